// The canvas under the pointer and the keys: choosing parts, measuring, moving the eye.

import * as THREE from 'three';
import type { App } from './app.ts';
import { h } from './dom.ts';
import { key } from './orbit.ts';
import { type Hit, hit } from './parts.ts';
import { words } from './words.ts';

/** A press that moves less is a click, CSS pixels. */
const STILL = 5;

export function canvas_of(): HTMLCanvasElement {
  return h('canvas', { class: 'stage', tabindex: 0, role: 'application', 'aria-label': words.canvas });
}

/** What is drawn at a place of the canvas, CSS pixels. */
export function hit_at({ stage, section }: App, x: number, y: number): Hit | null {
  const { canvas, camera, model } = stage;
  if (!model) return null;
  const ray = new THREE.Raycaster();
  camera.updateMatrixWorld();
  ray.setFromCamera(new THREE.Vector2(x / canvas.clientWidth * 2 - 1, 1 - y / canvas.clientHeight * 2), camera);
  return hit(model, ray, section.keeps);
}

export function attend(app: App, cross: HTMLElement) {
  const { stage, measure } = app, { canvas } = stage;
  let down: { x: number; y: number } | null = null;
  const choose = (x: number, y: number) => {
    const found = hit_at(app, x, y);
    if (measure.on) {
      if (found) measure.add(found);
    } else app.select(found?.part ?? null);
  };
  canvas.addEventListener('pointerdown', ({ offsetX: x, offsetY: y, button }) => {
    app.turntable.on && app.turntable.set(false);
    app.tell('shown');
    down = button === 0 ? { x, y } : null;
  });
  canvas.addEventListener('pointerup', ({ offsetX: x, offsetY: y }) => {
    if (down && Math.hypot(x - down.x, y - down.y) < STILL) choose(x, y);
    down = null;
  });
  canvas.addEventListener('dblclick', () => {
    const spot = app.selection === null || measure.on ? null : app.spot_of(app.selection);
    if (spot) void app.open(spot);
  });
  canvas.addEventListener('keydown', event => {
    cross.hidden = false;
    if (event.key === 'Enter') choose(canvas.clientWidth / 2, canvas.clientHeight / 2);
    else if (event.key === 'Escape') app.select(null);
    else if (event.key === 'Backspace' && measure.on) measure.undo();
    else if (event.key === 'Home') app.look('front');
    else if (!key(stage, event)) return;
    event.preventDefault();
  });
  // The cross that keys aim with is shown while they do.
  canvas.addEventListener('blur', () => { cross.hidden = true; });
  canvas.addEventListener('focus', () => { cross.hidden = !canvas.matches(':focus-visible'); });
}
