// What a frame, a reload and the compiler cost.

import type { App } from '../app.ts';
import { h } from '../dom.ts';
import { words } from '../words.ts';
import { fold } from './fold.ts';

export function stats(app: App): HTMLElement {
  const list = h('dl', { class: 'stats' });
  const element = fold('stats', words.stats, false, list);
  const row = (name: string, value: string) => [h('dt', {}, name), h('dd', {}, value)];
  let shown = '';
  const show = () => {
    if (!element.open) return;
    const { calls, triangles, ms } = app.stage.stats, reload = app.reload_times;
    const { mirrors } = app, { seen, drawn, calls: own, triangles: mirrored } = mirrors.stats;
    const rows: [string, string][] = [
      [words.draw_calls, `${calls}`], [words.triangles, triangles.toLocaleString('en')], [words.frame_ms, `${ms.toFixed(1)} ms`],
      ...(reload ? [[words.reload_ms, `${reload.painted.toFixed(0)} ms`] as [string, string]] : []),
      ...(mirrors.walls.length ? [[words.mirrors_seen, `${drawn} / ${seen}`], [words.mirrors_cost, `${own}, ${mirrored.toLocaleString('en')}`]] as [string, string][] : []),
      ...(app.state?.times ?? []).map(([step, took]) => [`${words.compile}: ${step}`, `${took.toFixed(1)} ms`] as [string, string]),
    ];
    const text = rows.join();
    if (text === shown) return;
    shown = text;
    list.replaceChildren(...rows.flatMap(([name, value]) => row(name, value)));
  };
  let soon = 0;
  const later = () => { soon ||= window.setTimeout(() => { soon = 0; show(); }, 150); };
  app.stage.on_frame.push(later);
  app.on('reload', later);
  element.addEventListener('toggle', show);
  return element;
}
