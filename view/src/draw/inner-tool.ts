// Tool for walls inside a storey: a drag along the grid draws one of the part chosen in the palette; one that stands is chosen
// by a click and removed.

import { toHouse } from '../plan/coordinates.ts';
import type { WallIndex } from '../plan/drawing.ts';
import type { PlanView } from '../plan/plan-view.ts';
import type { House, Point } from '../server/api.ts';
import { button } from '../ui/dom.ts';
import { strings } from '../ui/strings.ts';
import { arrow, lengthOf, storeyUnder } from './edits.ts';
import { snapped } from './ground.ts';
import type { EditSession } from './session.ts';

/** Walls begin on lines of the grid or between them, U. */
const STEP = 0.5;

/** The wall being drawn. */
interface Drawn {
  house: number;
  storey: number;
  shown: House;
  from: Point;
  to: Point;
}

export class InnerTool {
  readonly remove = button(strings.removeInner, () => void this.#drop(this.#chosen), { 'data-do': 'remove-inner', disabled: true });
  #plan: PlanView;
  #session: EditSession;
  #part: () => string | null;
  #drawn: Drawn | null = null;
  #pressed: SVGGElement | null = null;
  #chosen: SVGGElement | null = null;

  constructor(plan: PlanView, session: EditSession, part: () => string | null) {
    this.#plan = plan;
    this.#session = session;
    this.#part = part;
  }

  /** Makes walls inside focusable. */
  enable(on: boolean) {
    this.#choose(null);
    for (const [shape, { at, wall }] of this.#plan.drawn.walls) {
      if (!this.#isInner(at)) continue;
      if (!on) { for (const name of ['tabindex', 'role', 'aria-label', 'aria-pressed']) shape.removeAttribute(name); continue; }
      shape.setAttribute('tabindex', '0');
      shape.setAttribute('role', 'button');
      shape.setAttribute('aria-pressed', 'false');
      shape.setAttribute('aria-label', strings.innerOf(wall.facade, `${Number(lengthOf(wall).toFixed(2))}`));
    }
  }

  down(event: PointerEvent): boolean {
    const place = this.#plan.sheet.place(event), under = storeyUnder(this.#plan.state, this.#plan.storey, place, true);
    if (!under) return false;
    this.#pressed = this.#innerOf(event.target);
    const from = onGrid(toHouse(under.shown, place));
    this.#drawn = { ...under, from, to: from };
    return true;
  }

  move(event: PointerEvent) {
    const drawn = this.#drawn;
    if (!drawn) return;
    drawn.to = straight(drawn.from, toHouse(drawn.shown, this.#plan.sheet.place(event)));
    this.#show();
  }

  async up() {
    const { from, to } = this.#drawn ?? { from: [0, 0], to: [0, 0] };
    if (from[0] === to[0] && from[1] === to[1]) {
      this.#drawn = null;
      this.#choose(this.#pressed);
    } else await this.#send();
  }

  key(event: KeyboardEvent): boolean {
    const shape = this.#innerOf(event.target), { key } = event;
    if (key === 'Escape') { this.release(); return true; }
    if (shape && !this.#drawn) {
      if (key === 'Delete' || key === 'Backspace') { void this.#drop(shape); return true; }
      if (key === 'Enter' || key === ' ') { this.#choose(shape); return true; }
    }
    if (key === 'Enter' && this.#drawn) { void this.#send(); return true; }
    const { frame } = this.#plan.sheet;
    const under = this.#drawn?.shown ?? storeyUnder(this.#plan.state, this.#plan.storey, [frame.x + frame.width / 2, frame.y + frame.height / 2], true);
    const way = under && arrow(key, 'shown' in under ? under.shown : under, toHouse);
    if (!under || !way) return false;
    if (!this.#drawn && 'shown' in under) {
      const from = toHouse(under.shown, [frame.x + frame.width / 2, frame.y + frame.height / 2]).map(n => Math.round(n) + 0) as Point;
      this.#drawn = { ...under, from, to: [from[0] + way[0], from[1] + way[1]] };
    } else {
      const drawn = this.#drawn!, move = ([a, b]: Point): Point => [a + way[0] + 0, b + way[1] + 0];
      // With Shift both ends, else the far one along the wall, or round its start where the arrow lies across.
      if (event.shiftKey) [drawn.from, drawn.to] = [move(drawn.from), move(drawn.to)];
      else {
        const along = way[0] ? drawn.to[1] === drawn.from[1] : drawn.to[0] === drawn.from[0];
        drawn.to = along ? move(drawn.to) : move(drawn.from);
      }
    }
    this.#show();
    return true;
  }

  release() {
    this.#drawn = this.#pressed = null;
    this.#choose(null);
    this.#session.clear();
  }

  #isInner({ house, storey, ring }: WallIndex) { return this.#plan.state?.plan.houses[house]?.storeys[storey]?.rings[ring]?.inner ?? false; }

  #innerOf(target: EventTarget | null): SVGGElement | null {
    const shape = (target as Element).closest<SVGGElement>('.run'), found = shape && this.#plan.drawn.walls.get(shape);
    return found && this.#isInner(found.at) ? shape : null;
  }

  #choose(shape: SVGGElement | null) {
    this.#chosen?.classList.remove('held');
    this.#chosen?.setAttribute('aria-pressed', 'false');
    this.#chosen = shape;
    this.remove.disabled = !shape;
    if (!shape) return;
    shape.classList.add('held');
    shape.setAttribute('aria-pressed', 'true');
    this.#session.report(strings.innerChosen);
  }

  #show() {
    const { shown, from, to } = this.#drawn!, long = Math.hypot(to[0] - from[0], to[1] - from[1]);
    this.#session.ghost(shown, [from, to], strings.units(long).replace('+', ''));
  }

  async #send() {
    const drawn = this.#drawn, part = this.#part();
    this.#drawn = null;
    if (!drawn) return;
    const { house, storey, from, to } = drawn;
    // Walls run to the left and to the back, whichever way they are drawn.
    const points = from[0] > to[0] || from[1] > to[1] ? [to, from] : [from, to];
    await this.#session.send({ do: 'draw-wall', house, storey, points, ...(part?.trim() ? { part } : {}) });
  }

  async #drop(shape: SVGGElement | null) {
    const found = shape && this.#plan.drawn.walls.get(shape);
    if (!found) return;
    const { house, storey, ring } = found.at;
    this.#choose(null);
    await this.#session.send({ do: 'remove-wall', house, storey, ring });
  }
}

const onGrid = ([a, b]: Point): Point => [snapped(a, STEP), snapped(b, STEP)];

/** The end of a wall of whole units from a point, along the axis that is nearer to another point. */
function straight([a, b]: Point, to: Point): Point {
  const [x, y] = [Math.round(to[0] - a), Math.round(to[1] - b)];
  return Math.abs(to[0] - a) >= Math.abs(to[1] - b) ? [a + x, b] : [a, b + y];
}
