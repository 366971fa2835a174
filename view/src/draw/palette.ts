// The palette of parts with their images. The server renders each image on request, which takes time, so they are fetched a
// few at a time as they scroll into view and never hold up an edit.

import type { App } from '../app.ts';
import { field, h } from '../ui/dom.ts';
import { fetchPalette, type PaletteEntry, partImageUrl } from '../server/api.ts';
import { strings } from '../ui/strings.ts';

/** Number of concurrent image requests. */
const MAX_REQUESTS = 2;

/** Fetches images as they scroll into view. */
class ImageQueue {
  #waiting: HTMLImageElement[] = [];
  #loading = 0;
  #observer = new IntersectionObserver(entries => {
    for (const { isIntersecting, target } of entries) {
      if (!isIntersecting) continue;
      this.#observer.unobserve(target);
      this.#waiting.push(target as HTMLImageElement);
    }
    this.#next();
  });

  /** Creates an image that loads its URL later. */
  of(address: string): HTMLImageElement {
    const image = h('img', { alt: '', width: 40, height: 40, 'data-from': address });
    const done = () => { this.#loading--; this.#next(); };
    image.addEventListener('load', done);
    image.addEventListener('error', () => { image.classList.add('none'); done(); }); // Voids have no image.
    this.#observer.observe(image);
    return image;
  }

  #next() {
    while (this.#loading < MAX_REQUESTS && this.#waiting.length) {
      const image = this.#waiting.shift()!;
      if (!image.isConnected) continue; // Its list is no longer shown.
      this.#loading++;
      image.src = image.dataset.from!;
    }
  }
}

export class Palette {
  readonly element: HTMLElement;
  /** The part to place. */
  chosen: PaletteEntry | null = null;
  /** Called when another part is chosen. */
  changed: () => void = () => {};
  #app: App;
  #list = h('ul', { class: 'palette', 'aria-label': strings.palette });
  #filter = h('input', { type: 'search', oninput: () => this.#fill() });
  #images = new ImageQueue();
  #entries: PaletteEntry[] = [];
  #file: string | null = null;

  constructor(app: App) {
    this.#app = app;
    this.element = h('div', { class: 'parts' }, field(strings.filterParts, this.#filter), this.#list);
  }

  /** Loads the parts of the open file, once per file. */
  async fill() {
    const { file } = this.#app;
    if (file === null || file === this.#file) return;
    const entries = await fetchPalette(file).catch(() => null);
    if (file !== this.#app.file) return;
    this.#file = entries && file; // Retried if it failed.
    this.#entries = entries ?? [];
    this.chosen = null;
    this.#fill();
  }

  #fill() {
    const wanted = this.#filter.value.toLowerCase();
    const found = this.#entries.filter(entry => [entry.code, entry.en, entry.ja, entry.romaji].some(name => name?.toLowerCase().includes(wanted)));
    this.#list.replaceChildren(...found.map(entry => this.#row(entry)), ...(found.length ? [] : [h('li', { class: 'quiet' }, strings.noParts)]));
  }

  #row(entry: PaletteEntry): HTMLElement {
    const { code } = entry, image = this.#images.of(partImageUrl(this.#app.file!, code));
    const choose = () => {
      this.chosen = entry;
      for (const button of this.#list.querySelectorAll('button')) button.setAttribute('aria-pressed', `${button.dataset.code === code}`);
      this.changed();
    };
    return h('li', {}, h('button', { type: 'button', onclick: choose, 'data-code': code, 'aria-pressed': `${this.chosen?.code === code}` },
      image, h('span', { class: 'part-code' }, code.trim() || '—'), h('span', { class: 'part-name' }, partName(entry))));
  }
}

/** The part's name in the page's language. */
export const partName = ({ en, ja, code }: PaletteEntry) => (document.documentElement.lang === 'ja' ? ja : en) || code;
