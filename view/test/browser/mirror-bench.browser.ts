// What mirrors cost: in a town with 1, 10 and 50 glass facades in sight, in rows and each in a plane of its own; and the
// same in a town four times as large, the rest of which no mirror looks at. BENCH=FILE writes the table there; without it
// towns are smaller, as far as the comparisons allow.

import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import type { Browser } from 'playwright-core';
import { browser, built, served } from './chromium.ts';
import type { Drawn, Shot } from './mirror-page.ts';
import { scratch } from './scratch.ts';
import { town } from './town.ts';

const here = dirname(fileURLToPath(import.meta.url)), folder = scratch();
const BENCH = process.env['BENCH'], FRAMES = BENCH ? 6 : 1;
const SHOT: Shot = { eye: [-25, 12, 26], target: [60, 0, -10], fov: 50, width: BENCH ? 640 : 320, height: BENCH ? 400 : 200, options: { pixels: 4, shift: 0.5 } };
/** Houses on each side of the street; glass facades among them: all, and some. */
const LONG = BENCH ? 50 : 10, MANY = LONG, SOME = LONG / 5, ROWS = BENCH ? 6 : 2;
/** [glass facades, rows of houses behind, whether each lies in a plane of its own] */
const TOWNS: [glass: number, rows: number, apart: boolean][] = [
  [1, 0, true], [SOME, 0, true], [MANY, 0, true], [MANY, 0, false], [SOME, ROWS, true], [MANY, ROWS, true], [MANY, ROWS, false],
];
/** Without `BENCH` only what the comparisons need. */
const RUN = TOWNS.filter(([glass, rows]) => BENCH || glass > 1 && (rows === 0 || glass === SOME));

interface Measured extends Drawn {
  houses: number;
  all: number;
  /** Of a frame without mirrors. */
  without: number;
}

const models: Record<string, Uint8Array> = {}, measured = new Map<string, Measured>();
const houses = (rows: number) => LONG * (2 + rows);
const name = (glass: number, rows: number, apart: boolean) => `${glass}-${rows}-${apart}.glb`;
let chromium: Browser, url: string, close: () => void;

before(async () => {
  for (const of of RUN) {
    const text = join(folder, 'town.hsd');
    writeFileSync(text, town(LONG, ...of));
    models[name(...of)] = built(text);
  }
  ({ url, close } = await served(join(here, 'mirror-page.ts'), models));
  chromium = await browser();
});

after(async () => {
  await chromium?.close();
  close?.();
  if (BENCH && measured.size === TOWNS.length) writeFileSync(BENCH, table(chromium?.version() ?? ''));
});

for (const of of RUN) {
  const [glass, rows, apart] = of;
  test(`${glass} glass facades${apart ? ', each in a plane of its own,' : ' in one plane'} in a town of ${houses(rows)} houses`, async t => {
    const page = await chromium.newPage();
    await page.goto(url);
    const result = await page.evaluate(async ([file, shot, frames]) => {
      const it = window.page(true), { triangles } = await it.load(file, false);
      const without = await it.measure({ ...shot, options: { ...shot.options, on: false, probe: false } }, frames);
      return { ...await it.measure(shot, frames), all: triangles, without: without.ms };
    }, [name(...of), SHOT, FRAMES] as const);
    await page.close();
    measured.set(name(...of), { ...result, houses: houses(rows) });
    const { stats } = result;
    t.diagnostic(`${stats.drawn} mirrors, ${stats.calls} calls, ${stats.triangles} triangles, ${stats.tested} boxes; found in ${stats.find.toFixed(1)} ms; frame ${result.ms.toFixed(0)} ms, ${result.without.toFixed(0)} ms without`);
    assert(stats.drawn > 0 && stats.calls > 0);
  });
}

test('mirrors cost what their beams see, not what the town has', () => {
  for (const [glass, apart] of [[SOME, true], [MANY, true], [MANY, false]] as const) {
    const small = measured.get(name(glass, 0, apart))!, large = measured.get(name(glass, ROWS, apart));
    if (!large) continue;
    assert(large.all > small.all * (1 + ROWS / 3));
    for (const what of ['drawn', 'calls', 'triangles', 'chunks', 'pixels'] as const) {
      assert.equal(large.stats[what], small.stats[what], `${what} of ${glass} facades`);
    }
    assert(large.stats.tested < small.stats.tested * 1.5, 'more boxes make the tree a little higher');
  }
});

test('neighbours in one plane show one picture', () => {
  const rows = measured.get(name(MANY, 0, false))!.stats, apart = measured.get(name(MANY, 0, true))!.stats;
  assert(rows.drawn < apart.drawn / 4 && rows.calls < apart.calls / 2, `${rows.drawn}, ${apart.drawn}`);
});

function table(version: string): string {
  const rows = TOWNS.map(of => {
    const { houses, all, stats, ms, without } = measured.get(name(...of))!;
    const cells = [of[0], of[2] ? 'own planes' : 'one plane', houses, all, stats.drawn, stats.calls, stats.triangles, stats.tested, stats.find.toFixed(1), ms.toFixed(0), without.toFixed(0)];
    return `| ${cells.join(' | ')} |`;
  });
  return `# What mirrors cost

Written by \`BENCH=test/mirror-bench.md node test/browser/run.mjs HSD mirror-bench\`: a street of 100 houses, up to 50 of them with a glass
front, seen along its length at 640 x 400, recursion 1, pictures shared where that shifts nothing by more than half a pixel. Chromium ${version} without a graphics card (SwiftShader), so triangles and pixels cost far more than
on one: compare the columns with each other. Times are the least of several
frames, on two processors that other programs used as well: good to a third at best. "Found" is the processor's time to find the beams and what lies in them.
Towns of 400 houses have the rest behind the glass, where no beam goes: calls and triangles of the mirrors are the same.

| glass facades | lie in | houses | triangles of the town | mirrors drawn | draw calls of mirrors | triangles of mirrors | boxes tested | found, ms | frame, ms | without mirrors, ms |
|---|---|---|---|---|---|---|---|---|---|---|
${rows.join('\n')}
`;
}
