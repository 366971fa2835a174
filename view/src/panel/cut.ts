// The controls of the section plane.

import type { App } from '../app.ts';
import { field, h, tick } from '../dom.ts';
import type { Axis } from '../section.ts';
import { words } from '../words.ts';
import { fold } from './fold.ts';

export function cut(app: App): HTMLElement {
  const { section } = app;
  const on = tick(words.section_on, section.cut.on, value => set({ on: value }));
  const axis = h('select', { onchange: () => set({ axis: axis.value as Axis, on: true }) },
    ...(['x', 'y', 'z'] as const).map(name => h('option', { value: name, selected: name === section.cut.axis }, words[`axis_${name}`])));
  const at = h('input', { type: 'range', min: 0, max: 1, step: 0.005, value: section.cut.at, oninput: () => set({ at: at.valueAsNumber, on: true }) });
  const flip = tick(words.flip, section.cut.flip, value => set({ flip: value, on: true }));
  const metres = h('output', {});
  const show = () => {
    const { cut } = section;
    on.box.checked = cut.on;
    axis.value = cut.axis;
    at.value = `${cut.at}`;
    flip.box.checked = cut.flip;
    metres.textContent = `${section.position().toFixed(2)} m`;
    at.setAttribute('aria-valuetext', metres.textContent);
  };
  const set = (change: Partial<typeof section.cut>) => {
    section.set(change);
    app.tell('shown');
  };
  app.on('shown', show);
  app.on('model', show);
  return fold('section', words.section, false, on, field(words.axis, axis), field(words.position, at, metres), flip);
}
