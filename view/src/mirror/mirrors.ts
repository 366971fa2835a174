// Glass that mirrors its neighbours in real time (paper 003: beam tracing). Each frame the views which panes show are
// worked out (views.ts), their pictures are drawn into an atlas, the deepest first, and the glass takes them from there
// (glass.ts). What lies in no beam is not drawn.
//
// Pictures keep linear light in half floats: tones are mapped once, when the canvas is drawn. Levels take turns in two
// atlases, since a picture cannot be read while its texture is drawn into.

import * as THREE from 'three';
import type { Chunk, Model } from '../model.ts';
import { pack, type Size } from './atlas.ts';
import { area_of } from './geometry.ts';
import { type Entry, Glass } from './glass.ts';
import { Probes } from './probes.ts';
import { Tree } from './tree.ts';
import { eye_view, type Limits, type Mirrored, mirrored_views, stand, type View } from './views.ts';
import { is_glass, type Wall, walls_of } from './walls.ts';

export interface Options extends Limits {
  on: boolean;
  /** Whether walls are left out that are hidden behind other things. */
  probe: boolean;
  /** Size of pictures to that of their panes on the screen; 2 = two pixels each way, so smoother edges. */
  scale: number;
  /** Side of an atlas at most. */
  side: number;
  /** Colours of what no picture shows; null = the scene's background. */
  sky: Readonly<Sky> | null;
}

export interface Sky {
  zenith: THREE.Color;
  horizon: THREE.Color;
  ground: THREE.Color;
}

/** What a frame's mirrors were and cost. */
export interface Stats {
  /** Views that panes in sight would show. */
  seen: number;
  /** Walls that are hidden behind other things. */
  hidden: number;
  /** Those that were drawn. */
  drawn: number;
  /** The deepest level that was drawn. */
  depth: number;
  calls: number;
  triangles: number;
  /** Boxes of the trees that were looked at. */
  tested: number;
  /** Chunks handed to the card, in all views together. */
  chunks: number;
  /** Pixels of all pictures. */
  pixels: number;
  /** The scale they were drawn at. */
  scale: number;
  /** The processor's time to find the beams and what lies in them, milliseconds. */
  find: number;
  /** Its time for all of the mirrors; some of it may be the card's that it waits for. */
  ms: number;
}

const NO_STATS: Stats = { seen: 0, hidden: 0, drawn: 0, depth: 0, calls: 0, triangles: 0, tested: 0, chunks: 0, pixels: 0, scale: 1, find: 0, ms: 0 };

type Camera = THREE.PerspectiveCamera | THREE.OrthographicCamera;

export class Mirrors {
  readonly options: Options = {
    on: true, probe: true, depth: 1, shift: 3, pixels: 24, views: 64, scale: 1, side: 2048, sky: null,
  };
  stats: Stats = { ...NO_STATS };
  /** The mirrored views of the last frame. */
  views: Mirrored[] = [];
  walls: Wall[] = [];
  readonly probes: Probes;
  #glass = new Glass();
  #chunks = new Tree<Chunk>([]);
  #tree = new Tree<Wall>([]);
  #meshes = new Set<THREE.Object3D>();
  #atlases: THREE.WebGLRenderTarget[] = [];
  #eye = new THREE.PerspectiveCamera();
  #parallel = new THREE.OrthographicCamera();
  #reach = 1;
  #layers = 0;
  #renderer: THREE.WebGLRenderer;
  #scene: THREE.Scene;

