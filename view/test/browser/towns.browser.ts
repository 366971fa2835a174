// Towns: tiles are streamed, a click on a house tells what its map and rule say, what was skipped leads to its place.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { cpSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import type { Page } from 'playwright-core';
import { AXE } from './axe.ts';
import { brightness, does, EXAMPLES, mean, Preview, until } from './preview.ts';

const TOWN = 'town/block.hsd', PHONE = { width: 360, height: 740 };
/** The library says so of every tileset of version 1.1. */
const KNOWN = 'tiles versions at 1.1 or higher have limited support';

let preview: Preview, page: Page;

/** Waits until a town is shown with all its levels. */
async function shown(page: Page) {
  const ready = () => page.evaluate(() => {
    const { state, tiles, busy } = hsd.app.town;
    return state?.whole === true && !busy && tiles!.shown > 0;
  });
  await until(ready, 'the town is shown', 120_000);
  await page.evaluate(() => hsd.settled());
}

/** Where the middle of a house is drawn, CSS pixels of the page. */
const placeOf = (page: Page, key: string) => page.evaluate(key => {
  const { renderer: { viewport }, town } = hsd.app, { shape } = town.tiles!.shapeOf('houses', key)!, { canvas, camera } = viewport;
  const { x, y } = shape.boundingBox!.getCenter(camera.position.clone()).project(camera), { left, top } = canvas.getBoundingClientRect();
  shape.dispose();
  return { x: left + (x + 1) / 2 * canvas.clientWidth, y: top + (1 - y) / 2 * canvas.clientHeight };
}, key);

const card = (page: Page) => page.locator('.feature-card');

before(async () => {
  preview = await Preview.of([]);
  cpSync(join(EXAMPLES, 'towns'), join(preview.folder, 'town'), { recursive: true });
  preview.script = AXE;
  page = await preview.open(`?file=${TOWN}`);
  await shown(page);
});
after(async () => { await preview?.close(); });

/** Waits until a house is among the tiles that are shown. */
const drawn = (page: Page, key: string) => until(() => page.evaluate(key => hsd.app.town.tiles!.shapeOf('houses', key) !== null, key), `${key} is drawn`, 60_000);

test('tiles are drawn, and the panel says what was built', async () => {
  const { triangles } = await page.evaluate(() => hsd.stats);
  assert.ok(triangles > 1000, `${triangles} triangles`);
  const light = await brightness(page);
  assert.ok(light.some(value => value < mean(light) - 0.15), 'roofs are darker than the ground');
  const panel = page.locator('[data-fold=town]');
  assert.match(await panel.innerText(), /17 features: 16 built, 1 skipped/);
  assert.equal(await page.locator('.building').isVisible(), false, 'the build has ended');
  for (const fold of ['parts', 'shown', 'section']) assert.equal(await page.locator(`[data-fold=${fold}]`).isVisible(), false, `${fold} says nothing of a town`);
});

test('a click on a house tells its feature, type, parameters and evidence, and leads to its line', async () => {
  await drawn(page, 's1');
  const { x, y } = await placeOf(page, 's1');
  await page.mouse.click(x, y);
  await until(() => card(page).isVisible(), 'the card is shown');
  const text = await card(page).innerText();
  for (const word of ['houses', 'frontage=', 'drawn for this example', 'Front faces']) assert.ok(text.includes(word), `${word} in ${text}`);
  assert.ok(await page.evaluate(() => hsd.app.renderer.selected.drawn) > 0, 'it is marked');
  const { key, house } = await page.evaluate(() => hsd.app.town.selected!);
  assert.equal(text.split('\n')[0], key);
  const line = preview.read(TOWN).split('\n')[house!.line - 1]!;
  assert.match(line, /<Place/);
  await card(page).locator('[data-do=text]').click();
  await until(async () => (await page.locator('.source-line .spot').first().innerText()).includes('<Place'), 'its line is marked');
  await card(page).locator('[data-do=open]').click();
  assert.deepEqual((await preview.sent()).slice(0, 2), ['block.hsd', house!.line]);
  await page.evaluate(() => hsd.app.town.clearSelection());
});

