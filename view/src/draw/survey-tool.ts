// Tool for outlines in metres: draws the corners of a new house one by one, and drags the corners of surveyed outlines.

import type { XY } from '../plan/coordinates.ts';
import type { PlanView } from '../plan/plan-view.ts';
import type { PlanFrame } from '../server/api.ts';
import { s } from '../ui/dom.ts';
import { strings } from '../ui/strings.ts';
import { arrowWay, fromFrame, snapped, STEP, toFrame, WORLD } from './ground.ts';
import type { EditSession } from './session.ts';

/** A press so close to the first corner closes the outline, CSS pixels. */
const CLOSE = 14;
/** Radius of a handle, CSS pixels. */
const HANDLE = 8;

/** A corner being moved. */
interface Held { outline: number; corner: number; at: XY; drags: boolean }

export class SurveyTool {
  /** Handles of the corners; above the drawing. */
  readonly handles = s('g', { class: 'handles' });
  #plan: PlanView;
  #session: EditSession;
  /** The corners of a new outline, metres east and north. */
  #points: XY[] = [];
  /** The next corner. */
  #next: XY | null = null;
  #held: Held | null = null;
  #corners = new Map<SVGElement, { outline: number; corner: number }>();
  #focus: string | null = null;

  constructor(plan: PlanView, session: EditSession) {
    this.#plan = plan;
    this.#session = session;
  }

  /** Shows the corners of the outlines. */
  enable(on: boolean) {
    this.#held = null;
    this.#corners.clear();
    this.handles.remove();
    this.handles.replaceChildren();
    if (!on) return;
    for (const [outline, { corners, fixed, ...frame }] of (this.#plan.state?.plan.outlines ?? []).entries()) {
      for (const [corner, at] of fixed ? [] : corners.entries()) {
        const [x, y] = fromFrame(frame, at);
        const handle = s('circle', { class: 'corner', cx: x, cy: y, tabindex: 0, role: 'button', 'aria-label': strings.cornerOf(corner + 1, outline + 1) });
        this.#corners.set(handle, { outline, corner });
        this.handles.append(handle);
        if (this.#focus === `${outline} ${corner}`) setTimeout(() => handle.focus());
      }
    }
    this.#focus = null;
    this.#plan.sheet.svg.append(this.handles);
    this.scale();
  }

  /** Keeps the size of the handles on the screen. */
  scale() {
    for (const handle of this.#corners.keys()) handle.setAttribute('r', `${HANDLE * this.#plan.sheet.pixel}`);
  }

  down(event: PointerEvent): boolean {
    const corner = this.#corners.get(event.target as SVGElement);
    if (corner && !this.#points.length) { this.#hold(corner, true); return true; }
    const [first] = this.#points, at = this.#plan.sheet.place(event);
    if (first && this.#points.length > 2) {
      const [x, y] = fromFrame(WORLD, first);
      if (Math.hypot(x - at[0], y - at[1]) < CLOSE * this.#plan.sheet.pixel) { void this.#close(); return true; }
    }
    this.#add(this.#snap(WORLD, at));
    return true;
  }

  move(event: PointerEvent) {
    const at = this.#plan.sheet.place(event);
    if (this.#held) this.#held.at = this.#snap(this.#frame(this.#held), at);
    else this.#next = this.#snap(WORLD, at);
    this.#show();
  }

  async up() {
    if (this.#held?.drags) await this.#sendCorner();
  }

  key(event: KeyboardEvent): boolean {
    const corner = this.#corners.get(event.target as SVGElement), way = arrowWay(event.key), step = event.shiftKey ? 10 * STEP : STEP;
    if (event.key === 'Escape') { this.release(); return true; }
    if (corner && !this.#points.length) {
      if (event.key === 'Enter') { void this.#sendCorner(); return true; }
      if (!way) return false;
      if (this.#held?.outline !== corner.outline || this.#held.corner !== corner.corner) this.#hold(corner, false);
      const held = this.#held!, frame = this.#frame(held), [x, y] = fromFrame(frame, held.at);
      held.at = this.#snap(frame, [x + way[0] * step, y + way[1] * step]);
      this.#show();
      return true;
    }
    if (event.key === 'Enter' && this.#points.length) void this.#close();
    else if (event.key === 'Backspace' && this.#points.length) this.#points.pop();
    else if (event.key === ' ') this.#add(this.#next ?? this.#middle());
    else if (way) {
      const [east, north] = this.#next ?? this.#points.at(-1) ?? this.#middle();
      this.#next = [snapped(east + way[0] * step, STEP), snapped(north - way[1] * step, STEP)];
    } else return false;
    this.#show();
    return true;
  }

  release() {
    this.#points = [];
    this.#next = this.#held = null;
    this.#session.clear();
  }

  #middle(): XY {
    const { x, y, width, height } = this.#plan.sheet.frame;
    return this.#snap(WORLD, [x + width / 2, y + height / 2]);
  }

  #snap(frame: PlanFrame, at: XY): XY {
    const [east, north] = toFrame(frame, at);
    return [snapped(east, STEP), snapped(north, STEP)];
  }

  #frame({ outline }: { outline: number }): PlanFrame { return this.#plan.state!.plan.outlines[outline]!; }

  #hold(corner: { outline: number; corner: number }, drags: boolean) {
    this.#held = { ...corner, at: this.#plan.state!.plan.outlines[corner.outline]!.corners[corner.corner]!, drags };
  }

  #add(corner: XY) {
    const last = this.#points.at(-1);
    if (last?.[0] !== corner[0] || last[1] !== corner[1]) this.#points.push(corner);
    this.#next = corner;
    this.#show();
  }

  #show() {
    const held = this.#held;
    if (held) {
      const { corners, ...frame } = this.#plan.state!.plan.outlines[held.outline]!;
      const ring = corners.map((at, i) => fromFrame(frame, i === held.corner ? held.at : at));
      this.#session.sketch([ring], strings.placeAt(`${held.at[0]}`, `${held.at[1]}`), true);
      return;
    }
    const next = this.#next, last = this.#points.at(-1);
    if (!next) { this.#session.clear(); return; }
    const long = last ? Math.hypot(next[0] - last[0], next[1] - last[1]) : 0;
    const ring = [...this.#points, next].map(at => fromFrame(WORLD, at));
    this.#session.sketch([ring], strings.cornerAt(this.#points.length, long.toFixed(1)), false);
  }

  async #sendCorner() {
    const held = this.#held;
    this.#held = null;
    if (!held) return;
    const { outline, corner, at } = held, before = this.#plan.state!.plan.outlines[outline]!.corners[corner]!;
    if (at.every((n, k) => n === before[k])) { this.#session.clear(); return; }
    this.#focus = `${outline} ${corner}`;
    await this.#session.send({ do: 'move-corner', outline, corner, to: at });
  }

  async #close() {
    const points = this.#points;
    this.release();
    await this.#session.send({ do: 'draw-outline', points });
  }
}
