// The stage that a model stands on: light, ground, camera. It is drawn anew when something has changed, and only then.

import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { Model } from './model.ts';

export class Stage {
  readonly renderer: THREE.WebGLRenderer;
  readonly scene = new THREE.Scene();
  readonly camera = new THREE.PerspectiveCamera(40, 1, 0.05, 2000);
  readonly controls: OrbitControls;
  readonly sun = new THREE.DirectionalLight(0xfff4e0, 2.6);
  model: Model | null = null;
  /** Draws a frame; those who add to it put their own in its place. */
  paint = () => this.renderer.render(this.scene, this.camera);
  #wanted = false;

  constructor(canvas: HTMLCanvasElement) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    this.renderer.toneMapping = THREE.ACESFilmicToneMapping;
    this.scene.background = new THREE.Color(0xcfdde6);
    this.scene.add(new THREE.HemisphereLight(0xdfeaf5, 0x8a7d68, 1.4), this.sun, this.sun.target);
    this.sun.position.set(20, 40, 30);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener('change', () => this.draw());
    new ResizeObserver(() => this.#fit()).observe(canvas);
    this.#fit();
  }

  /** Puts a model in the place of the one before; the camera stays unless it is the first. */
  show(model: Model) {
    for (const { mesh } of this.model?.chunks ?? []) {
      this.scene.remove(mesh);
      mesh.geometry.dispose();
    }
    const first = this.model === null;
    this.model = model;
    for (const { mesh } of model.chunks) this.scene.add(mesh);
    if (first) this.look();
    this.draw();
  }

  /** Stands the camera before the model. */
  look() {
    const box = this.model?.box ?? new THREE.Box3(new THREE.Vector3(-1, 0, -1), new THREE.Vector3(1, 1, 1));
    const size = box.getSize(new THREE.Vector3()).length();
    box.getCenter(this.controls.target);
    this.camera.position.copy(this.controls.target).add(new THREE.Vector3(-0.55, 0.35, 1).multiplyScalar(size));
    this.camera.near = size / 500;
    this.camera.far = size * 20;
    this.camera.updateProjectionMatrix();
    this.controls.update();
  }

  /** Asks for a frame. */
  draw() {
    if (this.#wanted) return;
    this.#wanted = true;
    requestAnimationFrame(() => {
      this.#wanted = false;
      this.paint();
    });
  }

  #fit() {
    const { clientWidth: width, clientHeight: height } = this.renderer.domElement;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }
}
