// Rooms of the plan.

import { s } from '../ui/dom.ts';
import type { House, Point, Room } from '../server/api.ts';
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
