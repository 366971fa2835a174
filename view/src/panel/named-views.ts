// The views that the file names; each moves the camera to its place and the sun to its hour.

import type { App } from '../app.ts';
import { button, h } from '../ui/dom.ts';
import { strings } from '../ui/strings.ts';
import { collapsible } from './collapsible.ts';

export function namedViewList(app: App): HTMLElement {
  const list = h('ul', { class: 'list named-views' });
  const element = collapsible('named-views', strings.namedViews, true, list);
  const fill = () => {
    const views = app.state?.plan.views ?? [];
    element.hidden = views.length === 0;
    list.replaceChildren(...views.map(view => h('li', {}, button(view.name, () => app.visit(view), {
      class: 'row', 'aria-current': view.name === app.visited ? 'true' : null,
    }))));
  };
  app.on('state', fill);
  app.on('visited', fill);
  return element;
}
