// The stage that a model stands on: light, sky, ground, camera. It is drawn anew when something has changed, and only
// then; its shadows are drawn anew when the model, what is shown of it, or the sun has changed.

import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { Draft } from './draft.ts';
import type { Chunk, Model } from './model.ts';
import { Surroundings } from './surroundings.ts';

/** What the last frame took. */
export interface FrameStats {
  calls: number;
  triangles: number;
  /** From the first call to the last, milliseconds. */
  ms: number;
  frames: number;
}

/** Degrees from the foot of the picture to its top. */
const FOV = 36;

/** How far above the ground the eye stays, metres. */
const LOW = 0.3;

/** Metal has nothing but the sun to mirror on this stage, and would be black: so much of it stays metal. */
const METAL = 0.3;

/** A machine that takes longer for a frame is slow, milliseconds. */
const SLOW = 40;

export class Stage {
  readonly renderer: THREE.WebGLRenderer;
  readonly scene = new THREE.Scene();
  readonly camera = new THREE.PerspectiveCamera(FOV, 1, 0.05, 2000);
  readonly controls: OrbitControls;
  readonly surroundings: Surroundings;
  get sun() { return this.surroundings.sun; }
  /** Marks over the model; no part of it, so never picked. */
  readonly marks = new THREE.Group();
  model: Model | null = null;
  readonly stats: FrameStats = { calls: 0, triangles: 0, ms: 0, frames: 0 };
  /** Whether a chunk is shown. */
  shown: (chunk: Chunk) => boolean = () => true;
  /** Called with each new model before it is drawn. */
  readonly on_model: ((model: Model) => void)[] = [];
  /** Called when the graphics card was lost and is there again. */
  readonly on_restored: (() => void)[] = [];
  /** Called after each frame. */
  readonly on_frame: (() => void)[] = [];
  /** Draws a frame; those who add to it put their own in its place. */
  paint = () => this.renderer.render(this.scene, this.camera);
  /** What all of a frame took when it was last waited for, milliseconds. */
  pace = 0;
  /** Whether the last frame was drawn with few pixels. */
  coarse = false;
  /** Whether all of the last frame was waited for. */
  #waited = false;
  #wanted = false;
  #draft: Draft;
  #sharpen = 0;
  #shade_later = false;
  #after: (() => void)[] = [];
  #spent: THREE.Material[] = [];
  #dulled = new WeakSet<THREE.Material>();

