// Moving walls along their normals, and breaking stretches out of them; by pointer or by keys.

import type { App } from '../app.ts';
import { to_house } from '../plan/frame.ts';
import type { WallAt } from '../plan/picture.ts';
import type { PlanView } from '../plan/view.ts';
import type { House, Point, Wall } from '../server.ts';
import { words } from '../words.ts';
import type { Desk } from './desk.ts';
import { along, arrow, dragged, ghost_of, length_of, outward, share, type Stretch, stretch_of } from './strokes.ts';

/** A wall that is held. */
interface Held {
  shape: SVGGElement;
  at: WallAt;
  wall: Wall;
  house: House;
  by: number;
  /** Of a break: the part of the wall that moves; null = not chosen yet. */
  stretch: Stretch | null;
  /** Where the pointer took it; null = held by keys. */
  start: Point | null;
  choosing: boolean;
}

export class WallTool {
  breaks = false;
  /** Whether walls above and below move along. */
  all = false;
  #held: Held | null = null;
  #plan: PlanView;
  #desk: Desk;

  constructor(_: App, plan: PlanView, desk: Desk) {
    this.#plan = plan;
    this.#desk = desk;
  }

  /** Walls can be reached by Tab. */
  enable(on: boolean) {
    this.#held = null;
    for (const [shape, { wall }] of this.#plan.drawn.walls) {
      if (!on) { for (const name of ['tabindex', 'role', 'aria-label']) shape.removeAttribute(name); continue; }
      shape.setAttribute('tabindex', '0');
      shape.setAttribute('role', 'button');
      shape.setAttribute('aria-label', words.wall_of(wall.facade, `${Number(length_of(wall).toFixed(2))}`));
    }
  }

  down(event: PointerEvent): boolean {
    const shape = (event.target as Element).closest<SVGGElement>('.run');
    const found = shape && this.#plan.drawn.walls.get(shape);
    if (!found) return false;
    const start = to_house(found.house, this.#plan.sheet.place(event));
    // A second drag on a stretch that was chosen moves it.
    const held = this.#held;
    const chosen = this.breaks && held?.shape === shape && held.stretch && !held.start ? held.stretch : null;
    const inside = chosen && (({ from }) => from >= chosen.from && from < chosen.to)(stretch_of(found.wall, start, start));
    this.#hold({ shape: shape!, ...found, by: 0, stretch: inside ? chosen : null, start, choosing: this.breaks && !inside });
    return true;
  }

  move(event: PointerEvent) {
    const held = this.#held;
    if (!held?.start) return;
    const now = to_house(held.house, this.#plan.sheet.place(event));
    if (held.choosing) held.stretch = stretch_of(held.wall, held.start, now);
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
    const way = arrow(event.key, found.house, to_house);
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
      const { stretch } = held, most = Math.floor(length_of(held.wall) + 1e-9);
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
    this.#desk.clear();
    this.#desk.say('');
  }

  #hold(held: Held) {
    this.#held?.shape.classList.remove('held');
    // Where a wall cannot be moved, part of it may be; but not where it is written for several at once.
    const why = this.#desk.reason(held.wall.fixed);
    if (why) {
      this.#held = null;
      this.#desk.refuse(why);
      return;
    }
    this.#held = held;
    held.shape.classList.add('held');
    this.#show();
  }

  #show() {
    const { house, wall, by, stretch } = this.#held!;
    const label = stretch ? `${stretch.from}–${stretch.to}: ${words.units(by)}` : words.units(by);
    this.#desk.ghost(house, ghost_of(wall, by, stretch ?? undefined), label);
  }

  async #send() {
    const { at, by, stretch } = this.#held!;
    this.#held!.shape.classList.remove('held');
    this.#held = null;
    await this.#desk.send(stretch ? { do: 'break-wall', ...at, ...stretch, by } : { do: 'move-wall', ...at, by, storeys: this.all ? 'all' : 'one' });
  }
}
