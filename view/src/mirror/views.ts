// What a frame mirrors: for each pane in sight the beam of the view mirrored in its plane, and so on for panes that the
// beam meets. Only planes and rectangles are worked out here; nothing is drawn.
//
// Screens: a mirrored view is laid out so that what a pane shows lies at the pane's own place on the screen of the view that
// sees it. All views of a frame therefore share one screen, counted in its pixels from the lower left corner.

import * as THREE from 'three';
import type { Chunk } from '../model.ts';
import { area_of, before, clip, hull, type Point, type Rect, rect_of, reflection, sides } from './geometry.ts';
import type { Place } from './atlas.ts';
import type { Tree } from './tree.ts';
import type { Layer, Wall } from './walls.ts';

/** What looks into the scene: the eye, or the eye mirrored once or more. */
export interface View {
  /** How often it is mirrored. */
  level: number;
  parent: View | null;
  /** The point that it looks from; w = 0 where that is at infinity. */
  eye: THREE.Vector4;
  /** From the frame of the page to the screen (-1 to 1), as if looking through the mirrors. */
  screen: THREE.Matrix4;
  /** Where the camera stands: that of the eye mirrored. */
  world: THREE.Matrix4;
  /** What it sees lies before all of these. */
  beam: THREE.Plane[];
  children: View[];
}

/** A view that is mirrored. */
export interface Mirrored extends View {
  parent: View;
  /** Whose panes show it. */
  layers: Layer[];
  plane: THREE.Plane;
  /** What it needs of the screen. */
  rect: Rect;
  /** What of that glass can cover: convex, counter-clockwise, pixels. */
  outline: Point[];
  /** Where it is drawn. */
  place: Place;
  chunks: Chunk[];
}

export interface Limits {
  /** How often a view may be mirrored. */
  depth: number;
  /** Panes of one wall share a picture where that shifts nothing by more pixels. */
  shift: number;
  /** Mirrors with fewer pixels are left out. */
  pixels: number;
  /** Views at most; the largest are kept. */
  views: number;
}

export interface Town {
  walls: Tree<Wall>;
  chunks: Tree<Chunk>;
  /** Whether a wall that lies before a view may be seen from it. */
  visible: (wall: Wall, from: View) => boolean;
}

/** Eyes nearer to a pane see nothing mirrored in it, metres. */
const NEAR = 1e-3;

/** What a camera sees on a screen of so many pixels. */
export function eye_view(camera: THREE.Camera): View {
  const screen = new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
  const m = camera.matrixWorld.elements;
  const flat = camera.projectionMatrix.elements[15] === 1; // parallel: the eye is infinitely far behind
  const eye = flat ? new THREE.Vector4(m[8], m[9], m[10], 0) : new THREE.Vector4(m[12], m[13], m[14], 1);
  const frustum = new THREE.Frustum().setFromProjectionMatrix(screen);
  return { level: 0, parent: null, eye, screen, world: camera.matrixWorld.clone(), beam: frustum.planes, children: [] };
}

/** All mirrored views of a frame, each after those that see it; `seen` = those there would be without limits to their number. */
export function mirrored_views(eye: View, size: THREE.Vector2, town: Town, limits: Limits): { views: Mirrored[]; seen: number } {
  const views: Mirrored[] = [];
  let level: View[] = [eye], seen = 0;
  for (let depth = 1; depth <= limits.depth && level.length > 0; depth++) {
    const found = level.flatMap(view => {
      const panes = town.walls.within(view.beam)
        .filter(wall => wall.chunks.some(chunk => chunk.mesh.visible) && faces(wall, view) && town.visible(wall, view))
        .flatMap(wall => in_wall(view, wall, size, limits));
      return together(panes, limits.shift).map(some => ({ view, ...some }));
    });
    seen += found.length;
    const kept = found.sort((a, b) => area_of(b.rect) - area_of(a.rect)).slice(0, Math.max(0, limits.views - views.length))
      .map(({ view, ...some }) => mirrored(view, some, size));
    for (const view of kept) view.parent.children.push(view);
    views.push(...kept);
    level = kept;
  }
  for (const view of views) view.chunks = town.chunks.within(view.beam).filter(chunk => chunk.mesh.visible);
  return { views, seen };
}

/** Whether a view looks at the front of some of a wall's panes. */
const faces = ({ layers }: Wall, { eye }: View) => before(layers.at(-1)!.plane, eye) > NEAR;

/** Panes that show one picture. */
interface Panes {
  layers: Layer[];
  /** The outermost. */
  plane: THREE.Plane;
  rect: Rect;
  outline: Point[];
  /** How large a metre is where they are nearest, pixels. */
  near: number;
  /** What pictures of their own would have taken, pixels. */
  area: number;
}

/** What a view sees of one wall's panes. */
function in_wall(view: View, wall: Wall, size: THREE.Vector2, limits: Limits): Panes[] {
  const seen = wall.layers.flatMap(layer => {
    if (before(layer.plane, view.eye) <= NEAR) return [];
    let polygon = layer.polygon;
    for (const plane of view.beam) polygon = clip(polygon, plane);
    return polygon.length < 3 ? [] : [{ layer, polygon, near: pixels_per_metre(view, polygon, size) }];
  });
  const all: Panes[] = [];
  for (let from = 0, to = 0; from < seen.length; from = to) {
    const { layer: { plane }, near } = seen[from]!;
    for (to = from + 1; to < seen.length && shifted(plane, seen[to]!.layer.plane, near) <= limits.shift;) to++;
    const group = seen.slice(from, to);
    const outline = hull(group.flatMap(({ polygon }) => polygon.map(point => on_screen(view, point, size))));
    if (outline.length < 3 || !(area_of(rect_of(outline, 0)) >= limits.pixels)) continue;
    const rect = rect_of(outline, 1);
    all.push({ layers: group.map(({ layer }) => layer), plane, rect, outline, near, area: area_of(rect) });
  }
  return all;
}

