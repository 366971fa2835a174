// The 3D view: renderer, scene, camera. A frame is drawn only when something has changed; shadows are updated only when the
// model, its visible parts or the sun have changed.

import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { LowResolutionPass } from './low-resolution.ts';
import type { Chunk, Model } from '../model/model.ts';
import { Environment } from './environment.ts';

/** Statistics of the last frame. */
export interface FrameStats {
  calls: number;
  triangles: number;
  /** From the first draw call to the last, milliseconds. */
  ms: number;
  frames: number;
}

/** Two scenes in one view. */
export interface Split {
  /** The share of the view to the left of the line. */
  at: number;
  /** Prepares what is seen on the left side, or on the right. */
  show: (left: boolean) => void;
}

/** Vertical field of view, degrees. */
const FOV = 36;

/** Minimum height of the camera above the ground, metres. */
const MIN_EYE_HEIGHT = 0.3;

/** Least distance of the near plane, metres. */
const MIN_NEAR = 0.05;

/** With only the sun to reflect, metal would be black: this fraction of its metalness is kept. */
const METALNESS_SCALE = 0.3;

/** Frame time above which the machine counts as slow, milliseconds. */
const SLOW_FRAME_MS = 40;

/** Where the haze over a town begins and hides everything, seen from the ground, metres. */
const HAZE_NEAR = 120;
const HAZE_FAR = 3000;

export class Viewport {
  readonly renderer: THREE.WebGLRenderer;
  readonly scene = new THREE.Scene();
  readonly camera = new THREE.PerspectiveCamera(FOV, 1, 0.05, 2000);
  readonly controls: OrbitControls;
  readonly environment: Environment;
  get sun() { return this.environment.sun; }
  /** Overlays on the model, never picked. */
  readonly marks = new THREE.Group();
  model: Model | null = null;
  /** The bounds of a town, which is no model. */
  extent: THREE.Box3 | null = null;
  readonly stats: FrameStats = { calls: 0, triangles: 0, ms: 0, frames: 0 };
  /** True if a chunk is visible. */
  isVisible: (chunk: Chunk) => boolean = () => true;
  /** Called with each new model before it is drawn. */
  readonly onModel: ((model: Model) => void)[] = [];
  /** Called when the graphics context has been restored. */
  readonly onRestored: (() => void)[] = [];
  /** Called when the canvas has another size, before it is drawn. */
  readonly onResized: (() => void)[] = [];
  /** Called before each frame. */
  readonly beforeFrame: (() => void)[] = [];
  /** Called after each frame. */
  readonly onFrame: (() => void)[] = [];
  /** Draws the scene; replaced by extensions such as reflections. */
  paint = () => this.renderer.render(this.scene, this.camera);
  /** Null if one scene fills the view. */
  split: Split | null = null;
  /** Duration of the last full frame including the GPU, milliseconds. */
  frameTime = 0;
  /** True if the last frame had low resolution. */
  coarse = false;
  /** True if the GPU has finished the last frame. */
  #waited = false;
  #wanted = false;
  #lowResolution: LowResolutionPass;
  readonly #haze = new THREE.Fog(0);
  #sharpen = 0;
  #shadowsPending = false;
  #afterFrame: (() => void)[] = [];
  #disposable: THREE.Material[] = [];
  #dimmed = new WeakSet<THREE.Material>();

