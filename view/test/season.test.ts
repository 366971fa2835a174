// The colours of leaves over the year.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import * as THREE from 'three';
import { colourLeaves, tintOf } from '../src/town/season.ts';

test('cherries blossom in spring, turn red in autumn, and pines stay', () => {
  const [red, green, blue] = tintOf('leaves_cherry', 4, 2)!;
  assert.ok(blue > green && red > green, 'pink over green');
  assert.deepEqual(tintOf('leaves_cherry', 7, 1), [1, 1, 1]);
  assert.ok(tintOf('leaves_cherry', 11, 15)![0] > 1.3);
  assert.deepEqual(tintOf('leaves_cherry', 12, 24), tintOf('leaves_cherry', 2, 1), 'bare over the turn of the year');
  for (const name of ['leaves_pine', 'leaves_cedar', 'cedar_dark', 'cherry', 'leaves_constructor']) assert.equal(tintOf(name, 4, 2), null, name);
});

test('colours are those of the day, whatever was set before', () => {
  const leaves = new THREE.MeshStandardMaterial({ name: 'leaves_plane', color: 0x808080 }), before = leaves.color.clone();
  colourLeaves(leaves, { month: 11, day: 20 });
  assert.notDeepEqual(leaves.color, before);
  colourLeaves(leaves, { month: 1, day: 20 });
  colourLeaves(leaves, { month: 6, day: 20 });
  assert.deepEqual(leaves.color, before);
});
