// What stands in a walker's way: the surfaces near a place. A body is a round post that reaches from a step above the ground
// to the eyes, or as high as it is when it stoops; surfaces are cut at these heights and seen from above, and the post is pushed
// out of what it touches.
//
// Points are in the page's frame: x east, z south, y up, metres.

/** Half the width of a body. */
export const RADIUS = 0.3;

/** What is no higher than this is stepped on. */
const STEP = 0.45;

/** Height of a body that stands, and of one that stoops, as under the lintels of a store below the roof. */
export const HEIGHT = 1.6;
const STOOPED = 1.05;

/** From the eyes to the top of a body. */
export const CROWN = 0.1;

/** Heights of a body between these differ by this much. */
const BEND = 0.05;

/** Longest way at once: a body never jumps over a wall. */
const STRIDE = 0.15;

/** Nearer than this one is in the middle of what has come, metres. */
const WITHIN = 0.02;

/** The most steps at once. */
const MOST = 1000;

/** Upward part of the normal of a surface on which one can stand. */
const WALKABLE = 0.6;

export type Spot = [x: number, z: number];

/** Side of the squares by which surfaces are found. */
const SQUARE = 1.5;

const NONE: readonly number[] = [];

/** A step: where it ends, and how long it was meant to be. */
interface Step { spot: Spot; long: number }

export class Obstacles {
  /** Corners of triangles, nine numbers each. */
  readonly #triangles: Float32Array;
  /** Where in them the triangles over each square begin. */
  readonly #squares = new Map<number, number[]>();
  /** The height of the plane below all. */
  readonly #level: number;

  /** Takes the triangles within a reach of a place: corners, nine numbers each. */
  constructor(triangles: Float32Array, [x, z]: Spot, reach: number, level: number) {
    this.#triangles = triangles;
    this.#level = level;
    const side = (middle: number, a: number, b: number, c: number) => [
      Math.floor(Math.max(middle - reach, Math.min(a, b, c)) / SQUARE), Math.floor(Math.min(middle + reach, Math.max(a, b, c)) / SQUARE),
    ] as const;
    for (let i = 0; i < triangles.length; i += 9) {
      const [west, east] = side(x, triangles[i]!, triangles[i + 3]!, triangles[i + 6]!), [north, south] = side(z, triangles[i + 2]!, triangles[i + 5]!, triangles[i + 8]!);
      for (let column = west; column <= east; column++) {
        for (let row = north; row <= south; row++) {
          const square = this.#squares.get(squareOf(column, row));
          if (square) square.push(i); else this.#squares.set(squareOf(column, row), [i]);
        }
      }
    }
  }

  /** True if there is nothing but the plane. */
  get none(): boolean { return this.#triangles.length === 0; }

  /** The highest surface above or below a spot. */
  top(spot: Spot): number { return this.#height(spot, Infinity, 0); }

  /** The surface on which one stands at a spot, coming from a ground. */
  ground(spot: Spot, from: number): number { return this.#height(spot, from + STEP, WALKABLE); }

  #height([x, z]: Spot, most: number, least: number): number {
    const t = this.#triangles;
    let found = this.#level;
    for (const i of this.#squares.get(squareOf(Math.floor(x / SQUARE), Math.floor(z / SQUARE))) ?? NONE) {
      const [ax, ay, az, bx, by, bz, cx, cy, cz] = [t[i]!, t[i + 1]!, t[i + 2]!, t[i + 3]!, t[i + 4]!, t[i + 5]!, t[i + 6]!, t[i + 7]!, t[i + 8]!];
      if (Math.min(ax, bx, cx) > x || Math.max(ax, bx, cx) < x || Math.min(az, bz, cz) > z || Math.max(az, bz, cz) < z) continue;
      const area = (bx - ax) * (cz - az) - (cx - ax) * (bz - az);
      if (Math.abs(area) < 1e-9) continue;
      const u = ((bx - x) * (cz - z) - (cx - x) * (bz - z)) / area, v = ((cx - x) * (az - z) - (ax - x) * (cz - z)) / area;
      if (u < 0 || v < 0 || u + v > 1) continue;
      const y = u * ay + v * by + (1 - u - v) * cy;
      if (y <= found || y > most) continue;
      const across = Math.hypot((by - ay) * (cz - az) - (cy - ay) * (bz - az), (bx - ax) * (cy - ay) - (cx - ax) * (by - ay));
      if (Math.abs(area) >= least * Math.hypot(area, across)) found = y;
    }
    return found;
  }

  /** What a body that stands on a ground at a spot is nearest to: how far it is, and where; far if there is nothing within `reach`. */
  nearest([x, z]: Spot, ground: number, reach = RADIUS, height = STOOPED): { far: number; at: Spot } {
    const t = this.#triangles, low = ground + STEP, high = ground + height;
    let far = Infinity, at: Spot = [x, z];
    for (let column = Math.floor((x - reach) / SQUARE); column * SQUARE <= x + reach; column++) {
      for (let row = Math.floor((z - reach) / SQUARE); row * SQUARE <= z + reach; row++) {
        for (const i of this.#squares.get(squareOf(column, row)) ?? NONE) {
          if (Math.min(t[i]!, t[i + 3]!, t[i + 6]!) > x + reach || Math.max(t[i]!, t[i + 3]!, t[i + 6]!) < x - reach) continue;
          if (Math.min(t[i + 2]!, t[i + 5]!, t[i + 8]!) > z + reach || Math.max(t[i + 2]!, t[i + 5]!, t[i + 8]!) < z - reach) continue;
          if (Math.min(t[i + 1]!, t[i + 4]!, t[i + 7]!) > high || Math.max(t[i + 1]!, t[i + 4]!, t[i + 7]!) < low) continue;
          const found = nearestOf(cut(cut([...t.subarray(i, i + 9)], low, 1), high, -1), [x, z]);
          if (found && found.far < far) ({ far, at } = found);
        }
      }
    }
    return far <= reach ? { far, at } : { far: Infinity, at };
  }

  /** How high a body can stand at a spot to which it has come. */
  headroom(spot: Spot, ground: number): number {
    const room = Math.min(RADIUS, this.nearest(spot, ground).far) - 1e-3;
    let height = HEIGHT;
    while (height > STOOPED && this.nearest(spot, ground, RADIUS, height).far < room) height = Math.max(STOOPED, height - BEND);
    return height;
  }

  /** Walks a way from a spot, along what stands in it; returns where it ends, and the ground there. */
  walk(from: Spot, ground: number, way: Spot): { spot: Spot; ground: number } {
    const long = Math.hypot(...way);
    let spot = from, gone = 0;
    for (let i = 0; gone < long - 1e-9 && i < MOST; i++) {
      // One stoops to go on where one cannot upright, not to stand nearer to a front below what projects from it.
      const upright = this.#step(spot, ground, way, long - gone, this.headroom(spot, ground));
      const stoops = !isFree(spot, upright, way) && this.#leads(spot, ground, way);
      const best = stoops ? this.#step(spot, ground, way, long - gone, STOOPED) : upright;
      if (!best) break;
      gone += best.long;
      ground = this.ground(spot = best.spot, ground);
    }
    return { spot, ground };
  }

  /** Whether a body that stoops gets a body's width ahead on a way. */
  #leads(spot: Spot, ground: number, way: Spot): boolean {
    for (let gone = 0; gone < 2 * RADIUS;) {
      const step = this.#step(spot, ground, way, STRIDE, STOOPED);
      if (!step || !isFree(spot, step, way)) return false;
      gone += step.long;
      ground = this.ground(spot = step.spot, ground);
    }
    return true;
  }

  /** A step on a way of which so much is left, by a body of a height: null if it stays. */
  #step(spot: Spot, ground: number, way: Spot, left: number, height: number): Step | null {
    const { far } = this.nearest(spot, ground, RADIUS, height), long = Math.hypot(...way);
    // Who touches something, since a door has slid there or a nearer level of detail has come, takes steps too short to get through.
    const step = Math.min(left, far < RADIUS - 1e-3 && far > WITHIN ? Math.min(STRIDE, far / 2) : STRIDE);
    const next = this.#stride(ground, [spot[0] + way[0] / long * step, spot[1] + way[1] / long * step], far, step, height);
    return next && { spot: next, long: step };
  }

