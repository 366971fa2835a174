// Names of files, houses, layers, keys, reasons and evidence may hold markup, scripts, letters of the other direction and very long
// words: the page shows them as text, and keeps its layout.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import type { Page } from 'playwright-core';
import { Preview, until } from './preview.ts';

/** Would be an element, or run, if it were taken for anything but text. */
const MARKUP = '<img src=x onerror="globalThis.ran=1"><script>ran=1</script><b class=injected>';
const TURNED = '\u202Eesuoh\u202C', LONG = 'w'.repeat(3000);
const XML = (text: string) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('"', '&quot;');

const house = `<House name="${XML(MARKUP)}"><Storey><Row><Part code="${XML('<i>NOPE')}"/><Part code="GSI"/><Part code="GSI"/></Row><Turn/><Row><Part code="GSI"/><Part code="GSI"/></Row></Storey></House>`;
const square = (x: number) => ({ type: 'Polygon', coordinates: [[[x, 0], [x + 8, 0], [x + 8, 9], [x, 9], [x, 0]]] });
const map = (names: string[]) => JSON.stringify({
  type: 'FeatureCollection',
  features: names.map((name, n) => ({ type: 'Feature', id: name, properties: { name, n }, geometry: square(20 * n) })),
});
const town = `<Town name="${XML(MARKUP)}"><Layer name="houses" src="map.geojson" crs="local" evidence="${XML(MARKUP + LONG)}"/>
  <for each="houses" test="{n = 1}"><Skip because="${XML(MARKUP + TURNED)}"/></for>
  <for each="houses" test="{n != 1}"><Place type="block" on="outline" evidence="${XML(MARKUP)}"/></for></Town>`;
const KEYS = [MARKUP, `2${MARKUP}`, TURNED, LONG];

let preview: Preview;

before(async () => {
  preview = await Preview.of([['<b class=injected>.hsd', house], [`${'l'.repeat(200)}.hsd`, house], ['town/map.geojson', map(KEYS)], ['town/town.hsd', town]]);
});
after(async () => { await preview?.close(); });

/** Nothing of the markup has become an element or has run, and the page is no wider than its window. */
async function isText(page: Page, where: string) {
  const found = await page.evaluate(() => ({
    ran: 'ran' in globalThis,
    elements: document.querySelectorAll('.injected, img[src=x], main script, [onerror]').length,
    wide: document.documentElement.scrollWidth - innerWidth,
  }));
  assert.deepEqual({ ...found, wide: found.wide > 0 }, { ran: false, elements: 0, wide: false }, where);
}

test('a house: names of files, of the house and of its parts are text', async () => {
  const page = await preview.open(`?file=${encodeURIComponent('<b class=injected>.hsd')}`);
  await until(() => page.evaluate(() => hsd.app.state !== null), 'the house is shown');
  await isText(page, 'the page of a house');
  const text = await page.evaluate(() => document.body.textContent!);
  assert.ok(text.includes('<b class=injected>.hsd'), 'the file is named');
  assert.ok(text.includes('<i>NOPE'), 'the message quotes the code');
  await page.context().close();
});

test('a town: layers, keys, reasons and evidence are text', async () => {
  const page = await preview.open('?file=town/town.hsd');
  await until(() => page.evaluate(() => hsd.app.town.state?.whole === true && !hsd.app.town.busy), 'the town is shown', 60_000);
  await isText(page, 'the panel of a town');
  for (const key of KEYS) {
    await page.evaluate(key => hsd.app.town.goTo('houses', key), key);
    const card = page.locator('.feature-card');
    await until(async () => await card.isVisible() && await card.locator('h2').textContent() === key, `the card of ${key.slice(0, 20)}`);
    await isText(page, `the card of ${key.slice(0, 20)}`);
  }
  const skipped = await page.locator('.skipped').first().textContent();
  assert.ok(skipped!.includes(MARKUP), 'the reason is text');
  assert.deepEqual(preview.consoleMessages, []);
});
