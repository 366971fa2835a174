// What parts are in a model: those at a place of a text, those below another, where a ray meets one. A part that is
// written once may stand in many places; its place in the model tells them apart.

import * as THREE from 'three';
import { carried } from './carried.ts';
import { type Chunk, type Model, type Part, part_of, ranges_of } from './model.ts';
import type { Places } from './places.ts';
import type { Bytes } from './server.ts';

/** Children of each part; those of none under -1. */
export function children_of(model: Model): Map<number, number[]> {
  const children = new Map<number, number[]>();
  for (const [i, { parent }] of model.parts.entries()) {
    const key = parent ?? -1, list = children.get(key);
    if (list) list.push(i); else children.set(key, [i]);
  }
  return children;
}

/** The parts that a place of a source lights up: the smallest written thing round it, or all that lie within it. */
export function parts_at(model: Model, file: number, [start, end]: Bytes): number[] {
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
  // A part at whose end the cursor stands, and the next one, are both as small: the one that begins there.
  const begins = around.filter(i => model.parts[i]!.span![0] === start || model.parts[i]!.span![1] > start);
  if (begins.length) around = begins;
  const outer: number[] = [];
  for (const i of within) if (!outer.length || i >= model.parts[outer.at(-1)!]!.end) outer.push(i);
  return outer.length && !around.some(i => model.parts[i]!.kind === 'part') ? outer : around;
}

/** Which of the parts that are written at one place this is. */
export function ordinal_of(model: Model, part: number): number {
  const { span, file } = model.parts[part]!;
  let ordinal = 0;
  for (let i = 0; i < part; i++) {
    const other = model.parts[i]!;
    if (other.file === file && same(other.span, span) && other.kind === model.parts[part]!.kind) ordinal++;
  }
  return ordinal;
}

const same = (a: Bytes | null, b: Bytes | null) => a === b || a !== null && b !== null && a[0] === b[0] && a[1] === b[1];

/** What is remembered of a selected part from one revision to the next. */
export interface Trace {
  kind: string;
  code: string | null;
  house: number;
  storey: number;
  file: number;
  span: Bytes | null;
  ordinal: number;
  /** Its place in the tree: number below its parent, and so on up. */
  path: number[];
}

export function trace_of(model: Model, part: number): Trace {
  const { kind, code, house, storey, file, span } = model.parts[part]!;
  return { kind, code, house, storey, file, span, ordinal: ordinal_of(model, part), path: path_of(model, part) };
}

function path_of(model: Model, part: number): number[] {
  const path: number[] = [];
  for (let at: number | null = part; at !== null; at = model.parts[at]!.parent) {
    const up = model.parts[at]!.parent;
    let before = 0;
    for (let i = (up ?? -1) + 1; i < at; i++) if (model.parts[i]!.parent === up) before++;
    path.unshift(before);
  }
  return path;
}

/** The same part in a new model: at the place its text has moved to, else at the same place of the tree. */
export function found_again(trace: Trace, model: Model, old: Places | undefined, now: Places | undefined): number | null {
  if (trace.span && old && now) {
    const moved = carried(old.range(trace.span), old.text, now.text);
    if (moved) {
      const span: Bytes = [now.byte(moved[0]), now.byte(moved[1])];
      const here = model.parts.flatMap((part, i) =>
        part.kind === trace.kind && part.file === trace.file && same(part.span, span) ? [i] : []);
      if (here.length) return here[Math.min(trace.ordinal, here.length - 1)]!;
    }
  }
  let at: number | null = null;
  for (const step of trace.path) {
    const below = model.parts.flatMap((part, i) => part.parent === at ? [i] : []);
    if (below[step] === undefined) return null;
    at = below[step];
  }
  return at !== null && model.parts[at]!.kind === trace.kind ? at : null;
}

export interface Hit {
  part: number;
  chunk: Chunk;
  triangle: number;
  point: THREE.Vector3;
  distance: number;
}

/** What a ray meets first of what is shown and not cut away. */
export function hit(model: Model, ray: THREE.Raycaster, kept: (point: THREE.Vector3) => boolean): Hit | null {
  let best: Hit | null = null;
  for (const chunk of model.chunks) {
    if (!chunk.mesh.visible || !ray.ray.intersectsBox(chunk.box)) continue;
    for (const { faceIndex, point, distance } of ray.intersectObject(chunk.mesh, false)) {
      if (best && distance >= best.distance) break;
      if (!kept(point)) continue;
      best = { part: part_of(chunk, faceIndex!), chunk, triangle: faceIndex!, point, distance };
      break;
    }
  }
  return best;
}

/** The triangles of a part and of what is below it, as one mesh for marks; null where it has none. */
export function shape_of(model: Model, part: number): THREE.BufferGeometry | null {
  const positions: number[] = [];
  const { house } = model.parts[part]!;
  for (const chunk of model.chunks) {
    if (chunk.house !== house) continue;
    const { index } = chunk.mesh.geometry, position = chunk.mesh.geometry.getAttribute('position');
    for (const range of ranges_of(chunk, model.parts, part)) {
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

/** What a part is called: the name of its node, without what every reader sees. */
export const name_of = (part: Part) => part.code?.trim() || part.name || part.kind;
