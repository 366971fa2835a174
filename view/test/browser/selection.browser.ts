// Selection across model, source, tree, plan and editor, by pointer and keyboard.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import type { Page } from 'playwright-core';
import { does, Preview, unfold, until } from './preview.ts';

let preview: Preview, page: Page;

before(async () => {
  preview = await Preview.of(['machiya.hsd', 't-house.hsd', 'court-house.hsd', 'setback.hsd']);
  page = await preview.open('?file=machiya.hsd');
  await does(page, 'text').click();
  assert.equal(await page.locator('.pane.text select').textContent(), 'machiya.hsd', 'no path of the machine');
});
after(async () => { await preview?.close(); });

const selection = () => page.evaluate(() => hsd.selection);
const lineOf = (word: string) => preview.read('machiya.hsd').split('\n').findIndex(line => line.includes(word) && !line.startsWith('#')) + 1;

test('a click on a part shows its details and source, and opens it in the editor', async () => {
  await page.evaluate(async () => { await hsd.settled(); hsd.app.look('eaves'); await hsd.settled(); });
  const found = await page.evaluate(() => {
    const { clientWidth: w, clientHeight: h } = hsd.viewport.canvas;
    for (let y = 0.3; y < 0.9; y += 0.02) for (let x = 0.2; x < 0.9; x += 0.02) {
      const part = hsd.pick(x * w, y * h);
      if (part !== null && hsd.app.model!.parts[part]!.code?.trim() === 'MMU 2') return { x: x * w, y: y * h };
    }
    return null;
  });
  assert.ok(found, 'a slit window is visible');
  await page.locator('canvas.viewport').click({ position: found! });
  assert.equal((await selection())?.code, 'MMU 2');
  const card = page.locator('.card');
  assert.equal(await card.locator('h2').textContent(), 'MMU 2');
  const details = await card.textContent() ?? '', line = lineOf('MMU 2MMU 2');
  assert.match(details, /Storey 2/);
  assert.match(details, /Wall 1/);
  assert.ok(details.includes(`Line${line}`), details);
  assert.equal(await card.locator('pre').textContent(), preview.read('machiya.hsd').split('\n')[line - 1]);
  assert.equal(await page.locator('.source-line .selected').textContent(), 'MMU 2');
  assert.equal(await page.locator('.source-line:has(.selected)').getAttribute('data-line'), `${line}`);
  assert.ok(await page.evaluate(() => hsd.app.renderer.selected.drawn) > 0, 'it is highlighted in the model');
  assert.match(await page.locator('.live').textContent() ?? '', /Selected: Part, MMU 2, Storey 2/);
  await does(page, 'open').click();
  const text = preview.read('machiya.hsd'), begun = text.split('\n').slice(0, line - 1).join('\n').length + 1;
  const column = (await selection())!.span![0] - begun + 1;
  assert.deepEqual(await preview.sent(), ['machiya.hsd', line, column]);
  await page.locator('canvas.viewport').dblclick({ position: found! });
  assert.equal((await preview.sent())[1], line);
  await does(page, 'near').click();
  const far = await page.evaluate(() => Math.hypot(...[0, 1, 2].map(k => hsd.camera[k]! - hsd.camera[k + 3]!)));
  assert.ok(far < 8, `${far} m from the part`);
  await card.getByRole('button', { name: 'Close' }).click();
  assert.equal(await selection(), null);
  assert.ok(await card.isHidden());
});

test('a click on a code in the source selects its part; arrow keys move between codes', async () => {
  await page.locator('.source-line .code', { hasText: 'GDE 2' }).click();
  assert.equal((await selection())?.code, 'GDE 2');
  const lines = page.locator('.lines');
  await lines.focus();
  await page.keyboard.press('ArrowRight');
  assert.equal((await selection())?.code, 'TOD');
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('ArrowLeft');
  assert.equal((await selection())?.code, 'GSI');
  await page.keyboard.press('Enter');
  assert.equal((await preview.sent())[1], lineOf('GDE 2'));
});

