// Review of a house that was read from a scan: the scan lies under its plan, walls in doubt are settled by keys and clicks.

import assert from 'node:assert/strict';
import { after, before, beforeEach, test } from 'node:test';
import { inflateSync } from 'node:zlib';
import type { Page } from 'playwright-core';
import { AXE } from './axe.ts';
import { drawing } from './drawing.ts';
import { png } from './png.ts';
import { does, Preview, until } from './preview.ts';

const HOUSE = `<House name="read">
  <Storey height="9">
    <!-- in doubt: KTU at 1 0, TSH 2 at 2 0 -->
    <Row>KTU  KTU  TSH 2KTU  KTU</Row>
    <Row><repeat num="8"><Part code="KTU"/></repeat></Row>
    <Row><repeat num="6"><Part code="KTU"/></repeat></Row>
    <Row><repeat num="8"><Part code="KTU"/></repeat></Row>
    <Loop inner="yes" start="0 4">
      <!-- in doubt: KTU at 2 4 -->
      <Row>TFU 2KTU  KTU  TFU 2</Row>
    </Loop>
  </Storey>
  <Roofs kind="K" shape="KIR"/>
</House>
`;

/** Pixels a unit of the scan, and the pixel of the right end of the front. */
const UNIT = 40, [X, Y] = [320, 400], SIZE = [400, 480] as const;

/** A dark square in the house, half a unit wide, its middle 4.5 units to the left and 6.5 back; the rest is light. */
const scan = png(SIZE, (x, y) => Math.abs(X - (x + 0.5) - 4.5 * UNIT) < UNIT / 4 && Math.abs(Y - (y + 0.5) - 6.5 * UNIT) < UNIT / 4 ? 20 : 235);
const metres = 10 / 11 / UNIT;
const PLAN = { plan: 1, sheets: [{ storey: 1, picture: 'read.sheet-1.png', to_house: [-metres, 0, 0, -metres, X * metres, Y * metres] }] };

let preview: Preview, page: Page;
const { text, at, becomes, restore, status } = drawing('read.hsd', () => ({ preview, page }));
const options = () => page.locator('.doubt-list [role=option]').allTextContents();
const told = () => page.locator('.review-status').textContent();

before(async () => {
  preview = await Preview.of([['read.hsd', HOUSE], ['read.plan.json', JSON.stringify(PLAN)], ['other.hsd', HOUSE.replace(/<!--.*-->/g, '')]]);
  preview.write('read.sheet-1.png', scan);
  preview.script = AXE;
  page = await preview.open('?file=read.hsd', { viewport: { width: 1400, height: 900 }, deviceScaleFactor: 1 });
});
after(async () => { await preview?.close(); });
beforeEach(async () => {
  await restore(HOUSE);
  await until(async () => (await options()).length === 3, 'three walls are in doubt');
});

/** Goes to a wall in doubt by keys. */
async function reach(index: number) {
  await page.locator('.doubt-list').focus();
  await page.keyboard.press('Home');
  for (let i = 0; i < index; i++) await page.keyboard.press('n');
}

/** The grey of a place of the plan on the screen. */
async function grey(a: number, b: number): Promise<number> {
  const { x, y } = await at(a, b), shot = await page.screenshot({ clip: { x: Math.round(x) - 1, y: Math.round(y) - 1, width: 2, height: 2 } });
  let at8 = 8, data = new Uint8Array();
  while (at8 < shot.length) {
    const long = shot.readUInt32BE(at8);
    if (shot.toString('latin1', at8 + 4, at8 + 8) === 'IDAT') data = new Uint8Array([...data, ...shot.subarray(at8 + 8, at8 + 8 + long)]);
    at8 += 12 + long;
  }
  return inflateSync(data)[1]!;
}

test('walls in doubt are listed, and shown one after the other in the plan', async () => {
  assert.deepEqual((await options()).map(t => t.replace(/^(KTU|TSH 2) .*?, /, '$1, ')), ['KTU, left 1, back 0', 'TSH 2, left 2, back 0', 'KTU, left 2, back 4']);
  assert.equal(await page.locator('[data-fold=doubts] .count').textContent(), '3');
  await does(page, 'next-doubt').click();
  assert.ok(await page.locator('.pane.plan').isVisible(), 'the plan is shown');
  assert.match(await told() ?? '', /^1 of 3: KTU/);
  await until(async () => await page.locator('.doubt').count() === 3, 'all are marked');
  assert.equal(await page.locator('.doubt.current').count(), 1);
  // It is in the middle of the sheet, and lit in the model.
  const box = (await page.locator('svg.sheet').boundingBox())!, mark = await at(1.5, 0);
  assert.ok(Math.abs(mark.x - box.x - box.width / 2) < 3 && Math.abs(mark.y - box.y - box.height / 2) < 3, JSON.stringify([box, mark]));
  assert.deepEqual(await page.evaluate(() => hsd.lit), ['KTU']);
  await page.locator('svg.sheet').focus();
  await page.keyboard.press('n');
  assert.match(await told() ?? '', /^2 of 3: TSH 2/);
  await page.keyboard.press('p');
  await page.keyboard.press('p');
  assert.match(await told() ?? '', /^3 of 3: KTU/);
  await page.locator('.doubt').nth(1).locator('line').click({ force: true });
  assert.match(await told() ?? '', /^2 of 3: TSH 2/);
});

