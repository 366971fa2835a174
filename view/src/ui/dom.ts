// Short constructors for DOM elements.

type Child = Node | string | number | null | undefined | false;
type Attributes = Record<string, string | number | boolean | null | undefined | ((event: never) => void)>;

function build<E extends Element>(element: E, attributes: Attributes, children: Child[]): E {
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

/** Creates an HTML element; attributes whose names begin with `on` are event listeners. */
export function h<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]) {
  return build(document.createElement(tag), attributes, children);
}

/** Creates an SVG element. */
export function s<K extends keyof SVGElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]) {
  return build(document.createElementNS('http://www.w3.org/2000/svg', tag), attributes, children);
}

let numbers = 0;
/** Returns an id that is unique in the document. */
export const newId = () => `n${++numbers}`;

/** A form field with its label. */
export function field(label: string, input: HTMLElement, ...rest: Child[]): HTMLElement {
  if (!input.id) input.id = newId();
  return h('div', { class: 'field' }, h('label', { for: input.id }, label), input, ...rest);
}

/** A checkbox with its label. */
export function checkbox(label: string, checked: boolean, then: (on: boolean) => void): HTMLLabelElement & { box: HTMLInputElement } {
  const box = h('input', { type: 'checkbox', checked, onchange: () => then(box.checked) });
  return Object.assign(h('label', { class: 'tick' }, box, h('span', {}, label)), { box });
}

export function button(label: string, then: (event: MouseEvent) => void, more: Attributes = {}): HTMLButtonElement {
  return h('button', { type: 'button', onclick: then as (event: never) => void, ...more }, label);
}

/** True where the element takes keyboard input itself. */
export const isField = (target: EventTarget | null) =>
  target instanceof HTMLInputElement || target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement;

export function download(blob: Blob, name: string) {
  const url = URL.createObjectURL(blob);
  const link = h('a', { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
