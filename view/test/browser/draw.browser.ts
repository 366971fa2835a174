// The drawing tools: each edit changes the source file and the model follows; by pointer and by keyboard.

import assert from 'node:assert/strict';
import { chmodSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, beforeEach, test } from 'node:test';
import type { Page } from 'playwright-core';
import { drawing } from './drawing.ts';
import { does, Preview, until } from './preview.ts';

const HOUSE = `# A plain house; the front is to the south.
# Its back is closed.
0 0 180
9.0
name plain

KSK  KSK  TKD 2KSK  KSK
KTU  KTU  MRE  KTU
KTU  KTU  KTU  KTU  KTU  KTU
KTU  KTU  KTU  KTU
`;

let preview: Preview, page: Page;
const { text, tool, status, at, pull: drag, becomes, restore } = drawing('plain.hsd', () => ({ preview, page }));

before(async () => {
  preview = await Preview.of([['plain.hsd', HOUSE]]);
  page = await preview.open('?file=plain.hsd');
  await does(page, 'plan').click();
  await does(page, 'draw').click();
  await page.locator('.toolbar [data-do=model]').click(); // Makes room for the plan.
  await until(async () => await page.locator('.palette button').count() > 50, 'the palette is loaded');
});
after(async () => { await preview?.close(); });
beforeEach(async () => {
  await restore(HOUSE);
  await drawn();
  // Room for drags, at the edge of which the sheet would move along.
  await page.evaluate(() => { hsd.plan.fit(); hsd.plan.sheet.zoom(1.5); });
  await page.locator('.tools input[value=part]').check();
});

/** Waits until the plan is up to date with the model. */
const drawn = () => until(() => page.evaluate(() => hsd.plan.drawn.walls.size > 0 && document.documentElement.dataset.revision === `${hsd.revision}`), 'the plan is drawn');

/** Corners of a storey in the plan. */
const corners = (house = 0, storey = 0) => page.evaluate(([h, s]) => hsd.app.state!.plan.houses[h!]!.storeys[s!]!.rings[0]!.walls.map(w => w.from), [house, storey]);

test('the palette shows parts with images and finds them by name', async () => {
  const buttons = page.locator('.palette button');
  const all = await buttons.count();
  const picture = buttons.filter({ hasText: 'KSK' }).first().locator('img');
  await until(() => picture.evaluate(e => (e as HTMLImageElement).complete && (e as HTMLImageElement).naturalWidth > 0), 'an image is loaded');
  await page.getByLabel('Find a part').fill('格子');
  const found = await buttons.count();
  assert.ok(found > 0 && found < all, `${found} of ${all}`);
  await page.getByLabel('Find a part').fill('no such part');
  assert.equal(await buttons.count(), 0);
  await page.getByLabel('Find a part').fill('');
  assert.equal(await buttons.count(), all);
});

test('a part is placed with two clicks, undone and redone', async () => {
  await page.locator('.palette button[data-code="KTU  "]').click();
  assert.match(await status() ?? '', /now choose/);
  await page.locator('.unit[data-code=KSK] .hit').first().click({ force: true });
  await becomes(t => t.includes('KTU  KSK  TKD 2KSK  KSK'), 'the first unit is KTU');
  assert.equal(text(), HOUSE.replace('KSK  KSK  TKD', 'KTU  KSK  TKD'), 'nothing else has changed');
  assert.equal(await page.evaluate(() => hsd.find('KSK').length), 3);
  await does(page, 'undo').click();
  await becomes(t => t === HOUSE, 'undone');
  await does(page, 'redo').click();
  await becomes(t => t !== HOUSE, 'redone');
  await page.keyboard.press('Control+z');
  await becomes(t => t === HOUSE, 'undone by keyboard');
  await page.keyboard.press('Control+Shift+Z');
  await becomes(t => t !== HOUSE, 'redone by keyboard');
});

