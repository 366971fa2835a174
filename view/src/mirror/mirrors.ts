// Real-time reflections in glass by beam tracing (paper 003). Each frame finds the mirrored views that visible panes show
// (views.ts), draws them into an atlas, deepest first, and the glass samples them from there (glass.ts). Geometry outside
// all beams is not drawn.
//
// Images hold linear light in half floats; tone mapping happens once, on the canvas. Odd and even levels use separate
// atlases, since a texture cannot be read while it is drawn into.

import * as THREE from 'three';
import type { Chunk, Model } from '../model/model.ts';
import { pack, type Size } from './atlas.ts';
import { areaOf } from './geometry.ts';
import { type Entry, Glass } from './glass.ts';
import { OcclusionQueries } from './occlusion.ts';
import { BoxTree } from './box-tree.ts';
import { cameraView, type Limits, type Mirrored, mirroredViews, placeCamera, type View } from './views.ts';
import { isGlass, type Wall, findWalls } from './walls.ts';

export interface Options extends Limits {
  on: boolean;
  /** Skips walls that are occluded. */
  cullOccluded: boolean;
  /** Resolution of the images relative to the screen; 2 gives smoother edges. */
  scale: number;
  /** Largest side of an atlas, pixels. */
  side: number;
  /** Colours of what no image shows; null for the scene's background. */
  sky: Readonly<Sky> | null;
}

export interface Sky {
  zenith: THREE.Color;
  horizon: THREE.Color;
  ground: THREE.Color;
}

/** Statistics of a frame's reflections. */
export interface Stats {
  /** Views that the visible panes would show. */
  seen: number;
  /** Occluded walls. */
  hidden: number;
  /** Views drawn. */
  drawn: number;
  /** Deepest level drawn. */
  depth: number;
  calls: number;
  triangles: number;
  /** Boxes tested in the trees. */
  tested: number;
  /** Chunks submitted, over all views. */
  chunks: number;
  /** Pixels of all images. */
  pixels: number;
  /** Scale of the images. */
  scale: number;
  /** CPU time to find the beams and what they contain, milliseconds. */
  find: number;
  /** CPU time of all reflections, milliseconds; may include waiting for the GPU. */
  ms: number;
}

const NO_STATS: Stats = { seen: 0, hidden: 0, drawn: 0, depth: 0, calls: 0, triangles: 0, tested: 0, chunks: 0, pixels: 0, scale: 1, find: 0, ms: 0 };

type Camera = THREE.PerspectiveCamera | THREE.OrthographicCamera;

export class Mirrors {
  readonly options: Options = {
    on: true, cullOccluded: true, depth: 1, shift: 3, pixels: 24, views: 64, scale: 1, side: 2048, sky: null,
  };
  stats: Stats = { ...NO_STATS };
  /** The mirrored views of the last frame. */
  views: Mirrored[] = [];
  walls: Wall[] = [];
  readonly occlusion: OcclusionQueries;
  #glass = new Glass();
  #chunks = new BoxTree<Chunk>([]);
  #tree = new BoxTree<Wall>([]);
  #meshes = new Set<THREE.Object3D>();
  #atlases: THREE.WebGLRenderTarget[] = [];
  #perspective = new THREE.PerspectiveCamera();
  #orthographic = new THREE.OrthographicCamera();
  #reach = 1;
  #layers = 0;
  #renderer: THREE.WebGLRenderer;
  #scene: THREE.Scene;

