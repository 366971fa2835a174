// The cost of reflections: in a town with 1, 10 and 50 visible glass facades, in one plane and each in its own plane, and in
// a town four times as large whose additional houses no mirror sees. BENCH=FILE writes the table to a file; without it the
// towns are as small as the comparisons allow.

import assert from 'node:assert/strict';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import type { Browser } from 'playwright-core';
import { browser, built, served } from './chromium.ts';
import type { Drawn, Shot } from './mirror-page.ts';
import { temporaryFolder } from './temporary.ts';
import { town } from './town.ts';

const here = dirname(fileURLToPath(import.meta.url)), folder = temporaryFolder();
const BENCH = process.env['BENCH'], FRAMES = BENCH ? 6 : 1;
const SHOT: Shot = { eye: [-25, 12, 26], target: [60, 0, -10], fov: 50, width: BENCH ? 640 : 320, height: BENCH ? 400 : 200, options: { pixels: 4, shift: 0.5 } };
/** Houses on each side of the street; glass facades among them, all and some. */
const LONG = BENCH ? 50 : 10, MANY = LONG, SOME = LONG / 5, ROWS = BENCH ? 6 : 2;
/** [glass facades, rows of houses behind, each in a plane of its own] */
const TOWNS: [glass: number, rows: number, apart: boolean][] = [
  [1, 0, true], [SOME, 0, true], [MANY, 0, true], [MANY, 0, false], [SOME, ROWS, true], [MANY, ROWS, true], [MANY, ROWS, false],
];
/** What the file has below the table, from the other renderer. */
function other(file: string): string {
  const text = existsSync(file) ? readFileSync(file, 'utf8') : '', at = text.indexOf('\n# The share');
  return at < 0 ? '' : text.slice(at);
}
/** Without `BENCH`, only what the comparisons need. */
const RUN = TOWNS.filter(([glass, rows]) => BENCH || glass > 1 && (rows === 0 || glass === SOME));

interface Measured extends Drawn {
  houses: number;
  all: number;
  /** Frame time without reflections, milliseconds. */
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
  if (BENCH && measured.size === TOWNS.length) writeFileSync(BENCH, table(chromium?.version() ?? '') + other(BENCH));
});

for (const of of RUN) {
  const [glass, rows, apart] = of;
  test(`${glass} glass facades${apart ? ', each in a plane of its own,' : ' in one plane'} in a town of ${houses(rows)} houses`, async t => {
    const page = await chromium.newPage();
    await page.goto(url);
    const result = await page.evaluate(async ([file, shot, frames]) => {
      const it = window.page(true), { triangles } = await it.load(file, false);
      const without = await it.measure({ ...shot, options: { ...shot.options, on: false, cullOccluded: false } }, frames);
      return { ...await it.measure(shot, frames), all: triangles, without: without.ms };
    }, [name(...of), SHOT, FRAMES] as const);
    await page.close();
    measured.set(name(...of), { ...result, houses: houses(rows) });
    const { stats } = result;
    t.diagnostic(`${stats.drawn} mirrors, ${stats.calls} calls, ${stats.triangles} triangles, ${stats.tested} boxes; found in ${stats.find.toFixed(1)} ms; frame ${result.ms.toFixed(0)} ms, ${result.without.toFixed(0)} ms without`);
    assert(stats.drawn > 0 && stats.calls > 0);
  });
}

test('the cost of reflections depends on what their beams contain, not on the size of the town', () => {
  for (const [glass, apart] of [[SOME, true], [MANY, true], [MANY, false]] as const) {
    const small = measured.get(name(glass, 0, apart))!, large = measured.get(name(glass, ROWS, apart));
    if (!large) continue;
    assert(large.all > small.all * (1 + ROWS / 3));
    for (const what of ['drawn', 'calls', 'triangles', 'chunks', 'pixels'] as const) {
      assert.equal(large.stats[what], small.stats[what], `${what} of ${glass} facades`);
    }
    assert(large.stats.tested < small.stats.tested * 1.5, 'more boxes make the tree slightly deeper');
  }
});

test('neighbours in one plane share one image', () => {
  const rows = measured.get(name(MANY, 0, false))!.stats, apart = measured.get(name(MANY, 0, true))!.stats;
  assert(rows.drawn < apart.drawn / 4 && rows.calls < apart.calls / 2, `${rows.drawn}, ${apart.drawn}`);
});

function table(version: string): string {
  const rows = TOWNS.map(of => {
    const { houses, all, stats, ms, without } = measured.get(name(...of))!;
    const cells = [of[0], of[2] ? 'separate' : 'one', houses, all, stats.drawn, stats.calls, stats.triangles, stats.tested, stats.find.toFixed(1), ms.toFixed(0), without.toFixed(0)];
    return `| ${cells.join(' | ')} |`;
  });
  return `# The cost of reflections

Written by \`BENCH=test/mirror-bench.md node test/browser/run.mjs HSD mirror-bench\`: a street of 100 houses, up to 50 of them with a glass front, seen along its
length at 640 x 400 with recursion depth 1; panes share an image if that shifts it by at most half a pixel. Chromium ${version} with software rendering (SwiftShader), so that triangles and
pixels are far more expensive than on a GPU: compare the columns with each other. Times are the shortest of several frames, on two cores shared with other programs, and
accurate to about a third. "Search" is the CPU time to find the beams and their contents. In towns of 400 houses the additional houses stand behind the glass, where no beam goes: draw
calls and triangles of the reflections are the same.

| glass facades | planes | houses | triangles of the town | mirrors drawn | draw calls of reflections | triangles of reflections | boxes tested | search, ms | frame, ms | without reflections, ms |
|---|---|---|---|---|---|---|---|---|---|---|
${rows.join('\n')}
`;
}