test('a part is placed by keyboard', async () => {
  await page.locator('.palette button[data-code="KTU  "]').focus();
  await page.keyboard.press('Enter');
  await page.locator('.unit[tabindex="0"]').focus();
  await page.keyboard.press('Home');
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('Enter');
  await becomes(t => t.includes('KSK  KTU  TKD 2KSK  KSK'), 'the second unit is KTU');
  assert.equal(await page.evaluate(() => document.activeElement?.getAttribute('data-code')), 'KTU', 'the focus stays');
});

test('a wall is dragged along its normal with a ghost and its units, and the adjoining walls follow', async () => {
  await tool('wall');
  await drag([2.5, 4], [2.5, 6.2]);
  assert.equal(await page.locator('.ghost').count(), 1);
  assert.equal(await page.locator('.ghost-label').textContent(), '+2 units');
  await page.mouse.up();
  await becomes(t => t !== HOUSE, 'the text changes');
  assert.deepEqual(await corners(), [[0, 0], [6, 0], [6, 6], [0, 6]]);
  assert.ok(text().startsWith(HOUSE.slice(0, HOUSE.indexOf('KSK'))), 'comments stay');
  assert.equal(await page.locator('.ghost').count(), 0);
  await does(page, 'undo').click();
  await becomes(t => t === HOUSE, 'undone');
});

test('a wall is moved by keyboard', async () => {
  await tool('wall');
  const back = page.locator('.run').nth(2);
  await back.focus();
  await page.keyboard.press('ArrowUp');
  assert.equal(await page.locator('.ghost-label').textContent(), '+1 unit');
  await page.keyboard.press('Escape');
  assert.equal(await page.locator('.ghost').count(), 0);
  assert.equal(text(), HOUSE);
  await page.keyboard.press('ArrowDown');
  await page.keyboard.press('Enter');
  await becomes(t => t !== HOUSE, 'the text changes');
  assert.deepEqual(await corners(), [[0, 0], [6, 0], [6, 3], [0, 3]]);
});

test('an impossible edit is refused with a reason, and nothing changes', async () => {
  await tool('wall');
  await drag([2.5, 4], [2.5, -3]);
  await page.mouse.up();
  await until(async () => /^Not applied: .{10,}/.test(await status() ?? ''), 'it is refused');
  assert.ok(await page.locator('.status.refused').isVisible());
  assert.equal(await page.locator('.ghost').count(), 0, 'the ghost is removed');
  assert.equal(text(), HOUSE);
});

test('a stretch of a wall is chosen and broken out, by pointer and keyboard', async () => {
  await tool('break');
  await drag([4.2, 4], [2.8, 4]);
  await page.mouse.up();
  assert.match(await page.locator('.ghost-label').textContent() ?? '', /^1–4: 0 units/);
  await drag([3.5, 4], [3.5, 6]);
  await page.mouse.up();
  await becomes(t => t !== HOUSE, 'the text changes');
  assert.deepEqual(await corners(), [[0, 0], [6, 0], [6, 4], [5, 4], [5, 6], [2, 6], [2, 4], [0, 4]]);
  await preview.save(page, 'plain.hsd', HOUSE);
  await drawn();
  await page.locator('.run').nth(2).focus();
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('Shift+ArrowRight');
  await page.keyboard.press('ArrowUp');
  await page.keyboard.press('Enter');
  await becomes(t => t !== HOUSE, 'the text changes');
  assert.equal((await corners()).length, 8);
});

test('a storey is added, given a height, and removed', async () => {
  await does(page, 'add-storey').click();
  await becomes(t => t !== HOUSE, 'a storey is added');
  assert.equal(await page.evaluate(() => hsd.app.state!.plan.houses[0]!.storeys.length), 2);
  assert.equal(await page.locator('.pane.plan .bar select').inputValue(), '2', 'it is shown');
  const height = page.getByLabel('Height (shaku)');
  await height.fill('7.5');
  await does(page, 'set-height').click();
  await becomes(t => /7\.5/.test(t), 'it is 7.5 shaku high');
  assert.ok(Math.abs(await page.evaluate(() => hsd.app.state!.plan.houses[0]!.storeys[1]!.height) - 7.5) < 1e-6);
  await does(page, 'remove-storey').click();
  await becomes(() => true, 'it is removed');
  await until(() => page.evaluate(() => hsd.app.state!.plan.houses[0]!.storeys.length === 1), 'one storey is left');
});

