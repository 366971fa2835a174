// Rooms of the plan and what is built into them.

import { s } from '../ui/dom.ts';
import type { Faces, Fixture, House, Point, Room } from '../server/api.ts';
import { strings } from '../ui/strings.ts';
import { path, toPlan } from './coordinates.ts';

/** A room as a shape of the plan: its area, its mats, its name and its point. */
export function roomShape(house: House, room: Room): SVGGElement {
  const at = toPlan(house, room.at), rings = room.area.map(ring => path(ring.map(p => toPlan(house, p)))).join('');
  const mats = room.laid.map(([a0, b0, a1, b1]) => path(([[a0, b0], [a1, b0], [a1, b1], [a0, b1]] as Point[]).map(p => toPlan(house, p)))).join('');
  return s('g', { class: `room ${room.floor}` },
    s('path', { class: 'room-area', d: rings, 'fill-rule': 'evenodd' }), s('path', { class: 'mats', d: mats }),
    s('circle', { class: 'room-point', cx: at[0], cy: at[1], r: 0.16 }),
    s('text', { class: 'room-name', x: at[0], y: at[1] - 0.3, 'font-size': 0.42 }, room.name));
}

/** The direction out of the front of a fixture. */
export const outOf: Record<Faces, Point> = { F: [0, -1], B: [0, 1], L: [1, 0], R: [-1, 0] };

/** The corners of a rectangle from its least one. */
export const rectangleOf = ([a, b]: Point, [wide, deep]: Point): Point[] => [[a, b], [a + wide, b], [a + wide, b + deep], [a, b + deep]];

/** The height of letters, and the share of it that one takes of a line; those of Japanese are wider. */
const LETTERS = 0.34, NARROW = 0.55, WIDE = 1.05;

/** The distance between lines of treads, U. */
const TREAD = 0.25;

/** A fixture as a shape of the plan: its rectangle, its front, its name; of stairs the treads and the way up. */
export function fixtureShape(house: House, { kind, at, size, faces, built }: Fixture): SVGGElement {
  const [fa, fb] = outOf[faces], middle: Point = [at[0] + size[0] / 2, at[1] + size[1] / 2];
  /** From its middle to its front, and across it. */
  const half = Math.abs(fa * size[0] + fb * size[1]) / 2, side = Math.abs(fb * size[0] + fa * size[1]) / 2;
  /** A point so far before the middle and beside it. */
  const p = (ahead: number, aside: number) => toPlan(house, [middle[0] + fa * ahead - fb * aside, middle[1] + fb * ahead + fa * aside]);
  const stroke = (name: string, ...points: [number, number][]) => s('path', { class: name, d: path(points.map(([ahead, aside]) => p(ahead, aside)), false) });
  const name = strings.fixtureKind[kind] ?? kind, [x, y] = p(0, 0), [ex] = p(half, 0);
  const lies = Math.abs(ex - x) > half * house.unit_m * 0.7, wide = 2 * (lies ? half : side) * house.unit_m, deep = 2 * (lies ? side : half) * house.unit_m;
  const letters = [...name].reduce((sum, letter) => sum + (letter > '\u2e80' ? WIDE : NARROW), 0), upright = deep > wide * 1.5;
  const font = Math.min(LETTERS, (upright ? deep : wide) * 0.9 / letters, (upright ? wide : deep) * 0.8);
  const climbs = kind === 'stairs' || kind === 'hako-kaidan', treads = climbs ? Math.floor((2 * half - 1e-6) / TREAD) : 0;
  return s('g', { class: `fixture${built ? '' : ' left-out'}`, 'data-kind': kind },
    s('path', { class: 'fixture-area', d: path(rectangleOf(at, size).map(p => toPlan(house, p))) }, s('title', {}, built ? name : strings.leftOut(name))),
    ...Array.from({ length: treads }, (_, i) => stroke('tread', [half - (i + 1) * TREAD, -side], [half - (i + 1) * TREAD, side])),
    ...(climbs ? [stroke('way-up', [half - 0.1, 0], [0.15 - half, 0]), stroke('way-up', [0.35 - half, -0.15], [0.15 - half, 0], [0.35 - half, 0.15])] : []),
    stroke('fixture-front', [half, -side], [half, side]),
    s('text', { class: 'fixture-name', x, y, 'font-size': font, ...(upright ? { transform: `rotate(-90 ${x} ${y})` } : {}) }, name),
    s('circle', { class: 'fixture-corner', cx: toPlan(house, [at[0] + size[0], at[1] + size[1]])[0], cy: toPlan(house, [at[0] + size[0], at[1] + size[1]])[1], r: 0.13 }));
}
