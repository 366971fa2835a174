// The parts that can be set, with their pictures.

import type { App } from '../app.ts';
import { field, h } from '../dom.ts';
import { type Palette as Entry, palette, picture_of } from '../server.ts';
import { words } from '../words.ts';

export class Palette {
  readonly element: HTMLElement;
  /** What is to be set. */
  chosen: Entry | null = null;
  /** Told when another part is chosen. */
  changed: () => void = () => {};
  #app: App;
  #list = h('ul', { class: 'palette', 'aria-label': words.palette });
  #filter = h('input', { type: 'search', oninput: () => this.#fill() });
  #entries: Entry[] = [];
  #file: string | null = null;

  constructor(app: App) {
    this.#app = app;
    this.element = h('div', { class: 'parts' }, field(words.filter_parts, this.#filter), this.#list);
  }

  /** Reads the parts of the file once. */
  async fill() {
    const { file } = this.#app;
    if (file === null || file === this.#file) return;
    const entries = await palette(file).catch(() => null);
    if (file !== this.#app.file) return;
    this.#file = entries && file; // asked for again if it failed
    this.#entries = entries ?? [];
    this.chosen = null;
    this.#fill();
  }

  #fill() {
    const wanted = this.#filter.value.toLowerCase();
    const found = this.#entries.filter(entry => [entry.code, entry.en, entry.ja, entry.romaji].some(name => name?.toLowerCase().includes(wanted)));
    this.#list.replaceChildren(...found.map(entry => this.#row(entry)), ...(found.length ? [] : [h('li', { class: 'quiet' }, words.no_parts)]));
  }

  #row(entry: Entry): HTMLElement {
    const { code } = entry, picture = h('img', { src: picture_of(this.#app.file!, code), alt: '', loading: 'lazy', width: 40, height: 40 });
    picture.addEventListener('error', () => { picture.classList.add('none'); }); // of a void there is nothing to see
    const choose = () => {
      this.chosen = entry;
      for (const button of this.#list.querySelectorAll('button')) button.setAttribute('aria-pressed', `${button.dataset.code === code}`);
      this.changed();
    };
    return h('li', {}, h('button', { type: 'button', onclick: choose, 'data-code': code, 'aria-pressed': `${this.chosen?.code === code}` },
      picture, h('span', { class: 'part-code' }, code.trim() || '—'), h('span', { class: 'part-name' }, name_of(entry))));
  }
}

/** Its name in the language of the page. */
export const name_of = ({ en, ja, code }: Entry) => (document.documentElement.lang === 'ja' ? ja : en) || code;
