// The drawing tool: tools over the plan, each stroke of which changes the text. The text stays the truth: what is seen is
// always what was read from it.

import type { App } from '../app.ts';
import { button, field, h, is_field, new_id, tick } from '../dom.ts';
import type { PlanView } from '../plan/view.ts';
import { switch_of } from '../toolbar.ts';
import { words } from '../words.ts';
import { Desk } from './desk.ts';
import { OutlineTool } from './outline.ts';
import { name_of, Palette } from './palette.ts';
import { UnitTool } from './units.ts';
import { WallTool } from './walls.ts';

const TOOLS = ['part', 'wall', 'break', 'outline'] as const;
type Tool = (typeof TOOLS)[number];

export class DrawTool {
  on = false;
  tool: Tool = 'part';
  readonly desk: Desk;
  readonly #app: App;
  readonly #plan: PlanView;
  #switch = switch_of(words.draw_on, on => this.set(on), 'draw');
  #palette: Palette;
  #walls: WallTool;
  #outline: OutlineTool;
  #units: UnitTool;
  #how = h('p', { class: 'quiet' });
  #house = h('select', { onchange: () => this.#fill() });
  #houses = field(words.plan_house, this.#house);
  #height = h('input', { type: 'number', min: 1, max: 100, step: 0.1, onkeydown: (event: KeyboardEvent) => { if (event.key === 'Enter') this.#set_height(); } });
  #all = tick(words.all_storeys, false, on => { this.#walls.all = on; });
  /** What draws now: a mouse, a pen or a finger. */
  #finger: number | null = null;
  /** Whether it has moved since it came down. */
  #dragged = false;
  #bar: HTMLElement;

