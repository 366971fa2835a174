// Tiles of towns that come slowly, that change while they are loaded, or that miss an image: the page always comes to rest.

import assert from 'node:assert/strict';
import { cpSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import type { Page } from 'playwright-core';
import { EXAMPLES, Preview, until } from './preview.ts';

const TOWN = 'town/block.hsd';

/** Bodies of answers come long after their heads. */
const SLOW_BODIES = `
  const own = Response.prototype.arrayBuffer;
  Response.prototype.arrayBuffer = async function () { await new Promise(done => setTimeout(done, 400)); return own.call(this); };`;

/** Remembers the images that are drawn, and says which of them were closed before. */
const WATCHED_IMAGES = `
  const closed = new WeakSet(), close = ImageBitmap.prototype.close;
  globalThis.closedImages = [];
  ImageBitmap.prototype.close = function () { closed.add(this); close.call(this); };
  for (const name of ['texImage2D', 'texSubImage2D']) {
    const draw = WebGL2RenderingContext.prototype[name];
    WebGL2RenderingContext.prototype[name] = function (...all) {
      if (all.some(one => one instanceof ImageBitmap && closed.has(one))) globalThis.closedImages.push(name);
      return draw.apply(this, all);
    };
  }`;

let preview: Preview;

const atRest = (page: Page, ms = 60_000) => until(() => page.evaluate(() => hsd.app.town.state?.whole === true && !hsd.app.town.busy), 'all tiles are loaded', ms);
const shownTiles = (page: Page) => page.evaluate(() => hsd.app.town.tiles!.shown);

before(async () => {
  preview = await Preview.of([]);
  cpSync(join(EXAMPLES, 'towns'), join(preview.folder, 'town'), { recursive: true });
});
after(async () => { await preview?.close(); });

test('bodies that come long after their heads are waited for, and no longer', async () => {
  preview.script = SLOW_BODIES;
  const page = await preview.open(`?file=${TOWN}`);
  await atRest(page);
  assert.ok(await shownTiles(page) > 0, 'tiles are shown');
  const text = preview.read(TOWN);
  preview.write(TOWN, text.replace('<Place type="kura" on="centre"/>', '<Skip because="no store"/>'));
  await until(() => page.evaluate(() => hsd.app.town.state?.skipped === 2), 'it is built again');
  await atRest(page);
  assert.ok(await shownTiles(page) > 0, 'the next tiles are shown');
  preview.write(TOWN, text);
  await until(() => page.evaluate(() => hsd.app.town.state?.skipped === 1), 'it is as before');
  await page.context().close();
});

test('many quick saves end with the last town, and no texture of the ones before is kept or closed while it is drawn', async () => {
  preview.script = WATCHED_IMAGES;
  const page = await preview.open(`?file=${TOWN}`), text = preview.read(TOWN);
  await atRest(page);
  const before = await page.evaluate(() => hsd.app.town.tiles!.textures);
  assert.ok(before > 3, `${before} textures`);
  for (let round = 0; round < (process.env['HSD_THOROUGH'] ? 3 : 1); round++) {
    for (let n = 0; n < 12; n++) {
      preview.write(TOWN, n === 11 ? text : text.replace('seed="7"', `seed="${n}"`));
      await new Promise(done => setTimeout(done, [30, 90, 260, 700, 1500][(n * 7 + round) % 5]));
    }
    await until(() => page.evaluate(() => hsd.app.town.state?.skipped === 1 && hsd.app.town.progress === null), 'the last save is built', 60_000);
    await atRest(page);
    await page.evaluate(() => hsd.settled());
    assert.ok(await shownTiles(page) > 0, 'tiles are shown');
    await until(() => page.evaluate(before => hsd.app.town.tiles!.textures === before, before), 'the textures are those of one town');
  }
  assert.deepEqual(await page.evaluate(() => (globalThis as unknown as { closedImages: string[] }).closedImages), []);
  // The files of a town are there until two more are built: a page may ask for one that is gone, and gets the next.
  preview.consoleMessages.splice(0, Infinity, ...preview.consoleMessages.filter(text => !/Failed to load (tileset .* with status|model with error code) 404|Failed to load tile at url/.test(text)));
  await page.context().close();
});

test('a tile whose image cannot be loaded is shown, and the image is asked for again by the next town', async () => {
  preview.script = '';
  const page = await preview.open(`?file=house.hsd`, {}, false);
  let missed = '', again = 0;
  await page.route('**/textures/*', route => {
    missed ||= route.request().url();
    if (route.request().url() !== missed) return route.continue();
    return ++again === 1 ? route.fulfill({ status: 404 }) : route.continue();
  });
  await page.goto(`${preview.url}?file=${TOWN}`);
  await until(() => page.evaluate(() => globalThis.hsd !== undefined), 'the page is there');
  await atRest(page);
  assert.ok(await shownTiles(page) > 0, 'tiles are shown');
  assert.ok(missed, 'an image is missed');
  preview.write(TOWN, preview.read(TOWN).replace('<Place type="kura" on="centre"/>', '<Skip because="no store"/>'));
  await until(() => page.evaluate(() => hsd.app.town.state?.skipped === 2), 'it is built again');
  await atRest(page);
  assert.ok(again > 1, 'it is asked for again');
  preview.consoleMessages.splice(0, Infinity, ...preview.consoleMessages.filter(text => !text.includes("Couldn't load texture")));
  await page.context().close();
});

test('a camera that looks away from the town waits for nothing', async () => {
  const page = await preview.open(`?file=${TOWN}`);
  await atRest(page);
  await page.evaluate(() => { hsd.camera = [0, 400, 0, 0, 800, 1]; });
  preview.write(TOWN, preview.read(TOWN).replace('no store', 'no store at all'));
  const root = await page.evaluate(() => hsd.app.town.state!.tileset);
  await until(() => page.evaluate(root => hsd.app.town.state!.tileset !== root || hsd.app.town.progress === null, root), 'it is built again');
  await atRest(page);
  await page.context().close();
});

test('of a large town the middle is shown before the rest is built', async () => {
  const square = (x: number, y: number) => [[x, y], [x + 8, y], [x + 8, y + 12], [x, y + 12], [x, y]];
  const houses = Array.from({ length: 2160 }, (_, i) => ({
    type: 'Feature', properties: { key: `h${i}` }, geometry: { type: 'Polygon', coordinates: [square(i % 60 * 20, Math.floor(i / 60) * 100 + 10)] },
  }));
  const roads = Array.from({ length: 36 }, (_, i) => ({
    type: 'Feature', properties: { highway: 'residential' }, geometry: { type: 'LineString', coordinates: [[-20, i * 100], [1220, i * 100]] },
  }));
  for (const [name, features] of [['houses', houses], ['roads', roads]] as const) preview.write(`large/${name}.geojson`, JSON.stringify({ type: 'FeatureCollection', features }));
  preview.write('large/large.hsd', '<Town seed="1">\n<Layer name="houses" src="houses.geojson" crs="local" key="key"/>\n<Layer name="roads" src="roads.geojson" crs="local"/>\n'
    + '<for each="houses"><Place type="so-nikai"/></for>\n<Tiles size="100"/>\n</Town>\n');
  preview.script = `globalThis.seen = [];
    setInterval(() => {
      const { state, tiles } = globalThis.hsd?.app.town ?? {}, last = globalThis.seen.at(-1);
      if (!state?.tileset) return;
      const now = { tileset: state.tileset, features: state.features, built: state.built, whole: state.whole, shown: 0, size: 0 };
      const one = last?.tileset === state.tileset ? last : (globalThis.seen.push(now), now);
      one.shown = Math.max(one.shown, tiles?.shown ?? 0);
      if (tiles && !tiles.box.isEmpty()) one.size = tiles.box.max.x - tiles.box.min.x;
    }, 5);`;
  const page = await preview.open('?file=large/large.hsd');
  await atRest(page, 200_000);
  const seen = await page.evaluate(() => (globalThis as unknown as { seen: { features: number; built: number; whole: boolean; shown: number; size: number }[] }).seen);
  const [first] = seen, last = seen.at(-1)!;
  assert.ok(seen.length >= 3, JSON.stringify(seen));
  assert.ok(first!.built >= 300 && first!.built < 450, `${first!.built} houses first`);
  assert.ok(first!.shown > 0 && !first!.whole, 'they are shown');
  assert.ok(first!.size < 0.8 * last.size, `${first!.size} m of ${last.size} m`);
  assert.deepEqual([first!.features, last.features, last.built, last.whole], [2160, 2160, 2160, true]);
  await page.context().close();
});

test('nothing went wrong', () => preview.assertClean());
