import assert from 'node:assert/strict';
import { test } from 'node:test';
import { movedSpan } from '../src/server/spans.ts';

test('spans follow their text through an edit', () => {
  const old = 'one two three', now = 'one TWENTY two three';
  assert.deepEqual(movedSpan([0, 3], old, now), [0, 3]);
  const [start, end] = movedSpan([8, 13], old, now)!;
  assert.equal(now.slice(start, end), 'three');
  const whole = movedSpan([0, 13], old, now)!;
  assert.equal(now.slice(...whole), now);
  assert.equal(movedSpan([4, 7], 'one two three', 'one 2 three')?.join(), '4,5');
  assert.equal(movedSpan([4, 6], 'one two three', 'one 2 three'), null);
});
