// Photographs become a front: corners, lattice and mask by pointer and by keys, the wall seen straight at once, the model that is
// built.

import assert from 'node:assert/strict';
import { existsSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, beforeEach, test } from 'node:test';
import type { Page } from 'playwright-core';
import type { Corners, Place } from '../../src/server/front.ts';
import { AXE, violations } from './axe.ts';
import { png } from './png.ts';
import { does, Preview, until } from './preview.ts';

const SIZE = [640, 480] as const, BAYS = 4, STOREYS = 3;
/** The corners of the wall in the photograph, and in the second one. */
const CORNERS: Corners = [[120, 70], [540, 110], [520, 400], [110, 430]], OTHER: Corners = [[90, 100], [560, 60], [570, 420], [100, 390]];

/** The map from pixels of a photograph to parts of its wall. */
function toWall([p, q, r, s]: Corners): (x: number, y: number) => Place {
  // The unit square to four points, and back (Heckbert).
  const [dx1, dy1, dx2, dy2] = [q[0] - r[0], q[1] - r[1], s[0] - r[0], s[1] - r[1]], [sx, sy] = [p[0] - q[0] + r[0] - s[0], p[1] - q[1] + r[1] - s[1]];
  const by = dx1 * dy2 - dx2 * dy1, g = (sx * dy2 - dx2 * sy) / by, k = (dx1 * sy - sx * dy1) / by;
  const [a, b, c, d, e, f] = [q[0] - p[0] + g * q[0], s[0] - p[0] + k * s[0], p[0], q[1] - p[1] + g * q[1], s[1] - p[1] + k * s[1], p[1]];
  return (x, y) => {
    const [u, v, w] = [(e - f * k) * x + (c * k - b) * y + b * f - c * e, (f * g - d) * x + (a - c * g) * y + c * d - a * f, (d * k - e * g) * x + (b * g - a * k) * y + a * e - b * d];
    return [u / w, v / w];
  };
}

/** A wall of windows with bands between storeys, and a tree before one of them. */
function photograph(corners: Corners, tree: Place | null): Uint8Array {
  const wall = toWall(corners);
  const tone = (x: number, y: number) => {
    if (tree && Math.hypot(x - tree[0], y - tree[1]) < 26) return 40 + (x * 7 + y * 13) % 30;
    const [u, v] = wall(x, y);
    if (u < 0 || v < 0 || u > 1 || v > 1) return 245;
    const [a, b] = [u * BAYS % 1, v * STOREYS % 1];
    if (b < 0.06) return 215;
    if (a < 0.22 || a > 0.78 || b < 0.24 || b > 0.85) return 150;
    return a < 0.26 || a > 0.74 || b < 0.3 || b > 0.79 || Math.abs(a - 0.5) < 0.02 ? 225 : 45 + 40 * b;
  };
  return png(SIZE, (x, y) => [0.25, 0.75].flatMap(dx => [0.25, 0.75].map(dy => tone(x + dx, y + dy))).reduce((sum, t) => sum + t, 0) / 4);
}

let preview: Preview, page: Page;
const open = async (query = '') => {
  const opened = await preview.open(query, { viewport: { width: 1400, height: 900 }, deviceScaleFactor: 1 }, false);
  await opened.waitForFunction(() => globalThis.hsd?.front?.straight && !hsd.front!.busy);
  return opened;
};
const corners = () => page.evaluate(() => hsd.front!.draft.photos[0]!.corners);
const lattice = (way: 'columns' | 'rows') => page.evaluate(way => hsd.front!.draft[way], way);
const strokes = () => page.evaluate(() => hsd.front!.draft.photos[0]!.mask);
const told = () => page.locator('.told .status').textContent();
const settled = () => page.waitForFunction(() => !hsd.front!.busy, null, { timeout: 60_000 });
const picture = () => page.locator('svg.wall image').getAttribute('href');
const near = (a: number, b: number, by: number, what = '') => assert.ok(Math.abs(a - b) <= by, `${what} ${a} ${b}`);
/** The place on the screen of a pixel of the photograph, and of a part of the wall. */
const onPhoto = (at: Place) => page.evaluate(([x, y]) => {
  const p = new DOMPoint(x, y).matrixTransform(document.querySelector<SVGSVGElement>('svg.photo')!.getScreenCTM()!);
  return [p.x, p.y] as [number, number];
}, at);
const onWall = (at: Place) => page.evaluate(([u, v]) => {
  const [width, height] = hsd.front!.straight!.size;
  const p = new DOMPoint(u * width, v * height).matrixTransform(document.querySelector<SVGSVGElement>('svg.wall')!.getScreenCTM()!);
  return [p.x, p.y] as [number, number];
}, at);
async function drag(from: Place, to: Place) {
  await page.mouse.move(...from);
  await page.mouse.down();
  await page.mouse.move((from[0] + to[0]) / 2, (from[1] + to[1]) / 2);
  await page.mouse.move(...to);
}
/** Goes back to the beginning. */
async function restore() {
  while (await does(page, 'undo-front').isEnabled()) await does(page, 'undo-front').click();
  await does(page, 'front-corners').click();
  await settled();
}

