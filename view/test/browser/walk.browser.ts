// Walking and measuring in towns, by keys, buttons, mouse and touch.

import assert from 'node:assert/strict';
import { cpSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import type { Page } from 'playwright-core';
import { does, EXAMPLES, Preview, unfold, until } from './preview.ts';

const TOWN = 'town/block.hsd', PHONE = { width: 390, height: 740 };
const AXE = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const EYES = 1.5;

let preview: Preview, page: Page;

/** Waits until the tiles for the camera are there. */
async function atRest(page: Page) {
  await page.evaluate(() => hsd.settled());
  await until(() => page.evaluate(() => hsd.app.town.state?.whole === true && !hsd.app.town.busy), 'all tiles are loaded', 120_000);
}
const camera = (page: Page) => page.evaluate(() => hsd.camera);
const walks = (page: Page) => page.evaluate(() => hsd.app.walk.on);
const place = (page: Page) => page.evaluate(() => hsd.app.walk.place);
const live = (page: Page) => page.locator('.live').innerText();

/** Presses a key until something holds. */
async function hold(page: Page, key: string, holds: () => Promise<boolean>, what: string) {
  await page.keyboard.down(key);
  await until(holds, what, 60_000).finally(() => page.keyboard.up(key));
}

/** Whether a roof is above the eyes. */
const roofed = (page: Page) => page.evaluate(() => hsd.surface(hsd.camera.slice(0, 3), [0, 1, 0]) !== null);

before(async () => {
  preview = await Preview.of([]);
  cpSync(join(EXAMPLES, 'towns'), join(preview.folder, 'town'), { recursive: true });
  preview.script = AXE;
  page = await preview.open(`?file=${TOWN}`);
  await atRest(page);
});
after(async () => { await preview?.close(); });

test('a walk begins on the ground outside, at the height of eyes, and is told', async () => {
  await does(page, 'walk').click();
  assert.equal(await walks(page), true);
  assert.equal(await does(page, 'walk').getAttribute('aria-pressed'), 'true');
  const [x, y, z] = await camera(page), [east, ground, south] = await place(page);
  assert.ok(Math.abs(y! - ground! - EYES) < 0.01, `eyes at ${y} over ${ground}`);
  assert.deepEqual([x, z], [east, south]);
  assert.ok(Math.abs(ground!) < 0.3, `the ground at ${ground}`);
  assert.equal(await roofed(page), false, 'no roof above');
  assert.match(await live(page), /You are walking/);
  assert.match((await page.locator('canvas.viewport').getAttribute('aria-label'))!, /while walking/);
  assert.equal(await page.evaluate(() => document.activeElement === hsd.viewport.canvas), true, 'keys go to the picture');
});

test('W and the arrow keys go and turn, at the height of eyes', async () => {
  const before = await place(page), [, , , tx, , tz] = await camera(page), way = [tx! - before[0], tz! - before[2]];
  const gone = async () => { const [x, , z] = await place(page); return ((x - before[0]) * way[0]! + (z - before[2]) * way[1]!) / Math.hypot(...way as [number, number]); };
  await hold(page, 'KeyW', async () => await gone() > 2, 'it goes ahead');
  const ahead = await gone();
  await hold(page, 'ArrowDown', async () => await gone() < ahead - 1, 'it goes back');
  const aside = await place(page);
  await hold(page, 'KeyD', async () => { const [x, , z] = await place(page); return Math.hypot(x - aside[0], z - aside[2]) > 0.4; }, 'it goes to the side');
  const turned = async () => { const [x, , z, a, , b] = await camera(page); return Math.atan2(a! - x!, -(b! - z!)); }, heading = await turned();
  await hold(page, 'ArrowRight', async () => Math.abs(Math.sin(await turned() - heading)) > 0.3, 'it turns');
  assert.ok(Math.sin(await turned() - heading) > 0, 'to the right');
  const [, y] = await camera(page), [, ground] = await place(page);
  assert.ok(Math.abs(y! - ground - EYES) < 0.05, `eyes at ${y} over ${ground}`);
});

test('no house is walked into: from before a front, ahead leads to its wall and no farther', async () => {
  await page.evaluate(() => hsd.app.town.goTo('houses', 's1'));
  assert.equal(await walks(page), false, 'who looks from elsewhere walks no more');
  await does(page, 'walk').click();
  const { before, front } = await page.evaluate(() => {
    const { decision } = hsd.app.town.selected!, of = (name: string) => Number(decision![name]);
    return { before: hsd.app.walk.place, front: { x: (of('front_x1') + of('front_x2')) / 2, z: -(of('front_y1') + of('front_y2')) / 2, facing: of('facing') * Math.PI / 180 } };
  });
  // Its distance in front of the facade line; a house may have eaves and lattices up to a metre before it.
  const off = ([x, , z]: [number, number, number]) => (x - front.x) * Math.sin(front.facing) - (z - front.z) * Math.cos(front.facing);
  assert.ok(off(before) > 3, `it begins ${off(before)} m before the front`);
  let last = before;
  await hold(page, 'KeyW', async () => {
    const frames = await page.evaluate(() => hsd.stats.frames);
    await until(() => page.evaluate(frames => hsd.stats.frames > frames + 3, frames), 'frames are drawn');
    const now = await place(page), stopped = off(now) > off(last) - 0.02; // It may go on along the front.
    last = now;
    return stopped;
  }, 'it comes no nearer');
  assert.ok(off(last) > -0.6 && off(last) < 2.5, `it stops ${off(last)} m before the front`);
});

test('a drag looks around, and Escape ends the walk where it is', async () => {
  const box = (await page.locator('canvas.viewport').boundingBox())!, before = await camera(page);
  await page.mouse.move(box.x + 300, box.y + 250);
  await page.mouse.down();
  await page.mouse.move(box.x + 150, box.y + 250, { steps: 4 });
  await page.mouse.up();
  const after = await camera(page);
  assert.deepEqual(after.slice(0, 3), before.slice(0, 3), 'the eyes stay');
  assert.ok(Math.hypot(after[3]! - before[3]!, after[5]! - before[5]!) > 1, 'they look elsewhere');
  assert.equal(await page.evaluate(() => hsd.app.town.selected?.key), 's1', 'a drag selects nothing');
  await page.locator('canvas.viewport').focus();
  await page.keyboard.press('Escape');
  assert.equal(await walks(page), false);
  assert.equal(await does(page, 'walk').getAttribute('aria-pressed'), 'false');
  assert.deepEqual((await camera(page)).slice(0, 3), after.slice(0, 3));
  assert.match(await live(page), /stopped walking/);
  assert.equal(await page.evaluate(() => hsd.app.town.selected?.key), 's1', 'the first Escape only ends the walk');
  assert.equal(await page.locator('.walk-pad').isVisible(), false);
  await page.keyboard.press('ArrowLeft'); // Keys orbit again.
  assert.notDeepEqual((await camera(page)).slice(0, 3), after.slice(0, 3));
});

test('distances are measured in a town: by clicks in metres, and from the crosshair by Enter', async () => {
  await page.evaluate(() => { hsd.app.town.clearSelection(); });
  await does(page, 'view').selectOption('top');
  await atRest(page);
  const fold = await unfold(page, 'measure');
  await fold.locator('input[type=checkbox]').check();
  const spots = await page.evaluate(() => {
    const { canvas, camera } = hsd.viewport, { left, top } = canvas.getBoundingClientRect();
    // Two places of the streets around the block, on the ground.
    const { min, max } = hsd.app.town.box!;
    return [[min.x - 1, min.z - 1], [max.x + 1, min.z - 1]].map(([x, z]) => {
      const at = camera.position.clone().set(x!, hsd.viewport.environment.level, z!), seen = at.clone().project(camera);
      return { at: [x!, z!], x: left + (seen.x + 1) / 2 * canvas.clientWidth, y: top + (1 - seen.y) / 2 * canvas.clientHeight };
    });
  });
  for (const { x, y } of spots) await page.mouse.click(x, y);
  const wanted = Math.hypot(spots[1]!.at[0]! - spots[0]!.at[0]!, spots[1]!.at[1]! - spots[0]!.at[1]!);
  const cell = fold.locator('tbody td').first();
  await until(() => cell.isVisible(), 'the length is listed');
  assert.ok(Math.abs(Number((await cell.innerText()).replace(',', '')) - wanted) < wanted * 0.01, `${await cell.innerText()} m, not ${wanted}`);
  assert.match(await page.locator('.labels span').innerText(), /m/);
  assert.equal(await page.evaluate(() => hsd.app.town.selected), null, 'a click measures and selects nothing');
  await page.locator('canvas.viewport').focus();
  await page.keyboard.press('Enter');
  assert.equal(await page.evaluate(() => hsd.app.renderer.measure.points.length), 3);
  await page.keyboard.press('Backspace');
  assert.equal(await page.evaluate(() => hsd.app.renderer.measure.points.length), 2);
});

test('a measured point snaps to the corner of a house', async () => {
  await page.evaluate(() => { hsd.app.renderer.measure.clear(); return hsd.app.town.goTo('houses', 's1'); });
  await atRest(page);
  const corner = await page.evaluate(() => {
    const { shape } = hsd.app.town.tiles!.shapeOf('houses', 's1')!, { canvas, camera } = hsd.viewport, { left, top } = canvas.getBoundingClientRect();
    const position = shape.getAttribute('position'), corner = (i: number) => camera.position.clone().fromBufferAttribute(position, i);
    // A place close to a corner, on a triangle that is drawn there: a ray to it meets it.
    for (let i = 0; i < position.count; i += 3) {
      const middle = corner(i).add(corner(i + 1)).add(corner(i + 2)).divideScalar(3), at = corner(i).lerp(middle, 0.04);
      const seen = at.clone().project(camera), x = (seen.x + 1) / 2 * canvas.clientWidth, y = (1 - seen.y) / 2 * canvas.clientHeight;
      if (x < 20 || x > canvas.clientWidth - 20 || y < 20 || y > canvas.clientHeight - 20) continue;
      const hit = hsd.surface(camera.position.toArray(), at.clone().sub(camera.position).normalize().toArray());
      if (hit && Math.hypot(hit[0]! - at.x, hit[1]! - at.y, hit[2]! - at.z) < 0.01) return { x: left + x, y: top + y };
    }
    return null;
  });
  assert.ok(corner, 'a corner is seen');
  await page.mouse.click(corner.x, corner.y);
  const off = await page.evaluate(() => {
    const [point] = hsd.app.renderer.measure.points, { shape } = hsd.app.town.tiles!.shapeOf('houses', 's1')!, position = shape.getAttribute('position');
    let least = Infinity;
    for (let i = 0; i < position.count; i++) least = Math.min(least, Math.hypot(position.getX(i) - point!.x, position.getY(i) - point!.y, position.getZ(i) - point!.z));
    return least;
  });
  assert.ok(off < 1e-3, `${off} m from a corner`);
  await (await unfold(page, 'measure')).locator('input[type=checkbox]').uncheck();
});

test('on a phone: buttons go while they are touched, a drag of a finger looks around', async () => {
  const page = await preview.open(`?file=${TOWN}`, { viewport: PHONE, hasTouch: true, isMobile: true });
  await atRest(page);
  await does(page, 'walk').tap();
  await until(() => walks(page), 'a walk begins');
  const pad = page.locator('.walk-pad');
  assert.equal(await pad.isVisible(), true);
  for (const button of await pad.locator('button').all()) {
    const { width, height } = (await button.boundingBox())!;
    assert.ok(width >= 40 && height >= 36, `a button of ${width} × ${height}`);
  }
  const before = await place(page), touch = await page.context().newCDPSession(page), ahead = (await pad.locator('[data-way=ahead]').boundingBox())!;
  const points = (x: number, y: number) => ({ touchPoints: [{ x, y }] });
  await touch.send('Input.dispatchTouchEvent', { type: 'touchStart', ...points(ahead.x + 20, ahead.y + 20) });
  await until(async () => { const [x, , z] = await place(page); return Math.hypot(x - before[0], z - before[2]) > 1; }, 'it goes', 30_000);
  await touch.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
  await page.waitForTimeout(400);
  const stopped = await place(page);
  await page.waitForTimeout(400);
  assert.deepEqual(await place(page), stopped, 'it stops when the finger leaves');
  const seen = await camera(page);
  await touch.send('Input.dispatchTouchEvent', { type: 'touchStart', ...points(200, 250) });
  for (let i = 1; i <= 4; i++) await touch.send('Input.dispatchTouchEvent', { type: 'touchMove', ...points(200 - i * 30, 250) });
  await touch.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
  assert.notDeepEqual((await camera(page)).slice(3), seen.slice(3), 'it looks elsewhere');
  // A press of an assistive tool goes for a moment.
  const here = await place(page);
  await pad.locator('[data-way=back]').evaluate(button => (button as HTMLButtonElement).click());
  await until(async () => { const [x, , z] = await place(page); return Math.hypot(x - here[0], z - here[2]) > 0.2; }, 'it goes back', 30_000);
  const found = await page.evaluate(async () => {
    const { axe } = window as unknown as { axe: { run: (options: object) => Promise<{ violations: { id: string; nodes: { html: string }[] }[] }> } };
    return (await axe.run({ resultTypes: ['violations'] })).violations.flatMap(({ id, nodes }) => nodes.map(({ html }) => `${id}: ${html.slice(0, 160)}`));
  });
  assert.deepEqual(found, []);
  await pad.locator('[data-do=leave-walk]').tap();
  await until(async () => !await walks(page), 'the walk is left');
  await page.context().close();
});

test('a walk around a house, too', async () => {
  preview.write('house.hsd', '0 0 180\n9.0\n\nKSK  TOD  KSK\nKSK  KSK\nKSK  KSK  KSK\nKSK  KSK\n');
  const page = await preview.open('?file=house.hsd&lang=ja');
  await until(() => page.evaluate(() => (hsd.app.model?.chunks.length ?? 0) > 0), 'the house is shown');
  await does(page, 'walk').click();
  assert.equal(await walks(page), true);
  assert.match(await live(page), /歩いています/);
  const box = await page.evaluate(() => { const { min, max } = hsd.app.model!.box; return [min.x, min.z, max.x, max.z]; });
  for (const key of ['KeyW', 'KeyA', 'KeyW', 'KeyD', 'KeyS', 'KeyD']) {
    await page.keyboard.down('Shift');
    await page.keyboard.down(key);
    await page.waitForTimeout(900);
    await page.keyboard.up(key);
    await page.keyboard.up('Shift');
    const [x, , z] = await place(page);
    const inside = x > box[0]! + 1.2 && x < box[2]! - 1.2 && z > box[1]! + 1.2 && z < box[3]! - 1.2;
    assert.equal(inside, false, `${x} ${z} is in the house`);
  }
  await page.evaluate(() => hsd.app.openFile('town/block.hsd'));
  assert.equal(await walks(page), false, 'another file ends it');
  await page.context().close();
});

test('nothing went wrong', () => {
  preview.consoleMessages.splice(0, Infinity, ...preview.consoleMessages.filter(text => !text.includes('tiles versions at 1.1')));
  preview.assertClean();
});
