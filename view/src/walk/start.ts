// Where a walk begins: in the room that is looked at from inside, else on the ground, under no roof, with a way ahead.

import { HEIGHT, Obstacles, RADIUS, type Spot } from './obstacles.ts';

/** How far from the place that was looked at. */
export const SEARCHED = 40;

/** Room around a body where a walk begins. */
const ROOM = 1;

/** A way as long as this leads somewhere. */
const LONG = 12;

/** As far as ways are followed. */
export const FARTHEST = 30;

/** What is so much higher than the lowest place nearby, and a slope to it, is a roof. */
const ROOF = 1, SLOPE = 0.15;

const HEADINGS = 24;

/** How high above its floor a room is looked at from inside. */
const LOWEST = 0.4, HIGHEST = 2.2;

export interface Start {
  spot: Spot;
  ground: number;
  /** Clockwise from north, radians. */
  heading: number;
}

/** The start in a room, for eyes at a spot in it; null if they are outside, or too near to something. */
export function startIndoors(obstacles: Obstacles, spot: Spot, eyes: number, heading: number): Start | null {
  if (obstacles.top(spot) <= eyes) return null;
  const ground = obstacles.ground(spot, eyes - LOWEST), high = eyes - ground;
  return high >= LOWEST && high <= HIGHEST && obstacles.nearest(spot, ground).far >= RADIUS ? { spot, ground, heading } : null;
}

/** The nearest place to a spot at which a walk can begin; null if there is none. The heading is the wanted one if a way leads there. */
export function startNear(obstacles: Obstacles, [x, z]: Spot, wanted: number): Start | null {
  const places: { spot: Spot; top: number; away: number }[] = [];
  for (let i = 0; ; i++) {
    const away = 0.7 * Math.sqrt(i), turn = i * 2.399963; // Turns by the golden angle cover a disc evenly.
    if (away > SEARCHED) break;
    const spot: Spot = [x + away * Math.sin(turn), z + away * Math.cos(turn)];
    places.push({ spot, away, top: obstacles.top(spot) });
  }
  let best: (Start & { long: number }) | null = null;
  for (const { spot, top } of places) {
    const high = places.some(other => top > other.top + ROOF + SLOPE * Math.hypot(spot[0] - other.spot[0], spot[1] - other.spot[1]));
    if (high || obstacles.nearest(spot, top, ROOM, HEIGHT).far < ROOM) continue;
    const { heading, long } = longest(obstacles, spot, top, wanted);
    if (!best || long > best.long) best = { spot, ground: top, heading, long };
    if (best.long >= LONG) break;
  }
  return best;
}

/** The heading in which one can walk farthest from a spot; of those that lead somewhere, the one nearest to the wanted one. */
function longest(obstacles: Obstacles, spot: Spot, ground: number, wanted: number): { heading: number; long: number } {
  let best = { heading: wanted, long: -1 };
  // Beginning with the wanted one, turning away to both sides.
  for (let i = 0; i < HEADINGS; i++) {
    const heading = wanted + (i % 2 ? 1 : -1) * Math.ceil(i / 2) * 2 * Math.PI / HEADINGS, way: Spot = [Math.sin(heading), -Math.cos(heading)];
    let long = 0;
    for (; long < FARTHEST; long += 0.5) {
      const ahead: Spot = [spot[0] + way[0] * (long + 0.5), spot[1] + way[1] * (long + 0.5)];
      if (obstacles.nearest(ahead, ground, 0.4, HEIGHT).far < Infinity) break;
    }
    if (long > best.long + (best.long >= LONG ? LONG : 0)) best = { heading, long };
  }
  return best;
}
