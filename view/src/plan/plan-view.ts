// The plan pane: one storey at a time, with the selection and the parts at the editor's cursor.

import type { App } from '../app.ts';
import { button, field, h, s } from '../ui/dom.ts';
import type { Model } from '../model/model.ts';
import type { State, Unit } from '../server/api.ts';
import { strings } from '../ui/strings.ts';
import { toPlan } from './coordinates.ts';
import { placeLengths } from './lengths.ts';
import { type PlanDrawing, extent, drawStorey, storeysOf } from './drawing.ts';
import { ScanLayer } from './scan.ts';
import { contains, Sheet } from './sheet.ts';

export class PlanView {
  readonly element: HTMLElement;
  readonly sheet = new Sheet();
  /** The scan under the plan. */
  readonly scan = new ScanLayer(this.sheet.svg);
  /** Walls in doubt. */
  readonly doubts = s('g', { class: 'doubts' });
  /** Overlay for the drawing tools. */
  readonly marks = s('g', { class: 'marks' });
  readonly tools = h('div', { class: 'plan-tools' });
  drawn: PlanDrawing = { layers: [], units: new Map(), walls: new Map(), rooms: new Map(), fixtures: new Map(), lengths: [] };
  storey = 1;
  /** Called when a unit is clicked; returns true if a tool has handled it. */
  onUnitClick: (shape: SVGGElement) => boolean = () => false;
  /** Called when the walls in doubt are to be drawn. */
  drawDoubts: () => void = () => {};
  /** Called after the plan is redrawn. */
  onRedraw: () => void = () => {};
  /** Called when the sheet has another scale. */
  onScale: () => void = () => {};
  /** True during a drag, while the plan must not be redrawn. */
  isDragging: () => boolean = () => false;
  /** The state shown. */
  state: State | null = null;
  #app: App;
  #file: string | null = null;
  #chooser = h('select', { onchange: () => this.choose(Number(this.#chooser.value)) });
  #compass = s('svg', { class: 'compass', viewBox: '-12 -16 24 30', 'aria-hidden': 'true' },
    s('path', { d: 'M0 -9L5 9L0 5L-5 9Z' }), s('text', { y: -10, 'text-anchor': 'middle', 'font-size': 7 }, strings.north));
  #scale = h('div', { class: 'scale', 'aria-hidden': 'true' });
  #empty = h('p', { class: 'empty' }, strings.planEmpty);
  #stale = true;
  #wanted: number | null = null;
  /** Model parts by unit, for the model in `#matched`. */
  #parts = new Map<Unit, number>();
  #matched: Model | null = null;

  constructor(app: App) {
    this.#app = app;
    const { sheet } = this;
    sheet.svg.setAttribute('aria-label', strings.planHelp);
    this.element = h('section', { class: 'pane plan', 'aria-label': strings.plan, hidden: true },
      h('div', { class: 'bar' }, field(strings.planStorey, this.#chooser),
        button('+', () => sheet.zoom(1 / 1.3), { 'aria-label': strings.nearer, 'data-do': 'nearer' }),
        button('−', () => sheet.zoom(1.3), { 'aria-label': strings.farther, 'data-do': 'farther' }),
        button(strings.planFit, () => this.fit(), { 'data-do': 'fit' }), this.scan.controls),
      this.tools, h('div', { class: 'paper' }, sheet.svg, this.#compass, this.#scale, legend(), this.#empty));
    sheet.moved = () => this.#measure();
    sheet.svg.addEventListener('click', event => {
      const shape = (event.target as Element).closest<SVGGElement>('.unit');
      if (shape && !this.onUnitClick(shape)) this.pick(shape);
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

  /** Switches to a storey as soon as it exists. */
  showWhenReady(storey: number) {
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
    const part = this.partAt(shape);
    if (part !== null) this.#app.select(part);
  }

  /** The model part of a unit; null if it has none. */
  partAt(shape: SVGGElement): number | null {
    const { model, state } = this.#app, unit = this.drawn.units.get(shape)?.unit;
    if (!model || !state || !unit) return null;
    if (this.#matched !== model) {
      this.#matched = model;
      this.#parts = partsOfUnits(state, model);
    }
    return this.#parts.get(unit) ?? null;
  }

  /** Redraws the plan if it is visible and out of date. */
  update() {
    const { state } = this.#app;
    if (this.element.hidden || !this.#stale || !state || this.isDragging()) return;
    this.#stale = false;
    const before = this.state && extent(this.state), whole = before && contains(this.sheet.frame, before);
    this.state = state;
    this.#matched = null;
    const storeys = storeysOf(state);
    if (this.#wanted !== null && storeys.includes(this.#wanted)) [this.storey, this.#wanted] = [this.#wanted, null];
    if (!storeys.includes(this.storey)) this.storey = storeys.findLast(n => n < this.storey) ?? storeys[0] ?? 1;
    this.#chooser.replaceChildren(...storeys.map(n => h('option', { value: n, selected: n === this.storey }, strings.storey(n))));
    this.#empty.hidden = storeys.length > 0;
    this.drawn = drawStorey(state, this.storey);
    this.scan.show(state, this.storey);
    this.sheet.svg.replaceChildren(this.scan.element, this.#street(), ...this.drawn.layers, this.doubts, this.marks);
    this.drawDoubts();
    const now = extent(state);
    // What an edit moves out of the sheet is brought back, where all of it was in view.
    if (this.#file !== state.file || whole && now && !contains(this.sheet.frame, now)) {
      this.#file = state.file;
      this.fit();
    } else this.#measure();
    this.#light();
    this.onRedraw();
  }

  /** A line along the first wall of each house, for the street. */
  #street(): SVGGElement {
    const group = s('g', { class: 'streets' });
    for (const house of this.#app.state?.plan.houses ?? []) {
      const wall = house.storeys[0]?.rings[0]?.walls[0];
      if (!wall) continue;
      const [x1, y1] = toPlan(house, [wall.from[0] - 1, wall.from[1] - 1.6]), [x2, y2] = toPlan(house, [wall.to[0] + 1, wall.to[1] - 1.6]);
      group.append(s('line', { x1, y1, x2, y2 }));
    }
    return group;
  }

  #light() {
    const { selection, renderer: { pointed } } = this.#app, lit = new Set(pointed.parts);
    for (const shape of this.drawn.units.keys()) {
      shape.classList.remove('selected', 'pointed');
    }
    if (selection === null && !lit.size) return;
    for (const shape of this.drawn.units.keys()) {
      const part = this.partAt(shape);
      if (part === null) continue;
      shape.classList.toggle('selected', part === selection);
      shape.classList.toggle('pointed', lit.has(part));
    }
  }

  /** Updates the scale bar to a round length, and the lengths of the walls. */
  #measure() {
    const pixel = this.sheet.pixel;
    placeLengths(this.drawn.lengths, pixel);
    this.onScale();
    const target = pixel * 120;
    const step = 10 ** Math.floor(Math.log10(target)), length = [5, 2, 1].map(n => n * step).find(n => n <= target) ?? step;
    this.#scale.style.width = `${length / pixel}px`;
    this.#scale.textContent = `${Number(length.toPrecision(2))} m`;
  }
}

/** The model part of each unit; units written at the same span are matched by order. */
function partsOfUnits({ plan }: State, { parts }: Model): Map<Unit, number> {
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
  return h('details', { class: 'legend' }, h('summary', {}, strings.legend), h('ul', {},
    row('walls', strings.legendWall, line('wall')), row('walls', strings.legendOpening, line('door')),
    row('walls', strings.legendLattice, line('lattice')), row('walls', strings.legendVoid, line('void')),
    row('regions', strings.legendRegion, s('rect', { class: 'region r0', x: 2, y: 1, width: 20, height: 10 })),
    row('roofs', strings.legendRidge, s('line', { class: 'ridge', x1: 2, y1: 6, x2: 22, y2: 6 })),
    row('roofs', strings.legendFall, s('path', { class: 'fall', d: 'M2 6H21M17 2L21 6L17 10' })),
    row('floors', strings.legendCourt, s('rect', { class: 'court', x: 2, y: 1, width: 20, height: 10 })),
    row('walls', strings.legendLength, s('text', { class: 'length', x: 12, y: 7, 'font-size': 10 }, strings.length('9'))),
    row('streets', strings.legendStreet, s('line', { x1: 2, y1: 6, x2: 22, y2: 6 }))));
}
