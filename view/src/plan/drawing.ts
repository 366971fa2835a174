// Draws a storey of all houses as SVG: floors and courtyards, roof regions with their ridges and slopes, walls with their
// units.

import { s } from '../ui/dom.ts';
import type { Fixture, House, Point, Ring, Room, State, Storey, Unit, Wall } from '../server/api.ts';
import { strings } from '../ui/strings.ts';
import { bounds, path, toPlan, type XY } from './coordinates.ts';
import { type WallLength, wallLength } from './lengths.ts';
import { fixtureShape, roomShape } from './rooms.ts';
import { fallArrow, type Line, ridgeLines } from './ridges.ts';

/** Indices from 0, as in edits. */
export interface WallIndex {
  house: number;
  storey: number;
  ring: number;
  wall: number;
}

export interface RoomIndex {
  house: number;
  storey: number;
  room: number;
}

export interface FixtureIndex {
  house: number;
  storey: number;
  fixture: number;
}

export interface UnitIndex extends WallIndex { unit: number }

/** The drawn layers, with the units and walls behind their elements. */
export interface PlanDrawing {
  layers: SVGGElement[];
  units: Map<SVGGElement, { at: UnitIndex; unit: Unit }>;
  walls: Map<SVGGElement, { at: WallIndex; wall: Wall; house: House }>;
  rooms: Map<SVGGElement, { at: RoomIndex; room: Room; house: House }>;
  fixtures: Map<SVGGElement, { at: FixtureIndex; fixture: Fixture; house: House }>;
  lengths: WallLength[];
}

const REGIONS = 8; // Number of region colours.
/** Longer walls are labelled with their length, units. */
const MEASURED = 1.5;

/** The storey that stands on the ground. */
const GROUND = 1;

/** The storey numbers of all houses. */
export const storeysOf = ({ plan }: State) =>
  [...new Set(plan.houses.flatMap(house => [...(house.outdoors ? [GROUND] : []), ...house.storeys.map(storey => storey.storey)]))].sort((a, b) => a - b);

/** The bounding rectangle of all walls, eaves and what stands outdoors. */
export const extent = ({ plan }: State) => bounds(plan.houses.flatMap(house => [
  ...house.storeys.flatMap(storey => storey.rings.flatMap(ring => ring.walls.flatMap(wall => [wall.from, wall.to]))),
  ...house.roofs.flatMap(({ rect }) => cornersOf(rect)),
  ...(house.outdoors ?? []).flatMap(({ outline }) => outline),
].map(point => toPlan(house, point))));

const cornersOf = ([a0, b0, a1, b1]: [number, number, number, number]): Point[] => [[a0, b0], [a1, b0], [a1, b1], [a0, b1]];

export function drawStorey(state: State, number: number): PlanDrawing {
  const drawn: PlanDrawing = { layers: [], units: new Map(), walls: new Map(), rooms: new Map(), fixtures: new Map(), lengths: [] };
  const layer = (name: string) => {
    const group = s('g', { class: name });
    drawn.layers.push(group);
    return group;
  };
  const outdoors = layer('outdoors');
  const floors = layer('floors'), regions = layer('regions'), roofs = layer('roofs'), below = layer('below');
  // Above the roofs, so that rooms can be clicked.
  const rooms = layer('rooms'), fixtures = layer('fixtures'), walls = layer('walls');
  for (const [houseIndex, house] of state.plan.houses.entries()) {
    for (const { kind, code, outline } of number === GROUND ? house.outdoors ?? [] : []) {
      outdoors.append(s('path', { class: `${kind} ${kind === 'ground' ? code : ''}`, d: path(outline.map(p => toPlan(house, p))) }, s('title', {}, code)));
    }
    for (const [storeyIndex, storey] of house.storeys.entries()) {
      if (storey.storey === number - 1 && storey.kind === 'storey') outlines(house, storey, below);
      if (storey.storey !== number) continue;
      for (const ring of storey.rings) floor(house, ring, floors);
      regionShapes(house, storey, regions, roofs);
      for (const [room, own] of storey.rooms.entries()) {
        const shape = roomShape(house, own);
        drawn.rooms.set(shape, { at: { house: houseIndex, storey: storeyIndex, room }, room: own, house });
        rooms.append(shape);
      }
      for (const [fixture, own] of storey.fixtures.entries()) {
        const shape = fixtureShape(house, own);
        drawn.fixtures.set(shape, { at: { house: houseIndex, storey: storeyIndex, fixture }, fixture: own, house });
        fixtures.append(shape);
      }
      for (const [ringIndex, ring] of storey.rings.entries()) {
        for (const [wallIndex, wall] of ring.walls.entries()) {
          const at = { house: houseIndex, storey: storeyIndex, ring: ringIndex, wall: wallIndex };
          walls.append(wallShape(house, wall, at, drawn));
        }
      }
    }
    for (const roof of house.roofs) {
      if (roof.storey !== number) continue;
      roofs.append(s('path', { class: 'eaves', d: path(cornersOf(roof.rect).map(p => toPlan(house, p))) }));
    }
  }
  return drawn;
}

