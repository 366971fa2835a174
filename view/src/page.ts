// Page layout: toolbar on top, model in the middle with plan and source, panel beside it (on a phone, a sheet at the
// bottom).

import { App } from './app.ts';
import { h } from './ui/dom.ts';
import { FrontDesk } from './front/desk.ts';
import { DrawTool } from './draw/draw-tool.ts';
import { Review } from './draw/review.ts';
import { partCard } from './panel/part-card.ts';
import { sectionPanel } from './panel/section.ts';
import { fileList } from './panel/files.ts';
import { reflectionPanel } from './panel/reflections.ts';
import { namedViewList } from './panel/named-views.ts';
import { measuringPanel } from './panel/measuring.ts';
import { featureCard } from './panel/feature-card.ts';
import { townPanel, townProgress } from './panel/town.ts';
import { diagnosticList } from './panel/diagnostics.ts';
import { layerPanel } from './panel/layers.ts';
import { comparisonPanel } from './panel/comparison.ts';
import { parameterPanel } from './panel/parameters.ts';
import { sunPanel } from './panel/sun.ts';
import { statisticsPanel } from './panel/statistics.ts';
import { partTree } from './panel/part-tree.ts';
import { PlanView } from './plan/plan-view.ts';
import { attachInput, createCanvas } from './ui/canvas.ts';
import { SourcePane } from './ui/source-pane.ts';
import { toolbar } from './ui/toolbar.ts';
import { strings } from './ui/strings.ts';
import { walkPad } from './walk/pad.ts';

export interface Page {
  app: App;
  plan: PlanView;
  text: SourcePane;
  draw: DrawTool;
  review: Review;
  /** The photographs that become a front; null without any. */
  front: FrontDesk | null;
}

/** Makes the page; `fronts` tells whether photographs become a front in it. */
export function page(fronts: boolean): Page {
  document.title = strings.title;
  const canvas = createCanvas();
  const cross = h('div', { class: 'cross', hidden: true, 'aria-hidden': 'true' });
  const model = h('section', { class: 'pane model', 'aria-label': strings.model }, canvas, cross);
  const live = h('p', { class: 'live', role: 'status', 'aria-live': 'polite' });
  const lost = h('p', { class: 'lost', role: 'alert', hidden: true }, strings.lost);
  const main = h('main', { class: 'panes' }, model);
  document.body.append(main); // Element sizes are known from here on.
  const app = new App(canvas);
  model.append(app.renderer.measure.labels, walkPad(app.walk, app, app.renderer.viewport.canvas));
  const plan = new PlanView(app), text = new SourcePane(app);
  const draw = new DrawTool(app, plan), review = new Review(app, plan, () => { if (plan.element.hidden) bar.show(plan.element, true); });
  main.prepend(text.element);
  main.append(plan.element);
  const panel = h('aside', { class: 'panel', 'aria-label': strings.panel },
    townProgress(app), featureCard(app), partCard(app), townPanel(app), review.element, fileList(app), parameterPanel(app), comparisonPanel(app), namedViewList(app), diagnosticList(app), layerPanel(app), partTree(app), sectionPanel(app), sunPanel(app), measuringPanel(app), reflectionPanel(app), statisticsPanel(app));
  const narrow = matchMedia('(max-width: 720px)').matches, front = fronts ? new FrontDesk(app) : null;
  panel.hidden = narrow || fronts;
  if (front) {
    main.prepend(front.element);
    model.hidden = true;
    front.showModel = () => bar.show(model, true);
  }
  const panes = [
    ...front ? [{ name: 'photograph', label: strings.photos.pane, element: front.element }] : [],
    { name: 'model', label: strings.model, element: model }, { name: 'plan', label: strings.plan, element: plan.element },
    { name: 'text', label: strings.text, element: text.element },
  ];
  const changed = () => {
    document.body.classList.toggle('with-panel', !panel.hidden);
    plan.update();
    text.update();
  };
  const bar = toolbar(app, { panes, panel, changed }) as HTMLElement & { show: (element: HTMLElement, on: boolean) => void };
  document.body.prepend(h('header', {}, bar));
  document.body.append(panel, h('footer', {}, live, lost));
  attachInput(app, cross);
  app.announce = text => { live.textContent = text; };
  app.showSource = location => {
    bar.show(text.element, true);
    text.show(location);
  };
  app.on('connection', () => { lost.hidden = !app.lost; });
  app.on('files', () => { if (app.file === null && !front) app.announce(strings.noFile); });
  return { app, plan, text, draw, review, front };
}
