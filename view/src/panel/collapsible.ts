// A collapsible section of the panel.

import { h } from '../ui/dom.ts';

/** Its state is kept in local storage. */
export function collapsible(name: string, title: string, open: boolean, ...children: Node[]): HTMLDetailsElement {
  const kept = localStorage.getItem(`hsd-fold-${name}`);
  const element = h('details', { class: 'fold', 'data-fold': name, open: kept === null ? open : kept === '1' },
    h('summary', {}, h('h2', {}, title)), h('div', { class: 'inside' }, ...children));
  element.addEventListener('toggle', () => localStorage.setItem(`hsd-fold-${name}`, element.open ? '1' : '0'));
  return element;
}
