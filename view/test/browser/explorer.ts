// A walker who goes wherever the page lets one go, from the street, opening every door within reach; and the walls of the
// plan, which know nothing of meshes, to tell whether the way led through one.

import type { Page } from 'playwright-core';
import { toHouse, toPlan } from '../../src/plan/coordinates.ts';
import { holds } from '../../src/draw/edits.ts';
import type { House, Point } from '../../src/server/api.ts';
import { CROWN, Obstacles, type Spot } from '../../src/walk/obstacles.ts';
import { until } from './preview.ts';

/** Where a walker stands: x and z of the page, and the height of the ground, metres. */
export type Stand = [x: number, z: number, ground: number];

/** Distance between places, metres, and how far around the house one goes. */
const GRID = 0.3, AROUND = 1.8;

/** Nearer heights are those of one floor, metres. */
const LEVEL = 0.22;

/** Where a hand reaches a door from, metres. */
const HAND = 1.1;

/** Around a door that has slid, ways are new, metres. */
const NEWS = 2.5;

export interface Explored {
  stands: Stand[];
  /** Codes of the doors that were slid open. */
  opened: string[];
  /** Ways through walls of the plan. */
  through: string[];
  /** Names or points of rooms in which one has stood, with the storey. */
  rooms: Set<string>;
  /** Those in which one has not. */
  missed: string[];
  /** Places between two floors that are on no stairs. */
  afloat: string[];
}

/** Goes everywhere from the street; `opens` tells whether doors are opened on the way. */
export async function explore(page: Page, opens: boolean): Promise<Explored> {
  await until(() => page.evaluate(() => hsd.app.doors.size > 0), 'the page knows the doors');
  const { house, origin, level } = await page.evaluate(() => ({
    house: hsd.app.state!.plan.houses[0]!, origin: hsd.app.model!.origin.toArray(), level: hsd.viewport.environment.level,
  }));
  const toPage = (at: Point): Spot => { const [x, y] = toPlan(house, at); return [x - origin[0]!, y - origin[2]!]; };
  const fromPage = ([x, z]: Spot): Point => toHouse(house, [x + origin[0]!, z + origin[2]!]);
  const corners = house.storeys[0]!.rings[0]!.walls.map(wall => toPage(wall.from)), xs = corners.map(c => c[0]), zs = corners.map(c => c[1]);
  const low: Spot = [Math.min(...xs) - AROUND, Math.min(...zs) - AROUND], high: Spot = [Math.max(...xs) + AROUND, Math.max(...zs) + AROUND];
  const [a, b] = house.storeys[0]!.rings[0]!.walls[0]!.from, front = house.storeys[0]!.rings[0]!.walls[0]!.to;
  const start = toPage([(a + front[0]) / 2, b - 1]);
  const opened: string[] = [], used: number[] = [];
  const flood = new Flood(house, low, high, fromPage, origin[1]!);
  let again: (stand: Stand) => boolean = () => false;
  for (;;) {
    const triangles = await trianglesOf(page);
    const obstacles = new Obstacles(triangles, [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2], 60, level);
    if (!flood.stands.length) flood.visit([...start, obstacles.ground(start, 0)]);
    flood.go(obstacles, again);
    const { stands, through } = flood;
    const heads = stands.map(([x, z, ground]) => [x, z, ground, obstacles.headroom([x, z], ground) - CROWN]);
    const doors = opens ? await page.evaluate(({ heads, used, HAND }) => {
      const { model, walk } = hsd.app, eyes = hsd.viewport.camera.position.clone(), middle = eyes.clone(), slid: { part: number; code: string; at: number[] }[] = [];
      for (const part of walk.doors.all) {
        if (used.includes(part)) continue;
        const { code, box } = model!.parts[part]!;
        box.getCenter(middle);
        const near = heads.map(at => ({ at, far: Math.hypot(at[0]! - middle.x, at[1]! - middle.z) })).filter(({ at, far }) => far < HAND && Math.abs(at[2]! - box.min.y) < 0.7);
        for (const { at } of near.sort((one, other) => one.far - other.far)) {
          eyes.set(at[0]!, at[2]! + at[3]!, at[1]!);
          const ray = hsd.ray(eyes.toArray(), middle.clone().setY(at[2]! + 0.8 * at[3]!).sub(eyes).normalize().toArray());
          if (walk.doors.faced(ray) !== part) continue;
          slid.push({ part, code: code!.trim(), at: middle.toArray() });
          walk.doors.use(ray);
          break;
        }
      }
      return slid;
    }, { heads, used, HAND }) : [];
    if (doors.length) {
      used.push(...doors.map(({ part }) => part));
      opened.push(...doors.map(({ code }) => code));
      again = ([x, z]) => doors.some(({ at }) => Math.hypot(at[0]! - x, at[2]! - z) < NEWS);
      await until(() => page.evaluate(() => !hsd.app.walk.doors.busy), 'they have slid');
      continue;
    }
    const rooms = new Set<string>(), all: string[] = [];
    for (const storey of house.storeys) for (const room of storey.rooms) {
      const name = `${storey.storey}: ${room.name} at ${room.at.map(n => n.toFixed(1))}`, floor = storey.z0 + house.origin[2] - origin[1]!;
      all.push(name);
      const [ring, ...holes] = room.area, inside = ([x, z]: Stand) => { const p = fromPage([x, z]); return !!ring && holds(ring, p) && !holes.some(hole => holds(hole, p)); };
      if (stands.some(stand => Math.abs(stand[2] - floor) < 1 && inside(stand))) rooms.add(name);
    }
    return { stands, opened, through, rooms, missed: all.filter(name => !rooms.has(name)), afloat: afloat(house, stands, fromPage, origin[1]!) };
  }
}

