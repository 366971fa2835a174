// The page's reflections compared pixel by pixel with a ray caster, for various cameras and recursion depths.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Browser, Page } from 'playwright-core';
import { ofBytes } from '../colours.ts';
import { type Camera, Scene } from '../raycast.ts';
import { browser, built, served } from './chromium.ts';
import type { Drawn, Shot } from './mirror-page.ts';
import { temporaryFolder } from './temporary.ts';

const here = dirname(fileURLToPath(import.meta.url)), SIZE = { width: 240, height: 150 }, SKY = ofBytes(150, 180, 210);
/** Nothing is skipped or shared. */
const EXACT = { cullOccluded: false, shift: 0, pixels: 0, views: 64, side: 4096 };

/** Pixels in which one of the two images looks through a crack between parts as narrow as rounding errors. */
const CRACKS = 10;

let chromium: Browser, page: Page, url: string, close: () => void, cast: Scene, whole: Scene;

before(async () => {
  const model = built(join(here, '../scenes/two.hsd'));
  cast = new Scene(model);
  const text = readFileSync(join(here, '../scenes/two.hsd'), 'utf8'), other = join(temporaryFolder(), 'whole.hsd');
  writeFileSync(other, text.replaceAll(/reflection="0\.\d+"/g, 'reflection="1"'));
  const mirror = built(other);
  whole = new Scene(mirror);
  ({ url, close } = await served(join(here, 'mirror-page.ts'), { 'two.glb': model, 'whole.glb': mirror }));
  chromium = await browser();
  page = await chromium.newPage();
  page.on('pageerror', error => { throw error; });
  await page.goto(url);
  await page.evaluate(async () => {
    const it = Object.assign(window, { it: window.page(false) }).it;
    await it.load('two.glb', true);
  });
});

after(async () => {
  await chromium?.close();
  close?.();
});

async function drawn(shot: Shot, settled = false): Promise<{ drawn: Drawn; pixels: Uint8Array }> {
  const { text, errors, ...rest } = await page.evaluate(async ([shot, settled]) => {
    const { it } = window as unknown as { it: ReturnType<Window['page']> };
    return { drawn: settled ? await it.settle(shot) : it.draw(shot), text: it.pixels(), errors: it.errors() };
  }, [shot, settled] as const);
  assert.deepEqual(errors, [], 'no WebGL errors');
  return { ...rest, pixels: new Uint8Array(Buffer.from(text, 'base64')) };
}

type Eye = Pick<Camera, 'eye' | 'target' | 'fov'>;

/** Fraction of pixels that agree within 3 of 255, and the number of the others that are not at an edge. */
function compared(pixels: Uint8Array, eye: Eye, depth: number): { same: number; loose: number; right: Uint8Array } {
  const { width, height } = SIZE, camera = { ...eye, ...SIZE }, right = cast.picture(camera, depth, SKY);
  let wrong = 0, loose = 0;
  for (let at = 0; at < width * height; at++) {
    const is = pixels.subarray(at * 4, at * 4 + 3), should = right.subarray(at * 3, at * 3 + 3);
    if (!apart(is, should)) continue;
    wrong++;
    if (!edge(camera, at % width, Math.floor(at / width), depth)) loose++;
  }
  return { same: 1 - wrong / (width * height), loose, right };
}

const apart = (a: ArrayLike<number>, b: ArrayLike<number>) => [0, 1, 2].some(i => Math.abs(a[i]! - b[i]!) > 3);

/** True if rays through a pixel or within half a pixel of it do not all have the same colour. */
function edge(camera: Camera, x: number, y: number, depth: number): boolean {
  const middle = cast.seen(camera, x + 0.5, y + 0.5, depth, SKY), steps = [-0.8, -0.4, 0, 0.4, 0.8];
  return steps.some(u => steps.some(v => apart(middle, cast.seen(camera, x + 0.5 + u, y + 0.5 + v, depth, SKY))));
}

