// Where the page stands when it opens a file.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { alongStreet } from '../src/scene/opening.ts';
import type { House } from '../src/server/api.ts';

const house = (azimuth: number, east: number, north: number): Pick<House, 'azimuth' | 'origin'> => ({ azimuth, origin: [east, north, 0] });

test('a street with houses on both sides is seen along it, from its middle', () => {
  const found = alongStreet([house(180, 6, 3.5), house(180, 12, 3.5), house(0, 0, -3.5), house(0, 6, -3.5)])!;
  assert.ok(Math.abs(found.from[1]) < 1e-9 && Math.abs(found.to[1]) < 1e-9, 'in the middle of the street');
  assert.ok(found.from[0] < 0 || found.from[0] > 12, 'outside of it');
  assert.ok(found.to[0] > 0 && found.to[0] < 12, 'towards its middle');
});

test('a turned street is seen along it too', () => {
  const found = alongStreet([house(90, -3, 0), house(90, -3, 8), house(270, 3, 0), house(270, 3, 8)])!;
  assert.ok(Math.abs(found.from[0]) < 1e-9 && Math.abs(found.to[0]) < 1e-9);
});

test('one house, one side, or houses back to back are no street', () => {
  assert.equal(alongStreet([]), null);
  assert.equal(alongStreet([house(180, 0, 0)]), null);
  assert.equal(alongStreet([house(180, 0, 0), house(180, 6, 0), house(180, 12, 0)]), null);
  assert.equal(alongStreet([house(0, 0, 3), house(0, 6, 3), house(180, 0, -3), house(180, 6, -3)]), null);
});
