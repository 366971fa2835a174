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
  for (let last = NaN, still = 0; still < 4;) {
    await page.waitForTimeout(200);
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
  await page.waitForTimeout(500);
  await ahead();
  const inside = await south();
  assert.ok(inside < z - 1, `${inside} is behind the door at ${z}`);
});

test('the lamp is lit and put out by a key, and its button says so', async () => {
  await page.keyboard.press('KeyL');
  assert.match(await live(), /lamp is lit/);
  assert.equal(await does(page, 'lamp').getAttribute('aria-pressed'), 'true');
  await page.keyboard.press('KeyL');
  assert.equal(await does(page, 'lamp').getAttribute('aria-pressed'), 'false');
});

test('no requests to other hosts, no errors', () => preview.assertClean());
