// State of the page: the open file, its compiled state, its model and the selection. Panels and panes subscribe to its
// events.

import * as THREE from 'three';
import { OffsetMap } from './server/offsets.ts';
import { Highlight } from './scene/highlight.ts';
import { Loader, InvalidModelError } from './model/loader.ts';
import { Measure } from './scene/measure.ts';
import { alongStreet } from './scene/opening.ts';
import { Mirrors } from './mirror/mirrors.ts';
import { type Chunk, type Model, buildModel } from './model/model.ts';
import { Turntable } from './scene/orbit.ts';
import { findAgain, partsAt, traceOf } from './model/parts.ts';
import { Section } from './scene/section.ts';
import type { ByteRange, Cursor, Diagnostic, NamedView, ServerInfo, State } from './server/api.ts';
import { fetchPalette, fetchServerInfo, fetchState, listen, openInEditor, sourceOf } from './server/api.ts';
import { Viewport } from './scene/viewport.ts';
import { EYE_HEIGHT, frameBox, type View } from './scene/views.ts';
import { Comparison } from './town/comparison.ts';
import { Town } from './town/town.ts';
import { Walk } from './walk/walk.ts';
import { translations, strings } from './ui/strings.ts';

/**
 * `files`: the file list changed. `state`: a file was compiled. `model`: the model was replaced. `select`, `cursor`: the
 * highlighted parts changed. `shown`: visibility changed. `visited`: the camera went to a named view, or left it.
 * `town`: the town, its selected feature or the progress of its build changed. `walk`: a walk began or ended.
 */
export type AppEvent = 'files' | 'state' | 'model' | 'select' | 'cursor' | 'shown' | 'visited' | 'connection' | 'reload' | 'town' | 'walk';

/** A byte range in a source file. */
export interface SourceLocation {
  id: number;
  span: ByteRange;
}

/** Timings of a reload, milliseconds since the server announced the revision. */
export interface ReloadTimes {
  revision: number;
  fetched: number;
  parsed: number;
  painted: number;
}

export class App {
  serverInfo!: ServerInfo;
  file: string | null = null;
  state: State | null = null;
  model: Model | null = null;
  selection: number | null = null;
  lost = false;
  /** True while the camera moves to a preset view. */
  movingToView = false;
  /** True while `reset` restores the initial settings. */
  resetting = false;
  /** Display names of parts, by code. */
  names = new Map<string, string>();
  /** Codes of doors. */
  doors = new Set<string>();
  reloadTimes: ReloadTimes | null = null;
  /** Offset maps of the sources, by source id. */
  offsets = new Map<number, OffsetMap>();
  /** Hidden layers: `storey 1`, `roof 2`, `other`. */
  readonly hidden = new Set<string>();
  readonly viewport: Viewport;
  readonly loader = new Loader();
  readonly section: Section;
  readonly measure: Measure;
  readonly turntable: Turntable;
  readonly mirrors: Mirrors;
  readonly selected: Highlight;
  readonly pointed: Highlight;
  readonly town: Town;
  readonly comparison: Comparison;
  readonly walk: Walk;
  /** Announces a text in the live region. */
  announce: (text: string) => void = () => {};
  /** Sets the sun to a date and hour; null for the usual afternoon. */
  light: (time: { date: string; hour: number } | null) => void = () => {};
  /** Shows a location in the source pane. */
  showSource: (location: SourceLocation) => void = () => {};
  #listeners = new Map<AppEvent, (() => void)[]>();
  #request = 0;
  /** The newest revision that the server has announced. */
  #latestRevision = 0;
  #unsubscribe: () => void = () => {};

