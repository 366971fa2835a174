// Storeys and roofs, each shown or not.

import type { App } from '../app.ts';
import { button, h, tick } from '../dom.ts';
import { words } from '../words.ts';
import { fold } from './fold.ts';

export function shown(app: App): HTMLElement {
  const list = h('fieldset', {});
  const fill = () => {
    const layers = app.layers();
    const roofs = layers.filter(layer => layer.startsWith('roof'));
    const ticks = layers.map(layer => {
      const [kind, number] = layer.split(' ');
      const label = kind === 'storey' ? words.storey(Number(number)) : kind === 'roof'
        ? roofs.length === 1 || number === '0' ? words.roofs : words.roofs_of(Number(number)) : words.other;
      const box = tick(label, !app.hidden.has(layer), on => app.hide(layer, !on));
      box.dataset.layer = layer;
      return box;
    });
    list.replaceChildren(h('legend', { class: 'hidden' }, words.shown), ...ticks);
  };
  app.on('model', fill);
  app.on('shown', () => {
    for (const label of list.querySelectorAll('label')) label.querySelector('input')!.checked = !app.hidden.has(label.dataset.layer!);
  });
  const all = button(words.all, () => { for (const layer of [...app.hidden]) app.hide(layer, false); });
  return fold('shown', words.shown, true, list, all);
}
