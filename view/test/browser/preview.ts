// `hsd view` over a temporary folder, with pages of a real Chromium.

import assert from 'node:assert/strict';
import { type ChildProcess, spawn } from 'node:child_process';
import { cpSync, existsSync, mkdirSync, readFileSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Browser, BrowserContextOptions, Page } from 'playwright-core';
import type {} from '../../src/scripting.ts';
import { browser } from './chromium.ts';
import { temporaryFolder } from './temporary.ts';

const here = dirname(fileURLToPath(import.meta.url));
export const EXAMPLES = join(here, '../../../examples');

export class Preview {
  readonly folder = temporaryFolder();
  url = '';
  /** Requests to other hosts, and console messages. */
  readonly foreignRequests: string[] = [];
  readonly consoleMessages: string[] = [];
  /** Runs in each page before its own scripts. */
  script = '';
  #server: ChildProcess | null = null;
  #browser: Browser | null = null;

  /** Starts a preview of example files, or of files given by name and text. */
  static async of(files: (string | [name: string, text: string])[], ...options: string[]): Promise<Preview> {
    const preview = new Preview();
    for (const file of files) {
      if (typeof file !== 'string') preview.write(...file);
      else if (existsSync(file)) cpSync(file, join(preview.folder, file.split('/').pop()!));
      else cpSync(join(EXAMPLES, file), join(preview.folder, file));
    }
    // An editor that logs the locations it is sent to.
    const tools = temporaryFolder();
    preview.#log = join(tools, 'log');
    const editor = join(tools, 'editor.mjs');
    writeFileSync(editor, `import { appendFileSync } from 'node:fs'; appendFileSync(${JSON.stringify(preview.#log)}, process.argv.slice(2).join(' ') + '\\n');`);
    await preview.serve('0', '--editor', `${process.execPath} ${editor} {file} {line} {column}`, ...options);
    return preview;
  }

  /** Starts the page of photographs, given by name and contents. */
  static async ofPhotographs(photos: [name: string, bytes: Uint8Array][], ...options: string[]): Promise<Preview> {
    const preview = new Preview();
    for (const photo of photos) preview.write(...photo);
    preview.#shown = ['--facade', ...photos.map(([name]) => join(preview.folder, name))];
    await preview.serve('0', ...options);
    return preview;
  }

  /** What the server shows. */
  #shown = [this.folder];
  #log = '';
  #options: string[] = [];

  /** Starts the server, on the previous port if none is given. */
  async serve(port = new URL(this.url).port, ...options: string[]) {
    const hsd = process.env['HSD'];
    if (!hsd) throw new Error('HSD names no program: use test/browser/run.mjs');
    if (options.length) this.#options = options;
    const server = this.#server = spawn(hsd, ['view', ...this.#shown, '--no-open', '--port', port, ...this.#options], { stdio: ['ignore', 'pipe', 'inherit'] });
    this.url = await new Promise<string>((done, fail) => {
      let output = '';
      server.stdout!.on('data', data => {
        output += data;
        const url = output.match(/http:\S+/)?.[0];
        if (url) done(url);
      });
      server.on('exit', code => fail(new Error(`hsd view ended with ${code}`)));
    });
  }

  /** Stops the server but not the browser. */
  async stop() {
    const server = this.#server;
    if (!server || server.exitCode !== null) return;
    const ended = new Promise(done => server.once('exit', done));
    server.kill();
    await ended;
  }

  async close() {
    await this.#browser?.close();
    await this.stop();
  }

  /** Opens a page with a query string and waits for its first model. */
  async open(query = '', options: BrowserContextOptions = {}, wait = true): Promise<Page> {
    this.#browser ??= await browser();
    // Drawn in software, the model takes most of the time: a pixel for four does where no picture is looked at.
    const context = await this.#browser.newContext({ viewport: { width: 960, height: 640 }, deviceScaleFactor: 0.5, acceptDownloads: true, ...options });
    const page = await context.newPage(), own = new URL(this.url).origin;
    page.setDefaultTimeout(20_000);
    page.on('request', request => {
      const url = request.url();
      if (!url.startsWith(own) && !url.startsWith('blob:') && !url.startsWith('data:')) this.foreignRequests.push(url);
    });
    page.on('console', message => {
      const text = message.text();
      if (message.type() === 'error' && !/Failed to load resource|net::ERR/.test(text)) this.consoleMessages.push(text);
    });
    page.on('pageerror', error => this.consoleMessages.push(error.stack ?? error.message));
    await page.addInitScript('globalThis.__name = f => f'); // A helper that tsx inserts into functions sent to the page.
    if (this.script) await page.addInitScript(this.script);
    if (process.env['HSD_DIST']) await fromDist(page, own);
    await page.goto(this.url + query);
    if (wait) await page.waitForSelector('html[data-revision]', { state: 'attached' });
    if (wait) await page.evaluate(() => hsd.settled());
    return page;
  }