  constructor(renderer: THREE.WebGLRenderer, scene: THREE.Scene) {
    this.#renderer = renderer;
    this.#scene = scene;
    this.probes = new Probes(renderer);
    for (const camera of [this.#eye, this.#parallel]) camera.matrixAutoUpdate = camera.matrixWorldAutoUpdate = false;
  }

  /** Takes the place of what was shown before. */
  show(model: Model) {
    this.probes.clear();
    this.walls = walls_of(model);
    this.#layers = this.walls.reduce((sum, wall) => sum + wall.layers.length, 0);
    this.#tree = new Tree(this.walls);
    this.#chunks = new Tree(model.chunks);
    this.#meshes = new Set(model.chunks.map(chunk => chunk.mesh));
    this.#reach = model.box.getSize(new THREE.Vector3()).length() * 2 + 10;
    for (const chunk of model.chunks) if (is_glass(chunk)) this.#glass.dress(chunk.mesh.material);
  }

  /** Draws the scene with what its glass mirrors; `ask` = walls that are hidden now may be left out next time. */
  paint(camera: Camera, ask = true) {
    const begun = performance.now();
    const renderer = this.#renderer, scene = this.#scene;
    this.stats = { ...NO_STATS };
    this.views = [];
    this.#colours();
    const before: Wall[] = [], eye = this.#look(camera, before);
    this.stats.find = performance.now() - begun;
    if (this.views.length > 0) this.#pictures(camera, eye);
    this.#glass.view(eye.children.length > 0 ? 0 : -1, this.#atlases[1]?.texture ?? null);
    this.stats.ms = performance.now() - begun;
    renderer.render(scene, camera);
    if (this.options.probe && ask) this.probes.ask(before, camera);
  }

  dispose() {
    this.probes.clear();
    for (const atlas of this.#atlases) atlas.dispose();
    this.#atlases = [];
    this.#glass.dispose();
  }

  /** Works out what is mirrored, and where it is drawn; adds the walls that would be seen if nothing stood before them. */
  #look(camera: THREE.Camera, before: Wall[]): View {
    const { options, stats } = this;
    if (camera.parent === null) camera.updateMatrixWorld();
    const eye = eye_view(camera);
    if (!options.on || this.walls.length === 0) return eye;
    const size = this.#size();
    this.#tree.tested = this.#chunks.tested = 0;
    const visible = (wall: Wall, from: View) => {
      if (!options.probe || from !== eye) return true;
      before.push(wall);
      const hidden = this.probes.hidden(wall);
      if (hidden) stats.hidden++;
      return !hidden;
    };
    const town = { walls: this.#tree, chunks: this.#chunks, visible };
    const { views, seen } = mirrored_views(eye, size, town, options);
    stats.seen = seen;
    stats.tested = this.#tree.tested + this.#chunks.tested;
    const placed = this.#place(views);
    if (!placed) {
      eye.children = [];
      return eye;
    }
    this.views = views;
    stats.drawn = views.length;
    stats.depth = Math.max(0, ...views.map(view => view.level));
    stats.scale = placed;
    stats.pixels = views.reduce((sum, { place }) => sum + place.width * place.height, 0);
    return eye;
  }

  /** Gives views their places in the atlases, and the glass the table of them; the scale, or null where there is no room. */
  #place(views: Mirrored[]): number | null {
    const groups = [0, 1].map(turn => views.filter(view => view.level % 2 === turn));
    const sizes = groups.map(group => group.map(({ rect }): Size => ({ width: rect.x1 - rect.x0, height: rect.y1 - rect.y0 })));
    const { options } = this;
    const packed = pack(sizes, options.side, options.scale);
    if (!packed) return null;
    groups.forEach((group, turn) => group.forEach((view, i) => { view.place = packed.groups[turn]![i]!; }));
    const most = Math.max(...groups.map(group => group.reduce((sum, { rect }) => sum + area_of(rect), 0))) * packed.scale ** 2;
    this.#atlas_side(packed.groups.flat().reduce((side, p) => Math.max(side, p.x + p.width, p.y + p.height), Math.sqrt(most)));
    return packed.scale;
  }

  /** Makes the atlases at least so large; they do not shrink. */
  #atlas_side(least: number) {
    const is = this.#atlases[0]?.width ?? 0;
    if (is >= least) return;
    const side = Math.min(this.options.side, 2 ** Math.ceil(Math.log2(Math.max(256, least))));
    for (const atlas of this.#atlases) atlas.dispose();
    this.#atlases = [0, 1].map(() => {
      const atlas = new THREE.WebGLRenderTarget(side, side, { type: THREE.HalfFloatType, generateMipmaps: false });
      atlas.scissorTest = true;
      return atlas;
    });
  }

  /** Draws the pictures of all views, the deepest first. */
  #pictures(camera: Camera, eye: View) {
    const size = this.#size(), renderer = this.#renderer, scene = this.#scene, { shadowMap, info } = renderer;
    const seeing = [eye, ...this.views].filter(view => view.children.length > 0);
    this.#table(seeing);
    const all = scene.children, others = all.filter(child => !this.#meshes.has(child) && child.userData['mirrored'] !== false);
    const before = {
      target: renderer.getRenderTarget(), reset: info.autoReset, clear: renderer.autoClear, shadows: shadowMap.autoUpdate,
    };
    info.autoReset = false;
    renderer.autoClear = true;
    try {
      if (shadowMap.enabled && (shadowMap.autoUpdate || shadowMap.needsUpdate)) this.#shadows(camera);
      shadowMap.autoUpdate = false;
      const { calls, triangles } = info.render;
      for (const view of this.views.toReversed()) {
        const atlas = this.#atlases[view.level % 2]!, { x, y, width, height } = view.place;
        atlas.viewport.set(x, y, width, height);
        atlas.scissor.set(x, y, width, height);
        renderer.setRenderTarget(atlas);
        scene.children = [...others, ...view.chunks.map(chunk => chunk.mesh)];
        this.#glass.view(seeing.indexOf(view), view.children.length > 0 ? this.#atlases[(view.level + 1) % 2]!.texture : null);
        renderer.render(scene, this.#stood(camera, view, size));
        this.stats.chunks += view.chunks.length;
      }
      this.stats.calls = info.render.calls - calls;
      this.stats.triangles = info.render.triangles - triangles;
    } finally {
      scene.children = all;
      info.autoReset = before.reset;
      renderer.autoClear = before.clear;
      shadowMap.autoUpdate = before.shadows;
      renderer.setRenderTarget(before.target);
    }
  }

  /** Pixels of what is drawn into. */
  #size(): THREE.Vector2 {
    const target = this.#renderer.getRenderTarget();
    return target ? new THREE.Vector2(target.width, target.height) : this.#renderer.getDrawingBufferSize(new THREE.Vector2());
  }

