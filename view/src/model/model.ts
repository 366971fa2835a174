// The model as the page uses it. The many nodes of the file are joined into chunks: all triangles of one storey or roof in
// one material, and the glass of one facade. A house takes dozens of draw calls instead of hundreds, parts are found by
// their triangle ranges, and partial views of a town (mirrors) cull chunks by their boxes.
//
// Frame: that of glTF, metres, x east, y up, -z north, with the origin moved to the centre of the model on the ground: the
// centre when it was first loaded, or when it last moved away from there.

import * as THREE from 'three';
import type { ByteRange } from '../server/api.ts';

/** A node of the file with geometry, or an ancestor of one. */
export interface Part {
  name: string;
  kind: string;
  code: string | null;
  /** Counted from 1; inherited from the nearest ancestor, 0 = none. */
  storey: number;
  span: ByteRange | null;
  /** Id of the source that `span` refers to. */
  file: number;
  shape: string | null;
  /** Index of the house. */
  house: number;
  /** Index of the parent part. */
  parent: number | null;
  /** Index after its last descendant: the descendants of a part follow it. */
  end: number;
  /** Index of the facade that contains it. */
  facade: number | null;
  /** Outward direction of a facade. */
  front: THREE.Vector3 | null;
  box: THREE.Box3;
}

/** Triangles of one part in a chunk: `count` indices from `start`. */
export interface Range {
  start: number;
  count: number;
  part: number;
}

export interface Chunk {
  mesh: THREE.Mesh<THREE.BufferGeometry, THREE.MeshStandardMaterial>;
  house: number;
  storey: number;
  /** The part that contains all of it: a roof, a storey; for glass its facade, if any. */
  owner: number;
  /** Sorted by start. */
  ranges: Range[];
  box: THREE.Box3;
  /** Share of light that it reflects. */
  reflection: number;
}

export interface Model {
  parts: Part[];
  chunks: Chunk[];
  box: THREE.Box3;
  houses: number;
  /** Content keys of the houses; empty where the server gives none. */
  keys: string[];
  triangles: number;
  /** The page's origin in the file's frame. */
  origin: THREE.Vector3;
}

/** Kinds that chunks do not span, since they are shown and hidden as a whole. */
const CHUNK_OWNERS = new Set(['house', 'storey', 'roof', 'finial']);

/** Index count after which a chunk is full, so that towns without house nodes are culled too. */
const MAX_INDICES = 600_000;

interface Extras {
  kind?: string;
  code?: string;
  storey?: number;
  span?: ByteRange;
  file?: number;
  shape?: string;
}

/** An instance of a mesh. */
interface MeshInstance {
  geometry: THREE.BufferGeometry;
  /** Transform to the file's frame. */
  place: THREE.Matrix4;
  part: number;
}

/** The contents of a chunk being built. */
interface ChunkContents {
  material: THREE.MeshStandardMaterial;
  house: number;
  storey: number;
  owner: number;
  pieces: MeshInstance[];
  /** Total number of indices. */
  indices: number;
}

/** The part of a triangle. */
export function partAt(chunk: Chunk, triangle: number): number {
  const behind = lowerBound(chunk.ranges, range => range.start > triangle * 3);
  return chunk.ranges[behind - 1]!.part;
}

/** The ranges of a part and its descendants, which are contiguous. */
export function rangesOf({ ranges }: Chunk, parts: Part[], part: number): Range[] {
  const { end } = parts[part]!;
  return ranges.slice(lowerBound(ranges, range => range.part >= part), lowerBound(ranges, range => range.part >= end));
}

/** Binary search for the first element that satisfies a monotone predicate. */
function lowerBound<T>(list: T[], is: (of: T) => boolean): number {
  let low = 0, high = list.length;
  while (low < high) {
    const half = (low + high) >> 1;
    if (is(list[half]!)) high = half; else low = half + 1;
  }
  return low;
}

