// Spans count bytes of the original file; the page counts characters of a string. This is the way between them.

import type { Bytes } from './server.ts';

export class Places {
  readonly text: string;
  /** Bytes before each character (code unit); null where every character is one byte. */
  #before: Uint32Array | null = null;
  /** Where lines begin, characters. */
  readonly lines: number[] = [0];

  /** `encoding` of the file: `shift_jis` where it is that, else UTF-8, which may begin with a `bom`. */
  constructor(text: string, encoding = 'utf-8', bom = false) {
    this.text = text;
    let plain = !bom;
    for (let i = 0; i < text.length; i++) {
      const code = text.charCodeAt(i);
      if (code > 127) plain = false;
      if (code === 10) this.lines.push(i + 1);
    }
    if (plain) return;
    const before = this.#before = new Uint32Array(text.length + 1);
    const size = /^shift/i.test(encoding) ? in_shift_jis : in_utf8;
    let sum = bom ? 3 : 0;
    for (let i = 0; i < text.length; i++) {
      before[i] = sum;
      sum += size(text.charCodeAt(i));
    }
    before[text.length] = sum;
  }

  /** The character that a byte belongs to. */
  char(byte: number): number {
    const before = this.#before;
    if (!before) return Math.min(byte, this.text.length);
    let low = 0, high = this.text.length;
    while (low < high) {
      const half = (low + high + 1) >> 1;
      if (before[half]! <= byte) low = half; else high = half - 1;
    }
    return low;
  }

  chars([start, end]: Bytes): [start: number, end: number] {
    return [this.char(start), this.char(end)];
  }

  byte(char: number): number {
    return this.#before ? this.#before[Math.min(char, this.text.length)]! : char;
  }

  /** The line of a character, from 0. */
  line(char: number): number {
    let low = 0, high = this.lines.length - 1;
    while (low < high) {
      const half = (low + high + 1) >> 1;
      if (this.lines[half]! <= char) low = half; else high = half - 1;
    }
    return low;
  }
}

/** Of a pair of surrogates the first has all four bytes. */
const in_utf8 = (code: number) => code < 0x80 ? 1 : code < 0x800 ? 2 : code >= 0xd800 && code < 0xdc00 ? 4
  : code >= 0xdc00 && code < 0xe000 ? 0 : 3;
const in_shift_jis = (code: number) => code < 0x80 || code >= 0xff61 && code <= 0xff9f ? 1 : 2;

/** Where a span of an old text lies in a new one that differs from it in one stretch; null where it was changed itself. */
export function carried(span: [start: number, end: number], old: string, now: string): [start: number, end: number] | null {
  if (old === now) return span;
  const most = Math.min(old.length, now.length);
  let front = 0;
  while (front < most && old.charCodeAt(front) === now.charCodeAt(front)) front++;
  let back = 0;
  while (back < most - front && old.charCodeAt(old.length - 1 - back) === now.charCodeAt(now.length - 1 - back)) back++;
  const [start, end] = span, by = now.length - old.length;
  if (end <= front) return span;
  if (start >= old.length - back) return [start + by, end + by];
  // The stretch lies inside: what was between stays what it was.
  if (start <= front && end >= old.length - back) return end + by > start ? [start, end + by] : null;
  return null;
}
