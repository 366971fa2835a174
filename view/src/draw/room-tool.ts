// Tool for rooms: a click into an area without a room makes one, a click on a room chooses it, a drag of its point moves it. Its
// panel holds the words of the chosen room, or those of the next one.

import { toHouse, toPlan } from '../plan/coordinates.ts';
import type { RoomIndex } from '../plan/drawing.ts';
import type { PlanView } from '../plan/plan-view.ts';
import type { House, Point, Room } from '../server/api.ts';
import { button, field, h } from '../ui/dom.ts';
import { strings } from '../ui/strings.ts';
import { arrow, type RoomWords, storeyUnder } from './edits.ts';
import { snapped } from './ground.ts';
import type { EditSession } from './session.ts';

/** The step of the keyboard, U, which stays between the lines of the grid; that of the pointer, and with Shift. */
const STEP = 1, FINE = 0.1;

/** Half the size of the mark at a point, CSS pixels. */
const MARK = 7;

/** The room being moved. */
interface Held {
  at: RoomIndex;
  house: House;
  room: Room;
  to: Point;
}

export class RoomTool {
  readonly element: HTMLElement;
  #plan: PlanView;
  #session: EditSession;
  #chosen: RoomIndex | null = null;
  #held: Held | null = null;
  /** Where the keyboard stands, on the plan's houses; null until it is used. */
  #cursor: { at: { house: number; storey: number }; house: House; point: Point } | null = null;
  /** The room that takes the focus when the plan is drawn again. */
  #focus: RoomIndex | null = null;
  /** A room is made at this point when the pointer is released. */
  #press: { house: number; storey: number; at: Point } | null = null;
  #name = h('input', { type: 'text', maxlength: 100, onchange: () => this.#change({ name: this.#name.value.trim() }) });
  #floor = this.#select('floor', strings.roomFloor);
  #mats = this.#select('mats', strings.roomMats);
  #ceiling = this.#select('ceiling', strings.roomCeiling);
  /** Empty for the height of the storey, which edits write as 0. */
  #height = h('input', { type: 'number', min: 1, max: 100, step: 0.1, 'data-room': 'height', onchange: () => this.#change({ height: this.#height.valueAsNumber || 0 }) });
  #title = h('p', { class: 'quiet' });
  #remove = button(strings.removeRoom, () => void this.#drop(this.#chosen), { 'data-do': 'remove-room' });

