// The pane of photographs that become a front: the photograph with its corners and mask, the wall seen straight with its lattice,
// and what is told of both. The server finds, straightens and builds; the page only handles.

import type { App } from '../app.ts';
import { buildFront, fetchPhotographs, fetchStraight, type Built, type Photographs, type Straight } from '../server/front.ts';
import { button, field, h, isField } from '../ui/dom.ts';
import { strings } from '../ui/strings.ts';
import { toggleButton } from '../ui/toolbar.ts';
import { type Draft, type Way, even, firstDraft, History, metres, withCorner, withCorners, withLine, withLines, withMask, withNewLine } from './draft.ts';
import { PhotoSheet, type Tool } from './photo-sheet.ts';
import { WallSheet } from './wall-sheet.ts';

/** The width of the brush, as a part of the longer side of the photograph: at first, least and most. */
const BRUSH = 0.04, BRUSHES = [0.004, 0.2] as const;
/** The most bays or storeys. */
const MOST = 40;

export class FrontDesk {
  readonly element: HTMLElement;
  /** Shows the model that was built. */
  showModel: () => void = () => {};
  /** Milliseconds from asking for a straight wall to having its small picture. */
  readonly times: number[] = [];
  #app: App;
  #known!: Photographs;
  #history!: History<Draft>;
  /** What is shown while something is dragged; settled by `#settle`. */
  #dragged: Draft | null = null;
  #number = 0;
  #straight: Straight | null = null;
  #asking = false;
  #stale = false;
  #finds = false;
  #building = false;
  #photo: PhotoSheet;
  #wall: WallSheet;
  #tools: Record<Tool, HTMLButtonElement>;
  #width: HTMLInputElement;
  #counts: Record<Way, HTMLInputElement>;
  #size: [HTMLInputElement, HTMLInputElement];
  #which = h('select', { 'data-do': 'which-photo', onchange: () => { this.#number = Number(this.#which.value); this.#draw(); this.#ask(false); } });
  #undo = button(strings.undo, () => this.#step('undo'), { 'data-do': 'undo-front', title: 'Ctrl+Z' });
  #redo = button(strings.redo, () => this.#step('redo'), { 'data-do': 'redo-front', title: 'Ctrl+Shift+Z' });
  #remove = button(strings.photos.removeLine, () => this.#removeHeld(), { 'data-do': 'remove-line', title: 'Delete' });
  #street = toggleButton(strings.photos.street, on => void this.#stand(on), 'in-street');
  #build = button(strings.photos.build, () => void this.build(), { 'data-do': 'build-front', class: 'build' });
  #status = h('p', { class: 'status', role: 'status' });
  #guess = h('p', { class: 'quiet', hidden: true }, strings.photos.guessed);
  #messages = h('ul', { class: 'list messages' });

