// Strokes in numbers, without any drawing: how far a wall was dragged, which stretch of it, what a rectangle comes to.
// Places are those of the house, in U; src/ide/stroke.rs says what strokes are.

import type { House, Point, State, Wall } from '../server.ts';
import type { UnitAt, WallAt } from '../plan/picture.ts';

export type Stroke =
  | { do: 'set-part'; part: string } & UnitAt
  | { do: 'move-wall'; by: number; storeys: 'one' | 'all' } & WallAt
  | { do: 'break-wall'; from: number; to: number; by: number } & WallAt
  | { do: 'draw-house'; outline: Point[]; house?: number }
  | { do: 'add-storey'; house: number; height?: number }
  | { do: 'remove-storey'; house: number; storey: number }
  | { do: 'remove-house'; house: number }
  | { do: 'set-height'; house: number; storey: number; height: number };

/** A stretch of a wall: units from its `from` end. */
export interface Stretch { from: number; to: number }

/** Where outlines lie that belong to no house. */
export const WORLD: House = {
  name: '', azimuth: 180, origin: [0, 0, 0], unit_m: 10 / 11, storeys: [], roofs: [], street: false, fixed: null, file: 0, span: [0, 0],
};

export const length_of = ({ from, to }: Wall) => Math.hypot(to[0] - from[0], to[1] - from[1]);

/** Along a wall as it is walked. */
export function along(wall: Wall): Point {
  const long = length_of(wall) || 1;
  return [(wall.to[0] - wall.from[0]) / long, (wall.to[1] - wall.from[1]) / long];
}

/** Away from the interior, which lies on the right of the walk. (a, b) is a left-handed frame. */
export function outward(wall: Wall): Point {
  const [a, b] = along(wall);
  return [b, -a];
}

const dot = (p: Point, q: Point) => p[0] * q[0] + p[1] * q[1];
const minus = (p: Point, q: Point): Point => [p[0] - q[0], p[1] - q[1]];
const plus = (p: Point, q: Point, by: number): Point => [p[0] + q[0] * by, p[1] + q[1] * by];

/** Whole units outward from one place to another. */
export const dragged = (wall: Wall, from: Point, to: Point) => Math.round(dot(minus(to, from), outward(wall))) + 0;

/** The whole units of a wall between two places. */
export function stretch_of(wall: Wall, from: Point, to: Point): Stretch {
  const whole = Math.floor(length_of(wall) + 1e-9);
  const at = [from, to].map(p => dot(minus(p, wall.from), along(wall))).sort((x, y) => x - y);
  const start = Math.max(0, Math.min(whole - 1, Math.floor(at[0]! + 1e-9)));
  return { from: start, to: Math.max(start + 1, Math.min(whole, Math.ceil(at[1]! - 1e-9))) };
}

/** Where a wall, or a stretch of it, goes: its first end, out, along, and back to its last end. */
export function ghost_of(wall: Wall, by: number, stretch?: Stretch): Point[] {
  const start = stretch ? plus(wall.from, along(wall), stretch.from) : wall.from;
  const end = stretch ? plus(wall.from, along(wall), stretch.to) : wall.to;
  const out = outward(wall);
  return [start, plus(start, out, by), plus(end, out, by), end];
}

/** The rectangle of whole units between two places; null where it is too small. */
export function rectangle(from: Point, to: Point): Point[] | null {
  const [a0, b0] = [Math.round(Math.min(from[0], to[0])), Math.round(Math.min(from[1], to[1]))];
  const [a1, b1] = [Math.round(Math.max(from[0], to[0])), Math.round(Math.max(from[1], to[1]))];
  if (a1 - a0 < 1 || b1 - b0 < 1) return null;
  return [[a0, b0], [a1, b0], [a1, b1], [a0, b1]].map(([a, b]) => [a! + 0, b! + 0]); // no -0
}

/** Whether a stroke means the same place in the plans of two states. */
export function same_place(stroke: Stroke, meant: State, now: State): boolean {
  if (meant === now) return true;
  const [before, after] = [meant, now].map(({ plan }) => {
    const house = 'house' in stroke && stroke.house !== undefined ? plan.houses[stroke.house] : undefined;
    const storey = 'storey' in stroke ? house?.storeys[stroke.storey] : undefined;
    const wall = 'wall' in stroke ? storey?.rings[stroke.ring]?.walls[stroke.wall] : undefined;
    const unit = 'unit' in stroke ? wall?.units[stroke.unit] : undefined;
    const ends = (of?: Pick<Wall, 'from' | 'to'>) => of && [...of.from, ...of.to];
    return JSON.stringify([house?.name, storey?.storey, ends(wall), unit?.code, ends(unit)]);
  });
  return before === after;
}

/** Which way an arrow key points in the house: as [a, b], rounded to an axis. `to_house` turns places of the plan. */
export function arrow(key: string, house: House, to_house: (house: House, at: Point) => Point): Point | null {
  const ways: Record<string, Point> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  const way = ways[key];
  if (!way) return null;
  const [a, b] = minus(to_house(house, way), to_house(house, [0, 0]));
  return Math.abs(a) >= Math.abs(b) ? [Math.sign(a), 0] : [0, Math.sign(b)];
}

/** How much of a way goes along another. */
export const share = (way: Point, along: Point) => Math.round(dot(way, along)) + 0;
