// The file list.

import type { App } from '../app.ts';
import { button, field, h } from '../ui/dom.ts';
import { strings } from '../ui/strings.ts';
import { collapsible } from './collapsible.ts';

export function fileList(app: App): HTMLElement {
  const list = h('ul', { class: 'list files' });
  const filter = h('input', { type: 'search', oninput: () => fill() });
  const search = field(strings.filterFiles, filter);
  const fill = () => {
    const all = app.serverInfo.files, wanted = filter.value.toLowerCase();
    search.hidden = all.length < 8;
    const found = all.filter(({ path }) => path.toLowerCase().includes(wanted));
    list.replaceChildren(...found.map(({ path }) => h('li', {}, button(path, () => void app.openFile(path), {
      class: 'row', 'aria-current': path === app.file ? 'true' : null,
    }))));
  };
  app.on('files', fill);
  return collapsible('files', strings.files, true, search, list);
}
