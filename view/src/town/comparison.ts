// Two editions of a town in one view: the one that was kept to the left of a line, the one that is built now to its right. So
// hypotheses and years are compared: keep the town, then set other parameters.

import type { PageRenderer } from '../renderer.ts';
import { fetchDifference, keepTown, townFiles, type Difference } from '../server/api.ts';
import type { PageState } from '../state.ts';
import { strings } from '../ui/strings.ts';
import type { TownTiles } from './tiles.ts';
import type { Town } from './town.ts';

export class Comparison {
  /** Null if nothing is kept. */
  kept: { tiles: TownTiles; label: string } | null = null;
  /** Null until it is known. */
  difference: Difference | null = null;
  #state: PageState;
  #renderer: PageRenderer;
  #town: Town;
  /** The share of the view to the left of the line. */
  #at = 0.5;
  #told = '';

  constructor(state: PageState, renderer: PageRenderer, town: Town) {
    this.#state = state;
    this.#renderer = renderer;
    this.#town = town;
    town.onClear.push(() => this.clear());
    town.keptTiles = () => this.kept?.tiles ?? null;
    renderer.viewport.beforeFrame.push(() => this.kept?.tiles.update());
    state.on('town', () => void this.#tell());
  }

  get at() { return this.#at; }
  set at(share: number) {
    this.#at = Math.min(1, Math.max(0, share));
    const { split } = this.#renderer.viewport;
    if (split) split.at = this.#at;
    this.#renderer.viewport.draw();
  }

  /** The parameters that differ from the text's, in words. */
  label(): string {
    const set = (this.#state.state?.parameters ?? []).filter(({ value, default: usual }) => value !== usual);
    return set.map(({ name, value }) => `${name} = ${value}`).join(strings.comma) || strings.usualValues;
  }

  /** Keeps the town as it is now. */
  async keep() {
    const { viewport } = this.#renderer, { state } = this.#town;
    if (!state?.tileset) return;
    const label = this.label(), { TownTiles } = await import('./tiles.ts');
    await keepTown(state.id, true);
    this.#drop();
    const tiles = new TownTiles(townFiles(state.id) + state.tileset, viewport.camera, viewport.renderer, material => this.#town.look(material));
    tiles.onChange = () => viewport.draw();
    tiles.onTiles = () => viewport.updateShadows();
    tiles.onError = message => this.#state.announce(strings.failed + message);
    viewport.scene.add(tiles.group);
    this.kept = { tiles, label };
    viewport.split = { at: this.#at, show: left => this.#show(left) };
    this.#told = '';
    viewport.draw();
    this.#state.announce(strings.townKept(label));
    this.#state.emit('town');
  }

  /** Ends the comparison. */
  async end() {
    const { state } = this.#town;
    this.clear();
    if (state) await keepTown(state.id, false);
  }

  /** Forgets what was kept, as where another file is shown. */
  clear() {
    if (!this.kept) return;
    this.#drop();
    this.#state.emit('town');
  }

  #drop() {
    this.kept?.tiles.dispose();
    this.kept = this.difference = this.#renderer.viewport.split = null;
    const { tiles } = this.#town;
    if (tiles) tiles.group.visible = true;
    this.#renderer.viewport.updateShadows();
  }

  #show(left: boolean) {
    const { tiles } = this.#town;
    if (this.kept) this.kept.tiles.group.visible = left;
    if (tiles) tiles.group.visible = !left;
  }

  /** Asks what differs, once for each edition. */
  async #tell() {
    const { state, busy } = this.#town, edition = `${state?.id} ${state?.tileset} ${state?.whole}`;
    if (!this.kept || !state?.tileset || busy || edition === this.#told) return;
    this.#told = edition;
    const difference = await fetchDifference(state.id).catch(() => null);
    if (!this.kept || this.#told !== edition) return;
    this.difference = difference;
    this.#state.emit('town');
  }
}
