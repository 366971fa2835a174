// Every control of the page, in Chromium with the real server.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import type { Page } from 'playwright-core';
import { KYOTO, sunPosition } from '../../src/scene/sun.ts';
import { brightness, differ, does, fold, mean, Preview, unfold, until } from './preview.ts';

let preview: Preview, page: Page;

before(async () => {
  preview = await Preview.of(['machiya.hsd', 't-house.hsd', 'kura.hsd']);
  page = await preview.open('?file=machiya.hsd');
});
after(async () => { await preview?.close(); });

const live = () => page.locator('.live').textContent();
const reset = async () => { await does(page, 'reset').click(); await page.evaluate(() => hsd.settled()); };

test('the file list follows the folder and switches files', async () => {
  const files = page.locator('.files button');
  assert.deepEqual(await files.allTextContents(), ['kura.hsd', 'machiya.hsd', 't-house.hsd']);
  assert.equal(await page.locator('.files [aria-current]').textContent(), 'machiya.hsd');
  preview.write('zashiki.hsd', preview.read('kura.hsd'));
  await until(async () => await files.count() === 4, 'the new file is listed');
  await files.filter({ hasText: 't-house' }).click();
  await until(() => page.evaluate(() => hsd.app.state?.file === 't-house.hsd' && hsd.find('TKD 2').length === 1), 't-house is shown');
  assert.equal(await page.locator('.title').textContent(), 't-house.hsd');
  await files.filter({ hasText: 'machiya' }).click();
  await until(() => page.evaluate(() => hsd.find('GDE 2').length === 1), 'machiya is shown');
});

test('storeys and roofs can be hidden and shown', async () => {
  const triangles = () => page.evaluate(() => { hsd.viewport.frame(true); hsd.viewport.frame(true); return hsd.stats.triangles; });
  const all = await triangles(), seen = await brightness(page);
  const boxes = (await unfold(page, 'shown')).locator('label.tick');
  assert.deepEqual(await boxes.allTextContents(), ['Storey 1', 'Storey 2', 'Roofs of storey 1', 'Roofs of storey 2']);
  for (const [i, layer] of ['storey 1', 'storey 2', 'roof 1', 'roof 2'].entries()) {
    await boxes.nth(i).locator('input').uncheck();
    const less = await triangles();
    assert.ok(less < all, `${layer}: ${less} of ${all}`);
    const hidden = await page.evaluate(layer => hsd.app.model!.chunks.filter(c => hsd.app.layerOf(c) === layer).every(c => !c.mesh.visible)
      && hsd.app.model!.chunks.filter(c => hsd.app.layerOf(c) !== layer).every(c => c.mesh.visible), layer);
    assert.ok(hidden, layer);
    assert.ok(differ(seen, await brightness(page)) > 0.005, `${layer} is seen to go`);
    await boxes.nth(i).locator('input').check();
    assert.equal(await triangles(), all);
  }
  await boxes.nth(0).locator('input').uncheck();
  await fold(page, 'shown').getByRole('button', { name: 'Show all' }).click();
  assert.equal(await triangles(), all);
});

test('the section plane cuts on each axis, on either side, and bodies look solid', async () => {
  const section = await unfold(page, 'section');
  await does(page, 'view').selectOption('above');
  const whole = await brightness(page);
  await section.getByLabel('Cut the model').check();
  const kept = (x: number, y: number, z: number) => page.evaluate(([x, y, z]) => {
    const { min, max } = hsd.app.model!.box, at = min.clone();
    at.set(min.x + (max.x - min.x) * x!, min.y + (max.y - min.y) * y!, min.z + (max.z - min.z) * z!);
    return hsd.app.renderer.section.keeps(at);
  }, [x, y, z]);
  await section.getByLabel('Axis').selectOption('y');
  await section.getByLabel('Position').fill('0.3');
  assert.ok(await kept(0.5, 0.2, 0.5));
  assert.ok(!await kept(0.5, 0.4, 0.5));
  assert.ok(differ(whole, await brightness(page)) > 0.1, 'the upper part is hidden');
  // The flat colour of cut bodies is visible.
  const caps = () => page.evaluate(() => {
    const { clientWidth: w, clientHeight: h } = hsd.viewport.canvas, places: [number, number][] = [];
    for (let y = 0; y < h; y += 2) for (let x = 0; x < w; x += 2) places.push([x, y]);
    return hsd.pixels(places).filter(([r, g, b]) => Math.abs(r! - 0x8c) < 3 && Math.abs(g! - 0x3b) < 3 && Math.abs(b! - 0x2a) < 3).length;
  });
  assert.ok(await caps() > 20, `${await caps()} places of cut bodies`);
  const metres = await page.evaluate(() => hsd.app.renderer.section.position());
  assert.equal(await section.locator('output').textContent(), `${metres.toFixed(2)} m`);
  // Parts that are cut away cannot be picked.
  const roof = await page.evaluate(() => hsd.pick(hsd.viewport.canvas.clientWidth / 2, hsd.viewport.canvas.clientHeight / 3));
  assert.notEqual(await page.evaluate(part => part === null ? '' : hsd.app.model!.parts[part]!.kind, roof), 'roof');
  await section.getByLabel('Other side').check();
  assert.ok(!await kept(0.5, 0.2, 0.5));
  assert.ok(await kept(0.5, 0.4, 0.5));
  await section.getByLabel('Axis').selectOption('x');
  assert.ok(await kept(0.4, 0.5, 0.5) && !await kept(0.2, 0.5, 0.5));
  await section.getByLabel('Axis').selectOption('z');
  assert.ok(await kept(0.5, 0.5, 0.4) && !await kept(0.5, 0.5, 0.2));
  await section.getByLabel('Cut the model').uncheck();
  assert.ok(await kept(0.5, 0.5, 0.2));
  assert.equal(await page.evaluate(() => hsd.app.renderer.section.caps), 0);
  assert.equal(differ(whole, await brightness(page)), 0);
});

