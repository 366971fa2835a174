// Components of reflections: reflection matrices, clipping, beams, bounding volumes, atlas packing, walls of glass.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import * as THREE from 'three';
import { pack, type AtlasPlace, packShelves } from '../src/mirror/atlas.ts';
import { areaOf, axes, before, clip, hull, type Point, rectOf, reflection, sides } from '../src/mirror/geometry.ts';
import { BoxTree } from '../src/mirror/box-tree.ts';
import { cameraView, type Limits, mirroredViews, placeCamera } from '../src/mirror/views.ts';
import { ATTRIBUTE, type Wall, findWalls } from '../src/mirror/walls.ts';
import { type Model, buildModel } from '../src/model/model.ts';

const near = (a: THREE.Vector3, b: THREE.Vector3, by = 1e-9) => assert(a.distanceTo(b) < by, `${a.toArray()} is not ${b.toArray()}`);
const v = (x: number, y: number, z: number) => new THREE.Vector3(x, y, z);

/** A seeded generator of numbers in [0, 1). */
function dice(seed: number): () => number {
  return () => {
    seed = Math.imul(seed ^ (seed >>> 15), 0x2c1b3c6d) + 0x9e3779b9 | 0;
    return ((seed ^ (seed >>> 13)) >>> 0) / 2 ** 32;
  };
}

test('a point and its mirror image lie on one normal of the plane, equally far from it', () => {
  const roll = dice(1);
  for (let i = 0; i < 50; i++) {
    const plane = new THREE.Plane(v(roll() - 0.5, roll() - 0.5, roll() - 0.5).normalize(), roll() * 10 - 5);
    const point = v(roll() * 20, roll() * 20, roll() * 20), image = point.clone().applyMatrix4(reflection(plane));
    assert(Math.abs(plane.distanceToPoint(point) + plane.distanceToPoint(image)) < 1e-9);
    assert(image.clone().sub(point).cross(plane.normal).length() < 1e-9);
    near(image.applyMatrix4(reflection(plane)), point);
    assert(reflection(plane).determinant() < 0);
  }
});

test('an eye at infinity is in front of a plane that faces it', () => {
  const plane = new THREE.Plane(v(0, 0, 1), -3);
  assert.equal(before(plane, new THREE.Vector4(0, 0, 5, 1)), 2);
  assert.equal(before(plane, new THREE.Vector4(0, 0, 1, 0)), 1);
  assert(before(plane, new THREE.Vector4(0, 0, -1, 0)) < 0);
});

test('clipping keeps the part in front of the plane', () => {
  const square = [v(0, 0, 0), v(2, 0, 0), v(2, 2, 0), v(0, 2, 0)];
  const half = clip(square, new THREE.Plane(v(1, 0, 0), -1));
  assert.equal(half.length, 4);
  assert.deepEqual([...new Set(half.map(p => p.x))].sort(), [1, 2]);
  assert.equal(clip(square, new THREE.Plane(v(1, 0, 0), 0)).length, 4, 'touching counts as in front');
  assert.equal(clip(square, new THREE.Plane(v(1, 0, 0), -3)).length, 0);
  const corner = clip(square, new THREE.Plane(v(-1, -1, 0).normalize(), 3 / Math.SQRT2));
  assert.equal(corner.length, 5, 'a corner is cut off');
  assert.deepEqual(clip([], new THREE.Plane(v(1, 0, 0), 0)), []);
});

test('the convex hull is counter-clockwise and has no collinear points', () => {
  assert.deepEqual(hull([[0, 0], [1, 0], [2, 0], [2, 2], [1, 1], [0, 2], [0, 1]]), [[0, 0], [2, 0], [2, 2], [0, 2]]);
  const roll = dice(2), points = Array.from({ length: 100 }, (): Point => [roll(), roll()]), round = hull(points);
  round.forEach(([x0, y0], i) => {
    const [x1, y1] = round[(i + 1) % round.length]!;
    for (const [x, y] of points) assert((x1 - x0) * (y - y0) - (y1 - y0) * (x - x0) > -1e-9);
  });
});

