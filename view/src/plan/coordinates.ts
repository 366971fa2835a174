// Coordinates of the plan: metres, x to the east, y to the south, as on a map. A house has its own frame: a to the left
// along its front, b to the back, in U.

import type { House, Matrix, Point } from '../server/api.ts';

export type XY = [x: number, y: number];

/** Cosine and sine of a house's rotation, exact for right angles. */
function turnOf({ azimuth }: House): [number, number] {
  const quarter = (azimuth - 180) / 90;
  if (Number.isInteger(quarter)) return ([[1, 0], [0, 1], [-1, 0], [0, -1]] as [number, number][])[((quarter % 4) + 4) % 4]!;
  const angle = (azimuth - 180) * Math.PI / 180;
  return [Math.cos(angle), Math.sin(angle)];
}

/** From a house's frame to the plan. */
export function toPlan(house: House, [a, b]: Point): XY {
  const [cos, sin] = turnOf(house), u = house.unit_m;
  const east = -a * u, north = b * u;
  // Clockwise by azimuth - 180 degrees.
  return [house.origin[0] + east * cos + north * sin, -(house.origin[1] - east * sin + north * cos)];
}

/** From the plan to a house's frame. */
export function toHouse(house: House, [x, y]: XY): Point {
  const [cos, sin] = turnOf(house), u = house.unit_m;
  const e = x - house.origin[0], n = -y - house.origin[1];
  return [-(e * cos - n * sin) / u, (e * sin + n * cos) / u];
}

/** From what is in metres of a house's frame, left and back, to the plan. */
export function metresToPlan(house: House, [a, b, c, d, e, f]: Matrix): Matrix {
  const at = (left: number, back: number) => toPlan(house, [left / house.unit_m, back / house.unit_m]);
  const [o, x, y] = [at(e, f), at(a + e, b + f), at(c + e, d + f)];
  return [x[0] - o[0], x[1] - o[1], y[0] - o[0], y[1] - o[1], o[0], o[1]];
}

/** The bounding rectangle of points; null if there are none. */
export function bounds(points: Iterable<XY>): { x: number; y: number; width: number; height: number } | null {
  let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const [x, y] of points) {
    x0 = Math.min(x0, x); y0 = Math.min(y0, y);
    x1 = Math.max(x1, x); y1 = Math.max(y1, y);
  }
  return x0 <= x1 ? { x: x0, y: y0, width: x1 - x0, height: y1 - y0 } : null;
}

export const path = (points: XY[], closed = true) =>
  points.length ? `M${points.map(([x, y]) => `${round(x)} ${round(y)}`).join('L')}${closed ? 'Z' : ''}` : '';

const round = (n: number) => Math.round(n * 1e4) / 1e4;
