// Tool for what is built into rooms: a click places one of the kind in the panel, with its middle there; one that stands is
// chosen by a click, moved by a drag, and drawn larger by its corner. The panel holds what is chosen, or what comes next.

import { toHouse } from '../plan/coordinates.ts';
import type { FixtureIndex } from '../plan/drawing.ts';
import type { PlanView } from '../plan/plan-view.ts';
import { rectangleOf } from '../plan/rooms.ts';
import type { Faces, Fixture, House, Point } from '../server/api.ts';
import { button, field, h } from '../ui/dom.ts';
import { strings } from '../ui/strings.ts';
import { arrow, type FixtureWords, storeyUnder } from './edits.ts';
import { snapped } from './ground.ts';
import type { EditSession } from './session.ts';

/** Places and sizes are multiples of a quarter, U; the keyboard goes by whole units without Shift. */
const FINE = 0.25, STEP = 1;

/** The usual width along the front and depth, U: it is not written. */
const USUAL: Record<string, Point> = {
  tokonoma: [2, 1], chigaidana: [2, 1], butsudan: [1, 1], 'oshi-ire': [2, 1], stairs: [1, 3], 'hako-kaidan': [1, 3], kamado: [2, 0.75], well: [1, 1], sink: [2, 0.75],
};

/** The sides in the order in which one turns, clockwise as seen from above. */
const TURNS: Faces[] = ['F', 'L', 'B', 'R'];

/** What is being moved or drawn larger. */
interface Held {
  found: { at: FixtureIndex; fixture: Fixture; house: House };
  /** Where the pointer took it, from its least corner; null where its size is drawn. */
  grip: Point | null;
  at: Point;
  size: Point;
}

