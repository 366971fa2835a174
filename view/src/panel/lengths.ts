// The lengths that were measured.

import type { App } from '../app.ts';
import { button, h, tick } from '../dom.ts';
import { length_words } from '../lengths.ts';
import { words } from '../words.ts';
import { fold } from './fold.ts';

export function lengths(app: App): HTMLElement {
  const { measure } = app;
  const on = tick(words.measure_on, false, value => {
    measure.on = value;
    app.stage.canvas.classList.toggle('measuring', value);
  });
  const rows = h('tbody', {}), status = h('p', { class: 'quiet', role: 'status' });
  const table = h('table', { hidden: true }, h('thead', {}, h('tr', {}, h('th', { scope: 'col' }, words.measure),
    h('th', { scope: 'col' }, 'm'), h('th', { scope: 'col' }, words.shaku), h('th', { scope: 'col' }, words.ken))), rows);
  const row = (label: string, length: number) => {
    const { metres, shaku, ken } = length_words(length);
    return h('tr', {}, h('th', { scope: 'row' }, label), ...[metres, shaku, ken].map(text => h('td', {}, text.split(' ')[0])));
  };
  measure.changed = () => {
    const stretches = measure.stretches();
    table.hidden = stretches.length === 0;
    rows.replaceChildren(...stretches.map((length, i) => row(words.stretch(i + 1), length)),
      ...(stretches.length > 1 ? [row(words.total, measure.total())] : []));
    const last = stretches.at(-1);
    status.textContent = measure.points.length === 0 ? '' : last === undefined ? words.points(1)
      : Object.values(length_words(last)).join(' · ');
  };
  app.on('shown', () => {
    if (!app.resetting) return;
    on.box.checked = measure.on = false;
    app.stage.canvas.classList.remove('measuring');
    measure.clear();
  });
  return fold('measure', words.measure, false, on, h('p', { class: 'quiet' }, words.measure_how), table, status,
    h('div', { class: 'buttons' }, button(words.undo_point, () => measure.undo()), button(words.clear, () => measure.clear())));
}