  /** Where a body comes to by a step to a spot from one at which it is so far from what is nearest; null if it stays. */
  #stride(ground: number, to: Spot, away: number, step: number, height: number): Spot | null {
    // Who touches something may go away from it; who is in the middle of it, out of it.
    const least = away < WITHIN ? away + step / 2 : Math.min(RADIUS, away) - 1e-4;
    let [x, z] = to;
    for (let push = 0; push < 4; push++) {
      const { far, at } = this.nearest([x, z], this.ground([x, z], ground), RADIUS, height);
      if (far >= least) return [x, z];
      if (far < 1e-6 || away < WITHIN) return null;
      x += (x - at[0]) / far * (RADIUS - far);
      z += (z - at[1]) / far * (RADIUS - far);
    }
    return null;
  }
}

/** Whether a step leads as far ahead on a way as it was meant to. */
const isFree = ([x, z]: Spot, step: Step | null, [dx, dz]: Spot) =>
  step !== null && ((step.spot[0] - x) * dx + (step.spot[1] - z) * dz) / Math.hypot(dx, dz) > 0.99 * step.long;

/** The number of a square. */
const squareOf = (column: number, row: number) => column * 2 ** 24 + row;

/** The part of a polygon above a height, or below it. */
function cut(polygon: number[], height: number, side: 1 | -1): number[] {
  const kept: number[] = [], last = polygon.length - 3;
  for (let i = 0, before = last; i <= last; before = i, i += 3) {
    const one = side * (polygon[before + 1]! - height), two = side * (polygon[i + 1]! - height);
    if (one >= 0 !== two >= 0) for (let k = 0; k < 3; k++) kept.push(polygon[before + k]! + (polygon[i + k]! - polygon[before + k]!) * one / (one - two));
    if (two >= 0) kept.push(polygon[i]!, polygon[i + 1]!, polygon[i + 2]!);
  }
  return kept;
}

/** The point of a polygon, seen from above, that is nearest to a spot; null if there is no polygon. */
function nearestOf(polygon: number[], [x, z]: Spot): { far: number; at: Spot } | null {
  let found: { far: number; at: Spot } | null = null, lefts = 0, rights = 0;
  const last = polygon.length - 3;
  for (let i = 0, before = last; i <= last; before = i, i += 3) {
    const ax = polygon[before]!, az = polygon[before + 2]!, dx = polygon[i]! - ax, dz = polygon[i + 2]! - az, long = dx * dx + dz * dz;
    const along = long > 0 ? Math.min(1, Math.max(0, ((x - ax) * dx + (z - az) * dz) / long)) : 0;
    const at: Spot = [ax + dx * along, az + dz * along], far = Math.hypot(x - at[0], z - at[1]);
    if (!found || far < found.far) found = { far, at };
    const side = dx * (z - az) - dz * (x - ax);
    if (side > 0) lefts++; else if (side < 0) rights++;
  }
  const within = (lefts === 0) !== (rights === 0) && Math.max(lefts, rights) >= 3;
  return found && within ? { far: 0, at: [x, z] } : found;
}