test('the scan lies under the plan, at its scale; its opacity is set, and it is taken away', async () => {
  await reach(0);
  await page.evaluate(() => hsd.plan.fit());
  await page.locator('.sheet .scan image').waitFor();
  const slider = page.locator('[data-scan=opacity]');
  await slider.fill('1');
  // The square of the picture is where the house has it, and nowhere else.
  await until(async () => await grey(4.5, 6.5) < 60, 'the square is dark');
  for (const [a, b] of [[4.5, 6.1], [4.1, 6.5], [4.9, 6.5], [4.5, 6.9], [5.2, 6.5]] as const) assert.ok(await grey(a, b) > 190, `${a} ${b}`);
  for (const [a, b] of [[4.3, 6.3], [4.7, 6.7]] as const) assert.ok(await grey(a, b) < 60, `${a} ${b}`);
  await slider.fill('0.2');
  await until(async () => await grey(4.5, 6.5) > 150, 'it is faint');
  await slider.fill('1');
  await page.locator('[data-scan=on]').uncheck();
  await until(async () => await grey(4.5, 6.5) > 190, 'it is gone');
  await page.locator('[data-scan=on]').check();
  await until(async () => await grey(4.5, 6.5) < 60, 'it is back');
});

test('Enter accepts, a number makes another kind of it, Delete takes it away; undo brings it back', async () => {
  await reach(0);
  await page.keyboard.press('Enter');
  await becomes('<!-- in doubt: TSH 2 at 2 0 -->');
  assert.ok(text().includes('<Row>KTU  KTU  TSH 2KTU  KTU</Row>'), 'the wall stays');
  await until(async () => /^1 of 2: TSH 2/.test(await told() ?? ''), 'the next one is shown');
  await page.keyboard.press('3');
  await becomes('  <Storey height="9">\n    <Row>KTU  KTU  MRE  MRE  KTU  KTU</Row>');
  await until(async () => /^1 of 1: KTU/.test(await told() ?? ''), 'the last one is shown');
  await page.keyboard.press('Delete');
  await becomes(t => /<Loop inner="yes" start="0 4">\n\s*<Row>TFU 2<\/Row>\n\s*<\/Loop>\n\s*<Loop inner="yes" start="3 4">\n\s*<Row>KTU  TFU 2<\/Row>/.test(t), 'the wall is parted');
  assert.ok(!text().includes('in doubt'), text());
  await until(async () => (await options()).length === 0, 'nothing is in doubt');
  assert.equal(await page.locator('[data-fold=doubts] .count').textContent(), '');
  for (const left of [1, 2, 3]) {
    await does(page, 'undo-doubt').click();
    await until(async () => (await options()).length === left, `${left} are back`);
  }
  await becomes(t => t === HOUSE, 'all is undone');
});

test('the same by clicks; outside an open way is left', async () => {
  await page.locator('.doubt-list [role=option]').nth(1).click();
  await does(page, 'delete-doubt').click();
  await becomes('<Row>KTU  KTU  AKI 2KTU  KTU</Row>');
  await does(page, 'doubt-slide').click();
  await becomes('<Row>TFU 2TSH  KTU  TFU 2</Row>');
  assert.ok(!text().includes('at 2 4'));
});

test('a part that the drawing tool replaces is in doubt no longer; other changes keep the rest', async () => {
  await reach(0);
  await does(page, 'draw').click();
  await until(async () => await page.locator('.palette button').count() > 50, 'the palette is loaded');
  await page.locator('.palette button[data-code="KSK  "], .palette button[data-code="KSK"]').first().click();
  await page.evaluate(() => hsd.plan.fit());
  await page.mouse.click((await at(1.5, 0)).x, (await at(1.5, 0)).y);
  await becomes('<Row>KTU  KSK  TSH 2KTU  KTU</Row>');
  assert.ok(text().includes('<!-- in doubt: TSH 2 at 2 0 -->'), `${await status()}`);
  assert.equal((await options()).length, 2);
  // While a tool draws, the keys of the plan are its own.
  const before = text();
  await page.locator('svg.sheet').focus();
  for (const key of ['Enter', 'Delete', '4']) await page.keyboard.press(key);
  await page.waitForTimeout(300);
  assert.equal(text(), before);
  await does(page, 'draw').click();
});

test('axe finds nothing, and a file without a scan shows no more of it', async () => {
  await reach(2);
  const serious = await page.evaluate(async () => {
    const { axe } = window as unknown as { axe: { run: () => Promise<{ violations: { id: string; nodes: { html: string }[] }[] }> } };
    return (await axe.run()).violations.map(v => `${v.id} ${v.nodes[0]?.html}`);
  });
  assert.deepEqual(serious, []);
  const other = await preview.open('?file=other.hsd&lang=ja', { viewport: { width: 1400, height: 900 } });
  await does(other, 'plan').click();
  assert.equal(await other.locator('.scan-controls').isVisible(), false);
  assert.equal(await other.locator('[data-fold=doubts]').isVisible(), false);
  await other.context().close();
  const japanese = await preview.open('?file=read.hsd&lang=ja', { viewport: { width: 1400, height: 900 } });
  await does(japanese, 'next-doubt').click();
  assert.match(await japanese.locator('.review-status').textContent() ?? '', /^3 か所のうち 1: KTU/);
  await japanese.context().close();
});

test('a broken file beside the house is told in words, and the page goes on', async () => {
  preview.write('read.plan.json', '{"plan":1,"sheets":[{"storey":1}]}');
  await until(async () => /read\.plan\.json: line 1, column \d+ is not as/.test(await page.locator('.messages').textContent() ?? ''), 'it is told');
  assert.equal(await page.locator('.sheet .scan image').count(), 0);
  preview.write('read.plan.json', JSON.stringify(PLAN));
  await until(async () => await page.locator('.sheet .scan image').count() === 1, 'the scan is back');
});

test('no requests to other hosts, no errors', () => preview.assertClean());
