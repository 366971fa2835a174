// Where a walker comes to, against worked-out places: walls stop and lead along, steps are climbed, roofs are no ground.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import * as THREE from 'three';
import { Obstacles, RADIUS, type Spot } from '../src/walk/obstacles.ts';
import { startIndoors, startNear } from '../src/walk/start.ts';
import { nearestCorner, trianglesIn } from '../src/walk/surfaces.ts';

const EVERYWHERE = new THREE.Box3(new THREE.Vector3(-100, -100, -100), new THREE.Vector3(100, 100, 100));

/** Boxes from their lowest to their highest corners: x, y, z. */
function boxes(...all: [number, number, number, number, number, number][]): THREE.Mesh[] {
  return all.map(([x1, y1, z1, x2, y2, z2]) => {
    const mesh = new THREE.Mesh(new THREE.BoxGeometry(x2 - x1, y2 - y1, z2 - z1));
    mesh.position.set((x1 + x2) / 2, (y1 + y2) / 2, (z1 + z2) / 2);
    mesh.updateMatrixWorld();
    return mesh;
  });
}

const among = (meshes: THREE.Mesh[], level = 0) => new Obstacles(trianglesIn(EVERYWHERE, meshes), [0, 0], 100, level);
const near = (is: number, wanted: number, by = 0.02) => assert.ok(Math.abs(is - wanted) <= by, `${is}, not ${wanted}`);

test('a wall stops who walks into it, at arm\'s length', () => {
  const town = among(boxes([2, 0, -5, 2.2, 3, 5]));
  const { spot, ground } = town.walk([0, 0], 0, [10, 0]);
  near(spot[0], 2 - RADIUS);
  near(spot[1], 0);
  assert.equal(ground, 0);
});

test('who comes at a slant goes along the wall, and past its end', () => {
  const town = among(boxes([2, 0, -5, 2.2, 3, 5]));
  const along = town.walk([0, 0], 0, [3, 3]).spot;
  near(along[0], 2 - RADIUS);
  near(along[1], 3, 0.2);
  const past = town.walk([0, 4], 0, [4, 4]).spot;
  assert.ok(past[0] > 2.5, `${past}`);
});

test('no speed carries through a thin wall, from any side or angle', () => {
  const town = among(boxes([-3, 0, -3, 3, 3, -2.99], [-3, 0, 2.99, 3, 3, 3], [-3, 0, -3, -2.99, 3, 3], [2.99, 0, -3, 3, 3, 3]));
  for (let i = 0; i < 97; i++) {
    const turn = i * 2.399963;
    let at: Spot = [Math.cos(i), Math.sin(i)];
    for (let k = 0; k < 4; k++) at = town.walk(at, 0, [50 * Math.sin(turn + k), 50 * Math.cos(turn + k)]).spot;
    assert.ok(Math.max(...at.map(Math.abs)) < 3 - RADIUS + 0.01, `${at}`);
  }
});

test('a gap lets through who fits', () => {
  const gap = (wide: number) => among(boxes([2, 0, -5, 2.2, 3, -wide / 2], [2, 0, wide / 2, 2.2, 3, 5]));
  assert.ok(gap(0.8).walk([0, 0], 0, [5, 0]).spot[0] > 4.9);
  assert.ok(gap(0.5).walk([0, 0], 0, [5, 0]).spot[0] < 2);
});

test('steps are climbed, walls and low beams are not, eaves are passed under', () => {
  const stairs = among(boxes([1, 0, -2, 2, 0.3, 2], [2, 0, -2, 3, 0.6, 2], [3, 0, -2, 6, 0.9, 2]));
  const up = stairs.walk([0, 0], 0, [4, 0]);
  near(up.ground, 0.9, 1e-6);
  near(stairs.walk(up.spot, up.ground, [-4, 0]).ground, 0, 1e-6);
  assert.ok(among(boxes([1, 0, -2, 2, 0.6, 2])).walk([0, 0], 0, [4, 0]).spot[0] < 1, 'a wall of 0.6 m');
  assert.ok(among(boxes([1, 1, -2, 2, 1.1, 2])).walk([0, 0], 0, [4, 0]).spot[0] < 1, 'a beam at 1 m');
  near(among(boxes([1, 1.8, -2, 2, 1.9, 2])).walk([0, 0], 0, [4, 0]).spot[0], 4);
  assert.ok(among(boxes([1, 0.5, -2, 5, 0.6, 2])).walk([0, 0], 0, [4, 0]).spot[0] < 1, 'a deck');
});

test('one stoops under a low lintel, and stands again behind it', () => {
  const house = among(boxes([1, 1.2, -2, 2, 3, 2], [4, 0, -2, 5, 3, 2]));
  const { spot } = house.walk([0, 0], 0, [1.5, 0]);
  near(spot[0], 1.5);
  near(house.headroom(spot, 0), 1.2, 0.05);
  assert.ok(house.headroom(spot, 0) <= 1.2);
  for (const x of [0, 3, 4 - RADIUS]) assert.equal(house.headroom([x, 0], 0), 1.6, `at ${x}`);
});

