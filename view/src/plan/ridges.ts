// Ridges, hips and slopes of the regions of automatic roofs, as drawn by `hsd dump --stage regions --format svg`, in the
// house's frame.

import type { Point, Region } from '../server/api.ts';

export type Line = [Point, Point];
type Rect = [a0: number, b0: number, a1: number, b1: number];

const HIPS: Record<string, number> = { YOS: 1, HOG: 1, IRI: 0.5, TER: 0.5, HAK: 0.5 };

/** The ridge and hips of a region. The ridge of a branch extends to that of its trunk. */
export function ridgeLines(region: Region, all: Region[]): Line[] {
  const { ridge } = region;
  if (ridge === null) return [];
  // Computed along a, then turned back.
  const turned = ({ a0, b0, a1, b1 }: Region): Rect => ridge === 'a' ? [a0, b0, a1, b1] : [b0, a0, b1, a1];
  const back = ([p, q]: Point): Point => ridge === 'a' ? [p, q] : [q, p];
  const [a0, b0, a1, b1] = turned(region);
  const middle = (b0 + b1) / 2, half = (b1 - b0) / 2;
  const trunk = region.over === null ? undefined : all[region.over];
  const hip = Math.min((HIPS[region.shape] ?? 0) * half, (a1 - a0) / 2);
  const lines: Line[] = [];
  // The end of the ridge at an end wall: extended over the trunk, or shortened by a hip.
  const end = (wall: number, out: number): number => {
    if (trunk) {
      const [t0, , t1] = turned(trunk);
      if (out > 0 ? t0 >= wall : t1 <= wall) {
        return trunk.ridge !== null && trunk.ridge !== ridge ? wall + out * (t1 - t0) / 2 : wall;
      }
    }
    const top = wall - out * hip;
    if (hip > 0) for (const b of [b0, b1]) lines.push([[wall, b], [top, b + Math.sign(middle - b) * hip]]);
    return top;
  };
  const from = end(a0, -1), to = end(a1, 1);
  lines.push([[from, middle], [to, middle]]);
  return lines.map(([p, q]) => [back(p), back(q)]);
}

/** An arrow down the slope of a lean-to: the shaft and two barbs. */
export function fallArrow({ a0, b0, a1, b1, fall }: Region): Line[] {
  const ways: Record<string, Point> = { F: [0, -1], B: [0, 1], L: [1, 0], R: [-1, 0] };
  const way = fall === null ? undefined : ways[fall];
  if (!way) return [];
  const middle: Point = [(a0 + a1) / 2, (b0 + b1) / 2];
  const long = Math.abs((a1 - a0) * way[0]) + Math.abs((b1 - b0) * way[1]);
  const at = (along: number, across: number): Point =>
    [middle[0] + way[0] * along - way[1] * across, middle[1] + way[1] * along + way[0] * across];
  const tip = long * 0.35, head = Math.min(a1 - a0, b1 - b0) * 0.12;
  return [[at(-tip, 0), at(tip, 0)], [at(tip, 0), at(tip - head, head)], [at(tip, 0), at(tip - head, -head)]];
}
