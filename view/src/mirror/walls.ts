// Finds a model's reflective glass: the panes of facades, grouped by wall and depth. Panes in one plane form a layer, even
// across the facades of a wall (one per storey). Each glass vertex stores its layer.

import * as THREE from 'three';
import type { Chunk, Model } from '../model/model.ts';
import { axes, hull, type Point } from './geometry.ts';

/** Panes in one plane. */
export interface Layer {
  /** Index in the model, as stored in the vertices. */
  id: number;
  /** Faces outside. */
  plane: THREE.Plane;
  /** Convex outline of the panes, counter-clockwise seen from outside. */
  polygon: THREE.Vector3[];
}

/** The glass of one wall. */
export interface Wall {
  id: number;
  normal: THREE.Vector3;
  /** Outermost first. */
  layers: Layer[];
  chunks: Chunk[];
  box: THREE.Box3;
}

/** Vertex attribute with the layer; `NONE` reflects only the sky. */
export const ATTRIBUTE = 'mirrorLayer';
export const NONE = -1;

/** Panes closer in depth than this lie in one plane: well above f32 rounding, well below a real step. Metres. */
const PLANE_TOLERANCE = 5e-4;
/** Largest gap between facades of one wall, along and across it. Metres. */
const GAP_ALONG = 0.75, GAP_ACROSS = 0.3;
/** Smallest cosine to the facade's direction: includes panes of open doors and slanting windows. */
const OUTWARD = 0.2;

/** Glass triangles of one chunk with one normal. */
interface Piece {
  chunk: Chunk;
  normal: THREE.Vector3;
  box: THREE.Box3;
  /** First corners (positions in the index) with their depth along the normal. */
  triangles: { at: number; depth: number }[];
  depth: number;
}

/** True for glass, reflective or not. */
export const isGlass = ({ mesh: { material } }: Chunk) =>
  (material.userData as { reflection?: number }).reflection !== undefined && !(material as THREE.MeshStandardMaterial).emissiveMap; // Baked reflections are left alone.

/** Finds the walls of a model and sets the layer attribute of its glass. */
export function findWalls(model: Model): Wall[] {
  const pieces: Piece[] = [];
  for (const chunk of model.chunks) {
    if (!isGlass(chunk)) continue;
    const { geometry } = chunk.mesh;
    const layers = geometry.getAttribute(ATTRIBUTE) as THREE.BufferAttribute | undefined;
    if (layers) layers.array.fill(NONE); // Also clears the layers of a previous model.
    else geometry.setAttribute(ATTRIBUTE, new THREE.BufferAttribute(new Float32Array(geometry.getAttribute('position').count).fill(NONE), 1));
    geometry.getAttribute(ATTRIBUTE).needsUpdate = true;
    const front = chunk.reflection > 0 ? model.parts[chunk.owner]?.front : null;
    if (front) pieces.push(...piecesOf(chunk, front));
  }
  let count = 0;
  return groupWalls(pieces).map((group, id) => {
    const wall: Wall = { id, normal: group[0]!.normal, layers: layersOf(group, count), chunks: [], box: new THREE.Box3() };
    count += wall.layers.length;
    for (const { chunk } of group) if (!wall.chunks.includes(chunk)) wall.chunks.push(chunk);
    for (const { polygon } of wall.layers) for (const point of polygon) wall.box.expandByPoint(point);
    return wall;
  });
}

function piecesOf(chunk: Chunk, front: THREE.Vector3): Piece[] {
  const pieces = new Map<string, Piece>();
  const position = chunk.mesh.geometry.getAttribute('position'), index = chunk.mesh.geometry.index!;
  const [a, b, c] = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3()];
  const normal = new THREE.Vector3(), side = new THREE.Vector3();
  for (let at = 0; at < index.count; at += 3) {
    a.fromBufferAttribute(position, index.getX(at));
    b.fromBufferAttribute(position, index.getX(at + 1));
    c.fromBufferAttribute(position, index.getX(at + 2));
    normal.subVectors(b, a).cross(side.subVectors(c, a)).normalize();
    const out = normal.dot(front);
    if (!(out > OUTWARD)) continue;
    if (out > 0.99999) normal.copy(front);
    const key = normal.toArray().map(n => Math.round(n * 1000)).join(' ');
    let piece = pieces.get(key);
    if (!piece) pieces.set(key, piece = { chunk, normal: normal.clone(), box: new THREE.Box3(), triangles: [], depth: 0 });
    piece.box.expandByPoint(a).expandByPoint(b).expandByPoint(c);
    piece.triangles.push({ at, depth: (piece.normal.dot(a) + piece.normal.dot(b) + piece.normal.dot(c)) / 3 });
  }
  const all = [...pieces.values()];
  for (const piece of all) piece.depth = piece.triangles.reduce((sum, t) => sum + t.depth, 0) / piece.triangles.length;
  return all;
}

/** Groups pieces into walls: of one house, facing one way, nearly coplanar and near each other. */
function groupWalls(pieces: Piece[]): Piece[][] {
  const families = new Map<string, Piece[]>();
  for (const piece of pieces) {
    const key = [piece.chunk.house, ...piece.normal.toArray().map(n => Math.round(n * 1000))].join(' ');
    const family = families.get(key);
    if (family) family.push(piece); else families.set(key, [piece]);
  }
  const groups: Piece[][] = [];
  for (const family of families.values()) {
    const left = new Set(family);
    for (const first of family) {
      if (!left.delete(first)) continue;
      const group = [first];
      for (const piece of group) {
        const reach = piece.box.clone().expandByScalar(GAP_ALONG);
        for (const other of left) {
          if (Math.abs(other.depth - piece.depth) > GAP_ACROSS || !reach.intersectsBox(other.box)) continue;
          left.delete(other);
          group.push(other);
        }
      }
      groups.push(group);
    }
  }
  return groups;
}

/** The layers of a wall, outermost first, numbered from `first`. */
function layersOf(group: Piece[], first: number): Layer[] {
  const normal = group[0]!.normal, [u, v] = axes(normal);
  const all = group.flatMap(({ chunk, triangles }) => triangles.map(t => ({ chunk, ...t }))).sort((a, b) => b.depth - a.depth);
  const layers: Layer[] = [], point = new THREE.Vector3();
  for (let from = 0, to = 0; from < all.length; from = to) {
    while (to < all.length && all[Math.max(from, to - 1)]!.depth - all[to]!.depth < PLANE_TOLERANCE) to++;
    const depth = all[(from + to - 1) >> 1]!.depth, id = first + layers.length;
    const points: Point[] = [];
    for (const { chunk, at } of all.slice(from, to)) {
      const { geometry } = chunk.mesh, layer = geometry.getAttribute(ATTRIBUTE);
      for (let i = at; i < at + 3; i++) {
        const vertex = geometry.index!.getX(i);
        layer.setX(vertex, id);
        point.fromBufferAttribute(geometry.getAttribute('position'), vertex);
        points.push([point.dot(u), point.dot(v)]);
      }
    }
    const polygon = hull(points).map(([x, y]) =>
      new THREE.Vector3().addScaledVector(u, x).addScaledVector(v, y).addScaledVector(normal, depth));
    layers.push({ id, plane: new THREE.Plane(normal.clone(), -depth), polygon });
  }
  return layers;
}
