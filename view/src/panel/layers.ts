// Visibility of storeys and roofs.

import type { App } from '../app.ts';
import { button, h, checkbox } from '../ui/dom.ts';
import { strings } from '../ui/strings.ts';
import { collapsible } from './collapsible.ts';

export function layerPanel(app: App): HTMLElement {
  const list = h('fieldset', {});
  const fill = () => {
    const layers = app.layers();
    const roofs = layers.filter(layer => layer.startsWith('roof'));
    const ticks = layers.map(layer => {
      const [kind, number] = layer.split(' ');
      const label = kind === 'storey' ? strings.storey(Number(number)) : kind === 'roof'
        ? roofs.length === 1 || number === '0' ? strings.roofs : strings.roofsOf(Number(number)) : strings.other;
      const box = checkbox(label, !app.hidden.has(layer), on => app.hide(layer, !on));
      box.dataset.layer = layer;
      return box;
    });
    list.replaceChildren(h('legend', { class: 'hidden' }, strings.shown), ...ticks);
  };
  app.on('model', fill);
  app.on('shown', () => {
    for (const label of list.querySelectorAll('label')) label.querySelector('input')!.checked = !app.hidden.has(label.dataset.layer!);
  });
  const all = button(strings.all, () => { for (const layer of [...app.hidden]) app.hide(layer, false); });
  return collapsible('shown', strings.shown, true, list, all);
}
