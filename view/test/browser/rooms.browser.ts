// Rooms in the drawing tool: walls inside and rooms go into the text, by pointer and by keyboard.

import assert from 'node:assert/strict';
import { after, before, beforeEach, test } from 'node:test';
import type { Page } from 'playwright-core';
import { AXE } from './axe.ts';
import { drawing } from './drawing.ts';
import { does, Preview, until } from './preview.ts';

const HOUSE = `<Houses>
  <House name="small">
    <Storey height="9">
      <Row>KSK  KSK  TKD 2KSK  KSK  </Row>
      <Row><repeat num="8"><Part code="KTU"/></repeat></Row>
      <Row><repeat num="6"><Part code="KTU"/></repeat></Row>
      <Row><repeat num="8"><Part code="KTU"/></repeat></Row>
      <Loop inner="yes" start="0 4"><Row>TFU 2TFU 2TFU 2</Row></Loop>
    </Storey>
    <Roofs kind="K" shape="KIR"/>
  </House>
</Houses>
`;

let preview: Preview, page: Page;
const { text, tool, status, click, drag, becomes, restore } = drawing('rooms.hsd', () => ({ preview, page }));

before(async () => {
  preview = await Preview.of([['rooms.hsd', HOUSE]]);
  preview.script = AXE;
  page = await preview.open('?file=rooms.hsd');
  await does(page, 'plan').click();
  await does(page, 'draw').click();
  await page.locator('.toolbar [data-do=model]').click();
});
after(async () => { await preview?.close(); });
beforeEach(async () => {
  await restore(HOUSE);
  await until(() => page.evaluate(text => hsd.plan.drawn.walls.size > 0 && hsd.plan.state?.sources[0]?.text === text, HOUSE), 'the plan is drawn');
  await page.evaluate(() => { hsd.plan.fit(); hsd.plan.sheet.zoom(1.3); });
  await tool('part');
});

const rooms = () => page.evaluate(() => hsd.plan.state!.plan.houses[0]!.storeys[0]!.rooms.map(({ name, at, floor, laid }) => ({ name, at, floor, mats: laid.length })));

test('a click makes a room of an area; its name and floor are typed and chosen; undo takes it back', async () => {
  await tool('room');
  await page.locator('[data-room=floor]').selectOption('tatami');
  await click(3, 6);
  await becomes(t => t.includes('at="3 6" floor="tatami"/>'), 'a room is made');
  assert.equal((await rooms())[0]!.mats, 12);
  await page.waitForTimeout(60);
  await page.keyboard.type('座敷');
  await page.keyboard.press('Enter');
  await becomes(t => t.includes('<Room at="3 6" floor="tatami" name="座敷"/>'), 'it has a name');
  assert.equal(await page.locator('.room-name').textContent(), '座敷');
  await page.locator('[data-room=ceiling]').selectOption('none');
  await becomes(t => t.includes('ceiling="none"'), 'it has another ceiling');
  await page.locator('[data-room=floor]').selectOption('boards');
  await becomes(t => t.includes('floor="boards"'), 'it has boards');
  for (let i = 0; i < 4; i++) {
    const before = text();
    await does(page, 'undo').click();
    await becomes(t => t !== before, 'undone');
  }
  assert.equal(text(), HOUSE);
});

test('a room is moved by its point, refused where another one is, and removed', async () => {
  await tool('room');
  await click(3, 6);
  await becomes(t => t.includes('<Room'), 'a room is made');
  await drag([3, 6], [1, 5]);
  await becomes(t => t.includes('at="1 5"'), 'it is moved');
  await drag([1, 5], [1, 12]);
  await until(async () => /^Not applied: this is outside/.test(await status() ?? ''), 'it is not moved out of the house');
  assert.match(text(), /at="1 5"/);
  await does(page, 'remove-room').click();
  await becomes(t => !t.includes('<Room'), 'it is removed');
});

test('rooms by keyboard, told to screen readers', async () => {
  await tool('room');
  await page.locator('svg.sheet').focus();
  await page.keyboard.press('ArrowDown');
  assert.match(await status() ?? '', /^left [\d.]+, back [\d.]+$/);
  await page.keyboard.press('ArrowDown');
  await page.keyboard.press('Enter');
  await becomes(t => t.includes('<Room'), 'a room is made');
  const [made] = await rooms();
  const room = page.locator('.room[tabindex="0"]');
  assert.match(await room.getAttribute('aria-label') ?? '', /^Room without a name, /);
  await room.focus();
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('Enter');
  await becomes(t => !t.includes(`at="${made!.at.join(' ')}"`), 'it is moved');
  assert.equal((await rooms())[0]!.at[0], made!.at[0] + 1, 'to the left');
  const serious = await page.evaluate(async () => {
    const { axe } = window as unknown as { axe: { run: (at: Element) => Promise<{ violations: { id: string; impact: string }[] }> } };
    const { violations } = await axe.run(document.querySelector('.pane.plan')!);
    return violations.filter(v => v.impact === 'serious' || v.impact === 'critical').map(v => v.id);
  });
  assert.deepEqual(serious, []);
  await page.locator('.room').focus();
  await page.keyboard.press('Delete');
  await becomes(t => t === HOUSE, 'it is removed');
});

test('a wall inside is drawn with the chosen part, and removed', async () => {
  await tool('inner');
  await until(async () => await page.locator('.palette button').count() > 50, 'the palette is loaded');
  await page.locator('.palette button[data-code="TSH 2"]').click();
  await drag([2, 0], [2, 4]);
  await becomes(t => /<Loop inner="yes" start="2 0">\s*<Row turn="R"\/>\s*<Row>TSH 2TSH 2<\/Row>/.test(t), 'a wall of screens');
  await click(3, 4);
  assert.match(await status() ?? '', /^Inner wall chosen/);
  await does(page, 'remove-inner').click();
  await becomes(t => !t.includes('TFU 2'), 'the other wall is removed');
  await page.locator('.run[aria-label^="Inner wall"]').first().focus();
  await page.keyboard.press('Delete');
  await becomes(t => !t.includes('inner'), 'and this one by keyboard');
});

test('a wall inside by keyboard', async () => {
  await tool('inner');
  await page.locator('svg.sheet').focus();
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('Shift+ArrowUp');
  await page.keyboard.press('Shift+ArrowUp');
  assert.equal(await page.locator('.ghost-label').textContent(), '2 units');
  await page.keyboard.press('Enter');
  await becomes(t => t !== HOUSE, 'a wall of two units');
});

test('no requests to other hosts, no errors', () => preview.assertClean());
