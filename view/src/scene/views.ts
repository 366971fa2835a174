// Preset camera views. Directions are given for a house that faces south and rotated with its front.

import * as THREE from 'three';

/** Eye height of a person on the street, metres. */
export const EYE_HEIGHT = 1.6;

export const VIEWS = ['front', 'eaves', 'above', 'back', 'left', 'right', 'top'] as const;
export type View = (typeof VIEWS)[number];

/** Directions to the camera; `level`: a level camera at this fraction of the model's height, or at eye height (null). */
const DIRECTIONS: Record<View, { way: [number, number, number]; level?: number | null }> = {
  front: { way: [-0.62, 0, 1], level: null },
  eaves: { way: [-0.62, 0, 1], level: 0.55 },
  above: { way: [0.72, 0.5, 1] },
  back: { way: [-0.75, 0.5, -1] },
  // As seen from the street: the left side of a south front is the west.
  left: { way: [-1, 0.12, 0.0001] },
  right: { way: [1, 0.12, 0.0001] },
  top: { way: [0, 1, 0.0001] },
};

/** Parallel projections: elevations of the four sides, and the roofs from straight above. */
export const ELEVATIONS = ['elevation-front', 'elevation-back', 'elevation-left', 'elevation-right', 'plan'] as const;
export type Elevation = (typeof ELEVATIONS)[number];

const SIDES: Record<Elevation, [number, number, number]> = {
  'elevation-front': [0, 0, 1],
  'elevation-back': [0, 0, -1],
  'elevation-left': [-1, 0, 0],
  'elevation-right': [1, 0, 0],
  plan: [0, 1, 0],
};

/** A parallel camera at right angles to a side, as wide as some points need it in an image of this aspect. */
export function elevationCamera(view: Elevation, azimuth: number, points: THREE.Vector3[], aspect: number): THREE.OrthographicCamera {
  const axis = new THREE.Vector3(0, 1, 0), way = new THREE.Vector3(...SIDES[view]).applyAxisAngle(axis, turnOf(azimuth));
  const camera = new THREE.OrthographicCamera();
  // The front is at the bottom of a plan.
  if (view === 'plan') camera.up.set(0, 0, -1).applyAxisAngle(axis, turnOf(azimuth));
  const box = new THREE.Box3().setFromPoints(points), reach = box.getSize(new THREE.Vector3()).length();
  camera.position.copy(box.getCenter(new THREE.Vector3()));
  camera.lookAt(camera.position.clone().sub(way));
  camera.updateMatrixWorld();
  const seen = new THREE.Box3().setFromPoints(points.map(point => point.clone().applyMatrix4(camera.matrixWorldInverse)));
  const size = seen.getSize(new THREE.Vector3()), centre = seen.getCenter(new THREE.Vector3());
  const height = Math.max(size.y / 0.8, size.x / 0.9 / aspect), width = height * aspect;
  Object.assign(camera, {
    left: centre.x - width / 2, right: centre.x + width / 2, top: centre.y + height / 2, bottom: centre.y - height / 2,
    near: -2 * reach, far: 100 * reach,
  });
  camera.updateProjectionMatrix();
  return camera;
}

/** Rotation about y of a front's azimuth from the south, radians. */
const turnOf = (azimuth: number) => (180 - azimuth) * Math.PI / 180;

/** Direction to the camera for a front of this azimuth. */
export function directionOf(view: View, azimuth: number): { way: THREE.Vector3; level: number | null | undefined } {
  const { way, level } = DIRECTIONS[view];
  return { way: new THREE.Vector3(...way).normalize().applyAxisAngle(new THREE.Vector3(0, 1, 0), turnOf(azimuth)), level };
}

/** The corners of boxes. */
export function cornersOf(boxes: Iterable<THREE.Box3>): THREE.Vector3[] {
  const corners: THREE.Vector3[] = [];
  for (const { min, max } of boxes) {
    if (min.x > max.x) continue;
    for (let i = 0; i < 8; i++) {
      corners.push(new THREE.Vector3(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z));
    }
  }
  return corners;
}

/** Bounds of projected points, -1 to 1 inside the image; null if a point lies behind the camera. */
export function projectedBounds(camera: THREE.Camera, points: THREE.Vector3[]): THREE.Box2 | null {
  camera.updateMatrixWorld();
  const whole = new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
  const seen = new THREE.Vector4(), bounds = new THREE.Box2();
  for (const { x, y, z } of points) {
    seen.set(x, y, z, 1).applyMatrix4(whole);
    if (seen.w < 0.1) return null;
    bounds.expandByPoint(new THREE.Vector2(seen.x / seen.w, seen.y / seen.w));
  }
  return bounds;
}

/** Moves a camera as close to a box as its size allows; returns the target. */
export function frameBox(camera: THREE.PerspectiveCamera, box: THREE.Box3, view: View, azimuth: number): THREE.Vector3 {
  const { way, level } = directionOf(view, azimuth);
  const target = box.getCenter(new THREE.Vector3()), size = box.getSize(new THREE.Vector3()).length();
  const ground = Math.min(0, box.min.y);
  const eye = level === undefined ? undefined : ground + (level === null ? EYE_HEIGHT : level * (box.max.y - ground));
  const points = cornersOf([box]);
  const place = (far: number) => {
    camera.position.copy(target).addScaledVector(way, far);
    if (eye !== undefined) camera.position.y = eye;
    camera.lookAt(target);
    return projectedBounds(camera, points);
  };
  let near = size * 0.2, far = size * 8;
  for (let step = 0; step < 24; step++) {
    const half = (near + far) / 2, bounds = place(half);
    const most = bounds ? Math.max(-bounds.min.x, bounds.max.x, -bounds.min.y, bounds.max.y) : 2;
    if (most > 0.86) near = half; else far = half;
  }
  place(far);
  return target;
}