  constructor(app: App) {
    this.#app = app;
    const announce = (text: string) => app.announce(text);
    this.#photo = new PhotoSheet({
      announce, widen: by => this.#widen(this.#photo.width * by),
      corner: (corner, at, done) => this.#change(withCorner(this.draft, this.#number, corner, at), done, { asks: true }),
      stroke: stroke => this.#change(withMask(this.draft, this.#number, [...this.draft.photos[this.#number]!.mask, stroke]), true, { asks: true }),
    });
    this.#wall = new WallSheet({
      announce, move: (way, line, at, done) => this.#change(withLine(this.draft, way, line, at), done),
      remove: (way, line) => this.#removeLine(way, line), add: (way, at) => this.#addLine(way, at),
    });
    const tool = (name: Tool) => toggleButton(strings.photos.tools[name], () => this.#choose(name), `front-${name}`);
    this.#tools = { corners: tool('corners'), brush: tool('brush'), eraser: tool('eraser') };
    this.#width = h('input', { type: 'range', min: BRUSHES[0], max: BRUSHES[1], step: 0.002, 'data-do': 'brush-width', oninput: () => this.#widen(Number(this.#width.value) * this.#longest) });
    const count = (way: Way) => h('input', { type: 'number', min: 1, max: MOST, step: 1, 'data-do': `front-${way}`, onchange: () => this.#divide(way) });
    this.#counts = { columns: count('columns'), rows: count('rows') };
    const length = (name: string) => h('input', { type: 'number', min: 0.01, max: 1000, step: 'any', 'data-do': name, onchange: () => this.#resize() });
    this.#size = [length('front-width'), length('front-height')];
    this.element = this.#layOut();
    this.element.addEventListener('keydown', event => this.#key(event));
  }

  #layOut(): HTMLElement {
    const group = (label: string, ...children: Node[]) => h('div', { class: 'group', role: 'group', 'aria-label': label }, ...children);
    const { photos } = strings, add = (way: Way, label: string) => button(label, () => this.#addLine(way), { 'data-do': `add-${way}` });
    const [width, height] = this.#size;
    return h('section', { class: 'pane front-desk', 'aria-label': photos.pane },
      h('div', { class: 'bar' }, field(photos.photo, this.#which),
        group(photos.tool, ...Object.values(this.#tools)), field(photos.brushWidth, this.#width),
        button(photos.findCorners, () => this.#findCorners(), { 'data-do': 'find-corners' }), group(photos.back, this.#undo, this.#redo)),
      h('div', { class: 'bar' }, field(photos.bays, this.#counts.columns), field(photos.storeys, this.#counts.rows),
        button(photos.findLattice, () => this.#findLattice(), { 'data-do': 'find-lattice' }),
        add('columns', photos.addColumn), add('rows', photos.addRow), this.#remove,
        field(photos.width, width), field(photos.height, height), this.#build, this.#street),
      h('div', { class: 'sheets' }, this.#photo.element, this.#wall.element),
      h('div', { class: 'told', role: 'group', tabindex: 0, 'aria-label': photos.report }, this.#status, this.#guess, this.#messages, h('p', { class: 'quiet' }, photos.help)));
  }

  /** What is told now. */
  get draft(): Draft { return this.#dragged ?? this.#history.now; }
  get #longest() { return Math.max(...this.#known.photos[this.#number]!.size); }
  /** The width of the brush, pixels of the photograph. */
  get brush() { return this.#photo.width; }
  /** The wall as it was seen last. */
  get straight(): Straight | null { return this.#straight; }

  /** Begins with the photographs of the server, and with the model if they were built before. */
  async start() {
    this.#known = await fetchPhotographs();
    this.#history = new History(firstDraft(this.#known));
    const { photos, told, writes } = this.#known;
    this.#which.replaceChildren(...photos.map(({ name }, i) => h('option', { value: i }, name)));
    this.#which.closest<HTMLElement>('.field')!.hidden = photos.length < 2;
    this.#build.disabled = !writes;
    this.#street.disabled = !told;
    this.#choose('corners');
    this.#widen(BRUSH * this.#longest);
    const lost = photos.find(photo => photo.lost !== null);
    this.#report(lost ? strings.photos.lost(lost.name, lost.lost!) : told ? strings.photos.asLeft : strings.photos.found, lost !== undefined);
    this.#draw();
    this.#ask(!told);
    if (told) await this.#show();
  }

  /** Writes the front and shows its model. */
  async build() {
    if (this.#building || !this.#known.writes) return;
    this.#building = this.#build.disabled = true;
    this.#report(strings.photos.building);
    this.#messages.replaceChildren();
    try {
      const { byHand: _, ...told } = this.#history.now, built = await buildFront(told);
      if ('refused' in built) this.#report(built.refused, true); else await this.#built(built);
    } catch (error) {
      this.#report(strings.failed + (error as Error).message, true);
    }
    this.#building = this.#build.disabled = false;
  }

  async #built({ said, messages }: Built) {
    this.#messages.replaceChildren(...messages.map(({ severity, code, message, help }) => h('li', { class: `message ${severity}` },
      h('span', { class: 'severity' }, strings[severity]), ' ', h('span', { class: 'code' }, code), h('span', { class: 'text' }, message), help && h('span', { class: 'help' }, help))));
    this.#report(said ?? strings.photos.notBuilt, said === null);
    if (said === null) return;
    this.#street.disabled = false;
    await this.#show();
  }

  /** Shows the model of what was built last: the front alone or in its street. */
  async #show() {
    const { front, street } = this.#known.files, file = this.#street.getAttribute('aria-pressed') === 'true' ? street : front;
    this.showModel();
    if (this.#app.file === file) await this.#app.reload(); else await this.#app.openFile(file);
  }

  /** Puts the front into its street, or takes it out. */
  async #stand(on: boolean) {
    this.#street.setAttribute('aria-pressed', `${on}`);
    await this.#show();
  }

  /** Goes on to another draft; null where it makes no sense. */
  #change(next: Draft | null, done: boolean, { asks = false, finds = false } = {}) {
    const before = this.#history.now;
    if (next) this.#dragged = next;
    if (done && this.#dragged) {
      const settled = this.#dragged;
      this.#dragged = null;
      if (JSON.stringify(settled) !== JSON.stringify(before)) this.#history.push(settled, before);
    }
    this.#draw();
    if (asks) this.#ask(done && (finds || !this.draft.byHand && this.#number === 0));
  }

  /** Asks for the wall seen straight: one question at a time, the newest of those that wait. */
  #ask(finds: boolean) {
    this.#stale = true;
    this.#finds ||= finds;
    if (!this.#asking) void this.#answer();
  }

  async #answer() {
    this.#asking = true;
    while (this.#stale) {
      this.#stale = false;
      try {
        // A small picture comes at once; the whole one, and the lattice, when nothing moves any more.
        await this.#see(true, false);
        if (this.#stale || this.#dragged) continue;
        const finds = this.#finds;
        this.#finds = false;
        await this.#see(false, finds);
      } catch (error) {
        this.#report(strings.failed + (error as Error).message, true);
      }
    }
    this.#asking = false;
  }

  async #see(quick: boolean, finds: boolean) {
    const [draft, photo] = [this.draft, this.#number], begun = performance.now();
    const straight = await fetchStraight({ photo, marked: draft.photos[photo]!, size: draft.size, finds, quick });
    if ('refused' in straight) return this.#report(straight.refused, true);
    if (quick) this.times.push(performance.now() - begun);
    if (photo !== this.#number || this.#stale && !quick) return;
    this.#straight = straight;
    this.#wall.show(straight);
    // The lattice belongs to the corners that were moved: no step of its own.
    if (straight.lattice && !this.#dragged && !this.draft.byHand) this.#history.now = { ...this.draft, ...straight.lattice };
    this.#draw();
  }

  /** True while a question is under way. */
  get busy() { return this.#asking || this.#building; }

  #draw() {
    const { draft } = this, photo = this.#known.photos[this.#number]!;
    this.#photo.show(this.#number, photo, draft.photos[this.#number]!);
    const size = metres(draft, this.#straight?.aspect ?? 1, this.#known.storey);
    this.#wall.set({ columns: draft.columns, rows: draft.rows, metres: size });
    for (const way of ['columns', 'rows'] as const) if (document.activeElement !== this.#counts[way]) this.#counts[way].value = `${draft[way].length + 1}`;
    this.#size.forEach((input, i) => {
      if (document.activeElement !== input) input.value = draft.size ? `${draft.size[i]}` : '';
      input.placeholder = size[i]!.toFixed(2);
    });
    [this.#undo.disabled, this.#redo.disabled] = [!this.#history.canUndo, !this.#history.canRedo];
    this.#guess.hidden = !this.#straight?.guessed || draft.size !== null;
    this.#remove.disabled = !draft.columns.length && !draft.rows.length;
  }

  #report(text: string, refused = false) {
    this.#status.textContent = text;
    this.#status.classList.toggle('refused', refused);
  }

  #choose(tool: Tool) {
    for (const [name, own] of Object.entries(this.#tools)) own.setAttribute('aria-pressed', `${name === tool}`);
    this.#photo.choose(tool);
    this.#width.disabled = tool === 'corners';
    this.#app.announce(strings.photos.toolHelp[tool]);
  }

  #widen(width: number) {
    const [least, most] = BRUSHES, part = Math.min(Math.max(width / this.#longest, least), most);
    this.#photo.width = Math.round(part * this.#longest * 10) / 10;
    this.#width.value = `${part}`;
    if (this.#history) this.#draw();
  }

  #findCorners() {
    this.#change(withCorners(this.draft, this.#number, this.#known.photos[this.#number]!.corners), true, { asks: true });
  }

  #findLattice() {
    if (this.#number !== 0) [this.#number, this.#which.value] = [0, '0'];
    this.#change({ ...this.draft, byHand: false }, true, { asks: true, finds: true });
  }

  #divide(way: Way) {
    const pieces = Number(this.#counts[way].value);
    if (Number.isInteger(pieces) && pieces >= 1 && pieces <= MOST) this.#change(withLines(this.draft, way, even(pieces)), true);
    else this.#report(strings.photos.pieces(MOST), true);
  }

  #resize() {
    const [width, height] = this.#size.map(input => Number(input.value)) as [number, number], none = this.#size.every(input => input.value === '');
    if (none || width > 0 && height > 0) this.#change({ ...this.draft, size: none ? null : [width, height] }, true, { asks: true });
  }

  #addLine(way: Way, at?: number) {
    const added = withNewLine(this.draft, way, at);
    if (!added) return this.#report(strings.photos.noRoom, true);
    this.#change(added.draft, true);
    this.#wall.focus(way, added.line);
  }

  #removeLine(way: Way, line: number) {
    this.#change(withLines(this.draft, way, this.draft[way].filter((_, i) => i !== line)), true);
    this.#app.announce(strings.photos.removed);
    const { length } = this.draft[way], next = Math.min(line, length - 1);
    // The next line may have the focus already.
    this.#wall.held = length ? { way, line: next } : null;
    if (length) this.#wall.focus(way, next); else this.element.querySelector<HTMLElement>(`[data-do=add-${way}]`)!.focus();
  }

  #removeHeld() {
    const { held } = this.#wall;
    if (held && held.line < this.draft[held.way].length) this.#removeLine(held.way, held.line);
    else this.#report(strings.photos.chooseLine, true);
  }

  #step(way: 'undo' | 'redo') {
    this.#dragged = null;
    this.#history[way]();
    this.#draw();
    this.#ask(false);
    this.#app.announce(way === 'undo' ? strings.undone : strings.redone);
  }

  #key(event: KeyboardEvent) {
    const { key, ctrlKey, metaKey, shiftKey, altKey, target } = event, letter = key.toLowerCase();
    if (!(ctrlKey || metaKey) || altKey || isField(target) || letter !== 'z' && letter !== 'y') return;
    event.preventDefault();
    event.stopPropagation();
    const way = letter === 'y' || shiftKey ? 'redo' : 'undo';
    if (way === 'undo' ? this.#history.canUndo : this.#history.canRedo) this.#step(way);
  }
}
