import assert from 'node:assert/strict';
import { test } from 'node:test';
import { arrow, dragged, ghostPath, outward, rectangle, sameTarget, stretchOf } from '../src/draw/edits.ts';
import { toHouse } from '../src/plan/coordinates.ts';
import type { Doubt, House, Point, State, Wall } from '../src/server/api.ts';

const wall = (from: Point, to: Point): Wall => ({ facade: 1, from, to, span: [0, 0], file: 0, reflection: false, fixed: null, units: [] });
const house = (azimuth: number): House => ({
  name: '', azimuth, origin: [0, 0, 0], unit_m: 0.9, storeys: [], roofs: [], street: false, fixed: null, file: 0, span: [0, 0],
});
// A house of 6 by 4 units, in the order of its walls.
const walls = [wall([0, 0], [6, 0]), wall([6, 0], [6, 4]), wall([6, 4], [0, 4]), wall([0, 4], [0, 0])];

test('the outward normal points away from the house on all four sides', () => {
  assert.deepEqual(walls.map(w => outward(w).map(n => n + 0)), [[0, -1], [1, 0], [0, 1], [-1, 0]]);
});

test('a drag moves a wall by whole units, positive outward', () => {
  assert.equal(dragged(walls[0]!, [2, 0], [2.4, -1.6]), 2);
  assert.equal(dragged(walls[0]!, [2, 0], [2, 0.9]), -1);
  assert.equal(dragged(walls[1]!, [6, 1], [7.1, 3]), 1);
  assert.equal(dragged(walls[1]!, [6, 1], [6.4, 3]), 0);
});

test('a stretch of a wall is a whole number of units, at least one', () => {
  assert.deepEqual(stretchOf(walls[0]!, [1.3, 0.2], [3.6, 0]), { from: 1, to: 4 });
  assert.deepEqual(stretchOf(walls[0]!, [3.6, 0.2], [1.3, 0]), { from: 1, to: 4 });
  assert.deepEqual(stretchOf(walls[2]!, [5.5, 4], [5.5, 4]), { from: 0, to: 1 });
  assert.deepEqual(stretchOf(walls[0]!, [-3, 0], [99, 0]), { from: 0, to: 6 });
});

test('the ghost of a wall and of a stretch', () => {
  assert.deepEqual(ghostPath(walls[1]!, 2), [[6, 0], [8, 0], [8, 4], [6, 4]]);
  assert.deepEqual(ghostPath(walls[1]!, -1, { from: 1, to: 3 }).map(p => p.map(n => n + 0)), [[6, 1], [5, 1], [5, 3], [6, 3]]);
});

test('rectangles are snapped to the grid', () => {
  assert.deepEqual(rectangle([5.6, -0.2], [1.2, 3.4]), [[1, 0], [6, 0], [6, 3], [1, 3]]);
  assert.equal(rectangle([0, 0], [0.3, 5]), null);
});

test('arrow keys follow the plan, whatever the rotation of the house', () => {
  assert.deepEqual(arrow('ArrowUp', house(180), toHouse)!.map(n => n + 0), [0, 1]); // north is the back
  assert.deepEqual(arrow('ArrowLeft', house(180), toHouse)!.map(n => n + 0), [1, 0]);
  assert.deepEqual(arrow('ArrowUp', house(0), toHouse)!.map(n => n + 0), [0, -1]);
  assert.deepEqual(arrow('ArrowUp', house(90), toHouse)!.map(n => n + 0), [-1, 0]);
  assert.equal(arrow('Enter', house(0), toHouse), null);
});

test('an edit of a wall in doubt is not made of the one that has taken its number', () => {
  const doubt = (a: number): Doubt => ({ code: 'KTU', at: [a, 0], unit: null, file: 0, span: [0, 0] });
  const state = (...doubts: Doubt[]) => ({ plan: { houses: [], places: [], outlines: [], doubts } }) as unknown as State;
  const edit = { do: 'accept-doubt', doubt: 0 } as const;
  assert.ok(sameTarget(edit, state(doubt(1), doubt(2)), state(doubt(1))));
  assert.ok(!sameTarget(edit, state(doubt(1), doubt(2)), state(doubt(2))));
  assert.ok(!sameTarget(edit, state(doubt(1)), state()));
});
