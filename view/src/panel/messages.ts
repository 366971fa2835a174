// What the compiler says of the text. A message leads to its place, in the text pane and in the author's editor.

import type { App } from '../app.ts';
import { h } from '../dom.ts';
import { called, type Diagnostic, source_of } from '../server.ts';
import { words } from '../words.ts';
import { fold } from './fold.ts';

export function messages(app: App): HTMLElement {
  const list = h('ul', { class: 'list messages' }), none = h('p', { class: 'quiet' }, words.no_diagnostics);
  const element = fold('messages', words.diagnostics, true, none, list);
  const heading = element.querySelector('h2')!, count = h('span', { class: 'count' });
  heading.append(' ', count);
  app.on('state', () => {
    const { diagnostics } = app.state!;
    none.hidden = diagnostics.length > 0;
    count.textContent = diagnostics.length ? `${diagnostics.length}` : '';
    list.replaceChildren(...diagnostics.slice(0, 500).map(message => h('li', {}, row(app, message))));
  });
  return element;
}

function row(app: App, message: Diagnostic): HTMLElement {
  const { severity, code, line, column, help } = message, source = source_of(message, app.state!.sources);
  const elsewhere = source && source.id !== 0 ? `${called(source)}: ` : '';
  return h('button', { type: 'button', class: `row message ${severity}`, onclick: () => app.go_to(message) },
    h('span', { class: 'severity' }, `${words[severity]} `), h('span', { class: 'code' }, `${code} `),
    h('span', { class: 'place' }, source && elsewhere + words.at_line(line, column)),
    h('span', { class: 'words' }, message.message), help && h('span', { class: 'help' }, `${words.help}: ${help}`));
}