  constructor(renderer: THREE.WebGLRenderer, scene: THREE.Scene) {
    this.#renderer = renderer;
    this.#scene = scene;
    this.occlusion = new OcclusionQueries(renderer);
    for (const camera of [this.#perspective, this.#orthographic]) camera.matrixAutoUpdate = camera.matrixWorldAutoUpdate = false;
  }

  /** Replaces the model. */
  show(model: Model) {
    this.occlusion.clear();
    this.walls = findWalls(model);
    this.#layers = this.walls.reduce((sum, wall) => sum + wall.layers.length, 0);
    this.#tree = new BoxTree(this.walls);
    this.#chunks = new BoxTree(model.chunks);
    this.#meshes = new Set(model.chunks.map(chunk => chunk.mesh));
    this.#reach = model.box.getSize(new THREE.Vector3()).length() * 2 + 10;
    for (const chunk of model.chunks) if (isGlass(chunk)) this.#glass.attach(chunk.mesh.material, this.#scene.environment);
  }

  /** Draws the scene with its reflections; `ask` updates the occlusion queries for the next frame. */
  paint(camera: Camera, ask = true) {
    const begun = performance.now();
    const renderer = this.#renderer, scene = this.#scene;
    this.stats = { ...NO_STATS };
    this.views = [];
    this.#setColours();
    const before: Wall[] = [], eye = this.#findViews(camera, before);
    this.stats.find = performance.now() - begun;
    if (this.views.length > 0) this.#drawImages(camera, eye);
    this.#glass.selectView(eye.children.length > 0 ? 0 : -1, this.#atlases[1]?.texture ?? null);
    this.stats.ms = performance.now() - begun;
    renderer.render(scene, camera);
    if (this.options.cullOccluded && ask) this.occlusion.query(before, camera);
  }

  dispose() {
    this.occlusion.clear();
    for (const atlas of this.#atlases) atlas.dispose();
    this.#atlases = [];
    this.#glass.dispose();
  }

  /**
   * Finds the mirrored views and their places in the atlases; adds the walls in front of the camera to `before`, occluded or
   * not.
   */
  #findViews(camera: THREE.Camera, before: Wall[]): View {
    const { options, stats } = this;
    if (camera.parent === null) camera.updateMatrixWorld();
    const eye = cameraView(camera);
    if (!options.on || this.walls.length === 0) return eye;
    const size = this.#targetSize();
    this.#tree.tested = this.#chunks.tested = 0;
    const visible = (wall: Wall, from: View) => {
      if (!options.cullOccluded || from !== eye) return true;
      before.push(wall);
      const hidden = this.occlusion.hidden(wall);
      if (hidden) stats.hidden++;
      return !hidden;
    };
    const mirrorScene = { walls: this.#tree, chunks: this.#chunks, visible };
    const { views, seen } = mirroredViews(eye, size, mirrorScene, options);
    stats.seen = seen;
    stats.tested = this.#tree.tested + this.#chunks.tested;
    const placed = this.#placeViews(views);
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

  /** Places the views in the atlases; returns the scale, or null if they do not fit. */
  #placeViews(views: Mirrored[]): number | null {
    const groups = [0, 1].map(turn => views.filter(view => view.level % 2 === turn));
    const sizes = groups.map(group => group.map(({ rect }): Size => ({ width: rect.x1 - rect.x0, height: rect.y1 - rect.y0 })));
    const { options } = this;
    const packed = pack(sizes, options.side, options.scale);
    if (!packed) return null;
    groups.forEach((group, turn) => group.forEach((view, i) => { view.place = packed.groups[turn]![i]!; }));
    const most = Math.max(...groups.map(group => group.reduce((sum, { rect }) => sum + areaOf(rect), 0))) * packed.scale ** 2;
    this.#growAtlases(packed.groups.flat().reduce((side, p) => Math.max(side, p.x + p.width, p.y + p.height), Math.sqrt(most)));
    return packed.scale;
  }

  /** Grows the atlases to at least this side; they never shrink. */
  #growAtlases(least: number) {
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

  /** Draws the images of all views, deepest first. */
  #drawImages(camera: Camera, eye: View) {
    const size = this.#targetSize(), renderer = this.#renderer, scene = this.#scene, { shadowMap, info } = renderer;
    const seeing = [eye, ...this.views].filter(view => view.children.length > 0);
    this.#fillTable(seeing);
    const all = scene.children, others = all.filter(child => !this.#meshes.has(child) && child.userData['mirrored'] !== false);
    const before = {
      target: renderer.getRenderTarget(), reset: info.autoReset, clear: renderer.autoClear, shadows: shadowMap.autoUpdate,
    };
    info.autoReset = false;
    renderer.autoClear = true;
    try {
      if (shadowMap.enabled && (shadowMap.autoUpdate || shadowMap.needsUpdate)) this.#updateShadows(camera);
      shadowMap.autoUpdate = false;
      const { calls, triangles } = info.render;
      for (const view of this.views.toReversed()) {
        const atlas = this.#atlases[view.level % 2]!, { x, y, width, height } = view.place;
        atlas.viewport.set(x, y, width, height);
        atlas.scissor.set(x, y, width, height);
        renderer.setRenderTarget(atlas);
        scene.children = [...others, ...view.chunks.map(chunk => chunk.mesh)];
        this.#glass.selectView(seeing.indexOf(view), view.children.length > 0 ? this.#atlases[(view.level + 1) % 2]!.texture : null);
        renderer.render(scene, this.#mirroredCamera(camera, view, size));
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

  /** Size of the render target, pixels. */
  #targetSize(): THREE.Vector2 {
    const target = this.#renderer.getRenderTarget();
    return target ? new THREE.Vector2(target.width, target.height) : this.#renderer.getDrawingBufferSize(new THREE.Vector2());
  }

  #mirroredCamera(camera: Camera, view: Mirrored, size: THREE.Vector2): THREE.Camera {
    const own = camera instanceof THREE.OrthographicCamera ? this.#orthographic : this.#perspective;
    own.layers.mask = camera.layers.mask;
    placeCamera(own, view, camera.projectionMatrix, size, this.#reach);
    return own;
  }

  /**
   * Updates the shadow map with the whole scene, before subsets of it are drawn: one pixel with a camera that sees nothing
   * else.
   */
  #updateShadows(camera: THREE.Camera) {
    const blind = new THREE.OrthographicCamera(0, 1e-6, 1e-6, 0, 0, 1e-6);
    blind.position.set(0, -1e6, 0);
    blind.layers.mask = camera.layers.mask;
    const atlas = this.#atlases[1]!;
    atlas.viewport.set(0, 0, 1, 1);
    atlas.scissor.set(0, 0, 1, 1);
    this.#renderer.setRenderTarget(atlas);
    this.#glass.selectView(-1, null);
    this.#renderer.render(this.#scene, blind);
  }

  /** Fills the table of the images that each view sees. */
  #fillTable(seeing: View[]) {
    const side = this.#atlases[0]!.width;
    this.#glass.beginTable(seeing.length, this.#layers);
    seeing.forEach((view, row) => {
      for (const child of view.children as Mirrored[]) {
        const entry = atlasTransform(view, child, side);
        for (const { id } of child.layers) this.#glass.set(row, id, entry);
      }
    });
    this.#glass.endTable();
  }

  /** Sets the colours that glass without an image reflects. */
  #setColours() {
    const { background } = this.#scene, { mirrorZenith, mirrorHorizon, mirrorGround } = this.#glass.uniforms;
    const plain = background instanceof THREE.Color ? background : mirrorHorizon.value;
    const { zenith, horizon, ground } = this.options.sky ?? { zenith: plain, horizon: plain, ground: plain };
    mirrorZenith.value.copy(zenith);
    mirrorHorizon.value.copy(horizon);
    mirrorGround.value.copy(ground);
  }
}

/** Transform from a pixel of a view's image to a place in the atlas. */
function atlasTransform(view: View, child: Mirrored, side: number): Entry {
  // From the pixel to the screen, then to the texture; y is never flipped.
  const drawn = view.level > 0 ? view as Mirrored : null;
  const x = drawn ? line(drawn.rect.x0, drawn.rect.x1, drawn.place.x, drawn.place.width, drawn.level) : IDENTITY;
  const y = drawn ? line(drawn.rect.y0, drawn.rect.y1, drawn.place.y, drawn.place.height, 0) : IDENTITY;
  const { rect, place, level } = child;
  const u = after(inverse(x), line(rect.x0, rect.x1, place.x, place.width, level));
  const v = after(inverse(y), line(rect.y0, rect.y1, place.y, place.height, 0));
  return [u.scale / side, u.shift / side, v.scale / side, v.shift / side];
}

interface AxisTransform { scale: number; shift: number }
const IDENTITY: AxisTransform = { scale: 1, shift: 0 };

/** Transform from a range of the screen to pixels of an atlas; flipped at odd levels. */
function line(from: number, to: number, place: number, length: number, level: number): AxisTransform {
  const scale = length / (to - from);
  return level % 2 === 1 ? { scale: -scale, shift: place + to * scale } : { scale, shift: place - from * scale };
}

const inverse = ({ scale, shift }: AxisTransform): AxisTransform => ({ scale: 1 / scale, shift: -shift / scale });
const after = (first: AxisTransform, then: AxisTransform): AxisTransform => ({ scale: then.scale * first.scale, shift: then.scale * first.shift + then.shift });