  constructor(plan: PlanView, session: EditSession) {
    this.#plan = plan;
    this.#session = session;
    this.element = h('fieldset', { class: 'room-panel', hidden: true }, h('legend', {}, strings.kind['room']!), this.#title,
      h('div', { class: 'buttons' }, field(strings.name, this.#name), field(strings.floorOfRoom, this.#floor), field(strings.matsOfRoom, this.#mats),
        field(strings.ceilingOfRoom, this.#ceiling), field(strings.heightOfRoom, this.#height), this.#remove));
    this.#fill();
  }

  /** Makes rooms focusable. */
  enable(on: boolean) {
    this.#held = this.#press = null;
    for (const [shape, { room, at }] of this.#plan.drawn.rooms) {
      if (!on) { for (const name of ['tabindex', 'role', 'aria-label', 'aria-pressed']) shape.removeAttribute(name); continue; }
      shape.setAttribute('tabindex', '0');
      shape.setAttribute('role', 'button');
      shape.setAttribute('aria-label', strings.roomOf(room.name, strings.roomFloor[room.floor] ?? ''));
      shape.setAttribute('aria-pressed', `${same(at, this.#chosen)}`);
      if (this.#focus && same(at, this.#focus)) { shape.focus(); this.#focus = null; }
    }
    if (this.#chosen && !this.#found(this.#chosen)) this.#chosen = null;
    this.#fill();
  }

  down(event: PointerEvent): boolean {
    const shape = (event.target as Element).closest<SVGGElement>('.room');
    const found = shape && this.#plan.drawn.rooms.get(shape);
    this.#cursor = null;
    if (found && (event.target as Element).closest('.room-point')) {
      this.#choose(found.at);
      return this.#hold(found);
    }
    const under = storeyUnder(this.#plan.state, this.#plan.storey, this.#plan.sheet.place(event));
    if (!found && !under) return false;
    if (found) { this.#choose(found.at); return true; }
    const at = toHouse(under!.shown, this.#plan.sheet.place(event));
    this.#press = { house: under!.house, storey: under!.storey, at: [snapped(at[0], FINE), snapped(at[1], FINE)] };
    return true;
  }

  move(event: PointerEvent) {
    const held = this.#held;
    if (!held) return;
    const [a, b] = toHouse(held.house, this.#plan.sheet.place(event));
    held.to = [snapped(a, FINE), snapped(b, FINE)];
    this.#mark(held.house, held.to);
  }

  async up() {
    const press = this.#press;
    this.#press = null;
    if (this.#held) await this.#moved();
    else if (press) await this.#add(press);
  }

  key(event: KeyboardEvent): boolean {
    const shape = (event.target as Element).closest<SVGGElement>('.room'), found = shape && this.#plan.drawn.rooms.get(shape);
    const enter = event.key === 'Enter' || event.key === ' ', step = event.shiftKey ? FINE : STEP;
    if (event.key === 'Escape') { this.release(); return true; }
    if (found) {
      if (event.key === 'Delete' || event.key === 'Backspace') { void this.#drop(found.at); return true; }
      if (enter) {
        if (this.#held) { this.#focus = found.at; void this.#moved(); } else { this.#choose(found.at); this.#name.focus(); }
        return true;
      }
      const way = arrow(event.key, found.house, toHouse);
      if (!way) return false;
      this.#choose(found.at);
      if (!this.#held && !this.#hold(found)) return true;
      const held = this.#held!;
      held.to = stepped(held.to, way, step);
      this.#mark(held.house, held.to);
      return true;
    }
    if (enter && this.#cursor) { void this.#add({ ...this.#cursor.at, at: this.#cursor.point }); return true; }
    const { frame } = this.#plan.sheet;
    const under = this.#cursor ?? (under => under && { at: under, house: under.shown, point: middle(under.shown, frame) })(
      storeyUnder(this.#plan.state, this.#plan.storey, [frame.x + frame.width / 2, frame.y + frame.height / 2], true));
    const way = under && arrow(event.key, under.house, toHouse);
    if (!under || !way) return false;
    this.#chosen = null;
    this.#fill();
    this.#cursor = { ...under, at: { house: under.at.house, storey: under.at.storey }, point: this.#cursor ? stepped(under.point, way, step) : under.point };
    this.#mark(under.house, this.#cursor.point);
    return true;
  }

  release() {
    this.#held = this.#press = this.#cursor = null;
    this.#session.clear();
  }

  /** A list of the words of an attribute, whose change is applied to the chosen room. */
  #select(attribute: 'floor' | 'mats' | 'ceiling', words: Record<string, string>): HTMLSelectElement {
    const list: HTMLSelectElement = h('select', { 'data-room': attribute, onchange: () => {
      this.#mats.disabled = this.#floor.value !== 'tatami';
      this.#change({ [attribute]: list.value });
    } }, ...Object.entries(words).map(([value, label]) => h('option', { value }, label)));
    return list;
  }

  #found(at: RoomIndex): Room | undefined { return this.#plan.state?.plan.houses[at.house]?.storeys[at.storey]?.rooms[at.room]; }

  #choose(at: RoomIndex) {
    this.#chosen = at;
    this.#cursor = null;
    for (const [shape, { at }] of this.#plan.drawn.rooms) shape.setAttribute('aria-pressed', `${same(at, this.#chosen)}`);
    this.#fill();
    const room = this.#found(at);
    if (room) this.#session.report(strings.roomChosen(room.name));
  }

  /** Shows the words of the chosen room. */
  #fill() {
    const room = this.#chosen && this.#found(this.#chosen);
    this.#title.textContent = room ? strings.roomOf(room.name, strings.roomFloor[room.floor] ?? '') : strings.nextRoom;
    this.#remove.disabled = !room;
    if (room) {
      if (document.activeElement !== this.#name) this.#name.value = room.name;
      [this.#floor.value, this.#mats.value, this.#ceiling.value] = [room.floor, room.mats, room.ceiling];
      if (document.activeElement !== this.#height) this.#height.value = room.height === null ? '' : `${Number(room.height.toFixed(3))}`;
      const { house, storey } = this.#chosen!;
      this.#height.placeholder = `${Number(this.#plan.state!.plan.houses[house]!.storeys[storey]!.height.toFixed(2))}`;
    }
    this.#mats.disabled = this.#floor.value !== 'tatami';
  }

  #hold({ at, house, room }: { at: RoomIndex; house: House; room: Room }): boolean {
    const why = this.#session.reason(room.fixed);
    if (why) { this.#session.refuse(why); return false; }
    this.#held = { at, house, room, to: [...room.at] };
    this.#mark(house, room.at);
    return true;
  }

  /** Draws a mark at a point of a house. */
  #mark(house: House, point: Point) {
    const [x, y] = toPlan(house, point), size = MARK * this.#plan.sheet.pixel;
    this.#session.sketch([[[x - size, y], [x + size, y]], [[x, y - size], [x, y + size]]], strings.pointAt(`${point[0]}`, `${point[1]}`), false);
  }

  async #moved() {
    const held = this.#held;
    this.#held = null;
    if (!held) return;
    if (held.to.every((n, k) => n === held.room.at[k])) { this.#session.clear(); return; }
    await this.#session.send({ do: 'set-room', ...held.at, at: held.to });
  }

  async #add({ house, storey, at }: { house: number; storey: number; at: Point }) {
    const made = { house, storey, room: this.#plan.state?.plan.houses[house]?.storeys[storey]?.rooms.length ?? 0 };
    const name = this.#chosen ? '' : this.#name.value.trim();
    // What is shown of the chosen room is not meant for the next one.
    const height = this.#chosen || !this.#height.value ? {} : { height: this.#height.valueAsNumber };
    this.#cursor = null;
    if (!await this.#session.send({ do: 'add-room', house, storey, at, name, floor: this.#floor.value, mats: this.#mats.value, ceiling: this.#ceiling.value, ...height })) return;
    // What is typed next is its name.
    this.#choose(made);
    this.#name.focus();
    this.#name.select();
  }

  #change(words: RoomWords) {
    const at = this.#chosen, room = at && this.#found(at);
    if (!at || !room) return;
    const why = this.#session.reason(room.fixed);
    if (why) this.#session.refuse(why);
    else if (words.name !== room.name) void this.#session.send({ do: 'set-room', ...at, ...words });
  }

  async #drop(at: RoomIndex | null) {
    const room = at && this.#found(at);
    if (!at || !room) return;
    const why = this.#session.reason(room.fixed);
    this.#chosen = null;
    if (why) this.#session.refuse(why);
    else await this.#session.send({ do: 'remove-room', ...at });
  }
}

const same = (one: RoomIndex, other: RoomIndex | null) =>
  other !== null && one.house === other.house && one.storey === other.storey && one.room === other.room;

const stepped = ([a, b]: Point, [x, y]: Point, step: number): Point => [snapped(a + x * step, FINE), snapped(b + y * step, FINE)];

/** The point between lines of the grid that is nearest to the middle of a frame. */
function middle(house: House, { x, y, width, height }: { x: number; y: number; width: number; height: number }): Point {
  const [a, b] = toHouse(house, [x + width / 2, y + height / 2]);
  return [Math.floor(a) + 0.5, Math.floor(b) + 0.5];
}
