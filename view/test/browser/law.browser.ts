// Building law in a town: a click on the glass over a lot tells which rule binds that face, and its arithmetic.

import assert from 'node:assert/strict';
import { cpSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import type { Page } from 'playwright-core';
import { EXAMPLES, Preview, until } from './preview.ts';

/** A lot without a house of its own. */
const LOT = 'B6';

let preview: Preview, page: Page;

before(async () => {
  preview = await Preview.of([]);
  cpSync(join(EXAMPLES, 'towns'), join(preview.folder, 'town'), { recursive: true });
  page = await preview.open('?file=town/law.hsd');
  const ready = () => page.evaluate(() => {
    const { state, tiles, busy } = hsd.app.town;
    return state?.whole === true && !busy && tiles!.shown > 0;
  });
  await until(ready, 'the town is shown', 120_000);
  await page.evaluate(() => hsd.settled());
});
after(async () => { await preview?.close(); });

/** Where faces of an envelope that slope or lie level are drawn, CSS pixels of the page, each with how steep it is. */
const faces = (page: Page, key: string) => page.evaluate(key => {
  const { renderer: { viewport }, town } = hsd.app, { shape } = town.tiles!.shapeOf('lots', key)!, { canvas, camera } = viewport, { left, top } = canvas.getBoundingClientRect();
  const corners = shape.getAttribute('position'), corner = () => camera.position.clone(), found = [];
  for (let i = 0; i < corners.count; i += 3) {
    const [a, b, c] = [0, 1, 2].map(k => corner().fromBufferAttribute(corners, i + k)) as [typeof camera.position, typeof camera.position, typeof camera.position];
    const normal = b.clone().sub(a).cross(c.clone().sub(a)).normalize(), middle = a.clone().add(b).add(c).divideScalar(3);
    const area = b.clone().sub(a).cross(c.clone().sub(a)).length() / 2, seen = middle.clone().project(camera);
    if (normal.dot(camera.position.clone().sub(middle)) <= 0) continue;
    found.push({ up: normal.y, height: middle.y, area, x: left + (seen.x + 1) / 2 * canvas.clientWidth, y: top + (1 - seen.y) / 2 * canvas.clientHeight });
  }
  shape.dispose();
  return found.sort((a, b) => b.area - a.area);
}, key);

/** The text of the card after a click on the largest face of a kind. */
async function told(page: Page, wanted: (up: number) => boolean): Promise<{ text: string; height: number }> {
  const face = (await faces(page, LOT)).find(({ up }) => wanted(up));
  assert.ok(face, `such a face is among ${JSON.stringify((await faces(page, LOT)).slice(0, 12))}`);
  await page.evaluate(() => hsd.app.town.clearSelection());
  await page.mouse.click(face.x, face.y);
  await until(() => page.locator('.feature-card').isVisible(), 'the card is shown');
  return { text: await page.locator('.feature-card').innerText(), height: face.height };
}

test('a click on the glass over a lot tells which rule binds that face, and its arithmetic', async () => {
  await page.evaluate(key => hsd.app.town.goTo('lots', key), LOT);
  await page.evaluate(() => hsd.settled());
  const slope = await told(page, up => up > 0.1 && up < 0.95);
  const [, arithmetic, height] = slope.text.match(/Face of the envelope\n.*(?:road|side) \d+: (.+): ([\d.]+) m/) ?? [];
  assert.match(arithmetic ?? slope.text, /[\d.]+ x d/);
  assert.ok(Math.abs(Number(height) - slope.height) < 0.3, `${height} m, not ${slope.height}`);
  const wall = await told(page, up => Math.abs(up) < 0.05);
  assert.match(wall.text, /Face of the envelope\n.*(?:border of the lot|end of)/);
});

test('the answer is none where no face is', async () => {
  const face = await page.evaluate(async key => {
    const response = await fetch(`/api/town/${hsd.app.town.state!.id}/face?layer=lots&key=${key}&east=-900&north=-900&up=3`);
    return await response.json() as unknown;
  }, LOT);
  assert.equal(face, null);
});
