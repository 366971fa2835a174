// The stage that a model stands on: light, sky, ground, camera. It is drawn anew when something has changed, and only
// then; its shadows are drawn anew when the model, what is shown of it, or the sun has changed.

import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
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
  /** Called after each frame. */
  readonly on_frame: (() => void)[] = [];
  /** Draws a frame; those who add to it put their own in its place. */
  paint = () => this.renderer.render(this.scene, this.camera);
  /** What all of a frame took when it was last waited for, milliseconds. */
  pace = 0;
  /** Whether the last frame was drawn with few pixels. */
  coarse = false;
  #wanted = false;
  #sharpen = 0;
  #shade_later = false;
  #after: (() => void)[] = [];
  #spent: THREE.Material[] = [];

  constructor(canvas: HTMLCanvasElement) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, stencil: true });
    this.renderer.toneMapping = THREE.ACESFilmicToneMapping;
    this.renderer.localClippingEnabled = true;
    this.renderer.info.autoReset = false;
    const { shadowMap } = this.renderer;
    shadowMap.enabled = true;
    shadowMap.type = THREE.PCFShadowMap;
    shadowMap.autoUpdate = false;
    this.surroundings = new Surroundings();
    this.scene.add(this.surroundings.group, this.marks);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.maxPolarAngle = Math.PI * 0.53; // hardly below the ground
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('change', () => this.draw());
    new ResizeObserver(() => this.#fit()).observe(canvas);
    this.#fit();
  }

  get canvas() { return this.renderer.domElement; }

  /** Puts a model in the place of the one before; the camera stays. */
  show(model: Model) {
    for (const { mesh } of this.model?.chunks ?? []) {
      this.scene.remove(mesh);
      mesh.geometry.dispose();
      this.#spent.push(mesh.material); // until the next ones are drawn: their programs are the same
    }
    this.model = model;
    for (const { mesh } of model.chunks) this.scene.add(mesh);
    this.surroundings.fit(model.box);
    const size = this.size();
    this.camera.near = Math.max(0.02, size / 2000);
    this.camera.far = Math.max(400, size * 40);
    this.camera.updateProjectionMatrix();
    for (const then of this.on_model) then(model);
    this.refresh();
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
    const coarse = quick && this.pace > SLOW;
    if (coarse) this.#sharpen = window.setTimeout(() => this.frame(), 140);
    shadowMap.needsUpdate = this.#shade_later && !coarse;
    this.#shade_later &&= coarse;
    if (coarse !== this.coarse) {
      this.coarse = coarse;
      this.#resize();
    }
    const begun = performance.now(), { info } = this.renderer;
    info.reset();
    this.paint();
    const { stats } = this;
    stats.ms = performance.now() - begun;
    stats.calls = info.render.calls;
    stats.triangles = info.render.triangles;
    stats.frames++;
    for (const material of this.#spent.splice(0)) material.dispose();
    for (const then of this.#after.splice(0)) then();
    for (const then of this.on_frame) then();
  }

  /** Waits until all that was asked for is drawn. */
  settle() {
    const begun = performance.now() - this.stats.ms;
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    if (!this.coarse) this.pace = performance.now() - begun;
  }

  #resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    // As many pixels as there is time for.
    const share = this.coarse ? Math.min(0.7, Math.max(0.25, Math.sqrt(SLOW / this.pace))) : 1;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2) * share);
    this.renderer.setSize(width, height, false);
  }

  #fit() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    this.coarse = false;
    this.#resize();
    this.camera.aspect = width / height;
    // A narrow window sees as far to the sides as one of 4 to 3.
    const half = Math.tan(FOV / 2 * Math.PI / 180) * Math.max(1, 4 / 3 / this.camera.aspect);
    this.camera.fov = Math.min(80, Math.atan(half) * 360 / Math.PI);
    this.camera.updateProjectionMatrix();
    this.frame(); // at once, since the canvas has just been cleared
  }
}
