// Geometry of edits, without drawing: how far a wall was dragged, which stretch of it, which rectangle. Coordinates are in
// the house's frame, in U.

import type { House, Point, State, Wall } from '../server/api.ts';
import { toHouse, type XY } from '../plan/coordinates.ts';
import type { FixtureIndex, RoomIndex, UnitIndex, WallIndex } from '../plan/drawing.ts';

export type Edit =
  | { do: 'set-part'; part: string } & UnitIndex
  | { do: 'move-wall'; by: number; storeys: 'one' | 'all' } & WallIndex
  | { do: 'break-wall'; from: number; to: number; by: number } & WallIndex
  | { do: 'draw-house'; outline: Point[]; house?: number }
  | { do: 'add-storey'; house: number; height?: number }
  | { do: 'remove-storey'; house: number; storey: number }
  | { do: 'remove-house'; house: number }
  | { do: 'move-place'; place: number; to: Point }
  | { do: 'turn-place'; place: number; to: number }
  | { do: 'draw-outline'; points: Point[] }
  | { do: 'move-corner'; outline: number; corner: number; to: Point }
  | { do: 'draw-wall'; house: number; storey: number; points: Point[]; part?: string }
  | { do: 'remove-wall'; house: number; storey: number; ring: number }
  | { do: 'add-room'; house: number; storey: number; at: Point } & RoomWords
  | { do: 'set-room'; at?: Point } & RoomIndex & RoomWords
  | { do: 'remove-room' } & RoomIndex
  | { do: 'add-fixture'; house: number; storey: number; at: Point; kind: string } & FixtureWords
  | { do: 'set-fixture' } & FixtureIndex & FixtureWords
  | { do: 'remove-fixture' } & FixtureIndex
  | { do: 'accept-doubt'; doubt: number }
  | { do: 'change-doubt'; doubt: number; kind: DoubtKind }
  | { do: 'delete-doubt'; doubt: number }
  | { do: 'set-height'; house: number; storey: number; height: number };

/** What a wall in doubt may be, in the order of the keys 1 to 5. */
export const DOUBT_KINDS = ['wall', 'slide', 'window', 'lattice', 'open'] as const;
export type DoubtKind = (typeof DOUBT_KINDS)[number];

/** What an edit writes about a room; the rest stays as it is. */
export interface RoomWords { name?: string; floor?: string; mats?: string; ceiling?: string; height?: number }

/** What an edit writes about a fixture; the rest stays as it is. */
export interface FixtureWords { kind?: string; at?: Point; size?: Point; faces?: string }

/** A stretch of a wall, in units from its `from` end. */
export interface Stretch { from: number; to: number }

/** The frame of outlines that belong to no house. */
export const WORLD_FRAME: House = {
  name: '', azimuth: 180, origin: [0, 0, 0], unit_m: 10 / 11, storeys: [], roofs: [], street: false, fixed: null, file: 0, span: [0, 0],
};

export const lengthOf = ({ from, to }: Wall) => Math.hypot(to[0] - from[0], to[1] - from[1]);

/** Unit vector along a wall, in the direction in which it is written. */
export function along(wall: Wall): Point {
  const long = lengthOf(wall) || 1;
  return [(wall.to[0] - wall.from[0]) / long, (wall.to[1] - wall.from[1]) / long];
}

/** Unit vector away from the interior, which lies to the right of the wall's direction; (a, b) is a left-handed frame. */
export function outward(wall: Wall): Point {
  const [a, b] = along(wall);
  return [b, -a];
}

const dot = (p: Point, q: Point) => p[0] * q[0] + p[1] * q[1];
const minus = (p: Point, q: Point): Point => [p[0] - q[0], p[1] - q[1]];
const plus = (p: Point, q: Point, by: number): Point => [p[0] + q[0] * by, p[1] + q[1] * by];

/** The drag distance along the outward normal, in whole units. */
export const dragged = (wall: Wall, from: Point, to: Point) => Math.round(dot(minus(to, from), outward(wall))) + 0;

/** The whole units of a wall between two points. */
export function stretchOf(wall: Wall, from: Point, to: Point): Stretch {
  const whole = Math.floor(lengthOf(wall) + 1e-9);
  const at = [from, to].map(p => dot(minus(p, wall.from), along(wall))).sort((x, y) => x - y);
  const start = Math.max(0, Math.min(whole - 1, Math.floor(at[0]! + 1e-9)));
  return { from: start, to: Math.max(start + 1, Math.min(whole, Math.ceil(at[1]! - 1e-9))) };
}