before(async () => {
  preview = await Preview.ofPhotographs([['wall.png', photograph(CORNERS, [215, 200])], ['other.png', photograph(OTHER, null)]]);
  preview.script = AXE;
  page = await open();
});
after(async () => { await preview?.close(); });
beforeEach(restore);

test('the corners are found, the wall is seen straight, its lattice lies over it', async () => {
  const found = await corners();
  found.forEach((at, i) => near(Math.hypot(at[0] - CORNERS[i]![0], at[1] - CORNERS[i]![1]), 0, 2.5, `corner ${i}`));
  assert.match(await told() ?? '', /found/);
  assert.match(await picture() ?? '', /^data:image\/jpeg/);
  for (const [way, pieces] of [['columns', BAYS], ['rows', STOREYS]] as const) {
    const lines = await lattice(way);
    assert.equal(lines.length, pieces - 1, `${way}: ${lines}`);
    lines.forEach((at, i) => near(at, (i + 1) / pieces, 0.02, way));
    assert.equal(await page.locator(`.lattice-line.${way}`).count(), pieces - 1);
    assert.equal(await page.locator(`[data-do=front-${way}]`).inputValue(), `${pieces}`);
  }
  assert.equal(await does(page, 'model').getAttribute('aria-pressed'), 'false', 'there is no model yet');
  assert.ok(!existsSync(join(preview.folder, 'wall')), 'nothing is written');
});

test('a corner is dragged under a loupe, finely with Shift; the wall follows; undo and redo', async () => {
  const [first] = await corners(), from = await onPhoto(first!), before = await picture();
  assert.ok(!await page.locator('.loupe').isVisible());
  await drag(from, [from[0] + 30, from[1] + 20]);
  await until(async () => /^data:image\/bmp/.test(await picture() ?? ''), 'a small picture comes at once');
  const moved = await onPhoto((await corners())[0]!);
  near(moved[0] - from[0], 30, 1);
  near(moved[1] - from[1], 20, 1);
  const loupe = (await page.locator('.loupe').boundingBox())!;
  assert.ok(loupe.width > 150 && (loupe.x > moved[0] + 10 || loupe.x + loupe.width < moved[0] - 10), 'the loupe is beside the corner');
  const [left, top, wide] = (await page.locator('.loupe').getAttribute('viewBox'))!.split(' ').map(Number), [corner] = await corners();
  near(left! + wide! / 2, corner![0], 0.1);
  near(top! + wide! / 2, corner![1], 0.1);
  await page.mouse.up();
  await settled();
  assert.notEqual(await picture(), before);
  await page.locator('svg.photo .corner').first().focus();
  await page.keyboard.press('Control+z');
  assert.deepEqual((await corners())[0], first);
  await settled();
  assert.equal(await picture(), before, 'the wall is as it was');
  await page.keyboard.press('Control+Shift+z');
  assert.deepEqual((await corners())[0], corner);
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+y');
  assert.deepEqual((await corners())[0], corner);
  await does(page, 'undo-front').click();
  await does(page, 'redo-front').click();
  assert.deepEqual((await corners())[0], corner);
  await does(page, 'find-corners').click();
  assert.deepEqual((await corners())[0], first, 'as found');
  // A tenth of the way.
  await page.keyboard.down('Shift');
  await drag(from, [from[0] + 30, from[1]]);
  await page.mouse.up();
  await page.keyboard.up('Shift');
  near((await onPhoto((await corners())[0]!))[0] - from[0], 3, 0.5);
  // Corners that would cross stay.
  const [, second, third] = await corners();
  await drag(await onPhoto(second!), await onPhoto([third![0], third![1] + 60]));
  await page.mouse.up();
  const kept = (await corners())[1]!;
  assert.ok(kept[1] < third![1], `${kept}`);
});

