// A town: how far its build is, how many features are built, a search by key, and what was skipped.

import type { App } from '../app.ts';
import { button, field, h } from '../ui/dom.ts';
import type { Skipped } from '../server/api.ts';
import { strings } from '../ui/strings.ts';
import { collapsible } from './collapsible.ts';

/** Progress of the build, above all else in the panel. */
export function townProgress(app: App): HTMLElement {
  const bar = h('progress', { 'aria-label': strings.townBuild }), phase = h('span', {});
  const element = h('div', { class: 'building', hidden: true }, phase, bar);
  app.on('town', () => {
    const { progress, state } = app.town;
    element.hidden = !state || !progress;
    if (!progress) return;
    phase.textContent = strings.townPhase[progress.phase] + (progress.of ? ` ${progress.done} / ${progress.of}` : '');
    bar.hidden = progress.phase === 'failed';
    bar.max = Math.max(1, progress.of);
    if (progress.of) bar.value = progress.done; else bar.removeAttribute('value');
  });
  return element;
}

export function townPanel(app: App): HTMLElement {
  const counts = h('p', { class: 'quiet' }), none = h('p', { class: 'quiet', role: 'status' });
  const key = h('input', { type: 'search', 'data-do': 'find-key' });
  const form = h('form', { class: 'find', onsubmit: (event: Event) => { event.preventDefault(); void find(); } }, field(strings.townFind, key, button(strings.townGo, () => void find(), { 'data-do': 'find' })));
  const list = h('ul', { class: 'list skipped' }), heading = h('h3', {}, strings.townSkipped), more = h('p', { class: 'quiet' });
  const element = collapsible('town', strings.town, true, counts, form, none, heading, list, more);
  const find = async () => {
    const wanted = key.value.trim();
    if (!wanted) return;
    const found = await app.town.goTo('', wanted);
    none.textContent = found ? '' : strings.townNotFound(wanted);
  };
  let shown: unknown = null;
  app.on('town', () => {
    const { state, skipped } = app.town;
    element.hidden = !state;
    if (!state) return;
    counts.textContent = state.features === 0 ? '' : strings.townCounts(state.features, state.built, state.skipped) + (state.whole ? '' : ` ${strings.townNotWhole}`);
    heading.hidden = skipped.total === 0;
    more.textContent = skipped.total > skipped.list.length ? strings.townMore(skipped.total - skipped.list.length) : '';
    if (shown === skipped) return;
    shown = skipped;
    list.replaceChildren(...skipped.list.map(one => h('li', {}, row(app, one))));
  });
  return element;
}

/** A skipped feature: a click leads to its place, and to the rule that skips it. */
function row(app: App, { layer, key, code, reason, rule, at }: Skipped): HTMLElement {
  const go = () => {
    void app.town.goTo(layer, key);
    const location = app.ruleLocation(rule);
    if (location) app.showSource(location);
  };
  const words = [h('span', { class: 'key' }, `${layer} ${key}`), ' ', h('span', { class: 'code' }, code), ' ', h('span', { class: 'text' }, reason)];
  // What cannot be read has no place.
  return at ? h('button', { type: 'button', class: 'row', onclick: go }, ...words) : h('div', { class: 'row' }, ...words);
}