test('the sun follows date and hour in Kyoto, with its shadows; nights are dim', async () => {
  await reset();
  const sky = await unfold(page, 'sun');
  const set = async (date: string, hour: number) => {
    await sky.getByLabel('Date').fill(date);
    await sky.getByLabel('Hour in Kyoto').fill(`${hour}`);
    const [year, month, day] = date.split('-').map(Number) as [number, number, number];
    const { azimuth, altitude } = sunPosition({ year, month, day }, hour, KYOTO);
    const text = await sky.locator('p[role=status]').textContent();
    assert.ok(text!.includes(`${azimuth.toFixed(1)}°`) && text!.includes(`${altitude.toFixed(1)}°`), `${text}`);
    // The direction of the light: x east, y up, z south.
    const way = await page.evaluate(() => { const { sun } = hsd.viewport; return sun.position.clone().sub(sun.target.position).normalize().toArray(); });
    if (altitude > 0) {
      assert.ok(Math.abs(Math.asin(way[1]) * 180 / Math.PI - altitude) < 0.01);
      assert.ok(Math.abs((Math.atan2(way[0], -way[2]) * 180 / Math.PI + 360) % 360 - azimuth) < 0.01);
    }
    return brightness(page);
  };
  const morning = await set('2026-06-21', 8), noon = await set('2026-06-21', 12), winter = await set('2026-12-22', 12);
  assert.ok(differ(morning, noon) > 0.03, 'light moves from morning to noon');
  assert.ok(differ(noon, winter) > 0.03, 'light moves from summer to winter');
  const night = await set('2026-06-21', 23);
  assert.match(await sky.locator('p[role=status]').textContent() ?? '', /below the horizon/);
  assert.ok(mean(night) < mean(noon) * 0.45, `${mean(night)} by night, ${mean(noon)} at noon`);
  await reset();
  assert.equal(await sky.getByLabel('Hour in Kyoto').inputValue(), '14');
});

