// What is told of photographs by hand: corners, lattice, and the way back.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { APART, even, firstDraft, History, isWall, metres, withCorner, withLine, withNewLine } from '../src/front/draft.ts';
import type { Corners, Photographs } from '../src/server/front.ts';

const CORNERS: Corners = [[10, 10], [90, 12], [88, 70], [8, 72]];
const KNOWN: Photographs = { photos: [{ name: 'a.jpg', size: [100, 80], corners: CORNERS, lost: null }], folder: 'a', writes: true, files: { front: 'wall/wall.hsd', street: 'wall/wall-street.hsd' }, storey: 3.5, told: null };

test('corners go clockwise round a wall, or they stay', () => {
  const draft = firstDraft(KNOWN);
  assert.ok(isWall(CORNERS));
  assert.ok(!isWall([...CORNERS].reverse() as Corners));
  assert.deepEqual(withCorner(draft, 0, 1, [95.04, -3.26])?.photos[0]!.corners[1], [95, -3.3]);
  assert.equal(withCorner(draft, 0, 0, [95, 60]), null);
  assert.equal(withCorner(draft, 0, 0, [89, 41]), null);
  assert.deepEqual(draft.photos[0]!.corners, CORNERS, 'nothing is changed in place');
});

test('lines stay between their neighbours, and new ones need room', () => {
  let draft = { ...firstDraft(KNOWN), columns: even(4) };
  assert.deepEqual(draft.columns, [0.25, 0.5, 0.75]);
  draft = withLine(draft, 'columns', 1, 0.1);
  assert.equal(draft.columns[1], 0.25 + APART);
  assert.ok(draft.byHand);
  assert.equal(withLine(draft, 'columns', 2, 2).columns[2], 1 - APART);
  const added = withNewLine(draft, 'columns');
  assert.equal(added?.line, 2, 'in the middle of the widest');
  assert.equal(withNewLine(draft, 'columns', 0.251), null);
  assert.equal(withNewLine(draft, 'rows', 0.001), null);
  assert.deepEqual(withNewLine(draft, 'rows')?.draft.rows, [0.5]);
  assert.deepEqual(even(1), []);
});

test('the size is that told, or that of the storeys', () => {
  const draft = { ...firstDraft(KNOWN), rows: [0.3, 0.6] };
  assert.deepEqual(metres(draft, 2, 3.5), [21, 10.5]);
  assert.deepEqual(metres({ ...draft, size: [12, 9] }, 2, 3.5), [12, 9]);
  const told = { photos: [{ corners: CORNERS, mask: [] }], size: null, columns: [0.5], rows: [] };
  assert.deepEqual(firstDraft({ ...KNOWN, told }), { ...told, byHand: true });
});

test('steps are gone back and forward again, until another one is taken', () => {
  const history = new History(0);
  assert.ok(!history.canUndo && !history.canRedo);
  history.undo();
  [1, 2, 3].forEach(step => history.push(step));
  history.undo();
  history.undo();
  assert.equal(history.now, 1);
  history.redo();
  assert.equal(history.now, 2);
  history.push(7, 1);
  assert.ok(!history.canRedo);
  history.undo();
  assert.equal(history.now, 1, 'back to where the drag began');
});
