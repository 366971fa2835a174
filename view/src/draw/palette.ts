// The parts that can be set, with their pictures. Those are drawn when they are asked for, which takes a while: they come
// a few at a time, as they come into sight, so that no stroke has to wait behind them.

import type { App } from '../app.ts';
import { field, h } from '../dom.ts';
import { type Palette as Entry, palette, picture_of } from '../server.ts';
import { words } from '../words.ts';

/** Pictures that are on their way at once. */
const AT_ONCE = 2;

/** Fetches pictures as they come into sight. */
class Pictures {
  #waiting: HTMLImageElement[] = [];
  #coming = 0;
  #sight = new IntersectionObserver(seen => {
    for (const { isIntersecting, target } of seen) {
      if (!isIntersecting) continue;
      this.#sight.unobserve(target);
      this.#waiting.push(target as HTMLImageElement);
    }
    this.#next();
  });

  /** An image of this address. */
  of(address: string): HTMLImageElement {
    const image = h('img', { alt: '', width: 40, height: 40, 'data-from': address });
    const come = () => { this.#coming--; this.#next(); };
    image.addEventListener('load', come);
    image.addEventListener('error', () => { image.classList.add('none'); come(); }); // of a void there is nothing to see
    this.#sight.observe(image);
    return image;
  }

  #next() {
    while (this.#coming < AT_ONCE && this.#waiting.length) {
      const image = this.#waiting.shift()!;
      if (!image.isConnected) continue; // of a list that is no longer shown
      this.#coming++;
      image.src = image.dataset.from!;
    }
  }
}

export class Palette {
  readonly element: HTMLElement;
  /** What is to be set. */
  chosen: Entry | null = null;
  /** Told when another part is chosen. */
  changed: () => void = () => {};
  #app: App;
  #list = h('ul', { class: 'palette', 'aria-label': words.palette });
  #filter = h('input', { type: 'search', oninput: () => this.#fill() });
  #pictures = new Pictures();
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
    const { code } = entry, picture = this.#pictures.of(picture_of(this.#app.file!, code));
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
