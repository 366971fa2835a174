// The page used by the tests of reflections: a model and a camera, nothing else of `hsd view`. Flat: one colour per part, no
// lighting, no antialiasing; otherwise with sun, shadows, sky and ground.

import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { Mirrors, type Options, type Stats } from '../../src/mirror/mirrors.ts';
import { type Model, buildModel } from '../../src/model/model.ts';
import { colourOf } from '../colours.ts';

export interface Shot {
  eye: [number, number, number];
  target: [number, number, number];
  fov?: number;
  width: number;
  height: number;
  /** Half the visible height, for an orthographic view. */
  parallel?: number;
  options?: Partial<Options>;
}

export interface Shown {
  walls: number;
  layers: number;
  chunks: number;
  triangles: number;
}

export interface Drawn {
  stats: Stats;
  /** Milliseconds until the GPU has finished. */
  ms: number;
  /** Of the whole frame. */
  calls: number;
  triangles: number;
}

const SKY = new THREE.Color().setRGB(150 / 255, 180 / 255, 210 / 255, THREE.SRGBColorSpace);

class Page {
  #renderer: THREE.WebGLRenderer;
  #scene = new THREE.Scene();
  #mirrors: Mirrors;
  #model: Model | null = null;
  #defaults: Options;

  constructor(smooth: boolean) {
    this.#renderer = new THREE.WebGLRenderer({ antialias: smooth, preserveDrawingBuffer: true });
    document.body.append(this.#renderer.domElement);
    this.#scene.background = SKY;
    this.#mirrors = new Mirrors(this.#renderer, this.#scene);
    this.#defaults = { ...this.#mirrors.options };
    this.#renderer.info.autoReset = false;
  }

  /** Loads a model; `cover` is the opacity of flat glass. */
  async load(file: string, flat: boolean, cover = 1): Promise<Shown> {
    for (const { mesh } of this.#model?.chunks ?? []) this.#scene.remove(mesh);
    const model = buildModel((await new GLTFLoader().loadAsync(file)).scene);
    this.#model = model;
    if (flat) for (const chunk of model.chunks) flatten(chunk, cover);
    else this.#light(model);
    for (const { mesh } of model.chunks) this.#scene.add(mesh);
    this.#mirrors.show(model);
    const { walls } = this.#mirrors;
    return {
      walls: walls.length, layers: walls.reduce((sum, wall) => sum + wall.layers.length, 0),
      chunks: model.chunks.length, triangles: model.triangles,
    };
  }

  /** Draws a frame; coordinates are in the file's frame. */
  draw(shot: Shot): Drawn {
    const { eye, target, fov = 50, width, height, parallel } = shot, { origin } = this.#model!;
    Object.assign(this.#mirrors.options, this.#defaults, shot.options);
    this.#renderer.setSize(width, height);
    const camera = parallel === undefined ? new THREE.PerspectiveCamera(fov, width / height, 0.05, 500)
      : new THREE.OrthographicCamera(-parallel * width / height, parallel * width / height, parallel, -parallel, 0.05, 500);
    camera.position.set(...eye).sub(origin);
    camera.lookAt(new THREE.Vector3(...target).sub(origin));
    const begun = performance.now(), gl = this.#renderer.getContext(), { info } = this.#renderer;
    info.reset();
    this.#mirrors.paint(camera);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // Waits for the GPU.
    return { stats: this.#mirrors.stats, ms: performance.now() - begun, calls: info.render.calls, triangles: info.render.triangles };
  }

  /**
   * Draws the view of an eye behind a south-facing mirror that is itself not drawn, without reflections; `z` in the file's
   * frame.
   */
  behind(shot: Shot, z: number) {
    const turned = (p: [number, number, number]): [number, number, number] => [p[0], p[1], 2 * z - p[2]];
    this.#renderer.clippingPlanes = [new THREE.Plane(new THREE.Vector3(0, 0, 1), this.#model!.origin.z - z)];
    this.draw({ ...shot, eye: turned(shot.eye), target: turned(shot.target), options: { ...shot.options, on: false } });
    this.#renderer.clippingPlanes = [];
  }

  /** Draws until no further frame is requested; returns the number of frames. */
  async settle(shot: Shot): Promise<Drawn & { frames: number }> {
    const { occlusion } = this.#mirrors;
    let again = true, frames = 0;
    occlusion.requestFrame = () => { again = true; };
    while (again && frames < 20) {
      again = false;
      this.draw(shot);
      frames++;
      while (occlusion.pending) await new Promise(done => setTimeout(done, 5));
    }
    return { ...this.draw(shot), frames: frames + 1 };
  }

  /** Draws a number of frames; returns the shortest time, which other programs disturb least. */
  async measure(shot: Shot, frames: number): Promise<Drawn> {
    await this.settle(shot);
    const all: Drawn[] = [];
    for (let i = 0; i < frames; i++) all.push(this.draw(shot));
    const last = all.at(-1)!;
    return { ...last, ms: Math.min(...all.map(({ ms }) => ms)), stats: { ...last.stats, find: Math.min(...all.map(({ stats }) => stats.find)) } };
  }

  /** The drawn pixels from the lower left corner, RGBA, base64. */
  pixels(): string {
    const { width, height } = this.#renderer.domElement, gl = this.#renderer.getContext();
    const bytes = new Uint8Array(width * height * 4);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    let text = '';
    for (let i = 0; i < bytes.length; i += 0x8000) text += String.fromCharCode(...bytes.subarray(i, i + 0x8000));
    return btoa(text);
  }

  /** WebGL errors since the last call. */
  errors(): number[] {
    const gl = this.#renderer.getContext(), errors: number[] = [];
    for (let error = gl.getError(); error !== gl.NO_ERROR; error = gl.getError()) errors.push(error);
    return errors;
  }

  #light({ box }: Model) {
    const renderer = this.#renderer, size = box.getSize(new THREE.Vector3()).length();
    renderer.toneMapping = THREE.ACESFilmicToneMapping;
    renderer.shadowMap.enabled = true;
    const sun = new THREE.DirectionalLight(0xfff2dd, 2.9);
    sun.position.set(0.5, 1, 0.9).multiplyScalar(size);
    sun.castShadow = true;
    sun.shadow.mapSize.setScalar(2048);
    Object.assign(sun.shadow.camera, { left: -size, right: size, top: size, bottom: -size, near: 0, far: size * 4 });
    const ground = new THREE.Mesh(new THREE.CircleGeometry(size * 10, 48), new THREE.MeshStandardMaterial({ color: 0xcfc5b0 }));
    ground.rotation.x = -Math.PI / 2;
    ground.position.y = -0.003;
    ground.receiveShadow = true;
    this.#scene.add(sun, sun.target, new THREE.HemisphereLight(0xeaf1f8, 0xb0a288, 1.5), ground);
  }
}

/** Assigns one colour to each part. */
function flatten({ mesh, ranges }: Model['chunks'][number], cover: number) {
  const { geometry } = mesh, colours = new Float32Array(geometry.getAttribute('position').count * 3);
  for (const { start, count, part } of ranges) {
    for (let i = start; i < start + count; i++) colours.set(colourOf(part), geometry.index!.getX(i) * 3);
  }
  geometry.setAttribute('color', new THREE.BufferAttribute(colours, 3));
  const { side, userData } = mesh.material;
  const material = new THREE.MeshBasicMaterial({ vertexColors: true, toneMapped: false, side });
  material.userData = userData;
  if (cover < 1 && 'reflection' in userData) Object.assign(material, { transparent: true, opacity: cover, depthWrite: false });
  mesh.material = material as unknown as typeof mesh.material;
}

declare global {
  interface Window {
    /** `smooth` enables antialiasing. */
    page: (smooth: boolean) => Page;
  }
}
window.page = smooth => new Page(smooth);