  #stood(camera: Camera, view: Mirrored, size: THREE.Vector2): THREE.Camera {
    const own = camera instanceof THREE.OrthographicCamera ? this.#parallel : this.#eye;
    own.layers.mask = camera.layers.mask;
    stand(own, view, camera.projectionMatrix, size, this.#reach);
    return own;
  }

  /** Shadows of the whole scene, before parts of it are drawn: into a pixel, seen by an eye that sees nothing else. */
  #shadows(camera: THREE.Camera) {
    const blind = new THREE.OrthographicCamera(0, 1e-6, 1e-6, 0, 0, 1e-6);
    blind.position.set(0, -1e6, 0);
    blind.layers.mask = camera.layers.mask;
    const atlas = this.#atlases[1]!;
    atlas.viewport.set(0, 0, 1, 1);
    atlas.scissor.set(0, 0, 1, 1);
    this.#renderer.setRenderTarget(atlas);
    this.#glass.view(-1, null);
    this.#renderer.render(this.#scene, blind);
  }

  /** Where each view that sees mirrors finds them. */
  #table(seeing: View[]) {
    const side = this.#atlases[0]!.width;
    this.#glass.begin(seeing.length, this.#layers);
    seeing.forEach((view, row) => {
      for (const child of view.children as Mirrored[]) {
        const entry = place_on(view, child, side);
        for (const { id } of child.layers) this.#glass.set(row, id, entry);
      }
    });
    this.#glass.end();
  }

  /** What glass without a picture mirrors. */
  #colours() {
    const { background } = this.#scene, { mirrorZenith, mirrorHorizon, mirrorGround } = this.#glass.uniforms;
    const plain = background instanceof THREE.Color ? background : mirrorHorizon.value;
    const { zenith, horizon, ground } = this.options.sky ?? { zenith: plain, horizon: plain, ground: plain };
    mirrorZenith.value.copy(zenith);
    mirrorHorizon.value.copy(horizon);
    mirrorGround.value.copy(ground);
  }
}

/** How a pixel that a view is drawn at becomes a place in the atlas. */
function place_on(view: View, child: Mirrored, side: number): Entry {
  // The screen's x from the pixel's, then the texture's from the screen's; y alike, but never flipped.
  const drawn = view.level > 0 ? view as Mirrored : null;
  const x = drawn ? line(drawn.rect.x0, drawn.rect.x1, drawn.place.x, drawn.place.width, drawn.level) : IDENTITY;
  const y = drawn ? line(drawn.rect.y0, drawn.rect.y1, drawn.place.y, drawn.place.height, 0) : IDENTITY;
  const { rect, place, level } = child;
  const u = after(inverse(x), line(rect.x0, rect.x1, place.x, place.width, level));
  const v = after(inverse(y), line(rect.y0, rect.y1, place.y, place.height, 0));
  return [u.scale / side, u.shift / side, v.scale / side, v.shift / side];
}

interface Line { scale: number; shift: number }
const IDENTITY: Line = { scale: 1, shift: 0 };

/** From the screen between two places to pixels of an atlas; flipped at odd levels. */
function line(from: number, to: number, place: number, length: number, level: number): Line {
  const scale = length / (to - from);
  return level % 2 === 1 ? { scale: -scale, shift: place + to * scale } : { scale, shift: place - from * scale };
}

const inverse = ({ scale, shift }: Line): Line => ({ scale: 1 / scale, shift: -shift / scale });
const after = (first: Line, then: Line): Line => ({ scale: then.scale * first.scale, shift: then.scale * first.shift + then.shift });
