// Grey pictures as PNG.

import { deflateSync } from 'node:zlib';

/** Writes a grey picture as PNG. */
export function png([width, height]: readonly [number, number], grey: (x: number, y: number) => number): Uint8Array {
  const rows = new Uint8Array((width + 1) * height);
  for (let y = 0; y < height; y++) for (let x = 0; x < width; x++) rows[y * (width + 1) + 1 + x] = grey(x, y);
  const number = (n: number) => [n >>> 24, n >>> 16 & 255, n >>> 8 & 255, n & 255];
  const crc32 = (bytes: number[]) => ~bytes.reduce((sum, byte) => {
    let next = sum ^ byte;
    for (let i = 0; i < 8; i++) next = next >>> 1 ^ (next & 1 ? 0xedb88320 : 0);
    return next;
  }, -1);
  const chunk = (name: string, data: Uint8Array | number[]) => {
    const body = [...new TextEncoder().encode(name), ...data];
    return [...number(data.length), ...body, ...number(crc32(body))];
  };
  return new Uint8Array([137, 80, 78, 71, 13, 10, 26, 10, ...chunk('IHDR', [...number(width), ...number(height), 8, 0, 0, 0, 0]),
    ...chunk('IDAT', new Uint8Array(deflateSync(rows))), ...chunk('IEND', [])]);
}
