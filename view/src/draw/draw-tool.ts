// Drawing mode: tools over the plan, each of which edits the source file. The page always shows what was read back from the
// file.

import type { App } from '../app.ts';
import { button, field, h, isField, newId, checkbox } from '../ui/dom.ts';
import type { PlanView } from '../plan/plan-view.ts';
import { toggleButton } from '../ui/toolbar.ts';
import { strings } from '../ui/strings.ts';
import { FixtureTool } from './fixture-tool.ts';
import { EditSession } from './session.ts';
import { InnerTool } from './inner-tool.ts';
import { OutlineTool } from './outline-tool.ts';
import { partName, Palette } from './palette.ts';
import { PartTool } from './part-tool.ts';
import { PlaceTool } from './place-tool.ts';
import { RoomTool } from './room-tool.ts';
import { SurveyTool } from './survey-tool.ts';
import { WallTool } from './wall-tool.ts';

const TOOLS = ['part', 'wall', 'break', 'inner', 'room', 'fixture', 'outline', 'survey', 'place', 'turn'] as const;
type Tool = (typeof TOOLS)[number];

/** Tools that draw anywhere, so that a drag does not move the sheet. */
const FREE = new Set<Tool>(['outline', 'survey', 'inner', 'room', 'fixture']);

/** How far the sheet moves at once while a drag points out of it, CSS pixels. */
const FOLLOWED = 10;

export class DrawTool {
  on = false;
  tool: Tool = 'part';
  readonly session: EditSession;
  readonly #app: App;
  readonly #plan: PlanView;
  #switch = toggleButton(strings.drawOn, on => this.set(on), 'draw');
  #palette: Palette;
  #walls: WallTool;
  #outline: OutlineTool;
  #parts: PartTool;
  #places: PlaceTool;
  #survey: SurveyTool;
  #inner: InnerTool;
  #rooms: RoomTool;
  #fixtures: FixtureTool;
  #help = h('p', { class: 'quiet' });
  #house = h('select', { onchange: () => this.#fill() });
  #houses = field(strings.planHouse, this.#house);
  #height = h('input', { type: 'number', min: 1, max: 100, step: 0.1, onkeydown: (event: KeyboardEvent) => { if (event.key === 'Enter') this.#setHeight(); } });
  #allStoreys = checkbox(strings.allStoreys, false, on => { this.#walls.all = on; });
  #wholeGroup = checkbox(strings.wholeGroup, false, on => { this.#places.groups = on; });
  /** Id of the pointer that is drawing. */
  #pointerId: number | null = null;
  /** True if the pointer has moved since it was pressed. */
  #dragged = false;
  #bar: HTMLElement;

