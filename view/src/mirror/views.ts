// The mirrored views of a frame: for each visible pane the view's beam mirrored in its plane, and recursively for the panes
// in that beam. Computes planes and rectangles only; nothing is drawn.
//
// A mirrored view is laid out so that what a pane shows lies at the pane's own place on the screen of the view that sees it.
// All views of a frame therefore share one screen, in pixels from the lower left corner.

import * as THREE from 'three';
import type { Chunk } from '../model/model.ts';
import { areaOf, before, clip, hull, type Point, type Rect, rectOf, reflection, sides } from './geometry.ts';
import type { AtlasPlace } from './atlas.ts';
import type { BoxTree } from './box-tree.ts';
import type { Layer, Wall } from './walls.ts';

/** A viewpoint: the camera, or the camera mirrored once or more. */
export interface View {
  /** Number of reflections. */
  level: number;
  parent: View | null;
  /** The eye point; w = 0 for an eye at infinity. */
  eye: THREE.Vector4;
  /** From the page's frame to the screen (-1 to 1), through the mirrors. */
  screen: THREE.Matrix4;
  /** World matrix of the mirrored camera. */
  world: THREE.Matrix4;
  /** The visible space lies in front of all these planes. */
  beam: THREE.Plane[];
  children: View[];
}

/** A mirrored view. */
export interface Mirrored extends View {
  parent: View;
  /** The panes that show it. */
  layers: Layer[];
  plane: THREE.Plane;
  /** The part of the screen that it needs. */
  rect: Rect;
  /** The area covered by those panes: convex, counter-clockwise, pixels. */
  outline: Point[];
  /** Its place in the atlas. */
  place: AtlasPlace;
  chunks: Chunk[];
}

export interface Limits {
  /** Largest number of reflections. */
  depth: number;
  /** Panes of one wall share an image if that shifts it by at most this many pixels. */
  shift: number;
  /** Mirrors with fewer pixels are skipped. */
  pixels: number;
  /** Largest number of views; the largest are kept. */
  views: number;
}

export interface MirrorScene {
  walls: BoxTree<Wall>;
  chunks: BoxTree<Chunk>;
  /** True if a wall in front of a view may be visible from it. */
  visible: (wall: Wall, from: View) => boolean;
}

/** Eyes closer to a pane than this see no reflection in it, metres. */
const NEAR = 1e-3;

/** The view of a camera. */
export function cameraView(camera: THREE.Camera): View {
  const screen = new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
  const m = camera.matrixWorld.elements;
  const flat = camera.projectionMatrix.elements[15] === 1; // Orthographic: the eye is infinitely far away.
  const eye = flat ? new THREE.Vector4(m[8], m[9], m[10], 0) : new THREE.Vector4(m[12], m[13], m[14], 1);
  const frustum = new THREE.Frustum().setFromProjectionMatrix(screen);
  return { level: 0, parent: null, eye, screen, world: camera.matrixWorld.clone(), beam: frustum.planes, children: [] };
}

/** All mirrored views of a frame, parents first; `seen` counts them without the limit on their number. */
export function mirroredViews(eye: View, size: THREE.Vector2, scene: MirrorScene, limits: Limits): { views: Mirrored[]; seen: number } {
  const views: Mirrored[] = [];
  let level: View[] = [eye], seen = 0;
  for (let depth = 1; depth <= limits.depth && level.length > 0; depth++) {
    const found = level.flatMap(view => {
      const panes = scene.walls.within(view.beam)
        .filter(wall => wall.chunks.some(chunk => chunk.mesh.visible) && faces(wall, view) && scene.visible(wall, view))
        .flatMap(wall => panesIn(view, wall, size, limits));
      return mergePanes(panes, limits.shift).map(some => ({ view, ...some }));
    });
    seen += found.length;
    const kept = found.sort((a, b) => areaOf(b.rect) - areaOf(a.rect)).slice(0, Math.max(0, limits.views - views.length))
      .map(({ view, ...some }) => mirrored(view, some, size));
    for (const view of kept) view.parent.children.push(view);
    views.push(...kept);
    level = kept;
  }
  for (const view of views) view.chunks = scene.chunks.within(view.beam).filter(chunk => chunk.mesh.visible);
  return { views, seen };
}

/** True if a view is in front of at least one of a wall's panes. */
const faces = ({ layers }: Wall, { eye }: View) => before(layers.at(-1)!.plane, eye) > NEAR;

/** Panes that share an image. */
interface Panes {
  layers: Layer[];
  /** The outermost plane. */
  plane: THREE.Plane;
  rect: Rect;
  outline: Point[];
  /** Pixels per metre at the nearest point. */
  near: number;
  /** Pixels that separate images would have needed. */
  area: number;
}