  constructor(canvas: HTMLCanvasElement) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    this.renderer.toneMapping = THREE.ACESFilmicToneMapping;
    this.renderer.localClippingEnabled = true;
    this.renderer.info.autoReset = false;
    const { shadowMap } = this.renderer;
    shadowMap.enabled = true;
    shadowMap.type = THREE.PCFShadowMap;
    shadowMap.autoUpdate = false;
    this.#lowResolution = new LowResolutionPass(this.renderer);
    this.environment = new Environment();
    this.#haze.color = this.environment.colours.horizon; // It follows the sun.
    this.scene.add(this.environment.group, this.marks);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('change', () => { this.#keepAboveGround(); this.draw(); });
    canvas.addEventListener('webglcontextrestored', () => {
      for (const then of this.onRestored) then();
      this.updateShadows();
    });
    new ResizeObserver(() => this.#resize()).observe(canvas);
    this.#resize();
  }

  get canvas() { return this.renderer.domElement; }

  /** Replaces the model; the camera and meshes common to both stay. */
  show(model: Model) {
    const before = new Set(this.model?.chunks.map(chunk => chunk.mesh)), now = new Set(model.chunks.map(chunk => chunk.mesh));
    const used = new Set(model.chunks.map(chunk => chunk.mesh.material)), disposable = new Set<THREE.Material>();
    for (const mesh of before) {
      if (now.has(mesh)) continue;
      this.scene.remove(mesh);
      mesh.geometry.dispose();
      if (!used.has(mesh.material)) disposable.add(mesh.material);
    }
    for (const material of used) this.dim(material);
    this.#disposable.push(...disposable); // Disposed after the next frame, so that its shader programs are reused.
    this.model = model;
    for (const mesh of now) if (!before.has(mesh)) this.scene.add(mesh);
    if (!this.extent) this.environment.fit(model.box);
    this.camera.far = Math.max(400, this.size() * 40);
    for (const then of this.onModel) then(model);
    this.refresh();
  }

  /** Adjusts ground, light and the reach of the camera to the bounds of a town. */
  showExtent(box: THREE.Box3) {
    this.extent = box;
    this.environment.fit(box);
    this.camera.far = Math.max(400, this.size() * 6);
    this.camera.updateProjectionMatrix();
  }

  /** Takes most of the metalness of a material, once. */
  dim(material: THREE.Material) {
    if (this.#dimmed.has(material) || !('metalness' in material)) return; // Kept from the previous model, or not a PBR material.
    this.#dimmed.add(material);
    (material as THREE.MeshStandardMaterial).metalness *= METALNESS_SCALE;
  }

  /** The bounds of what is shown. */
  get bounds(): THREE.Box3 | null { return this.extent ?? this.model?.box ?? null; }

  /** Lets what is far off in a town fade into the horizon: from afar or above later than on the ground, as one sees farther. */
  #fade() {
    const { scene, extent, camera, controls } = this, away = camera.position.distanceTo(controls.target);
    scene.fog = extent ? this.#haze : null;
    this.#haze.near = Math.max(HAZE_NEAR, away * 2);
    this.#haze.far = Math.max(HAZE_FAR, away * 10);
  }

  /** Moves the near plane as far out as the nearest surface allows: the depth of distant surfaces is the finer for it. */
  #fitNear() {
    const { camera, model, extent } = this, ground = Math.min(0, this.bounds?.min.y ?? 0);
    let least = Math.max(0, camera.position.y - ground);
    if (extent) least = Math.max(MIN_NEAR * 4, extent.distanceToPoint(camera.position));
    for (const { box, mesh } of model?.chunks ?? []) if (mesh.visible) least = Math.min(least, box.distanceToPoint(camera.position));
    const near = Math.max(MIN_NEAR, least / 2);
    if (near === camera.near) return;
    camera.near = near;
    camera.updateProjectionMatrix();
  }

  /** Keeps the camera above the ground and limits its downward angle. */
  #keepAboveGround() {
    const { controls, camera: { position } } = this, { target } = controls;
    const low = Math.min(0, this.bounds?.min.y ?? 0) + MIN_EYE_HEIGHT, rise = Math.max(0, low - position.y);
    position.y += rise;
    target.y += rise;
    controls.maxPolarAngle = Math.acos(THREE.MathUtils.clamp((low - target.y) / position.distanceTo(target), -1, 1));
  }

  /** Points the camera at a target from its position. */
  lookAt(target: THREE.Vector3) {
    this.controls.target.copy(target);
    this.#keepAboveGround();
    this.controls.update();
    this.draw();
  }

  /** Updates the visibility of all chunks. */
  refresh() {
    for (const chunk of this.model?.chunks ?? []) chunk.mesh.visible = this.isVisible(chunk);
    this.updateShadows();
  }

