// Elements in few words.

type Child = Node | string | number | null | undefined | false;
type Attributes = Record<string, string | number | boolean | null | undefined | ((event: never) => void)>;

function filled<E extends Element>(element: E, attributes: Attributes, children: Child[]): E {
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') element.addEventListener(name.slice(2), value as EventListener);
    else if (value === true) element.setAttribute(name, '');
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, `${value}`);
  }
  for (const child of children) {
    if (child !== null && child !== undefined && child !== false) element.append(child instanceof Node ? child : `${child}`);
  }
  return element;
}

/** An element; attributes whose names begin with `on` are listeners. */
export function h<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]) {
  return filled(document.createElement(tag), attributes, children);
}

/** An element of SVG. */
export function s<K extends keyof SVGElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]) {
  return filled(document.createElementNS('http://www.w3.org/2000/svg', tag), attributes, children);
}

let numbers = 0;
/** A name that no other element has. */
export const new_id = () => `n${++numbers}`;

/** A field with its label. */
export function field(label: string, input: HTMLElement, ...rest: Child[]): HTMLElement {
  if (!input.id) input.id = new_id();
  return h('div', { class: 'field' }, h('label', { for: input.id }, label), input, ...rest);
}

/** A box to tick, with its label. */
export function tick(label: string, checked: boolean, then: (on: boolean) => void): HTMLLabelElement & { box: HTMLInputElement } {
  const box = h('input', { type: 'checkbox', checked, onchange: () => then(box.checked) });
  return Object.assign(h('label', { class: 'tick' }, box, h('span', {}, label)), { box });
}

export function button(label: string, then: (event: MouseEvent) => void, more: Attributes = {}): HTMLButtonElement {
  return h('button', { type: 'button', onclick: then as (event: never) => void, ...more }, label);
}

/** Whether this is written in a field, so that keys are not ours. */
export const is_field = (target: EventTarget | null) =>
  target instanceof HTMLInputElement || target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement;

export function download(blob: Blob, name: string) {
  const url = URL.createObjectURL(blob);
  const link = h('a', { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
