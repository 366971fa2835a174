// A page with three.js in a headless browser, without any network: a small server hands out the page, three's
// modules and the models asked for.
import { accessSync, constants } from 'node:fs';
import { readFile } from 'node:fs/promises';
import http from 'node:http';
import { delimiter, dirname, extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import { folder, load } from './modules.mjs';

const { chromium } = load('playwright-core');
const here = dirname(fileURLToPath(import.meta.url));
const types = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.wasm': 'application/wasm' };
const page_of = script => `<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,">
<style>body { margin: 0 }</style>
<script type="importmap">{ "imports": {
  "three": "/node_modules/three/build/three.module.js",
  "three/addons/": "/node_modules/three/examples/jsm/" } }</script>
<script type="module" src="/${script}"></script>`;

/** The first of these programs on the path. */
function program(...names) {
  if (process.env.CHROMIUM) return process.env.CHROMIUM;
  for (const name of names) {
    for (const place of process.env.PATH.split(delimiter)) {
      try {
        accessSync(join(place, name), constants.X_OK);
        return join(place, name);
      } catch { /* look on */ }
    }
  }
  throw new Error(`none of ${names.join(', ')} is installed`);
}

/** Answers `/models/N` with the Nth file, the rest from this folder and from `node_modules`. */
function serve(script, files) {
  return http.createServer(async (request, response) => {
    const path = normalize(decodeURIComponent(new URL(request.url, 'http://localhost').pathname));
    const model = path.match(/^\/models\/(\d+)$/);
    try {
      const body = path === '/' ? page_of(script)
        : await readFile(model ? files[model[1]] : join(path.startsWith('/node_modules/') ? folder : here, path));
      response.setHeader('content-type', path === '/' ? types['.html'] : types[extname(path)] ?? 'application/octet-stream');
      response.end(body);
    } catch {
      response.statusCode = 404;
      response.end();
    }
  }).listen(0, '127.0.0.1');
}

/** A headless browser that draws by software. */
export function browser() {
  return chromium.launch({
    executablePath: program('chromium', 'chromium-browser', 'google-chrome'),
    args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
  });
}

/**
 * Opens `script` of this folder in a page of the given size, and calls `use(page, complaints)`, where `complaints`
 * collects whatever the console says at the level of a warning or worse. The script sets `window.ready`.
 */
export async function with_page({ script, files, width = 640, height = 480 }, use) {
  const server = serve(script, files);
  await new Promise(done => server.once('listening', done));
  const running = await browser();
  try {
    const page = await running.newPage({ viewport: { width, height } });
    const complaints = [];
    page.on('console', message => {
      // Reading back a drawing by a software driver is slow, and the driver says so.
      const chatter = /GPU stall due to ReadPixels/.test(message.text());
      if (['error', 'warning'].includes(message.type()) && !chatter) complaints.push(`${message.type()}: ${message.text()}`);
    });
    page.on('pageerror', error => complaints.push(`error: ${error.message}`));
    await page.goto(`http://127.0.0.1:${server.address().port}/`);
    await page.waitForFunction('window.ready', null, { timeout: 60000 });
    return await use(page, complaints);
  } finally {
    await running.close();
    server.close();
  }
}
