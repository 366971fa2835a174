// A part of the panel that folds away under its heading.

import { h } from '../dom.ts';

/** Which are open is kept in the browser, so that a page opened again is as it was left. */
export function fold(name: string, title: string, open: boolean, ...children: Node[]): HTMLDetailsElement {
  const kept = localStorage.getItem(`hsd-fold-${name}`);
  const element = h('details', { class: 'fold', 'data-fold': name, open: kept === null ? open : kept === '1' },
    h('summary', {}, h('h2', {}, title)), h('div', { class: 'inside' }, ...children));
  element.addEventListener('toggle', () => localStorage.setItem(`hsd-fold-${name}`, element.open ? '1' : '0'));
  return element;
}