  constructor(app: App, plan: PlanView) {
    this.#app = app;
    this.#plan = plan;
    this.session = new EditSession(app, plan);
    this.#palette = new Palette(app);
    this.#walls = new WallTool(app, plan, this.session);
    this.#outline = new OutlineTool(app, plan, this.session);
    this.#parts = new PartTool(plan, this.session, () => this.#palette.chosen?.code ?? null);
    this.#places = new PlaceTool(plan, this.session);
    this.#survey = new SurveyTool(plan, this.session);
    this.#inner = new InnerTool(plan, this.session, () => this.#palette.chosen?.code ?? null);
    this.#rooms = new RoomTool(plan, this.session);
    this.#fixtures = new FixtureTool(plan, this.session);
    this.#palette.changed = () => this.session.report(strings.partChosen(partName(this.#palette.chosen!)));
    const name = newId();
    this.#bar = h('div', { class: 'draw', hidden: true },
      h('fieldset', { class: 'tools' }, h('legend', { class: 'hidden' }, strings.tool), ...TOOLS.map(tool => h('label', { class: 'tick' },
        h('input', { type: 'radio', name, value: tool, checked: tool === this.tool, onchange: () => this.choose(tool) }), strings.toolName[tool]))),
      h('div', { class: 'buttons' },
        button(strings.undo, () => void this.session.undo(), { 'data-do': 'undo', title: 'Ctrl+Z' }),
        button(strings.redo, () => void this.session.redo(), { 'data-do': 'redo', title: 'Ctrl+Shift+Z' })),
      this.#allStoreys, this.#wholeGroup, this.#help, this.#rooms.element, this.#fixtures.element, this.#inner.remove, this.#palette.element, this.#houses,
      h('div', { class: 'buttons' },
        button(strings.addStorey, () => void this.#addStorey(), { 'data-do': 'add-storey' }),
        button(strings.removeStorey, () => void this.#removeStorey(), { 'data-do': 'remove-storey' }),
        button(strings.removeHouse, () => void this.session.send({ do: 'remove-house', house: this.#houseIndex() }), { 'data-do': 'remove-house' }),
        field(strings.height, this.#height, button(strings.setHeight, () => this.#setHeight(), { 'data-do': 'set-height' }))),
      this.session.status);
    plan.element.querySelector('.bar')!.append(this.#switch);
    plan.tools.append(this.#bar);
    // A click at the end of a drag is ignored.
    plan.onUnitClick = shape => this.#dragged || this.on && this.tool === 'part' && this.#parts.choose(shape);
    plan.onRedraw = () => {
      this.session.clear(); // The preview of an edit belongs to the previous drawing.
      this.#fill();
      this.#enable();
    };
    plan.onScale = () => this.#survey.scale();
    plan.isDragging = () => this.#pointerId !== null;
    plan.sheet.moves = target => !this.on || this.tool === 'part' || !FREE.has(this.tool) && !target.closest('.run');
    app.on('files', () => {
      this.#switch.disabled = !app.serverInfo.writes;
      this.#switch.title = app.serverInfo.writes ? '' : strings.drawOffWhy;
      if (!app.serverInfo.writes) this.set(false);
      if (app.file !== this.#file) this.#forget();
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
    this.session.clear();
    if (on) void this.#palette.fill();
    this.#fill();
    this.#enable();
  }

  choose(tool: Tool) {
    this.tool = tool;
    this.#walls.breaks = tool === 'break';
    this.#palette.element.hidden = tool !== 'part' && tool !== 'inner';
    this.#rooms.element.hidden = tool !== 'room';
    this.#fixtures.element.hidden = tool !== 'fixture';
    this.#inner.remove.hidden = tool !== 'inner';
    this.#allStoreys.hidden = tool !== 'wall';
    this.#wholeGroup.hidden = tool !== 'place' && tool !== 'turn';
    this.#places.turns = tool === 'turn';
    this.#help.textContent = strings.toolHelp[tool];
    this.#plan.element.dataset.tool = tool;
    this.#release();
    this.#enable();
  }

  /** The open file. */
  #file: string | null = null;

  /** Another file is open: what was said and begun belongs to the one before. */
  #forget() {
    this.#file = this.#app.file;
    this.#cancelDrag();
  }

  /** Moves the sheet along while a drag points out of it. */
  #follow(event: PointerEvent) {
    clearTimeout(this.#following);
    const { sheet } = this.#plan, [x, y] = sheet.outOf(event);
    if (!x && !y || this.#pointerId !== event.pointerId) return;
    sheet.pan(x * sheet.pixel * FOLLOWED, y * sheet.pixel * FOLLOWED);
    this.#activeTool()?.move(event);
    this.#following = window.setTimeout(() => this.#follow(event), 40);
  }

  #following = 0;

  #activeTool() {
    switch (this.tool) {
      case 'part': return null;
      case 'outline': return this.#outline;
      case 'survey': return this.#survey;
      case 'inner': return this.#inner;
      case 'room': return this.#rooms;
      case 'fixture': return this.#fixtures;
      case 'place': case 'turn': return this.#places;
      default: return this.#walls;
    }
  }

  #release() {
    for (const tool of [this.#walls, this.#outline, this.#survey, this.#places, this.#inner, this.#rooms, this.#fixtures]) tool.release();
  }

  /** Cancels a drag. */
  #cancelDrag() {
    this.#pointerId = null;
    this.#release();
    this.session.report('');
    this.#plan.update();
  }

  #enable() {
    const tools = [[this.#walls, ['wall', 'break']], [this.#places, ['place', 'turn']], [this.#parts, ['part']], [this.#survey, ['survey']], [this.#inner, ['inner']], [this.#rooms, ['room']], [this.#fixtures, ['fixture']]] as const;
    // What another tool has made focusable is taken back first.
    for (const [tool] of tools) tool.enable(false);
    for (const [tool, names] of tools) if (this.on && (names as readonly Tool[]).includes(this.tool)) tool.enable(true);
  }

  #attend() {
    const plan = this.#plan, { svg } = plan.sheet;
    svg.addEventListener('pointerdown', event => {
      this.#dragged = false;
      if (!this.on || event.button !== 0) return;
      // A second finger pinches to zoom.
      if (this.#pointerId !== null) { this.#cancelDrag(); return; }
      if (!this.#activeTool()?.down(event)) return;
      this.#pointerId = event.pointerId;
      event.preventDefault();
    });
    // The next corner follows the pointer between presses.
    svg.addEventListener('pointermove', event => { if (this.on && this.tool === 'survey' && this.#pointerId === null) this.#survey.move(event); });
    const isActive = ({ pointerId }: PointerEvent) => this.on && pointerId === this.#pointerId;
    window.addEventListener('pointermove', event => {
      if (!isActive(event)) return;
      this.#dragged = true;
      this.#activeTool()?.move(event);
      this.#follow(event);
    });
    window.addEventListener('pointerup', event => {
      if (!isActive(event)) return;
      this.#pointerId = null;
      void this.#activeTool()?.up();
      plan.update();
    });
    window.addEventListener('pointercancel', event => { if (isActive(event)) this.#cancelDrag(); });
    window.addEventListener('keydown', event => {
      if (event.key !== 'Escape' || this.#pointerId === null) return;
      this.#cancelDrag();
      event.preventDefault();
      event.stopPropagation();
    }, { capture: true });
    // Captured before the sheet uses the same keys for panning.
    svg.addEventListener('keydown', event => {
      if (!this.on || event.ctrlKey || event.metaKey) return;
      if ((this.#activeTool() ?? this.#parts).key(event)) event.preventDefault();
    }, { capture: true });
    window.addEventListener('keydown', event => {
      const { key, ctrlKey, metaKey, shiftKey } = event;
      if (!this.on || !(ctrlKey || metaKey) || isField(event.target) && (event.target as HTMLInputElement).type !== 'radio') return;
      const letter = key.toLowerCase();
      if (letter === 'z' && !shiftKey) void this.session.undo();
      else if (letter === 'z' || letter === 'y') void this.session.redo();
      else return;
      event.preventDefault();
    });
  }

  /** Lists the houses and shows the height of the current storey. */
  #fill() {
    const houses = this.#app.state?.plan.houses ?? [];
    this.#houses.hidden = houses.length < 2;
    const now = Number(this.#house.value || 0);
    this.#house.replaceChildren(...houses.map(({ name }, i) => h('option', { value: i, selected: i === now }, name || `${i + 1}`)));
    const height = houses[this.#houseIndex()]?.storeys[this.#storeyIndex()]?.height;
    if (height !== undefined && document.activeElement !== this.#height) this.#height.value = `${Number(height.toFixed(2))}`;
  }

  #houseIndex(): number { return Math.max(0, Number(this.#house.value || 0)); }

  /** Index of the shown storey in the house, as edits count them. */
  #storeyIndex(): number {
    const storeys = this.#app.state?.plan.houses[this.#houseIndex()]?.storeys ?? [];
    return storeys.findIndex(({ storey, kind }) => storey === this.#plan.storey && kind === 'storey');
  }

  async #addStorey() {
    const house = this.#app.state?.plan.houses[this.#houseIndex()], why = this.session.reason(house?.fixed);
    if (why) this.session.refuse(why);
    else if (house && await this.session.send({ do: 'add-storey', house: this.#houseIndex() })) this.#plan.showWhenReady(Math.max(...house.storeys.map(s => s.storey)) + 1);
  }

  async #removeStorey() {
    await this.session.send({ do: 'remove-storey', house: this.#houseIndex(), storey: this.#storeyIndex() });
  }

  #setHeight() {
    const height = this.#height.valueAsNumber, { min, max } = this.#height;
    if (!(height >= Number(min) && height <= Number(max))) this.session.refuse(strings.heightBounds(min, max));
    else void this.session.send({ do: 'set-height', house: this.#houseIndex(), storey: this.#storeyIndex(), height });
  }
}