/** By how many pixels at most a picture is shifted if panes of one plane show that of a parallel one. */
const shifted = (a: THREE.Plane, b: THREE.Plane, near: number) => 2 * Math.abs(a.constant - b.constant) * near;

/** How much larger a picture of several may be than theirs together, and pixels that do not matter. */
const LARGER = 2, LITTLE = 400;

/** Panes of neighbours in one line show one picture where it is not much larger than theirs together: what they mirror is
 * mostly the same, and drawn once. */
function together(all: Panes[], shift: number): Panes[] {
  const groups: Panes[] = [];
  for (const panes of all) {
    const group = groups.find(group => {
      if (group.plane.normal.dot(panes.plane.normal) < 1 - 1e-7) return false;
      if (shifted(group.plane, panes.plane, Math.max(group.near, panes.near)) > shift + 1e-3) return false;
      return area_of(rect_of([...group.outline, ...panes.outline], 1)) <= LARGER * (group.area + panes.area) + LITTLE;
    });
    if (!group) {
      groups.push(panes);
      continue;
    }
    group.layers = [...group.layers, ...panes.layers];
    if (panes.plane.constant < group.plane.constant) group.plane = panes.plane;
    group.outline = hull([...group.outline, ...panes.outline]);
    group.rect = rect_of(group.outline, 1);
    group.near = Math.max(group.near, panes.near);
    group.area += panes.area;
  }
  return groups;
}

function mirrored(parent: View, { layers, plane, rect, outline }: Panes, size: THREE.Vector2): Mirrored {
  const through = reflection(plane);
  const screen = parent.screen.clone().multiply(through);
  const polygon = outline.map(([x, y]): Point => [2 * x / size.x - 1, 2 * y / size.y - 1]);
  return {
    level: parent.level + 1,
    parent,
    eye: parent.eye.clone().applyMatrix4(through),
    screen,
    world: through.clone().multiply(parent.world),
    // A pixel more on all sides: texels round the outline are read where pictures are smaller than what they fill.
    beam: [plane, ...sides(screen, polygon, [2 / size.x, 2 / size.y])],
    children: [],
    layers, plane, rect, outline,
    place: { x: 0, y: 0, width: 0, height: 0 },
    chunks: [],
  };
}

function on_screen(view: View, point: THREE.Vector3, size: THREE.Vector2): Point {
  const at = new THREE.Vector4(point.x, point.y, point.z, 1).applyMatrix4(view.screen);
  return [(at.x / at.w + 1) / 2 * size.x, (at.y / at.w + 1) / 2 * size.y];
}

/** How large a metre is where a polygon is nearest. */
function pixels_per_metre(view: View, polygon: THREE.Vector3[], size: THREE.Vector2): number {
  const m = view.screen.elements;
  const scale = Math.hypot(m[1]!, m[5]!, m[9]!) * size.y / 2; // the row that makes the screen's y
  const near = Math.min(...polygon.map(({ x, y, z }) => m[3]! * x + m[7]! * y + m[11]! * z + m[15]!));
  return scale / Math.max(near, 1e-6);
}

/** A camera for a mirrored view, cropped to its rectangle, cut off at its plane. Pictures at odd levels are flipped sideways,
 * so that no triangle turns its back. */
export function stand(camera: THREE.Camera, view: Mirrored, projection: THREE.Matrix4, size: THREE.Vector2, reach: number) {
  const flipped = view.level % 2 === 1, flip = new THREE.Matrix4().makeScale(-1, 1, 1);
  camera.matrixWorld.copy(view.world);
  camera.projectionMatrix.copy(projection);
  let { x0, x1 } = view.rect;
  if (flipped) {
    camera.matrixWorld.multiply(flip);
    camera.projectionMatrix.premultiply(flip).multiply(flip);
    [x0, x1] = [size.x - x1, size.x - x0];
  }
  camera.matrixWorldInverse.copy(camera.matrixWorld).invert();
  const { y0, y1 } = view.rect;
  camera.projectionMatrix.premultiply(new THREE.Matrix4().set(
    size.x / (x1 - x0), 0, 0, (size.x - x1 - x0) / (x1 - x0),
    0, size.y / (y1 - y0), 0, (size.y - y1 - y0) / (y1 - y0),
    0, 0, 1, 0,
    0, 0, 0, 1,
  ));
  cut(camera, view.plane, reach);
  camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
}

/** Lays a camera's near plane into a mirror's plane: only the row of depths changes. Perspective reaches to infinity. */
function cut(camera: THREE.Camera, plane: THREE.Plane, reach: number) {
  const { normal, constant } = plane.clone().applyMatrix4(camera.matrixWorldInverse);
  const p = camera.projectionMatrix.elements, parallel = p[15] === 1;
  // Depth = grown * distance to the plane / w - 1. The largest growth which keeps all in front of the far end, at the corners.
  let most = parallel ? reach : 1e-9;
  if (!parallel) {
    for (const x of [-1, 1]) {
      for (const y of [-1, 1]) {
        most = Math.max(most, normal.x * (x + p[8]!) / p[0]! + normal.y * (y + p[9]!) / p[5]! - normal.z);
      }
    }
  }
  const grown = 2 / most;
  p[2] = grown * normal.x - p[3]!;
  p[6] = grown * normal.y - p[7]!;
  p[10] = grown * normal.z - p[11]!;
  p[14] = grown * constant - p[15]!;
}
