// Lays the page out: tools above, the house in the middle with its plan and its text, the panel beside it (on a phone:
// a sheet at the foot).

import { App } from './app.ts';
import { attend, canvas_of } from './canvas.ts';
import { h } from './dom.ts';
import { DrawTool } from './draw/tool.ts';
import { card } from './panel/card.ts';
import { cut } from './panel/cut.ts';
import { files } from './panel/files.ts';
import { glass } from './panel/glass.ts';
import { lengths } from './panel/lengths.ts';
import { messages } from './panel/messages.ts';
import { shown } from './panel/shown.ts';
import { sky } from './panel/sky.ts';
import { stats } from './panel/stats.ts';
import { tree } from './panel/tree.ts';
import { PlanView } from './plan/view.ts';
import { TextPane } from './text.ts';
import { toolbar } from './toolbar.ts';
import { words } from './words.ts';

export interface Page {
  app: App;
  plan: PlanView;
  text: TextPane;
  draw: DrawTool;
}

export function page(): Page {
  document.title = words.title;
  const canvas = canvas_of();
  const cross = h('div', { class: 'cross', hidden: true, 'aria-hidden': 'true' });
  const model = h('section', { class: 'pane model', 'aria-label': words.model }, canvas, cross);
  const live = h('p', { class: 'live', role: 'status', 'aria-live': 'polite' });
  const lost = h('p', { class: 'lost', role: 'alert', hidden: true }, words.lost);
  const main = h('main', { class: 'panes' }, model);
  document.body.append(main); // sizes are known from here on
  const app = new App(canvas);
  model.append(app.measure.labels);
  const plan = new PlanView(app), text = new TextPane(app);
  const draw = new DrawTool(app, plan);
  main.prepend(text.element);
  main.append(plan.element);
  const panel = h('aside', { class: 'panel', 'aria-label': words.panel },
    card(app), files(app), messages(app), shown(app), tree(app), cut(app), sky(app), lengths(app), glass(app), stats(app));
  const narrow = matchMedia('(max-width: 720px)').matches;
  panel.hidden = narrow;
  const panes = [
    { name: 'model', label: words.model, element: model }, { name: 'plan', label: words.plan, element: plan.element },
    { name: 'text', label: words.text, element: text.element },
  ];
  const changed = () => {
    document.body.classList.toggle('with-panel', !panel.hidden);
    plan.update();
    text.update();
  };
  const bar = toolbar(app, { panes, panel, changed }) as HTMLElement & { show: (element: HTMLElement, on: boolean) => void };
  document.body.prepend(h('header', {}, bar));
  document.body.append(panel, h('footer', {}, live, lost));
  attend(app, cross);
  app.announce = said => { live.textContent = said; };
  app.show_text = spot => {
    bar.show(text.element, true);
    text.show(spot);
  };
  app.on('connection', () => { lost.hidden = !app.lost; });
  app.on('files', () => { if (app.file === null) app.announce(words.no_file); });
  return { app, plan, text, draw };
}
