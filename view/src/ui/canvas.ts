// Pointer and keyboard input of the 3D canvas: selecting, measuring, moving the camera.

import type { App } from '../app.ts';
import { handleKey } from '../scene/orbit.ts';
import { h } from './dom.ts';
import { strings } from './strings.ts';

/** Presses that move less than this are clicks, CSS pixels. */
const CLICK_DISTANCE = 5;

export function createCanvas(): HTMLCanvasElement {
  return h('canvas', { class: 'viewport', tabindex: 0, role: 'application', 'aria-label': strings.canvas });
}

export function attachInput(app: App, cross: HTMLElement) {
  const { renderer } = app, { viewport, measure } = renderer, { canvas } = viewport;
  let down: { x: number; y: number } | null = null;
  const choose = (x: number, y: number) => {
    const ray = app.town.state && renderer.rayAt(x, y), found = ray ? null : renderer.hitAt(x, y);
    if (measure.on) {
      const point = ray ? app.town.surfaceAt(ray) : found?.point;
      if (point) measure.add(point);
    } else if (ray) app.town.pick(ray);
    else if (app.walk.on && app.walk.doors.press(renderer.rayAt(x, y))) { /* It slides. */ }
    else app.select(found?.part ?? null);
  };
  canvas.addEventListener('pointerdown', ({ offsetX: x, offsetY: y, button }) => {
    renderer.turntable.on && renderer.turntable.set(false);
    app.emit('shown');
    down = button === 0 ? { x, y } : null;
  });
  canvas.addEventListener('pointerup', ({ offsetX: x, offsetY: y }) => {
    if (down && Math.hypot(x - down.x, y - down.y) < CLICK_DISTANCE) choose(x, y);
    down = null;
  });
  canvas.addEventListener('dblclick', () => {
    const location = app.selection === null || measure.on ? null : app.locationOf(app.selection);
    if (location) void app.open(location);
  });
  canvas.addEventListener('keydown', event => {
    cross.hidden = false;
    if (app.walk.handleKey(event)) { /* It goes there, or ends the walk. */ }
    else if (event.key === 'Enter') choose(canvas.clientWidth / 2, canvas.clientHeight / 2);
    else if (event.key === 'Escape') { app.select(null); app.town.clearSelection(); }
    else if (event.key === 'Backspace' && measure.on) measure.undo();
    else if (event.key === 'Home') app.look('front');
    else if (!handleKey(viewport, event)) return;
    event.preventDefault();
  });
  // The crosshair is visible only while the keyboard is in use.
  canvas.addEventListener('blur', () => { cross.hidden = true; });
  canvas.addEventListener('focus', () => { cross.hidden = !canvas.matches(':focus-visible'); });
}
