// Drawing the outline of a new house: a rectangle on the unit grid.

import type { App } from '../app.ts';
import { to_house } from '../plan/frame.ts';
import type { PlanView } from '../plan/view.ts';
import type { House, Point } from '../server.ts';
import { words } from '../words.ts';
import type { Desk } from './desk.ts';
import { arrow, rectangle, WORLD } from './strokes.ts';

export class OutlineTool {
  #app: App;
  #plan: PlanView;
  #desk: Desk;
  #from: Point | null = null;
  #to: Point = [0, 0];
  #drags = false;

  constructor(app: App, plan: PlanView, desk: Desk) {
    this.#app = app;
    this.#plan = plan;
    this.#desk = desk;
  }

  get #house(): House { return this.#app.state?.plan.houses[0] ?? WORLD; }

  down(event: PointerEvent): boolean {
    this.#from = this.#to = to_house(this.#house, this.#plan.sheet.place(event));
    this.#drags = true;
    return true;
  }

  move(event: PointerEvent) {
    if (!this.#drags) return;
    this.#to = to_house(this.#house, this.#plan.sheet.place(event));
    this.#show();
  }

  async up() {
    if (!this.#drags) return;
    this.#drags = false;
    await this.#send();
  }

  key(event: KeyboardEvent): boolean {
    if (event.key === 'Escape') { this.release(); return true; }
    const way = arrow(event.key, this.#house, to_house);
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
    this.#desk.clear();
  }

  /** Beside what stands there already. */
  #begin() {
    const walls = this.#house.storeys.flatMap(storey => storey.rings.flatMap(ring => ring.walls));
    const left = Math.max(0, ...walls.map(wall => wall.from[0])) + (walls.length ? 2 : 0);
    this.#from = [left, 0];
    this.#to = [left + 4, 4];
  }

  #show() {
    const shape = this.#from && rectangle(this.#from, this.#to);
    if (!shape) { this.#desk.clear(); return; }
    const [[a0, b0], , [a1, b1]] = shape as [Point, Point, Point];
    this.#desk.ghost(this.#house, shape, words.rectangle(a1 - a0, b1 - b0), true);
  }

  async #send() {
    const shape = this.#from && rectangle(this.#from, this.#to);
    this.#from = null;
    if (!shape) { this.#desk.clear(); return; }
    await this.#desk.send({ do: 'draw-house', outline: shape, ...(this.#app.state?.plan.houses.length ? { house: 0 } : {}) });
  }
}