test('rectangles are grown to whole pixels', () => {
  assert.deepEqual(rectOf([[0.2, 3.9], [2, 5.1]], 1), { x0: -1, y0: 2, x1: 3, y1: 7 });
  assert.equal(areaOf({ x0: 3, y0: 0, x1: 1, y1: 5 }), 0);
});

test('the axes of a plane are right-handed with its normal', () => {
  for (const normal of [v(0, 1, 0), v(0, -1, 0), v(1, 0, 0), v(0.6, 0, -0.8), v(0, 0.6, 0.8)]) {
    const [a, b] = axes(normal);
    near(a.clone().cross(b), normal);
  }
});

test('the side planes of a view bound what it shows', () => {
  const camera = new THREE.PerspectiveCamera(60, 1.5, 0.1, 100);
  camera.position.set(3, 2, 5);
  camera.lookAt(0, 0, 0);
  camera.updateMatrixWorld();
  const { screen } = cameraView(camera), triangle: Point[] = [[-0.5, -0.4], [0.6, -0.2], [0.1, 0.7]], planes = sides(screen, triangle, [0, 0]);
  const roll = dice(3), inside = ([x, y]: Point) => triangle.every(([x0, y0], i) => {
    const [x1, y1] = triangle[(i + 1) % 3]!;
    return (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0) >= 0;
  });
  let both = 0;
  for (let i = 0; i < 300; i++) {
    const at: Point = [roll() * 2 - 1, roll() * 2 - 1], point = v(at[0], at[1], roll() * 0.05 + 0.9).unproject(camera);
    assert.equal(planes.every(plane => plane.distanceToPoint(point) >= 0), inside(at));
    both += inside(at) ? 1 : 0;
  }
  assert(both > 20 && both < 280);
});

test('the box tree finds exactly the boxes in a beam without testing all of them', () => {
  const roll = dice(4);
  const boxes = Array.from({ length: 2000 }, (_, id) => {
    const low = v(roll() * 500, roll() * 10, roll() * 500);
    return { id, box: new THREE.Box3(low, low.clone().add(v(roll() * 5, roll() * 5, roll() * 5))) };
  });
  const camera = new THREE.PerspectiveCamera(30, 1, 0.1, 60), tree = new BoxTree(boxes);
  camera.position.set(200, 5, 200);
  camera.updateMatrixWorld();
  const { beam } = cameraView(camera), found = tree.within(beam).map(({ id }) => id).sort((a, b) => a - b);
  const touches = (box: THREE.Box3) => beam.every(({ normal: n, constant }) =>
    Math.max(n.x * box.min.x, n.x * box.max.x) + Math.max(n.y * box.min.y, n.y * box.max.y) + Math.max(n.z * box.min.z, n.z * box.max.z) + constant >= 0);
  assert.deepEqual(found, boxes.filter(({ box }) => touches(box)).map(({ id }) => id));
  assert(found.length > 3 && tree.tested < 300, `${found.length} found, ${tree.tested} tested`);
  assert.deepEqual(new BoxTree([]).within(beam), []);
});

const apart = (a: AtlasPlace, b: AtlasPlace) => a.x + a.width <= b.x || b.x + b.width <= a.x || a.y + a.height <= b.y || b.y + b.height <= a.y;

test('images in the atlas do not overlap and share one scale', () => {
  const roll = dice(5), sizes = Array.from({ length: 60 }, () => ({ width: 5 + Math.floor(roll() * 300), height: 5 + Math.floor(roll() * 200) }));
  const whole = packShelves(sizes, 2048)!;
  for (const side of [2048, 512]) {
    const { scale, groups } = pack([sizes, sizes.slice(0, 3)], side)!, places = groups[0]!;
    assert.equal(scale === 1, side === 2048);
    assert(places.every((a, i) => a.x >= 0 && a.y >= 0 && a.x + a.width <= side && a.y + a.height <= side
      && places.every((b, j) => i === j || apart(a, b))));
    assert(places.every(({ width }, i) => width === Math.ceil(sizes[i]!.width * scale)));
  }
  assert.deepEqual(whole.map(({ width, height }) => ({ width, height })), sizes);
  assert.equal(packShelves([{ width: 300, height: 5 }], 256), null);
  assert.equal(pack([[{ width: 9e6, height: 5 }]], 256), null, 'too large at any scale');
});

