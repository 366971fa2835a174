import assert from 'node:assert/strict';
import { test } from 'node:test';
import { arrow, dragged, ghost_of, outward, rectangle, stretch_of } from '../src/draw/strokes.ts';
import { to_house } from '../src/plan/frame.ts';
import type { House, Point, Wall } from '../src/server.ts';

const wall = (from: Point, to: Point): Wall => ({ facade: 1, from, to, span: [0, 0], file: 0, reflection: false, fixed: null, units: [] });
const house = (azimuth: number): House => ({
  name: '', azimuth, origin: [0, 0, 0], unit_m: 0.9, storeys: [], roofs: [], street: false, fixed: null, file: 0, span: [0, 0],
});
// A house of 6 by 4, as it is walked.
const walls = [wall([0, 0], [6, 0]), wall([6, 0], [6, 4]), wall([6, 4], [0, 4]), wall([0, 4], [0, 0])];

test('outward is away from the house on all four sides', () => {
  assert.deepEqual(walls.map(w => outward(w).map(n => n + 0)), [[0, -1], [1, 0], [0, 1], [-1, 0]]);
});

test('a wall is dragged by whole units, outward where that is positive', () => {
  assert.equal(dragged(walls[0]!, [2, 0], [2.4, -1.6]), 2);
  assert.equal(dragged(walls[0]!, [2, 0], [2, 0.9]), -1);
  assert.equal(dragged(walls[1]!, [6, 1], [7.1, 3]), 1);
  assert.equal(dragged(walls[1]!, [6, 1], [6.4, 3]), 0);
});

test('a stretch of a wall is whole units of it, at least one', () => {
  assert.deepEqual(stretch_of(walls[0]!, [1.3, 0.2], [3.6, 0]), { from: 1, to: 4 });
  assert.deepEqual(stretch_of(walls[0]!, [3.6, 0.2], [1.3, 0]), { from: 1, to: 4 });
  assert.deepEqual(stretch_of(walls[2]!, [5.5, 4], [5.5, 4]), { from: 0, to: 1 });
  assert.deepEqual(stretch_of(walls[0]!, [-3, 0], [99, 0]), { from: 0, to: 6 });
});

test('the ghost of a wall, and of a stretch of it', () => {
  assert.deepEqual(ghost_of(walls[1]!, 2), [[6, 0], [8, 0], [8, 4], [6, 4]]);
  assert.deepEqual(ghost_of(walls[1]!, -1, { from: 1, to: 3 }).map(p => p.map(n => n + 0)), [[6, 1], [5, 1], [5, 3], [6, 3]]);
});

test('rectangles lie on the grid', () => {
  assert.deepEqual(rectangle([5.6, -0.2], [1.2, 3.4]), [[1, 0], [6, 0], [6, 3], [1, 3]]);
  assert.equal(rectangle([0, 0], [0.3, 5]), null);
});

test('arrow keys point as the plan is seen, however the house is turned', () => {
  assert.deepEqual(arrow('ArrowUp', house(180), to_house)!.map(n => n + 0), [0, 1]); // north is the back
  assert.deepEqual(arrow('ArrowLeft', house(180), to_house)!.map(n => n + 0), [1, 0]);
  assert.deepEqual(arrow('ArrowUp', house(0), to_house)!.map(n => n + 0), [0, -1]);
  assert.deepEqual(arrow('ArrowUp', house(90), to_house)!.map(n => n + 0), [-1, 0]);
  assert.equal(arrow('Enter', house(0), to_house), null);
});
