// The card of the part that is selected: what it is, where it stands, where it is written.

import type { App } from '../app.ts';
import { button, h } from '../dom.ts';
import { length_words } from '../lengths.ts';
import * as THREE from 'three';
import { words } from '../words.ts';

export function card(app: App): HTMLElement {
  const element = h('section', { class: 'card', 'aria-label': words.part, hidden: true });
  const show = () => {
    const part = app.selection === null ? undefined : app.model?.parts[app.selection];
    element.hidden = !part;
    if (!part) return;
    const spot = app.spot_of(app.selection!), line = spot && app.line_of(spot);
    const size = part.box.isEmpty() ? null : part.box.getSize(new THREE.Vector3());
    const names = app.names.get(part.code?.trim() ?? '');
    const rows: [string, string | null | undefined][] = [
      [words.code, part.code?.trim()], [words.name, names ?? part.name],
      [words.place, [part.storey > 0 ? words.storey(part.storey) : '', part.facade !== null && part.kind !== 'facade'
        ? `${words.kind.facade} ${app.model!.parts[part.facade]!.name.replace(/^facade /, '')}` : ''].filter(Boolean).join(words.comma)],
      [words.shape, part.shape],
      [words.size, size && [size.x, size.y, size.z].map(n => n.toFixed(2)).join(' × ') + ` m · ${length_words(size.y).shaku} ↕`],
      [words.line, line && `${line.line}`],
    ];
    const title = part.code?.trim() || `${words.kind[part.kind] ?? part.kind} ${part.name}`;
    element.replaceChildren(
      h('h2', {}, title), button('×', () => app.select(null), { class: 'close', 'aria-label': words.close }),
      h('dl', {}, ...rows.filter(([, value]) => value).flatMap(([name, value]) => [h('dt', {}, name), h('dd', {}, value!)])),
      ...(line ? [h('pre', { class: 'line', 'aria-label': words.source_line }, h('code', {}, line.text))] : []),
      h('div', { class: 'buttons' },
        spot && app.hello.opens && button(words.open, () => void app.open(spot), { 'data-do': 'open' }),
        spot && button(words.show_text, () => app.show_text(spot), { 'data-do': 'text' }),
        button(words.frame_it, () => app.look('above', app.selection), { 'data-do': 'near' })));
  };
  app.on('select', show);
  return element;
}
