// What the page shows, looked at: names, shadows, cuts, lengths, the plan and the model on a phone.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import type { Page } from 'playwright-core';
import { does, Preview, until } from './preview.ts';

const HOUSE = `0 0 180
9.0

KSK  KSK  TKD 2KSK  KSK
KTU  KTU  MRE  KTU
KTU  KTU  KTU  KTU  KTU  KTU
KTU  KTU  KTU  KTU
`;

let preview: Preview, page: Page;

before(async () => {
  preview = await Preview.of(['machiya.hsd', 'street.hsd', 'plot.hsd', ['plain.hsd', HOUSE]]);
  page = await preview.open('?file=machiya.hsd');
});
after(async () => { await preview?.close(); });

const open = async (file: string) => {
  await page.locator('.files button').filter({ hasText: file }).click();
  await until(() => page.evaluate(file => hsd.app.state?.file === file && hsd.app.model!.chunks.length > 0, file), `${file} is open`);
  await page.evaluate(() => hsd.settled());
};

test('cards of posts and roofs do not call themselves void', async () => {
  await until(() => page.evaluate(() => hsd.app.names.size > 50), 'the names of the parts are loaded');
  for (const kind of ['post', 'roof', 'storey']) {
    await page.evaluate(kind => hsd.select(hsd.app.model!.parts.findIndex(part => part.kind === kind)), kind);
    const card = await page.locator('.card').textContent() ?? '';
    assert.doesNotMatch(card, /void/, kind);
  }
  await page.evaluate(() => hsd.select(null));
});

test('the lit part is cut with the model', async () => {
  const lit = () => page.evaluate(() => {
    const { clientWidth: w, clientHeight: h } = hsd.viewport.canvas, places: [number, number][] = [];
    for (let y = 0; y < h; y += 3) for (let x = 0; x < w; x += 3) places.push([x, y]);
    return hsd.pixels(places).filter(([r, g, b]) => r! > 150 && r! > g! + 45 && g! < 130 && b! < 110).length;
  });
  await does(page, 'view').selectOption('above');
  await page.evaluate(() => hsd.select(hsd.app.model!.parts.findIndex(part => part.kind === 'roof' && part.storey === 2)));
  const whole = await lit();
  assert.ok(whole > 100, `${whole} places are lit`);
  await page.evaluate(() => hsd.app.renderer.section.set({ on: true, axis: 'y', at: 0.2, flip: false }));
  const cut = await lit();
  await page.evaluate(() => { hsd.app.renderer.section.set({ on: false }); hsd.select(null); });
  assert.ok(cut < whole / 10, `${cut} of ${whole} places are lit above the cut`);
});

test('the ground has one surface, and the near plane is as far away as the house allows', async () => {
  await does(page, 'view').selectOption('above');
  await page.evaluate(() => hsd.settled());
  const seen = await page.evaluate(() => {
    const { min } = hsd.app.model!.box, { group } = hsd.viewport.environment;
    const flat = group.children.filter(child => child.receiveShadow && Math.abs(child.position.y - min.y) < 0.1);
    return { grounds: flat.map(child => child.name), near: hsd.viewport.camera.near };
  });
  assert.deepEqual(seen.grounds, ['ground']);
  assert.ok(seen.near > 1, `${seen.near} m`);
});

test('a street of facing houses opens along it', async () => {
  await open('street.hsd');
  const [x, y, z, tx, , tz] = await page.evaluate(async () => { hsd.app.reset(); await hsd.settled(); return hsd.camera; }) as [number, number, number, number, number, number];
  assert.ok(Math.abs(x - tx) > 20 && Math.abs(z - tz) < 0.5, `${x} ${z} to ${tx} ${tz}`);
  assert.ok(y < 3, 'at eye height');
  assert.ok(await page.evaluate(() => {
    const { clientWidth: w, clientHeight: h } = hsd.viewport.canvas;
    return hsd.pick(w * 0.1, h * 0.5) !== null && hsd.pick(w * 0.9, h * 0.5) !== null;
  }), 'houses on both sides');
});

test('the views that a file names are listed, a click goes there, and a file that is no street opens at its first', async () => {
  await open('plot.hsd');
  const list = page.locator('.named-views button');
  assert.deepEqual(await list.allTextContents(), ['garden', 'corridor']);
  /** How far the camera stands from a named view and looks past it, metres, and the difference of its angle, degrees. */
  const off = (n: number) => page.evaluate(n => {
    const { from, to, fov } = hsd.app.state!.plan.views[n]!, { origin } = hsd.app.model!, [x, y, z, tx, ty, tz] = hsd.camera as [number, number, number, number, number, number];
    const far = ([e, up, s]: [number, number, number], [east, north, height]: [number, number, number]) => Math.hypot(e + origin.x - east, up + origin.y - height, s + origin.z + north);
    const { camera } = hsd.viewport;
    // A narrow window is opened wider.
    const angle = camera.aspect < 4 / 3 && camera.fov <= 80 ? Math.max(0, fov - camera.fov) : Math.abs(camera.fov - fov);
    return [far([x, y, z], from), far([tx, ty, tz], to), angle];
  }, n);
  const there = async (n: number) => { for (const miss of await off(n)) assert.ok(miss < 0.02, `${miss} from view ${n}`); };
  await until(() => page.evaluate(() => hsd.app.visited === 'garden'), 'it opens in the garden');
  await there(0);
  await list.nth(1).click();
  await there(1);
  assert.equal(await list.nth(1).getAttribute('aria-current'), 'true');
  await does(page, 'view').selectOption('front');
  assert.equal(await list.nth(1).getAttribute('aria-current'), null);
  assert.ok((await off(1))[2]! > 5, 'a preset view has its own angle');
  await open('machiya.hsd');
  assert.ok(await page.locator('[data-fold=named-views]').isHidden(), 'no list without views');
});

