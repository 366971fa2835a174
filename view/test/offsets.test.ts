import assert from 'node:assert/strict';
import { test } from 'node:test';
import { OffsetMap } from '../src/server/offsets.ts';

test('UTF-8 offsets in a text with kanji and a surrogate pair', () => {
  const text = 'KSK  格子𠮷 x';
  const places = new OffsetMap({ text, mark: 3, widths: null });
  const bytes = new TextEncoder();
  for (const [from, to] of [[0, 3], [5, 7], [7, 9], [10, 11]] as const) {
    const start = 3 + bytes.encode(text.slice(0, from)).length, end = 3 + bytes.encode(text.slice(0, to)).length;
    assert.deepEqual(places.range([start, end]), [from, to]);
    assert.equal(places.byte(from), start);
  }
});

test('Shift_JIS offsets by the widths sent with the text', () => {
  const places = new OffsetMap({ text: 'a格子b', mark: 0, widths: '1221' });
  assert.deepEqual(places.range([1, 5]), [1, 3]);
  assert.deepEqual(places.range([5, 6]), [3, 4]);
  assert.equal(places.unit(2), 1); // inside a character
});
