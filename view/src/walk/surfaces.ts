// The triangles of meshes within a box, in the page's frame.

import * as THREE from 'three';

/** Corners of the geometries that were asked for, three numbers each. */
const corners = new WeakMap<THREE.BufferGeometry, ArrayLike<number>>();

/** The corners of a geometry as plain numbers, whatever they are packed into. */
function cornersOf(geometry: THREE.BufferGeometry): ArrayLike<number> {
  const position = geometry.getAttribute('position');
  if (position instanceof THREE.BufferAttribute && !position.normalized && position.itemSize === 3) return position.array;
  const known = corners.get(geometry);
  if (known) return known;
  const plain = new Float32Array(position.count * 3);
  for (let i = 0; i < position.count; i++) plain.set([position.getX(i), position.getY(i), position.getZ(i)], i * 3);
  corners.set(geometry, plain);
  return plain;
}

/** The corner of what is drawn that is nearest to a place, seen from above; null if nothing is drawn. */
export function nearestCorner(place: THREE.Vector3, meshes: Iterable<THREE.Mesh>): THREE.Vector3 | null {
  const found = new THREE.Vector3(), one = new THREE.Vector3();
  let least = Infinity;
  for (const { geometry, matrixWorld } of meshes) {
    const at = cornersOf(geometry);
    for (let i = 0; i < at.length; i += 3) {
      one.set(at[i]!, at[i + 1]!, at[i + 2]!).applyMatrix4(matrixWorld);
      const far = Math.hypot(one.x - place.x, one.z - place.z);
      if (far < least) { least = far; found.copy(one); }
    }
  }
  return least < Infinity ? found : null;
}

/** The triangles that touch a box: nine numbers each. */
export function trianglesIn(box: THREE.Box3, meshes: Iterable<THREE.Mesh>): Float32Array {
  const found: number[] = [], place = new THREE.Matrix4(), one = new THREE.Vector3();
  for (const mesh of meshes) {
    const { geometry } = mesh, count = mesh instanceof THREE.InstancedMesh ? mesh.count : 1;
    if (!geometry.boundingBox) geometry.computeBoundingBox();
    for (let copy = 0; copy < count; copy++) {
      place.copy(mesh.matrixWorld);
      if (mesh instanceof THREE.InstancedMesh) {
        mesh.getMatrixAt(copy, place);
        place.premultiply(mesh.matrixWorld);
      }
      const own = box.clone().applyMatrix4(place.clone().invert());
      if (!geometry.boundingBox!.intersectsBox(own)) continue;
      const { min, max } = own, at = cornersOf(geometry), index = geometry.index?.array;
      const all = index?.length ?? at.length / 3;
      for (let i = 0; i < all; i += 3) {
        const a = (index ? index[i]! : i) * 3, b = (index ? index[i + 1]! : i + 1) * 3, c = (index ? index[i + 2]! : i + 2) * 3;
        if (Math.min(at[a]!, at[b]!, at[c]!) > max.x || Math.max(at[a]!, at[b]!, at[c]!) < min.x) continue;
        if (Math.min(at[a + 1]!, at[b + 1]!, at[c + 1]!) > max.y || Math.max(at[a + 1]!, at[b + 1]!, at[c + 1]!) < min.y) continue;
        if (Math.min(at[a + 2]!, at[b + 2]!, at[c + 2]!) > max.z || Math.max(at[a + 2]!, at[b + 2]!, at[c + 2]!) < min.z) continue;
        for (const corner of [a, b, c]) {
          one.set(at[corner]!, at[corner + 1]!, at[corner + 2]!).applyMatrix4(place);
          found.push(one.x, one.y, one.z);
        }
      }
    }
  }
  return new Float32Array(found);
}
