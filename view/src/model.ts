// A model as the page needs it. What was one node each in the file is joined to chunks: all triangles of one storey, roof or
// the like in one material, and glass of one facade. So a house is some dozens of draws instead of hundreds, parts are found
// again by their triangles, and whatever sees only a part of a town (a mirror) picks chunks by their boxes.
//
// Frame: that of glTF, metres, x east, y up, -z north, moved so that a place on the ground in the model's midst is the
// origin: its middle when it was first read, or when it last moved away from there.

import * as THREE from 'three';
import type { Bytes } from './server.ts';

/** A node of the file that shows something, or that stands above one. */
export interface Part {
  name: string;
  kind: string;
  code: string | null;
  /** Counted from 1; that of the nearest node above which has one, 0 = none. */
  storey: number;
  span: Bytes | null;
  /** Which source the span is of. */
  file: number;
  shape: string | null;
  /** Number of the house. */
  house: number;
  /** Into the parts. */
  parent: number | null;
  /** Behind the last part that stands below it: those below a part follow it. */
  end: number;
  /** The facade that it stands in, into the parts. */
  facade: number | null;
  /** Which way a facade looks: out of the house. */
  front: THREE.Vector3 | null;
  box: THREE.Box3;
}

/** Triangles of a chunk that one part has: indices from `start`, `count` of them. */
export interface Range {
  start: number;
  count: number;
  part: number;
}

export interface Chunk {
  mesh: THREE.Mesh<THREE.BufferGeometry, THREE.MeshStandardMaterial>;
  house: number;
  storey: number;
  /** The part whose node all of it stands under: a roof, a storey or the like; of glass its facade, if it has one. */
  owner: number;
  /** In the order of their starts. */
  ranges: Range[];
  box: THREE.Box3;
  /** Share of the neighbourhood that it mirrors. */
  reflection: number;
}

export interface Model {
  parts: Part[];
  chunks: Chunk[];
  box: THREE.Box3;
  houses: number;
  /** What is the same for the same house, house by house; none where the server does not say. */
  keys: string[];
  triangles: number;
  /** What the origin of the page is in the frame of the file. */
  middle: THREE.Vector3;
}

/** Kinds that a chunk does not reach beyond: what is shown and hidden as a whole. */
const OWNERS = new Set(['house', 'storey', 'roof', 'finial']);

/** Corners of triangles after which a chunk is full: towns without houses as nodes are drawn only where they are seen, too. */
const MOST = 600_000;

interface Extras {
  kind?: string;
  code?: string;
  storey?: number;
  span?: Bytes;
  file?: number;
  shape?: string;
}

/** A mesh at one of its places. */
interface Piece {
  geometry: THREE.BufferGeometry;
  /** To the frame of the file. */
  place: THREE.Matrix4;
  part: number;
}

/** What goes to one chunk. */
interface Heap {
  material: THREE.MeshStandardMaterial;
  house: number;
  storey: number;
  owner: number;
  pieces: Piece[];
  /** Corners of triangles in them. */
  indices: number;
}

/** The part whose triangle this is. */
export function part_of(chunk: Chunk, triangle: number): number {
  const behind = first_of(chunk.ranges, range => range.start > triangle * 3);
  return chunk.ranges[behind - 1]!.part;
}

/** The ranges of a part and of what is below it: parts follow one another in a chunk as they do in the model. */
export function ranges_of({ ranges }: Chunk, parts: Part[], part: number): Range[] {
  const { end } = parts[part]!;
  return ranges.slice(first_of(ranges, range => range.part >= part), first_of(ranges, range => range.part >= end));
}

/** The first of which this is true; of all behind it, it is true too. */
function first_of<T>(list: T[], is: (of: T) => boolean): number {
  let low = 0, high = list.length;
  while (low < high) {
    const half = (low + high) >> 1;
    if (is(list[half]!)) high = half; else low = half + 1;
  }
  return low;
}

/** The middle of a model on the ground, in the frame of the file. */
const middle_of = (box: THREE.Box3) => box.getCenter(new THREE.Vector3()).setY(0); // 0, 0, 0 of an empty one

/** Whether a model with this box in the frame of the file stands round a place: then it keeps it as its middle, so that
 * nothing moves which has not changed. */
