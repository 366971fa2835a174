// The parts as a tree of houses, storeys, walls and parts, with the usual arrow keys, so that every part can be selected
// without a mouse.

import type { App } from '../app.ts';
import { h } from '../ui/dom.ts';
import { childrenOf } from '../model/parts.ts';
import { strings } from '../ui/strings.ts';
import { collapsible } from './collapsible.ts';

export function partTree(app: App): HTMLElement {
  const root = h('ul', { role: 'tree', class: 'tree', 'aria-label': strings.parts });
  let below = new Map<number, number[]>(), open = new Set<string>(), current: number | null = null;
  const element = collapsible('parts', strings.parts, false, h('p', { class: 'quiet' }, strings.partsHelp), root);

  /** Expanded branches are remembered by their position, since part indices change between revisions. */
  const place = (part: number): string => {
    const { parent, kind, storey, house } = app.model!.parts[part]!;
    return `${house}/${storey}/${kind}/${(below.get(parent ?? -1) ?? []).indexOf(part)}/${parent === null ? '' : place(parent)}`;
  };
  const item = (part: number, level: number, index: number, of: number): HTMLLIElement => {
    const children = below.get(part) ?? [], { name, code, kind } = app.model!.parts[part]!;
    const opened = children.length > 0 && open.has(place(part));
    const label = kind === 'part' ? code?.trim() || name : [strings.kind[kind] ?? kind, name].filter(Boolean).join(' ');
    return h('li', {
      role: 'treeitem', 'data-part': part, 'aria-level': level, 'aria-posinset': index + 1, 'aria-setsize': of,
      'aria-expanded': children.length ? `${opened}` : null, 'aria-selected': `${part === app.selection}`,
      tabindex: part === current ? 0 : -1,
    }, h('span', { class: `label ${kind}` }, label),
    opened && h('ul', { role: 'group' }, ...children.map((child, i) => item(child, level + 1, i, children.length))));
  };
  const fill = () => {
    if (!app.model) { root.replaceChildren(); return; }
    const roots = below.get(-1) ?? [];
    if (current === null || !app.model.parts[current]) current = roots[0] ?? null;
    if (element.open) root.replaceChildren(...roots.map((part, i) => item(part, 1, i, roots.length)));
  };
  const row = (part: number | null) => part === null ? null : root.querySelector<HTMLElement>(`[data-part="${part}"]`);
  const go = (part: number | null | undefined) => {
    const to = row(part ?? null);
    if (!to) return;
    row(current)?.setAttribute('tabindex', '-1');
    current = part!;
    to.setAttribute('tabindex', '0');
    to.focus();
    app.highlight(app.locationOf(part!));
    app.renderer.pointed.set(app.model, [part!]);
  };
  const toggle = (part: number, on: boolean) => {
    if (on) open.add(place(part)); else open.delete(place(part));
    fill();
    go(part);
  };
  const key = (event: KeyboardEvent) => {
    if (current === null || !app.model) return;
    const rows = [...root.querySelectorAll<HTMLElement>('[role=treeitem]')].map(li => Number(li.dataset.part));
    const at = rows.indexOf(current), children = below.get(current) ?? [], isOpen = open.has(place(current));
    switch (event.key) {
      case 'ArrowDown': go(rows[at + 1]); break;
      case 'ArrowUp': go(rows[at - 1]); break;
      case 'Home': go(rows[0]); break;
      case 'End': go(rows.at(-1)); break;
      case 'ArrowRight': if (children.length) if (isOpen) go(children[0]); else toggle(current, true); break;
      case 'ArrowLeft': if (children.length && isOpen) toggle(current, false); else go(app.model.parts[current]!.parent); break;
      case 'Enter': case ' ': app.select(current); break;
      default: return;
    }
    event.preventDefault();
    event.stopPropagation();
  };
  root.addEventListener('keydown', key);
  root.addEventListener('click', event => {
    const li = (event.target as Element).closest<HTMLElement>('[role=treeitem]');
    if (!li) return;
    const part = Number(li.dataset.part);
    current = part;
    if (li.getAttribute('aria-expanded') === 'false') open.add(place(part));
    app.select(part);
  });
  app.on('model', () => {
    current = null;
    below = app.model ? childrenOf(app.model) : new Map();
    fill();
  });
  app.on('select', () => {
    if (app.selection !== null && app.model) {
      for (let at = app.model.parts[app.selection]!.parent; at !== null; at = app.model.parts[at]!.parent) open.add(place(at));
      current = app.selection;
    }
    const focused = root.contains(document.activeElement);
    fill();
    const to = row(app.selection);
    if (focused) to?.focus();
    to?.scrollIntoView({ block: 'nearest' });
  });
  element.addEventListener('toggle', fill);
  return element;
}
