// node programs.mjs HSD OUT_DIR
// Opens the pages of grammar/programs.md (`three.html`, `cesium.html`) beside the models that they name, in a browser whose
// network is the npm modules of the checks. Exits with 1 if one says an error, draws nothing, or does not tell what is clicked.
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import http from 'node:http';
import { dirname, extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import { browser } from './browser.mjs';
import { folder as modules } from './modules.mjs';

const [hsd, out] = process.argv.slice(2);
if (!out) throw new Error('usage: programs.mjs HSD OUT_DIR');
const root = join(dirname(fileURLToPath(import.meta.url)), '..');
mkdirSync(join(out, 'maps'), { recursive: true });
const text = readFileSync(join(root, 'grammar/programs.md'), 'utf8');
const pages = [...text.matchAll(/`(\w+\.html)`[^\n]*\n\n```html\n([^]*?)```/g)];
if (pages.length !== 2) throw new Error(`${pages.length} pages in grammar/programs.md, not 2`);
for (const [, name, body] of pages) writeFileSync(join(out, name), body);

// What the pages show: the example, and its block of houses put on the globe by a plane zone of Japan.
execFileSync(hsd, ['build', '--quiet', join(root, 'examples/machiya.hsd'), '-o', join(out, 'machiya.glb')], { stdio: 'inherit' });
const towns = join(root, 'examples/towns');
for (const name of ['block-houses.geojson', 'block-roads.geojson', 'shares.csv']) {
  writeFileSync(join(out, 'maps', name), readFileSync(join(towns, name)));
}
const town = readFileSync(join(towns, 'block.hsd'), 'utf8').replaceAll('crs="local"', 'crs="EPSG:6674"');
writeFileSync(join(out, 'maps/kyoto.hsd'), town);
execFileSync(hsd, ['town', '--quiet', '--detail', '0', join(out, 'maps/kyoto.hsd'), '-o', `${join(out, 'kyoto')}/`], { stdio: 'inherit' });

const types = { '.html': 'text/html', '.js': 'text/javascript', '.json': 'application/json', '.css': 'text/css', '.wasm': 'application/wasm' };
const typeOf = path => types[extname(path)] ?? 'application/octet-stream';
const server = http.createServer(async (request, response) => {
  const path = normalize(decodeURIComponent(new URL(request.url, 'http://localhost').pathname));
  try {
    response.setHeader('content-type', typeOf(path));
    response.end(await readFile(join(out, path)));
  } catch {
    response.statusCode = path === '/favicon.ico' ? 204 : 404;
    response.end();
  }
}).listen(0, '127.0.0.1');
await new Promise(done => server.once('listening', done));
const running = await browser();
let bad = 0;
for (const [, name] of pages) {
  const page = await running.newPage({ viewport: { width: 480, height: 320 } });
  const problems = [];
  page.on('console', message => { if (message.type() === 'error') problems.push(message.text()); });
  page.on('pageerror', error => problems.push(error.message));
  await page.route(/^https?:\/\/(?!127\.0\.0\.1)/, async route => {
    const url = new URL(route.request().url());
    const [, module, path] = url.href.match(/^https:\/\/cdn\.jsdelivr\.net\/npm\/(\w+)@[\d.]+\/(.*)$/) ?? [];
    if (!module) { problems.push(`asks ${url.origin}`); return route.abort(); }
    return route.fulfill({ body: await readFile(join(modules, 'node_modules', module, path)), contentType: typeOf(path), headers: { 'access-control-allow-origin': '*' } });
  });
  await page.goto(`http://127.0.0.1:${server.address().port}/${name}`);
  // A click tells what is there as soon as it is drawn.
  let title = '';
  for (const end = Date.now() + 120_000; !title && problems.length === 0 && Date.now() < end; await page.waitForTimeout(500)) {
    for (const [x, y] of [[240, 170], [240, 190], [200, 180]]) await page.mouse.click(x, y);
    title = await page.title();
  }
  if (process.env.HSD_PICTURES) await page.screenshot({ path: join(process.env.HSD_PICTURES, `${name}.png`) });
  if (!title) problems.push('no click tells anything');
  console.log(`${name}: ${title}`);
  for (const problem of problems) console.log(`  ${problem}`);
  bad += problems.length;
  await page.close();
}
await running.close();
server.close();
process.exit(bad > 0 ? 1 : 0);