test('a new house is drawn, by pointer and keyboard', async () => {
  for (let i = 0; i < 4; i++) await does(page, 'farther').click();
  await tool('outline');
  await drag([-6, 0], [-2, 3]);
  assert.equal(await page.locator('.ghost-label').textContent(), '4 × 3 units');
  await page.mouse.up();
  await becomes(t => t !== HOUSE, 'a house is added');
  assert.equal(await page.evaluate(() => hsd.app.state!.plan.houses.length), 2);
  const second = await corners(1);
  assert.equal(second.length, 4);
  const one = text();
  await page.locator('svg.sheet').focus();
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('ArrowLeft');
  assert.match(await page.locator('.ghost-label').textContent() ?? '', /^5 × 4 units/);
  await page.keyboard.press('Enter');
  await becomes(t => t !== one, 'another house is added');
  assert.equal(await page.evaluate(() => hsd.app.state!.plan.houses.length), 3);
  const two = text();
  await page.getByLabel('House', { exact: true }).selectOption('1');
  await does(page, 'remove-house').click();
  await becomes(t => t !== two, 'one is removed');
  assert.equal(await page.evaluate(() => hsd.app.state!.plan.houses.length), 2);
});

test('Escape and a second finger cancel a drag', async () => {
  await tool('wall');
  await drag([2.5, 4], [2.5, 6]);
  await page.keyboard.press('Escape');
  assert.equal(await page.locator('.ghost').count(), 0);
  await page.mouse.up();
  await tool('outline');
  await drag([8, 1], [11, 4]);
  await page.keyboard.press('Escape');
  await page.mouse.up();
  await tool('wall');
  await drag([2.5, 4], [2.5, 6]);
  const { x, y } = await at(3.5, 4);
  await page.evaluate(([x, y]) => document.elementFromPoint(x!, y!)!.dispatchEvent(
    new PointerEvent('pointerdown', { bubbles: true, pointerId: 77, pointerType: 'touch', clientX: x!, clientY: y! })), [x, y]);
  await page.mouse.up();
  assert.equal(await page.locator('.ghost').count(), 0);
  await page.waitForTimeout(200);
  assert.equal(text(), HOUSE);
});

test('edits in quick succession are all applied in order', async () => {
  await page.locator('.palette button[data-code="KTU  "]').click();
  const units = page.locator('.unit[data-code=KSK] .hit'), count = await units.count();
  await page.evaluate(() => {
    for (const unit of document.querySelectorAll('.unit[data-code=KSK] .hit')) unit.dispatchEvent(new MouseEvent('click', { bubbles: true }));
  });
  await becomes(t => !t.includes('KSK'), `${count} units are set`);
  for (let i = 0; i < count; i++) await page.keyboard.press('Control+z');
  await becomes(t => t === HOUSE, 'all are undone');
});

test('a change saved during a drag is kept, and the edit is applied if its target still exists', async () => {
  await tool('wall');
  await drag([2.5, 4], [2.5, 6.2]);
  await preview.save(page, 'plain.hsd', `# Written meanwhile.\n${HOUSE}`);
  assert.equal(await page.locator('.ghost').count(), 1, 'the drag continues');
  await page.mouse.up();
  await becomes(t => t.startsWith('# Written meanwhile.') && t.length > HOUSE.length + 25, 'both are there');
  assert.deepEqual(await corners(), [[0, 0], [6, 0], [6, 6], [0, 6]]);
  await preview.save(page, 'plain.hsd', HOUSE);
  await drawn();
  await drag([2.5, 4], [2.5, 6.2]);
  const deeper = HOUSE.replaceAll('KTU  KTU  MRE  KTU', 'KTU  KTU  MRE  KTU  KTU').replace('\nKTU  KTU  KTU  KTU\n', '\nKTU  KTU  KTU  KTU  KTU\n');
  await preview.save(page, 'plain.hsd', deeper);
  await page.mouse.up();
  await until(async () => (await status() ?? '').includes('changed in the meantime'), 'it is refused');
  assert.equal(text(), deeper);
  assert.equal(await page.locator('.ghost').count(), 0);
});

