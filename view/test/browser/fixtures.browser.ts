// Fixtures in the drawing tool: placed, moved, turned, drawn larger and removed, by pointer and by keyboard.

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
      <Room name="奥" at="3 6" floor="tatami"/>
    </Storey>
    <Storey height="7">
      <Row>KTU  KTU  MMU 2KTU  KTU  </Row>
      <Row><repeat num="8"><Part code="KTU"/></repeat></Row>
      <Row><repeat num="6"><Part code="KTU"/></repeat></Row>
      <Row><repeat num="8"><Part code="KTU"/></repeat></Row>
    </Storey>
    <Roofs kind="K" shape="KIR"/>
  </House>
</Houses>
`;

let preview: Preview, page: Page;
const { text, status, click, drag, becomes, restore } = drawing('fixtures.hsd', () => ({ preview, page }));

before(async () => {
  preview = await Preview.of([['fixtures.hsd', HOUSE]]);
  preview.script = AXE;
  page = await preview.open('?file=fixtures.hsd', { viewport: { width: 1100, height: 900 } });
  await does(page, 'plan').click();
  await does(page, 'draw').click();
  await page.locator('.toolbar [data-do=model]').click();
});
after(async () => { await preview?.close(); });
beforeEach(async () => {
  await restore(HOUSE);
  // A drag out of the sheet has moved it along, the farther the longer it took.
  await does(page, 'fit').click();
  await page.locator('.tools input[value=part]').check();
  await page.locator('.tools input[value=fixture]').check();
});

const fixtures = () => page.evaluate(() => hsd.plan.state!.plan.houses[0]!.storeys[0]!.fixtures.map(({ kind, at, size, faces, built }) => ({ kind, at, size, faces, built })));
const panel = (name: string) => page.locator(`[data-fixture=${name}]`);

/** The next fixture is of this kind. */
async function next(kind: string, faces = 'F') {
  await panel('kind').selectOption(kind);
  await panel('faces').selectOption(faces);
}

test('a click places a fixture of the chosen kind, which the plan shows with its name and front; undo takes it back', async () => {
  await next('tokonoma');
  await click(2, 7.5);
  await becomes(t => t.includes('<Fixture kind="tokonoma" at="1 7"/>'), 'an alcove stands at the back');
  assert.equal(await page.locator('.fixture .fixture-name').textContent(), 'tokonoma');
  const [front, area] = await page.evaluate(() => ['.fixture-front', '.fixture-area'].map(name => document.querySelector(name)!.getBoundingClientRect().bottom));
  assert.ok(Math.abs(front! - area!) < 1, `the front at ${front} is towards the street, as ${area}`);
  const before = text();
  await does(page, 'undo').click();
  await becomes(t => t !== before, 'undone');
  assert.equal(text(), HOUSE);
});

test('the panel knows the usual size of every kind', async () => {
  const kinds = await panel('kind').locator('option').evaluateAll(all => all.map(o => (o as HTMLOptionElement).value));
  assert.equal(kinds.length, 9);
  for (const kind of kinds) {
    await restore(HOUSE);
    await next(kind, 'L');
    await click(2, 2);
    await becomes(t => t.includes(`<Fixture kind="${kind}"`), `${kind} is placed`);
    assert.match(text(), new RegExp(`<Fixture kind="${kind}" at="[\\d. ]+" faces="L"/>`), 'its size need not be written');
    assert.equal((await fixtures())[0]!.built, true, kind);
    await page.locator('.tools input[value=part]').check();
    await page.locator('.tools input[value=fixture]').check();
  }
});

test('a fixture is moved and drawn larger by drags, turned and changed in the panel, and removed', async () => {
  await next('oshi-ire');
  await click(2, 7.5);
  await becomes(t => t.includes('at="1 7"'), 'a closet stands');
  await drag([1.5, 7.5], [3.5, 7.5]);
  await becomes(t => t.includes('at="3 7"'), 'it is moved');
  await drag([5, 8], [6, 8]);
  await becomes(t => t.includes('size="3 1"'), 'it is wider');
  await panel('width').fill('2');
  await panel('width').press('Enter');
  await becomes(t => t.includes('<Fixture kind="oshi-ire" at="3 7"/>'), 'its width is the usual one again');
  await does(page, 'turn-fixture').click();
  await becomes(t => t.includes('faces="L"'), 'it looks to the left');
  assert.deepEqual((await fixtures())[0], { kind: 'oshi-ire', at: [3, 6], size: [1, 2], faces: 'L', built: true }, 'where it fits');
  await panel('kind').selectOption('chigaidana');
  await becomes(t => t.includes('kind="chigaidana"'), 'it is another kind');
  await does(page, 'remove-fixture').click();
  await becomes(t => t === HOUSE, 'it is removed');
});

test('what does not fit is refused in words', async () => {
  await next('tokonoma');
  // The two answers differ, so that neither is taken for the other.
  for (const [a, b, why] of [[2, 4, /a wall would run through/], [5.9, 6, /this is outside of the walls/]] as const) {
    await click(a, b);
    await until(async () => why.test(await status() ?? ''), `${why}`);
  }
  assert.equal(text(), HOUSE);
  await click(2, 7.5);
  await becomes(t => t.includes('<Fixture'), 'an alcove stands');
  await drag([2, 7.5], [2, 11]);
  await until(async () => /^Not applied: this is outside/.test(await status() ?? ''), 'it is not moved out');
  await page.keyboard.press('Escape');
  await page.locator('.tools input[value=part]').check();
  await page.locator('.tools input[value=fixture]').check();
  await preview.save(page, 'fixtures.hsd', HOUSE.replace('</Storey>', '<Fixture kind="well" at="8 1"/></Storey>'));
  await until(async () => await page.locator('.fixture.left-out').count() === 1, 'what the text says and does not fit is drawn as left out');
  assert.match(await page.locator('.fixture').getAttribute('aria-label') ?? '', /is left out/);
});

test('stairs lead into the storey above, and have treads and the way up', async () => {
  await next('stairs');
  await click(0.5, 1.5);
  await becomes(t => t.includes('<Fixture kind="stairs" at="0 0"/>'), 'stairs stand');
  assert.equal(await page.locator('.fixture .tread').count(), 11);
  assert.equal(await page.locator('.fixture .way-up').count(), 2);
  await page.locator('.field:has(label:text-is("Storey")) select').first().selectOption('2');
  await click(3, 3);
  await until(async () => /^Not applied: no storey stands above/.test(await status() ?? ''), 'none in the highest storey');
  await page.locator('.field:has(label:text-is("Storey")) select').first().selectOption('1');
});

test('fixtures by keyboard, told to screen readers', async () => {
  await next('well');
  await page.locator('svg.sheet').focus();
  await page.keyboard.press('ArrowDown');
  assert.match(await status() ?? '', /^left [\d.]+, back [\d.]+, 1 × 1 units$/);
  await page.keyboard.press('ArrowDown');
  await page.keyboard.press('ArrowDown');
  await page.keyboard.press('Enter');
  await becomes(t => t.includes('<Fixture kind="well"'), 'a well stands');
  const [made] = await fixtures(), well = page.locator('.fixture[tabindex="0"]');
  assert.match(await well.getAttribute('aria-label') ?? '', /^well, 1 × 1 units, faces front, left [\d.]+, back [\d.]+$/);
  await well.focus();
  await page.keyboard.press('Shift+ArrowLeft');
  await page.keyboard.press('Enter');
  await becomes(t => !t.includes(`at="${made!.at.join(' ')}"`), 'it is moved');
  assert.equal((await fixtures())[0]!.at[0], made!.at[0] + 0.25, 'to the left');
  assert.equal(await page.evaluate(() => document.activeElement?.classList.contains('fixture')), true, 'and keeps the focus');
  await page.keyboard.press('r');
  await becomes(t => t.includes('faces="L"'), 'it is turned');
  const serious = await page.evaluate(async () => {
    const { axe } = window as unknown as { axe: { run: (at: Element) => Promise<{ violations: { id: string; impact: string }[] }> } };
    const { violations } = await axe.run(document.querySelector('.pane.plan')!);
    return violations.filter(v => v.impact === 'serious' || v.impact === 'critical').map(v => v.id);
  });
  assert.deepEqual(serious, []);
  await page.locator('.fixture').focus();
  await page.keyboard.press('Delete');
  await becomes(t => t === HOUSE, 'it is removed');
});

test('the height of a room is set in its panel, and taken out again', async () => {
  await page.locator('.tools input[value=room]').check();
  await click(4, 5);
  const height = page.locator('[data-room=height]');
  assert.equal(await height.getAttribute('placeholder'), '9');
  await height.fill('7.5');
  await height.press('Enter');
  await becomes(t => t.includes('height="7.5"/>'), 'the ceiling is lower');
  await height.fill('0.2');
  await height.press('Enter');
  await until(async () => /^Not applied: a ceiling is between/.test(await status() ?? ''), 'no ceiling so low');
  await height.fill('');
  await height.press('Enter');
  await becomes(t => t === HOUSE, 'it is that of the storey again');
});

test('fixtures have their names in Japanese', async () => {
  await preview.save(page, 'fixtures.hsd', HOUSE.replace('</Storey>', '<Fixture kind="tokonoma" at="1 7"/></Storey>'));
  const japanese = await preview.open('?file=fixtures.hsd&lang=ja');
  await does(japanese, 'plan').click();
  assert.equal(await japanese.locator('.fixture-name').textContent(), '床の間');
  await does(japanese, 'draw').click();
  await japanese.locator('.tools input[value=fixture]').check();
  assert.match(await japanese.locator('.fixture').getAttribute('aria-label') ?? '', /^床の間、2 × 1 U、正面は前/);
});

test('no requests to other hosts, no errors', () => preview.assertClean());
