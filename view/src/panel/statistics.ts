// Statistics of the frame, the reload and the compiler.

import type { App } from '../app.ts';
import { h } from '../ui/dom.ts';
import { strings } from '../ui/strings.ts';
import { collapsible } from './collapsible.ts';

export function statisticsPanel(app: App): HTMLElement {
  const list = h('dl', { class: 'stats' });
  const element = collapsible('stats', strings.stats, false, list);
  const row = (name: string, value: string) => [h('dt', {}, name), h('dd', {}, value)];
  let shown = '';
  const show = () => {
    if (!element.open) return;
    const { calls, triangles, ms } = app.renderer.viewport.stats, reload = app.reloadTimes;
    const { mirrors } = app.renderer, { seen, drawn, calls: own, triangles: mirrored } = mirrors.stats;
    const rows: [string, string][] = [
      [strings.drawCalls, `${calls}`], [strings.triangles, triangles.toLocaleString('en')], [strings.frameMs, `${ms.toFixed(1)} ms`],
      ...(reload ? [[strings.reloadMs, `${reload.painted.toFixed(0)} ms`] as [string, string]] : []),
      ...(mirrors.walls.length ? [[strings.mirrorsSeen, `${drawn} / ${seen}`], [strings.mirrorsCost, `${own}, ${mirrored.toLocaleString('en')}`]] as [string, string][] : []),
      ...(app.state?.times ?? []).map(([step, took]) => [`${strings.compile}: ${step}`, `${took.toFixed(1)} ms`] as [string, string]),
    ];
    const text = rows.join();
    if (text === shown) return;
    shown = text;
    list.replaceChildren(...rows.flatMap(([name, value]) => row(name, value)));
  };
  let soon = 0;
  const later = () => { soon ||= window.setTimeout(() => { soon = 0; show(); }, 150); };
  app.renderer.viewport.onFrame.push(later);
  app.on('reload', later);
  element.addEventListener('toggle', show);
  return element;
}
