// Walking inside: doors slide at a key and at a click, and are in the way only while they are shut; the lamp.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import type { Page } from 'playwright-core';
import { does, Preview, until } from './preview.ts';

let preview: Preview, page: Page;

before(async () => {
  preview = await Preview.of(['rooms.hsd']);
  page = await preview.open('?file=rooms.hsd');
  await page.evaluate(() => hsd.settled());
});
after(async () => { await preview?.close(); });

const live = () => page.locator('.live').innerText();
const south = () => page.evaluate(() => hsd.app.walk.place[2]);
/** The front door's middle: x and z. */
const door = () => page.evaluate(() => {
  const { box } = hsd.app.model!.parts.find(({ code }) => code?.startsWith('TOD'))!;
  return [(box.min.x + box.max.x) / 2, (box.min.z + box.max.z) / 2] as [number, number];
});

/** Goes ahead until one stands for a while. */
async function ahead() {
  await page.keyboard.down('KeyW');
  for (let last = NaN, still = 0; still < 2;) {
    const frames = await page.evaluate(() => hsd.stats.frames);
    await until(() => page.evaluate(frames => hsd.stats.frames > frames + 3, frames), 'frames are drawn', 30_000);
    const now = await south();
    still = Math.abs(now - last) < 0.01 ? still + 1 : 0;
    last = now;
  }
  await page.keyboard.up('KeyW');
}

test('from the street a shut door stops a walker, and an open one leads into the passage', async () => {
  const [x, z] = await door();
  await page.evaluate(([x, z]) => {
    hsd.viewport.camera.position.set(x!, 1.5, z! + 3);
    hsd.viewport.lookAt(hsd.viewport.camera.position.clone().set(x!, 1.5, z!));
  }, [x, z]);
  await does(page, 'walk').click();
  assert.equal(await page.evaluate(() => hsd.app.walk.on), true);
  await ahead();
  const stopped = await south();
  assert.ok(stopped > z + 0.2, `stopped at ${stopped}, before the door at ${z}`);
  await page.keyboard.press('KeyE');
  await until(async () => /^Opened: /.test(await live()), 'it is told');
  await until(() => page.evaluate(() => !hsd.app.walk.doors.busy), 'it has slid');
  await ahead();
  const inside = await south();
  assert.ok(inside < z - 1, `${inside} is behind the door at ${z}`);
});

test('who looks at a room from inside begins to walk there, with the eyes above its floor', async () => {
  await does(page, 'leave-walk').click();
  await page.evaluate(() => hsd.app.visit(hsd.app.state!.plan.views.find(({ name }) => name === 'zashiki')!));
  await page.evaluate(() => hsd.settled());
  await does(page, 'walk').click();
  const { place, eyes, from, floor, origin } = await page.evaluate(() => {
    const { houses: [house], views } = hsd.app.state!.plan;
    return { place: hsd.app.walk.place, eyes: hsd.camera[1]!, from: views.find(({ name }) => name === 'zashiki')!.from, floor: house!.storeys[0]!.z0 + house!.origin[2], origin: hsd.app.model!.origin.toArray() };
  });
  assert.ok(Math.hypot(place[0] + origin[0]! - from[0], place[2] + origin[2]! + from[1]) < 0.01, `${place} is not where the view is`);
  assert.ok(Math.abs(place[1] + origin[1]! - floor) < 0.7, `it stands at ${place[1]}, the floor is at ${floor}`);
  await until(async () => { const now = await page.evaluate(() => hsd.camera[1]! - hsd.app.walk.place[1]); return Math.abs(now - 1.5) < 0.05; }, `the eyes are at ${eyes}`);
});

test('the lamp is lit and put out by a key, and its button says so', async () => {
  await page.keyboard.press('KeyL');
  assert.match(await live(), /lamp is lit/);
  assert.equal(await does(page, 'lamp').getAttribute('aria-pressed'), 'true');
  await page.keyboard.press('KeyL');
  assert.equal(await does(page, 'lamp').getAttribute('aria-pressed'), 'false');
});

test('no requests to other hosts, no errors', () => preview.assertClean());
