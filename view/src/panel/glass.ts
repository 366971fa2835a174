// Whether glass mirrors what stands round it, and how deep mirrors are seen in mirrors.

import type { App } from '../app.ts';
import { field, h, tick } from '../dom.ts';
import { words } from '../words.ts';
import { fold } from './fold.ts';

export function glass(app: App): HTMLElement {
  const { options } = app.mirrors, start = { on: options.on, depth: options.depth };
  const set = (change: Partial<typeof start>) => {
    Object.assign(options, change);
    on.box.checked = options.on;
    depth.value = `${options.depth}`;
    app.stage.draw();
  };
  const on = tick(words.mirrors_on, options.on, value => set({ on: value }));
  const depth = h('input', { type: 'number', min: 1, max: 6, step: 1, value: options.depth, oninput: () => {
    if (depth.valueAsNumber >= 1) set({ depth: Math.min(6, Math.round(depth.valueAsNumber)) });
  } });
  const none = h('p', { class: 'quiet' }, words.mirrors_none);
  app.on('model', () => { none.hidden = app.mirrors.walls.length > 0; });
  app.on('shown', () => { if (app.resetting) set(start); });
  return fold('glass', words.mirrors, false, on, field(words.mirrors_depth, depth), none);
}
