// The bar of tools: which panes are shown, where the model is looked at from, the turntable, a picture of what is seen.

import type { App } from './app.ts';
import { button, download, h } from './dom.ts';
import { VIEWS } from './views.ts';
import { words } from './words.ts';

/** A button that is on or off. */
export function switch_of(label: string, then: (on: boolean) => void, name: string): HTMLButtonElement {
  const element = button(label, () => then(element.getAttribute('aria-pressed') !== 'true'), { 'aria-pressed': 'false', 'data-do': name });
  return element;
}

export interface Panes {
  panes: { name: string; label: string; element: HTMLElement }[];
  panel: HTMLElement;
  changed: () => void;
}

export function toolbar(app: App, { panes, panel, changed }: Panes): HTMLElement {
  const narrow = matchMedia('(max-width: 720px)');
  const switches = panes.map(({ name, label, element }) => ({ element, name, button: switch_of(label, on => show(element, on), name) }));
  const show = (element: HTMLElement, on: boolean) => {
    // Where there is room for one only, another one goes.
    for (const { element: other } of switches) {
      if (other === element) other.hidden = !on; else if (on && narrow.matches) other.hidden = true;
    }
    if (switches.every(({ element: e }) => e.hidden)) switches[on ? 0 : switches.findIndex(s => s.element !== element)]!.element.hidden = false;
    tell();
  };
  const panel_switch = switch_of(words.panel, on => { panel.hidden = !on; tell(); }, 'panel');
  const tell = () => {
    for (const { element, button } of switches) button.setAttribute('aria-pressed', `${!element.hidden}`);
    panel_switch.setAttribute('aria-pressed', `${!panel.hidden}`);
    changed();
  };
  app.on('shown', () => turn.setAttribute('aria-pressed', `${app.turntable.on}`));
  const turn = switch_of(words.turntable, on => {
    app.turntable.set(on);
    turn.setAttribute('aria-pressed', `${on}`);
  }, 'turntable');
  const views = h('select', { 'aria-label': words.views, 'data-do': 'view', onchange: () => {
    if (views.value) app.look(views.value as (typeof VIEWS)[number]);
  } }, h('option', { value: '' }, words.views), ...VIEWS.map(view => h('option', { value: view }, words.view[view])));
  // The view is left as soon as the eye moves.
  app.stage.controls.addEventListener('change', () => { if (!app.looking) views.value = ''; });
  const bar = h('div', { class: 'toolbar', role: 'toolbar', 'aria-label': words.tools },
    h('h1', { class: 'brand' }, h('b', {}, 'hsd'), ' ', h('span', { class: 'title' })),
    h('div', { class: 'group', role: 'group', 'aria-label': words.show }, ...switches.map(({ button }) => button)),
    h('div', { class: 'group', role: 'group', 'aria-label': words.views }, views, turn,
      button(words.reset, () => app.reset(), { 'data-do': 'reset' }),
      button(words.screenshot, () => void screenshot(app), { title: words.screenshot_how, 'data-do': 'screenshot' })),
    panel_switch);
  app.on('files', () => { bar.querySelector('.title')!.textContent = app.file ?? app.hello.root; });
  narrow.addEventListener('change', () => { if (narrow.matches) show(switches.find(s => !s.element.hidden)!.element, true); });
  tell();
  return Object.assign(bar, { show });
}

/** A picture of what is seen, to keep. */
export async function screenshot(app: App) {
  app.stage.frame();
  const blob = await new Promise<Blob | null>(done => app.stage.canvas.toBlob(done, 'image/png'));
  if (!blob) return;
  const name = (app.file ?? 'house').split(/[\\/]/).pop()!.replace(/\.[^.]*$/, '');
  download(blob, `${name}.png`);
  app.announce(words.saved);
}
