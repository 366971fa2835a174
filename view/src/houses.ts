// A model of which only some houses are read anew: the others are taken over from the revision before, with what they
// have on the graphics card. What the server hands out for it is described in src/view/houses.rs.

import type * as THREE from 'three';
import { type Chunk, type Model, model_of, type Part } from './model.ts';
import type { Bytes, State } from './server.ts';

/** A house in a model that has been read. */
interface Found {
  parts: Part[];
  /** Number of the first part. */
  first: number;
  chunks: Chunk[];
}

/**
 * The model with these houses, each by its key and name. `read` reads the `.glb` of those that were not there before. Null
 * where houses are missing, or there are other parts than those that were written.
 */
export async function renewed(
  before: Model, list: State['houses'], answer: ArrayBuffer, read: (glb: ArrayBuffer) => Promise<THREE.Object3D>,
): Promise<Model | null> {
  const numbers = new DataView(answer), number = (at: number) => numbers.getUint32(4 * at, true);
  const count = number(0), lacks = 1 + 3 * count, glb = lacks + 1 + number(lacks);
  const known = new Map(houses_of(before).map((house, i) => [before.keys[i]!, house]));
  if (number(lacks) > 0) {
    const model = model_of(await read(answer.slice(4 * glb)), () => before.middle);
    share_looks(before, model);
    for (const [i, house] of houses_of(model).entries()) known.set(list[number(lacks + 1 + i)]![0], house);
  }
  const houses = list.map(([key]) => known.get(key)!);
  if (houses.includes(undefined!) || houses.reduce((sum, house) => sum + house.parts.length, 0) !== count) return null;
  const model = together(before, houses);
  model.keys = list.map(([key]) => key);
  for (const [i, part] of model.parts.entries()) {
    const [file, start, end] = [1, 2, 3].map(k => number(3 * i + k)) as [number, ...Bytes];
    Object.assign(part, file === 0xffffffff ? { file: 0, span: null } : { file, span: [start, end] });
    if (part.parent === null) part.name = list[part.house]![1];
  }
  return model;
}

/** The houses of a model, each with the parts that follow it. */
function houses_of({ parts, chunks }: Model): Found[] {
  const houses: Found[] = [];
  for (let first = 0; first < parts.length; first = parts[first]!.end) {
    houses.push({ parts: parts.slice(first, parts[first]!.end), first, chunks: [] });
  }
  for (const chunk of chunks) houses[chunk.house]?.chunks.push(chunk);
  return houses;
}

/** Gives a model the materials of another where they look the same, so that they do not become more with each save. */
function share_looks(from: Model, to: Model) {
  const look = ({ mesh: { material } }: Chunk) => material.userData['look'] as string | undefined;
  const known = new Map(from.chunks.map(chunk => [look(chunk), chunk.mesh.material]));
  for (const chunk of to.chunks) if (look(chunk) !== undefined) chunk.mesh.material = known.get(look(chunk)) ?? chunk.mesh.material;
}

/** One model of many houses. */
function together(before: Model, houses: Found[]): Model {
  const parts: Part[] = [], chunks: Chunk[] = [], box = before.box.clone().makeEmpty();
  houses.forEach((house, number) => {
    const shift = parts.length - house.first;
    const moved = (part: number | null) => part === null ? null : part + shift;
    for (const part of house.parts) {
      parts.push({ ...part, house: number, parent: moved(part.parent), end: part.end + shift, facade: moved(part.facade) });
    }
    for (const chunk of house.chunks) {
      const ranges = shift === 0 ? chunk.ranges : chunk.ranges.map(range => ({ ...range, part: range.part + shift }));
      chunks.push({ ...chunk, house: number, owner: chunk.owner + shift, ranges });
    }
    box.union(house.parts[0]!.box);
  });
  const triangles = chunks.reduce((sum, { mesh }) => sum + mesh.geometry.index!.count / 3, 0);
  return { parts, chunks, box, houses: houses.length, keys: [], triangles, middle: before.middle };
}
