// The toolbar: visible panes, camera views, turntable, screenshot.

import type { App } from '../app.ts';
import { button, download, h } from './dom.ts';
import { VIEWS } from '../scene/views.ts';
import { strings } from './strings.ts';

/** A toggle button. */
export function toggleButton(label: string, then: (on: boolean) => void, name: string): HTMLButtonElement {
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
  const switches = panes.map(({ name, label, element }) => ({ element, name, button: toggleButton(label, on => show(element, on), name) }));
  const show = (element: HTMLElement, on: boolean) => {
    // Where there is room for only one pane, it replaces the others.
    for (const { element: other } of switches) {
      if (other === element) other.hidden = !on; else if (on && narrow.matches) other.hidden = true;
    }
    if (switches.every(({ element: e }) => e.hidden)) switches[on ? 0 : switches.findIndex(s => s.element !== element)]!.element.hidden = false;
    update();
  };
  const panelSwitch = toggleButton(strings.panel, on => { panel.hidden = !on; update(); }, 'panel');
  const update = () => {
    for (const { element, button } of switches) button.setAttribute('aria-pressed', `${!element.hidden}`);
    panelSwitch.setAttribute('aria-pressed', `${!panel.hidden}`);
    changed();
  };
  const walk = toggleButton(strings.walk, on => {
    if (!on) return app.walk.leave();
    if (app.walk.start()) app.renderer.viewport.canvas.focus();
  }, 'walk');
  app.on('walk', () => walk.setAttribute('aria-pressed', `${app.walk.on}`));
  app.on('shown', () => turn.setAttribute('aria-pressed', `${app.renderer.turntable.on}`));
  const turn = toggleButton(strings.turntable, on => {
    app.renderer.turntable.set(on);
    turn.setAttribute('aria-pressed', `${on}`);
  }, 'turntable');
  const views = h('select', { 'aria-label': strings.views, 'data-do': 'view', onchange: () => {
    if (views.value) app.look(views.value as (typeof VIEWS)[number]);
  } }, h('option', { value: '' }, strings.views), ...VIEWS.map(view => h('option', { value: view }, strings.view[view])));
  // Moving the camera leaves the preset view.
  app.renderer.viewport.controls.addEventListener('change', () => { if (!app.movingToView) views.value = ''; });
  const bar = h('div', { class: 'toolbar', role: 'toolbar', 'aria-label': strings.tools },
    h('h1', { class: 'brand' }, h('b', {}, 'hsd'), ' ', h('span', { class: 'title' })),
    h('div', { class: 'group', role: 'group', 'aria-label': strings.show }, ...switches.map(({ button }) => button)),
    h('div', { class: 'group', role: 'group', 'aria-label': strings.views }, views, turn, walk,
      button(strings.reset, () => app.reset(), { 'data-do': 'reset' }),
      button(strings.screenshot, () => void screenshot(app), { title: strings.screenshotHelp, 'data-do': 'screenshot' })),
    panelSwitch);
  app.on('files', () => { bar.querySelector('.title')!.textContent = app.file ?? app.serverInfo.root; });
  narrow.addEventListener('change', () => { if (narrow.matches) show(switches.find(s => !s.element.hidden)!.element, true); });
  update();
  return Object.assign(bar, { show });
}

/** Downloads an image of the current view. */
export async function screenshot(app: App) {
  app.renderer.viewport.frame();
  const blob = await new Promise<Blob | null>(done => app.renderer.viewport.canvas.toBlob(done, 'image/png'));
  if (!blob) return;
  const name = (app.file ?? 'house').split(/[\\/]/).pop()!.replace(/\.[^.]*$/, '');
  download(blob, `${name}.png`);
  app.announce(strings.saved);
}