test('a click on the ground tells its place in the system of the map, and its height', async () => {
  const spot = await page.evaluate(() => {
    const { canvas, camera, environment } = hsd.viewport, { left, top } = canvas.getBoundingClientRect(), { min, max } = hsd.app.town.box!;
    const at = camera.position.clone().set((min.x + max.x) / 2, environment.level, max.z + 1.5), seen = at.clone().project(camera);
    return { at: at.toArray(), x: left + (seen.x + 1) / 2 * canvas.clientWidth, y: top + (1 - seen.y) / 2 * canvas.clientHeight };
  });
  await page.mouse.click(spot.x, spot.y);
  await until(async () => /local/.test(await card(page).innerText()), 'the place is told');
  const told = (await card(page).locator('.ground-place').innerText()).match(/^x (-?[\d.]+) m, y (-?[\d.]+) m \(local\), height (-?[\d.]+) m$/)!.slice(1).map(Number);
  // The map counts from elsewhere: the houses of the town tell from where.
  const origin = await page.evaluate(async () => (await (await fetch(`/api/town/${hsd.app.town.state!.id}/place?east=0&north=0`)).json() as { at: number[] }).at);
  assert.ok(Math.abs(told[0]! - origin[0]! - spot.at[0]!) < 0.3 && Math.abs(told[1]! - origin[1]! + spot.at[2]!) < 0.3, `${told}, not ${spot.at} from ${origin}`);
  assert.ok(Math.abs(told[2]!) < 0.5, `the ground at ${told[2]}`);
  assert.equal(await page.locator('.live').innerText(), await card(page).locator('.ground-place').innerText());
  await page.locator('canvas.viewport').focus();
  await page.keyboard.press('Escape');
  await until(async () => !await card(page).isVisible(), 'Escape clears it');
});

test('without a pointer: a house is found by its key, and Enter selects what is under the crosshair', async () => {
  const find = page.locator('[data-do=find-key]');
  await find.fill('s3');
  await find.press('Enter');
  await until(async () => await card(page).locator('h2').innerText() === 's3', 's3 is selected');
  assert.equal(await page.locator('.live').innerText(), await page.evaluate(() => `Selected: ${hsd.app.town.title()}`));
  await page.locator('canvas.viewport').focus();
  await page.keyboard.press('Escape');
  await until(async () => !await card(page).isVisible(), 'Escape clears the selection');
  await page.keyboard.press('Enter');
  await until(async () => await card(page).isVisible(), 'the house in the middle is selected');
  await find.fill('nobody');
  await find.press('Enter');
  await until(async () => (await page.locator('[data-fold=town]').innerText()).includes('No feature has the key nobody.'), 'it is said');
});

test('what was skipped leads to its place and to its rule', async () => {
  await page.locator('.skipped button').click();
  await until(async () => await card(page).locator('h2').innerText() === 'k2', 'it is selected');
  assert.match(await card(page).innerText(), /skipped: a shed/);
  const target = await page.evaluate(() => ({ at: hsd.app.town.skipped.list[0]!.at!, target: hsd.camera.slice(3) }));
  assert.ok(Math.abs(target.target[0]! - target.at[0]) < 0.1 && Math.abs(target.target[2]! + target.at[1]) < 0.1, JSON.stringify(target));
  assert.ok(await page.evaluate(() => hsd.app.renderer.selected.drawn) > 0, 'its place is marked');
  await until(async () => (await page.locator('.source-line .spot').first().innerText()).includes("use = 'shed'"), 'its rule is marked');
});

test('the view from the street stands before the front', async () => {
  await page.evaluate(() => hsd.app.town.goTo('houses', 's1'));
  await does(page, 'street').click();
  const { camera, decision } = await page.evaluate(() => ({ camera: hsd.camera, decision: hsd.app.town.selected!.decision! }));
  assert.ok(camera[1]! > 1 && camera[1]! < 3, `eyes at ${camera[1]} m`);
  const middle = [(Number(decision['front_x1']) + Number(decision['front_x2'])) / 2, -(Number(decision['front_y1']) + Number(decision['front_y2'])) / 2];
  assert.ok(Math.abs(camera[3]! - middle[0]!) < 0.1 && Math.abs(camera[5]! - middle[1]!) < 0.1, 'it looks at the middle of the front');
});

