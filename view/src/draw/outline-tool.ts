// Tool for drawing the outline of a new house: a rectangle on the unit grid.

import type { App } from '../app.ts';
import { toHouse } from '../plan/coordinates.ts';
import type { PlanView } from '../plan/plan-view.ts';
import type { House, Point } from '../server/api.ts';
import { strings } from '../ui/strings.ts';
import type { EditSession } from './session.ts';
import { arrow, rectangle, WORLD_FRAME } from './edits.ts';

export class OutlineTool {
  #app: App;
  #plan: PlanView;
  #session: EditSession;
  #from: Point | null = null;
  #to: Point = [0, 0];
  #drags = false;

  constructor(app: App, plan: PlanView, session: EditSession) {
    this.#app = app;
    this.#plan = plan;
    this.#session = session;
  }

  get #house(): House { return this.#app.state?.plan.houses[0] ?? WORLD_FRAME; }

  down(event: PointerEvent): boolean {
    this.#from = this.#to = toHouse(this.#house, this.#plan.sheet.place(event));
    this.#drags = true;
    return true;
  }

  move(event: PointerEvent) {
    if (!this.#drags) return;
    this.#to = toHouse(this.#house, this.#plan.sheet.place(event));
    this.#show();
  }

  async up() {
    if (!this.#drags) return;
    this.#drags = false;
    await this.#send();
  }

  key(event: KeyboardEvent): boolean {
    if (event.key === 'Escape') { this.release(); return true; }
    const way = arrow(event.key, this.#house, toHouse);
    if (way && !this.#from) this.#begin();
    else if (way) {
      const [a, b] = way, move = ([x, y]: Point): Point => [x + a, y + b];
      this.#to = move(this.#to);
      if (event.shiftKey) this.#from = move(this.#from!);
    } else if (event.key === 'Enter' && this.#from) { void this.#send(); return true; } else return false;
    this.#show();
    return true;
  }

  release() {
    this.#from = null;
    this.#drags = false;
    this.#session.clear();
  }

  /** Starts beside the existing walls. */
  #begin() {
    const walls = this.#house.storeys.flatMap(storey => storey.rings.flatMap(ring => ring.walls));
    const left = Math.max(0, ...walls.map(wall => wall.from[0])) + (walls.length ? 2 : 0);
    this.#from = [left, 0];
    this.#to = [left + 4, 4];
  }

  #show() {
    const shape = this.#from && rectangle(this.#from, this.#to);
    if (!shape) { this.#session.clear(); return; }
    const [[a0, b0], , [a1, b1]] = shape as [Point, Point, Point];
    this.#session.ghost(this.#house, shape, strings.rectangle(a1 - a0, b1 - b0), true);
  }

  async #send() {
    const shape = this.#from && rectangle(this.#from, this.#to);
    this.#from = null;
    if (!shape) { this.#session.clear(); return; }
    await this.#session.send({ do: 'draw-house', outline: shape, ...(this.#app.state?.plan.houses.length ? { house: 0 } : {}) });
  }
}