  /** Writes a file in one step, so that no page can see it half written. */
  write(name: string, text: string | Uint8Array) {
    const path = join(this.folder, name), unfinished = `${path}.unfinished`;
    mkdirSync(dirname(path), { recursive: true });
    writeFileSync(unfinished, text);
    renameSync(unfinished, path);
  }

  read(name: string): string { return readFileSync(join(this.folder, name), 'utf8'); }

  /** Saves a source file and waits until a page shows it; returns the milliseconds from the save to the painted frame. */
  async save(page: Page, name: string, text: string | Uint8Array): Promise<number> {
    const shown = page.evaluate(before => new Promise<number>(done => {
      const look = () => hsd.revision > before && hsd.reload?.revision === hsd.revision ? done(Date.now()) : setTimeout(look, 1);
      look();
    }), await page.evaluate(() => hsd.revision));
    const begun = Date.now();
    this.write(name, text);
    return await shown - begun;
  }

  /** The location that the editor was last sent to: file, line, column. */
  async sent(): Promise<[file: string, line: number, column: number]> {
    await until(() => existsSync(this.#log) && readFileSync(this.#log, 'utf8').endsWith('\n'), 'the editor is called');
    const [file, line, column] = readFileSync(this.#log, 'utf8').trim().split('\n').pop()!.split(' ');
    rmSync(this.#log);
    return [file!.split('/').pop()!, Number(line), Number(column)];
  }

  /** Asserts that no request left the machine and nothing failed. */
  assertClean() {
    assert.deepEqual(this.foreignRequests, [], 'requests to other hosts');
    assert.deepEqual(this.consoleMessages, [], 'console messages');
  }
}

/** Serves the page from dist/, so that the program need not be rebuilt while working on the page. */
async function fromDist(page: Page, own: string) {
  const { gunzipSync } = await import('node:zlib');
  await page.route(url => url.origin === own && !url.pathname.startsWith('/api/'), async route => {
    const name = new URL(route.request().url()).pathname.slice(1) || 'index.html';
    const body = gunzipSync(new Uint8Array(readFileSync(join(here, `../../dist/${name}.gz`))));
    // Names of chunks change with their content; the program in hand serves the one of its own page.
    const like = /-[A-Z0-9]{8}\.js$/.test(name) ? new URL('/view.js', own).href : route.request().url();
    const { 'content-type': type, 'content-security-policy': policy } = (await route.fetch({ url: like })).headers();
    if (!type || !policy) throw new Error(`${name} is new: build hsd with it`);
    await route.fulfill({ body: Buffer.from(new Uint8Array(body)), headers: { 'content-type': type, 'content-security-policy': policy } });
  });
}

/** Waits until a condition holds. */
export async function until(holds: () => boolean | Promise<boolean>, what: string, ms = 10_000) {
  const end = Date.now() + ms;
  while (!await holds()) {
    if (Date.now() > end) assert.fail(`not within ${ms / 1000} s: ${what}`);
    await new Promise(done => setTimeout(done, 20));
  }
}

export const fold = (page: Page, name: string) => page.locator(`[data-fold=${name}]`);

/** Opens a section of the panel. */
export async function unfold(page: Page, name: string) {
  const element = fold(page, name);
  if (!await element.evaluate(e => (e as HTMLDetailsElement).open)) await element.locator('summary').first().click();
  return element;
}

/** A button by its action. */
export const does = (page: Page, name: string) => page.locator(`[data-do="${name}"]:visible`).first();

/** The image of the canvas: brightness from 0 to 1 on a grid of positions. */
export const brightness = (page: Page, quick = false) => page.evaluate(quick => {
  const { clientWidth: w, clientHeight: h } = hsd.viewport.canvas, places: [number, number][] = [];
  for (let y = 0.05; y < 1; y += 0.05) for (let x = 0.05; x < 1; x += 0.04) places.push([x * w, y * h]);
  return hsd.pixels(places, quick).map(([r, g, b]) => (r! * 0.3 + g! * 0.59 + b! * 0.11) / 255);
}, quick);

/** Fraction of positions in which two images differ. */
export const differ = (a: number[], b: number[], by = 0.03) => a.filter((value, i) => Math.abs(value - b[i]!) > by).length / a.length;

export const mean = (values: number[]) => values.reduce((sum, value) => sum + value, 0) / values.length;