function floor(house: House, ring: Ring, into: SVGGElement) {
  if (ring.inner || ring.walls.length < 3) return;
  const corners = ring.walls.map(wall => toPlan(house, wall.from));
  into.append(s('path', { class: ring.hole ? 'court' : 'floor', d: path(corners) }));
  if (!ring.hole) return;
  const { x, y, width, height } = bounds(corners)!;
  into.append(s('text', { class: 'court-name', x: x + width / 2, y: y + height / 2, 'font-size': Math.min(width, height) / 5 }, strings.legendCourt));
}

function outlines(house: House, storey: Storey, into: SVGGElement) {
  for (const ring of storey.rings) {
    if (!ring.inner) into.append(s('path', { d: path(ring.walls.map(wall => toPlan(house, wall.from)), ring.closed) }));
  }
}

function regionShapes(house: House, storey: Storey, into: SVGGElement, over: SVGGElement) {
  const draw = (lines: Line[], name: string) => {
    for (const [p, q] of lines) {
      const [[x1, y1], [x2, y2]] = [toPlan(house, p), toPlan(house, q)];
      over.append(s('line', { class: name, x1, y1, x2, y2 }));
    }
  };
  for (const [i, region] of storey.regions.entries()) {
    const { a0, b0, a1, b1 } = region;
    const corners = region.polygon ?? cornersOf([a0, b0, a1, b1]);
    into.append(s('path', { class: `region r${i % REGIONS}`, d: path(corners.map(p => toPlan(house, p))) },
      s('title', {}, `${strings.legendRegion} ${i + 1}: ${strings.role[region.role] ?? region.role}, ${region.shape}`)));
    draw(ridgeLines(region, storey.regions), 'ridge');
    draw(fallArrow(region), 'fall');
  }
  // Explicit roofs have ridges but no regions.
  if (storey.regions.length) return;
  for (const { ridge, storey: of } of house.roofs) if (ridge && of === storey.storey) draw([ridge], 'ridge');
}

function wallShape(house: House, wall: Wall, at: WallIndex, drawn: PlanDrawing): SVGGElement {
  const group = s('g', { class: 'run' });
  const ends = [toPlan(house, wall.from), toPlan(house, wall.to)] as const;
  drawn.walls.set(group, { at, wall, house });
  for (const [i, unit] of wall.units.entries()) {
    const [x1, y1] = toPlan(house, unit.from), [x2, y2] = toPlan(house, unit.to);
    const line = (name: string) => s('line', { class: name, x1, y1, x2, y2 });
    const shape = s('g', { class: `unit ${unit.part}`, 'data-code': unit.code }, line('hit'), line('base'), line('inner'),
      s('title', {}, unit.code || strings.legendVoid));
    drawn.units.set(shape, { at: { ...at, unit: i }, unit });
    group.append(shape, tick(ends, [x1, y1]));
  }
  group.append(tick(ends, ends[1]));
  const long = Math.hypot(ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]);
  if (long <= MEASURED * house.unit_m) return group;
  const length = wallLength(ends);
  drawn.lengths.push(length);
  // A sibling of the wall's element, so that the length is not part of its accessible name.
  return s('g', {}, group, length.element);
}

/** A short line across a wall between two units. */
function tick([[x1, y1], [x2, y2]]: readonly [XY, XY], [x, y]: XY): SVGLineElement {
  const long = Math.hypot(x2 - x1, y2 - y1) || 1, [nx, ny] = [-(y2 - y1) / long * 0.09, (x2 - x1) / long * 0.09];
  return s('line', { class: 'tick', x1: x - nx, y1: y - ny, x2: x + nx, y2: y + ny });
}
