// Client of the preview server's HTTP interface (`src/view`). Plan lengths are in U in the author frame; spans are byte
// offsets in the original file.

export type Language = 'en' | 'ja';
export type ByteRange = [start: number, end: number];

/** A file of the workspace. */
export interface File {
  path: string;
  kind: 'text' | 'model' | 'tiles';
}

export interface ServerInfo {
  version: string;
  language: Language;
  root: string;
  files: File[];
  /** The file to open first. */
  file: string | null;
  /** True if edits may change source files. */
  writes: boolean;
  /** True if an editor can be opened at a location. */
  opens: boolean;
  /** True if the page makes a front of photographs. */
  front: boolean;
}

/** A source file that was read; id 0 is the open file. */
export interface Source {
  id: number;
  name: string;
  /** Path relative to the workspace; null outside of it. */
  path: string | null;
  text: string;
  /** Length of the byte order mark. */
  mark: number;
  /** Bytes of the file per UTF-16 unit of the text, one digit each; null for UTF-8. */
  widths: string | null;
}

/** Display name of a source: its path in the workspace, else its file name. */
export const displayName = ({ path, name }: Source) => path ?? name.split(/[\\/]/).pop()!;

/** The source of a diagnostic; undefined for diagnostics of a model file. */
export const sourceOf = ({ id, file }: Diagnostic, sources: Source[]) =>
  sources.find(source => id === undefined ? source.name === file : source.id === id);

export interface Diagnostic {
  /** Id of its source. */
  id?: number;
  /** Empty for diagnostics of the page itself. */
  code: string;
  severity: 'error' | 'warning' | 'note';
  message: string;
  help: string | null;
  /** Null for diagnostics about a feature of a map, as are line, column and span. */
  file: string | null;
  /** Counted from 1; meaningless for diagnostics of a model file. */
  line: number;
  column: number;
  span: { start: number; end: number };
  labels: { message: string; file: string; span: { start: number; end: number } }[];
  /** What it is about instead of a place in a file. */
  feature?: { layer: string; key: string };
}

export type Point = [a: number, b: number];

/** A unit of a wall, from `from` on the right to `to` on the left, seen from outside. */
export interface Unit {
  code: string;
  /** One of wall, door, window, lattice, post, opening, modern, void, picture, split. */
  part: string;
  from: Point;
  to: Point;
  span: ByteRange;
  file: number;
  /** Key of the reason why it cannot be changed, in `plan.reasons` of the state. */
  fixed: string | null;
}

export interface Wall {
  facade: number;
  from: Point;
  to: Point;
  span: ByteRange;
  file: number;
  reflection: boolean;
  fixed: string | null;
  units: Unit[];
}

export interface Region {
  a0: number;
  b0: number;
  a1: number;
  b1: number;
  ridge: 'a' | 'b' | null;
  fall: 'F' | 'B' | 'L' | 'R' | null;
  role: 'main' | 'branch' | 'lean-to';
  shape: string;
  over: number | null;
  /** Given only if it is not a rectangle. */
  polygon?: Point[];
}

/** A closed or open chain of walls. */
export interface Ring {
  hole: boolean;
  inner: boolean;
  closed: boolean;
  walls: Wall[];
}

/** A room, by the point at which it is written. */
export interface Room {
  name: string;
  at: Point;
  floor: 'boards' | 'tatami' | 'earth';
  mats: 'festive' | 'rows';
  ceiling: 'battens' | 'joists' | 'none';
  /** From its floor to its ceiling, shaku; null for that of the storey. */
  height: number | null;
  /** Its outline, then each opening in it. */
  area: Point[][];
  laid: [a0: number, b0: number, a1: number, b1: number][];
  file: number;
  span: ByteRange;
  fixed: string | null;
}

/** What is built into a room: its least corner, and its extent along a and b. */
export interface Fixture {
  kind: string;
  at: Point;
  size: Point;
  /** The side of its front. */
  faces: Faces;
  /** False if it does not fit and is left out. */
  built: boolean;
  file: number;
  span: ByteRange;
  fixed: string | null;
}