  constructor(app: App, plan: PlanView) {
    this.#app = app;
    this.#plan = plan;
    this.desk = new Desk(app, plan);
    this.#palette = new Palette(app);
    this.#walls = new WallTool(app, plan, this.desk);
    this.#outline = new OutlineTool(app, plan, this.desk);
    this.#units = new UnitTool(plan, this.desk, () => this.#palette.chosen?.code ?? null);
    this.#palette.changed = () => this.desk.say(words.part_chosen(name_of(this.#palette.chosen!)));
    const name = new_id();
    this.#bar = h('div', { class: 'draw', hidden: true },
      h('fieldset', { class: 'tools' }, h('legend', { class: 'hidden' }, words.tool), ...TOOLS.map(tool => h('label', { class: 'tick' },
        h('input', { type: 'radio', name, value: tool, checked: tool === this.tool, onchange: () => this.choose(tool) }), words[`tool_${tool}`]))),
      h('div', { class: 'buttons' },
        button(words.undo, () => void this.desk.undo(), { 'data-do': 'undo', title: 'Ctrl+Z' }),
        button(words.redo, () => void this.desk.redo(), { 'data-do': 'redo', title: 'Ctrl+Shift+Z' })),
      this.#all, this.#how, this.#palette.element, this.#houses,
      h('div', { class: 'buttons' },
        button(words.add_storey, () => void this.#add(), { 'data-do': 'add-storey' }),
        button(words.remove_storey, () => void this.#remove(), { 'data-do': 'remove-storey' }),
        button(words.remove_house, () => void this.desk.send({ do: 'remove-house', house: this.#at() }), { 'data-do': 'remove-house' }),
        field(words.height, this.#height, button(words.set_height, () => this.#set_height(), { 'data-do': 'set-height' }))),
      this.desk.said);
    plan.element.querySelector('.bar')!.append(this.#switch);
    plan.tools.append(this.#bar);
    // The click at the end of a drag means nothing.
    plan.on_unit = shape => this.#dragged || this.on && this.tool === 'part' && this.#units.choose(shape);
    plan.on_drawn = () => {
      this.desk.clear(); // what lay on a plan that is no longer there
      this.#fill();
      this.#enable();
    };
    plan.held = () => this.#finger !== null;
    plan.sheet.moves = target => !this.on || this.tool === 'part' || this.tool !== 'outline' && !target.closest('.run');
    app.on('files', () => {
      this.#switch.disabled = !app.hello.writes;
      this.#switch.title = app.hello.writes ? '' : words.draw_off_why;
      if (!app.hello.writes) this.set(false);
      if (this.on) void this.#palette.fill();
    });
    this.#attend();
    this.choose(this.tool);
  }

  set(on: boolean) {
    this.on = on;
    this.#bar.hidden = !on;
    this.#switch.setAttribute('aria-pressed', `${on}`);
    this.#plan.element.classList.toggle('drawing', on);
    this.desk.clear();
    if (on) void this.#palette.fill();
    this.#fill();
    this.#enable();
  }

  choose(tool: Tool) {
    this.tool = tool;
    this.#walls.breaks = tool === 'break';
    this.#palette.element.hidden = tool !== 'part';
    this.#all.hidden = tool !== 'wall';
    this.#how.textContent = words[`how_${tool}`];
    this.#plan.element.dataset.tool = tool;
    this.#walls.release();
    this.#outline.release();
    this.#enable();
  }

  /** Ends a drag without a stroke. */
  #let_go() {
    this.#finger = null;
    this.#walls.release();
    this.#outline.release();
    this.desk.say('');
    this.#plan.update();
  }

  #enable() {
    this.#walls.enable(this.on && (this.tool === 'wall' || this.tool === 'break'));
    this.#units.enable(this.on && this.tool === 'part');
  }

  #attend() {
    const plan = this.#plan, { svg } = plan.sheet;
    const held = () => this.tool === 'outline' ? this.#outline : this.tool === 'part' ? null : this.#walls;
    svg.addEventListener('pointerdown', event => {
      this.#dragged = false;
      if (!this.on || event.button !== 0) return;
      // A second finger means to zoom.
      if (this.#finger !== null) { this.#let_go(); return; }
      if (!held()?.down(event)) return;
      this.#finger = event.pointerId;
      event.preventDefault();
    });
    const own = ({ pointerId }: PointerEvent) => this.on && pointerId === this.#finger;
    window.addEventListener('pointermove', event => {
      if (!own(event)) return;
      this.#dragged = true;
      held()?.move(event);
    });
    window.addEventListener('pointerup', event => {
      if (!own(event)) return;
      this.#finger = null;
      void held()?.up();
      plan.update();
    });
    window.addEventListener('pointercancel', event => { if (own(event)) this.#let_go(); });
    window.addEventListener('keydown', event => {
      if (event.key !== 'Escape' || this.#finger === null) return;
      this.#let_go();
      event.preventDefault();
      event.stopPropagation();
    }, { capture: true });
    // Before the sheet moves by the same keys.
    svg.addEventListener('keydown', event => {
      if (!this.on || event.ctrlKey || event.metaKey) return;
      if ((held() ?? this.#units).key(event)) event.preventDefault();
    }, { capture: true });
    window.addEventListener('keydown', event => {
      const { key, ctrlKey, metaKey, shiftKey } = event;
      if (!this.on || !(ctrlKey || metaKey) || is_field(event.target) && (event.target as HTMLInputElement).type !== 'radio') return;
      const letter = key.toLowerCase();
      if (letter === 'z' && !shiftKey) void this.desk.undo();
      else if (letter === 'z' || letter === 'y') void this.desk.redo();
      else return;
      event.preventDefault();
    });
  }

  /** Houses, and the height of the storey that is shown. */
  #fill() {
    const houses = this.#app.state?.plan.houses ?? [];
    this.#houses.hidden = houses.length < 2;
    const now = Number(this.#house.value || 0);
    this.#house.replaceChildren(...houses.map(({ name }, i) => h('option', { value: i, selected: i === now }, name || `${i + 1}`)));
    const height = houses[this.#at()]?.storeys[this.#storey()]?.height;
    if (height !== undefined && document.activeElement !== this.#height) this.#height.value = `${Number(height.toFixed(2))}`;
  }

  #at(): number { return Math.max(0, Number(this.#house.value || 0)); }

  /** Which of the house's storeys is shown, as strokes count them. */
  #storey(): number {
    const storeys = this.#app.state?.plan.houses[this.#at()]?.storeys ?? [];
    return storeys.findIndex(({ storey, kind }) => storey === this.#plan.storey && kind === 'storey');
  }

  async #add() {
    const house = this.#app.state?.plan.houses[this.#at()], why = this.desk.reason(house?.fixed);
    if (why) this.desk.refuse(why);
    else if (house && await this.desk.send({ do: 'add-storey', house: this.#at() })) this.#plan.want(Math.max(...house.storeys.map(s => s.storey)) + 1);
  }

  async #remove() {
    await this.desk.send({ do: 'remove-storey', house: this.#at(), storey: this.#storey() });
  }

  #set_height() {
    const height = this.#height.valueAsNumber, { min, max } = this.#height;
    if (!(height >= Number(min) && height <= Number(max))) this.desk.refuse(words.height_bounds(min, max));
    else void this.desk.send({ do: 'set-height', house: this.#at(), storey: this.#storey(), height });
  }
}