test('a save makes only what has changed, keeps the view, and tells mistakes', async () => {
  const text = preview.read(TOWN), before = await page.evaluate(() => ({ camera: hsd.camera, root: hsd.app.town.state!.tileset }));
  preview.write(TOWN, text.replace('<Place type="kura" on="centre"/>', '<Skip because="no store"/>'));
  await until(() => page.evaluate(() => hsd.app.town.state?.skipped === 2 && hsd.app.town.skipped.total === 2), 'the store is skipped');
  await shown(page);
  const now = await page.evaluate(() => ({ camera: hsd.camera, root: hsd.app.town.state!.tileset }));
  assert.deepEqual(now.camera, before.camera);
  assert.notEqual(now.root, before.root);
  preview.write(TOWN, text.replace("{use = 'shed'}", "{usse = 'shed'}"));
  const message = page.locator('.messages .message.error').first();
  await until(async () => await message.isVisible(), 'the mistake is told');
  assert.match(await message.innerText(), /usse/);
  preview.write(TOWN, text);
  await until(() => page.evaluate(() => hsd.app.state!.diagnostics.length === 0 && hsd.app.town.state!.skipped === 1), 'all is well again');
  await shown(page);
});

test('a house file opens after a town, and the town is gone', async () => {
  preview.write('house.hsd', '0 0 180\n9.0\n\nKSK  TOD  KSK\nKSK  KSK\nKSK  KSK  KSK\nKSK  KSK\n');
  await until(() => page.evaluate(() => hsd.app.serverInfo.files.some(({ path }) => path === 'house.hsd')), 'the file is listed', 60_000);
  await page.evaluate(() => hsd.app.openFile('house.hsd'));
  await until(() => page.evaluate(() => (hsd.app.model?.chunks.length ?? 0) > 0), 'the house is shown');
  assert.equal(await page.evaluate(() => hsd.app.town.tiles), null);
  assert.equal(await page.locator('[data-fold=town]').isVisible(), false);
  assert.equal(await page.locator('[data-fold=parts]').isVisible(), true);
});

test('a folder of tiles on the globe is shown with its tables', async () => {
  execFileSync(process.env['HSD']!, ['town', join(preview.folder, TOWN), '-o', `${join(preview.folder, 'tiles')}/`, '--detail', '0,1', '--quiet']);
  const page = await preview.open('?file=tiles/tileset.json');
  await shown(page);
  await page.evaluate(() => hsd.app.town.goTo('houses', 's1'));
  await until(async () => await card(page).isVisible(), 'the card is shown');
  assert.match(await card(page).innerText(), /frontage=/);
  await page.context().close();
});

for (const [layout, language] of [['wide', 'en'], ['phone', 'ja']] as const) {
  test(`axe finds nothing: ${layout}, ${language}`, async () => {
    const page = await preview.open(`?file=${TOWN}&lang=${language}`, layout === 'phone' ? { viewport: PHONE } : {});
    await shown(page);
    await page.evaluate(() => hsd.app.town.goTo('houses', 's1'));
    if (layout === 'phone') await does(page, 'panel').click();
    await until(async () => await card(page).isVisible(), 'the card is shown');
    const found = await page.evaluate(async () => {
      const { axe } = window as unknown as { axe: { run: (options: object) => Promise<{ violations: { id: string; nodes: { html: string }[] }[] }> } };
      return (await axe.run({ resultTypes: ['violations'] })).violations.flatMap(({ id, nodes }) => nodes.map(({ html }) => `${id}: ${html.slice(0, 160)}`));
    });
    assert.deepEqual(found, []);
    await page.context().close();
  });
}

test('the script that streams tiles is not loaded for a house', async () => {
  const page = await preview.open('?file=house.hsd'), scripts: string[] = [];
  page.on('request', request => { if (request.url().endsWith('.js')) scripts.push(request.url()); });
  await page.reload();
  await until(() => page.evaluate(() => (globalThis.hsd?.app.model?.chunks.length ?? 0) > 0), 'the house is shown');
  assert.deepEqual(scripts.filter(url => /\/tiles-/.test(url)), []);
  await page.context().close();
});

test('nothing went wrong', () => {
  preview.consoleMessages.splice(0, Infinity, ...preview.consoleMessages.filter(text => !text.includes(KNOWN)));
  preview.assertClean();
});
