// Two editions of a town side by side: kept, another year, the line between them, what differs, in Chromium with the real server.

import assert from 'node:assert/strict';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import type { Page } from 'playwright-core';
import { AXE, violations } from './axe.ts';
import { EXAMPLES, Preview, until } from './preview.ts';

let preview: Preview, page: Page;

before(async () => {
  const towns = join(EXAMPLES, 'towns');
  preview = await Preview.of(['kyoto.hsd', 'kyoto-shares.csv', 'block-houses.geojson', 'block-roads.geojson'].map(name => join(towns, name)));
  preview.script = AXE;
  page = await preview.open('?file=kyoto.hsd');
  await until(() => page.evaluate(() => hsd.app.town.state?.whole === true && !hsd.app.town.busy), 'the town is built', 120_000);
  await page.locator('[data-fold="comparison"] summary').click();
});
after(async () => { await preview?.close(); });

/** What is shown on either side of the line, as it is painted. */
const sides = () => page.evaluate(() => {
  const { split, scene } = hsd.app.renderer.viewport, found: string[] = [];
  for (const left of [true, false]) {
    split?.show(left);
    found.push(scene.children.filter(child => child.name === 'town' && child.visible).map(child => hsd.app.comparison.kept?.tiles.group === child ? 'kept' : 'built').join());
  }
  return found;
});

test('without a kept town one scene fills the view', async () => {
  assert.equal(await page.locator('[data-do="end-comparison"]').isVisible(), false);
  assert.equal(await page.evaluate(() => hsd.app.renderer.viewport.split), null);
});

test('another year stands beside the kept town, and what differs is listed', async () => {
  await page.locator('[data-do="keep-town"]').click();
  await until(() => page.evaluate(() => hsd.app.comparison.kept !== null && !hsd.app.comparison.kept.tiles.busy), 'it is kept', 120_000);
  await until(async () => (await page.locator('[data-fold="comparison"]').innerText()).includes('0 features differ'), 'nothing differs', 120_000);
  const year = page.locator('[data-parameter="year"] input');
  await year.fill('1998');
  await until(() => page.evaluate(() => hsd.app.comparison.difference !== null && hsd.app.comparison.difference.total > 0 && !hsd.app.town.busy), 'the other year is built', 120_000);
  const { total, same, list } = await page.evaluate(() => hsd.app.comparison.difference!);
  // Four fronts, and the surface of the four streets.
  assert.deepEqual([total, list.length], [8, 8]);
  assert.ok(same > total, `${same}`);
  const fronts = list.filter(({ before, after }) => before.startsWith('chu-nikai') && after.startsWith('kanban'));
  const streets = list.filter(({ before, after }) => before.includes('surface=earth') && after.includes('surface=asphalt'));
  assert.deepEqual([fronts.length, streets.length], [4, 4], JSON.stringify(list));
  assert.deepEqual(await sides(), ['kept', 'built']);
  const text = await page.locator('[data-fold="comparison"]').innerText();
  assert.match(text, /Right: year = 1998/);
  assert.match(text, /8 features differ/);
});

test('the line moves by keyboard, and each side has its own houses', async () => {
  const slider = page.locator('[data-do="split"]');
  const picture = async () => (await page.locator('canvas').first().screenshot()).toString('base64');
  await slider.focus();
  await page.keyboard.press('Home');
  assert.equal(await page.evaluate(() => hsd.app.comparison.at), 0);
  const built = await picture();
  await page.keyboard.press('End');
  assert.equal(await page.evaluate(() => hsd.app.comparison.at), 1);
  assert.notEqual(await picture(), built);
  await slider.fill('50');
});

test('a feature that differs is found by a click', async () => {
  await page.locator('[data-fold="comparison"] li button').first().click();
  await until(() => page.evaluate(() => hsd.app.town.selected !== null), 'it is selected', 120_000);
});

test('nothing stands in the way of the panel', async () => {
  assert.deepEqual(await violations(page), []);
});

test('the comparison ends', async () => {
  await page.locator('[data-do="end-comparison"]').click();
  await until(() => page.evaluate(() => hsd.app.renderer.viewport.split === null && hsd.app.comparison.kept === null), 'one scene again', 120_000);
  assert.equal(await page.evaluate(() => hsd.app.town.tiles!.group.visible), true);
});
