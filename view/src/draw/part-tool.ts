// Tool for placing parts: a unit of the plan takes the part chosen in the palette.

import type { PlanView } from '../plan/plan-view.ts';
import { strings } from '../ui/strings.ts';
import type { EditSession } from './session.ts';

export class PartTool {
  #plan: PlanView;
  #session: EditSession;
  #part: () => string | null;
  /** Index of the unit in the tab order, kept when the plan is redrawn. */
  #place = 0;

  constructor(plan: PlanView, session: EditSession, part: () => string | null) {
    this.#plan = plan;
    this.#session = session;
    this.#part = part;
  }

  get #shapes(): SVGGElement[] { return [...this.#plan.drawn.units.keys()]; }

  /** Roving tabindex: Tab reaches one unit, arrow keys the others. */
  enable(on: boolean) {
    const focused = document.activeElement === document.body || this.#plan.sheet.svg.contains(document.activeElement);
    for (const [i, shape] of this.#shapes.entries()) {
      if (!on) { for (const name of ['tabindex', 'role', 'aria-label']) shape.removeAttribute(name); continue; }
      const { at, unit } = this.#plan.drawn.units.get(shape)!;
      shape.setAttribute('tabindex', i === this.#place ? '0' : '-1');
      shape.setAttribute('role', 'button');
      shape.setAttribute('aria-label', strings.unitOf(unit.code, at.unit + 1));
    }
    if (!on) return;
    if (focused && this.#kept) this.#shapes[this.#place]?.focus();
    this.#kept = false;
  }

  /** True if the focus must be restored after the plan is redrawn. */
  #kept = false;

  /** Places the chosen part; returns false if none is chosen, so that the unit is selected instead. */
  choose(shape: SVGGElement): boolean {
    const part = this.#part(), found = this.#plan.drawn.units.get(shape);
    if (part === null || !found) return false;
    const why = this.#session.reason(found.unit.fixed);
    if (why) this.#session.refuse(why);
    else {
      this.#place = Math.max(0, this.#shapes.indexOf(shape));
      this.#kept = true;
      void this.#session.send({ do: 'set-part', ...found.at, part });
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
      // Units run from right to left in a wall's row.
      case 'ArrowRight': case 'ArrowDown': go(at + 1); return true;
      case 'ArrowLeft': case 'ArrowUp': go(at - 1); return true;
      case 'Home': go(0); return true;
      case 'End': go(shapes.length - 1); return true;
      case 'Enter': case ' ': if (!this.choose(shapes[at]!)) this.#plan.pick(shapes[at]!); return true;
      default: return false;
    }
  }
}
