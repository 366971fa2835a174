// A lamp that a walker carries: warm, and no brighter than to see a dark room by.

import * as THREE from 'three';
import type { App } from '../app.ts';
import { strings } from '../ui/strings.ts';

/** Colour, candela, how far it reaches in metres, and how fast it fades. */
const LAMP = [0xffc58a, 9, 12, 1.4] as const;

export class Lamp {
  on = false;
  #app: App;
  #light = new THREE.PointLight(...LAMP);

  constructor(app: App) { this.#app = app; }

  set(on: boolean) {
    if (on === this.on) return;
    this.on = on;
    const { scene } = this.#app.viewport;
    if (on) scene.add(this.#light); else scene.remove(this.#light);
    this.#app.viewport.draw();
    this.#app.announce(on ? strings.lampOn : strings.lampOff);
    this.#app.emit('walk');
  }

  /** Holds it beside the eyes. */
  hold({ position }: THREE.Camera) { this.#light.position.copy(position).add({ x: 0, y: -0.25, z: 0 } as THREE.Vector3); }
}