export type Faces = 'F' | 'B' | 'L' | 'R';

export interface Storey {
  storey: number;
  kind: 'storey' | 'parapet';
  z0: number;
  z1: number;
  /** In shaku. */
  height: number;
  file: number;
  span: ByteRange;
  fixed: string | null;
  rings: Ring[];
  rooms: Room[];
  fixtures: Fixture[];
  regions: Region[];
}

export interface Roof {
  shape: string;
  kind: string;
  storey: number;
  file?: number;
  span?: ByteRange;
  rect: [a0: number, b0: number, a1: number, b1: number];
  z: number;
  ridge: [Point, Point] | null;
}

/** What stands outdoors: a part, or covered ground with its surface as `code`. */
export interface Outdoor {
  kind: 'put' | 'ground';
  code: string;
  outline: Point[];
  file: number;
  span: ByteRange;
}

export interface House {
  name: string;
  file: number;
  span: ByteRange;
  street: boolean;
  fixed: string | null;
  roofs: Roof[];
  azimuth: number;
  origin: [east: number, north: number, up: number];
  unit_m: number;
  storeys: Storey[];
  /** Ground, then parts; left out where nothing stands outdoors. */
  outdoors?: Outdoor[];
}

/** A frame of metres east and north, turned clockwise, degrees. */
export interface PlanFrame { origin: [east: number, north: number]; turn: number }

/** A group, a placed house or a house, with its place in the frame of the groups around it. */
export interface PlanPlace extends PlanFrame {
  kind: string;
  at: [east: number, north: number];
  /** Its `turn` or `azimuth`. */
  heading: number;
  /** Indices of the houses that move with it. */
  houses: number[];
  fixed: string | null;
  turn_fixed: string | null;
}

/** A surveyed outline, or one of its courtyards. */
export interface PlanOutline extends PlanFrame {
  corners: [east: number, north: number][];
  fixed: string | null;
}

/** A wall of which a reader of plans was not certain; its entry in a comment is at `span`. */
export interface Doubt {
  code: string;
  /** Where its part began when it was read. */
  at: Point;
  /** Its part now, by indices from 0; null if the wall is gone. */
  unit: { house: number; storey: number; ring: number; wall: number; unit: number } | null;
  file: number;
  span: ByteRange;
}

/** A matrix of SVG: x' = a x + c y + e, y' = b x + d y + f. */
export type Matrix = [a: number, b: number, c: number, d: number, e: number, f: number];

/** The pictures that a house was read from. */
export interface Scan {
  /** The name of the file that tells of them. */
  file: string;
  sheets: ScanSheet[];
  /** Why others are not shown. */
  faults: string[];
}

export interface ScanSheet {
  /** Number of its storey, from 1. */
  storey: number;
  number: number;
  /** Differs if the picture does. */
  key: string;
  size: [width: number, height: number];
  /** From pixels of the picture to metres to the left along the front of the first house, and to the back. */
  to_house: Matrix;
}

export interface State {
  revision: number;
  file: string;
  sources: Source[];
  diagnostics: Diagnostic[];
  /** Content key and name of each house; empty for model files. */
  houses: [key: string, name: string][];
  /** Content keys of the external textures, by name. */
  pictures: Record<string, string>;
  /** `reasons`: texts for the keys in `fixed`. */
  plan: { reasons: Record<string, string>; houses: House[]; views: NamedView[]; places: PlanPlace[]; outlines: PlanOutline[]; doubts: Doubt[] };
  /** Null if the file is no town. */
  town: TownState | null;
  /** Empty for models and towns in tiles. */
  parameters: Parameter[];
  /** Null if no scan lies beside the file. */
  scan: Scan | null;
  times: [step: string, ms: number][];
}

/** A parameter of a file; values as they are written. */
export interface Parameter {
  name: string;
  kind: 'number' | 'truth' | 'text';
  value: string;
  default: string;
  min: string | null;
  max: string | null;
  step: string | null;
  /** Empty if any value is allowed. */
  choices: string[];
  unit: string | null;
  doc: string | null;
}