/** A model with panes of glass: [facade, share, x, y, depth]. */
function model(panes: [facade: number, share: number, x: number, y: number, z: number][]): Model {
  const root = new THREE.Group(), materials = new Map<number, THREE.Material>();
  root.userData = { kind: 'house' };
  const facades = new Map<number, THREE.Group>();
  for (const [facade, share, x, y, z] of panes) {
    let group = facades.get(facade);
    if (!group) {
      facades.set(facade, group = new THREE.Group());
      group.userData = { kind: 'facade' };
      root.add(group);
    }
    const material = materials.get(share) ?? new THREE.MeshStandardMaterial();
    material.userData = { reflection: share };
    materials.set(share, material);
    const pane = new THREE.Mesh(new THREE.BoxGeometry(1, 1, 0.02), material);
    pane.position.set(x, y, z - 0.01);
    pane.userData = { kind: 'part' };
    group.add(pane);
  }
  return buildModel(root);
}

test('panes are grouped by wall and depth, across facades', () => {
  const town = model([[1, 0.7, 0, 0, 0.05], [1, 0.3, 1, 0, 0.03], [2, 0.7, 0, 1, 0.05], [3, 0.7, 30, 0, 0.05], [4, 0, 3, 0, 0.05]]);
  const walls = findWalls(town);
  assert.deepEqual(walls.map(wall => wall.layers.length).sort(), [1, 2], 'storeys of a wall are joined, distant walls are not, and non-reflective glass is skipped');
  const [high] = walls.filter(wall => wall.layers.length === 2);
  const [outer, inner] = high!.layers;
  assert(Math.abs(inner!.plane.constant - outer!.plane.constant - 0.02) < 1e-6, 'the outermost first');
  near(outer!.plane.normal, v(0, 0, 1));
  const size = new THREE.Box3().setFromPoints(outer!.polygon).getSize(v(0, 0, 0));
  near(size, v(1, 2, 0), 1e-6);
  for (const { mesh: { geometry } } of town.chunks) {
    const layer = geometry.getAttribute(ATTRIBUTE), normal = geometry.getAttribute('normal');
    for (let i = 0; i < layer.count; i++) if (normal.getZ(i) < 0.5) assert.equal(layer.getX(i), -1, 'only outward faces reflect');
  }
  assert.equal(town.chunks.flatMap(({ mesh: { geometry } }) => [...geometry.getAttribute(ATTRIBUTE).array]).filter(n => n >= 0).length, 4 * 4);
});

const LIMITS: Limits = { depth: 1, shift: 0, pixels: 1, views: 64 }, SIZE = new THREE.Vector2(400, 300);

function viewsOf(walls: Wall[], town: Model, camera: THREE.Camera, limits: Limits = LIMITS) {
  camera.updateMatrixWorld();
  return mirroredViews(cameraView(camera), SIZE, { walls: new BoxTree(walls), chunks: new BoxTree(town.chunks), visible: () => true }, limits);
}

test('a pane is mirrored only for an eye in front of it that sees it', () => {
  const town = model([[1, 0.7, 0, 0, 0]]), walls = findWalls(town);
  const at = (x: number, z: number, tx: number, tz: number) => {
    const camera = new THREE.PerspectiveCamera(50, 4 / 3, 0.1, 100);
    camera.position.set(x, 0, z);
    camera.lookAt(tx, 0, tz);
    return viewsOf(walls, town, camera).views.length;
  };
  assert.equal(at(0, 5, 0, 0), 1);
  assert.equal(at(0, -5, 0, 0), 0, 'behind');
  assert.equal(at(0, 5, 0, 10), 0, 'looking away');
  assert.equal(at(0, 5, 9, 4), 0, 'looking past it');
  const parallel = new THREE.OrthographicCamera(-4, 4, 3, -3, 0.1, 100);
  parallel.position.set(0, 0, 5);
  assert.equal(viewsOf(walls, town, parallel).views.length, 1);
});

