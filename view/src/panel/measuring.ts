// The measuring tool's controls and results.

import type { App } from '../app.ts';
import { button, h, checkbox } from '../ui/dom.ts';
import { formatLength } from '../ui/lengths.ts';
import { strings } from '../ui/strings.ts';
import { collapsible } from './collapsible.ts';

export function measuringPanel(app: App): HTMLElement {
  const { measure } = app.renderer;
  const on = checkbox(strings.measureOn, false, value => {
    measure.on = value;
    app.renderer.viewport.canvas.classList.toggle('measuring', value);
  });
  const rows = h('tbody', {}), status = h('p', { class: 'quiet', role: 'status' });
  const table = h('table', { hidden: true }, h('thead', {}, h('tr', {}, h('th', { scope: 'col' }, strings.measure),
    h('th', { scope: 'col' }, 'm'), h('th', { scope: 'col' }, strings.shaku), h('th', { scope: 'col' }, strings.ken))), rows);
  const row = (label: string, length: number) => {
    const { metres, shaku, ken } = formatLength(length);
    return h('tr', {}, h('th', { scope: 'row' }, label), ...[metres, shaku, ken].map(text => h('td', {}, text.split(' ')[0])));
  };
  measure.changed = () => {
    const segments = measure.segments();
    table.hidden = segments.length === 0;
    rows.replaceChildren(...segments.map((length, i) => row(strings.segment(i + 1), length)),
      ...(segments.length > 1 ? [row(strings.total, measure.total())] : []));
    const last = segments.at(-1);
    status.textContent = measure.points.length === 0 ? '' : last === undefined ? strings.points(1)
      : Object.values(formatLength(last)).join(' · ');
  };
  app.on('shown', () => {
    if (!app.resetting) return;
    on.box.checked = measure.on = false;
    app.renderer.viewport.canvas.classList.remove('measuring');
    measure.clear();
  });
  return collapsible('measure', strings.measure, false, on, h('p', { class: 'quiet' }, strings.measureHelp), table, status,
    h('div', { class: 'buttons' }, button(strings.undoPoint, () => measure.undo()), button(strings.clear, () => measure.clear())));
}
