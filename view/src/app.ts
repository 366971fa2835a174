// What the page knows: the file that is shown, its state, its model, what is selected. Whoever shows some of it listens.

import * as THREE from 'three';
import { Places } from './places.ts';
import { Highlight } from './highlight.ts';
import { Loader, Unreadable } from './load.ts';
import { Measure } from './measure.ts';
import { Mirrors } from './mirror/mirrors.ts';
import { type Chunk, type Model, model_of } from './model.ts';
import { Turntable } from './orbit.ts';
import { found_again, parts_at, trace_of } from './parts.ts';
import { Section } from './section.ts';
import type { Bytes, Cursor, Diagnostic, Hello, State } from './server.ts';
import { hello, listen, open, palette, source_of, state } from './server.ts';
import { Stage } from './stage.ts';
import { look_from, type View } from './views.ts';
import { both, words } from './words.ts';

/** files: the folder; state: a text was read; model: another one stands; select, cursor: what is lit; shown: what is hidden. */
export type Happening = 'files' | 'state' | 'model' | 'select' | 'cursor' | 'shown' | 'connection' | 'reload';

/** A place in a source that the text is asked to show. */
export interface Spot {
  id: number;
  span: Bytes;
}

/** Where a reload spent its time, milliseconds since it was heard of. */
export interface Reload {
  revision: number;
  fetched: number;
  parsed: number;
  painted: number;
}

export class App {
  hello!: Hello;
  file: string | null = null;
  state: State | null = null;
  model: Model | null = null;
  selection: number | null = null;
  lost = false;
  /** Whether the eye is on its way to a view. */
  looking = false;
  /** Whether all controls go back to where they began. */
  resetting = false;
  /** What parts are called, by code. */
  names = new Map<string, string>();
  reload_times: Reload | null = null;
  /** By the number of the source. */
  places = new Map<number, Places>();
  /** What is not shown: `storey 1`, `roof 2`, `other`. */
  readonly hidden = new Set<string>();
  readonly stage: Stage;
  readonly loader = new Loader();
  readonly section: Section;
  readonly measure: Measure;
  readonly turntable: Turntable;
  readonly mirrors: Mirrors;
  readonly selected: Highlight;
  readonly pointed: Highlight;
  /** Says something to those who cannot see it. */
  announce: (text: string) => void = () => {};
  /** Shows a place in the text pane. */
  show_text: (spot: Spot) => void = () => {};
  #listeners = new Map<Happening, (() => void)[]>();
  #turn = 0;
  /** The newest revision that the server has told of. */
  #heard = 0;
  #stop: () => void = () => {};

  constructor(canvas: HTMLCanvasElement) {
    this.stage = new Stage(canvas);
    this.section = new Section(this.stage);
    this.measure = new Measure(this.stage);
    this.turntable = new Turntable(this.stage);
    this.mirrors = mirrors_on(this.stage);
    this.pointed = new Highlight(this.stage, 'cursor', 0x2f6f9f);
    this.selected = new Highlight(this.stage, 'selection', 0xc8431f);
    this.stage.shown = chunk => !this.hidden.has(this.layer_of(chunk));
  }

  on(what: Happening, then: () => void) {
    this.#listeners.set(what, [...this.#listeners.get(what) ?? [], then]);
  }

