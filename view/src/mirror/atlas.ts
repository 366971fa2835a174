// Packs the images of mirrors into one texture: shelf packing, highest first.

/** Width and height of an image, pixels. */
export interface Size {
  width: number;
  height: number;
}

/** Lower left corner and size of an image in the atlas. */
export interface AtlasPlace extends Size {
  x: number;
  y: number;
}

/** Packs images into a square; null if they do not fit. */
export function packShelves(sizes: Size[], side: number): AtlasPlace[] | null {
  const order = sizes.map((_, i) => i).sort((a, b) => sizes[b]!.height - sizes[a]!.height || a - b);
  const places = new Array<AtlasPlace>(sizes.length);
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

/** Scales sizes, rounded up to whole pixels. */
export const scaled = (sizes: Size[], scale: number): Size[] =>
  sizes.map(({ width, height }) => ({ width: Math.ceil(width * scale), height: Math.ceil(height * scale) }));

/** The smallest scale at which mirrors are drawn. */
const MIN_SCALE = 1 / 16;

/** Packs each group into a square of its own at one common scale, at most `wanted`; null if they do not fit at any scale. */
export function pack(groups: Size[][], side: number, wanted = 1): { scale: number; groups: AtlasPlace[][] } | null {
  const filled = Math.max(...groups.map(sizes => sizes.reduce((sum, s) => sum + s.width * s.height, 0)), 0);
  const widest = Math.max(...groups.flat().map(s => Math.max(s.width, s.height)), 1);
  let scale = Math.min(wanted, side / widest, side / Math.sqrt(Math.max(1, filled)));
  for (; scale >= MIN_SCALE; scale *= 0.94) {
    const placed = groups.map(sizes => packShelves(scaled(sizes, scale), side));
    if (placed.every(places => places !== null)) return { scale, groups: placed };
  }
  return null;
}