test('measuring snaps to vertices and shows metres, shaku and ken', async () => {
  await reset();
  const section = await unfold(page, 'measure');
  await section.getByLabel('Measure', { exact: true }).check();
  const canvas = page.locator('canvas.viewport');
  // Visible points on the model.
  const places = await page.evaluate(() => {
    const found: [number, number][] = [], { clientWidth: w, clientHeight: h } = hsd.viewport.canvas;
    for (let y = h * 0.35; y < h * 0.75 && found.length < 3; y += h * 0.13) {
      const x = w * (0.35 + 0.1 * found.length);
      if (hsd.pick(x, y) !== null) found.push([x, y]);
    }
    return found;
  });
  assert.equal(places.length, 3);
  for (const [x, y] of places) await canvas.click({ position: { x, y } });
  const { points, vertices } = await page.evaluate(() => {
    const { points } = hsd.app.renderer.measure, seen = new Set<string>();
    const key = (p: { x: number; y: number; z: number }) => [p.x, p.y, p.z].map(n => n.toFixed(4)).join();
    for (const { mesh } of hsd.app.model!.chunks) {
      const at = mesh.geometry.getAttribute('position');
      for (let i = 0; i < at.count; i++) seen.add(key({ x: at.getX(i), y: at.getY(i), z: at.getZ(i) }));
    }
    return { points: points.map(p => p.toArray()), vertices: points.filter(p => seen.has(key(p))).length };
  });
  assert.equal(points.length, 3);
  // A point near a corner snaps to it: choose a visible vertex and click on its pixel.
  const rows = section.locator('tbody tr');
  assert.equal(await rows.count(), 3, 'two stretches and their sum');
  const lengths = [0, 1].map(i => Math.hypot(...[0, 1, 2].map(k => points[i + 1]![k]! - points[i]![k]!)));
  const cells = await rows.nth(0).locator('td').allTextContents();
  assert.deepEqual(cells, [lengths[0]!.toFixed(3), (lengths[0]! / (10 / 33)).toFixed(2), (lengths[0]! / (60 / 33)).toFixed(2)]);
  assert.equal(await rows.nth(2).locator('td').first().textContent(), (lengths[0]! + lengths[1]!).toFixed(3));
  assert.equal(await page.locator('.labels span').count(), 2, 'labels beside the stretches');
  // At the pixel of a vertex, the vertex itself is chosen.
  await section.getByRole('button', { name: 'Clear' }).click();
  const corner = await page.evaluate(() => {
    const { model, renderer: { viewport } } = hsd.app, { clientWidth: w, clientHeight: h } = viewport.canvas;
    for (const { mesh } of model!.chunks) {
      const at = mesh.geometry.getAttribute('position');
      for (let i = 0; i < at.count; i += 7) {
        const p = viewport.camera.position.clone().set(at.getX(i), at.getY(i), at.getZ(i)), q = p.clone().project(viewport.camera);
        const x = Math.round((q.x + 1) / 2 * w), y = Math.round((1 - q.y) / 2 * h);
        const hit = x > 40 && y > 40 && x < w - 40 && y < h - 40 && hsd.hit(x, y);
        if (hit && Math.hypot(...hit.map((n, k) => n - p.toArray()[k]!)) < 0.02) return { x, y };
      }
    }
    return null;
  });
  assert.ok(corner, 'a corner is seen');
  await canvas.click({ position: corner! });
  const far = await page.evaluate(() => {
    const p = hsd.app.renderer.measure.points[0]!;
    let least = Infinity;
    for (const { mesh } of hsd.app.model!.chunks) {
      const at = mesh.geometry.getAttribute('position');
      for (let i = 0; i < at.count; i++) least = Math.min(least, Math.hypot(at.getX(i) - p.x, at.getY(i) - p.y, at.getZ(i) - p.z));
    }
    return least;
  });
  assert.ok(far < 1e-6, `snapped to a vertex, ${far} m off; ${vertices} before`);
  // With the keyboard: the crosshair in the middle.
  await section.getByRole('button', { name: 'Clear' }).click();
  await canvas.focus();
  await page.keyboard.press('Enter');
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('Enter');
  assert.equal(await page.evaluate(() => hsd.app.renderer.measure.points.length), 2);
  await section.getByRole('button', { name: 'Undo last point' }).click();
  assert.equal(await page.evaluate(() => hsd.app.renderer.measure.points.length), 1);
  await reset();
  assert.equal(await page.evaluate(() => hsd.app.renderer.measure.points.length), 0);
  assert.ok(!await section.getByLabel('Measure', { exact: true }).isChecked());
});

