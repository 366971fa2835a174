// A lamp that a walker carries: warm, and no brighter than to see a dark room by.

import * as THREE from 'three';
import type { EventBus } from '../event-bus.ts';
import type { Viewport } from '../scene/viewport.ts';
import { strings } from '../ui/strings.ts';

/** Colour, candela, how far it reaches in metres, and how fast it fades. */
const LAMP = [0xffc58a, 9, 12, 1.4] as const;

export class Lamp {
  on = false;
  #events: EventBus;
  #viewport: Viewport;
  #light = new THREE.PointLight(...LAMP);

  constructor(events: EventBus, viewport: Viewport) {
    this.#events = events;
    this.#viewport = viewport;
  }

  set(on: boolean) {
    if (on === this.on) return;
    this.on = on;
    const { scene } = this.#viewport;
    if (on) scene.add(this.#light); else scene.remove(this.#light);
    this.#viewport.draw();
    this.#events.announce(on ? strings.lampOn : strings.lampOff);
    this.#events.emit('walk');
  }

  /** Holds it beside the eyes. */
  hold({ position }: THREE.Camera) { this.#light.position.copy(position).add({ x: 0, y: -0.25, z: 0 } as THREE.Vector3); }
}
