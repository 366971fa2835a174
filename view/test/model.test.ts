// Models, including those of other programs, are loaded as their files define them.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import * as THREE from 'three';
import { buildModel } from '../src/model/model.ts';

/** A triangle on the ground, facing up. */
const triangle = () => new THREE.BufferGeometry().setFromPoints([new THREE.Vector3(0, 0, 0), new THREE.Vector3(0, 0, 2), new THREE.Vector3(2, 0, 0)]);
const material = new THREE.MeshStandardMaterial();

/** The normal of a model's first triangle. */
function front(root: THREE.Object3D): THREE.Vector3 {
  const { geometry } = buildModel(root).chunks[0]!.mesh, { index } = geometry;
  const [a, b, c] = [0, 1, 2].map(i => new THREE.Vector3().fromBufferAttribute(geometry.getAttribute('position'), index!.getX(i)));
  return b!.sub(a!).cross(c!.sub(a!)).normalize();
}

test('each instance of a mesh has its own transform', () => {
  const root = new THREE.Group(), many = new THREE.InstancedMesh(triangle(), material, 3);
  for (let i = 0; i < 3; i++) many.setMatrixAt(i, new THREE.Matrix4().makeTranslation(10 * i, i, 0));
  many.position.y = 5;
  root.add(many);
  const { chunks, box, triangles } = buildModel(root);
  assert.equal(triangles, 3);
  assert.equal(chunks.length, 1);
  assert.deepEqual(box.min.toArray(), [-11, 5, -1]);
  assert.deepEqual(box.max.toArray(), [11, 7, 1]);
});

test('mirrored instances keep their outside', () => {
  const root = new THREE.Group(), mesh = new THREE.Mesh(triangle(), material);
  root.add(mesh);
  assert.deepEqual(front(root).toArray(), [0, 1, 0]);
  mesh.scale.x = -1;
  assert.ok(front(root).y > 0);
});

test('normal maps of mirrored instances face outward', () => {
  const root = new THREE.Group(), geometry = triangle();
  geometry.setAttribute('tangent', new THREE.Float32BufferAttribute([1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1], 4));
  const mesh = new THREE.Mesh(geometry, material);
  mesh.scale.x = -1;
  root.add(mesh);
  const tangent = buildModel(root).chunks[0]!.mesh.geometry.getAttribute('tangent');
  assert.deepEqual([tangent.getX(0), tangent.getW(0)], [-1, -1]);
});

test('vertex colours are kept where there are any', () => {
  const painted = new THREE.MeshStandardMaterial({ vertexColors: true }), root = new THREE.Group(), geometry = triangle();
  geometry.setAttribute('color', new THREE.Float32BufferAttribute([1, 0, 0, 0, 1, 0, 0, 0, 1], 3));
  root.add(new THREE.Mesh(geometry, painted));
  const [chunk] = buildModel(root).chunks;
  assert.deepEqual([...chunk!.mesh.geometry.getAttribute('color').array], [1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1]);
  assert.ok(painted.vertexColors);
  root.add(new THREE.Mesh(triangle(), painted));
  assert.equal(buildModel(root).chunks[0]!.mesh.geometry.hasAttribute('color'), false);
  assert.equal(painted.vertexColors, false);
});

test('a town in one material is split into chunks', () => {
  const root = new THREE.Group(), many = new THREE.InstancedMesh(triangle(), material, 500_000);
  root.add(many);
  const { chunks, triangles } = buildModel(root);
  assert.equal(triangles, 500_000);
  assert.ok(chunks.length > 1, `${chunks.length} chunks`);
});
