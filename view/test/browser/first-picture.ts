// Measures how long the first picture of a town takes: `HSD=hsd node --import tsx test/browser/first-picture.ts TOWN...`, from the
// start of `hsd view` to the frame that shows the first tiles, in a browser that runs already.

import { spawn } from 'node:child_process';
import { browser } from './chromium.ts';

const chromium = await browser();
for (const town of process.argv.slice(2)) {
  const begun = performance.now(), since = () => Math.round(performance.now() - begun);
  const server = spawn(process.env['HSD']!, ['view', town, '--no-open', '--port', '0'], { stdio: ['ignore', 'pipe', 'inherit'] });
  const url = await new Promise<string>(done => {
    let output = '';
    server.stdout.on('data', data => { const found = (output += data).match(/http:\S+/); if (found) done(found[0]); });
  });
  const listens = since(), page = await chromium.newPage({ viewport: { width: 1100, height: 700 } });
  const seen: [string, number][] = [];
  page.on('response', async response => {
    const path = new URL(response.url()).pathname;
    if (/tileset|\.glb|view\.js|tiles-|state/.test(path)) seen.push([path.replace(/^.*\//, ''), since()]);
  });
  await page.addInitScript('globalThis.__name = f => f');
  await page.goto(url);
  const loaded = since();
  await page.waitForFunction(() => globalThis.hsd?.app.town.tiles, null, { timeout: 300_000, polling: 5 });
  const rooted = since();
  await page.waitForFunction(() => (hsd.app.town.tiles?.shown ?? 0) > 0, null, { timeout: 300_000, polling: 5 });
  const first = since();
  await page.evaluate(() => new Promise<void>(done => hsd.viewport.draw(done)));
  const drawn = since();
  await page.waitForFunction(() => hsd.app.town.state?.whole && !hsd.app.town.busy, null, { timeout: 600_000, polling: 20 });
  console.log(town, { listens, loaded, rooted, first, drawn, whole: since(), features: await page.evaluate(() => hsd.app.town.state!.features) });
  console.log(seen.slice(0, 12).map(([name, at]) => `${name} ${at}`).join(', '));
  await page.close();
  server.kill();
}
await chromium.close();