  tell(what: Happening) {
    for (const then of this.#listeners.get(what) ?? []) then();
  }

  async begin() {
    this.hello = await hello();
    this.tell('files');
  }

  /** Shows a file of the folder. */
  async choose(file: string) {
    this.#stop();
    this.file = file;
    this.state = this.model = null;
    this.hidden.clear();
    this.stage.show(model_of(new THREE.Group())); // what stood there is no longer what is named
    this.measure.clear();
    this.select(null);
    this.#point(null);
    this.tell('files');
    void this.#learn(file);
    this.#heard = 0;
    this.#stop = listen(file, {
      state: revision => {
        this.#heard = revision;
        if (this.state) void this.reload(revision); // the first one is on its way
      },
      cursor: cursor => this.#point(cursor),
      files: () => void this.#list(),
      lost: () => this.#connection(true),
      found: () => { if (this.lost) { this.#connection(false); void this.reload(); void this.#list(); } },
    });
    await this.reload();
    if (this.file === file && this.#heard > this.revision) await this.reload(this.#heard);
  }

  get revision(): number { return this.state?.revision ?? 0; }

  /** Reads the state of the file and its model; `revision` = the one that was heard of. */
  async reload(revision?: number): Promise<void> {
    const { file, model: before } = this, heard = performance.now();
    if (file === null || revision !== undefined && revision === this.state?.revision) return;
    const turn = ++this.#turn;
    try {
      // The model is asked for at once where its number is known.
      const early = revision === undefined ? null : this.loader.fetch(file, revision, before);
      early?.catch(() => {});
      const now = await state(file);
      const answer = await (early && now.revision === revision ? early : this.loader.fetch(file, now.revision, before));
      const fetched = performance.now() - heard;
      if (turn !== this.#turn || file !== this.file) return;
      let model: Model | null = null;
      try {
        model = answer && await this.loader.load(answer, file, now);
        if (!model && turn === this.#turn && file === this.file) return await this.reload(); // there is a newer one
      } catch (error) {
        if (!(error instanceof Unreadable)) throw error;
        now.diagnostics.push(unreadable(file, error));
      }
      if (turn !== this.#turn || file !== this.file) return;
      this.#take(now, model, { revision: now.revision, fetched, parsed: performance.now() - heard, painted: 0 }, heard);
    } catch (error) {
      this.announce(words.failed + (error as Error).message);
    }
  }

  #take(now: State, model: Model | null, times: Reload, heard: number) {
    const first = !this.model?.chunks.length, before = this.places;
    const trace = this.model && this.selection !== null ? trace_of(this.model, this.selection) : null;
    this.state = now;
    this.places = new Map(now.sources.map(source => [source.id, new Places(source)]));
    const nothing = !model || model.chunks.length === 0;
    const keep = nothing && !first && now.diagnostics.some(d => d.severity === 'error');
    if (model && !keep) {
      this.model = model;
      const again = trace && found_again(trace, model, before.get(trace.file), this.places.get(trace.file));
      this.selection = again;
      this.selected.set(model, again === null ? [] : [again]);
      this.pointed.set(model, this.cursor ? parts_at(model, this.cursor.id, this.cursor.span) : []);
      this.stage.show(model);
      if (first) this.look('front');
    }
    this.stage.frame(!first);
    this.stage.settle();
    times.painted = performance.now() - heard;
    this.reload_times = times;
    document.documentElement.dataset.revision = `${now.revision}`;
    // What stands beside the model comes after it.
    setTimeout(() => {
      if (this.state !== now) return;
      this.tell('state');
      if (!keep) this.tell('model');
      this.tell('select');
      this.tell('reload');
      if (first) setTimeout(() => { this.stage.frame(); this.stage.settle(); }, 100); // to know how quick the machine is
      const count = (severity: string) => now.diagnostics.filter(d => d.severity === severity).length;
      const messages = now.diagnostics.length ? ` ${words.messages(count('error'), count('warning'))}` : '';
      this.announce((keep ? words.kept : this.model?.chunks.length ? words.reloaded(now.revision) : words.nothing_stands) + messages);
    });
  }

  /** Selects a part, or none. */
  select(part: number | null) {
    this.selection = part;
    this.selected.set(this.model, part === null ? [] : [part]);
    this.tell('select');
    if (part !== null) this.announce(words.selected + this.describe(part));
  }

  /** A part in a few words. */
  describe(part: number): string {
    const { kind, code, name, storey } = this.model!.parts[part]!;
    const what = words.kind[kind] ?? kind;
    return [what, code?.trim() || name, storey > 0 && kind !== 'storey' ? words.storey(storey) : ''].filter(Boolean).join(words.comma);
  }

  /** Lights up what is written at a place. */
  light(spot: Spot | null) {
    const parts = this.model && spot ? parts_at(this.model, spot.id, spot.span) : [];
    this.pointed.set(this.model, parts);
    this.tell('cursor');
  }

  /** Selects what is written at a place. */
  select_at({ id, span }: Spot) {
    const found = this.model ? parts_at(this.model, id, span) : [];
    if (found.length) this.select(found[0]!);
  }

  cursor: Cursor | null = null;
  #point(cursor: Cursor | null) {
    this.cursor = cursor;
    this.light(cursor);
  }

  /** The line that a place begins on, from 1, and the text of the line. */
  line_of({ id, span }: Spot): { line: number; text: string } | null {
    const places = this.places.get(id);
    if (!places) return null;
    const line = places.line(places.unit(span[0]));
    return { line: line + 1, text: places.text.slice(places.lines[line], places.lines[line + 1] ?? undefined).trimEnd() };
  }

  spot_of(part: number): Spot | null {
    for (let at: number | null = part; at !== null; at = this.model!.parts[at]!.parent) {
      const { span, file } = this.model!.parts[at]!;
      if (span) return { id: file, span };
    }
    return null;
  }

  /** Sends the author's editor to a place. */
  async open({ id, span }: Spot) {
    if (!this.file || !this.hello.opens) return;
    try {
      await open(this.file, id, span);
      this.announce(words.opened);
    } catch (error) {
      this.announce(words.failed + (error as Error).message);
    }
  }

  /** Shows where a message points to: in the text, and in the editor where there is one. */
  go_to(message: Diagnostic) {
    const spot = spot_of_message(message, this.state!);
    if (!spot) return;
    this.show_text(spot);
    void this.open(spot);
  }

  /** What is switched with a chunk. */
  layer_of({ owner, storey }: Chunk): string {
    const kind = this.model?.parts[owner]?.kind;
    if (kind === 'roof' || kind === 'finial') return `roof ${storey}`;
    return storey > 0 ? `storey ${storey}` : 'other';
  }

  layers(): string[] {
    const layers = new Set(this.model?.chunks.map(chunk => this.layer_of(chunk)));
    const order = ['storey', 'roof', 'other'];
    const rank = (layer: string) => order.indexOf(layer.split(' ')[0]!) * 1e6 + Number(layer.split(' ')[1] ?? 0);
    return [...layers].sort((a, b) => rank(a) - rank(b));
  }

  hide(layer: string, hidden: boolean) {
    if (hidden) this.hidden.add(layer); else this.hidden.delete(layer);
    this.stage.refresh();
    this.tell('shown');
  }

  /** Where the front of the first house looks. */
  azimuth(): number { return this.state?.plan.houses[0]?.azimuth ?? 180; }

  look(view: View, part: number | null = null) {
    const box = part === null ? this.model?.box : this.model?.parts[part]?.box;
    if (!box || box.isEmpty()) return;
    this.looking = true;
    this.stage.look_at(look_from(this.stage.camera, box.clone(), view, this.azimuth()));
    this.looking = false;
  }

  /** Everything as it was when the page was opened. */
  reset() {
    this.resetting = true;
    this.hidden.clear();
    this.turntable.set(false);
    this.section.set({ on: false, axis: 'z', at: 0.5, flip: false });
    this.select(null);
    this.tell('shown');
    this.resetting = false;
    this.stage.refresh();
    this.look('front');
  }

  #connection(lost: boolean) {
    if (this.lost === lost) return;
    this.lost = lost;
    this.announce(lost ? words.lost : words.found);
    this.tell('connection');
  }

  /** What parts are called. */
  async #learn(file: string) {
    const parts = await palette(file).catch(() => []);
    if (file !== this.file) return;
    this.names = new Map(parts.map(({ code, ja, romaji, en }) => [code.trim(), `${words === both.ja ? ja : en} · ${words === both.ja ? romaji : `${ja} ${romaji}`}`]));
    this.tell('select');
  }

  async #list() {
    try {
      const { file } = this, there = (hello: Hello) => hello.files.some(({ path }) => path === file), before = there(this.hello);
      this.hello = { ...await hello(), file: this.hello.file };
      this.tell('files');
      if (file !== null && file === this.file && before && !there(this.hello)) this.announce(words.gone(file));
    } catch { /* The events say when the server is lost. */ }
  }
}

/** The place of a message in the sources of a state; none where it is of a model. */
export function spot_of_message(message: Diagnostic, { sources }: State): Spot | null {
  const source = source_of(message, sources);
  return source ? { id: source.id, span: [message.span.start, message.span.end] } : null;
}

/** A model that cannot be read, told as what the compiler says is. */
function unreadable(file: string, { message }: Error): Diagnostic {
  const nowhere = { line: 0, column: 0, span: { start: 0, end: 0 }, labels: [] };
  return { code: '', severity: 'error', message: words.unreadable(file, message), help: words.unreadable_help, file, ...nowhere };
}

/** Lets the glass of a stage mirror what stands on it. */
function mirrors_on(stage: Stage): Mirrors {
  const mirrors = new Mirrors(stage.renderer, stage.scene);
  mirrors.options.sky = stage.surroundings.colours;
  mirrors.probes.wake = () => stage.draw();
  stage.marks.userData['mirrored'] = false;
  stage.on_model.push(model => mirrors.show(model));
  stage.on_restored.push(() => mirrors.probes.clear());
  // A pane that a quick frame is too coarse for is not hidden.
  stage.paint = () => mirrors.paint(stage.camera, !stage.coarse);
  return mirrors;
}
