// Details of the selected part: what it is, where it is, where it is written.

import type { App } from '../app.ts';
import { button, h } from '../ui/dom.ts';
import { formatLength } from '../ui/lengths.ts';
import * as THREE from 'three';
import { strings } from '../ui/strings.ts';

export function partCard(app: App): HTMLElement {
  const element = h('section', { class: 'card', 'aria-label': strings.part, hidden: true });
  const show = () => {
    const part = app.selection === null ? undefined : app.model?.parts[app.selection];
    element.hidden = !part;
    if (!part) return;
    const location = app.locationOf(app.selection!), line = location && app.lineAt(location);
    const size = part.box.isEmpty() ? null : part.box.getSize(new THREE.Vector3());
    const code = part.code?.trim(), names = code && app.names.get(code); // Posts, tiles and roofs have no code, and a void's is empty.
    const rows: [string, string | null | undefined][] = [
      [strings.code, code], [strings.name, names || part.name],
      [strings.place, [part.storey > 0 ? strings.storey(part.storey) : '', part.facade !== null && part.kind !== 'facade'
        ? `${strings.kind.facade} ${app.model!.parts[part.facade]!.name.replace(/^facade /, '')}` : ''].filter(Boolean).join(strings.comma)],
      [strings.shape, part.shape],
      [strings.size, size && [size.x, size.y, size.z].map(n => n.toFixed(2)).join(' × ') + ` m · ${formatLength(size.y).shaku} ↕`],
      [strings.line, line && `${line.line}`],
    ];
    const title = code || `${strings.kind[part.kind] ?? part.kind} ${part.name}`;
    element.replaceChildren(
      h('h2', {}, title), button('×', () => app.select(null), { class: 'close', 'aria-label': strings.close }),
      h('dl', {}, ...rows.filter(([, value]) => value).flatMap(([name, value]) => [h('dt', {}, name), h('dd', {}, value!)])),
      ...(line ? [h('pre', { class: 'line', 'aria-label': strings.sourceLine }, h('code', {}, line.text))] : []),
      h('div', { class: 'buttons' },
        location && app.serverInfo.opens && button(strings.open, () => void app.open(location), { 'data-do': 'open' }),
        location && button(strings.showText, () => app.showSource(location), { 'data-do': 'text' }),
        button(strings.frameIt, () => app.look('above', app.selection), { 'data-do': 'near' })));
  };
  app.on('select', show);
  return element;
}