/** A town in tiles. */
export interface TownState {
  /** The number under which its files are served. */
  id: number;
  /** The name of the root of its tiles; null before there are any. */
  tileset: string | null;
  features: number;
  built: number;
  skipped: number;
  /** True if all levels of detail that the preview makes are there. */
  whole: boolean;
}

/** How far the build of a town is, in features. */
export interface TownProgress {
  phase: 'maps' | 'far' | 'near' | 'done' | 'failed';
  done: number;
  of: number;
}

/** What a tile says of a feature. */
export interface TownFeature {
  key: string;
  layer: string;
  type: string;
  year: string;
  evidence: string;
  parameters: string;
  /** The number of its `for`, from 1; 0 if unknown. */
  rule: number;
  /** The line of the town file; 0 if unknown. */
  line: number;
}

/** The line of a feature in the table of decisions, by the names of its columns. */
export type Decision = Record<string, string>;

/** A face of the envelope of a lot: what binds it, and how its height comes about. */
export interface EnvelopeFace {
  rule: string;
  /** Empty where the border of the lot binds. */
  arithmetic: string;
  /** The set of rules; empty for the only one. */
  scenario: string;
}

/** A place in the system of a town's map. */
export interface MapPlace {
  crs: string;
  /** East and north in it, metres. */
  at: [east: number, north: number];
  /** Longitude and latitude; null where the system lies nowhere on the globe. */
  degrees: [longitude: number, latitude: number] | null;
}

/** A feature on which nothing stands. */
export interface Skipped {
  layer: string;
  key: string;
  /** The code of a diagnostic, or a word. */
  code: string;
  reason: string;
  rule: number;
  /** Metres east and north of the town's origin; null if unknown. */
  at: [east: number, north: number] | null;
}

/** What differs between the town that is kept and the one that is built now. */
export interface Difference {
  same: number;
  total: number;
  /** The first ones. */
  list: Changed[];
}

/** A feature that differs; what stands on it is empty for nothing. */
export interface Changed {
  layer: string;
  key: string;
  at: [east: number, north: number];
  before: string;
  after: string;
}

/** A view that the author has named; places are metres east, north and up, `fov` the vertical angle in degrees. */
export interface NamedView {
  name: string;
  from: [number, number, number];
  to: [number, number, number];
  fov: number;
  /** Year-month-day and hour of the sun; null for the usual afternoon. */
  date: string | null;
  hour: number | null;
  file: number;
  span: ByteRange;
}

/** The cursor in the user's editor. */
export interface Cursor {
  id: number;
  span: ByteRange;
}

export async function answer<T>(response: Response): Promise<T> {
  if (!response.ok) throw new Error(await response.text() || `${response.status}`);
  return await response.json() as T;
}

const fileQuery = (file: string) => `file=${encodeURIComponent(file)}`;

export const fetchServerInfo = async () => answer<ServerInfo>(await fetch('/api/hello'));
export const fetchState = async (file: string) => answer<State>(await fetch(`/api/state?${fileQuery(file)}`));
export const modelUrl = (file: string, revision: number) => `/api/model/${revision}/house.glb?${fileQuery(file)}`;

/** The address of the picture of a sheet. */
export const scanUrl = (file: string, { number, key }: ScanSheet) => `/api/scan?${fileQuery(file)}&sheet=${number}&key=${key}`;

/** The address of the files of a town. */
export const townFiles = (id: number) => `/api/town/${id}/files/`;

/** Fetches the decision about a feature, of any layer if none is named; null if there is no such feature. */
export const fetchFeature = async (id: number, layer: string, key: string) =>
  answer<Decision | null>(await fetch(`/api/town/${id}/feature?layer=${encodeURIComponent(layer)}&key=${encodeURIComponent(key)}`));

/** Fetches what binds the envelope of a lot at a place, metres east, north and up in the town; null if none has a face there. */
export const fetchFace = async (id: number, layer: string, key: string, [east, north, up]: [number, number, number]) =>
  answer<EnvelopeFace | null>(await fetch(`/api/town/${id}/face?${new URLSearchParams({ layer, key, east: `${east}`, north: `${north}`, up: `${up}` })}`));

