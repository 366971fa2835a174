// Tools for moving and turning groups and houses as a whole, by pointer or keyboard.

import { toPlan, type XY } from '../plan/coordinates.ts';
import type { PlanView } from '../plan/plan-view.ts';
import type { PlanPlace } from '../server/api.ts';
import { strings } from '../ui/strings.ts';
import { arrowWay, fromFrame, snapped, STEP, toFrame, TURN, turnAround } from './ground.ts';
import type { EditSession } from './session.ts';

/** What is being moved. */
interface Held {
  shape: SVGGElement;
  index: number;
  place: PlanPlace;
  /** Its new place in its frame, metres. */
  at: XY;
  /** Its new direction, degrees. */
  heading: number;
  /** Where the pointer was pressed on the plan; null when the keyboard is used. */
  start: XY | null;
}

export class PlaceTool {
  /** Turns instead of moving. */
  turns = false;
  /** Takes the outermost group instead of the house. */
  groups = false;
  #held: Held | null = null;
  #plan: PlanView;
  #session: EditSession;

  constructor(plan: PlanView, session: EditSession) {
    this.#plan = plan;
    this.#session = session;
  }

  /** Makes the first wall of each house focusable. */
  enable(on: boolean) {
    this.#held = null;
    const seen = new Set<number>();
    for (const [shape, { at, house }] of this.#plan.drawn.walls) {
      if (!on) { for (const name of ['tabindex', 'role', 'aria-label']) shape.removeAttribute(name); continue; }
      if (seen.has(at.house)) continue;
      seen.add(at.house);
      shape.setAttribute('tabindex', '0');
      shape.setAttribute('role', 'button');
      shape.setAttribute('aria-label', strings.placeOf(house.name || `${at.house + 1}`));
    }
  }

  down(event: PointerEvent): boolean {
    const shape = (event.target as Element).closest<SVGGElement>('.run');
    return shape !== null && this.#hold(shape, this.#plan.sheet.place(event));
  }

  move(event: PointerEvent) {
    const held = this.#held;
    if (!held?.start) return;
    const { place, start } = held, now = this.#plan.sheet.place(event);
    if (this.turns) {
      const pivot = fromFrame(place, place.at), angle = ([x, y]: XY) => Math.atan2(y - pivot[1], x - pivot[0]) * 180 / Math.PI;
      held.heading = snapped(place.heading + angle(now) - angle(start), TURN);
    } else {
      const [from, to] = [toFrame(place, start), toFrame(place, now)];
      held.at = [0, 1].map(k => Number((place.at[k]! + snapped(to[k]! - from[k]!, STEP)).toFixed(3))) as XY;
    }
    this.#show();
  }

  async up() {
    if (!this.#held?.start) return;
    this.#held.start = null;
    await this.#send();
  }

  key(event: KeyboardEvent): boolean {
    const shape = (event.target as Element).closest<SVGGElement>('.run');
    if (!shape || !this.#plan.drawn.walls.has(shape)) return false;
    if (event.key === 'Escape') { this.release(); return true; }
    if (event.key === 'Enter' || event.key === ' ') { void this.#send(); return true; }
    const way = arrowWay(event.key);
    if (!way) return false;
    if (this.#held?.shape !== shape && !this.#hold(shape, null)) return true;
    const held = this.#held!, { place } = held;
    if (this.turns) held.heading += (way[0] || way[1]) * (event.shiftKey ? 1 : TURN);
    else {
      const [[x0, y0], [x1, y1]] = [toFrame(place, [0, 0]), toFrame(place, way)], step = event.shiftKey ? 10 * STEP : STEP;
      // Along the axis of the frame that is nearest to the arrow.
      const [x, y] = Math.abs(x1 - x0) >= Math.abs(y1 - y0) ? [Math.sign(x1 - x0), 0] : [0, Math.sign(y1 - y0)];
      held.at = [Number((held.at[0] + x * step).toFixed(3)), Number((held.at[1] + y * step).toFixed(3))];
    }
    this.#show();
    return true;
  }

  release() {
    this.#held?.shape.classList.remove('held');
    this.#held = null;
    this.#session.clear();
    this.#session.report('');
  }

  #hold(shape: SVGGElement, start: XY | null): boolean {
    this.release();
    const found = this.#plan.drawn.walls.get(shape), all = this.#plan.state?.plan.places ?? [];
    if (!found) return false;
    const holds = (place: PlanPlace) => place.houses.includes(found.at.house);
    const index = this.groups ? all.findIndex(holds) : all.findLastIndex(holds), place = all[index];
    if (!place) { this.#session.refuse(strings.notPlaced); return false; }
    const why = this.#session.reason(this.turns ? place.turn_fixed : place.fixed);
    if (why) { this.#session.refuse(why); return false; }
    shape.classList.add('held');
    this.#held = { shape, index, place, at: [...place.at], heading: place.heading, start };
    return true;
  }

  #show() {
    const { place, at, heading } = this.#held!, pivot = fromFrame(place, place.at), to = fromFrame(place, at);
    const moved = (point: XY): XY => {
      const [x, y] = turnAround(point, pivot, heading - place.heading);
      return [x + to[0] - pivot[0], y + to[1] - pivot[1]];
    };
    const houses = place.houses.map(house => this.#plan.state!.plan.houses[house]!);
    const rings = houses.flatMap(house => (house.storeys[0]?.rings ?? []).filter(ring => !ring.inner)
      .map(ring => ring.walls.map(wall => moved(toPlan(house, wall.from)))));
    this.#session.sketch(rings, this.turns ? `${Number(heading.toFixed(3))}°` : strings.placeAt(`${at[0]}`, `${at[1]}`), true);
  }

  async #send() {
    const held = this.#held;
    if (!held) return;
    held.shape.classList.remove('held');
    this.#held = null;
    const { index, place, at, heading } = held;
    if (this.turns ? heading === place.heading : at.every((n, k) => n === place.at[k])) { this.release(); return; }
    await this.#session.send(this.turns ? { do: 'turn-place', place: index, to: heading } : { do: 'move-place', place: index, to: at });
  }
}