test('keys move a corner by a pixel, with Shift by ten', async () => {
  const first = (await corners())[0]!;
  await page.locator('svg.photo').focus();
  await page.keyboard.press('Tab');
  const label = () => page.evaluate(() => document.activeElement!.getAttribute('aria-label'));
  assert.match(await label() ?? '', /^Upper left corner, x [\d.]+, y [\d.]+$/);
  assert.ok(await page.locator('.loupe').isVisible());
  for (const key of ['ArrowRight', 'ArrowRight', 'ArrowDown', 'Shift+ArrowDown', 'Shift+ArrowLeft', 'ArrowUp']) await page.keyboard.press(key);
  near((await corners())[0]![0], first[0] - 8, 0.11);
  near((await corners())[0]![1], first[1] + 10, 0.11);
  assert.ok((await label())!.includes(`x ${(await corners())[0]![0].toFixed(1)}`));
  for (const name of ['Upper right', 'Lower right', 'Lower left']) {
    await page.keyboard.press('Tab');
    assert.ok((await label())!.startsWith(name));
  }
  await page.keyboard.press('Tab');
  assert.ok(!await page.locator('.loupe').isVisible());
});

test('lines of the lattice are moved, added, removed, divided evenly and found again', async () => {
  const [first] = await lattice('columns'), at = await onWall([first!, 0.5]), to = await onWall([first! + 0.05, 0.5]);
  await drag(at, to);
  await page.mouse.up();
  near((await lattice('columns'))[0]!, first! + 0.05, 0.004);
  // By keys, in pixels of the wall; not over its neighbour.
  const size = await page.evaluate(() => hsd.front!.straight!.size), line = page.locator('.lattice-line.columns').first();
  const before = (await lattice('columns'))[0]!;
  await line.focus();
  for (const key of ['ArrowLeft', 'Shift+ArrowLeft', 'ArrowRight']) await page.keyboard.press(key);
  near((await lattice('columns'))[0]!, before - 10 / size[0], 1e-6);
  assert.equal(await line.getAttribute('role'), 'slider');
  assert.match(await line.getAttribute('aria-valuetext') ?? '', /^\d+\.\d\d m$/);
  await page.locator('.lattice-line.rows').first().focus();
  const row = (await lattice('rows'))[0]!;
  await page.keyboard.press('Shift+ArrowDown');
  near((await lattice('rows'))[0]!, row + 10 / size[1], 1e-6);
  for (let i = 0; i < 70; i++) await page.keyboard.press('Shift+ArrowDown');
  const [a, b] = await lattice('rows');
  assert.ok(a! < b!, 'it stays before the next one');
  await page.keyboard.press('Delete');
  assert.equal((await lattice('rows')).length, STOREYS - 2);
  assert.equal(await page.evaluate(() => document.activeElement!.getAttribute('data-line')), 'rows 0', 'the next one is held');
  await does(page, 'remove-line').click();
  assert.equal((await lattice('rows')).length, STOREYS - 3);
  await does(page, 'remove-line').click();
  assert.match(await told() ?? '', /Choose a line/);
  await does(page, 'add-rows').click();
  await does(page, 'add-rows').click();
  assert.deepEqual(await lattice('rows'), [0.25, 0.5]);
  assert.equal(await page.evaluate(() => document.activeElement!.getAttribute('data-line')), 'rows 0');
  await does(page, 'add-columns').click();
  assert.equal((await lattice('columns')).length, BAYS);
  await page.mouse.dblclick(...await onWall([0.93, 0.9]));
  near((await lattice('columns')).at(-1)!, 0.93, 0.004);
  await page.keyboard.down('Shift');
  await page.mouse.dblclick(...await onWall([0.1, 0.8]));
  await page.keyboard.up('Shift');
  near((await lattice('rows')).at(-1)!, 0.8, 0.004);
  await page.locator('[data-do=front-columns]').fill('5');
  await page.locator('[data-do=front-columns]').press('Enter');
  assert.deepEqual((await lattice('columns')).map(c => Number(c.toFixed(6))), [0.2, 0.4, 0.6, 0.8]);
  await page.locator('[data-do=front-rows]').fill('99');
  await page.locator('[data-do=front-rows]').press('Enter');
  assert.match(await told() ?? '', /1 to 40/);
  // A lattice by hand stays when a corner moves.
  await page.locator('svg.photo .corner').first().focus();
  await page.keyboard.press('ArrowLeft');
  await settled();
  assert.equal((await lattice('columns')).length, 4);
  await does(page, 'find-lattice').click();
  await until(async () => (await lattice('columns')).length === BAYS - 1 && (await lattice('rows')).length === STOREYS - 1, 'it is found');
});

