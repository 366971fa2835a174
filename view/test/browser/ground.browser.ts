// Groups, placed houses and surveyed outlines: moved, turned and drawn on the plan, written in the source file.

import assert from 'node:assert/strict';
import { after, before, beforeEach, test } from 'node:test';
import type { Page } from 'playwright-core';
import { drawing } from './drawing.ts';
import { does, Preview, until } from './preview.ts';

const TOWN = `<Houses>
  <Group x="2" turn="90">
    <Place type="kura" x="6" y="3"/>
  </Group>
  <House name="shop" y="12">
    <Outline points="0 0, 6.2 -0.4, 6.8 8, 0.6 8.4"/>
    <Storey height="9"/>
  </House>
</Houses>
`;

let preview: Preview, page: Page;
const { text, tool, status, at, drag, becomes, restore } = drawing('town.hsd', () => ({ preview, page }), true);

before(async () => {
  preview = await Preview.of([['town.hsd', TOWN], ['plain.hsd', '0 0 180\n9\n\nKSK  KSK  KSK\nKSK\nKSK  KSK  KSK\nKSK\n']]);
  page = await preview.open('?file=town.hsd');
  await does(page, 'plan').click();
  await does(page, 'draw').click();
  await page.locator('.toolbar [data-do=model]').click();
});
after(async () => { await preview?.close(); });
beforeEach(async () => {
  await restore(TOWN);
  await until(() => page.evaluate(text => hsd.plan.state?.sources[0]?.text === text && hsd.plan.drawn.walls.size > 0, TOWN), 'the plan is drawn');
  await does(page, 'fit').click();
});


/** Middle of a wall of a house, metres east and north. */
const wall = (house: number, n = 0) => page.evaluate(([house, n]) => {
  const h = hsd.plan.state!.plan.houses[house!]!, w = h.storeys[0]!.rings[0]!.walls[n!]!;
  const [a, b] = [0, 1].map(k => (w.from[k]! + w.to[k]!) / 2) as [number, number], turn = (h.azimuth - 180) * Math.PI / 180;
  const e = -a * h.unit_m, no = b * h.unit_m;
  return [h.origin[0] + e * Math.cos(turn) + no * Math.sin(turn), h.origin[1] - e * Math.sin(turn) + no * Math.cos(turn)] as [number, number];
}, [house, n]);

test('a house in a turned group is dragged in the frame of the group', async () => {
  await tool('place');
  const [e, n] = await wall(0);
  await drag([e, n], [e, n - 1.5]); // To the south, which is the group's east.
  await becomes('<Place type="kura" x="7.5" y="3"/>');
  await does(page, 'undo').click();
  await becomes('x="6" y="3"');
});

test('the whole group is dragged, and a surveyed house', async () => {
  await tool('place');
  await page.getByLabel('The whole group').check();
  const [e, n] = await wall(0);
  await drag([e, n], [e + 1, n]);
  await becomes('<Group x="3" turn="90">');
  await page.getByLabel('The whole group').uncheck();
  const [e2, n2] = await wall(1);
  await drag([e2, n2], [e2, n2 + 2]);
  await becomes('<House name="shop" y="14">');
});

test('a house is moved and turned by keyboard; an outline is not turned, with the reason', async () => {
  await tool('place');
  await page.locator('.run[tabindex="0"]').first().focus();
  await page.keyboard.press('ArrowUp');
  assert.match(await page.locator('.ghost-label').textContent() ?? '', /x 5\.9 m, y 3 m/);
  await page.keyboard.press('Escape');
  assert.equal(await page.locator('.ghost').count(), 0);
  await page.keyboard.press('Shift+ArrowDown');
  await page.keyboard.press('Enter');
  await becomes('x="7" y="3"');
  await tool('turn');
  await page.locator('.run[tabindex="0"]').first().focus();
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('Enter');
  await becomes('azimuth="185"');
  const before = text();
  await page.locator('.run[tabindex="0"]').nth(1).focus();
  await page.keyboard.press('ArrowRight');
  assert.match(await status() ?? '', /Not applied: .*outline/);
  assert.equal(text(), before);
});

