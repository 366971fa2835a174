// Compares a town with itself under other parameters: what is kept, where the line runs, what differs.

import type { App } from '../app.ts';
import type { Changed } from '../server/api.ts';
import { button, field, h } from '../ui/dom.ts';
import { strings } from '../ui/strings.ts';
import { collapsible } from './collapsible.ts';

export function comparisonPanel(app: App): HTMLElement {
  const { comparison } = app;
  const keep = button(strings.keepTown, () => void comparison.keep().catch(failed), { 'data-do': 'keep-town' });
  const end = button(strings.endComparison, () => void comparison.end().catch(failed), { 'data-do': 'end-comparison' });
  const slider = h('input', { type: 'range', min: 0, max: 100, step: 1, value: 50, 'data-do': 'split', oninput: () => { comparison.at = slider.valueAsNumber / 100; place(); } });
  const sides = h('p', { class: 'quiet', role: 'status' }), counts = h('p', { class: 'quiet' }), list = h('ul', { class: 'list skipped' });
  const compared = h('div', { hidden: true }, sides, field(strings.splitAt, slider), counts, list);
  const element = collapsible('comparison', strings.comparison, false, h('p', { class: 'quiet' }, strings.comparisonHelp), keep, end, compared);
  element.hidden = true;
  // The line over the view.
  const line = h('div', { class: 'split-line', 'aria-hidden': 'true', hidden: true });
  app.renderer.viewport.canvas.parentElement?.append(line);
  const place = () => { line.style.left = `${comparison.at * 100}%`; };
  const failed = (error: Error) => app.announce(strings.failed + error.message);
  let shown: unknown = null;
  const fill = () => {
    const { state } = app.town, { kept, difference } = comparison;
    element.hidden = !state || !(app.state?.parameters.length);
    end.hidden = compared.hidden = line.hidden = kept === null;
    keep.disabled = !state?.tileset;
    place();
    if (!kept) return;
    sides.textContent = strings.twoSides(kept.label, comparison.label());
    counts.textContent = difference ? strings.differences(difference.total, difference.same) : '';
    if (shown === difference) return;
    shown = difference;
    const rows = (difference?.list ?? []).map(one => h('li', {}, row(app, one)));
    const more = (difference?.total ?? 0) - rows.length;
    list.replaceChildren(...rows, ...more > 0 ? [h('li', { class: 'quiet' }, strings.andMore(more))] : []);
  };
  app.on('town', fill);
  app.on('state', fill);
  return element;
}

/** A feature that differs: a click leads to it. */
function row(app: App, { layer, key, before, after }: Changed): HTMLElement {
  return h('button', { type: 'button', class: 'row', onclick: () => void app.town.goTo(layer, key) },
    h('span', { class: 'key' }, `${layer} ${key}`), ' ', h('span', { class: 'text' }, `${before || strings.nothing} → ${after || strings.nothing}`));
}
