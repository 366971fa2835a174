// Geometry for mirrors: planes, polygons in them and their projections. No drawing.

import * as THREE from 'three';

/** A point on the screen, or in the axes of a plane. */
export type Point = [x: number, y: number];

/** A half-open rectangle of whole pixels, origin at the lower left. */
export interface Rect {
  x0: number;
  y0: number;
  x1: number;
  y1: number;
}

/** The reflection matrix of a plane. */
export function reflection({ normal: { x, y, z }, constant: d }: THREE.Plane): THREE.Matrix4 {
  return new THREE.Matrix4(
    1 - 2 * x * x, -2 * x * y, -2 * x * z, -2 * x * d,
    -2 * x * y, 1 - 2 * y * y, -2 * y * z, -2 * y * d,
    -2 * x * z, -2 * y * z, 1 - 2 * z * z, -2 * z * d,
    0, 0, 0, 1,
  );
}

/** Signed distance of an eye to a plane; an eye at infinity has w = 0. */
export function before(plane: THREE.Plane, eye: THREE.Vector4): number {
  const { x, y, z } = plane.normal;
  return x * eye.x + y * eye.y + z * eye.z + plane.constant * eye.w;
}

/** The part of a polygon in front of a plane. */
export function clip(polygon: THREE.Vector3[], plane: THREE.Plane): THREE.Vector3[] {
  const kept: THREE.Vector3[] = [];
  let last = polygon.at(-1);
  if (!last) return kept;
  let was = plane.distanceToPoint(last);
  for (const point of polygon) {
    const is = plane.distanceToPoint(point);
    if (is >= 0 !== was >= 0) kept.push(last.clone().lerp(point, was / (was - is)));
    if (is >= 0) kept.push(point);
    last = point;
    was = is;
  }
  return kept;
}

/** The convex hull, counter-clockwise, without collinear points. */
export function hull(points: Point[]): Point[] {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  if (sorted.length < 3) return sorted;
  const half = (along: Point[]) => {
    const chain: Point[] = [];
    for (const p of along) {
      while (chain.length > 1 && turn(chain.at(-2)!, chain.at(-1)!, p) <= 1e-9) chain.pop();
      chain.push(p);
    }
    chain.pop();
    return chain;
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

/** Positive where c lies to the left of the line from a to b. */
const turn = (a: Point, b: Point, c: Point) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);

/** The bounding rectangle of points in whole pixels, grown by `pad`. */
export function rectOf(points: Point[], pad: number): Rect {
  const rect = { x0: Infinity, y0: Infinity, x1: -Infinity, y1: -Infinity };
  for (const [x, y] of points) {
    rect.x0 = Math.min(rect.x0, x);
    rect.y0 = Math.min(rect.y0, y);
    rect.x1 = Math.max(rect.x1, x);
    rect.y1 = Math.max(rect.y1, y);
  }
  return { x0: Math.floor(rect.x0) - pad, y0: Math.floor(rect.y0) - pad, x1: Math.ceil(rect.x1) + pad, y1: Math.ceil(rect.y1) + pad };
}

export const areaOf = ({ x0, y0, x1, y1 }: Rect) => Math.max(0, x1 - x0) * Math.max(0, y1 - y0);

/** The plane a x + b y + c z + d = 0, with its front where the sum is positive. */
export function planeOf(a: number, b: number, c: number, d: number): THREE.Plane {
  return new THREE.Plane(new THREE.Vector3(a, b, c), d).normalize();
}

/**
 * The side planes of the pyramid that a view sees through a convex polygon of its screen (counter-clockwise, -1 to 1), moved
 * outward by `pad`.
 */
export function sides(view: THREE.Matrix4, polygon: Point[], pad: Point): THREE.Plane[] {
  const m = view.elements;
  return polygon.flatMap(([x0, y0], i) => {
    const [x1, y1] = polygon[(i + 1) % polygon.length]!;
    const a = y0 - y1, b = x1 - x0;
    if (a === 0 && b === 0) return [];
    const c = -(a * x0 + b * y0) + Math.abs(a) * pad[0] + Math.abs(b) * pad[1];
    const row = (j: number) => a * m[4 * j]! + b * m[4 * j + 1]! + c * m[4 * j + 3]!;
    return [planeOf(row(0), row(1), row(2), row(3))];
  });
}

/** Two axes of a plane, right-handed with its normal. */
export function axes(normal: THREE.Vector3): [THREE.Vector3, THREE.Vector3] {
  const up = Math.abs(normal.y) < 0.9 ? new THREE.Vector3(0, 1, 0) : new THREE.Vector3(1, 0, 0);
  const u = up.cross(normal).normalize();
  return [u, new THREE.Vector3().crossVectors(normal, u)];
}
