// Where pictures of mirrors lie in one texture: on shelves, the highest first.

/** The width and height of a picture, in pixels. */
export interface Size {
  width: number;
  height: number;
}

/** Where its lower left corner lies, and its size there. */
export interface Place extends Size {
  x: number;
  y: number;
}

/** Places for pictures in a square, or null where they are too many. */
export function shelves(sizes: Size[], side: number): Place[] | null {
  const order = sizes.map((_, i) => i).sort((a, b) => sizes[b]!.height - sizes[a]!.height || a - b);
  const places = new Array<Place>(sizes.length);
  let x = 0, y = 0, high = 0;
  for (const i of order) {
    const { width, height } = sizes[i]!;
    if (x + width > side) {
      y += high;
      x = high = 0;
    }
    if (width > side || y + height > side) return null;
    places[i] = { x, y, width, height };
    x += width;
    high = Math.max(high, height);
  }
  return places;
}

/** Sizes at a scale, whole pixels. */
export const scaled = (sizes: Size[], scale: number): Size[] =>
  sizes.map(({ width, height }) => ({ width: Math.ceil(width * scale), height: Math.ceil(height * scale) }));

/** The least scale that mirrors are drawn at. */
const LEAST = 1 / 16;

/** Places for all groups, each in a square of its own, at one scale for all: 1 where there is room, less where there is not. */
export function pack(groups: Size[][], side: number, wanted = 1): { scale: number; groups: Place[][] } | null {
  const filled = Math.max(...groups.map(sizes => sizes.reduce((sum, s) => sum + s.width * s.height, 0)), 0);
  const widest = Math.max(...groups.flat().map(s => Math.max(s.width, s.height)), 1);
  let scale = Math.min(wanted, side / widest, side / Math.sqrt(Math.max(1, filled)));
  for (; scale >= LEAST; scale *= 0.94) {
    const placed = groups.map(sizes => shelves(scaled(sizes, scale), side));
    if (placed.every(places => places !== null)) return { scale, groups: placed };
  }
  return null;
}
