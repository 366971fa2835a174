import assert from 'node:assert/strict';
import { test } from 'node:test';
import { bounds, metresToPlan, path, toHouse, toPlan } from '../src/plan/coordinates.ts';
import { fallArrow, ridgeLines } from '../src/plan/ridges.ts';
import type { House, Region } from '../src/server/api.ts';

const house = (azimuth: number): House => ({
  name: '', azimuth, origin: [10, 20, 0], unit_m: 1, storeys: [], roofs: [], street: false, fixed: null, file: 0, span: [0, 0],
});
const region = (more: Partial<Region>): Region => ({
  a0: 0, b0: 0, a1: 12, b1: 5, ridge: 'a', fall: null, role: 'main', shape: 'KIR', over: null, ...more,
});

test('the plan is a map: left of a south front is west, its back is north, north is up', () => {
  assert.deepEqual(toPlan(house(180), [3, 2]), [7, -22]);
  // A front to the east: left is south, back is west.
  assert.deepEqual(toPlan(house(90), [3, 2]), [8, -17]);
  // To the north: left is east, back is south.
  assert.deepEqual(toPlan(house(0), [3, 2]), [13, -18]);
  assert.deepEqual(toPlan(house(270), [3, 2]), [12, -23]);
});

test('the inverse transform', () => {
  for (const azimuth of [0, 45, 90, 123.4, 180, 270]) {
    const [a, b] = toHouse(house(azimuth), toPlan(house(azimuth), [3.5, -2]));
    assert.ok(Math.abs(a - 3.5) < 1e-9 && Math.abs(b + 2) < 1e-9, `${azimuth}: ${a} ${b}`);
  }
});

test('the pixels of a scan lie in the plan where the house has them', () => {
  // 100 pixels a metre; the right end of the front is at pixel 500, 700.
  const sheet = [-0.01, 0, 0, -0.01, 5, 7] as const, at = ([a, b, c, d, e, f]: readonly number[], x: number, y: number) => [a! * x + c! * y + e!, b! * x + d! * y + f!];
  for (const azimuth of [180, 90, 0, 270, 33]) {
    const own = { ...house(azimuth), unit_m: 0.5 }, matrix = metresToPlan(own, [...sheet]);
    for (const [x, y] of [[500, 700], [200, 650], [0, 0]] as const) {
      const [left, back] = at(sheet, x, y), expected = toPlan(own, [left! / 0.5, back! / 0.5]);
      at(matrix, x, y).forEach((n, k) => assert.ok(Math.abs(n - expected[k]!) < 1e-9, `${azimuth}: ${n} ${expected}`));
    }
  }
  // With its front to the south, the sheet lies as it is read: right is east, down is south.
  assert.deepEqual(metresToPlan(house(180), [...sheet]).slice(0, 4).map(n => Number(n.toFixed(9)) + 0), [0.01, 0, 0, 0.01]);
});

test('the ridge of a branch meets that of its trunk; hips rise from the corners', () => {
  const trunk = region({}), branch = region({ a0: 4, b0: 5, a1: 8, b1: 10, ridge: 'b', role: 'branch', over: 0 });
  assert.deepEqual(ridgeLines(trunk, [trunk, branch]), [[[0, 2.5], [12, 2.5]]]);
  assert.deepEqual(ridgeLines(branch, [trunk, branch]), [[[6, 2.5], [6, 10]]]);
  const hip = region({ a1: 10, b1: 4, shape: 'YOS' });
  assert.deepEqual(ridgeLines(hip, [hip]).at(-1), [[2, 2], [8, 2]]);
  assert.equal(ridgeLines(hip, [hip]).length, 5);
});

test('an arrow down a lean-to', () => {
  const [shaft] = fallArrow(region({ a1: 4, b1: 2, ridge: null, fall: 'B' }));
  assert.ok(shaft![0][1] < shaft![1][1], 'to the back');
  assert.deepEqual(shaft!.map(([a]) => a), [2, 2]);
  assert.deepEqual(fallArrow(region({})), []);
});

test('bounds and paths', () => {
  assert.equal(bounds([]), null);
  assert.deepEqual(bounds([[1, 2], [4, -2]]), { x: 1, y: -2, width: 3, height: 4 });
  assert.equal(path([[0, 0], [1, 2]], false), 'M0 0L1 2');
});