/** The preview of a moved wall or stretch: its start, out, along, and back to its end. */
export function ghostPath(wall: Wall, by: number, stretch?: Stretch): Point[] {
  const start = stretch ? plus(wall.from, along(wall), stretch.from) : wall.from;
  const end = stretch ? plus(wall.from, along(wall), stretch.to) : wall.to;
  const out = outward(wall);
  return [start, plus(start, out, by), plus(end, out, by), end];
}

/** The rectangle of whole units between two points; null where it is smaller than one unit. */
export function rectangle(from: Point, to: Point): Point[] | null {
  const [a0, b0] = [Math.round(Math.min(from[0], to[0])), Math.round(Math.min(from[1], to[1]))];
  const [a1, b1] = [Math.round(Math.max(from[0], to[0])), Math.round(Math.max(from[1], to[1]))];
  if (a1 - a0 < 1 || b1 - b0 < 1) return null;
  return [[a0, b0], [a1, b0], [a1, b1], [a0, b1]].map(([a, b]) => [a! + 0, b! + 0]); // Avoids -0.
}

/** True if an edit refers to the same wall, unit or storey in both states. */
export function sameTarget(edit: Edit, meant: State, now: State): boolean {
  if (meant === now) return true;
  const [before, after] = [meant, now].map(({ plan }) => {
    const house = 'house' in edit && edit.house !== undefined ? plan.houses[edit.house] : undefined;
    const storey = 'storey' in edit ? house?.storeys[edit.storey] : undefined;
    const wall = 'wall' in edit ? storey?.rings[edit.ring]?.walls[edit.wall] : undefined;
    const room = 'room' in edit ? storey?.rooms[edit.room] : undefined;
    const fixture = 'fixture' in edit ? storey?.fixtures[edit.fixture] : undefined;
    const inner = edit.do === 'remove-wall' ? storey?.rings[edit.ring]?.walls.map(wall => [wall.from, wall.to]) : undefined;
    const unit = 'unit' in edit ? wall?.units[edit.unit] : undefined;
    const doubt = 'doubt' in edit ? plan.doubts[edit.doubt] : undefined;
    const ends = (of?: Pick<Wall, 'from' | 'to'>) => of && [...of.from, ...of.to];
    const place = 'place' in edit ? plan.places[edit.place] : 'corner' in edit ? plan.outlines[edit.outline] : undefined;
    return JSON.stringify([place, house?.name, storey?.storey, ends(wall), unit?.code, ends(unit), room?.at, room?.name, fixture?.kind, fixture?.at, inner, doubt?.code, doubt?.at, doubt?.unit]);
  });
  return before === after;
}

/** The direction of an arrow key in the house's frame, snapped to an axis; `toHouse` converts plan coordinates. */
export function arrow(key: string, house: House, toHouse: (house: House, at: Point) => Point): Point | null {
  const ways: Record<string, Point> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  const way = ways[key];
  if (!way) return null;
  const [a, b] = minus(toHouse(house, way), toHouse(house, [0, 0]));
  return Math.abs(a) >= Math.abs(b) ? [Math.sign(a), 0] : [0, Math.sign(b)];
}

/** The component of a direction along another, rounded. */
export const share = (way: Point, along: Point) => Math.round(dot(way, along)) + 0;

/** True if a point is within a ring of walls. */
export function holds(ring: Point[], [a, b]: Point): boolean {
  let inside = false;
  for (const [i, [x, y]] of ring.entries()) {
    const [u, v] = ring[(i + 1) % ring.length]!;
    if (y > b !== v > b && a < x + (b - y) / (v - y) * (u - x)) inside = !inside;
  }
  return inside;
}

/** The house and storey under a point of the plan; with `nearest`, the first house where there is none under it. */
export function storeyUnder(state: State | null, number: number, at: XY, nearest = false): { house: number; storey: number; shown: House } | null {
  const all = (state?.plan.houses ?? []).flatMap((shown, house) => {
    const storey = shown.storeys.findIndex(({ storey, kind }) => storey === number && kind === 'storey');
    return storey < 0 ? [] : [{ house, storey, shown }];
  });
  const under = all.find(({ shown, storey }) => shown.storeys[storey]!.rings.some(ring => !ring.inner && !ring.hole && holds(ring.walls.map(wall => wall.from), toHouse(shown, at))));
  return under ?? (nearest ? all[0] ?? null : null);
}