export class FixtureTool {
  readonly element: HTMLElement;
  #plan: PlanView;
  #session: EditSession;
  #chosen: FixtureIndex | null = null;
  #held: Held | null = null;
  /** Where the next one would stand for the keyboard: its least corner; null until it is used. */
  #cursor: { house: number; storey: number; shown: House; at: Point } | null = null;
  /** What takes the focus when the plan is drawn again. */
  #focus: FixtureIndex | null = null;
  /** One is placed here when the pointer is released. */
  #press: { house: number; storey: number; shown: House; at: Point } | null = null;
  #kind = h('select', { 'data-fixture': 'kind', onchange: () => { if (!this.#change({ kind: this.#kind.value })) this.#usual(); } },
    ...Object.entries(strings.fixtureKind).map(([value, label]) => h('option', { value }, label)));
  #faces = h('select', { 'data-fixture': 'faces', onchange: () => this.#change({ faces: this.#faces.value }) },
    ...TURNS.map(value => h('option', { value }, strings.fixtureFaces[value])));
  #wide = this.#number('width');
  #deep = this.#number('depth');
  #title = h('p', { class: 'quiet' });
  #remove = button(strings.removeFixture, () => void this.#drop(this.#chosen), { 'data-do': 'remove-fixture' });
  #turn = button(strings.turnFixture, () => void this.#turned(this.#chosen), { 'data-do': 'turn-fixture' });

  constructor(plan: PlanView, session: EditSession) {
    this.#plan = plan;
    this.#session = session;
    this.element = h('fieldset', { class: 'room-panel', hidden: true }, h('legend', {}, strings.fixture), this.#title,
      h('div', { class: 'buttons' }, field(strings.kindOfFixture, this.#kind), field(strings.facesOfFixture, this.#faces), field(strings.widthOfFixture, this.#wide),
        field(strings.depthOfFixture, this.#deep), this.#turn, this.#remove));
    this.#usual();
    this.#fill();
  }

  /** Makes fixtures focusable. */
  enable(on: boolean) {
    this.#held = this.#press = null;
    if (this.#chosen && !this.#found(this.#chosen)) this.#chosen = null;
    for (const [shape, { fixture, at }] of this.#plan.drawn.fixtures) {
      if (!on) { for (const name of ['tabindex', 'role', 'aria-label', 'aria-pressed']) shape.removeAttribute(name); continue; }
      shape.setAttribute('tabindex', '0');
      shape.setAttribute('role', 'button');
      shape.setAttribute('aria-label', told(fixture));
      shape.setAttribute('aria-pressed', `${same(at, this.#chosen)}`);
      if (this.#focus && same(at, this.#focus)) { shape.focus(); this.#focus = null; }
    }
    this.#fill();
  }

  down(event: PointerEvent): boolean {
    const target = event.target as Element, shape = target.closest<SVGGElement>('.fixture'), found = shape && this.#plan.drawn.fixtures.get(shape);
    const place = this.#plan.sheet.place(event);
    this.#cursor = null;
    if (found) {
      this.#choose(found.at);
      const { at } = found.fixture, [a, b] = toHouse(found.house, place);
      return this.#hold(found, target.closest('.fixture-corner') ? null : [a - at[0], b - at[1]]);
    }
    const under = storeyUnder(this.#plan.state, this.#plan.storey, place), size = this.#next();
    if (!under || !size) return false;
    const [a, b] = toHouse(under.shown, place);
    this.#press = { ...under, at: [snapped(a - size[0] / 2, FINE), snapped(b - size[1] / 2, FINE)] };
    return true;
  }

  move(event: PointerEvent) {
    const held = this.#held;
    if (!held) return;
    const [a, b] = toHouse(held.found.house, this.#plan.sheet.place(event)), { at } = held.found.fixture;
    if (held.grip) held.at = [snapped(a - held.grip[0], FINE), snapped(b - held.grip[1], FINE)];
    else held.size = [Math.max(FINE, snapped(a - at[0], FINE)), Math.max(FINE, snapped(b - at[1], FINE))];
    this.#show(held.found.house, held.at, held.size);
  }

  async up() {
    const press = this.#press;
    this.#press = null;
    if (this.#held) await this.#apply();
    else if (press) await this.#add(press);
  }

  key(event: KeyboardEvent): boolean {
    const shape = (event.target as Element).closest<SVGGElement>('.fixture'), found = shape && this.#plan.drawn.fixtures.get(shape);
    const enter = event.key === 'Enter' || event.key === ' ', step = event.shiftKey ? FINE : STEP;
    if (event.key === 'Escape') { this.release(); return true; }
    if (found) {
      if (event.key === 'Delete' || event.key === 'Backspace') { void this.#drop(found.at); return true; }
      if (event.key.toLowerCase() === 'r' && !event.altKey) { this.#focus = found.at; void this.#turned(found.at); return true; }
      if (enter) {
        if (this.#held) { this.#focus = found.at; void this.#apply(); } else { this.#choose(found.at); this.#kind.focus(); }
        return true;
      }
      const way = arrow(event.key, found.house, toHouse);
      if (!way) return false;
      this.#choose(found.at);
      if (!this.#held && !this.#hold(found, [0, 0])) return true;
      const held = this.#held!;
      held.at = stepped(held.at, way, step);
      this.#show(held.found.house, held.at, held.size);
      return true;
    }
    if (enter && this.#cursor) { void this.#add(this.#cursor); return true; }
    const { x, y, width, height } = this.#plan.sheet.frame;
    const under = this.#cursor ?? storeyUnder(this.#plan.state, this.#plan.storey, [x + width / 2, y + height / 2], true);
    const way = under && arrow(event.key, under.shown, toHouse);
    if (!under || !way) return false;
    this.#chosen = null;
    this.#fill();
    const size = this.#next();
    if (!size) return true;
    const [a, b] = toHouse(under.shown, [x + width / 2, y + height / 2]), middle: Point = [Math.round(a - size[0] / 2), Math.round(b - size[1] / 2)];
    this.#cursor = { ...under, at: 'at' in under ? stepped(under.at as Point, way, step) : middle };
    this.#show(under.shown, this.#cursor.at, size);
    return true;
  }

  release() {
    this.#held = this.#press = this.#cursor = null;
    this.#session.clear();
  }

  /** A field for the width or the depth. */
  #number(name: 'width' | 'depth'): HTMLInputElement {
    return h('input', { type: 'number', min: FINE, max: 60, step: FINE, 'data-fixture': name, onchange: () => {
      const size = this.#next();
      if (size) this.#change({ size });
      else if (this.#chosen) this.#fill();
    } });
  }

  #found(at: FixtureIndex): Fixture | undefined { return this.#plan.state?.plan.houses[at.house]?.storeys[at.storey]?.fixtures[at.fixture]; }

  /** What the fields say of the extent along a and b; null where they hold no numbers. */
  #next(): Point | null {
    const size: Point = [this.#wide.valueAsNumber, this.#deep.valueAsNumber];
    return size.every(n => n > 0) ? turned(size, this.#faces.value as Faces) : null;
  }

  /** Sets the fields to the usual size of the kind. */
  #usual() {
    const [wide, deep] = USUAL[this.#kind.value]!;
    [this.#wide.value, this.#deep.value] = [`${wide}`, `${deep}`];
  }

  #choose(at: FixtureIndex) {
    this.#chosen = at;
    this.#cursor = null;
    for (const [shape, { at }] of this.#plan.drawn.fixtures) shape.setAttribute('aria-pressed', `${same(at, this.#chosen)}`);
    this.#fill();
    const fixture = this.#found(at);
    if (fixture) this.#session.report(strings.fixtureChosen(told(fixture)));
  }

  /** Shows what is chosen. */
  #fill() {
    const fixture = this.#chosen && this.#found(this.#chosen);
    this.#title.textContent = fixture ? told(fixture) : strings.nextFixture;
    this.#remove.disabled = this.#turn.disabled = !fixture;
    if (!fixture) return;
    [this.#kind.value, this.#faces.value] = [fixture.kind, fixture.faces];
    [this.#wide.value, this.#deep.value] = turned(fixture.size, fixture.faces).map(n => `${Number(n.toFixed(3))}`) as [string, string];
  }

  #hold(found: Held['found'], grip: Point | null): boolean {
    const why = this.#session.reason(found.fixture.fixed);
    if (why) { this.#session.refuse(why); return false; }
    this.#held = { found, grip, at: [...found.fixture.at], size: [...found.fixture.size] };
    return true;
  }

  #show(house: House, at: Point, size: Point) {
    this.#session.ghost(house, rectangleOf(at, size), `${strings.pointAt(`${at[0]}`, `${at[1]}`)}, ${strings.rectangle(size[0], size[1])}`, true);
  }

  async #apply() {
    const held = this.#held;
    this.#held = null;
    if (!held) return;
    const { at, fixture } = held.found, moved = held.at.some((n, k) => n !== fixture.at[k]), sized = held.size.some((n, k) => n !== fixture.size[k]);
    if (moved || sized) await this.#session.send({ do: 'set-fixture', ...at, ...(moved ? { at: held.at } : {}), ...(sized ? { size: held.size } : {}) });
    else this.#plan.marks.replaceChildren();
  }

  async #add({ house, storey, at }: { house: number; storey: number; at: Point }) {
    const size = this.#next(), made = { house, storey, fixture: this.#plan.state?.plan.houses[house]?.storeys[storey]?.fixtures.length ?? 0 };
    this.#cursor = null;
    if (size && await this.#session.send({ do: 'add-fixture', house, storey, at, kind: this.#kind.value, size, faces: this.#faces.value })) this.#choose(made);
  }

  /** Changes what is chosen; false if nothing is. */
  #change(words: FixtureWords): boolean {
    const at = this.#chosen, fixture = at && this.#found(at);
    if (!at || !fixture) return false;
    const why = this.#session.reason(fixture.fixed);
    if (why) this.#session.refuse(why);
    // What is refused is not shown any longer.
    else void this.#session.send({ do: 'set-fixture', ...at, ...words }).then(applied => { if (!applied) this.#fill(); });
    return true;
  }

  async #turned(at: FixtureIndex | null) {
    const fixture = at && this.#found(at);
    if (!at || !fixture) return;
    this.#choose(at);
    this.#change({ faces: TURNS[(TURNS.indexOf(fixture.faces) + 1) % TURNS.length]! });
  }

  async #drop(at: FixtureIndex | null) {
    const fixture = at && this.#found(at);
    if (!at || !fixture) return;
    const why = this.#session.reason(fixture.fixed);
    this.#chosen = null;
    if (why) this.#session.refuse(why);
    else await this.#session.send({ do: 'remove-fixture', ...at });
  }
}

const same = (one: FixtureIndex, other: FixtureIndex | null) =>
  other !== null && one.house === other.house && one.storey === other.storey && one.fixture === other.fixture;

const stepped = ([a, b]: Point, [x, y]: Point, step: number): Point => [snapped(a + x * step, FINE), snapped(b + y * step, FINE)];

/** Width and depth from the extent along a and b, and the other way. */
const turned = ([a, b]: Point, faces: Faces): Point => faces === 'F' || faces === 'B' ? [a, b] : [b, a];

/** What a screen reader says of a fixture. */
function told({ kind, at, size, faces, built }: Fixture): string {
  const name = strings.fixtureKind[kind] ?? kind, short = (n: number) => `${Number(n.toFixed(2))}`;
  const text = strings.fixtureOf(name, strings.fixtureFaces[faces]!, ...turned(size, faces).map(short) as [string, string], strings.pointAt(short(at[0]), short(at[1])));
  return built ? text : strings.leftOut(text);
}