/** The centre of a model on the ground, in the file's frame. */
const groundCentre = (box: THREE.Box3) => box.getCenter(new THREE.Vector3()).setY(0); // (0, 0, 0) for an empty box.

/**
 * True if a model with this box (in the file's frame) surrounds a point, which then stays its origin so that unchanged
 * houses do not move.
 */
export const surrounds = (origin: THREE.Vector3, box: THREE.Box3) => box.isEmpty() || box.containsPoint(origin.clone().setY(box.min.y));

/** Keeps the origin of a model that is being replaced. */
export const keepOrigin = ({ origin }: Model) => (box: THREE.Box3) => surrounds(origin, box) ? origin : groundCentre(box);

/** Builds the model of a loaded scene; `originFor` returns the origin for a bounding box. */
export function buildModel(root: THREE.Object3D, originFor: (box: THREE.Box3) => THREE.Vector3 = groundCentre): Model {
  root.updateMatrixWorld(true);
  const parts: Part[] = [];
  const chunkContents = new Map<string, ChunkContents[]>();
  let houses = 0;
  const visit = (node: THREE.Object3D, above: number | null, owner: number | null) => {
    const extras = node.userData as Extras;
    const begin = parts.length;
    let own = above, owned = owner;
    if (extras.kind !== undefined) {
      const up = above === null ? undefined : parts[above];
      own = parts.length;
      if (extras.kind === 'house') houses++;
      if (CHUNK_OWNERS.has(extras.kind)) owned = own;
      parts.push({
        name: (node.userData as { name?: string }).name ?? node.name, // The loader replaces blanks in node names.
        kind: extras.kind,
        code: extras.code ?? null,
        storey: extras.storey ?? up?.storey ?? 0,
        span: extras.span ?? null,
        file: extras.file ?? 0,
        shape: extras.shape ?? null,
        house: Math.max(0, houses - 1),
        parent: above,
        end: 0,
        facade: extras.kind === 'facade' ? own : up?.facade ?? null,
        front: extras.kind === 'facade' ? new THREE.Vector3(0, 0, 1).transformDirection(node.matrixWorld) : null,
        box: new THREE.Box3(),
      });
    }
    if (node instanceof THREE.Mesh) {
      if (own === null) {
        // A model from another program: all of it is one part.
        own = parts.push({
          name: node.name, kind: 'model', code: null, storey: 0, span: null, file: 0, shape: null, house: 0,
          parent: null, end: 0, facade: null, front: null, box: new THREE.Box3(),
        }) - 1;
      }
      const part = parts[own]!, material = node.material as THREE.MeshStandardMaterial;
      const pane = material.userData['reflection'] !== undefined ? part.facade : null, chief = pane ?? owned;
      const key = `${part.house} ${part.storey} ${chief ?? -1} ${material.uuid}`;
      const list = chunkContents.get(key) ?? [];
      chunkContents.set(key, list);
      for (const place of instanceTransforms(node)) {
        let contents = list.at(-1);
        if (!contents || contents.indices > MAX_INDICES) {
          contents = { material, house: part.house, storey: part.storey, owner: chief ?? own, pieces: [], indices: 0 };
          list.push(contents);
        }
        contents.pieces.push({ geometry: node.geometry, place, part: own });
        contents.indices += indexCount(node.geometry);
      }
    }
    for (const child of node.children) visit(child, own, owned);
    if (own !== null && own >= begin) parts[own]!.end = parts.length;
  };
  visit(root, null, null);

  const all = new THREE.Box3().setFromObject(root);
  const origin = originFor(all);
  if (all.isEmpty()) all.set(new THREE.Vector3(-1, 0, -1), new THREE.Vector3(1, 1, 1)).translate(origin);
  const chunks = [...chunkContents.values()].flat().map(contents => buildChunk(contents, parts, origin));
  for (let i = parts.length - 1; i >= 0; i--) {
    const { parent, box } = parts[i]!;
    if (parent !== null) parts[parent]!.box.union(box);
  }
  const triangles = chunks.reduce((sum, chunk) => sum + chunk.mesh.geometry.index!.count / 3, 0);
  return { parts, chunks, box: all.translate(origin.clone().negate()), houses: Math.max(1, houses), keys: [], triangles, origin };
}

