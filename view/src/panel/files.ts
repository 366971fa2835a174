// The files of the folder.

import type { App } from '../app.ts';
import { button, field, h } from '../dom.ts';
import { words } from '../words.ts';
import { fold } from './fold.ts';

export function files(app: App): HTMLElement {
  const list = h('ul', { class: 'list files' });
  const filter = h('input', { type: 'search', oninput: () => fill() });
  const search = field(words.filter_files, filter);
  const fill = () => {
    const all = app.hello.files, wanted = filter.value.toLowerCase();
    search.hidden = all.length < 8;
    const found = all.filter(({ path }) => path.toLowerCase().includes(wanted));
    list.replaceChildren(...found.map(({ path }) => h('li', {}, button(path, () => void app.choose(path), {
      class: 'row', 'aria-current': path === app.file ? 'true' : null,
    }))));
  };
  app.on('files', fill);
  return fold('files', words.files, true, search, list);
}
