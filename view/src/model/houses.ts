// Incremental updates: only the houses that changed are read again, the others keep their meshes from the previous revision.
// The server's answer is described in `src/view`.

import type * as THREE from 'three';
import { type Chunk, type Model, buildModel, type Part } from './model.ts';
import type { ByteRange, State } from '../server/api.ts';

/** One house of a loaded model. */
interface LoadedHouse {
  parts: Part[];
  /** Index of its first part. */
  first: number;
  chunks: Chunk[];
}

/**
 * Builds the model of a list of houses, given by key and name. `read` parses the `.glb` of the houses that the page does not
 * have yet. Returns null if houses are missing or the parts do not match those in the answer.
 */
export async function updateModel(
  before: Model, list: State['houses'], answer: ArrayBuffer, read: (glb: ArrayBuffer) => Promise<THREE.Object3D>,
): Promise<Model | null> {
  const numbers = new DataView(answer), number = (at: number) => numbers.getUint32(4 * at, true);
  const count = number(0), lacks = 1 + 3 * count, glb = lacks + 1 + number(lacks);
  const known = new Map(housesOf(before).map((house, i) => [before.keys[i]!, house]));
  if (number(lacks) > 0) {
    const model = buildModel(await read(answer.slice(4 * glb)), () => before.origin);
    shareMaterials(before, model);
    for (const [i, house] of housesOf(model).entries()) known.set(list[number(lacks + 1 + i)]![0], house);
  }
  const houses = list.map(([key]) => known.get(key)!);
  if (houses.includes(undefined!) || houses.reduce((sum, house) => sum + house.parts.length, 0) !== count) return null;
  const model = mergeHouses(before, houses);
  model.keys = list.map(([key]) => key);
  for (const [i, part] of model.parts.entries()) {
    const [file, start, end] = [1, 2, 3].map(k => number(3 * i + k)) as [number, ...ByteRange];
    Object.assign(part, file === 0xffffffff ? { file: 0, span: null } : { file, span: [start, end] });
    if (part.parent === null) part.name = list[part.house]![1];
  }
  return model;
}

/** The houses of a model, each with its parts and chunks. */
function housesOf({ parts, chunks }: Model): LoadedHouse[] {
  const houses: LoadedHouse[] = [];
  for (let first = 0; first < parts.length; first = parts[first]!.end) {
    houses.push({ parts: parts.slice(first, parts[first]!.end), first, chunks: [] });
  }
  for (const chunk of chunks) houses[chunk.house]?.chunks.push(chunk);
  return houses;
}

/** Reuses the materials of one model in another where they look the same, so that they do not accumulate over saves. */
function shareMaterials(from: Model, to: Model) {
  const look = ({ mesh: { material } }: Chunk) => material.userData['appearance'] as string | undefined;
  const known = new Map(from.chunks.map(chunk => [look(chunk), chunk.mesh.material]));
  for (const chunk of to.chunks) if (look(chunk) !== undefined) chunk.mesh.material = known.get(look(chunk)) ?? chunk.mesh.material;
}

/** Joins houses into one model. */
function mergeHouses(before: Model, houses: LoadedHouse[]): Model {
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
  return { parts, chunks, box, houses: houses.length, keys: [], triangles, origin: before.origin };
}
