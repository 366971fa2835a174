// Models that are not ours, too, stand as their file says.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import * as THREE from 'three';
import { model_of } from '../src/model.ts';

/** A triangle on the ground, seen from above. */
const triangle = () => new THREE.BufferGeometry().setFromPoints([new THREE.Vector3(0, 0, 0), new THREE.Vector3(0, 0, 2), new THREE.Vector3(2, 0, 0)]);
const material = new THREE.MeshStandardMaterial();

/** Which way the first triangle of a model looks. */
function front(root: THREE.Object3D): THREE.Vector3 {
  const { geometry } = model_of(root).chunks[0]!.mesh, { index } = geometry;
  const [a, b, c] = [0, 1, 2].map(i => new THREE.Vector3().fromBufferAttribute(geometry.getAttribute('position'), index!.getX(i)));
  return b!.sub(a!).cross(c!.sub(a!)).normalize();
}

test('each instance of a mesh stands at its place', () => {
  const root = new THREE.Group(), many = new THREE.InstancedMesh(triangle(), material, 3);
  for (let i = 0; i < 3; i++) many.setMatrixAt(i, new THREE.Matrix4().makeTranslation(10 * i, i, 0));
  many.position.y = 5;
  root.add(many);
  const { chunks, box, triangles } = model_of(root);
  assert.equal(triangles, 3);
  assert.equal(chunks.length, 1);
  assert.deepEqual(box.min.toArray(), [-11, 5, -1]);
  assert.deepEqual(box.max.toArray(), [11, 7, 1]);
});

test('what stands mirrored keeps its outside', () => {
  const root = new THREE.Group(), mesh = new THREE.Mesh(triangle(), material);
  root.add(mesh);
  assert.deepEqual(front(root).toArray(), [0, 1, 0]);
  mesh.scale.x = -1;
  assert.ok(front(root).y > 0);
});

test('normal maps of what stands mirrored look outward too', () => {
  const root = new THREE.Group(), geometry = triangle();
  geometry.setAttribute('tangent', new THREE.Float32BufferAttribute([1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1], 4));
  const mesh = new THREE.Mesh(geometry, material);
  mesh.scale.x = -1;
  root.add(mesh);
  const tangent = model_of(root).chunks[0]!.mesh.geometry.getAttribute('tangent');
  assert.deepEqual([tangent.getX(0), tangent.getW(0)], [-1, -1]);
});

test('colours of corners are kept, and looked for only where there are some', () => {
  const painted = new THREE.MeshStandardMaterial({ vertexColors: true }), root = new THREE.Group(), geometry = triangle();
  geometry.setAttribute('color', new THREE.Float32BufferAttribute([1, 0, 0, 0, 1, 0, 0, 0, 1], 3));
  root.add(new THREE.Mesh(geometry, painted));
  const [chunk] = model_of(root).chunks;
  assert.deepEqual([...chunk!.mesh.geometry.getAttribute('color').array], [1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1]);
  assert.ok(painted.vertexColors);
  root.add(new THREE.Mesh(triangle(), painted));
  assert.equal(model_of(root).chunks[0]!.mesh.geometry.hasAttribute('color'), false);
  assert.equal(painted.vertexColors, false);
});

test('a town in one material is divided', () => {
  const root = new THREE.Group(), many = new THREE.InstancedMesh(triangle(), material, 500_000);
  root.add(many);
  const { chunks, triangles } = model_of(root);
  assert.equal(triangles, 500_000);
  assert.ok(chunks.length > 1, `${chunks.length} chunks`);
});