test('every part is reachable in the tree by keyboard', async () => {
  await page.evaluate(() => hsd.select(null));
  const tree = await unfold(page, 'parts');
  await tree.locator('[role=treeitem][tabindex="0"]').focus();
  await page.keyboard.press('Home');
  const focus = () => page.evaluate(() => document.activeElement?.querySelector('.label')?.textContent);
  // A closed branch is expanded first.
  const into = async () => {
    const was = await focus();
    for (let i = 0; i < 2 && await focus() === was; i++) await page.keyboard.press('ArrowRight');
  };
  await into();
  assert.match(await focus() ?? '', /^Storey/);
  await into();
  assert.match(await focus() ?? '', /^Wall/);
  await into();
  assert.equal(await focus(), 'GSI');
  assert.deepEqual(await page.evaluate(() => hsd.lit), ['GSI'], 'the focused part is highlighted');
  await page.keyboard.press('ArrowDown');
  await page.keyboard.press('ArrowDown');
  await page.keyboard.press('Enter');
  assert.equal((await selection())?.code, 'GDE 2');
  assert.equal(await page.locator('[role=treeitem][aria-selected=true] > .label').textContent(), 'GDE 2');
  await page.keyboard.press('ArrowLeft');
  assert.match(await focus() ?? '', /^Wall/);
  await page.keyboard.press('ArrowLeft');
  assert.equal(await page.evaluate(() => document.activeElement?.getAttribute('aria-expanded')), 'false');
  await page.keyboard.press('End');
  assert.match(await focus() ?? '', /^Roof/);
  await page.keyboard.press(' ');
  assert.equal((await selection())?.kind, 'roof');
});

test('the canvas by keyboard: rotate, pan, zoom, select, deselect', async () => {
  await page.evaluate(() => { hsd.select(null); hsd.app.look('front'); });
  await page.locator('canvas.viewport').focus();
  const camera = () => page.evaluate(() => [...hsd.camera]);
  const press = async (key: string) => {
    const was = await camera();
    await page.keyboard.press(key);
    const now = await camera();
    return { eye: Math.hypot(...[0, 1, 2].map(k => now[k]! - was[k]!)), target: Math.hypot(...[3, 4, 5].map(k => now[k]! - was[k]!)),
      nearer: Math.hypot(...[0, 1, 2].map(k => was[k]! - was[k + 3]!)) - Math.hypot(...[0, 1, 2].map(k => now[k]! - now[k + 3]!)) };
  };
  const turned = await press('ArrowLeft');
  assert.ok(turned.eye > 0.5 && turned.target < 1e-9 && Math.abs(turned.nearer) < 1e-6);
  assert.ok((await press('ArrowUp')).eye > 0.5);
  const moved = await press('Shift+ArrowRight');
  assert.ok(moved.target > 0.1 && Math.abs(moved.target - moved.eye) < 1e-9);
  assert.ok((await press('+')).nearer > 0.5);
  assert.ok((await press('-')).nearer < -0.5);
  await press('Home');
  await page.keyboard.press('Enter');
  const middle = await page.evaluate(() => hsd.pick(hsd.viewport.canvas.clientWidth / 2, hsd.viewport.canvas.clientHeight / 2));
  assert.notEqual(middle, null);
  assert.equal((await selection())?.number, middle);
  assert.ok(await page.locator('.cross').isVisible(), 'the cross is shown while keys aim');
  await page.keyboard.press('Escape');
  assert.equal(await selection(), null);
});

test('the plan: units, regions, ridges, courts; storeys; zoom and pan; a click selects', async () => {
  await does(page, 'plan').click();
  const plan = page.locator('.pane.plan'), sheet = plan.locator('svg.sheet');
  const count = (of: string) => sheet.locator(of).count();
  const units = await page.evaluate(() => hsd.app.state!.plan.houses[0]!.storeys.map(s => s.rings.flatMap(r => r.walls.flatMap(w => w.units)).length));
  assert.equal(await count('.unit'), units[0]);
  assert.equal(await count('.unit.wall[data-code=APW]'), 16, 'party walls are walls');
  assert.deepEqual(await sheet.locator('.length').allTextContents(), ['18 shaku', '24 shaku', '18 shaku', '24 shaku'], 'lengths with their unit');
  await plan.getByLabel('Storey').selectOption('2');
  assert.equal(await count('.unit'), units[1]);
  assert.equal(await count('.unit[data-code="MMU 2"]'), 4);
  await sheet.locator('.unit[data-code="MMU 2"] .hit').nth(3).dispatchEvent('click');
  const chosen = await selection();
  assert.deepEqual([chosen?.code, chosen?.storey], ['MMU 2', 2]);
  // The fourth in the plan is the fourth in the model.
  assert.equal(chosen?.number, await page.evaluate(() => hsd.find('MMU 2').filter(i => hsd.app.model!.parts[i]!.storey === 2)[3]));
  assert.equal(await count('.unit.selected'), 1);
  await plan.getByLabel('Storey').selectOption('1');
  const box = () => sheet.getAttribute('viewBox').then(v => v!.split(' ').map(Number) as [number, number, number, number]);
  await does(page, 'fit').click();
  const fitted = await box();
  await plan.locator('[data-do=nearer]').click();
  assert.ok((await box())[2] < fitted[2] * 0.9);
  await plan.locator('[data-do=farther]').click();
  assert.ok(Math.abs((await box())[2] - fitted[2]) < 1e-6);
  await sheet.hover();
  await page.mouse.wheel(0, -300);
  await until(async () => (await box())[2] < fitted[2] * 0.8, 'the wheel zooms');
  await does(page, 'fit').click();
  const place = (await sheet.boundingBox())!;
  await page.mouse.move(place.x + 40, place.y + 40);
  await page.mouse.down();
  await page.mouse.move(place.x + 100, place.y + 60, { steps: 3 });
  await page.mouse.up();
  assert.ok((await box())[0] < fitted[0] - 0.2, 'a drag moves the sheet');
  await does(page, 'fit').click();
  await sheet.focus();
  await page.keyboard.press('ArrowRight');
  assert.ok((await box())[0] > fitted[0]);
  await page.keyboard.press('+');
  assert.ok((await box())[2] < fitted[2]);
  await plan.locator('.legend summary').click();
  assert.match(await plan.locator('.legend').textContent() ?? '', /Wall.*Lattice.*Ridge, hip.*Slope of a lean-to.*Courtyard/);
  assert.match(await plan.locator('.scale').textContent() ?? '', /^[\d.]+ m$/);
});

