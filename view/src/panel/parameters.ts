// The parameters of a file: what is set here holds while the preview runs; the text keeps its defaults.

import type { App } from '../app.ts';
import { setParameters, type Parameter } from '../server/api.ts';
import { button, field, h, checkbox, newId } from '../ui/dom.ts';
import { strings } from '../ui/strings.ts';
import { collapsible } from './collapsible.ts';

/** How long a value must stand before it is sent, ms: a slider that moves sends the last one. */
const SETTLED = 200;

/** The control of a parameter. */
interface Control {
  element: HTMLElement;
  read: () => string;
  write: (value: string) => void;
}

export function parameterPanel(app: App): HTMLElement {
  const list = h('div', { class: 'parameters' });
  const reset = button(strings.usualValues, () => send({}));
  const panel = collapsible('parameters', strings.parameters, true, list, reset);
  panel.hidden = true;
  let shown: Parameter[] = [], controls: Control[] = [], timer = 0, made = '';

  const send = (values: Record<string, string>) => {
    clearTimeout(timer);
    const { file } = app;
    if (file === null) return;
    setParameters(file, values).catch((error: Error) => app.announce(strings.failed + error.message));
  };
  const changed = () => {
    const pairs = shown.map((parameter, n) => [parameter, controls[n]!.read()] as const);
    send(Object.fromEntries(pairs.filter(([parameter, value]) => value !== parameter.default).map(([{ name }, value]) => [name, value])));
  };
  const soon = () => {
    clearTimeout(timer);
    timer = window.setTimeout(changed, SETTLED);
  };

  const fill = () => {
    shown = app.state?.parameters ?? [];
    panel.hidden = shown.length === 0;
    const now = JSON.stringify([app.file, shown.map(({ value: _, ...rest }) => rest)]);
    if (now !== made) {
      made = now;
      controls = shown.map(parameter => control(parameter, soon));
      list.replaceChildren(...controls.map(({ element }) => element));
    }
    shown.forEach(({ value }, n) => {
      const own = controls[n]!;
      // A slider in the hand is not moved.
      if (!own.element.contains(document.activeElement) || !panel.contains(document.activeElement)) own.write(value);
    });
    reset.disabled = shown.every(({ value, default: usual }) => value === usual);
  };
  app.on('state', fill);
  app.on('files', () => { if (app.state === null) panel.hidden = true; });
  return panel;
}

/** Makes the control of a parameter: a tick, a list, a slider where both ends are known, or a field. */
function control(parameter: Parameter, changed: () => void): Control {
  const { name, unit, doc, choices, kind, min, max, step } = parameter;
  const label = unit ? `${name} (${unit})` : name;
  const described = (input: HTMLElement, ...rest: Node[]) => {
    const about = doc ? h('p', { class: 'quiet', id: newId() }, doc) : null;
    if (about) input.setAttribute('aria-describedby', about.id);
    return h('div', { class: 'parameter', 'data-parameter': name }, field(label, input, ...rest), about);
  };
  if (choices.length) {
    const select = h('select', { onchange: changed }, ...choices.map(choice => h('option', { value: choice }, choice)));
    return { element: described(select), read: () => select.value, write: value => { select.value = value; } };
  }
  if (kind === 'truth') {
    const tick = checkbox(label, false, changed);
    const about = doc ? h('p', { class: 'quiet', id: newId() }, doc) : null;
    if (about) tick.box.setAttribute('aria-describedby', about.id);
    return {
      element: h('div', { class: 'parameter', 'data-parameter': name }, tick, about),
      read: () => tick.box.checked ? 'yes' : 'no', write: value => { tick.box.checked = value === 'yes'; },
    };
  }
  if (kind === 'number' && min !== null && max !== null) {
    const out = h('output', {}), tell = () => { out.textContent = slider.value; };
    const slider = h('input', { type: 'range', min, max, step: step ?? 'any', oninput: () => { tell(); changed(); } });
    return { element: described(slider, out), read: () => `${slider.valueAsNumber}`, write: value => { slider.value = value; tell(); } };
  }
  const input = h('input', kind === 'number' ? { type: 'number', min, max, step: step ?? 'any', onchange: changed } : { type: 'text', onchange: changed });
  return { element: described(input), read: () => input.value, write: value => { input.value = value; } };
}