const EYES: [name: string, eye: Eye][] = [
  ['across the street', { eye: [-1.5, 2.2, 6.2], target: [-4, 2.4, 0], fov: 50 }],
  ['close and slanting', { eye: [1.2, 1.6, 1.5], target: [-5, 2.6, 0.5], fov: 60 }],
  ['from above', { eye: [-7, 9, 14], target: [-3.5, 2, 1], fov: 40 }],
  ['before a pane', { eye: [-3.2, 4.6, 1.4], target: [-3.8, 4.4, 0], fov: 80 }],
  ['at the south house', { eye: [-4, 3, 2.2], target: [-4.5, 2, 7], fov: 65 }],
  ['round the corner', { eye: [5, 4, 3], target: [-1, 3.5, -1], fov: 50 }],
];

for (const depth of [0, 1, 2, 3, 4]) {
  for (const [name, eye] of depth < 3 ? EYES : EYES.slice(0, 1)) {
    test(`depth ${depth}, ${name}`, async t => {
      const { pixels, drawn: { stats } } = await drawn({ ...eye, ...SIZE, options: { ...EXACT, depth } });
      const { same, loose, right } = compared(pixels, eye, depth);
      t.diagnostic(`${(same * 100).toFixed(2)} % agree, ${loose} off edges; ${stats.drawn} mirrors, ${stats.calls} calls`);
      if (process.env['KEEP']) await keep(`${depth}-${name}`, pixels, right);
      assert(same >= 0.985, `${same}`);
      assert(loose <= CRACKS, `${loose} pixels differ off edges`);
      assert.equal(stats.depth <= depth, true);
      assert.equal(stats.drawn > 0, depth > 0);
    });
  }
}

test('the comparison detects missing reflections and a camera shifted by 20 cm', async () => {
  const [, eye] = EYES[0]!;
  const good = compared((await drawn({ ...eye, ...SIZE, options: { ...EXACT, depth: 1 } })).pixels, eye, 1);
  const without = compared((await drawn({ ...eye, ...SIZE, options: { ...EXACT, on: false } })).pixels, eye, 1);
  assert(without.same < 0.985 && without.loose > 200, `${without.same}, ${without.loose}`);
  const [x, y, z] = eye.eye, beside: Eye = { ...eye, eye: [x + 0.2, y, z] };
  const moved = compared((await drawn({ ...beside, ...SIZE, options: { ...EXACT, depth: 1 } })).pixels, eye, 1);
  assert(moved.same < 0.985 && moved.loose > 200, `${moved.same}, ${moved.loose}`);
  assert(good.same > 0.99);
});

test('occluded glass is not mirrored until the camera rises above the house', async () => {
  const behind: Eye = { eye: [-5, 1.5, 12], target: [-5, 1.5, 0], fov: 50 }, above: Eye = { ...behind, eye: [-5, 7, 13] };
  const options = { ...EXACT, cullOccluded: true, depth: 1 };
  const first = await drawn({ ...behind, ...SIZE, options });
  assert(first.drawn.stats.drawn > 0, 'occlusion is not known yet');
  const hidden = await drawn({ ...behind, ...SIZE, options }, true);
  assert.equal(hidden.drawn.stats.drawn, 0);
  assert.equal(hidden.drawn.stats.calls, 0);
  assert(hidden.drawn.stats.hidden > 0);
  assert(compared(hidden.pixels, behind, 1).same > 0.99);
  const { drawn: { stats }, pixels } = await drawn({ ...above, ...SIZE, options }, true);
  assert(stats.drawn > 0);
  assert(compared(pixels, above, 1).same >= 0.985);
});

test('panes of several depths share an image with little shift', async t => {
  const [, eye] = EYES[0]!, shots = await Promise.all([0, 100].map(shift => drawn({ ...eye, ...SIZE, options: { ...EXACT, depth: 1, shift } })));
  const [exact, shared] = shots.map(shot => shot.drawn.stats.drawn);
  assert(shared! < exact!);
  const { same } = compared(shots[1]!.pixels, eye, 1);
  t.diagnostic(`${(same * 100).toFixed(2)} % agree; ${shared} mirrors instead of ${exact}`);
  assert(same > 0.96);
});

