// Source offsets: the server counts bytes of the file, in any encoding, the page counts UTF-16 units.

import type { ByteRange, Source } from './api.ts';

export class OffsetMap {
  /** Byte offset of each unit, and the end. */
  #starts: Uint32Array;
  readonly text: string;
  /** First unit of each line. */
  readonly lines: number[] = [0];

  constructor({ text, mark, widths }: Pick<Source, 'text' | 'mark' | 'widths'>) {
    this.#starts = new Uint32Array(text.length + 1);
    this.text = text;
    for (let i = text.indexOf('\n'); i >= 0; i = text.indexOf('\n', i + 1)) this.lines.push(i + 1);
    let at = mark;
    for (let i = 0; i < text.length; i++) {
      // A low surrogate has the byte offset of its pair.
      const second = i > 0 && text.charCodeAt(i) >> 10 === 0x37;
      this.#starts[i] = second ? this.#starts[i - 1]! : at;
      at += widths ? Number(widths[i]) : utf8(text.charCodeAt(i));
    }
    this.#starts[text.length] = at;
  }

  /** The unit at a byte; inside a character, its first unit. */
  unit(byte: number): number {
    let low = 0, high = this.#starts.length - 1;
    while (low < high) {
      const half = (low + high + 1) >> 1;
      if (this.#starts[half]! <= byte) low = half; else high = half - 1;
    }
    while (low > 0 && this.#starts[low - 1] === this.#starts[low]) low--;
    return low;
  }

  /** The line of a unit, from 0. */
  line(unit: number): number {
    let low = 0, high = this.lines.length - 1;
    while (low < high) {
      const half = (low + high + 1) >> 1;
      if (this.lines[half]! <= unit) low = half; else high = half - 1;
    }
    return low;
  }

  /** The byte offset of a unit. */
  byte(unit: number): number {
    return this.#starts[Math.max(0, Math.min(unit, this.#starts.length - 1))]!;
  }

  /** A byte range as units, for `slice`. */
  range([start, end]: ByteRange): [from: number, to: number] {
    return [this.unit(start), this.unit(end)];
  }
}

/** UTF-8 length of a unit; a high surrogate counts for its pair. */
function utf8(unit: number): number {
  if (unit < 0x80) return 1;
  if (unit < 0x800) return 2;
  if (unit >= 0xd800 && unit < 0xdc00) return 4;
  return unit >= 0xdc00 && unit < 0xe000 ? 0 : 3;
}