  constructor(canvas: HTMLCanvasElement) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    this.renderer.toneMapping = THREE.ACESFilmicToneMapping;
    this.renderer.localClippingEnabled = true;
    this.renderer.info.autoReset = false;
    const { shadowMap } = this.renderer;
    shadowMap.enabled = true;
    shadowMap.type = THREE.PCFShadowMap;
    shadowMap.autoUpdate = false;
    this.#draft = new Draft(this.renderer);
    this.surroundings = new Surroundings();
    this.scene.add(this.surroundings.group, this.marks);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('change', () => { this.#stay_above(); this.draw(); });
    canvas.addEventListener('webglcontextrestored', () => {
      for (const then of this.on_restored) then();
      this.shade();
    });
    new ResizeObserver(() => this.#fit()).observe(canvas);
    this.#fit();
  }

  get canvas() { return this.renderer.domElement; }

  /** Puts a model in the place of the one before; the camera stays, and so do meshes that both have. */
  show(model: Model) {
    const before = new Set(this.model?.chunks.map(chunk => chunk.mesh)), now = new Set(model.chunks.map(chunk => chunk.mesh));
    const used = new Set(model.chunks.map(chunk => chunk.mesh.material)), spent = new Set<THREE.Material>();
    for (const mesh of before) {
      if (now.has(mesh)) continue;
      this.scene.remove(mesh);
      mesh.geometry.dispose();
      if (!used.has(mesh.material)) spent.add(mesh.material);
    }
    for (const material of used) {
      if (this.#dulled.has(material) || !('metalness' in material)) continue; // kept from the model before, or of another kind
      this.#dulled.add(material);
      material.metalness *= METAL;
    }
    this.#spent.push(...spent); // until the next ones are drawn: their programs are the same
    this.model = model;
    for (const mesh of now) if (!before.has(mesh)) this.scene.add(mesh);
    this.surroundings.fit(model.box);
    const size = this.size();
    this.camera.near = Math.max(0.02, size / 2000);
    this.camera.far = Math.max(400, size * 40);
    this.camera.updateProjectionMatrix();
    for (const then of this.on_model) then(model);
    this.refresh();
  }

  /** Lifts the eye above the ground with what it looks at, and lets the controls turn it down as far and no further. */
  #stay_above() {
    const { controls, camera: { position }, model } = this, { target } = controls;
    const low = Math.min(0, model?.box.min.y ?? 0) + LOW, rise = Math.max(0, low - position.y);
    position.y += rise;
    target.y += rise;
    controls.maxPolarAngle = Math.acos(THREE.MathUtils.clamp((low - target.y) / position.distanceTo(target), -1, 1));
  }

  /** Turns the camera to a place, from where it stands. */
  look_at(target: THREE.Vector3) {
    this.controls.target.copy(target);
    this.#stay_above();
    this.controls.update();
    this.draw();
  }

  /** Hides and shows chunks anew. */
  refresh() {
    for (const chunk of this.model?.chunks ?? []) chunk.mesh.visible = this.shown(chunk);
    this.shade();
  }

  /** Asks for new shadows. */
  shade() {
    this.renderer.shadowMap.needsUpdate = true;
    this.draw();
  }

  /** Diagonal of the model, metres. */
  size(): number {
    return this.model?.box.getSize(new THREE.Vector3()).length() || 10;
  }

  /** Asks for a frame; `after` is called when it has been drawn. */
  draw(after?: () => void) {
    if (after) this.#after.push(after);
    if (this.#wanted) return;
    this.#wanted = true;
    requestAnimationFrame(() => this.frame(true));
  }

  /**
   * Draws a frame at once. Where the machine is slow and things are about to change again (`quick`), it is drawn with few
   * pixels and with the shadows there were, and again in full as soon as there is time.
   */
  frame(quick = false) {
    this.#wanted = false;
    const { shadowMap } = this.renderer;
    clearTimeout(this.#sharpen);
    this.#shade_later ||= shadowMap.needsUpdate;
    const coarse = this.coarse = quick && this.pace > SLOW;
    if (coarse) this.#sharpen = window.setTimeout(() => this.frame(), 140);
    shadowMap.needsUpdate = this.#shade_later && !coarse;
    this.#shade_later &&= coarse;
    const begun = performance.now(), { info } = this.renderer, { stats } = this;
    this.#waited = false;
    info.reset();
    if (coarse) this.#draft.begin(SLOW / this.pace);
    try {
      this.paint();
      stats.calls = info.render.calls;
      stats.triangles = info.render.triangles;
    } finally {
      if (coarse) this.#draft.end();
    }
    stats.ms = performance.now() - begun;
    stats.frames++;
    for (const material of this.#spent.splice(0)) release(material);
    for (const then of this.#after.splice(0)) then();
    for (const then of this.on_frame) then();
  }

  /** Waits until all that was asked for is drawn. */
  settle() {
    const begun = performance.now() - this.stats.ms;
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    if (!this.coarse && !this.#waited) this.pace = performance.now() - begun;
    this.#waited = true;
  }

  #fit() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    // A narrow window sees as far to the sides as one of 4 to 3.
    const half = Math.tan(FOV / 2 * Math.PI / 180) * Math.max(1, 4 / 3 / this.camera.aspect);
    this.camera.fov = Math.min(80, Math.atan(half) * 360 / Math.PI);
    this.camera.updateProjectionMatrix();
    this.frame(); // at once, since the canvas has just been cleared
  }
}

/** Gives back what a material takes of the graphics card, but for pictures that the loader keeps for the next model. */
function release(material: THREE.Material) {
  for (const value of Object.values(material)) {
    if (!(value instanceof THREE.Texture) || value.userData['kept']) continue;
    value.dispose();
    if (value.source.data instanceof ImageBitmap) value.source.data.close();
  }
  material.dispose();
}