/** Fetches a place, metres east and north of the town's origin, in the system of its map; null if that is not known. */
export const fetchPlace = async (id: number, east: number, north: number) =>
  answer<MapPlace | null>(await fetch(`/api/town/${id}/place?east=${east}&north=${north}`));

/** Fetches the first of the features on which nothing stands. */
export const fetchSkipped = async (id: number) => answer<{ total: number; list: Skipped[] }>(await fetch(`/api/town/${id}/skipped`));

/** Fetches what differs from the town that is kept; null if none is. */
export const fetchDifference = async (id: number) => answer<Difference | null>(await fetch(`/api/town/${id}/difference`));

/** Content type of a complete model. */
export const GLB_TYPE = 'model/gltf-binary';

const send = (path: string, body: unknown) =>
  fetch(path, { method: 'POST', headers: { 'content-type': 'application/json' }, body: JSON.stringify(body) });

/** Keeps the town that is built now, to compare later ones with it, or forgets it. */
export const keepTown = async (id: number, keep: boolean) => { await answer(await send(`/api/town/${id}/keep`, { keep })); };

/** Fetches the houses of a revision that the page does not have, or the complete model. */
export const fetchHouses = (file: string, revision: number, had: string[]) => send('/api/houses', { file, revision, had });

export const post = async <T>(path: string, body: unknown) => answer<T>(await send(path, body));

/** Sets parameters of a file for as long as the preview runs; those that are left out have their usual values. */
export const setParameters = (file: string, values: Record<string, string>) => post<{}>('/api/parameters', { file, values });

/** Opens a location in the user's editor. */
export const openInEditor = (file: string, id: number, span: ByteRange) => post<{}>('/api/open', { file, id, span });

/** A part that can be placed. */
export interface PaletteEntry {
  code: string;
  /** Class letter: K wall, T door, M window, G lattice, ... */
  class: string;
  /** What it closes; null for walls, posts and open bays. */
  opening: 'door' | 'window' | null;
  ja: string;
  romaji: string;
  en: string;
  /** In U. */
  width: number;
}

/** Fetches the parts available to a file. */
export const fetchPalette = async (file: string) => answer<PaletteEntry[]>(await fetch(`/api/parts?${fileQuery(file)}`));
export const partImageUrl = (file: string, code: string) => `/api/part?${fileQuery(file)}&code=${encodeURIComponent(code)}`;

/** The result of an edit: a new revision, or the reason for its refusal. */
export type EditResult = { revision?: number; refused?: string };

/** Applies an edit to the source file; the server documents the kinds of edits. */
export const applyEdit = (file: string, revision: number, edit: object) => post<EditResult>('/api/stroke', { file, revision, stroke: edit });
export const undo = (file: string) => post<EditResult>('/api/undo', { file });
export const redo = (file: string) => post<EditResult>('/api/redo', { file });

/** Subscribes to the server's events; returns a function that unsubscribes. Reconnects every second after a failure. */
export function listen(file: string, handlers: {
  state: (revision: number) => void;
  cursor: (cursor: Cursor | null) => void;
  town: (progress: TownProgress) => void;
  files: () => void;
  lost: () => void;
  found: () => void;
}): () => void {
  let events: EventSource, timer = 0;
  const connect = () => {
    events = new EventSource(`/api/events?${fileQuery(file)}`);
    const on = (name: string, then: (data: never) => void) =>
      events.addEventListener(name, event => then(JSON.parse((event as MessageEvent<string>).data) as never));
    on('state', ({ revision }: { revision: number }) => handlers.state(revision));
    on('cursor', handlers.cursor);
    on('town', handlers.town);
    on('files', handlers.files);
    events.addEventListener('open', handlers.found);
    events.addEventListener('error', () => {
      handlers.lost();
      events.close();
      timer = window.setTimeout(connect, 1000);
    });
  };
  connect();
  return () => {
    clearTimeout(timer);
    events.close();
  };
}
