// The sun by date and hour in Kyoto.

import type { App } from '../app.ts';
import { field, h } from '../dom.ts';
import { clock, date_of, KYOTO, sun_at } from '../sun.ts';
import { words } from '../words.ts';
import { fold } from './fold.ts';

const START = { date: '2026-10-10', hour: 14 };

export function sky(app: App): HTMLElement {
  const date = h('input', { type: 'date', value: START.date, min: '1200-01-01', max: '2999-12-31', oninput: () => set() });
  const hour = h('input', { type: 'range', min: 0, max: 24, step: 0.25, value: START.hour, oninput: () => set() });
  const time = h('output', {}), where = h('p', { class: 'quiet', role: 'status' });
  const set = () => {
    const day = date_of(date.value);
    if (!day) return;
    const sun = sun_at(day, hour.valueAsNumber, KYOTO);
    app.stage.surroundings.light(sun);
    app.stage.shade();
    time.textContent = clock(hour.valueAsNumber);
    hour.setAttribute('aria-valuetext', time.textContent);
    where.textContent = words.sun_at(sun.azimuth.toFixed(1), sun.altitude.toFixed(1)) + (sun.altitude < 0 ? ` (${words.night})` : '');
  };
  set();
  app.on('shown', () => {
    if (!app.resetting) return;
    date.value = START.date;
    hour.value = `${START.hour}`;
    set();
  });
  return fold('sun', words.sun, false, field(words.date, date), field(words.hour, hour, time), where,
    h('p', { class: 'quiet' }, words.sun_place));
}
