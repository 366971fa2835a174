// What the server says and takes (src/view in the Rust sources). Lengths in plans are U in the author frame; spans count
// bytes of the original file.

export type Language = 'en' | 'ja';
export type Bytes = [start: number, end: number];

/** A file below the folder that is shown. */
export interface File {
  path: string;
  kind: 'text' | 'model';
}

export interface Hello {
  version: string;
  language: Language;
  root: string;
  files: File[];
  /** The file to begin with. */
  file: string | null;
  /** Whether strokes may change texts. */
  writes: boolean;
  /** Whether there is an editor that can be sent to a place. */
  opens: boolean;
}

/** A text that was read; 0 is the one that is shown. */
export interface Source {
  id: number;
  name: string;
  /** Its path below the folder; null where it lies outside. */
  path: string | null;
  text: string;
  /** Bytes of the file before the text. */
  mark: number;
  /** How many bytes of the file each UTF-16 unit of the text takes, a digit each; null = as in UTF-8. */
  widths: string | null;
}

/** What a source is called: its path below the folder, else the end of its name. */
export const called = ({ path, name }: Source) => path ?? name.split(/[\\/]/).pop()!;

/** The source that a message is of; none where it is of a model. */
export const source_of = ({ id, file }: Diagnostic, sources: Source[]) =>
  sources.find(source => id === undefined ? source.name === file : source.id === id);

export interface Diagnostic {
  /** Which source it is in. */
  id?: number;
  /** Empty where the page says it. */
  code: string;
  severity: 'error' | 'warning' | 'note';
  message: string;
  help: string | null;
  file: string;
  /** Counted from 1; says nothing where the message is of a model. */
  line: number;
  column: number;
  span: { start: number; end: number };
  labels: { message: string; file: string; span: { start: number; end: number } }[];
}

export type Point = [a: number, b: number];

/** What stands in a wall, from `from` at its right to `to` as seen from outside. */
export interface Unit {
  code: string;
  /** One of wall, door, window, lattice, post, opening, modern, void, picture, split. */
  part: string;
  from: Point;
  to: Point;
  span: Bytes;
  file: number;
  /** Key of a reason why nothing else can be put there. */
  fixed: string | null;
}

export interface Wall {
  facade: number;
  from: Point;
  to: Point;
  span: Bytes;
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
  /** Only where it is no rectangle. */
  polygon?: Point[];
}

/** A walk along walls. */
export interface Ring {
  hole: boolean;
  inner: boolean;
  closed: boolean;
  walls: Wall[];
}

export interface Storey {
  storey: number;
  kind: 'storey' | 'parapet';
  z0: number;
  z1: number;
  /** Shaku. */
  height: number;
  file: number;
  span: Bytes;
  fixed: string | null;
  rings: Ring[];
  regions: Region[];
}

export interface Roof {
  shape: string;
  kind: string;
  storey: number;
  file?: number;
  span?: Bytes;
  rect: [a0: number, b0: number, a1: number, b1: number];
  z: number;
  ridge: [Point, Point] | null;
}

export interface House {
  name: string;
  file: number;
  span: Bytes;
  street: boolean;
  fixed: string | null;
  roofs: Roof[];
  azimuth: number;
  origin: [east: number, north: number, up: number];
  unit_m: number;
  storeys: Storey[];
}

export interface State {
  revision: number;
  file: string;
  sources: Source[];
  diagnostics: Diagnostic[];
  /** Of each house what is the same for the same one, and its name; none of a model that was made before. */
  houses: [key: string, name: string][];
  /** The pictures beside the model, by name: what is the same under the same key is the same picture. */
  pictures: Record<string, string>;
  /** `reasons`: what the keys in `fixed` mean. */
  plan: { reasons: Record<string, string>; houses: House[] };
  times: [step: string, ms: number][];
}

/** A place that the author's editor stands at. */
export interface Cursor {
  id: number;
  span: Bytes;
}

async function answer<T>(response: Response): Promise<T> {
  if (!response.ok) throw new Error(await response.text() || `${response.status}`);
  return await response.json() as T;
}

const of = (file: string) => `file=${encodeURIComponent(file)}`;

export const hello = async () => answer<Hello>(await fetch('/api/hello'));
export const state = async (file: string) => answer<State>(await fetch(`/api/state?${of(file)}`));
export const model_url = (file: string, revision: number) => `/api/model/${revision}/house.glb?${of(file)}`;

/** The kind of an answer that is a whole model. */
export const WHOLE = 'model/gltf-binary';

const send = (path: string, body: unknown) =>
  fetch(path, { method: 'POST', headers: { 'content-type': 'application/json' }, body: JSON.stringify(body) });

/** The houses that are lacked by who had these of an earlier revision, or the whole model. */
export const others = (file: string, revision: number, had: string[]) => send('/api/houses', { file, revision, had });

const post = async <T>(path: string, body: unknown) => answer<T>(await send(path, body));

/** Sends the author's editor to a place. */
export const open = (file: string, id: number, span: Bytes) => post<{}>('/api/open', { file, id, span });

/** A part that can be set. */
export interface Palette {
  code: string;
  /** Letter: K wall, T door, M window, G lattice, ... */
  class: string;
  ja: string;
  romaji: string;
  en: string;
  /** U. */
  width: number;
}

/** The parts that the houses of a file may be made of. */
export const palette = async (file: string) => answer<Palette[]>(await fetch(`/api/parts?${of(file)}`));
export const picture_of = (file: string, code: string) => `/api/part?${of(file)}&code=${encodeURIComponent(code)}`;

/** What a stroke came to: a new revision, or why it was refused. */
export type Answer = { revision?: number; refused?: string };

/** Changes the text by a stroke, as the header of src/ide/stroke.rs has them. */
export const stroke = (file: string, revision: number, stroke: object) => post<Answer>('/api/stroke', { file, revision, stroke });
export const undo = (file: string) => post<Answer>('/api/undo', { file });
export const redo = (file: string) => post<Answer>('/api/redo', { file });

/** Hears of what changes; returns how to stop. Where the server is lost it is called again until it answers. */
export function listen(file: string, hear: {
  state: (revision: number) => void;
  cursor: (cursor: Cursor | null) => void;
  files: () => void;
  lost: () => void;
  found: () => void;
}): () => void {
  let events: EventSource, again = 0;
  const begin = () => {
    events = new EventSource(`/api/events?${of(file)}`);
    const on = (name: string, then: (data: never) => void) =>
      events.addEventListener(name, event => then(JSON.parse((event as MessageEvent<string>).data) as never));
    on('state', ({ revision }: { revision: number }) => hear.state(revision));
    on('cursor', hear.cursor);
    on('files', hear.files);
    events.addEventListener('open', hear.found);
    events.addEventListener('error', () => {
      hear.lost();
      events.close();
      again = window.setTimeout(begin, 1000);
    });
  };
  begin();
  return () => {
    clearTimeout(again);
    events.close();
  };
}
