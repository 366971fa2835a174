// Details of the selected feature of a town: what its map and its rule say, what stands on it, and why there.

import type { App } from '../app.ts';
import { button, h } from '../ui/dom.ts';
import { strings } from '../ui/strings.ts';
import { placeText } from '../town/town.ts';

export function featureCard(app: App): HTMLElement {
  const element = h('section', { class: 'feature-card', 'aria-label': strings.feature, hidden: true });
  const show = () => {
    const { selected, ground } = app.town, close = () => button('×', () => app.town.clearSelection(), { class: 'close', 'aria-label': strings.close });
    element.hidden = !selected && !ground;
    if (!selected && ground) element.replaceChildren(h('h2', {}, strings.ground), close(), h('p', { class: 'ground-place' }, placeText(ground)));
    if (!selected) return;
    const { house, decision, face } = selected, rule = house?.rule || Number(decision?.['rule'] ?? 0);
    const location = app.lineLocation(house?.line ?? 0) ?? app.ruleLocation(rule), line = location && app.lineAt(location);
    const of = (name: string) => decision?.[name];
    const metres = (name: string) => of(name) && `${Number(of(name)).toFixed(2)} m`;
    const size = [metres('width'), metres('depth')].filter(Boolean).join(' × ');
    const rows: [string, string | undefined | false | null][] = [
      [strings.layer, selected.layer], [strings.type, house?.type || of('type')], [strings.year, house?.year],
      [strings.face, face && [face.scenario, strings.faceRule(face.rule), face.arithmetic, `${face.height.toFixed(2)} m`].filter(Boolean).join(': ')],
      [strings.evidence, house?.evidence],
      [strings.rule, rule > 0 && `${rule}${house?.line ? strings.comma + strings.lineNumber(house.line) : ''}`],
      [strings.parameters, of('parameters') || house?.parameters],
      [strings.what, [of('what'), of('why')].filter(Boolean).join(': ')],
      [strings.facing, of('facing') && `${Math.round(Number(of('facing')))}°`], [strings.plot, size], [strings.access, of('access')],
      [strings.measures, of('measures')],
    ];
    element.replaceChildren(
      h('h2', {}, selected.key), close(),
      h('dl', {}, ...rows.filter(([, value]) => value).flatMap(([name, value]) => [h('dt', {}, name), h('dd', {}, value as string)])),
      ...(line ? [h('pre', { class: 'line', 'aria-label': strings.sourceLine, tabindex: 0 }, h('code', {}, line.text.trim()))] : []),
      h('div', { class: 'buttons' },
        location && app.serverInfo.opens && button(strings.open, () => void app.open(location), { 'data-do': 'open' }),
        location && button(strings.showText, () => app.showSource(location), { 'data-do': 'text' }),
        button(strings.frameHouse, () => app.town.lookAtSelected(), { 'data-do': 'near' }),
        of('front_x1') && button(strings.fromStreet, () => app.town.standBefore(), { 'data-do': 'street' })));
  };
  app.on('town', show);
  app.on('state', show);
  return element;
}