export const stands_round = (middle: THREE.Vector3, box: THREE.Box3) => box.isEmpty() || box.containsPoint(middle.clone().setY(box.min.y));

/** The middle of what takes the place of a model. */
export const kept_middle = ({ middle }: Model) => (box: THREE.Box3) => stands_round(middle, box) ? middle : middle_of(box);

/** Joins what a loader made; `stands` = the middle of a model with this box. */
export function model_of(root: THREE.Object3D, stands: (box: THREE.Box3) => THREE.Vector3 = middle_of): Model {
  root.updateMatrixWorld(true);
  const parts: Part[] = [];
  const heaps = new Map<string, Heap[]>();
  let houses = 0;
  const visit = (node: THREE.Object3D, above: number | null, owner: number | null) => {
    const extras = node.userData as Extras;
    const begin = parts.length;
    let own = above, owned = owner;
    if (extras.kind !== undefined) {
      const up = above === null ? undefined : parts[above];
      own = parts.length;
      if (extras.kind === 'house') houses++;
      if (OWNERS.has(extras.kind)) owned = own;
      parts.push({
        name: (node.userData as { name?: string }).name ?? node.name, // the loader leaves out blanks of its own
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
        // A model that is not ours: all of it is one part.
        own = parts.push({
          name: node.name, kind: 'model', code: null, storey: 0, span: null, file: 0, shape: null, house: 0,
          parent: null, end: 0, facade: null, front: null, box: new THREE.Box3(),
        }) - 1;
      }
      const part = parts[own]!, material = node.material as THREE.MeshStandardMaterial;
      const pane = material.userData['reflection'] !== undefined ? part.facade : null, chief = pane ?? owned;
      const key = `${part.house} ${part.storey} ${chief ?? -1} ${material.uuid}`;
      const list = heaps.get(key) ?? [];
      heaps.set(key, list);
      for (const place of places_of(node)) {
        let heap = list.at(-1);
        if (!heap || heap.indices > MOST) {
          heap = { material, house: part.house, storey: part.storey, owner: chief ?? own, pieces: [], indices: 0 };
          list.push(heap);
        }
        heap.pieces.push({ geometry: node.geometry, place, part: own });
        heap.indices += count_of(node.geometry);
      }
    }
    for (const child of node.children) visit(child, own, owned);
    if (own !== null && own >= begin) parts[own]!.end = parts.length;
  };
  visit(root, null, null);

  const all = new THREE.Box3().setFromObject(root);
  const middle = stands(all);
  if (all.isEmpty()) all.set(new THREE.Vector3(-1, 0, -1), new THREE.Vector3(1, 1, 1)).translate(middle);
  const chunks = [...heaps.values()].flat().map(heap => joined(heap, parts, middle));
  for (let i = parts.length - 1; i >= 0; i--) {
    const { parent, box } = parts[i]!;
    if (parent !== null) parts[parent]!.box.union(box);
  }
  const triangles = chunks.reduce((sum, chunk) => sum + chunk.mesh.geometry.index!.count / 3, 0);
  return { parts, chunks, box: all.translate(middle.clone().negate()), houses: Math.max(1, houses), keys: [], triangles, middle };
}

/** Where a mesh stands: once, or as often as it has instances. */
function places_of(node: THREE.Mesh): THREE.Matrix4[] {
  if (!(node instanceof THREE.InstancedMesh)) return [node.matrixWorld];
  const place = (i: number) => new THREE.Matrix4().fromArray(node.instanceMatrix.array, i * 16).premultiply(node.matrixWorld);
  return Array.from({ length: node.count }, (_, i) => place(i));
}

/** One chunk: everything of a heap in one geometry, in the frame of the page. */
function joined(heap: Heap, parts: Part[], middle: THREE.Vector3): Chunk {
  const { pieces, material } = heap;
  const of = (name: string) => pieces.every(p => p.geometry.hasAttribute(name));
  const vertices = pieces.reduce((sum, p) => sum + p.geometry.getAttribute('position').count, 0);
  const indices = pieces.reduce((sum, p) => sum + count_of(p.geometry), 0);
  const position = new Float32Array(vertices * 3), normal = new Float32Array(vertices * 3);
  const tangent = of('tangent') ? new Float32Array(vertices * 4) : null;
  const uv = of('uv') ? new Float32Array(vertices * 2) : null;
  // Places in the picture of what is mirrored, in models that were baked.
  const uv1 = of('uv1') ? new Float32Array(vertices * 2) : null;
  const color = of('color') ? new Float32Array(vertices * 4) : null;
  const index = new Uint32Array(indices);
  const ranges: Range[] = [], box = new THREE.Box3();
  const turn = new THREE.Matrix3();
  let vertex = 0, next = 0;
  for (const { geometry: from, place, part } of pieces) {
    const { count } = from.getAttribute('position'), own = parts[part]!.box, mirrored = place.determinant() < 0;
    placed(numbers(from, 'position'), place, middle, position.subarray(vertex * 3), own);
    if (from.hasAttribute('normal')) turned(numbers(from, 'normal'), turn.getNormalMatrix(place), 3, normal.subarray(vertex * 3));
    if (tangent) {
      const to = tangent.subarray(vertex * 4), given = numbers(from, 'tangent');
      turned(given, turn.setFromMatrix4(place), 4, to);
      for (let i = 3; i < count * 4; i += 4) to[i] = mirrored ? -given[i]! : given[i]!;
    }
    uv?.set(numbers(from, 'uv'), vertex * 2);
    uv1?.set(numbers(from, 'uv1'), vertex * 2);
    if (color) {
      const colors = from.getAttribute('color');
      for (let i = 0; i < count; i++) {
        const opaque = colors.itemSize < 4 ? 1 : colors.getW(i);
        color.set([colors.getX(i), colors.getY(i), colors.getZ(i), opaque], (vertex + i) * 4);
      }
    }
    const length = count_of(from);
    // What stands mirrored keeps its outside if its triangles go the other way around.
    const order = mirrored ? [0, 2, 1] : [0, 1, 2];
    for (let i = 0; i < length; i++) {
      const corner = i - i % 3 + order[i % 3]!;
      index[next + i] = vertex + (from.index ? from.index.getX(corner) : corner);
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
  geometry.setAttribute('normal', new THREE.BufferAttribute(normal, 3));
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
  const { house, storey, owner } = heap;
  // What was baked is not mirrored once more.
  const baked = material instanceof THREE.MeshStandardMaterial && material.emissiveMap !== null;
  return { mesh, house, storey, owner, ranges, box, reflection: baked ? 0 : reflection ?? 0 };
}

/** The numbers of an attribute, however they are packed: those of the file itself where it has plain ones. */
function numbers(geometry: THREE.BufferGeometry, name: string): ArrayLike<number> {
  const attribute = geometry.getAttribute(name), { count, itemSize } = attribute;
  if (attribute instanceof THREE.BufferAttribute && attribute.array instanceof Float32Array) return attribute.array;
  const all = new Float32Array(count * itemSize);
  for (let i = 0; i < all.length; i++) all[i] = attribute.getComponent(Math.floor(i / itemSize), i % itemSize);
  return all;
}

/** Moves points to their place, seen from the middle of the model; widens a box by them. */
function placed(from: ArrayLike<number>, place: THREE.Matrix4, middle: THREE.Vector3, to: Float32Array, box: THREE.Box3) {
  const m = place.elements, least = [Infinity, Infinity, Infinity], most = [-Infinity, -Infinity, -Infinity];
  const shift = [m[12]! - middle.x, m[13]! - middle.y, m[14]! - middle.z];
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

/** Turns directions, of which `step` numbers follow one another, and makes them one long. */
function turned(from: ArrayLike<number>, { elements: m }: THREE.Matrix3, step: number, to: Float32Array) {
  for (let i = 0; i < from.length; i += step) {
    const x = from[i]!, y = from[i + 1]!, z = from[i + 2]!;
    const a = m[0]! * x + m[3]! * y + m[6]! * z, b = m[1]! * x + m[4]! * y + m[7]! * z, c = m[2]! * x + m[5]! * y + m[8]! * z;
    const length = Math.sqrt(a * a + b * b + c * c) || 1;
    to[i] = a / length;
    to[i + 1] = b / length;
    to[i + 2] = c / length;
  }
}

const count_of = (geometry: THREE.BufferGeometry) => (geometry.index ?? geometry.getAttribute('position')).count;