test('a smaller atlas gives coarser images, not wrong ones', async t => {
  const [, eye] = EYES[0]!, { drawn: { stats }, pixels } = await drawn({ ...eye, ...SIZE, options: { ...EXACT, depth: 2, side: 128 } });
  assert(stats.scale < 0.8 && stats.drawn > 3);
  const { same } = compared(pixels, eye, 2);
  t.diagnostic(`${(same * 100).toFixed(2)} % agree at scale ${stats.scale.toFixed(2)}`);
  assert(same > 0.9);
});

test('objects behind clear glass are visible through it', async t => {
  const load = (cover: number) => page.evaluate(async cover => {
    await (window as unknown as { it: ReturnType<Window['page']> }).it.load('two.glb', true, cover);
  }, cover);
  await load(0.35);
  cast.cover = 0.35;
  try {
    for (const [name, eye] of EYES.slice(0, 2)) {
      const { pixels } = await drawn({ ...eye, ...SIZE, options: { ...EXACT, depth: 2 } }), { same, right } = compared(pixels, eye, 2);
      t.diagnostic(`${(same * 100).toFixed(2)} % agree`);
      if (process.env['KEEP']) await keep(`clear-${name}`, pixels, right);
      assert(same >= 0.985, `${same}`);
    }
  } finally {
    cast.cover = 1;
    await load(1);
  }
});

test('a perfect mirror shows the light and shadows that an eye behind it would see', async t => {
  const [, eye] = EYES[0]!, lit = await chromium.newPage();
  await lit.goto(url);
  const [mirrored, direct] = await lit.evaluate(async shot => {
    const it = window.page(false);
    await it.load('whole.glb', false);
    it.draw(shot);
    const mirrored = it.pixels();
    it.behind(shot, 0.055); // The plane of the curtain wall's panes.
    return [mirrored, it.pixels()];
  }, { ...eye, ...SIZE, options: { ...EXACT, depth: 1 } } as Shot).then(all => all.map(text => new Uint8Array(Buffer.from(text, 'base64'))));
  await lit.close();
  let all = 0, same = 0;
  const sky = direct!.subarray(direct!.length - 4); // The background is not tone-mapped where it is seen directly.
  for (let y = 0; y < SIZE.height; y++) {
    for (let x = 0; x < SIZE.width; x++) {
      const glass = whole.glass({ ...eye, ...SIZE }, x + 0.5, y + 0.5);
      if (!glass || glass.share !== 1 || Math.abs(glass.at[2] - 0.055) > 1e-4) continue;
      const own = (y * SIZE.width + x) * 4, across = (y * SIZE.width + SIZE.width - 1 - x) * 4;
      const is = mirrored!.subarray(own, own + 3), should = direct!.subarray(across, across + 3);
      if (!apart(should, sky)) continue;
      all++;
      if (!apart(is, should)) same++;
    }
  }
  t.diagnostic(`${(100 * same / all).toFixed(2)} % of ${all} agree`);
  assert(all > 5000, 'enough of the ground and the neighbour is visible');
  assert(same / all >= 0.985, `${same / all}`);
});

/** Keeps both images side by side for inspection. */
async function keep(name: string, pixels: Uint8Array, right: Uint8Array) {
  const { writeFile } = await import('node:fs/promises');
  const { width, height } = SIZE, rows: string[] = [`P3 ${width * 2} ${height} 255`];
  for (let y = height - 1; y >= 0; y--) {
    for (let x = 0; x < width; x++) rows.push([...pixels.subarray((y * width + x) * 4, (y * width + x) * 4 + 3)].join(' '));
    for (let x = 0; x < width; x++) rows.push([...right.subarray((y * width + x) * 3, (y * width + x) * 3 + 3)].join(' '));
  }
  await writeFile(`${process.env['KEEP']}/${name.replaceAll(' ', '_')}.ppm`, rows.join('\n'));
}
