// The plan of the houses: one storey at a time, with what is selected and what the editor's cursor stands at.

import type { App } from '../app.ts';
import { button, field, h, s } from '../dom.ts';
import type { Model } from '../model.ts';
import type { State, Unit } from '../server.ts';
import { words } from '../words.ts';
import { to_plan } from './frame.ts';
import { type Drawn, extent, picture, storeys_of } from './picture.ts';
import { Sheet } from './sheet.ts';

export class PlanView {
  readonly element: HTMLElement;
  readonly sheet = new Sheet();
  /** Over the plan, for those who draw on it. */
  readonly marks = s('g', { class: 'marks' });
  readonly tools = h('div', { class: 'plan-tools' });
  drawn: Drawn = { layers: [], units: new Map(), walls: new Map() };
  storey = 1;
  /** A unit was chosen; true: it is taken care of. */
  on_unit: (shape: SVGGElement) => boolean = () => false;
  /** The plan was drawn anew. */
  on_drawn: () => void = () => {};
  /** Whether somebody draws on it just now, so that it stays as it is. */
  held: () => boolean = () => false;
  /** What it was drawn from. */
  state: State | null = null;
  #app: App;
  #file: string | null = null;
  #chooser = h('select', { onchange: () => this.choose(Number(this.#chooser.value)) });
  #compass = s('svg', { class: 'compass', viewBox: '-12 -16 24 30', 'aria-hidden': 'true' },
    s('path', { d: 'M0 -9L5 9L0 5L-5 9Z' }), s('text', { y: -10, 'text-anchor': 'middle', 'font-size': 7 }, words.north));
  #scale = h('div', { class: 'scale', 'aria-hidden': 'true' });
  #empty = h('p', { class: 'empty' }, words.plan_empty);
  #stale = true;
  #wanted: number | null = null;
  /** The parts that units are, in the model that they were found in. */
  #parts = new Map<Unit, number>();
  #matched: Model | null = null;

  constructor(app: App) {
    this.#app = app;
    const { sheet } = this;
    sheet.svg.setAttribute('aria-label', words.plan_how);
    this.element = h('section', { class: 'pane plan', 'aria-label': words.plan, hidden: true },
      h('div', { class: 'bar' }, field(words.plan_storey, this.#chooser),
        button('+', () => sheet.zoom(1 / 1.3), { 'aria-label': words.nearer, 'data-do': 'nearer' }),
        button('−', () => sheet.zoom(1.3), { 'aria-label': words.farther, 'data-do': 'farther' }),
        button(words.plan_fit, () => this.fit(), { 'data-do': 'fit' })),
      this.tools, h('div', { class: 'paper' }, sheet.svg, this.#compass, this.#scale, legend(), this.#empty));
    sheet.moved = () => this.#measure();
    sheet.svg.addEventListener('click', event => {
      const shape = (event.target as Element).closest<SVGGElement>('.unit');
      if (shape && !this.on_unit(shape)) this.pick(shape);
    });
    app.on('state', () => { this.#stale = true; this.update(); });
    app.on('select', () => this.#light());
    app.on('cursor', () => this.#light());
  }

  choose(storey: number) {
    this.storey = storey;
    this.#stale = true;
    this.update();
  }

  /** Shows a storey as soon as there is one of this number. */
  want(storey: number) {
    this.storey = storey;
    this.#wanted = storey;
    this.#stale = true;
    this.update();
  }

  fit() {
    const { state } = this.#app;
    this.sheet.fit(state && extent(state));
  }

  /** Selects the part of a unit. */
  pick(shape: SVGGElement) {
    const part = this.part_of(shape);
    if (part !== null) this.#app.select(part);
  }

  /** The part of the model that a unit is; null where there is nothing to see. */
  part_of(shape: SVGGElement): number | null {
    const { model, state } = this.#app, unit = this.drawn.units.get(shape)?.unit;
    if (!model || !state || !unit) return null;
    if (this.#matched !== model) {
      this.#matched = model;
      this.#parts = parts_of_units(state, model);
    }
    return this.#parts.get(unit) ?? null;
  }

  /** Draws anew what has changed, if the plan is shown. */
  update() {
    const { state } = this.#app;
    if (this.element.hidden || !this.#stale || !state || this.held()) return;
    this.#stale = false;
    this.state = state;
    this.#matched = null;
    const storeys = storeys_of(state);
    if (this.#wanted !== null && storeys.includes(this.#wanted)) [this.storey, this.#wanted] = [this.#wanted, null];
    if (!storeys.includes(this.storey)) this.storey = storeys.findLast(n => n < this.storey) ?? storeys[0] ?? 1;
    this.#chooser.replaceChildren(...storeys.map(n => h('option', { value: n, selected: n === this.storey }, words.storey(n))));
    this.#empty.hidden = storeys.length > 0;
    this.drawn = picture(state, this.storey);
    this.sheet.svg.replaceChildren(this.#street(), ...this.drawn.layers, this.marks);
    if (this.#file !== state.file) {
      this.#file = state.file;
      this.fit();
    }
    this.#light();
    this.on_drawn();
  }

  /** A line along each first wall, where the street is. */
  #street(): SVGGElement {
    const group = s('g', { class: 'streets' });
    for (const house of this.#app.state?.plan.houses ?? []) {
      const wall = house.storeys[0]?.rings[0]?.walls[0];
      if (!wall) continue;
      const [x1, y1] = to_plan(house, [wall.from[0] - 1, wall.from[1] - 1.6]), [x2, y2] = to_plan(house, [wall.to[0] + 1, wall.to[1] - 1.6]);
      group.append(s('line', { x1, y1, x2, y2 }));
    }
    return group;
  }

  #light() {
    const { selection, pointed } = this.#app, lit = new Set(pointed.parts);
    for (const shape of this.drawn.units.keys()) {
      shape.classList.remove('selected', 'pointed');
    }
    if (selection === null && !lit.size) return;
    for (const shape of this.drawn.units.keys()) {
      const part = this.part_of(shape);
      if (part === null) continue;
      shape.classList.toggle('selected', part === selection);
      shape.classList.toggle('pointed', lit.has(part));
    }
  }

  /** A measure of a round length. */
  #measure() {
    const pixel = this.sheet.pixel, want = pixel * 120;
    const step = 10 ** Math.floor(Math.log10(want)), length = [5, 2, 1].map(n => n * step).find(n => n <= want) ?? step;
    this.#scale.style.width = `${length / pixel}px`;
    this.#scale.textContent = `${Number(length.toPrecision(2))} m`;
  }
}

/** Which part of the model each unit is; those written at one place are told apart by their order. */
function parts_of_units({ plan }: State, { parts }: Model): Map<Unit, number> {
  const written = new Map<string, number[]>(), turns = new Map<string, number>(), found = new Map<Unit, number>();
  for (const [i, { kind, file, span }] of parts.entries()) {
    if (kind !== 'part' || !span) continue;
    const key = `${file} ${span}`, list = written.get(key);
    if (list) list.push(i); else written.set(key, [i]);
  }
  for (const { storeys } of plan.houses) for (const { rings } of storeys) for (const { walls } of rings) {
    for (const unit of walls.flatMap(wall => wall.units)) {
      const key = `${unit.file} ${unit.span}`, turn = turns.get(key) ?? 0, list = written.get(key);
      turns.set(key, turn + 1);
      if (list) found.set(unit, list[Math.min(turn, list.length - 1)]!);
    }
  }
  return found;
}

function legend(): HTMLElement {
  const row = (name: string, label: string, shape: SVGElement) =>
    h('li', {}, s('svg', { viewBox: '0 0 24 12', class: 'key', 'aria-hidden': 'true' }, s('g', { class: name }, shape)), label);
  const line = (name: string) => s('g', { class: `unit ${name}` }, s('line', { class: 'base', x1: 2, y1: 6, x2: 22, y2: 6 }),
    s('line', { class: 'inner', x1: 2, y1: 6, x2: 22, y2: 6 }));
  return h('details', { class: 'legend' }, h('summary', {}, words.legend), h('ul', {},
    row('walls', words.legend_wall, line('wall')), row('walls', words.legend_opening, line('door')),
    row('walls', words.legend_lattice, line('lattice')), row('walls', words.legend_void, line('void')),
    row('regions', words.legend_region, s('rect', { class: 'region r0', x: 2, y: 1, width: 20, height: 10 })),
    row('roofs', words.legend_ridge, s('line', { class: 'ridge', x1: 2, y1: 6, x2: 22, y2: 6 })),
    row('roofs', words.legend_fall, s('path', { class: 'fall', d: 'M2 6H21M17 2L21 6L17 10' })),
    row('floors', words.legend_court, s('rect', { class: 'court', x: 2, y: 1, width: 20, height: 10 })),
    row('walls', words.legend_length, s('text', { class: 'length', x: 12, y: 7, 'font-size': 11 }, '18')),
    row('streets', words.legend_street, s('line', { x1: 2, y1: 6, x2: 22, y2: 6 }))));
}