test('the plan of automatic roofs has their regions, ridges and courts', async () => {
  const count = (of: string) => page.locator('svg.sheet').locator(of).count();
  const show = async (file: string) => {
    await page.evaluate(file => hsd.app.openFile(file), file);
    await until(() => page.evaluate(file => hsd.plan.drawn.units.size > 0 && hsd.app.state?.file === file, file), file);
    await page.waitForTimeout(50);
  };
  await show('t-house.hsd');
  assert.equal(await count('.region'), 2);
  assert.equal(await count('.ridge'), 2);
  // The stem's ridge ends on that of the bar.
  const ends = await page.locator('svg.sheet .ridge').evaluateAll(lines => lines.map(l => ['x1', 'y1', 'x2', 'y2'].map(n => Number(l.getAttribute(n)))));
  const [bar, stem] = [...ends].sort((p, q) => Math.abs(q[0]! - q[2]!) - Math.abs(p[0]! - p[2]!)) as [number[], number[]];
  assert.ok([stem[1], stem[3]].some(y => Math.abs(y! - bar[1]!) < 1e-6), 'ridges meet');
  await show('court-house.hsd');
  assert.equal(await count('.court'), 1);
  assert.ok(await count('.region') >= 4);
  // A lean-to in front of a storey that is set back: an arrow down its slope, away from the wall above.
  await show('setback.hsd');
  const falls = await page.evaluate(() => hsd.app.state!.plan.houses[0]!.storeys[0]!.regions.filter(r => r.fall)), fall = falls[0];
  assert.equal(await count('.fall'), 3 * falls.length, 'a shaft and two barbs each');
  const [x1, y1, x2, y2] = await page.locator('svg.sheet .fall').first().evaluate(l => ['x1', 'y1', 'x2', 'y2'].map(n => Number(l.getAttribute(n)))) as [number, number, number, number];
  assert.ok({ F: y2 > y1, B: y2 < y1, L: x2 < x1, R: x2 > x1 }[fall!.fall!], `${fall!.fall}: ${x1} ${y1} to ${x2} ${y2}`);
});

test('the editor\'s cursor highlights its part', async () => {
  const other = await preview.open('', {}, false);
  const text = preview.read('machiya.hsd'), at = text.indexOf('GDE 2') + 1;
  let sent = false;
  await other.route('**/api/events**', route => {
    // The previous page may still send requests.
    if (sent || !route.request().frame().url().includes('?file=')) return route.continue();
    sent = true;
    return route.fulfill({ contentType: 'text/event-stream', body: `event: cursor\ndata: {"id":0,"span":[${at},${at}]}\n\n` });
  });
  await other.goto(`${preview.url}?file=machiya.hsd`);
  await until(() => other.evaluate(() => globalThis.hsd?.lit.join() === 'GDE 2'), 'the part at the cursor is highlighted');
  assert.ok(await other.evaluate(() => hsd.app.renderer.pointed.drawn) > 0);
  await does(other, 'text').click();
  assert.equal(await other.locator('.source-line .pointed').textContent(), 'GDE 2');
  await does(other, 'plan').click();
  assert.equal(await other.locator('.unit.pointed').getAttribute('data-code'), 'GDE 2');
  await other.context().close();
});

test('no requests to other hosts, no errors', () => preview.assertClean());
