// A storey of all houses as SVG: floors and courts, regions of roofs with their ridges and falls, walls with their units.

import { s } from '../dom.ts';
import { SHAKU } from '../lengths.ts';
import type { House, Point, Ring, State, Storey, Unit, Wall } from '../server.ts';
import { words } from '../words.ts';
import { bounds, path, to_plan, type XY } from './frame.ts';
import { fall_arrow, type Line, ridge_lines } from './ridges.ts';

/** Counted from 0 as strokes count them. */
export interface WallAt {
  house: number;
  storey: number;
  ring: number;
  wall: number;
}

export interface UnitAt extends WallAt { unit: number }

/** What is drawn, and where it stands in the plan. */
export interface Drawn {
  layers: SVGGElement[];
  units: Map<SVGGElement, { at: UnitAt; unit: Unit }>;
  walls: Map<SVGGElement, { at: WallAt; wall: Wall; house: House }>;
}

const REGIONS = 8; // colours in turn
/** Walls whose lengths are written are longer, units. */
const MEASURED = 1.5;

/** Storeys of all houses by their number. */
export const storeys_of = ({ plan }: State) =>
  [...new Set(plan.houses.flatMap(house => house.storeys.map(storey => storey.storey)))].sort((a, b) => a - b);

/** Every place that a plan has. */
export const extent = ({ plan }: State) => bounds(plan.houses.flatMap(house =>
  house.storeys.flatMap(storey => storey.rings.flatMap(ring => ring.walls.flatMap(wall =>
    [to_plan(house, wall.from), to_plan(house, wall.to)])))));

export function picture(state: State, number: number): Drawn {
  const drawn: Drawn = { layers: [], units: new Map(), walls: new Map() };
  const layer = (name: string) => {
    const group = s('g', { class: name });
    drawn.layers.push(group);
    return group;
  };
  const floors = layer('floors'), regions = layer('regions'), roofs = layer('roofs'), below = layer('below');
  const walls = layer('walls');
  for (const [house_index, house] of state.plan.houses.entries()) {
    for (const [storey_index, storey] of house.storeys.entries()) {
      if (storey.storey === number - 1 && storey.kind === 'storey') outlines(house, storey, below);
      if (storey.storey !== number) continue;
      for (const ring of storey.rings) floor(house, ring, floors);
      region_shapes(house, storey, regions, roofs);
      for (const [ring_index, ring] of storey.rings.entries()) {
        for (const [wall_index, wall] of ring.walls.entries()) {
          const at = { house: house_index, storey: storey_index, ring: ring_index, wall: wall_index };
          walls.append(wall_shape(house, wall, at, drawn));
        }
      }
    }
    for (const roof of house.roofs) {
      if (roof.storey !== number) continue;
      const [a0, b0, a1, b1] = roof.rect;
      const corners: Point[] = [[a0, b0], [a1, b0], [a1, b1], [a0, b1]];
      roofs.append(s('path', { class: 'eaves', d: path(corners.map(p => to_plan(house, p))) }));
    }
  }
  return drawn;
}

function floor(house: House, ring: Ring, into: SVGGElement) {
  if (ring.inner || ring.walls.length < 3) return;
  const corners = ring.walls.map(wall => to_plan(house, wall.from));
  into.append(s('path', { class: ring.hole ? 'court' : 'floor', d: path(corners) }));
  if (!ring.hole) return;
  const { x, y, width, height } = bounds(corners)!;
  into.append(s('text', { class: 'court-name', x: x + width / 2, y: y + height / 2, 'font-size': Math.min(width, height) / 5 }, words.legend_court));
}

function outlines(house: House, storey: Storey, into: SVGGElement) {
  for (const ring of storey.rings) {
    if (!ring.inner) into.append(s('path', { d: path(ring.walls.map(wall => to_plan(house, wall.from)), ring.closed) }));
  }
}

function region_shapes(house: House, storey: Storey, into: SVGGElement, over: SVGGElement) {
  const draw = (lines: Line[], name: string) => {
    for (const [p, q] of lines) {
      const [[x1, y1], [x2, y2]] = [to_plan(house, p), to_plan(house, q)];
      over.append(s('line', { class: name, x1, y1, x2, y2 }));
    }
  };
  for (const [i, region] of storey.regions.entries()) {
    const { a0, b0, a1, b1 } = region;
    const corners: Point[] = region.polygon ?? [[a0, b0], [a1, b0], [a1, b1], [a0, b1]];
    into.append(s('path', { class: `region r${i % REGIONS}`, d: path(corners.map(p => to_plan(house, p))) },
      s('title', {}, `${words.legend_region} ${i + 1}: ${words.role[region.role] ?? region.role}, ${region.shape}`)));
    draw(ridge_lines(region, storey.regions), 'ridge');
    draw(fall_arrow(region), 'fall');
  }
  // Roofs that are written have no regions, but ridges.
  if (storey.regions.length) return;
  for (const { ridge, storey: of } of house.roofs) if (ridge && of === storey.storey) draw([ridge], 'ridge');
}

function wall_shape(house: House, wall: Wall, at: WallAt, drawn: Drawn): SVGGElement {
  const group = s('g', { class: 'run' });
  const ends = [to_plan(house, wall.from), to_plan(house, wall.to)] as const;
  drawn.walls.set(group, { at, wall, house });
  for (const [i, unit] of wall.units.entries()) {
    const [x1, y1] = to_plan(house, unit.from), [x2, y2] = to_plan(house, unit.to);
    const line = (name: string) => s('line', { class: name, x1, y1, x2, y2 });
    const shape = s('g', { class: `unit ${unit.part}`, 'data-code': unit.code }, line('hit'), line('base'), line('inner'),
      s('title', {}, unit.code || words.legend_void));
    drawn.units.set(shape, { at: { ...at, unit: i }, unit });
    group.append(shape, tick(ends, [x1, y1]));
  }
  group.append(tick(ends, ends[1]));
  const long = Math.hypot(ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]);
  // Beside it, not in it: the length is no part of what a wall is called.
  return s('g', {}, group, ...long > MEASURED * house.unit_m ? [measure(ends, long)] : []);
}

/** The length of a wall in shaku, outside of it: the interior lies on the right of the walk. */
function measure([[x1, y1], [x2, y2]]: readonly [XY, XY], long: number): SVGTextElement {
  const [nx, ny] = [(y2 - y1) / long * 0.42, -(x2 - x1) / long * 0.42];
  return s('text', { class: 'length', x: (x1 + x2) / 2 + nx, y: (y1 + y2) / 2 + ny, 'font-size': 0.34 },
    `${Number((long / SHAKU).toFixed(2))}`);
}

/** A short line across a wall, where one unit ends and the next begins. */
function tick([[x1, y1], [x2, y2]]: readonly [XY, XY], [x, y]: XY): SVGLineElement {
  const long = Math.hypot(x2 - x1, y2 - y1) || 1, [nx, ny] = [-(y2 - y1) / long * 0.09, (x2 - x1) / long * 0.09];
  return s('line', { class: 'tick', x1: x - nx, y1: y - ny, x2: x + nx, y2: y + ny });
}
