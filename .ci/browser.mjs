// Runs a page with three.js in a headless browser, without the network: a small server provides the page, the modules of
// three.js and the models.
import { accessSync, constants } from 'node:fs';
import { readFile } from 'node:fs/promises';
import http from 'node:http';
import { delimiter, dirname, extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import { folder, load } from './modules.mjs';

const { chromium } = load('playwright-core');
const here = dirname(fileURLToPath(import.meta.url));
const types = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.wasm': 'application/wasm' };
const pageOf = script => `<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,">
<style>body { margin: 0 }</style>
<script type="importmap">{ "imports": {
  "three": "/node_modules/three/build/three.module.js",
  "three/addons/": "/node_modules/three/examples/jsm/",
  "three/examples/jsm/": "/node_modules/three/examples/jsm/",
  "3d-tiles-renderer/three": "/node_modules/3d-tiles-renderer/build/index.three.js",
  "3d-tiles-renderer/three/plugins": "/node_modules/3d-tiles-renderer/build/index.three-plugins.js" } }</script>
<script type="module" src="/${script}"></script>`;

/** The path of the first of these programs on the PATH. */
function program(...names) {
  if (process.env.CHROMIUM) return process.env.CHROMIUM;
  for (const name of names) {
    for (const place of process.env.PATH.split(delimiter)) {
      try {
        accessSync(join(place, name), constants.X_OK);
        return join(place, name);
      } catch { /* try the next folder */ }
    }
  }
  throw new Error(`none of ${names.join(', ')} is installed`);
}

/** Serves the Nth file as `/models/N`, a folder as `/town/`, everything else from this folder and from `node_modules`. */
function serve(script, files, town) {
  return http.createServer(async (request, response) => {
    const path = normalize(decodeURIComponent(new URL(request.url, 'http://localhost').pathname));
    const model = path.match(/^\/models\/(\d+)$/);
    try {
      const body = path === '/' ? pageOf(script)
        : path.startsWith('/town/') ? await readFile(join(town, path.slice('/town'.length)))
        : await readFile(model ? files[model[1]] : join(path.startsWith('/node_modules/') ? folder : here, path));
      response.setHeader('content-type', path === '/' ? types['.html'] : types[extname(path)] ?? 'application/octet-stream');
      response.end(body);
    } catch {
      response.statusCode = 404;
      response.end();
    }
  }).listen(0, '127.0.0.1');
}

/** A headless browser with software rendering. */
export function browser() {
  return chromium.launch({
    executablePath: program('chromium', 'chromium-browser', 'google-chrome'),
    args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
  });
}

/**
 * Opens a script of this folder in a page of the given size and calls `use(page, problems)`, where `problems` collects the
 * warnings and errors of the console. The script sets `window.ready`.
 */
export async function withPage({ script, files = [], town, width = 640, height = 480 }, use) {
  const server = serve(script, files, town);
  await new Promise(done => server.once('listening', done));
  const running = await browser();
  try {
    const page = await running.newPage({ viewport: { width, height } });
    const problems = [];
    page.on('console', message => {
      // The software driver warns that reading pixels back is slow.
      const expected = /GPU stall due to ReadPixels/.test(message.text());
      if (['error', 'warning'].includes(message.type()) && !expected) problems.push(`${message.type()}: ${message.text()}`);
    });
    page.on('pageerror', error => problems.push(`error: ${error.message}`));
    await page.goto(`http://127.0.0.1:${server.address().port}/`);
    await page.waitForFunction('window.ready', null, { timeout: 60000 });
    return await use(page, problems);
  } finally {
    await running.close();
    server.close();
  }
}
