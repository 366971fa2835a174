// What is told of photographs by hand, as the page changes it: corners, masks, lattice, size; and the way back.

import type { Corners, Photographs, Place, Stroke, Told } from '../server/front.ts';

/** The direction of a line of the lattice: between bays, or between storeys. */
export type Way = 'columns' | 'rows';

export interface Draft extends Told {
  /** True if the lattice was changed by hand, so that it is not found again when a corner moves. */
  byHand: boolean;
}

/** The least distance of lines, as a part of the wall: nearer ones make no part. */
export const APART = 0.006;

/** What is told when the page opens: as it was left, or as it was found. */
export const firstDraft = ({ photos, told }: Photographs): Draft => told
  ? { ...told, byHand: true }
  : { photos: photos.map(({ corners }) => ({ corners, mask: [] })), size: null, columns: [], rows: [], byHand: false };

const rounded = (value: number) => Math.round(value * 10) / 10;

/** True if corners go clockwise round an area, as the server asks it. */
export const isWall = (corners: Corners) => corners.every((at, i) => {
  const next = corners[(i + 1) % 4]!, after = corners[(i + 2) % 4]!;
  return (next[0] - at[0]) * (after[1] - next[1]) - (next[1] - at[1]) * (after[0] - next[0]) > 1;
});

/** Moves a corner; null where the four would be no wall. */
export function withCorner(draft: Draft, photo: number, corner: number, [x, y]: Place): Draft | null {
  const corners = draft.photos[photo]!.corners.map((at, i) => i === corner ? [rounded(x), rounded(y)] : at) as Corners;
  return isWall(corners) ? withCorners(draft, photo, corners) : null;
}

export const withCorners = (draft: Draft, photo: number, corners: Corners): Draft =>
  ({ ...draft, photos: draft.photos.map((marked, i) => i === photo ? { ...marked, corners } : marked) });

export const withMask = (draft: Draft, photo: number, mask: Stroke[]): Draft =>
  ({ ...draft, photos: draft.photos.map((marked, i) => i === photo ? { ...marked, mask } : marked) });

/** Between which places a line may be moved: not over its neighbours. */
export function room(lines: number[], line: number): [number, number] {
  return [(lines[line - 1] ?? 0) + APART, (lines[line + 1] ?? 1) - APART];
}

export function withLine(draft: Draft, way: Way, line: number, at: number): Draft {
  const [least, most] = room(draft[way], line);
  return withLines(draft, way, draft[way].map((own, i) => i === line ? Math.min(Math.max(at, least), most) : own));
}

export const withLines = (draft: Draft, way: Way, lines: number[]): Draft => ({ ...draft, [way]: lines, byHand: true });

/** Adds a line; null where there is no room for it. */
export function withNewLine(draft: Draft, way: Way, at = widest(draft[way])): { draft: Draft; line: number } | null {
  const ends = [0, ...draft[way], 1];
  if (ends.some(end => Math.abs(end - at) < APART)) return null;
  const lines = [...draft[way], at].sort((a, b) => a - b);
  return { draft: withLines(draft, way, lines), line: lines.indexOf(at) };
}

/** The middle of the widest gap. */
function widest(lines: number[]): number {
  const ends = [0, ...lines, 1], gaps = ends.slice(1).map((end, i) => end - ends[i]!), most = gaps.indexOf(Math.max(...gaps));
  return (ends[most]! + ends[most + 1]!) / 2;
}

/** Lines that divide the wall into so many equal pieces. */
export const even = (pieces: number) => Array.from({ length: pieces - 1 }, (_, i) => (i + 1) / pieces);

/** Width and height of the wall, metres. */
export function metres({ size, rows }: Draft, aspect: number, storey: number): [number, number] {
  const height = storey * (rows.length + 1);
  return size ?? [height * aspect, height];
}

/** Steps to go back to and forward to again. */
export class History<T> {
  now: T;
  #before: T[] = [];
  #after: T[] = [];

  constructor(now: T) { this.now = now; }

  /** Goes on from a step that can be gone back to. */
  push(next: T, from = this.now) {
    this.#before.push(from);
    [this.now, this.#after] = [next, []];
  }

  get canUndo() { return this.#before.length > 0; }
  get canRedo() { return this.#after.length > 0; }

  undo() { this.#step(this.#before, this.#after); }
  redo() { this.#step(this.#after, this.#before); }

  #step(from: T[], to: T[]) {
    const next = from.pop();
    if (next === undefined) return;
    to.push(this.now);
    this.now = next;
  }
}
