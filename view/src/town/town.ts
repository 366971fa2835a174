// The town that is shown, if the file is one: its tiles, the feature that is selected, how far its build is. The tiles
// themselves are streamed by `tiles.ts`, which is loaded with the first town.

import * as THREE from 'three';
import { mergeGeometries } from 'three/addons/utils/BufferGeometryUtils.js';
import type { EventBus } from '../event-bus.ts';
import type { PageRenderer } from '../renderer.ts';
import { fetchFace, fetchFeature, fetchPlace, fetchSkipped, townFiles, type Decision, type EnvelopeFace, type MapPlace, type Skipped, type TownFeature, type TownProgress, type TownState } from '../server/api.ts';
import { EYE_HEIGHT } from '../scene/views.ts';
import { strings } from '../ui/strings.ts';
import { colourLeaves } from './season.ts';
import type { TownTiles } from './tiles.ts';

/** Longest side of a town that preset views show as a whole, metres: houses of a larger one would be specks. */
const FIRST_VIEW = 700;

/** Distance from which a feature is looked at, metres. */
const NEAR = 28;

/** Height of the mark of a feature on which nothing stands, metres. */
const PIN = 6;

/** Around the town its ground goes on for so far, metres. */
const AROUND = 200;

/** A selected feature: what its tile says, and its line in the table of decisions. */
export interface SelectedFeature {
  /** Null where nothing stands on it. */
  house: TownFeature | null;
  layer: string;
  key: string;
  decision: Decision | null;
  /** What binds the face of its envelope that was clicked; null elsewhere. */
  face: EnvelopeFace & { height: number } | null;
}

/** A place on the ground that was clicked: metres east and north of the town's origin, and its height above the lowest ground. */
export interface GroundPlace {
  point: THREE.Vector3;
  /** Null until it is known, and for a town of which it is not. */
  place: MapPlace | null;
}

export class Town {
  /** Null if the file is no town. */
  state: TownState | null = null;
  progress: TownProgress | null = null;
  selected: SelectedFeature | null = null;
  ground: GroundPlace | null = null;
  skipped: { total: number; list: Skipped[] } = { total: 0, list: [] };
  tiles: TownTiles | null = null;
  /** Called when other tiles are shown. */
  readonly onTiles: (() => void)[] = [];
  /** Called when the town is removed from the view. */
  readonly onClear: (() => void)[] = [];
  /** Called when the first tiles of the town are shown. */
  onFirstTiles: () => void = () => {};
  /** Tiles of the kept edition in a comparison; null without one. */
  keptTiles: () => TownTiles | null = () => null;
  #events: EventBus;
  #renderer: PageRenderer;
  /** The tiles that are about to take the place of the shown ones. */
  #next: TownTiles | null = null;
  #root = '';
  #day = { month: 7, day: 1 };
  #file: string | null = null;
  #box: THREE.Box3 | null = null;
  #timer = 0;

