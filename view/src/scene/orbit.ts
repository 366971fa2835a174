// Camera movement without a mouse: by keys and on the turntable.

import * as THREE from 'three';
import type { Viewport } from './viewport.ts';

const STEP = Math.PI / 24;

/** Orbits the camera around its target. */
export function orbit({ camera, controls }: Viewport, around: number, up: number) {
  const away = camera.position.clone().sub(controls.target);
  const at = new THREE.Spherical().setFromVector3(away);
  at.theta += around;
  at.phi = Math.min(controls.maxPolarAngle, Math.max(0.02, at.phi - up));
  camera.position.setFromSpherical(at).add(controls.target);
  controls.update();
}

/** Zooms by a factor; below 1 moves closer. */
export function zoom({ camera, controls }: Viewport, by: number) {
  camera.position.sub(controls.target).multiplyScalar(by).add(controls.target);
  controls.update();
}

/** Pans the camera, as fractions of its distance to the target. */
export function pan({ camera, controls }: Viewport, right: number, up: number) {
  const far = camera.position.distanceTo(controls.target);
  const move = new THREE.Vector3(right * far, up * far, 0).applyQuaternion(camera.quaternion);
  camera.position.add(move);
  controls.target.add(move);
  controls.update();
}

/** Handles a key on the canvas; returns false if it has no meaning there. */
export function handleKey(viewport: Viewport, event: KeyboardEvent): boolean {
  if (event.ctrlKey || event.metaKey || event.altKey) return false;
  const way: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  const arrow = way[event.key];
  if (arrow && event.shiftKey) pan(viewport, arrow[0] * 0.05, arrow[1] * 0.05);
  else if (arrow) orbit(viewport, arrow[0] * STEP, arrow[1] * STEP);
  else if (event.key === '+' || event.key === '=') zoom(viewport, 1 / 1.15);
  else if (event.key === '-' || event.key === '_') zoom(viewport, 1.15);
  else return false;
  return true;
}

/** Rotates the camera slowly, or in steps where reduced motion is preferred. */
export class Turntable {
  on = false;
  #viewport: Viewport;
  #last = 0;
  #still = matchMedia('(prefers-reduced-motion: reduce)');

  constructor(viewport: Viewport) { this.#viewport = viewport; }

  set(on: boolean) {
    if (this.on === on) return;
    this.on = on;
    this.#last = performance.now();
    if (on) requestAnimationFrame(this.#turn);
  }

  #turn = (now: number) => {
    if (!this.on) return;
    const seconds = Math.max(0, now - this.#last) / 1000;
    if (!this.#still.matches) {
      orbit(this.#viewport, Math.min(seconds, 0.1) * 0.35, 0);
      this.#last = now;
    } else if (seconds > 2) {
      orbit(this.#viewport, Math.PI / 8, 0);
      this.#last = now;
    }
    requestAnimationFrame(this.#turn);
  };
}