test('a house is turned by dragging it around its place', async () => {
  await tool('turn');
  const pivot: [number, number] = [5, -6], [e, n] = await wall(0); // The place in the world: x 3, y 6 of the turned group.
  const angle = -Math.PI / 6, [dx, dy] = [e - pivot[0], n - pivot[1]];
  await drag([e, n], [pivot[0] + dx * Math.cos(angle) - dy * Math.sin(angle), pivot[1] + dx * Math.sin(angle) + dy * Math.cos(angle)]);
  await becomes('azimuth="210"');
});

test('a corner of an outline is dragged and moved by keyboard; the text follows', async () => {
  await tool('survey');
  await drag([6.8, 20], [7.3, 20.5]);
  await becomes('points="0 0, 6.2 -0.4, 7.3 8.5, 0.6 8.4"');
  await page.locator('.corner').first().focus();
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('Enter');
  await becomes('points="-0.1 0, 6.2 -0.4');
  assert.equal(await page.evaluate(() => document.activeElement?.getAttribute('aria-label')), 'Corner 1 of outline 1', 'the focus stays');
});

test('an outline is drawn corner by corner in metres, by pointer and by keyboard', async () => {
  await tool('survey');
  for (let i = 0; i < 3; i++) await does(page, 'farther').click();
  const ring: [number, number][] = [[-12, 0], [-6, 0], [-6, 7], [-12, 6.5]];
  for (const corner of [...ring, ring[0]!]) {
    const { x, y } = await at(...corner);
    await page.mouse.move(x, y, { steps: 2 });
    await page.mouse.down();
    await page.mouse.up();
  }
  await until(() => /<Outline points="-1[12]\S* [^"]*, [^"]*, [^"]*, [^"]*"\/>/.test(text()), 'a second outline');
  await until(() => page.evaluate(() => hsd.plan.state!.plan.houses.length === 3), 'the house is shown');
  const one = text();
  await page.locator('svg.sheet').focus();
  for (const key of [' ', ...Array(5).fill('Shift+ArrowRight'), ' ', ...Array(6).fill('Shift+ArrowUp'), ' ', 'Enter']) await page.keyboard.press(key);
  await until(() => text() !== one, 'a third outline');
  assert.equal(text().match(/<Outline/g)!.length, 3);
});

test('Escape gives up an outline, and a form without outlines says how to get them', async () => {
  await tool('survey');
  const { x, y } = await at(-3, 1);
  await page.mouse.click(x, y);
  assert.equal(await page.locator('.ghost').count(), 1);
  await page.locator('svg.sheet').focus();
  await page.keyboard.press('Escape');
  assert.equal(await page.locator('.ghost').count(), 0);
  assert.equal(text(), TOWN);
  await page.locator('.files button').filter({ hasText: 'plain' }).click();
  await until(() => page.evaluate(() => hsd.plan.state?.file === 'plain.hsd'), 'the other file is open');
  await page.locator('svg.sheet').focus();
  for (const key of [' ', ...Array(3).fill('Shift+ArrowRight'), ' ', ...Array(3).fill('Shift+ArrowUp'), ' ', 'Enter']) await page.keyboard.press(key);
  await until(async () => (await status() ?? '').includes('convert the text to XML'), 'it is refused');
  await page.locator('.files button').filter({ hasText: 'town' }).click();
});

test('a house of the legacy form is dragged and turned by its first line', async () => {
  await page.locator('.files button').filter({ hasText: 'plain' }).click();
  const shown = (first: string) => until(() => page.evaluate(first => hsd.plan.state?.file === 'plain.hsd' && hsd.plan.state.sources[0]!.text.startsWith(first), first), `the text begins with ${first}`);
  await shown('0 0 180\n');
  await does(page, 'fit').click();
  await page.evaluate(() => hsd.plan.sheet.zoom(1.5)); // Room for the drag.
  await tool('place');
  const [e, n] = await wall(0);
  await drag([e, n], [e + 2, n - 1]);
  await shown('2 -1 180\n9\n');
  await tool('turn');
  await page.locator('.run[tabindex="0"]').first().focus();
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('Enter');
  await shown('2 -1 185\n9\n');
  await page.locator('.files button').filter({ hasText: 'town' }).click();
});

test('no requests to other hosts, no errors', () => preview.assertClean());
