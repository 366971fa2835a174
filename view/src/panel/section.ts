// Controls of the section plane.

import type { App } from '../app.ts';
import { field, h, checkbox } from '../ui/dom.ts';
import type { Axis } from '../scene/section.ts';
import { strings } from '../ui/strings.ts';
import { collapsible } from './collapsible.ts';

export function sectionPanel(app: App): HTMLElement {
  const { section } = app.renderer;
  const on = checkbox(strings.sectionOn, section.cut.on, value => set({ on: value }));
  const axis = h('select', { onchange: () => set({ axis: axis.value as Axis, on: true }) },
    ...(['x', 'y', 'z'] as const).map(name => h('option', { value: name, selected: name === section.cut.axis }, strings.axisName[name])));
  const at = h('input', { type: 'range', min: 0, max: 1, step: 0.005, value: section.cut.at, oninput: () => set({ at: at.valueAsNumber, on: true }) });
  const flip = checkbox(strings.flip, section.cut.flip, value => set({ flip: value, on: true }));
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
    app.emit('shown');
  };
  app.on('shown', show);
  app.on('model', show);
  return collapsible('section', strings.section, false, on, field(strings.axis, axis), field(strings.position, at, metres), flip);
}