test('lengths have one size and a unit on a small house and on a street, and Fit shows all of them', async () => {
  await does(page, 'plan').click();
  for (const file of ['plain.hsd', 'street.hsd', 'machiya.hsd']) {
    await open(file);
    await until(() => page.evaluate(file => hsd.plan.state?.file === file, file), 'the plan is drawn');
    await does(page, 'fit').click();
    const seen = await page.evaluate(() => {
      const sheet = document.querySelector('.paper')!.getBoundingClientRect();
      return [...document.querySelectorAll<SVGTextElement>('.length')].filter(e => e.style.display !== 'none' && !e.closest('.legend')).map(e => {
        const { left, right, top, bottom } = e.getBoundingClientRect();
        return { text: e.textContent!, high: bottom - top, inside: left >= sheet.left && right <= sheet.right && top >= sheet.top && bottom <= sheet.bottom };
      });
    });
    assert.ok(file === 'street.hsd' || seen.length === 4, `${file}: ${seen.length} lengths`);
    for (const { text, high, inside } of seen) {
      assert.match(text, /^[\d.]+ shaku$/);
      assert.ok(high > 9 && high < 22, `${file}: ${text} is ${high} px high`);
      assert.ok(inside, `${file}: ${text} is cut off`);
    }
  }
});

/** Screen position of a point of the first house. */
const at = (a: number, b: number) => page.evaluate(([a, b]) => {
  const u = hsd.app.state!.plan.houses[0]!.unit_m, p = new DOMPoint(-a! * u, -b! * u).matrixTransform(hsd.plan.sheet.svg.getScreenCTM()!);
  return { x: p.x, y: p.y };
}, [a, b]);

const becomes = async (what: string) => {
  await until(() => page.evaluate(before => hsd.app.state?.sources[0]?.text !== before && hsd.reload?.revision === hsd.revision, HOUSE), what);
  await page.waitForTimeout(100);
};

test('a selected part stays selected at its place after an edit', async () => {
  await open('plain.hsd');
  await does(page, 'draw').click();
  await page.locator('.tools input[value=wall]').check();
  const centre = () => page.evaluate(() => {
    const { model, selection } = hsd.app;
    return selection === null ? null : model!.parts[selection]!.box.min.clone().add(model!.parts[selection]!.box.max).multiplyScalar(0.5).add(model!.origin).toArray().map(n => Number(n.toFixed(3)));
  });
  // A unit of the right wall, of which there are several equal ones.
  await page.evaluate(() => hsd.select(hsd.app.model!.parts.findIndex(part => part.code?.trim() === 'KTU' && hsd.app.model!.parts[part.facade!]!.name.endsWith('2'))));
  const before = await centre();
  assert.ok(before);
  // The front moves out: units are added at the beginning of the right wall.
  const [p, q] = [await at(1.5, 0), await at(1.5, -2.1)];
  await page.mouse.move(p.x, p.y);
  await page.mouse.down();
  await page.mouse.move(q.x, q.y, { steps: 4 });
  await page.mouse.up();
  await becomes('the front has moved');
  assert.deepEqual(await centre(), before);
});

test('a wall that is dragged outward stays in the plan', async () => {
  await preview.save(page, 'plain.hsd', HOUSE);
  await page.waitForTimeout(100);
  await does(page, 'fit').click();
  const [p, sheet] = [await at(2.5, 4), (await page.locator('.sheet').boundingBox())!];
  const shown = () => page.evaluate(() => hsd.plan.sheet.frame.y);
  const top = await shown();
  await page.mouse.move(p.x, p.y);
  await page.mouse.down();
  await page.mouse.move(p.x, sheet.y + 2, { steps: 4 });
  await until(async () => await shown() < top - 1, 'the sheet follows the pointer at its edge');
  await page.mouse.up();
  await becomes('the wall has moved');
  const clear = await page.evaluate(() => {
    const sheet = document.querySelector('.sheet')!.getBoundingClientRect();
    return [...document.querySelectorAll('.run .base')].every(e => { const { top, bottom } = e.getBoundingClientRect(); return top >= sheet.top && bottom <= sheet.bottom; });
  });
  assert.ok(clear, 'all walls are in the sheet');
});

test('what was said of one file is gone with it', async () => {
  assert.notEqual(await page.locator('.status').textContent(), '');
  await open('machiya.hsd');
  assert.equal(await page.locator('.status').textContent(), '');
});

test('on a phone the house is whole with the panel open, and the plan keeps its room while drawing', async () => {
  const phone = await preview.open('?file=machiya.hsd', { viewport: { width: 390, height: 844 }, hasTouch: true });
  const whole = () => phone.evaluate(async () => {
    await hsd.settled();
    const { min, max } = hsd.app.model!.box, corner = min.clone();
    return [0, 1, 2, 3, 4, 5, 6, 7].every(i => {
      corner.set(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z).project(hsd.viewport.camera);
      return Math.abs(corner.x) <= 1 && Math.abs(corner.y) <= 1;
    });
  });
  assert.ok(await whole(), 'without the panel');
  await does(phone, 'panel').tap();
  await until(whole, 'the roof is not cut off by the panel');
  await does(phone, 'plan').tap();
  await does(phone, 'draw').tap();
  for (const tool of ['part', 'wall', 'survey']) {
    await phone.locator(`.tools input[value=${tool}]`).check();
    const { height } = (await phone.locator('.sheet').boundingBox())!;
    assert.ok(height > 220, `${height} px with the panel open, ${tool}`);
  }
  await phone.context().close();
});

test('no requests to other hosts, no errors', () => preview.assertClean());
