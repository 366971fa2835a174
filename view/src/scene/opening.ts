// The view that a file opens with: where its houses face each other over a street, from one end along it at eye height.

import type { House } from '../server/api.ts';

/** A place on the ground, metres east and north. */
type Ground = [east: number, north: number];

/** Houses on either side that make a street, and the least share of all houses on each. */
const LEAST = 2, SHARE = 0.25;
/** Fronts this far from one direction face the same way, degrees. */
const ALIKE = 20;
/** Distance of the camera from the first front, metres. */
const BEFORE = 5;

/** Stands before the houses of a street and looks along it; null where houses do not face each other. */
export function alongStreet(houses: Pick<House, 'azimuth' | 'origin'>[]): { from: Ground; to: Ground } | null {
  const facing = (degrees: number) => houses.filter(({ azimuth }) => Math.abs((azimuth - degrees + 540) % 360 - 180) < ALIKE);
  const first = houses[0];
  if (!first) return null;
  const sides = [facing(first.azimuth), facing(first.azimuth + 180)] as const;
  if (sides.some(side => side.length < Math.max(LEAST, houses.length * SHARE))) return null;
  const angle = first.azimuth * Math.PI / 180, out: Ground = [Math.sin(angle), Math.cos(angle)], along: Ground = [out[1], -out[0]];
  const at = ({ origin }: Pick<House, 'origin'>, [e, n]: Ground) => origin[0] * e + origin[1] * n;
  const [own, other] = sides.map(side => side.map(house => at(house, out)).sort((a, b) => a - b));
  // Back to back there is no street between them.
  const [near, far] = [own!.at(-1)!, other![0]!];
  if (far - near < 1) return null;
  const places = sides.flat().map(house => at(house, along)), [begin, end] = [Math.min(...places), Math.max(...places)];
  const middle = (near + far) / 2, ground = (t: number): Ground => [along[0] * t + out[0] * middle, along[1] * t + out[1] * middle];
  return { from: ground(begin - BEFORE), to: ground((begin + end) / 2) };
}