/** The transforms of a mesh: one, or one per instance. */
function instanceTransforms(node: THREE.Mesh): THREE.Matrix4[] {
  if (!(node instanceof THREE.InstancedMesh)) return [node.matrixWorld];
  const place = (i: number) => new THREE.Matrix4().fromArray(node.instanceMatrix.array, i * 16).premultiply(node.matrixWorld);
  return Array.from({ length: node.count }, (_, i) => place(i));
}

/** Joins the pieces of a chunk into one geometry, in the page's frame. */
function buildChunk(contents: ChunkContents, parts: Part[], origin: THREE.Vector3): Chunk {
  const { pieces, material } = contents;
  const of = (name: string) => pieces.every(p => p.geometry.hasAttribute(name));
  const vertices = pieces.reduce((sum, p) => sum + usedVertices(p.geometry).count, 0);
  const indices = pieces.reduce((sum, p) => sum + indexCount(p.geometry), 0);
  const position = new Float32Array(vertices * 3);
  // Without normals the loader's material shades flat.
  const normal = of('normal') ? new Float32Array(vertices * 3) : null;
  const tangent = of('tangent') ? new Float32Array(vertices * 4) : null;
  const uv = of('uv') ? new Float32Array(vertices * 2) : null;
  // Texture coordinates of the baked reflections.
  const uv1 = of('uv1') ? new Float32Array(vertices * 2) : null;
  const color = of('color') ? new Float32Array(vertices * 4) : null;
  const index = new Uint32Array(indices);
  const ranges: Range[] = [], box = new THREE.Box3();
  const turn = new THREE.Matrix3();
  let vertex = 0, next = 0;
  for (const { geometry: from, place, part } of pieces) {
    const { first, count } = usedVertices(from), own = parts[part]!.box, mirrored = place.determinant() < 0;
    const values = (name: string) => attributeValues(from, name, first, count);
    transformPoints(values('position'), place, origin, position.subarray(vertex * 3), own);
    if (normal) transformDirections(values('normal'), turn.getNormalMatrix(place), 3, normal.subarray(vertex * 3));
    if (tangent) {
      const to = tangent.subarray(vertex * 4), given = values('tangent');
      transformDirections(given, turn.setFromMatrix4(place), 4, to);
      for (let i = 3; i < count * 4; i += 4) to[i] = mirrored ? -given[i]! : given[i]!;
    }
    uv?.set(values('uv'), vertex * 2);
    uv1?.set(values('uv1'), vertex * 2);
    if (color) {
      const colors = from.getAttribute('color');
      for (let i = 0; i < count; i++) {
        const at = first + i, opaque = colors.itemSize < 4 ? 1 : colors.getW(at);
        color.set([colors.getX(at), colors.getY(at), colors.getZ(at), opaque], (vertex + i) * 4);
      }
    }
    const length = indexCount(from);
    // Mirrored instances reverse the winding to keep their outside.
    const order = mirrored ? [0, 2, 1] : [0, 1, 2];
    for (let i = 0; i < length; i++) {
      const corner = i - i % 3 + order[i % 3]!;
      index[next + i] = vertex - first + (from.index ? from.index.getX(corner) : corner);
    }
    const last = ranges.at(-1);
    if (last?.part === part) last.count += length; else ranges.push({ start: next, count: length, part });
    vertex += count;
    next += length;
    box.union(own);
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setIndex(new THREE.BufferAttribute(index, 1));
  geometry.setAttribute('position', new THREE.BufferAttribute(position, 3));
  if (normal) geometry.setAttribute('normal', new THREE.BufferAttribute(normal, 3));
  if (tangent) geometry.setAttribute('tangent', new THREE.BufferAttribute(tangent, 4));
  if (uv) geometry.setAttribute('uv', new THREE.BufferAttribute(uv, 2));
  if (uv1) geometry.setAttribute('uv1', new THREE.BufferAttribute(uv1, 2));
  if (color) geometry.setAttribute('color', new THREE.BufferAttribute(color, 4));
  else material.vertexColors = false;
  geometry.boundingBox = box.clone();
  geometry.boundingSphere = box.getBoundingSphere(new THREE.Sphere());
  const mesh = new THREE.Mesh(geometry, material);
  mesh.castShadow = mesh.receiveShadow = true;
  mesh.matrixAutoUpdate = false;
  const { reflection } = material.userData as { reflection?: number };
  const { house, storey, owner } = contents;
  // Baked reflections are not reflected again.
  const baked = material instanceof THREE.MeshStandardMaterial && material.emissiveMap !== null;
  return { mesh, house, storey, owner, ranges, box, reflection: baked ? 0 : reflection ?? 0 };
}

/** The vertices that the triangles of a geometry use: surfaces of a house may share their attributes. */
function usedVertices(geometry: THREE.BufferGeometry): { first: number, count: number } {
  const { index } = geometry, all = geometry.getAttribute('position').count;
  if (!index || index.count === 0) return { first: 0, count: all };
  let first = Infinity, last = 0;
  for (let i = 0; i < index.count; i++) {
    const vertex = index.getX(i);
    if (vertex < first) first = vertex;
    if (vertex > last) last = vertex;
  }
  return { first, count: last - first + 1 };
}

/** The values of an attribute of some vertices, unpacked; a view of the original array where it holds plain floats. */
function attributeValues(geometry: THREE.BufferGeometry, name: string, first: number, count: number): ArrayLike<number> {
  const attribute = geometry.getAttribute(name), { itemSize } = attribute;
  if (attribute instanceof THREE.BufferAttribute && attribute.array instanceof Float32Array) {
    return attribute.array.subarray(first * itemSize, (first + count) * itemSize);
  }
  const some = new Float32Array(count * itemSize);
  for (let i = 0; i < some.length; i++) some[i] = attribute.getComponent(first + Math.floor(i / itemSize), i % itemSize);
  return some;
}

/** Transforms points into the page's frame and extends a box by them. */
function transformPoints(from: ArrayLike<number>, place: THREE.Matrix4, origin: THREE.Vector3, to: Float32Array, box: THREE.Box3) {
  const m = place.elements, least = [Infinity, Infinity, Infinity], most = [-Infinity, -Infinity, -Infinity];
  const shift = [m[12]! - origin.x, m[13]! - origin.y, m[14]! - origin.z];
  for (let i = 0; i < from.length; i += 3) {
    const x = from[i]!, y = from[i + 1]!, z = from[i + 2]!;
    for (let axis = 0; axis < 3; axis++) {
      const at = m[axis]! * x + m[axis + 4]! * y + m[axis + 8]! * z + shift[axis]!;
      to[i + axis] = at;
      if (at < least[axis]!) least[axis] = at;
      if (at > most[axis]!) most[axis] = at;
    }
  }
  box.union(new THREE.Box3(new THREE.Vector3().fromArray(least), new THREE.Vector3().fromArray(most)));
}

/** Transforms and normalises directions, with `step` values per vertex. */
function transformDirections(from: ArrayLike<number>, { elements: m }: THREE.Matrix3, step: number, to: Float32Array) {
  for (let i = 0; i < from.length; i += step) {
    const x = from[i]!, y = from[i + 1]!, z = from[i + 2]!;
    const a = m[0]! * x + m[3]! * y + m[6]! * z, b = m[1]! * x + m[4]! * y + m[7]! * z, c = m[2]! * x + m[5]! * y + m[8]! * z;
    const length = Math.sqrt(a * a + b * b + c * c) || 1;
    to[i] = a / length;
    to[i + 1] = b / length;
    to[i + 2] = c / length;
  }
}

const indexCount = (geometry: THREE.BufferGeometry) => (geometry.index ?? geometry.getAttribute('position')).count;