test('a mask is painted and erased, by pointer and by keys', async () => {
  const wall = await picture();
  assert.ok(await page.locator('[data-do=brush-width]').isDisabled());
  await does(page, 'front-brush').click();
  await page.locator('[data-do=brush-width]').fill('0.08');
  const width = await page.evaluate(() => hsd.front!.brush);
  near(width, 0.08 * 640, 0.1);
  await drag(await onPhoto([205, 190]), await onPhoto([225, 215]));
  await page.mouse.up();
  await settled();
  const [stroke] = await strokes();
  assert.ok(stroke && !stroke.erases && stroke.points.length > 1 && stroke.width === width, JSON.stringify(stroke));
  assert.ok(await page.locator('svg.photo .veil').isVisible());
  assert.notEqual(await picture(), wall, 'the wall shows it');
  // Corners are no hindrance while a brush is in hand.
  const first = await corners();
  await drag(await onPhoto(first[0]!), await onPhoto([first[0]![0] + 20, first[0]![1]]));
  await page.mouse.up();
  assert.deepEqual(await corners(), first);
  assert.equal((await strokes()).length, 2);
  await does(page, 'front-eraser').click();
  await page.locator('svg.photo').focus();
  // The brush stands where the pointer left it.
  await page.keyboard.press(']');
  near(await page.evaluate(() => hsd.front!.brush), width * 1.25, 0.2);
  await page.keyboard.press('[');
  await page.keyboard.press(' ');
  for (const key of ['ArrowRight', 'ArrowRight', 'Shift+ArrowDown', 'ArrowLeft', 'ArrowUp']) await page.keyboard.press(key);
  await page.keyboard.press(' ');
  const erased = (await strokes())[2]!;
  assert.ok(erased.erases && erased.points.length === 6, JSON.stringify(erased));
  near(erased.points[1]![0] - erased.points[0]![0], width / 4, 0.3);
  near(erased.points[3]![1] - erased.points[2]![1], width * 2.5, 0.3);
  await page.keyboard.press('Enter');
  await page.keyboard.press('Escape');
  assert.equal((await strokes()).length, 4, 'a dot');
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
  assert.equal((await strokes()).length, 2);
});

test('width and height make the proportions; what is no size changes nothing', async () => {
  const aspect = () => page.evaluate(() => hsd.front!.straight!.aspect);
  await page.locator('[data-do=front-width]').fill('12');
  await page.locator('[data-do=front-width]').press('Enter');
  assert.equal(await page.evaluate(() => hsd.front!.draft.size), null, 'both are needed');
  await page.locator('[data-do=front-height]').fill('6');
  await page.locator('[data-do=front-height]').press('Enter');
  await until(async () => Math.abs(await aspect() - 2) < 1e-9, 'twice as wide as high');
  await settled();
  const [wide, high] = await page.evaluate(() => hsd.front!.straight!.size);
  near(wide / high, 2, 0.01);
});

