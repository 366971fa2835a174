// Settings of reflections in glass.

import type { App } from '../app.ts';
import { field, h, checkbox } from '../ui/dom.ts';
import { strings } from '../ui/strings.ts';
import { collapsible } from './collapsible.ts';

export function reflectionPanel(app: App): HTMLElement {
  const { options } = app.renderer.mirrors, start = { on: options.on, depth: options.depth };
  const set = (change: Partial<typeof start>) => {
    Object.assign(options, change);
    on.box.checked = options.on;
    depth.value = `${options.depth}`;
    app.renderer.viewport.draw();
  };
  const on = checkbox(strings.mirrorsOn, options.on, value => set({ on: value }));
  const depth = h('input', { type: 'number', min: 1, max: 6, step: 1, value: options.depth, oninput: () => {
    if (depth.valueAsNumber >= 1) set({ depth: Math.min(6, Math.round(depth.valueAsNumber)) });
  } });
  const none = h('p', { class: 'quiet' }, strings.mirrorsNone);
  app.on('model', () => { none.hidden = app.renderer.mirrors.walls.length > 0; });
  app.on('shown', () => { if (app.resetting) set(start); });
  return collapsible('glass', strings.mirrors, false, on, field(strings.mirrorsDepth, depth), none);
}
