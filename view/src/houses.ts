// A model of which only some houses are read anew: the others are taken over from the revision before, with what they
// have on the graphics card. What the server hands out for it is described in src/view/houses.rs.

import type * as THREE from 'three';
import { type Chunk, type Model, model_of, type Part } from './model.ts';
import type { Bytes, State } from './server.ts';

/** Where a part is written; `span` = null: nowhere. */
type Place = Pick<Part, 'file' | 'span'>;

/** A house in a model that has been read. */
interface Found {
  parts: Part[];
  /** Number of the first part. */
  first: number;
  chunks: Chunk[];
}

/**
 * The model with these houses, each by its key and name. `read` reads the `.glb` of one house. Null where houses are
 * missing, or there are other parts than those that were written.
 */
export async function renewed(
  before: Model, list: State['houses'], answer: ArrayBuffer, read: (glb: ArrayBuffer) => Promise<THREE.Object3D>,
): Promise<Model | null> {
  const numbers = new DataView(answer), count = numbers.getUint32(0, true);
  const known = new Map(houses_of(before).map((house, i) => [before.keys[i]!, house]));
  for (let at = 4 + 12 * count; at < answer.byteLength;) {
    const house = numbers.getUint32(at, true), glb = at + 8, end = glb + numbers.getUint32(at + 4, true);
    const model = model_of(await read(answer.slice(glb, end)), () => before.middle);
    known.set(list[house]![0], houses_of(model)[0]!);
    at = end;
  }
  const place = (part: number): Place => {
    if (part >= count) return { file: 0, span: null };
    const [file, start, end] = [0, 4, 8].map(offset => numbers.getUint32(4 + 12 * part + offset, true)) as [number, ...Bytes];
    return file === 0xffffffff ? { file: 0, span: null } : { file, span: [start, end] };
  };
  const houses = list.map(([key]) => known.get(key));
  if (houses.some(house => house === undefined)) return null;
  const model = together(before, houses as Found[], place);
  model.keys = list.map(([key]) => key);
  for (const part of model.parts) if (part.parent === null) part.name = list[part.house]![1];
  return model.parts.length === count ? model : null;
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

/** One model of many houses. */
function together(before: Model, houses: Found[], place: (part: number) => Place): Model {
  const parts: Part[] = [], chunks: Chunk[] = [], box = before.box.clone().makeEmpty();
  houses.forEach((house, number) => {
    const shift = parts.length - house.first;
    const moved = (part: number | null) => part === null ? null : part + shift;
    for (const part of house.parts) {
      parts.push({
        ...part, ...place(parts.length),
        house: number, parent: moved(part.parent), end: part.end + shift, facade: moved(part.facade),
      });
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
