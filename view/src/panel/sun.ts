// Sun position by date and hour in Kyoto.

import type { App } from '../app.ts';
import { field, h } from '../ui/dom.ts';
import { formatHour, parseDate, KYOTO, sunPosition } from '../scene/sun.ts';
import { strings } from '../ui/strings.ts';
import { collapsible } from './collapsible.ts';

const START = { date: '2026-10-10', hour: 14 };

export function sunPanel(app: App): HTMLElement {
  const date = h('input', { type: 'date', value: START.date, min: '1200-01-01', max: '2999-12-31', oninput: () => set() });
  const hour = h('input', { type: 'range', min: 0, max: 24, step: 0.25, value: START.hour, oninput: () => set() });
  const time = h('output', {}), where = h('p', { class: 'quiet', role: 'status' });
  const set = () => {
    const day = parseDate(date.value);
    if (!day) return;
    const sun = sunPosition(day, hour.valueAsNumber, KYOTO);
    app.renderer.viewport.environment.light(sun);
    app.town.turn(day);
    app.renderer.viewport.updateShadows();
    time.textContent = formatHour(hour.valueAsNumber);
    hour.setAttribute('aria-valuetext', time.textContent);
    where.textContent = strings.sunAt(sun.azimuth.toFixed(1), sun.altitude.toFixed(1)) + (sun.altitude < 0 ? ` (${strings.night})` : '');
  };
  set();
  app.light = time => {
    const now = time ?? START;
    date.value = now.date;
    hour.value = `${now.hour}`;
    set();
  };
  app.on('shown', () => { if (app.resetting) app.light(null); });
  return collapsible('sun', strings.sun, false, field(strings.date, date), field(strings.hour, hour, time), where,
    h('p', { class: 'quiet' }, strings.sunPlace));
}