test('heights are limited to numbers within bounds', async () => {
  const height = page.getByLabel('Height (shaku)');
  for (const wrong of ['-3', '', '500', '0.2']) {
    await height.fill(wrong);
    await does(page, 'set-height').click();
    assert.match(await status() ?? '', /Not applied: the height must be a number from 1 to 100/);
  }
  assert.equal(text(), HOUSE);
});

test('a first house can be drawn in an empty file', async () => {
  preview.write('empty.hsd', '');
  preview.write('remark.hsd', '# 私の家\n');
  for (const file of ['empty.hsd', 'remark.hsd']) {
    await page.locator('.files button').filter({ hasText: file.split('.')[0]! }).click();
    await until(() => page.evaluate(file => hsd.app.state?.file === file && hsd.reload !== null, file), 'it is shown');
    const status = await page.evaluate(() => hsd.app.state!.diagnostics.map(d => d.code));
    await until(async () => await page.locator('.messages .message').count() === status.length, 'messages are shown');
    await page.waitForTimeout(150);
    await tool('outline');
    const { x, y, width, height } = (await page.locator('.sheet').boundingBox())!;
    await page.mouse.move(x + width * 0.35, y + height * 0.35);
    await page.mouse.down();
    await page.mouse.move(x + width * 0.65, y + height * 0.65, { steps: 4 });
    await page.mouse.up();
    await until(() => page.evaluate(() => hsd.app.state!.plan.houses.length === 1 && hsd.app.model!.triangles > 0), 'the house is shown');
    await does(page, 'remove-house').click();
    await until(async () => (await page.locator('.status').textContent() ?? '').includes('the only house'), 'it is refused');
    assert.equal(await page.evaluate(() => hsd.app.state!.diagnostics.length), 0, preview.read(file));
  }
  await page.locator('.files button').filter({ hasText: 'plain' }).click();
  await until(() => page.evaluate(() => hsd.app.state?.file === 'plain.hsd'), 'the other is back');
});

test('a read-only or missing file is reported', async () => {
  const path = join(preview.folder, 'plain.hsd');
  await page.locator('.palette button[data-code="KTU  "]').click();
  const set = () => page.locator('.unit[data-code=KSK] .hit').first().click({ force: true });
  chmodSync(path, 0o444);
  await set();
  await until(async () => (await status() ?? '').includes('Not applied: no permission to write to the file or its folder'), 'the edit of a read-only file is refused');
  chmodSync(path, 0o644);
  assert.equal(text(), HOUSE);
  rmSync(path);
  await until(async () => /plain\.hsd has been removed/.test(await page.locator('.live').textContent() ?? ''), 'the removal is reported');
  await set();
  await until(async () => (await status() ?? '').includes('Not applied: the file no longer exists'), 'the edit is refused');
  preview.write('plain.hsd', HOUSE);
});

test('drawing is disabled where files may not be edited', async () => {
  const closed = await Preview.of([['plain.hsd', HOUSE]], '--read-only');
  try {
    const there = await closed.open('?file=plain.hsd');
    await does(there, 'plan').click();
    assert.ok(await does(there, 'draw').isDisabled());
    closed.assertClean();
  } finally {
    await closed.close();
  }
});

test('no requests to other hosts, no errors', () => preview.assertClean());