test('panes of one wall share an image where that shifts it little', () => {
  const town = model([[1, 0.7, 0, 0, 0.05], [1, 0.3, 1, 0, 0.03]]), walls = findWalls(town), camera = new THREE.PerspectiveCamera(50, 4 / 3, 0.1, 100);
  camera.position.set(0, 0, 10);
  const layers = (shift: number) => viewsOf(walls, town, camera, { ...LIMITS, shift }).views.map(view => view.layers.length);
  assert.deepEqual(layers(0), [1, 1]);
  assert.deepEqual(layers(5), [2]);
});

test('a reflection is aligned with its pane on the screen, cropped and clipped at the pane', () => {
  const town = model([[1, 0.7, 0.3, 0.2, 0]]), walls = findWalls(town);
  const eyes = [new THREE.PerspectiveCamera(50, 4 / 3, 0.1, 100), new THREE.OrthographicCamera(-4, 4, 3, -3, 0.1, 100)];
  for (const camera of eyes) {
    camera.position.set(2, 1.5, 4);
    camera.lookAt(0, 0, 0);
    const [view] = viewsOf(walls, town, camera).views, { rect } = view!;
    const own = new THREE.Camera();
    placeCamera(own, view!, camera.projectionMatrix, SIZE, 300);
    assert(own.matrixWorld.determinant() > 0, 'the winding of triangles is kept');
    const screen = new THREE.Matrix4().multiplyMatrices(own.projectionMatrix, own.matrixWorldInverse), roll = dice(6);
    for (let i = 0; i < 40; i++) {
      const point = v(roll() * 4 - 2, roll() * 4 - 2, roll() * 6 + 1e-3), image = point.clone().applyMatrix4(reflection(view!.plane));
      const seen = image.project(camera), drawn = point.clone().applyMatrix4(screen);
      const x = (seen.x + 1) / 2 * SIZE.x, y = (seen.y + 1) / 2 * SIZE.y;
      assert(Math.abs((1 - drawn.x) / 2 * (rect.x1 - rect.x0) + rect.x0 - x) < 1e-6, 'flipped sideways');
      assert(Math.abs((1 + drawn.y) / 2 * (rect.y1 - rect.y0) + rect.y0 - y) < 1e-6);
      if (Math.abs(drawn.x) < 1 && Math.abs(drawn.y) < 1) assert(drawn.z > -1 && drawn.z < 1, `depth ${drawn.z}`);
      const behind = point.setZ(-0.01 - roll()).applyMatrix4(screen);
      assert(behind.z < -1, 'everything behind the pane is clipped');
    }
  }
});

test('two facing panes mirror each other up to the recursion depth', () => {
  const town = model([[1, 0.7, 0, 0, 0]]), back = model([[1, 0.7, 0, 0, 0]]), walls = findWalls(town);
  // The same pane, turned round and moved across the street.
  const far: Wall = { ...findWalls(back)[0]!, id: 1 };
  const turn = new THREE.Matrix4().makeRotationY(Math.PI).setPosition(0, 0, 4);
  far.normal = far.normal.clone().transformDirection(turn);
  far.layers = far.layers.map(layer => ({ id: 1, plane: layer.plane.clone().applyMatrix4(turn), polygon: layer.polygon.map(p => p.clone().applyMatrix4(turn)) }));
  far.box = new THREE.Box3().setFromPoints(far.layers[0]!.polygon);
  const camera = new THREE.PerspectiveCamera(70, 4 / 3, 0.05, 100);
  camera.position.set(0.1, 0.1, 3);
  for (const depth of [0, 1, 2, 3, 4]) {
    const { views } = viewsOf([walls[0]!, far], town, camera, { ...LIMITS, depth });
    assert.deepEqual(views.map(view => view.level), [1, 2, 3, 4].slice(0, depth));
    for (const { parent, rect } of views.filter(view => view.level > 1)) {
      const outer = (parent as typeof views[number]).rect;
      assert(rect.x0 >= outer.x0 - 1 && rect.x1 <= outer.x1 + 1 && areaOf(rect) < areaOf(outer));
    }
  }
});
