// Geometry that mirrors need: planes as they lie in space, polygons in them and on the screen. No drawing.

import * as THREE from 'three';

/** A point of the screen, or of a plane in axes of its own. */
export type Point = [x: number, y: number];

/** A rectangle of whole pixels: from its lower left corner to beyond its upper right one. */
export interface Rect {
  x0: number;
  y0: number;
  x1: number;
  y1: number;
}

/** Mirrors points in a plane. */
export function reflection({ normal: { x, y, z }, constant: d }: THREE.Plane): THREE.Matrix4 {
  return new THREE.Matrix4(
    1 - 2 * x * x, -2 * x * y, -2 * x * z, -2 * x * d,
    -2 * x * y, 1 - 2 * y * y, -2 * y * z, -2 * y * d,
    -2 * x * z, -2 * y * z, 1 - 2 * z * z, -2 * z * d,
    0, 0, 0, 1,
  );
}

/** How far before a plane an eye stands; an eye at infinity has w = 0. */
export function before(plane: THREE.Plane, eye: THREE.Vector4): number {
  const { x, y, z } = plane.normal;
  return x * eye.x + y * eye.y + z * eye.z + plane.constant * eye.w;
}

/** What of a polygon lies before a plane. */
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

/** The convex hull, counter-clockwise, without points along its sides. */
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

/** Positive where c lies to the left of the way from a to b. */
const turn = (a: Point, b: Point, c: Point) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);

/** The whole pixels that points lie in, and `pad` more on all sides. */
export function rect_of(points: Point[], pad: number): Rect {
  const rect = { x0: Infinity, y0: Infinity, x1: -Infinity, y1: -Infinity };
  for (const [x, y] of points) {
    rect.x0 = Math.min(rect.x0, x);
    rect.y0 = Math.min(rect.y0, y);
    rect.x1 = Math.max(rect.x1, x);
    rect.y1 = Math.max(rect.y1, y);
  }
  return { x0: Math.floor(rect.x0) - pad, y0: Math.floor(rect.y0) - pad, x1: Math.ceil(rect.x1) + pad, y1: Math.ceil(rect.y1) + pad };
}

export const area_of = ({ x0, y0, x1, y1 }: Rect) => Math.max(0, x1 - x0) * Math.max(0, y1 - y0);

/** A plane whose points have `row · point = 0`, its front where that is positive. */
export function plane_of(a: number, b: number, c: number, d: number): THREE.Plane {
  return new THREE.Plane(new THREE.Vector3(a, b, c), d).normalize();
}

/** The sides of what a view sees through a convex polygon of its screen (counter-clockwise, -1 to 1), moved out by `pad`. */
export function sides(view: THREE.Matrix4, polygon: Point[], pad: Point): THREE.Plane[] {
  const m = view.elements;
  return polygon.flatMap(([x0, y0], i) => {
    const [x1, y1] = polygon[(i + 1) % polygon.length]!;
    const a = y0 - y1, b = x1 - x0;
    if (a === 0 && b === 0) return [];
    const c = -(a * x0 + b * y0) + Math.abs(a) * pad[0] + Math.abs(b) * pad[1];
    const row = (j: number) => a * m[4 * j]! + b * m[4 * j + 1]! + c * m[4 * j + 3]!;
    return [plane_of(row(0), row(1), row(2), row(3))];
  });
}

/** Two axes of a plane, right-handed with its normal. */
export function axes(normal: THREE.Vector3): [THREE.Vector3, THREE.Vector3] {
  const up = Math.abs(normal.y) < 0.9 ? new THREE.Vector3(0, 1, 0) : new THREE.Vector3(1, 0, 0);
  const u = up.cross(normal).normalize();
  return [u, new THREE.Vector3().crossVectors(normal, u)];
}
