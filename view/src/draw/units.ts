// Setting parts: a unit of the plan takes the part that was chosen.

import type { PlanView } from '../plan/view.ts';
import { words } from '../words.ts';
import type { Desk } from './desk.ts';

export class UnitTool {
  #plan: PlanView;
  #desk: Desk;
  #part: () => string | null;
  /** Which unit keeps the place of Tab when the plan is drawn anew. */
  #place = 0;

  constructor(plan: PlanView, desk: Desk, part: () => string | null) {
    this.#plan = plan;
    this.#desk = desk;
    this.#part = part;
  }

  get #shapes(): SVGGElement[] { return [...this.#plan.drawn.units.keys()]; }

  /** One unit is reached by Tab, the others from there by arrow keys. */
  enable(on: boolean) {
    const focused = document.activeElement === document.body || this.#plan.sheet.svg.contains(document.activeElement);
    for (const [i, shape] of this.#shapes.entries()) {
      if (!on) { for (const name of ['tabindex', 'role', 'aria-label']) shape.removeAttribute(name); continue; }
      const { at, unit } = this.#plan.drawn.units.get(shape)!;
      shape.setAttribute('tabindex', i === this.#place ? '0' : '-1');
      shape.setAttribute('role', 'button');
      shape.setAttribute('aria-label', words.unit_of(unit.code, at.unit + 1));
    }
    if (on && focused && this.#kept) this.#shapes[this.#place]?.focus();
    this.#kept = false;
  }

  /** Whether the place has to be found again after the plan is drawn anew. */
  #kept = false;

  /** Sets the part here; false where none is chosen, so that the unit is selected instead. */
  choose(shape: SVGGElement): boolean {
    const part = this.#part(), found = this.#plan.drawn.units.get(shape);
    if (part === null || !found) return false;
    const why = this.#desk.reason(found.unit.fixed);
    if (why) this.#desk.refuse(why);
    else {
      this.#place = Math.max(0, this.#shapes.indexOf(shape));
      this.#kept = true;
      void this.#desk.send({ do: 'set-part', ...found.at, part });
    }
    return true;
  }

  key({ key, target }: KeyboardEvent): boolean {
    const shapes = this.#shapes, at = shapes.indexOf((target as Element).closest('.unit') as SVGGElement);
    if (at < 0) return false;
    const go = (to: number) => {
      const shape = shapes[to];
      if (!shape) return;
      shapes[at]!.setAttribute('tabindex', '-1');
      shape.setAttribute('tabindex', '0');
      this.#place = to;
      shape.focus();
    };
    switch (key) {
      // Units run to the left as they are written.
      case 'ArrowRight': case 'ArrowDown': go(at + 1); return true;
      case 'ArrowLeft': case 'ArrowUp': go(at - 1); return true;
      case 'Home': go(0); return true;
      case 'End': go(shapes.length - 1); return true;
      case 'Enter': case ' ': if (!this.choose(shapes[at]!)) this.#plan.pick(shapes[at]!); return true;
      default: return false;
    }
  }
}
