// Geometry of what moves as a whole on the ground: frames of groups, in metres east and north, turned clockwise.

import type { XY } from '../plan/coordinates.ts';
import type { PlanFrame } from '../server/api.ts';

const turned = ([x, y]: XY, degrees: number): XY => {
  const angle = degrees * Math.PI / 180, [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  return [x * cos + y * sin, y * cos - x * sin];
};

/** A point of a frame on the plan, whose y runs to the south. */
export function fromFrame({ origin, turn }: PlanFrame, at: XY): XY {
  const [east, north] = turned(at, turn);
  return [origin[0] + east, -(origin[1] + north)];
}

/** A point of the plan in a frame. */
export const toFrame = ({ origin, turn }: PlanFrame, [x, y]: XY): XY => turned([x - origin[0], -y - origin[1]], -turn);

/** Turns a point of the plan clockwise around another one. */
export function turnAround([x, y]: XY, [px, py]: XY, degrees: number): XY {
  const angle = degrees * Math.PI / 180, [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  return [px + (x - px) * cos - (y - py) * sin, py + (x - px) * sin + (y - py) * cos];
}

/** The direction of an arrow key on the plan; null for other keys. */
export const arrowWay = (key: string): XY | null =>
  ({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] } as Record<string, XY>)[key] ?? null;

/** Rounds to a whole number of steps, without the last digits of the product. */
export const snapped = (value: number, step: number) => Number((Math.round(value / step) * step).toFixed(3)) + 0;

/** The step of places and corners, metres, and of turns, degrees. */
export const STEP = 0.1, TURN = 5;

/** The frame of the world. */
export const WORLD: PlanFrame = { origin: [0, 0], turn: 0 };
