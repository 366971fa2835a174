import assert from 'node:assert/strict';
import { test } from 'node:test';
import { carried, Places } from '../src/bytes.ts';

test('bytes and characters of several encodings', () => {
  const text = 'a町家\nb𠮷c\n';
  const utf8 = new Places(text);
  const encoder = new TextEncoder();
  for (const i of [0, 1, 2, 3, 4, 5, 7, 8, 9]) {
    const bytes = encoder.encode(text.slice(0, i)).length;
    assert.equal(utf8.byte(i), bytes, `${i}`);
    assert.equal(utf8.char(bytes), i, `${i}`);
  }
  const marked = new Places(text, 'utf-8', true);
  assert.deepEqual(marked.chars([3, 4]), [0, 1]);
  const jis = new Places('aﾊ町b', 'Shift_JIS');
  assert.deepEqual([0, 1, 2, 3, 4].map(i => jis.byte(i)), [0, 1, 2, 4, 5]);
  const plain = new Places('KTU\nKSK');
  assert.equal(plain.byte(5), 5);
  assert.equal(plain.line(3), 0);
  assert.equal(plain.line(4), 1);
});

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
