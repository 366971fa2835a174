// Operations of the page: opening and reloading a file, selection, camera and visibility. They change the state and emit
// its events.

import * as THREE from 'three';
import { buildModel, type Model } from './model/model.ts';
import { InvalidModelError, Loader } from './model/loader.ts';
import { findAgain, partsAt, traceOf } from './model/parts.ts';
import { PageRenderer } from './renderer.ts';
import { alongStreet } from './scene/opening.ts';
import { EYE_HEIGHT, frameBox, type View } from './scene/views.ts';
import type { Cursor, Diagnostic, NamedView, ServerInfo, State } from './server/api.ts';
import { fetchPalette, fetchServerInfo, fetchState, listen, openInEditor } from './server/api.ts';
import { OffsetMap } from './server/offsets.ts';
import { locationOfDiagnostic, PageState, type ReloadTimes, type SourceLocation } from './state.ts';
import { Comparison } from './town/comparison.ts';
import { Town } from './town/town.ts';
import { strings, translations } from './ui/strings.ts';
import { Walk } from './walk/walk.ts';

export class App extends PageState {
  readonly loader = new Loader();
  readonly renderer: PageRenderer;
  readonly town: Town;
  readonly comparison: Comparison;
  readonly walk: Walk;
  /** Sets the sun to a date and hour; null for the usual afternoon. */
  light: (time: { date: string; hour: number } | null) => void = () => {};
  /** Shows a location in the source pane. */
  showSource: (location: SourceLocation) => void = () => {};
  #request = 0;
  /** The newest revision that the server has announced. */
  #latestRevision = 0;
  #unsubscribe: () => void = () => {};

  constructor(canvas: HTMLCanvasElement) {
    super();
    this.renderer = new PageRenderer(canvas);
    this.town = new Town(this, this.renderer);
    this.comparison = new Comparison(this, this.renderer, this.town);
    this.walk = new Walk(this, this.renderer, this.town);
    this.town.onFirstTiles = () => this.look('above');
    const { viewport } = this.renderer;
    viewport.controls.addEventListener('change', () => { if (!this.movingToView) { this.#framed = null; this.#visits(null); } });
    // A preset view still shows all of it when the panel opens or the window turns.
    viewport.onResized.push(() => { if (this.#framed) this.look(this.#framed.view, this.#framed.part); });
    viewport.isVisible = chunk => !this.hidden.has(this.layerOf(chunk));
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
    this.renderer.viewport.show(buildModel(new THREE.Group())); // The previous file's model must not stay under the new file's name.
    this.walk.leave();
    this.town.apply(file, null);
    this.renderer.measure.clear();
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
      this.renderer.selected.set(model, again === null ? [] : [again]);
      this.renderer.pointed.set(model, this.cursor ? partsAt(model, this.cursor.id, this.cursor.span) : []);
      this.renderer.viewport.show(model);
      if (first) this.#lookFirst();
    }
    this.town.apply(this.file, now.town);
    this.renderer.viewport.frame(!first);
    this.renderer.viewport.settle();
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
      if (first) setTimeout(() => { this.renderer.viewport.frame(); this.renderer.viewport.settle(); }, 100); // Measures how long a full frame takes on this machine.
      const count = (severity: string) => now.diagnostics.filter(d => d.severity === severity).length;
      const messages = now.diagnostics.length ? ` ${strings.messages(count('error'), count('warning'))}` : '';
      const there = this.model?.chunks.length || now.town;
      this.announce((keep ? strings.kept : there ? strings.reloaded(now.revision) : strings.noModel) + messages);
    });
  }

  /** Selects a part; null clears the selection. */
  select(part: number | null) {
    this.selection = part;
    this.renderer.selected.set(this.model, part === null ? [] : [part]);
    this.emit('select');
    if (part !== null) this.announce(strings.selected + this.describe(part));
  }

  /** Highlights the parts written at a location. */
  highlight(location: SourceLocation | null) {
    const parts = this.model && location ? partsAt(this.model, location.id, location.span) : [];
    this.renderer.pointed.set(this.model, parts);
    this.emit('cursor');
  }

  /** Selects the part written at a location. */
  selectAt({ id, span }: SourceLocation) {
    const found = this.model ? partsAt(this.model, id, span) : [];
    if (found.length) this.select(found[0]!);
  }

  #setCursor(cursor: Cursor | null) {
    this.cursor = cursor;
    this.highlight(cursor);
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

  hide(layer: string, hidden: boolean) {
    if (hidden) this.hidden.add(layer); else this.hidden.delete(layer);
    this.renderer.viewport.refresh();
    this.emit('shown');
  }

  look(view: View, part: number | null = null) {
    const box = this.town.viewBox() ?? (part === null ? this.model?.box : this.model?.parts[part]?.box);
    if (!box || box.isEmpty()) return;
    this.#visits(null);
    this.movingToView = true;
    this.renderer.viewport.setFieldOfView(null);
    this.renderer.viewport.lookAt(frameBox(this.renderer.viewport.camera, box.clone(), view, this.azimuth()));
    this.movingToView = false;
    this.#framed = { view, part };
  }

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
    this.renderer.viewport.setFieldOfView(fov);
    this.renderer.viewport.camera.position.copy(place(from));
    this.renderer.viewport.lookAt(place(to));
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
    this.renderer.turntable.set(false);
    this.renderer.section.set({ on: false, axis: 'z', at: 0.5, flip: false });
    this.select(null);
    this.town.clearSelection();
    this.emit('shown');
    this.resetting = false;
    this.renderer.viewport.refresh();
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
    this.renderer.viewport.setFieldOfView(null);
    this.renderer.viewport.camera.position.copy(place(street.from));
    this.renderer.viewport.lookAt(place(street.to));
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

/** Diagnostics of the scan beside a file. */
const faultsOf = ({ scan }: State): Diagnostic[] => (scan?.faults ?? []).map(why => ({
  code: '', severity: 'warning', message: `${scan!.file}: ${why}`, help: null, file: scan!.file, line: 0, column: 0, span: { start: 0, end: 0 }, labels: [],
}));

/** A diagnostic for a model that cannot be read, in the compiler's format. */
function invalidModel(file: string, { message }: Error): Diagnostic {
  const nowhere = { line: 0, column: 0, span: { start: 0, end: 0 }, labels: [] };
  return { code: '', severity: 'error', message: strings.unreadable(file, message), help: strings.unreadableHelp, file, ...nowhere };
}