  constructor(events: EventBus, renderer: PageRenderer) {
    this.#events = events;
    this.#renderer = renderer;
    const { viewport } = renderer;
    renderer.tileMeshes = () => this.tiles?.meshes() ?? null;
    viewport.beforeFrame.push(() => { this.tiles?.update(); this.#next?.update(); });
    viewport.controls.addEventListener('change', () => this.#later());
  }

  /** True while it is being built or loaded. */
  get busy(): boolean { return this.progress !== null || this.#next !== null || (this.tiles?.busy ?? this.#root !== ''); }

  /** The bounds of the town. */
  get box(): THREE.Box3 | null { return this.tiles && !this.tiles.box.isEmpty() ? this.tiles.box : null; }

  /** Takes over a state of the open file. */
  apply(file: string | null, state: TownState | null) {
    if (file !== this.#file) this.#clear();
    this.#file = file;
    this.state = state;
    if (!state) this.#clear();
    const root = state?.tileset ? townFiles(state.id) + state.tileset : '';
    if (root && root !== this.#root) void this.#load(root);
    this.#root = root;
    if (state) void import('./tiles.ts'); // While the first tiles are built.
    if (state) void this.#loadSkipped(state);
    const { selected } = this;
    if (state && selected) void this.choose(selected.layer, selected.key);
    document.body.classList.toggle('town', state !== null);
    this.#events.emit('town');
  }

  /** Hears how far the build is. */
  hear(progress: TownProgress) {
    const before = this.progress?.phase;
    this.progress = progress.phase === 'done' ? null : progress;
    if (progress.phase !== before) this.#events.announce(strings.townPhase[progress.phase]);
    this.#events.emit('town');
  }

  #clear() {
    for (const then of this.onClear) then();
    this.tiles?.dispose();
    this.#next?.dispose();
    this.tiles = this.#next = this.#box = null;
    this.#root = '';
    this.progress = this.selected = this.ground = null;
    this.skipped = { total: 0, list: [] };
    this.#renderer.viewport.extent = null;
    this.#mark();
  }

  async #load(root: string) {
    const { viewport } = this.#renderer, { TownTiles } = await import('./tiles.ts');
    if (root !== this.#root) return;
    this.#next?.dispose();
    const tiles = this.#next = new TownTiles(root, viewport.camera, viewport.renderer, material => this.look(material));
    tiles.onChange = () => { this.#change(); viewport.draw(); };
    tiles.onTiles = () => { for (const then of this.onTiles) then(); this.#later(); };
    tiles.onError = message => this.#events.announce(strings.failed + message);
    tiles.onRoot = () => { if (!this.tiles) this.#change(true); };
    viewport.draw();
  }

  /** Gives a material of a tile the look that it has here. */
  look(material: THREE.Material) {
    this.#renderer.viewport.dim(material);
    colourLeaves(material, this.#day);
  }

  /** Shows the trees as they are on a day. */
  turn(day: { month: number; day: number }) {
    this.#day = day;
    for (const tiles of [this.tiles, this.#next, this.keptTiles()]) for (const material of tiles?.materials() ?? []) colourLeaves(material, day);
  }

  /** Shows the next tiles once they are all there, so that the ones before do not vanish first. */
  #change(now = false) {
    const { viewport } = this.#renderer, next = this.#next;
    if (!next || !now && next.busy) return;
    if (next.box.isEmpty()) return this.#drop(next);
    const first = !this.tiles;
    this.tiles?.dispose();
    this.tiles = next;
    this.#next = null;
    viewport.scene.add(next.group);
    viewport.showExtent(next.box);
    if (first) this.onFirstTiles();
    this.#events.emit('town');
    this.#later();
  }

  /** Gives up tiles whose root cannot be loaded; the ones before stay, and the next state asks again. */
  #drop(next: TownTiles) {
    next.dispose();
    this.#next = null;
    this.#root = '';
    this.#events.emit('town');
  }

  /** What preset views show: the town, or the part in the middle of a large one. */
  viewBox(): THREE.Box3 | null {
    const { box } = this, part = this.tiles?.middle;
    if (!box || !part || part.isEmpty()) return box;
    const size = box.getSize(new THREE.Vector3());
    return Math.max(size.x, size.z) > FIRST_VIEW ? part : box;
  }

  /** When the picture has come to rest: shadows and the mark of the selected feature follow it. */
  #later() {
    if (!this.tiles) return;
    clearTimeout(this.#timer);
    this.#timer = window.setTimeout(() => {
      const { viewport } = this.#renderer;
      if (!this.tiles) return;
      const far = viewport.camera.position.distanceTo(viewport.controls.target);
      viewport.environment.shade(viewport.controls.target, THREE.MathUtils.clamp(far * 1.3, 40, 500));
      this.#mark();
      viewport.updateShadows();
    }, 250);
  }

  /** Marks the selected feature in the tiles that are shown. */
  #mark() {
    const { selected, tiles } = this;
    const found = selected && tiles ? tiles.shapeOf(selected.layer, selected.key) : null;
    const place = selected && !found ? placeOf(selected.decision, 'x', 'y') : null;
    this.#renderer.selected.show(found ? [found.shape] : place ? [pin(place)] : this.ground ? [pin(this.ground.point, 1)] : []);
    this.#box = found?.shape.boundingBox ?? this.#box;
    if (found && selected && !selected.house) {
      selected.house = found.feature;
      this.#events.emit('town');
    }
  }

  /** Selects what is drawn at a ray. */
  pick(ray: THREE.Raycaster) {
    const found = this.tiles?.hit(ray);
    if (found?.feature) return void this.choose(found.feature.layer, found.feature.key, found.feature, found.point);
    this.clearSelection();
    const point = found?.point ?? this.surfaceAt(ray);
    if (point && this.box?.clone().expandByScalar(AROUND).containsPoint(point)) void this.#choosePlace(point);
  }

  /** Chooses a place on the ground, which is then told in the system of the map. */
  async #choosePlace(point: THREE.Vector3) {
    const { state } = this, ground: GroundPlace = { point, place: null };
    if (!state) return;
    this.ground = ground;
    this.#mark();
    this.#events.emit('town');
    ground.place = await fetchPlace(state.id, point.x, -point.z).catch(() => null);
    if (this.ground !== ground) return;
    this.#events.emit('town');
    this.#events.announce(placeText(ground));
  }

  /** The point of a house, or else of the ground, that a ray meets first. */
  surfaceAt(ray: THREE.Raycaster): THREE.Vector3 | null {
    const { level } = this.#renderer.viewport.environment, ground = new THREE.Plane(new THREE.Vector3(0, 1, 0), -level);
    return this.tiles?.pointAt(ray) ?? ray.ray.intersectPlane(ground, new THREE.Vector3());
  }

  clearSelection() {
    this.selected = this.ground = this.#box = null;
    this.#mark();
    this.#events.emit('town');
  }

  /** Selects a feature, or the face of its envelope at a place; returns false if there is none. */
  async choose(layer: string, key: string, house: TownFeature | null = null, at: THREE.Vector3 | null = null): Promise<boolean> {
    const { state } = this;
    if (!state) return false;
    const [decision, face] = await Promise.all([
      fetchFeature(state.id, layer, key).catch(() => null),
      at && fetchFace(state.id, layer, key, [at.x, -at.z, at.y]).catch(() => null)]);
    if (this.state?.id !== state.id || !decision && !house) return false;
    const own = decision?.['layer'] ?? layer;
    this.#box = this.ground = null;
    this.selected = { house, layer: own, key, decision, face: face && at && { ...face, height: at.y } };
    this.#mark();
    this.#events.emit('town');
    this.#events.announce(strings.selected + this.title());
    return true;
  }

  /** What the selected feature is called. */
  title(): string {
    const { selected } = this;
    if (!selected) return '';
    const type = selected.house?.type || selected.decision?.['type'];
    return [`${selected.layer} ${selected.key}`, type].filter(Boolean).join(strings.comma);
  }

  /** Selects a feature and looks at it; returns false if there is none. */
  async goTo(layer: string, key: string): Promise<boolean> {
    const found = await this.choose(layer, key);
    if (found) this.lookAtSelected();
    return found;
  }

  /** Looks at the selected feature from above. */
  lookAtSelected() {
    const decision = this.selected?.decision, { viewport } = this.#renderer;
    const target = this.#box?.getCenter(new THREE.Vector3()) ?? placeOf(decision, 'x', 'y');
    if (!target) return;
    const far = Math.max(NEAR, (this.#box?.getSize(new THREE.Vector3()).length() ?? 0) * 1.6);
    viewport.camera.position.copy(target).add(new THREE.Vector3(0.5, 0.6, 0.8).normalize().multiplyScalar(far));
    viewport.lookAt(target);
  }

  /** Stands on the street before the front of the selected feature; false if it has none. */
  standBefore(): boolean {
    const decision = this.selected?.decision, { viewport } = this.#renderer;
    const one = placeOf(decision, 'front_x1', 'front_y1'), two = placeOf(decision, 'front_x2', 'front_y2');
    if (!one || !two || !decision?.['facing']) return false;
    const azimuth = Number(decision['facing']) * Math.PI / 180, ground = this.#box?.min.y ?? 0;
    const target = one.add(two).multiplyScalar(0.5), away = Math.max(7, one.distanceTo(two) * 1.2);
    target.y = ground + EYE_HEIGHT + 0.9;
    viewport.camera.position.set(target.x + Math.sin(azimuth) * away, ground + EYE_HEIGHT, target.z - Math.cos(azimuth) * away);
    viewport.lookAt(target);
    return true;
  }

  async #loadSkipped(state: TownState) {
    const skipped = state.skipped > 0 ? await fetchSkipped(state.id).catch(() => null) : { total: 0, list: [] };
    if (!skipped || this.state !== state) return;
    this.skipped = skipped;
    this.#events.emit('town');
  }
}

/** What is said of a place on the ground. */
export function placeText({ point, place }: GroundPlace): string {
  const metres = (n: number) => n.toFixed(2), degrees = place?.degrees?.map(n => n.toFixed(6)).reverse();
  const [east, north] = place?.at ?? [point.x, -point.z];
  return [strings.groundAt(metres(east), metres(north), place?.crs ?? strings.townOrigin), degrees && strings.degreesAt(degrees[0]!, degrees[1]!), strings.groundHeight(metres(point.y))]
    .filter(Boolean).join(strings.comma);
}

/** A mark where nothing stands: a post in a ring, of some size. */
function pin(place: THREE.Vector3, height = PIN): THREE.BufferGeometry {
  const post = new THREE.CylinderGeometry(height / 30, height / 30, height, 8).translate(place.x, place.y + height / 2, place.z);
  const ring = new THREE.TorusGeometry(height * 0.27, height / 50, 6, 24).rotateX(Math.PI / 2).translate(place.x, place.y + 0.15, place.z);
  return mergeGeometries([post, ring]);
}

/** A place of the table of decisions in the page's frame. */
function placeOf(decision: Decision | null | undefined, x: string, y: string): THREE.Vector3 | null {
  if (!decision?.[x] || !decision[y]) return null;
  return new THREE.Vector3(Number(decision[x]), 0, -Number(decision[y]));
}