test('a slope is walked up, a steep roof is not', () => {
  const slope = (rise: number) => {
    const mesh = new THREE.Mesh(new THREE.PlaneGeometry(10, 10));
    mesh.rotation.set(-Math.PI / 2, Math.atan(rise), 0, 'ZYX');
    mesh.position.x = 5;
    mesh.updateMatrixWorld();
    const plane = new THREE.Mesh(new THREE.BufferGeometry().setAttribute('position', new THREE.Float32BufferAttribute([0, 0, -5, 0, 0, 5, 10, 10 * rise, 5, 0, 0, -5, 10, 10 * rise, 5, 10, 10 * rise, -5], 3)));
    plane.updateMatrixWorld();
    return among([plane]);
  };
  const up = slope(0.2).walk([-1, 0], 0, [6, 0]);
  near(up.ground, 1, 0.02);
  assert.ok(slope(3).walk([-1, 0], 0, [6, 0]).spot[0] < 1);
});

test('who is inside of something that has come may leave it', () => {
  const town = among(boxes([-0.1, 0, -5, 0.1, 3, 5]));
  assert.ok(town.walk([0.25, 0], 0, [3, 0]).spot[0] > 3, 'away from it');
  assert.ok(town.walk([0.25, 0], 0, [-3, 0]).spot[0] > 0, 'not through it');
});

test('instances and packed corners count like others', () => {
  const mesh = new THREE.InstancedMesh(new THREE.BoxGeometry(1, 2, 8), new THREE.MeshBasicMaterial(), 2);
  mesh.setMatrixAt(0, new THREE.Matrix4().makeTranslation(4, 1, 0));
  mesh.setMatrixAt(1, new THREE.Matrix4().makeTranslation(-4, 1, 0));
  mesh.updateMatrixWorld();
  near(among([mesh]).walk([0, 0], 0, [9, 0]).spot[0], 3.5 - RADIUS);
  near(among([mesh]).walk([0, 0], 0, [-9, 0]).spot[0], RADIUS - 3.5);
  const packed = new THREE.Mesh(new THREE.BoxGeometry(2, 2, 2)), { position } = packed.geometry.attributes;
  packed.geometry.setAttribute('position', new THREE.BufferAttribute(new Int16Array([...position!.array].map(value => value * 32767)), 3, true));
  packed.position.set(3, 0, 0);
  packed.updateMatrixWorld();
  near(among([packed]).walk([0, 0], 0, [9, 0]).spot[0], 2 - RADIUS);
});

test('the nearest corner of what is drawn is found from far away', () => {
  const meshes = boxes([200, 0, 0, 210, 6, 10], [300, 0, 0, 310, 6, 10]);
  const { x, z } = nearestCorner(new THREE.Vector3(0, 0, 40), meshes)!;
  assert.deepEqual([x, z], [200, 10]);
  assert.equal(nearestCorner(new THREE.Vector3(), []), null);
});

test('a walk begins outside, where a way leads somewhere, and looks along it', () => {
  // Two rows of houses with flat roofs on a street from west to east; between the houses of the south a closed court.
  const street = among(boxes([-20, 0, -12, 20, 6, -3], [-20, 0, 3, -4, 6, 14], [4, 0, 3, 20, 6, 14], [-4, 0, 3, 4, 6, 4], [-4, 0, 13, 4, 6, 14]));
  for (const at of [[0, -8], [10, 8], [0, 8], [0, 0]] as Spot[]) {
    const start = startNear(street, at, 0)!;
    assert.ok(Math.abs(start.spot[1]) < 3 || Math.abs(start.spot[0]) > 20 || Math.abs(start.spot[1]) > 12, `from ${at} to ${start.spot}`);
    near(start.ground, 0, 1e-6);
  }
  const within = startNear(street, [0, 0], 0)!, along = Math.abs(Math.sin(within.heading));
  assert.ok(along > 0.9, `it looks to ${within.heading}`);
});

test('who looks at a room from inside begins there, who hovers over a house does not', () => {
  // A floor with two steps up to it, walls, and a ceiling.
  const room = among(boxes([-4, 0, -4, 4, 0.5, 4], [-4, 0.5, -4.2, 4, 3, -4], [-4, 3, -4, 4, 3.2, 4]));
  const start = startIndoors(room, [0, 0], 1.6, 1)!;
  assert.deepEqual([start.spot, start.heading], [[0, 0], 1]);
  near(start.ground, 0.5, 1e-6);
  assert.equal(startIndoors(room, [0, 0], 4.5, 1), null, 'over the roof');
  assert.equal(startIndoors(room, [0, 6], 1.6, 1), null, 'outside');
  assert.equal(startIndoors(room, [0, -3.9], 1.6, 1), null, 'in the wall');
});
