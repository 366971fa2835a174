// node site_look.mjs SITE
// Opens the pages of house types of a site in a browser and moves their sliders. Exits with 1 on messages of the console, if nothing
// is drawn, or if no slider changes the model. Where the page compiles, its text is changed too, once to one with an error.
import { readFile } from 'node:fs/promises';
import http from 'node:http';
import { extname, join, normalize } from 'node:path';
import { browser } from './browser.mjs';

const [site] = process.argv.slice(2);
if (!site) throw new Error('no folder');
const types = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm', '.glb': 'model/gltf-binary', '.jpg': 'image/jpeg', '.png': 'image/png' };
const server = http.createServer(async (request, response) => {
  const path = normalize(decodeURIComponent(new URL(request.url, 'http://localhost').pathname));
  try {
    const body = await readFile(join(site, path));
    response.writeHead(200, { 'content-type': types[extname(path)] ?? 'application/octet-stream' }).end(body);
  } catch {
    response.writeHead(404).end();
  }
}).listen(0, '127.0.0.1');
await new Promise(done => server.once('listening', done));
const running = await browser(), found = [];
for (const name of ['houses.html', 'ja/houses.html']) {
  const page = await running.newPage({ viewport: { width: process.env.HSD_PICTURE ? 900 : 320, height: 480 }, deviceScaleFactor: 0.5 });
  page.setDefaultTimeout(240000);
  page.on('console', message => { if (message.type() === 'error') found.push(`${name}: ${message.text()}`); });
  page.on('pageerror', error => found.push(`${name}: ${error.message}`));
  page.on('response', response => { if (response.status() >= 400) found.push(`${name}: ${response.url()} ${response.status()}`); });
  const shown = async () => {
    await page.waitForFunction(() => !['', 'loading', undefined].includes(document.querySelector('#houses')?.dataset.state), null, { timeout: 240000 });
    const { state, triangles } = await page.evaluate(() => ({ ...document.querySelector('#houses').dataset }));
    if (state !== 'shown') found.push(`${name}: ${state}`);
    return Number(triangles);
  };
  await page.goto(`http://127.0.0.1:${server.address().port}/${name}`, { waitUntil: 'commit' });
  const counts = [await shown()];
  const sliders = await page.$$('#houses input[type=range]');
  for (const slider of sliders) {
    await slider.evaluate(input => { input.value = input.value === input.max ? input.min : input.max; input.dispatchEvent(new Event('input')); });
    counts.push(await shown());
  }
  const text = await page.$('#houses textarea');
  if (text) {
    const type = written => text.evaluate((area, written) => { area.value = written; area.dispatchEvent(new Event('input')); }, written);
    await type('0 0 180\n9.5\n\nKKS  TKD 2MRE\nKSK  MRE  KSK\nKKS  TIT 2KKS\nKSK  KSK  KSK\n');
    counts.push(await shown());
    if (counts.at(-1) === counts.at(-2)) found.push(`${name}: the text changes nothing`);
    await type('0 0 180\n9.5\n\nKSX\n');
    await shown();
    const said = await page.textContent('#houses pre');
    if (!said.includes('HSD0301')) found.push(`${name}: an error is not told: ${said}`);
    console.log(`${name}: its text compiled in the page, ${counts.at(-1)} triangles; ${said.trim()}`);
  }
  console.log(`${name}: ${sliders.length} sliders, triangles ${counts.join(', ')}`);
  if (!counts.every(count => count > 2) || new Set(counts).size < 2) found.push(`${name}: the sliders change nothing`);
  if (process.env.HSD_PICTURE) await page.locator('#houses').screenshot({ path: join(process.env.HSD_PICTURE, name.replace('/', '-').replace('html', 'png')) });
  await page.close();
}
await running.close();
server.close();
for (const line of found) console.log(`  ${line}`);
process.exit(found.length > 0 ? 1 : 0);
