// Client of the server's interface for photographs that become a front (`src/cli/view/photographs.rs`). Places are in pixels of
// the photograph, from its upper left corner; lines of the lattice are parts of the wall, from its upper left corner.

import { answer, post } from './api.ts';

export type Place = [x: number, y: number];
export type Corners = [Place, Place, Place, Place];

/** A stroke of the brush over what stands before the wall, or of the eraser. */
export interface Stroke {
  erases: boolean;
  width: number;
  points: Place[];
}

/** What is told of a photograph: corners clockwise from the upper left, mask. */
export interface Marked {
  corners: Corners;
  mask: Stroke[];
}

/** What is told by hand. */
export interface Told {
  photos: Marked[];
  /** Width and height of the wall, metres. */
  size: [width: number, height: number] | null;
  /** Lines between bays from the left, between storeys from above, without the ends. */
  columns: number[];
  rows: number[];
}

export interface Photograph {
  name: string;
  size: [width: number, height: number];
  /** Those found, or somewhere. */
  corners: Corners;
  /** Why they were not found. */
  lost: string | null;
}

/** The texts that are written: the front alone, and between two town houses. */
export interface Files {
  front: string;
  street: string;
}

export interface Photographs {
  photos: Photograph[];
  /** The name of the folder that is written. */
  folder: string;
  files: Files;
  writes: boolean;
  /** The height of a storey where no size is told, metres. */
  storey: number;
  /** What was told when the folder was written last. */
  told: Told | null;
}

/** What is asked of a wall seen straight. */
export interface StraightRequest {
  photo: number;
  marked: Marked;
  size: Told['size'];
  /** True if the lattice is to be found. */
  finds: boolean;
  /** True if the picture is only for a moment: it is smaller and comes sooner. */
  quick: boolean;
}

/** A wall seen straight. */
export interface Straight {
  /** The address of the picture, and its size. */
  picture: string;
  size: [width: number, height: number];
  /** Width over height. */
  aspect: number;
  /** True if the focal length is a guess, and the aspect with it. */
  guessed: boolean;
  lattice: { columns: number[]; rows: number[] } | null;
}

/** What was built: what is said of it, nothing if there is no front, and messages. */
export interface Built {
  said: string | null;
  messages: { severity: 'error' | 'warning' | 'note'; code: string; message: string; help: string | null }[];
}

export type Refused = { refused: string };

export const fetchPhotographs = async () => answer<Photographs>(await fetch('/api/front'));
export const photoUrl = (number: number) => `/api/front/photo?number=${number}`;
export const fetchStraight = (asked: StraightRequest) => post<Straight | Refused>('/api/front/straight', asked);
export const buildFront = (told: Told) => post<Built | Refused>('/api/front/build', told);
