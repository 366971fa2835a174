// Colours of parts in the tests of reflections: one per part, whatever its material.

export type Colour = [r: number, g: number, b: number];

/** Colour of a part, linear, 0 to 1. */
export function colourOf(part: number): Colour {
  const channel = (salt: number) => {
    let h = Math.imul(part + 1, 0x9e3779b1) ^ Math.imul(salt, 0x85ebca6b);
    h = Math.imul(h ^ (h >>> 15), 0x2c1b3c6d);
    h ^= h >>> 13;
    return linear((40 + (h >>> 8) % 180) / 255);
  };
  return [channel(1), channel(2), channel(3)];
}

/** Linear colour of an sRGB pixel. */
export const ofBytes = (r: number, g: number, b: number): Colour => [linear(r / 255), linear(g / 255), linear(b / 255)];

/** sRGB transfer function, 0 to 1, and its inverse. */
export function linear(s: number): number {
  return s <= 0.04045 ? s / 12.92 : ((s + 0.055) / 1.055) ** 2.4;
}

export function encoded(c: number): number {
  return c <= 0.0031308 ? c * 12.92 : 1.055 * c ** (1 / 2.4) - 0.055;
}

/** The sRGB bytes of a linear colour. */
export function bytesOf(colour: Colour): Colour {
  const byte = (c: number) => Math.round(255 * Math.min(1, encoded(c)));
  return [byte(colour[0]), byte(colour[1]), byte(colour[2])];
}
