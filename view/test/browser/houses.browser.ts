// Incremental reload: a save reads only the houses that have changed, and the result equals that of a fresh page.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import type { Page } from 'playwright-core';
import { brightness, differ, does, Preview } from './preview.ts';
import { town } from './town.ts';

const FILE = 'town.hsd', text = town(3, 1, 1, true);
const houses = text.trim().split('\n').slice(1, -1);

/** The source with its list of houses changed. */
const changed = (change: (list: string[]) => string[]) => `<Houses>\n${change([...houses]).join('\n')}\n</Houses>\n`;

/** Moves a house, metres. */
const moved = (x: number, y: number) => (house: string) =>
  house.replace(/ x="([^"]*)" y="([^"]*)"/, (_, fromX, fromY) => ` x="${Number(fromX) + x}" y="${Number(fromY) + y}"`);

/** Rendering is compared only in the last test. */
const SMALL = { viewport: { width: 640, height: 360 } };

let preview: Preview, page: Page;
const shown = (): [Preview, Page] => [preview, page];

before(async () => {
  preview = await Preview.of([[FILE, text]]);
  page = await preview.open(`?file=${FILE}`, SMALL);
});
after(async () => { await preview?.close(); });

/** The complete model, lengths in the file's frame, and the number of its meshes that are in `globalThis.held`. */
const model = (page: Page) => page.evaluate(() => {
  const { parts, chunks, box, triangles, houses, keys, origin } = hsd.app.model!;
  const ends = ({ min, max }: typeof box) => [min.clone().add(origin).toArray(), max.clone().add(origin).toArray()];
  const sums = (name: string, { geometry }: (typeof chunks)[0]['mesh']) => {
    const list = geometry.getAttribute(name), sums = [0, 0, 0, 0];
    for (let i = 0; i < (list?.count ?? 0); i++) for (let k = 0; k < list!.itemSize; k++) sums[k]! += list!.getComponent(i, k) / list!.count;
    return name === 'position' ? sums.slice(0, 3).map((sum, k) => sum + origin.toArray()[k]!) : sums;
  };
  const held = (globalThis as { held?: Set<unknown> }).held;
  return {
    kept: chunks.filter(chunk => held?.has(chunk.mesh)).length,
    all: {
      triangles, houses, keys, box: ends(box),
      parts: parts.map(({ box, front, ...part }) => ({ ...part, front: front?.toArray() ?? null, box: box.isEmpty() ? null : ends(box) })),
      chunks: chunks.map(({ mesh, box, ...chunk }) => ({
        ...chunk, box: ends(box), material: mesh.material.name, metal: mesh.material.metalness, shown: mesh.visible,
        arrays: ['position', 'normal', 'tangent', 'uv', 'mirrorLayer'].map(name => sums(name, mesh)), order: [...mesh.geometry.index!.array.slice(0, 12)],
      })),
    },
  };
});

/** Asserts equality up to f32 rounding. */
function alike(a: unknown, b: unknown, at = 'model') {
  if (typeof a === 'number' && typeof b === 'number') assert.ok(Math.abs(a - b) < 2e-3, `${at}: ${a} and ${b}`);
  else if (a && b && typeof a === 'object' && typeof b === 'object') {
    assert.deepEqual(Object.keys(a), Object.keys(b), at);
    for (const [key, value] of Object.entries(a)) alike(value, (b as Record<string, unknown>)[key], `${at}.${key}`);
  } else assert.equal(a, b, at);
}

/** Saves a source file and compares the page with a fresh one; returns how many meshes were kept. */
async function saved(text: string, [preview, page] = shown()): Promise<{ kept: number; of: number }> {
  await page.evaluate(() => { (globalThis as { held?: Set<unknown> }).held = new Set(hsd.app.model!.chunks.map(chunk => chunk.mesh)); });
  await preview.save(page, FILE, text);
  await page.evaluate(() => hsd.settled());
  const now = await model(page), fresh = await preview.open(`?file=${FILE}`, SMALL);
  alike(now.all, (await model(fresh)).all);
  await fresh.context().close();
  return { kept: now.kept, of: now.all.chunks.length };
}

test('a comment shifts all spans, and no mesh is read again', async () => {
  await page.evaluate(() => hsd.select(hsd.find('TKD 2').at(-1)!));
  const before = await page.evaluate(() => hsd.selection!);
  const { kept, of } = await saved(`<!-- 通り -->\n${text}`);
  assert.equal(kept, of);
  const { number, span } = await page.evaluate(() => hsd.selection!);
  assert.equal(number, before.number);
  assert.equal(span![0], before.span![0] + new TextEncoder().encode('<!-- 通り -->\n').length);
  await page.evaluate(() => hsd.select(null));
});

test('only the meshes of the changed house are replaced', async t => {
  const reading = () => page.evaluate(() => hsd.reload!.parsed - hsd.reload!.fetched);
  const took: number[] = [];
  const most = async (change: (list: string[]) => string[], others: number) => {
    const { kept, of } = await saved(changed(change));
    assert.ok(kept > of * others && kept < of, `${kept} of ${of} are kept`);
    took.push(await reading());
  };
  const front = houses.findIndex(house => house.includes('NGC'));
  await most(list => list.with(1, list[1]!.replace('KTU  KTU  TKD 2', 'KTU  MRE  TKD 2')), 0.7);
  await most(list => list.with(4, list[4]!.replace('</Storey>', '</Storey><Storey height="8"><Row>KTU  KTU</Row><Row>KTU</Row><Row>KTU  KTU</Row><Row>KTU</Row></Storey>')), 0.6);
  await most(list => list.with(front, list[front]!.replace('reflection="0.7"', 'reflection="0.3"')), 0.6);
  const nothing = await saved(changed(list => list.map(moved(0, 1))));
  assert.equal(nothing.kept, 0);
  const all = await reading();
  t.diagnostic(`read in ${took.map(ms => ms.toFixed(0)).join(', ')} ms; all of them in ${all.toFixed(0)} ms`);
});

test('houses can be added, removed, reordered and duplicated', async () => {
  await preview.save(page, FILE, text);
  const gone = await saved(changed(list => list.toSpliced(2, 3)));
  assert.equal(gone.kept, gone.of);
  await preview.save(page, FILE, text);
  const turned = await saved(changed(list => list.reverse()));
  assert.equal(turned.kept, turned.of);
  const twice = await saved(changed(list => [...list, list[0]!, list[0]!]));
  assert.ok(twice.kept < twice.of);
  await saved(changed(list => list.map(moved(0, 12))));
});

test('hidden layers stay hidden, and picking hits what is visible', async () => {
  await page.evaluate(() => hsd.app.hide('roof 1', true));
  await preview.save(page, FILE, changed(list => list.with(1, list[1]!.replace('TKD 2', 'TIT 2'))));
  const wrong = await page.evaluate(() => hsd.app.model!.chunks.filter(c => c.mesh.visible !== (hsd.app.layerOf(c) !== 'roof 1')).length);
  assert.equal(wrong, 0);
  await does(page, 'reset').click();
  const door = await page.evaluate(async () => {
    const part = hsd.find('TIT 2').find(part => hsd.app.model!.parts[part]!.house === 1)!, { max, min } = hsd.app.model!.parts[part]!.box;
    const middle = max.clone().add(min).divideScalar(2), out = hsd.app.model!.parts[hsd.app.model!.parts[part]!.facade!]!.front!;
    hsd.camera = [...middle.clone().addScaledVector(out, 3).toArray(), ...middle.toArray()];
    await hsd.settled();
    const [x, y] = hsd.positionOf(part);
    return { part, picked: hsd.pick(x!, y!) };
  });
  const below = await page.evaluate(({ part, picked }) => picked !== null && picked >= part && picked < hsd.app.model!.parts[part]!.end, door);
  assert.ok(below, JSON.stringify(door));
});

test('a town that moves far away stays in view', async () => {
  const before = await page.evaluate(() => hsd.app.model!.origin.toArray());
  await saved(changed(list => list.map(moved(9000, 0))));
  const now = await page.evaluate(() => ({ origin: hsd.app.model!.origin.toArray(), min: hsd.app.model!.box.min.x, max: hsd.app.model!.box.max.x }));
  assert.notDeepEqual(now.origin, before);
  assert.ok(now.min < 0 && now.max > 0, `from ${now.min} to ${now.max}`);
});

test('a texture that failed to load is retried with the next save', async () => {
  const own = await Preview.of([[FILE, text]]), other = await own.open('?file=none.hsd', SMALL, false);
  let lost = 0;
  await other.route('**/house_textures/**', route => lost++ === 0 ? route.abort() : route.continue());
  await other.goto(`${own.url}?file=${FILE}`);
  await other.waitForSelector('html[data-revision]', { state: 'attached' });
  const bare = () => other.evaluate(() => hsd.app.model!.chunks.reduce((sum, { mesh: { material } }) =>
    sum + [material.map, material.normalMap, material.roughnessMap].filter(Boolean).length, 0) / hsd.app.model!.chunks.length);
  const before = await bare();
  await own.save(other, FILE, `${text}\n`);
  assert.ok(lost > 1 && await bare() > before, `${before} pictures a chunk became ${await bare()}`);
  await own.close();
});

test('a lower level of detail is shown on request', async () => {
  const coarse = await Preview.of([[FILE, text]], '--detail', '1');
  try {
    const far = await coarse.open(`?file=${FILE}`, SMALL), count = (page: Page) => page.evaluate(() => hsd.app.model!.triangles);
    await preview.save(page, FILE, `${text}\n`);
    const [few, all] = [await count(far), await count(page)];
    assert.ok(few < all / 2, `${few} of ${all} triangles`);
    await saved(changed(list => list.with(1, list[1]!.replace('KTU  KTU  TKD 2', 'KTU  MRE  TKD 2'))), [coarse, far]);
    const { kept, of } = await saved(changed(list => list.with(1, list[1]!.replace('KTU  KTU  TKD 2', 'KTU  MRE  TKD 2')).toSpliced(7, 1)), [coarse, far]);
    assert.equal(kept, of);
    coarse.assertClean();
  } finally {
    await coarse.close();
  }
});

test('many changes leak nothing and look like a fresh page', async () => {
  const held = () => page.evaluate(() => {
    hsd.viewport.updateShadows();
    hsd.viewport.frame(); // Shadows of the whole model.
    return { ...hsd.viewport.renderer.info.memory, programs: hsd.viewport.renderer.info.programs!.length };
  });
  const other = changed(list => list.with(5, list[5]!.replace('KTU  KTU  TKD 2', 'KTU  MRE  TKD 2')));
  for (const textNow of [text, other, text, other]) await preview.save(page, FILE, textNow);
  const first = await held();
  for (let i = 0; i < 3; i++) for (const now of [text, other]) await preview.save(page, FILE, now);
  const last = await held();
  const looksOf = (page: Page) => page.evaluate(() => new Set(hsd.app.model!.chunks.map(chunk => chunk.mesh.material)).size);
  assert.ok(last.geometries <= first.geometries + 2 && last.textures <= first.textures + 2 && last.programs <= first.programs + 1,
    `${JSON.stringify(first)} became ${JSON.stringify(last)}`);
  // Materials are shared by houses that were loaded at different times.
  const anew = await preview.open(`?file=${FILE}`, SMALL);
  assert.equal(await looksOf(page), await looksOf(anew));
  await anew.context().close();
  // Metal keeps its reduced metalness, however often its houses were kept.
  const metals = await page.evaluate(() => hsd.app.model!.chunks.map(chunk => chunk.mesh.material.metalness).filter(metal => metal > 0));
  assert.ok(metals.length > 0 && metals.every(metal => metal === 0.3), metals.join(' '));
  // Rendered images agree, including glass.
  const fresh = await preview.open(`?file=${FILE}`, SMALL), looks: number[][] = [];
  for (const one of [page, fresh]) {
    await one.evaluate(() => {
      const { origin } = hsd.app.model!;
      hsd.camera = [10 - origin.x, 2, 6 - origin.z, 8 - origin.x, 2, 0 - origin.z];
    });
    await one.evaluate(() => hsd.settled());
    looks.push(await brightness(one));
  }
  assert.ok(differ(looks[0]!, looks[1]!, 0.06) < 0.02, `${differ(looks[0]!, looks[1]!, 0.06)} of the places differ`);
  preview.assertClean();
});
