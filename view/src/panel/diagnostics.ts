// The compiler's diagnostics. A click shows the location in the source pane and in the user's editor.

import type { App } from '../app.ts';
import { h } from '../ui/dom.ts';
import { displayName, type Diagnostic, sourceOf } from '../server/api.ts';
import { strings } from '../ui/strings.ts';
import { collapsible } from './collapsible.ts';

export function diagnosticList(app: App): HTMLElement {
  const list = h('ul', { class: 'list messages' }), none = h('p', { class: 'quiet' }, strings.noDiagnostics);
  const element = collapsible('messages', strings.diagnostics, true, none, list);
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
  const { severity, code, line, column, help, feature } = message, source = sourceOf(message, app.state!.sources);
  const elsewhere = source && source.id !== 0 ? `${displayName(source)}: ` : '';
  return h('button', { type: 'button', class: `row message ${severity}`, onclick: () => app.showDiagnostic(message) },
    h('span', { class: 'severity' }, `${strings[severity]} `), h('span', { class: 'code' }, `${code} `),
    h('span', { class: 'place' }, feature ? `${feature.layer} ${feature.key}` : source && elsewhere + strings.atLine(line, column)),
    h('span', { class: 'text' }, message.message), help && h('span', { class: 'help' }, `${strings.help}: ${help}`));
}
