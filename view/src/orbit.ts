// Moving the eye without a mouse: by keys, by buttons, and by itself on the turntable.

import * as THREE from 'three';
import type { Stage } from './stage.ts';

const STEP = Math.PI / 24;

/** Turns the eye round what it looks at. */
export function orbit({ camera, controls }: Stage, around: number, up: number) {
  const away = camera.position.clone().sub(controls.target);
  const at = new THREE.Spherical().setFromVector3(away);
  at.theta += around;
  at.phi = Math.min(controls.maxPolarAngle, Math.max(0.02, at.phi - up));
  camera.position.setFromSpherical(at).add(controls.target);
  controls.update();
}

/** Goes nearer (by less than 1) or farther. */
export function zoom({ camera, controls }: Stage, by: number) {
  camera.position.sub(controls.target).multiplyScalar(by).add(controls.target);
  controls.update();
}

/** Moves the eye and what it looks at, by shares of the distance between them. */
export function pan({ camera, controls }: Stage, right: number, up: number) {
  const far = camera.position.distanceTo(controls.target);
  const move = new THREE.Vector3(right * far, up * far, 0).applyQuaternion(camera.quaternion);
  camera.position.add(move);
  controls.target.add(move);
  controls.update();
}

/** Does what a key means on the canvas; false where it means nothing. */
export function key(stage: Stage, event: KeyboardEvent): boolean {
  if (event.ctrlKey || event.metaKey || event.altKey) return false;
  const way: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  const arrow = way[event.key];
  if (arrow && event.shiftKey) pan(stage, arrow[0] * 0.05, arrow[1] * 0.05);
  else if (arrow) orbit(stage, arrow[0] * STEP, arrow[1] * STEP);
  else if (event.key === '+' || event.key === '=') zoom(stage, 1 / 1.15);
  else if (event.key === '-' || event.key === '_') zoom(stage, 1.15);
  else return false;
  return true;
}

/** Turns the eye slowly; by steps where motion is not wanted. */
export class Turntable {
  on = false;
  #stage: Stage;
  #last = 0;
  #still = matchMedia('(prefers-reduced-motion: reduce)');

  constructor(stage: Stage) { this.#stage = stage; }

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
      orbit(this.#stage, Math.min(seconds, 0.1) * 0.35, 0);
      this.#last = now;
    } else if (seconds > 2) {
      orbit(this.#stage, Math.PI / 8, 0);
      this.#last = now;
    }
    requestAnimationFrame(this.#turn);
  };
}
