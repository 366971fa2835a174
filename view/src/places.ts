// Places of a text: the server counts bytes of the file, whatever its encoding, the page UTF-16 units of the text.

import type { Bytes, Source } from './server.ts';

export class Places {
  /** The byte that each unit begins at, and that behind the last. */
  #starts: Uint32Array;
  readonly text: string;
  /** The unit that each line begins at. */
  readonly lines: number[] = [0];

  constructor({ text, mark, widths }: Pick<Source, 'text' | 'mark' | 'widths'>) {
    this.#starts = new Uint32Array(text.length + 1);
    this.text = text;
    for (let i = text.indexOf('\n'); i >= 0; i = text.indexOf('\n', i + 1)) this.lines.push(i + 1);
    let at = mark;
    for (let i = 0; i < text.length; i++) {
      // The second half of a pair begins where the first does.
      const second = i > 0 && text.charCodeAt(i) >> 10 === 0x37;
      this.#starts[i] = second ? this.#starts[i - 1]! : at;
      at += widths ? Number(widths[i]) : utf8(text.charCodeAt(i));
    }
    this.#starts[text.length] = at;
  }

  /** The unit at a byte; inside a character, its first. */
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

  /** The byte of a unit. */
  byte(unit: number): number {
    return this.#starts[Math.max(0, Math.min(unit, this.#starts.length - 1))]!;
  }

  /** The units of a span, for `slice`. */
  range([start, end]: Bytes): [from: number, to: number] {
    return [this.unit(start), this.unit(end)];
  }
}

/** Bytes of a unit in UTF-8; of a pair the first has all four. */
function utf8(unit: number): number {
  if (unit < 0x80) return 1;
  if (unit < 0x800) return 2;
  if (unit >= 0xd800 && unit < 0xdc00) return 4;
  return unit >= 0xdc00 && unit < 0xe000 ? 0 : 3;
}
