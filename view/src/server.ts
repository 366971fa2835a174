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

export interface Diagnostic {
  code: string;
  severity: 'error' | 'warning' | 'note';
  message: string;
  help: string | null;
  file: string;
  line: number;
  column: number;
  span: { start: number; end: number };
  labels: { message: string; file: string; span: { start: number; end: number } }[];
}

export type Point = [a: number, b: number];

export interface Unit {
  code: string;
  from: number;
  to: number;
  span: Bytes;
  file: number;
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
}

export interface Storey {
  storey: number;
  z0: number;
  z1: number;
  rings: { hole: boolean; inner: boolean; walls: Wall[] }[];
  regions: Region[];
}

export interface House {
  name: string;
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
  /** The pictures beside the model, by name: what is the same under the same key is the same picture. */
  pictures: Record<string, string>;
  plan: { houses: House[] };
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

async function post<T>(path: string, body: unknown): Promise<T> {
  const headers = { 'content-type': 'application/json' };
  return answer<T>(await fetch(path, { method: 'POST', headers, body: JSON.stringify(body) }));
}

/** Sends the author's editor to a place. */
export const open = (file: string, id: number, span: Bytes) => post<{}>('/api/open', { file, id, span });

/** Hears of what changes; returns how to stop. */
export function listen(file: string, hear: {
  state: (revision: number) => void;
  cursor: (cursor: Cursor | null) => void;
  files: () => void;
  lost: () => void;
}): () => void {
  const events = new EventSource(`/api/events?${of(file)}`);
  const on = (name: string, then: (data: never) => void) =>
    events.addEventListener(name, event => then(JSON.parse((event as MessageEvent<string>).data) as never));
  on('state', ({ revision }: { revision: number }) => hear.state(revision));
  on('cursor', hear.cursor);
  on('files', hear.files);
  events.addEventListener('error', hear.lost);
  return () => events.close();
}
