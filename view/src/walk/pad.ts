// Buttons for walking without keys: held, they go on; a press of Enter or of an assistive tool goes for a moment.

import type { EventBus } from '../event-bus.ts';
import { button, h } from '../ui/dom.ts';
import { strings } from '../ui/strings.ts';
import type { Walk, Way } from './walk.ts';

const SIGNS: [Way, string][] = [['turn-left', '↺'], ['ahead', '↑'], ['turn-right', '↻'], ['left', '←'], ['back', '↓'], ['right', '→']];

export function walkPad(walk: Walk, events: EventBus, canvas: HTMLCanvasElement): HTMLElement {
  const lamp = button(strings.lamp, () => walk.lamp.set(!walk.lamp.on), { title: 'L', 'data-do': 'lamp', 'aria-pressed': 'false' });
  const element = h('div', { class: 'walk-pad', role: 'group', 'aria-label': strings.walk, hidden: true },
    ...SIGNS.map(([way, sign]) => holdButton(walk, way, sign)),
    button(strings.door, () => walk.useDoor(), { title: 'E', 'data-do': 'door' }), lamp,
    button(strings.leaveWalk, () => { walk.leave(); canvas.focus(); }, { class: 'leave', 'data-do': 'leave-walk' }));
  element.addEventListener('keydown', event => {
    if (event.key !== 'Escape') return;
    walk.leave();
    canvas.focus();
  });
  events.on('walk', () => { element.hidden = !walk.on; lamp.setAttribute('aria-pressed', `${walk.lamp.on}`); });
  return element;
}

function holdButton(walk: Walk, way: Way, sign: string): HTMLButtonElement {
  const element = button(sign, event => { if (event.detail === 0) walk.nudge(way); }, { 'aria-label': strings.way[way], title: strings.way[way], 'data-way': way });
  element.addEventListener('pointerdown', event => {
    element.setPointerCapture(event.pointerId);
    walk.hold(way, true);
  });
  for (const end of ['pointerup', 'pointercancel', 'lostpointercapture'] as const) element.addEventListener(end, () => walk.hold(way, false));
  element.addEventListener('contextmenu', event => event.preventDefault()); // A long touch.
  return element;
}