/** The triangles of a page. They come as one string, since a list of a million numbers takes seconds on the way. */
async function trianglesOf(page: Page): Promise<Float32Array> {
  const text = await page.evaluate(() => {
    const bytes = new Uint8Array(Float32Array.from(hsd.triangles()).buffer), pieces: string[] = [];
    for (let i = 0; i < bytes.length; i += 0x8000) pieces.push(String.fromCharCode(...bytes.subarray(i, i + 0x8000)));
    return btoa(pieces.join(''));
  });
  const bytes = Buffer.from(text, 'base64');
  return new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
}

/** The places to which steps lead. */
class Flood {
  readonly stands: Stand[] = [];
  readonly through: string[] = [];
  #seen = new Set<string>();
  #next = 0;
  #house: House;
  #low: Spot;
  #high: Spot;
  #fromPage: (at: Spot) => Point;
  #up: number;

  constructor(house: House, low: Spot, high: Spot, fromPage: (at: Spot) => Point, up: number) {
    [this.#house, this.#low, this.#high, this.#fromPage, this.#up] = [house, low, high, fromPage, up];
  }

  visit(stand: Stand) {
    const [x, z, ground] = stand, key = `${Math.round(x / GRID)} ${Math.round(z / GRID)} ${Math.round(ground / LEVEL)}`;
    if (this.#seen.has(key) || x < this.#low[0] || x > this.#high[0] || z < this.#low[1] || z > this.#high[1]) return;
    this.#seen.add(key);
    this.stands.push(stand);
  }

  /** Goes on from new places, and from those where something is new. */
  go(obstacles: Obstacles, again: (stand: Stand) => boolean) {
    for (const stand of this.stands.filter(again)) this.#step(obstacles, stand);
    for (; this.#next < this.stands.length; this.#next++) this.#step(obstacles, this.stands[this.#next]!);
  }

  #step(obstacles: Obstacles, [x, z, ground]: Stand) {
    for (let way = 0; way < 8; way++) {
      const turn = way * Math.PI / 4, next = obstacles.walk([x, z], ground, [GRID * Math.sin(turn) * 1.05, GRID * Math.cos(turn) * 1.05]);
      const wall = crossed(this.#house, this.#fromPage([x, z]), this.#fromPage(next.spot), ground + this.#up, next.ground + this.#up);
      if (wall && this.through.length < 20) this.through.push(wall);
      this.visit([...next.spot, next.ground]);
    }
  }
}

/** What one climbs besides stairs is lower than this, metres: sills, steps of stone, what has a step of its own. */
const CLIMBED = 0.75;

/** Places above a floor, and below the next one, on which no stairs stand. */
function afloat(house: House, stands: Stand[], fromPage: (at: Spot) => Point, up: number): string[] {
  const reach = 0.35;
  return house.storeys.flatMap(({ z0, z1, fixtures }) => stands.filter(([x, z, ground]) => {
    const above = ground + up - house.origin[2] - z0, [a, b] = fromPage([x, z]);
    if (above < CLIMBED || above > z1 - z0 - 0.25) return false;
    return !fixtures.some(({ kind, at, size }) => /stairs|kaidan/.test(kind) && a > at[0] - reach && a < at[0] + size[0] + reach && b > at[1] - reach && b < at[1] + size[1] + reach);
  }).map(([x, z, ground]) => `${fromPage([x, z]).map(n => n.toFixed(2))} at ${ground.toFixed(2)} m`)).slice(0, 20);
}

/** What is open or is opened: kinds of units, and codes of modern doors. */
const WAYS = /^(opening|void|door)$/, MODERN = /^N(SH|AD)/;

/** The wall of the plan that a way leads through, where it is neither a door nor open; null if there is none. */
function crossed(house: House, from: Point, to: Point, z0: number, z1: number): string | null {
  const at = (z0 + z1) / 2 - house.origin[2];
  const storey = house.storeys.findLast(s => s.kind === 'storey' && at > s.z0 - 0.35) ?? house.storeys[0]!;
  for (const wall of storey.rings.flatMap(ring => ring.walls)) for (const unit of wall.units) {
    if (WAYS.test(unit.part) && !unit.code.startsWith('TTB') || MODERN.test(unit.code)) continue;
    if (meet(from, to, unit.from, unit.to)) return `storey ${storey.storey}, ${unit.code} at ${unit.from}–${unit.to}, from ${from.map(n => n.toFixed(2))} to ${to.map(n => n.toFixed(2))}`;
  }
  return null;
}

function meet(p: Point, q: Point, r: Point, s: Point): boolean {
  const side = (a: Point, b: Point, c: Point) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  return side(p, q, r) * side(p, q, s) < 0 && side(r, s, p) * side(r, s, q) < 0;
}
