// Tools for moving a wall along its normal and for breaking a stretch out of it, by pointer or keyboard.

import type { App } from '../app.ts';
import { toHouse } from '../plan/coordinates.ts';
import type { WallIndex } from '../plan/drawing.ts';
import type { PlanView } from '../plan/plan-view.ts';
import type { House, Point, Wall } from '../server/api.ts';
import { strings } from '../ui/strings.ts';
import type { EditSession } from './session.ts';
import { along, arrow, dragged, ghostPath, lengthOf, outward, share, type Stretch, stretchOf } from './edits.ts';

/** The wall being edited. */
interface Held {
  shape: SVGGElement;
  at: WallIndex;
  wall: Wall;
  house: House;
  by: number;
  /** The stretch to break out; null until it is chosen. */
  stretch: Stretch | null;
  /** Where the pointer was pressed; null when the keyboard is used. */
  start: Point | null;
  choosing: boolean;
}

export class WallTool {
  breaks = false;
  /** Moves the walls above and below as well. */
  all = false;
  #held: Held | null = null;
  #plan: PlanView;
  #session: EditSession;

  constructor(_: App, plan: PlanView, session: EditSession) {
    this.#plan = plan;
    this.#session = session;
  }

  /** Makes walls focusable. */
  enable(on: boolean) {
    this.#held = null;
    for (const [shape, { wall }] of this.#plan.drawn.walls) {
      if (!on) { for (const name of ['tabindex', 'role', 'aria-label']) shape.removeAttribute(name); continue; }
      shape.setAttribute('tabindex', '0');
      shape.setAttribute('role', 'button');
      shape.setAttribute('aria-label', strings.wallOf(wall.facade, `${Number(lengthOf(wall).toFixed(2))}`));
    }
  }

  down(event: PointerEvent): boolean {
    const shape = (event.target as Element).closest<SVGGElement>('.run');
    const found = shape && this.#plan.drawn.walls.get(shape);
    if (!found) return false;
    const start = toHouse(found.house, this.#plan.sheet.place(event));
    // A second drag on a chosen stretch moves it.
    const held = this.#held;
    const chosen = this.breaks && held?.shape === shape && held.stretch && !held.start ? held.stretch : null;
    const inside = chosen && (({ from }) => from >= chosen.from && from < chosen.to)(stretchOf(found.wall, start, start));
    this.#hold({ shape: shape!, ...found, by: 0, stretch: inside ? chosen : null, start, choosing: this.breaks && !inside });
    return true;
  }

  move(event: PointerEvent) {
    const held = this.#held;
    if (!held?.start) return;
    const now = toHouse(held.house, this.#plan.sheet.place(event));
    if (held.choosing) held.stretch = stretchOf(held.wall, held.start, now);
    else held.by = dragged(held.wall, held.start, now);
    this.#show();
  }

  async up() {
    const held = this.#held;
    if (!held?.start) return;
    held.start = null;
    if (held.choosing) { held.choosing = false; return; }
    if (held.by !== 0) await this.#send();
    else if (!this.breaks) this.release();
  }

  key(event: KeyboardEvent): boolean {
    const shape = (event.target as Element).closest<SVGGElement>('.run');
    const found = shape && this.#plan.drawn.walls.get(shape);
    if (!found) return false;
    const way = arrow(event.key, found.house, toHouse);
    if (event.key === 'Escape') { this.release(); return true; }
    if (event.key === 'Enter' || event.key === ' ') { if (this.#held?.by) void this.#send(); return true; }
    if (!way) return false;
    if (this.#held?.shape !== shape) this.#hold({ shape: shape!, ...found, by: 0, stretch: null, start: null, choosing: false });
    const held = this.#held;
    if (!held) return true;
    const out = share(way, outward(held.wall)), on = share(way, along(held.wall));
    if (this.breaks) held.stretch ??= { from: 0, to: 1 };
    if (out) held.by += out;
    else if (on && held.stretch) {
      const { stretch } = held, most = Math.floor(lengthOf(held.wall) + 1e-9);
      if (event.shiftKey) stretch.to = Math.max(stretch.from + 1, Math.min(most, stretch.to + on));
      else {
        const from = Math.max(0, Math.min(most - (stretch.to - stretch.from), stretch.from + on));
        held.stretch = { from, to: from + stretch.to - stretch.from };
      }
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

  #hold(held: Held) {
    this.#held?.shape.classList.remove('held');
    // Walls that one source line writes for several storeys or houses cannot be edited in one of them.
    const why = this.#session.reason(held.wall.fixed);
    if (why) {
      this.#held = null;
      this.#session.refuse(why);
      return;
    }
    this.#held = held;
    held.shape.classList.add('held');
    this.#show();
  }

  #show() {
    const { house, wall, by, stretch } = this.#held!;
    const label = stretch ? `${stretch.from}–${stretch.to}: ${strings.units(by)}` : strings.units(by);
    this.#session.ghost(house, ghostPath(wall, by, stretch ?? undefined), label);
  }

  async #send() {
    const { at, by, stretch } = this.#held!;
    this.#held!.shape.classList.remove('held');
    this.#held = null;
    await this.#session.send(stretch ? { do: 'break-wall', ...at, ...stretch, by } : { do: 'move-wall', ...at, by, storeys: this.all ? 'all' : 'one' });
  }
}