/** The panes of a wall that a view sees. */
function panesIn(view: View, wall: Wall, size: THREE.Vector2, limits: Limits): Panes[] {
  const seen = wall.layers.flatMap(layer => {
    if (before(layer.plane, view.eye) <= NEAR) return [];
    let polygon = layer.polygon;
    for (const plane of view.beam) polygon = clip(polygon, plane);
    return polygon.length < 3 ? [] : [{ layer, polygon, near: pixelsPerMetre(view, polygon, size) }];
  });
  const all: Panes[] = [];
  for (let from = 0, to = 0; from < seen.length; from = to) {
    const { layer: { plane }, near } = seen[from]!;
    for (to = from + 1; to < seen.length && shifted(plane, seen[to]!.layer.plane, near) <= limits.shift;) to++;
    const group = seen.slice(from, to);
    const outline = hull(group.flatMap(({ polygon }) => polygon.map(point => onScreen(view, point, size))));
    if (outline.length < 3 || !(areaOf(rectOf(outline, 0)) >= limits.pixels)) continue;
    const rect = rectOf(outline, 1);
    all.push({ layers: group.map(({ layer }) => layer), plane, rect, outline, near, area: areaOf(rect) });
  }
  return all;
}

/** Largest shift of the image, pixels, if panes in one plane show that of a parallel plane. */
const shifted = (a: THREE.Plane, b: THREE.Plane, near: number) => 2 * Math.abs(a.constant - b.constant) * near;

/** A shared image may be this much larger than separate ones, and this many pixels are always allowed. */
const LARGER = 2, LITTLE = 400;

/**
 * Merges neighbouring panes in one plane into one image where that is not much larger than separate ones: they reflect
 * mostly the same things.
 */
function mergePanes(all: Panes[], shift: number): Panes[] {
  const groups: Panes[] = [];
  for (const panes of all) {
    const group = groups.find(group => {
      if (group.plane.normal.dot(panes.plane.normal) < 1 - 1e-7) return false;
      if (shifted(group.plane, panes.plane, Math.max(group.near, panes.near)) > shift + 1e-3) return false;
      return areaOf(rectOf([...group.outline, ...panes.outline], 1)) <= LARGER * (group.area + panes.area) + LITTLE;
    });
    if (!group) {
      groups.push(panes);
      continue;
    }
    group.layers = [...group.layers, ...panes.layers];
    if (panes.plane.constant < group.plane.constant) group.plane = panes.plane;
    group.outline = hull([...group.outline, ...panes.outline]);
    group.rect = rectOf(group.outline, 1);
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
    // One pixel of margin: filtering reads texels around the outline.
    beam: [plane, ...sides(screen, polygon, [2 / size.x, 2 / size.y])],
    children: [],
    layers, plane, rect, outline,
    place: { x: 0, y: 0, width: 0, height: 0 },
    chunks: [],
  };
}

function onScreen(view: View, point: THREE.Vector3, size: THREE.Vector2): Point {
  const at = new THREE.Vector4(point.x, point.y, point.z, 1).applyMatrix4(view.screen);
  return [(at.x / at.w + 1) / 2 * size.x, (at.y / at.w + 1) / 2 * size.y];
}

/** Pixels per metre at the nearest point of a polygon. */
function pixelsPerMetre(view: View, polygon: THREE.Vector3[], size: THREE.Vector2): number {
  const m = view.screen.elements;
  const scale = Math.hypot(m[1]!, m[5]!, m[9]!) * size.y / 2; // The row that yields the screen's y.
  const near = Math.min(...polygon.map(({ x, y, z }) => m[3]! * x + m[7]! * y + m[11]! * z + m[15]!));
  return scale / Math.max(near, 1e-6);
}

/**
 * Sets up a camera for a mirrored view, cropped to its rectangle and clipped at its plane. Images at odd levels are flipped
 * horizontally to keep the winding of triangles.
 */
export function placeCamera(camera: THREE.Camera, view: Mirrored, projection: THREE.Matrix4, size: THREE.Vector2, reach: number) {
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

/**
 * Replaces the near plane by the mirror's plane (oblique clipping): only the depth row changes. Perspective reaches to
 * infinity.
 */
function cut(camera: THREE.Camera, plane: THREE.Plane, reach: number) {
  const { normal, constant } = plane.clone().applyMatrix4(camera.matrixWorldInverse);
  const p = camera.projectionMatrix.elements, parallel = p[15] === 1;
  // Depth = grown * distance to the plane / w - 1: the largest factor that keeps everything before the far plane, at the
  // corners.
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