  constructor(canvas: HTMLCanvasElement) {
    this.viewport = new Viewport(canvas);
    this.section = new Section(this.viewport);
    this.measure = new Measure(this.viewport, () => this.meshes());
    this.turntable = new Turntable(this.viewport);
    this.mirrors = createMirrors(this.viewport);
    this.pointed = new Highlight(this.viewport, 'cursor', 0x2f6f9f);
    this.selected = new Highlight(this.viewport, 'selection', 0xc8431f);
    this.town = new Town(this);
    this.comparison = new Comparison(this);
    this.walk = new Walk(this);
    this.viewport.controls.addEventListener('change', () => { if (!this.movingToView) { this.#framed = null; this.#visits(null); } });
    // A preset view still shows all of it when the panel opens or the window turns.
    this.viewport.onResized.push(() => { if (this.#framed) this.look(this.#framed.view, this.#framed.part); });
    this.section.overlays.push(...this.pointed.materials, ...this.selected.materials);
    this.viewport.isVisible = chunk => !this.hidden.has(this.layerOf(chunk));
  }

  on(event: AppEvent, then: () => void) {
    this.#listeners.set(event, [...this.#listeners.get(event) ?? [], then]);
  }

  emit(event: AppEvent) {
    for (const then of this.#listeners.get(event) ?? []) then();
  }

  async start() {
    this.serverInfo = await fetchServerInfo();
    this.emit('files');
  }

  /** Opens a file of the workspace. */
  async openFile(file: string) {
    this.#unsubscribe();
    this.file = file;
    this.state = this.model = this.#framed = null;
    this.hidden.clear();
    this.viewport.show(buildModel(new THREE.Group())); // The previous file's model must not stay under the new file's name.
    this.walk.leave();
    this.town.apply(file, null);
    this.measure.clear();
    this.select(null);
    this.#setCursor(null);
    this.emit('files');
    void this.#loadPartNames(file);
    this.#latestRevision = 0;
    this.#unsubscribe = listen(file, {
      state: revision => {
        this.#latestRevision = revision;
        if (this.state) void this.reload(revision); // The first load is already under way.
      },
      cursor: cursor => this.#setCursor(cursor),
      town: progress => this.town.hear(progress),
      files: () => void this.#refreshFiles(),
      lost: () => this.#connection(true),
      found: () => { if (this.lost) { this.#connection(false); void this.reload(); void this.#refreshFiles(); } },
    });
    await this.reload();
    if (this.file === file && this.#latestRevision > this.revision) await this.reload(this.#latestRevision);
  }

  get revision(): number { return this.state?.revision ?? 0; }

  /** Fetches the state and the model of the open file; `revision` is the one that the server announced, if any. */
  async reload(revision?: number): Promise<void> {
    const { file, model: before } = this, begun = performance.now();
    if (file === null || revision !== undefined && revision === this.state?.revision) return;
    const request = ++this.#request;
    try {
      // With a known revision, the model is requested in parallel with the state; a town most likely stays one.
      const early = revision === undefined || this.town.state ? null : this.loader.fetch(file, revision, before);
      early?.catch(() => {});
      const now = await fetchState(file);
      now.diagnostics.push(...faultsOf(now));
      // A town is no model: its tiles are streamed.
      const answer = now.town ? null : await (early && now.revision === revision ? early : this.loader.fetch(file, now.revision, before));
      const fetched = performance.now() - begun;
      if (request !== this.#request || file !== this.file) return;
      let model: Model | null = null;
      try {
        model = answer && await this.loader.load(answer, file, now);
        if (!model && !now.town && request === this.#request && file === this.file) return await this.reload(); // A newer revision exists.
      } catch (error) {
        if (!(error instanceof InvalidModelError)) throw error;
        now.diagnostics.push(invalidModel(file, error));
      }
      if (request !== this.#request || file !== this.file) return;
      this.#apply(now, model, { revision: now.revision, fetched, parsed: performance.now() - begun, painted: 0 }, begun);
    } catch (error) {
      this.announce(strings.failed + (error as Error).message);
    }
  }

  #apply(now: State, model: Model | null, times: ReloadTimes, begun: number) {
    const first = !this.model?.chunks.length, before = this.offsets;
    const trace = this.model && this.selection !== null ? traceOf(this.model, this.selection) : null;
    this.state = now;
    this.offsets = new Map(now.sources.map(source => [source.id, new OffsetMap(source)]));
    const nothing = !model || model.chunks.length === 0;
    const keep = nothing && !first && now.diagnostics.some(d => d.severity === 'error');
    if (model && !keep) {
      this.model = model;
      const again = trace && findAgain(trace, model, before.get(trace.file), this.offsets.get(trace.file));
      this.selection = again;
      this.selected.set(model, again === null ? [] : [again]);
      this.pointed.set(model, this.cursor ? partsAt(model, this.cursor.id, this.cursor.span) : []);
      this.viewport.show(model);
      if (first) this.#lookFirst();
    }
    this.town.apply(this.file, now.town);
    this.viewport.frame(!first);
    this.viewport.settle();
    times.painted = performance.now() - begun;
    this.reloadTimes = times;
    document.documentElement.dataset.revision = `${now.revision}`;
    // The panels are updated after the model has been painted.
    setTimeout(() => {
      if (this.state !== now) return;
      this.emit('state');
      if (!keep) this.emit('model');
      this.emit('select');
      this.emit('reload');
      if (first) setTimeout(() => { this.viewport.frame(); this.viewport.settle(); }, 100); // Measures how long a full frame takes on this machine.
      const count = (severity: string) => now.diagnostics.filter(d => d.severity === severity).length;
      const messages = now.diagnostics.length ? ` ${strings.messages(count('error'), count('warning'))}` : '';
      const there = this.model?.chunks.length || now.town;
      this.announce((keep ? strings.kept : there ? strings.reloaded(now.revision) : strings.noModel) + messages);
    });
  }

  /** Selects a part; null clears the selection. */
  select(part: number | null) {
    this.selection = part;
    this.selected.set(this.model, part === null ? [] : [part]);
    this.emit('select');
    if (part !== null) this.announce(strings.selected + this.describe(part));
  }

  /** What is drawn of the model, or of the tiles of the town. */
  *meshes(): Iterable<THREE.Mesh> {
    if (this.town.tiles) yield* this.town.tiles.meshes();
    else for (const { mesh } of this.viewport.model?.chunks ?? []) if (mesh.visible) yield mesh;
  }

  /** A short description of a part. */
  describe(part: number): string {
    const { kind, code, name, storey } = this.model!.parts[part]!;
    const what = strings.kind[kind] ?? kind;
    return [what, code?.trim() || name, storey > 0 && kind !== 'storey' ? strings.storey(storey) : ''].filter(Boolean).join(strings.comma);
  }

  /** Highlights the parts written at a location. */
  highlight(location: SourceLocation | null) {
    const parts = this.model && location ? partsAt(this.model, location.id, location.span) : [];
    this.pointed.set(this.model, parts);
    this.emit('cursor');
  }

  /** Selects the part written at a location. */
  selectAt({ id, span }: SourceLocation) {
    const found = this.model ? partsAt(this.model, id, span) : [];
    if (found.length) this.select(found[0]!);
  }

  cursor: Cursor | null = null;
  #setCursor(cursor: Cursor | null) {
    this.cursor = cursor;
    this.highlight(cursor);
  }

  /** The 1-based line number on which a location begins, and the text of that line. */
  lineAt({ id, span }: SourceLocation): { line: number; text: string } | null {
    const offsets = this.offsets.get(id);
    if (!offsets) return null;
    const line = offsets.line(offsets.unit(span[0]));
    return { line: line + 1, text: offsets.text.slice(offsets.lines[line], offsets.lines[line + 1] ?? undefined).trimEnd() };
  }

  /** A line of the open file, from 1; null if there is none. */
  lineLocation(line: number): SourceLocation | null {
    const offsets = this.offsets.get(0), start = offsets?.lines[line - 1];
    if (!offsets || start === undefined) return null;
    const text = offsets.text.slice(start, offsets.lines[line] ?? undefined), blanks = text.length - text.trimStart().length;
    return { id: 0, span: [offsets.byte(start + blanks), offsets.byte(start + text.trimEnd().length)] };
  }

  /** The `for` with a number, from 1, in the open file. */
  ruleLocation(rule: number): SourceLocation | null {
    const offsets = this.offsets.get(0);
    // Comments keep their length, so that places stay.
    const plain = offsets?.text.replace(/<!--.*?-->/gs, comment => ' '.repeat(comment.length)) ?? '';
    const found = [...plain.matchAll(/<for\b[^>]*>/g)][rule - 1];
    return found ? { id: 0, span: [offsets!.byte(found.index), offsets!.byte(found.index + found[0].length)] } : null;
  }

  locationOf(part: number): SourceLocation | null {
    for (let at: number | null = part; at !== null; at = this.model!.parts[at]!.parent) {
      const { span, file } = this.model!.parts[at]!;
      if (span) return { id: file, span };
    }
    return null;
  }

  /** Opens a location in the user's editor. */
  async open({ id, span }: SourceLocation) {
    if (!this.file || !this.serverInfo.opens) return;
    try {
      await openInEditor(this.file, id, span);
      this.announce(strings.opened);
    } catch (error) {
      this.announce(strings.failed + (error as Error).message);
    }
  }

  /** Shows the location of a diagnostic in the source pane, and in the editor where there is one; a feature in the model. */
  showDiagnostic(message: Diagnostic) {
    if (message.feature) return void this.town.goTo(message.feature.layer, message.feature.key);
    const location = locationOfDiagnostic(message, this.state!);
    if (!location) return;
    this.showSource(location);
    void this.open(location);
  }

  /** The visibility layer of a chunk. */
  layerOf({ owner, storey }: Chunk): string {
    const kind = this.model?.parts[owner]?.kind;
    if (kind === 'roof' || kind === 'finial') return `roof ${storey}`;
    return storey > 0 ? `storey ${storey}` : 'other';
  }

  layers(): string[] {
    const layers = new Set(this.model?.chunks.map(chunk => this.layerOf(chunk)));
    const order = ['storey', 'roof', 'other'];
    const rank = (layer: string) => order.indexOf(layer.split(' ')[0]!) * 1e6 + Number(layer.split(' ')[1] ?? 0);
    return [...layers].sort((a, b) => rank(a) - rank(b));
  }

  hide(layer: string, hidden: boolean) {
    if (hidden) this.hidden.add(layer); else this.hidden.delete(layer);
    this.viewport.refresh();
    this.emit('shown');
  }

  /** Azimuth of the front of the first house, degrees. */
  azimuth(): number { return this.state?.plan.houses[0]?.azimuth ?? 180; }

  look(view: View, part: number | null = null) {
    const box = this.town.viewBox() ?? (part === null ? this.model?.box : this.model?.parts[part]?.box);
    if (!box || box.isEmpty()) return;
    this.#visits(null);
    this.movingToView = true;
    this.viewport.setFieldOfView(null);
    this.viewport.lookAt(frameBox(this.viewport.camera, box.clone(), view, this.azimuth()));
    this.movingToView = false;
    this.#framed = { view, part };
  }

  /** The name of the view of the file that is shown, until the camera is moved. */
  visited: string | null = null;
  #visits(name: string | null) {
    if (this.visited === name) return;
    this.visited = name;
    this.emit('visited');
  }

  /** Goes to a view that the file names: its place, its angle and its light. */
  visit({ name, from, to, fov, date, hour }: NamedView) {
    if (!this.model) return;
    const place = ([east, north, up]: NamedView['from']) => new THREE.Vector3(east, up, -north).sub(this.model!.origin);
    this.#framed = null;
    this.light(date === null || hour === null ? null : { date, hour });
    this.movingToView = true;
    this.viewport.setFieldOfView(fov);
    this.viewport.camera.position.copy(place(from));
    this.viewport.lookAt(place(to));
    this.movingToView = false;
    this.#visits(name);
    this.announce(strings.atView(name));
  }

  /** The preset view that is shown, until the camera is moved. */
  #framed: { view: View; part: number | null } | null = null;

  /** Restores the settings that the page opened with. */
  reset() {
    this.walk.leave();
    this.resetting = true;
    this.hidden.clear();
    this.turntable.set(false);
    this.section.set({ on: false, axis: 'z', at: 0.5, flip: false });
    this.select(null);
    this.town.clearSelection();
    this.emit('shown');
    this.resetting = false;
    this.viewport.refresh();
    if (this.town.state) this.look('above'); else this.#lookFirst();
  }

  /** The view that the file opens with: along a street of facing houses, else the first that the file names, else the front. */
  #lookFirst() {
    const street = this.model && alongStreet(this.state?.plan.houses ?? []), named = this.state?.plan.views[0];
    if (!street) return named ? this.visit(named) : this.look('front');
    const { origin, box } = this.model!, ground = Math.min(0, box.min.y);
    const place = ([east, north]: [number, number]) => new THREE.Vector3(east - origin.x, ground + EYE_HEIGHT, -north - origin.z);
    this.#framed = null;
    this.#visits(null);
    this.viewport.setFieldOfView(null);
    this.viewport.camera.position.copy(place(street.from));
    this.viewport.lookAt(place(street.to));
  }

  #connection(lost: boolean) {
    if (this.lost === lost) return;
    this.lost = lost;
    this.announce(lost ? strings.lost : strings.found);
    this.emit('connection');
  }

  /** Loads the names of the parts. */
  async #loadPartNames(file: string) {
    const parts = await fetchPalette(file).catch(() => []);
    if (file !== this.file) return;
    this.doors = new Set(parts.filter(({ opening }) => opening === 'door').map(({ code }) => code.trim()));
    this.names = new Map(parts.map(({ code, ja, romaji, en }) => [code.trim(), `${strings === translations.ja ? ja : en} · ${strings === translations.ja ? romaji : `${ja} ${romaji}`}`]));
    this.emit('select');
  }

  async #refreshFiles() {
    try {
      const { file } = this, there = (info: ServerInfo) => info.files.some(({ path }) => path === file), before = there(this.serverInfo);
      this.serverInfo = { ...await fetchServerInfo(), file: this.serverInfo.file };
      this.emit('files');
      if (file !== null && file === this.file && before && !there(this.serverInfo)) this.announce(strings.gone(file));
    } catch { /* The events say when the server is lost. */ }
  }
}

/** The location of a diagnostic; null for diagnostics of a model file. */
export function locationOfDiagnostic(message: Diagnostic, { sources }: State): SourceLocation | null {
  const source = sourceOf(message, sources);
  return source ? { id: source.id, span: [message.span.start, message.span.end] } : null;
}

/** Diagnostics of the scan beside a file. */
const faultsOf = ({ scan }: State): Diagnostic[] => (scan?.faults ?? []).map(why => ({
  code: '', severity: 'warning', message: `${scan!.file}: ${why}`, help: null, file: scan!.file, line: 0, column: 0, span: { start: 0, end: 0 }, labels: [],
}));

/** A diagnostic for a model that cannot be read, in the compiler's format. */
function invalidModel(file: string, { message }: Error): Diagnostic {
  const nowhere = { line: 0, column: 0, span: { start: 0, end: 0 }, labels: [] };
  return { code: '', severity: 'error', message: strings.unreadable(file, message), help: strings.unreadableHelp, file, ...nowhere };
}

/** Connects reflective glass to a viewport. */
function createMirrors(viewport: Viewport): Mirrors {
  const mirrors = new Mirrors(viewport.renderer, viewport.scene);
  mirrors.options.sky = viewport.environment.colours;
  mirrors.occlusion.requestFrame = () => viewport.draw();
  viewport.marks.userData['mirrored'] = false;
  viewport.onModel.push(model => mirrors.show(model));
  viewport.onRestored.push(() => mirrors.occlusion.clear());
  // A coarse frame must not mark small panes as occluded.
  viewport.paint = () => mirrors.paint(viewport.camera, !viewport.coarse);
  return mirrors;
}