  /** Requests a shadow update. */
  updateShadows() {
    this.renderer.shadowMap.needsUpdate = true;
    this.draw();
  }

  /** Diagonal of the model, metres. */
  size(): number {
    return this.bounds?.getSize(new THREE.Vector3()).length() || 10;
  }

  /** Requests a frame; `after` is called when it has been drawn. */
  draw(after?: () => void) {
    if (after) this.#afterFrame.push(after);
    if (this.#wanted) return;
    this.#wanted = true;
    requestAnimationFrame(() => this.frame(true));
  }

  /**
   * Draws a frame immediately. With `quick`, on a slow machine, it has low resolution and the previous shadows, and a full
   * frame follows when there is time.
   */
  frame(quick = false) {
    this.#wanted = false;
    const { shadowMap } = this.renderer;
    clearTimeout(this.#sharpen);
    this.#shadowsPending ||= shadowMap.needsUpdate;
    const coarse = this.coarse = quick && this.frameTime > SLOW_FRAME_MS && !this.split;
    if (coarse) this.#sharpen = window.setTimeout(() => this.frame(), 140);
    shadowMap.needsUpdate = this.#shadowsPending && !coarse;
    this.#shadowsPending &&= coarse;
    const begun = performance.now(), { info } = this.renderer, { stats } = this;
    this.#waited = false;
    info.reset();
    for (const first of this.beforeFrame) first();
    this.#fitNear();
    this.#fade();
    if (coarse) this.#lowResolution.begin(SLOW_FRAME_MS / this.frameTime);
    try {
      if (this.split) this.#paintBoth(this.split); else this.paint();
      stats.calls = info.render.calls;
      stats.triangles = info.render.triangles;
    } finally {
      if (coarse) this.#lowResolution.end();
    }
    stats.ms = performance.now() - begun;
    stats.frames++;
    for (const material of this.#disposable.splice(0)) disposeMaterial(material);
    for (const then of this.#afterFrame.splice(0)) then();
    for (const then of this.onFrame) then();
  }

  /** Paints both sides, each with shadows of its own. */
  #paintBoth({ at, show }: Split) {
    const { renderer, canvas: { clientWidth: width, clientHeight: height } } = this, line = Math.round(width * at);
    renderer.setScissorTest(true);
    for (const [left, from, to] of [[true, 0, line], [false, line, width]] as const) {
      if (from === to) continue;
      show(left);
      renderer.shadowMap.needsUpdate = true;
      renderer.setScissor(from, 0, to - from, height);
      this.paint();
    }
    renderer.setScissorTest(false);
  }

  /** Waits until the GPU has finished. */
  settle() {
    const begun = performance.now() - this.stats.ms;
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    if (!this.coarse && !this.#waited) this.frameTime = performance.now() - begun;
    this.#waited = true;
  }

  /** Sets the vertical angle of view, degrees; null for the usual one. */
  setFieldOfView(fov: number | null) {
    this.#fov = fov ?? FOV;
    this.#fitFieldOfView();
  }
  #fov = FOV;

  /** A narrow window keeps the horizontal field of view of a 4:3 one. */
  #fitFieldOfView() {
    const half = Math.tan(this.#fov / 2 * Math.PI / 180) * Math.max(1, 4 / 3 / this.camera.aspect);
    this.camera.fov = Math.max(this.#fov, Math.min(80, Math.atan(half) * 360 / Math.PI));
    this.camera.updateProjectionMatrix();
  }

  #resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.#fitFieldOfView();
    for (const then of this.onResized) then();
    this.frame(); // Immediately, since resizing clears the canvas.
  }
}

/** Frees the GPU resources of a material, except textures that the loader keeps. */
function disposeMaterial(material: THREE.Material) {
  for (const value of Object.values(material)) {
    if (!(value instanceof THREE.Texture) || value.userData['kept']) continue;
    value.dispose();
    if (value.source.data instanceof ImageBitmap) value.source.data.close();
  }
  material.dispose();
}
