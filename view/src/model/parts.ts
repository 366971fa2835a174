// Queries over the parts of a model: by source location, by ancestry, by ray. One source span may produce many parts, which
// are told apart by their order.

import * as THREE from 'three';
import { movedSpan } from '../server/spans.ts';
import { type Chunk, type Model, type Part, partAt, rangesOf } from './model.ts';
import type { OffsetMap } from '../server/offsets.ts';
import type { ByteRange } from '../server/api.ts';

/** The children of each part; the roots under -1. */
export function childrenOf(model: Model): Map<number, number[]> {
  const children = new Map<number, number[]>();
  for (const [i, { parent }] of model.parts.entries()) {
    const key = parent ?? -1, list = children.get(key);
    if (list) list.push(i); else children.set(key, [i]);
  }
  return children;
}

/** The parts at a source range: those of the smallest enclosing span, or all within the range. */
export function partsAt(model: Model, file: number, [start, end]: ByteRange): number[] {
  let best = Infinity, around: number[] = [];
  const within: number[] = [];
  for (const [i, part] of model.parts.entries()) {
    if (!part.span || part.file !== file) continue;
    const [from, to] = part.span;
    if (from >= start && to <= end && end > start) within.push(i);
    if (from <= start && to >= end && (start < to || start === end && start <= to)) {
      if (to - from < best) { best = to - from; around = []; }
      if (to - from === best) around.push(i);
    }
  }
  // With the cursor between two adjacent parts, the one that begins there wins.
  const begins = around.filter(i => model.parts[i]!.span![0] === start || model.parts[i]!.span![1] > start);
  if (begins.length) around = begins;
  const outer: number[] = [];
  for (const i of within) if (!outer.length || i >= model.parts[outer.at(-1)!]!.end) outer.push(i);
  return outer.length && !around.some(i => model.parts[i]!.kind === 'part') ? outer : around;
}

/** Index of a part among those written at the same span. */
export function ordinalOf(model: Model, part: number): number {
  const { span, file } = model.parts[part]!;
  let ordinal = 0;
  for (let i = 0; i < part; i++) {
    const other = model.parts[i]!;
    if (other.file === file && sameSpan(other.span, span) && other.kind === model.parts[part]!.kind) ordinal++;
  }
  return ordinal;
}

const sameSpan = (a: ByteRange | null, b: ByteRange | null) => a === b || a !== null && b !== null && a[0] === b[0] && a[1] === b[1];

/** Identifies a selected part across revisions. */
export interface Trace {
  kind: string;
  code: string | null;
  house: number;
  storey: number;
  file: number;
  span: ByteRange | null;
  ordinal: number;
  /** The centre of its box in the frame of the file, metres; null if it has no triangles. */
  centre: THREE.Vector3 | null;
  /** Its path in the tree: sibling indices from the part upwards. */
  path: number[];
}

export function traceOf(model: Model, part: number): Trace {
  const { kind, code, house, storey, file, span } = model.parts[part]!;
  return { kind, code, house, storey, file, span, ordinal: ordinalOf(model, part), centre: centreOf(model, part), path: pathOf(model, part) };
}

/** The centre of a part's box in the frame of the file; null if it has no triangles. */
const centreOf = ({ parts, origin }: Model, part: number) => parts[part]!.box.isEmpty() ? null : parts[part]!.box.getCenter(new THREE.Vector3()).add(origin);

/** Parts of two revisions whose centres are nearer stand at the same place, metres. */
const SAME_PLACE = 0.01;

function pathOf(model: Model, part: number): number[] {
  const path: number[] = [];
  for (let at: number | null = part; at !== null; at = model.parts[at]!.parent) {
    const up = model.parts[at]!.parent;
    let before = 0;
    for (let i = (up ?? -1) + 1; i < at; i++) if (model.parts[i]!.parent === up) before++;
    path.unshift(before);
  }
  return path;
}

/**
 * Finds the same part in a new model: what looks the same at the same place, else by its span, moved through the edit, else by
 * its path. Texts of equal codes in a row do not tell which of them is new, so the place comes first.
 */
export function findAgain(trace: Trace, model: Model, old: OffsetMap | undefined, now: OffsetMap | undefined): number | null {
  const { centre } = trace;
  const same = (part: Part) => part.kind === trace.kind && part.code === trace.code && part.storey === trace.storey;
  if (centre) {
    const at = model.parts.findIndex((part, i) => same(part) && (centreOf(model, i)?.distanceTo(centre) ?? Infinity) < SAME_PLACE);
    if (at >= 0) return at;
  }
  if (trace.span && old && now) {
    const moved = movedSpan(old.range(trace.span), old.text, now.text);
    if (moved) {
      const span: ByteRange = [now.byte(moved[0]), now.byte(moved[1])];
      const here = model.parts.flatMap((part, i) =>
        part.kind === trace.kind && part.file === trace.file && sameSpan(part.span, span) ? [i] : []);
      if (here.length) return here[Math.min(trace.ordinal, here.length - 1)]!;
    }
  }
  let at: number | null = null;
  for (const step of trace.path) {
    const below = model.parts.flatMap((part, i) => part.parent === at ? [i] : []);
    if (below[step] === undefined) return null;
    at = below[step];
  }
  return at !== null && same(model.parts[at]!) ? at : null; // Better none than another one.
}

export interface Hit {
  part: number;
  chunk: Chunk;
  triangle: number;
  point: THREE.Vector3;
  distance: number;
}

/** The first visible surface that a ray hits. */
export function hit(model: Model, ray: THREE.Raycaster, kept: (point: THREE.Vector3) => boolean): Hit | null {
  let best: Hit | null = null;
  for (const chunk of model.chunks) {
    if (!chunk.mesh.visible || !ray.ray.intersectsBox(chunk.box)) continue;
    for (const { faceIndex, point, distance } of ray.intersectObject(chunk.mesh, false)) {
      if (best && distance >= best.distance) break;
      if (!kept(point)) continue;
      best = { part: partAt(chunk, faceIndex!), chunk, triangle: faceIndex!, point, distance };
      break;
    }
  }
  return best;
}

/** The triangles of a part and its descendants as one mesh; null if there are none. */
export function shapeOf(model: Model, part: number): THREE.BufferGeometry | null {
  const positions: number[] = [];
  const { house } = model.parts[part]!;
  for (const chunk of model.chunks) {
    if (chunk.house !== house) continue;
    const { index } = chunk.mesh.geometry, position = chunk.mesh.geometry.getAttribute('position');
    for (const range of rangesOf(chunk, model.parts, part)) {
      for (let i = range.start; i < range.start + range.count; i++) {
        const v = index!.getX(i);
        positions.push(position.getX(v), position.getY(v), position.getZ(v));
      }
    }
  }
  if (positions.length === 0) return null;
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(positions, 3));
  return geometry;
}

/** The display name of a part. */
export const nameOf = (part: Part) => part.code?.trim() || part.name || part.kind;
