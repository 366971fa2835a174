import assert from 'node:assert/strict';
import { test } from 'node:test';
import { carried } from '../src/carried.ts';

test('spans follow their words through a change', () => {
  const old = 'one two three', now = 'one TWENTY two three';
  assert.deepEqual(carried([0, 3], old, now), [0, 3]);
  const [start, end] = carried([8, 13], old, now)!;
  assert.equal(now.slice(start, end), 'three');
  const whole = carried([0, 13], old, now)!;
  assert.equal(now.slice(...whole), now);
  assert.equal(carried([4, 7], 'one two three', 'one 2 three')?.join(), '4,5');
  assert.equal(carried([4, 6], 'one two three', 'one 2 three'), null);
});