test('another photograph of the wall has corners and a mask of its own', async () => {
  const which = page.locator('[data-do=which-photo]');
  const before = await picture();
  await which.selectOption('1');
  await settled();
  assert.notEqual(await picture(), before);
  const other = await page.evaluate(() => hsd.front!.draft.photos[1]!.corners);
  other.forEach((at, i) => near(Math.hypot(at[0] - OTHER[i]![0], at[1] - OTHER[i]![1]), 0, 9, `corner ${i}`));
  await page.locator('svg.photo .corner').nth(2).focus();
  await page.keyboard.press('Shift+ArrowRight');
  assert.notDeepEqual(await page.evaluate(() => hsd.front!.draft.photos[1]!.corners), other);
  assert.equal(await page.evaluate(() => hsd.front!.draft.columns.length), BAYS - 1, 'the lattice is that of the first');
  await which.selectOption('0');
  await settled();
});

test('Build writes the folder and shows the model; again after a change; axe finds nothing', async () => {
  assert.deepEqual(await violations(page), []);
  await does(page, 'build-front').click();
  await page.waitForSelector('html[data-revision]', { state: 'attached' });
  await until(async () => !await page.evaluate(() => hsd.front!.busy), 'it is built');
  const files = readdirSync(join(preview.folder, 'wall'));
  for (const name of ['wall.hsd', 'parts.csv', 'rectified.png', 'compared.png', 'facade.json', 'by-hand.json', 'wall-street.hsd']) assert.ok(files.includes(name), `${files}`);
  assert.match(await told() ?? '', /12 places/);
  assert.ok(await page.locator('.pane.model').isVisible());
  const text = preview.read('wall/wall.hsd');
  const parts = await page.evaluate(() => hsd.app.model!.parts.filter(({ kind }) => kind === 'part').length);
  assert.equal(parts, BAYS * STOREYS, text);
  assert.match(text, /replaced by the same part|<repeat num/);
  await page.evaluate(() => hsd.settled());
  assert.deepEqual(await violations(page), []);
  // Between two town houses, and out of the street again.
  await does(page, 'in-street').click();
  await until(async () => (await page.evaluate(() => hsd.app.model?.houses)) === 3, 'it stands in a street');
  assert.equal(await does(page, 'in-street').getAttribute('aria-pressed'), 'true');
  await page.evaluate(() => hsd.settled());
  assert.deepEqual(await violations(page), []);
  await does(page, 'in-street').click();
  await until(async () => (await page.evaluate(() => hsd.app.model?.houses)) === 1, 'it stands alone');
  await page.evaluate(() => hsd.settled());
  const revision = await page.evaluate(() => hsd.revision);
  await page.locator('[data-do=front-rows]').fill('2');
  await page.locator('[data-do=front-rows]').press('Enter');
  await does(page, 'build-front').click();
  await until(async () => await page.evaluate(before => hsd.revision > before && !hsd.front!.busy, revision), 'it is built again');
  await until(async () => await page.evaluate(() => hsd.app.model!.parts.filter(({ kind }) => kind === 'part').length) === 2 * BAYS, 'the model is new');
});

test('a page that is opened again begins where the last one ended, in Japanese too', async () => {
  const again = await open('?lang=ja');
  await again.waitForSelector('html[data-revision]', { state: 'attached' });
  assert.equal(await again.locator('[data-do=front-rows]').inputValue(), '2');
  assert.match(await again.locator('.told .status').textContent() ?? '', /前に作ったとき/);
  assert.match(await again.locator('svg.photo .corner').first().getAttribute('aria-label') ?? '', /^左上の隅/);
  assert.equal(await does(again, 'build-front').textContent(), '作る');
  assert.deepEqual(await violations(again), []);
  await again.context().close();
});

test('small pictures of a wall come while it is dragged', async t => {
  const times = (await page.evaluate(() => hsd.front!.times)).sort((a, b) => a - b), middle = times[times.length >> 1]!;
  t.diagnostic(`${times.length} pictures, ${middle.toFixed(0)} ms in the middle, ${times.at(-1)!.toFixed(0)} ms at the most`);
  assert.ok(times.length > 20);
});

test('no requests to other hosts, no errors', () => preview.assertClean());