test('preset views have their direction and show the whole house', async () => {
  const from = async (view: string) => {
    await does(page, 'view').selectOption(view);
    return page.evaluate(() => {
      const [x, y, z, tx, ty, tz] = hsd.camera as [number, number, number, number, number, number];
      const inside = hsd.viewport.model!.parts.filter(p => p.kind === 'part').every(p => {
        const q = p.box.getCenter(hsd.viewport.camera.position.clone()).project(hsd.viewport.camera);
        return Math.abs(q.x) < 1 && Math.abs(q.y) < 1;
      });
      return { x: x - tx, y: y - ty, z: z - tz, eye: y - Math.min(0, hsd.viewport.model!.box.min.y), inside };
    });
  };
  const front = await from('front');
  assert.ok(front.z > 0 && Math.abs(front.eye - 1.6) < 1e-6 && front.inside, `front: from the south at 1.6 m: ${JSON.stringify(front)}`);
  const eaves = await from('eaves');
  assert.ok(eaves.eye > 2 && eaves.z > 0 && eaves.inside);
  const above = await from('above');
  assert.ok(above.y > 2 && above.z > 0 && above.inside);
  const back = await from('back');
  assert.ok(back.z < 0 && back.inside);
  const left = await from('left'), right = await from('right');
  assert.ok(left.x < 0 && right.x > 0 && Math.abs(left.z) < 0.1 && left.inside && right.inside);
  assert.equal(await does(page, 'view').inputValue(), 'right');
  const top = await from('top');
  assert.ok(top.y > 5 && Math.hypot(top.x, top.z) < 0.2 && top.inside);
  await page.locator('canvas.viewport').focus();
  await page.keyboard.press('ArrowLeft');
  assert.equal(await does(page, 'view').inputValue(), '', 'moving the camera leaves the preset');
  const eye = await page.evaluate(() => { hsd.camera = [2, -6, 30, 0, 12, 0]; return hsd.camera[1]!; });
  assert.ok(eye > 0 && eye < 1, `it stays above the ground: ${eye}`);
  // Pan down, then zoom towards a point below the ground.
  for (let i = 0; i < 50; i++) await page.keyboard.press('Shift+ArrowDown');
  await page.evaluate(() => { hsd.camera = [0, 2, 8, 0, -3, 0]; });
  for (let i = 0; i < 20; i++) await page.keyboard.press('+');
  assert.ok(await page.evaluate(() => hsd.camera.every(Number.isFinite) && hsd.camera[1]! > 0));
});

test('automatic rotation starts, stops, and moves in steps with reduced motion', async () => {
  await reset();
  const angle = (on: Page) => on.evaluate(() => Math.atan2(hsd.camera[0]! - hsd.camera[3]!, hsd.camera[2]! - hsd.camera[5]!));
  const begun = await angle(page), button = does(page, 'turntable');
  await button.click();
  assert.equal(await button.getAttribute('aria-pressed'), 'true');
  await until(async () => Math.abs(await angle(page) - begun) > 0.1, 'it turns');
  await button.click();
  await page.evaluate(() => hsd.settled());
  const stopped = await angle(page);
  await page.waitForTimeout(300);
  assert.equal(await angle(page), stopped);
  const still = await preview.open('?file=machiya.hsd', { reducedMotion: 'reduce' });
  const first = await angle(still);
  await does(still, 'turntable').click();
  await still.waitForTimeout(700);
  assert.equal(await angle(still), first, 'no motion');
  await until(async () => Math.abs(await angle(still) - first) > 0.3, 'a step');
  await still.context().close();
});

test('a screenshot is downloaded as a PNG of the current view', async () => {
  await reset();
  const waiting = page.waitForEvent('download');
  await does(page, 'screenshot').click();
  const download = await waiting, bytes = readFileSync((await download.path())!);
  assert.equal(download.suggestedFilename(), 'machiya.png');
  assert.equal(bytes.subarray(1, 4).toString(), 'PNG');
  const size = await page.evaluate(() => [hsd.viewport.canvas.width, hsd.viewport.canvas.height]);
  assert.deepEqual([bytes.readUInt32BE(16), bytes.readUInt32BE(20)], size);
  const colours = await page.evaluate(async data => {
    const picture = await createImageBitmap(new Blob([Uint8Array.from(atob(data), c => c.charCodeAt(0))], { type: 'image/png' }));
    const canvas = new OffscreenCanvas(picture.width, picture.height), context = canvas.getContext('2d')!;
    context.drawImage(picture, 0, 0);
    const { data: pixels } = context.getImageData(0, 0, picture.width, picture.height), seen = new Set<number>();
    for (let i = 0; i < pixels.length; i += 4 * 997) seen.add(pixels[i]! << 16 | pixels[i + 1]! << 8 | pixels[i + 2]!);
    return seen.size;
  }, bytes.toString('base64'));
  assert.ok(colours > 30, `${colours} colours`);
  assert.equal(await live(), 'Image saved.');
});

test('statistics show the cost of a frame', async () => {
  const stats = await unfold(page, 'stats');
  await page.evaluate(() => hsd.settled());
  await until(async () => {
    const { calls, triangles } = await page.evaluate(() => hsd.stats), text = await stats.textContent() ?? '';
    return text.includes(`Draw calls${calls}`) && text.includes(triangles.toLocaleString('en'));
  }, 'the numbers are those of the last frame');
  assert.match(await stats.textContent() ?? '', /Frame[\d.]+ ms.*Reload\d+ ms.*Compile: read[\d.]+ ms/);
});

test('no requests to other hosts, no errors', () => preview.assertClean());
