// The text beside the house: numbered lines, what the compiler says underlined, the code of the selected part and that
// under the editor's cursor lit up. It is read here and written in the author's editor.

import type { App, Spot } from './app.ts';
import { field, h } from './dom.ts';
import { type Bytes, called, source_of } from './server.ts';
import { words } from './words.ts';

/** A stretch of the text, in characters, that looks different. */
interface Mark {
  start: number;
  end: number;
  name: string;
}

export class TextPane {
  readonly element: HTMLElement;
  #app: App;
  #id = 0;
  #lines = h('div', { class: 'lines', tabindex: 0, role: 'region', 'aria-label': words.source_text });
  #chooser = h('select', { onchange: () => { this.#id = Number(this.#chooser.value); this.#fill(); } });
  /** How each line looks that is shown. */
  #looks: string[] = [];
  #codes: { start: number; end: number; span: Bytes }[] = [];
  #spot: Spot | null = null;

  constructor(app: App) {
    this.#app = app;
    this.element = h('section', { class: 'pane text', 'aria-label': words.text, hidden: true },
      h('div', { class: 'bar' }, field(words.source, this.#chooser)), this.#lines);
    this.#lines.addEventListener('click', event => {
      const piece = (event.target as Element).closest<HTMLElement>('[data-start]');
      const line = piece?.closest<HTMLElement>('[data-line]');
      const from = this.#app.places.get(this.#id)?.lines[Number(line?.dataset.line) - 1];
      if (from !== undefined) this.#choose(from + Number(piece!.dataset.start));
    });
    this.#lines.addEventListener('keydown', event => this.#key(event));
    app.on('state', () => { this.#spot = null; this.#choosers(); this.update(); });
    app.on('model', () => this.update());
    app.on('select', () => { this.#spot = null; this.update(); this.#reveal(app.selection === null ? null : app.spot_of(app.selection)); });
    app.on('cursor', () => { this.update(); this.#reveal(app.cursor); });
  }

  /** Shows a place, and marks it. */
  show(spot: Spot) {
    this.#id = spot.id;
    this.#spot = spot;
    this.#choosers();
    this.update();
    this.#reveal(spot);
  }

  #choosers() {
    const { sources } = this.#app.state!;
    if (!sources.some(source => source.id === this.#id)) this.#id = sources[0]?.id ?? 0;
    this.#chooser.replaceChildren(...sources.map(source => h('option', { value: source.id, selected: source.id === this.#id }, called(source))));
  }

  /** Draws the text anew if anything in it has changed and it is shown. */
  update() {
    if (this.element.hidden || !this.#app.state) return;
    this.#fill();
  }

  #fill() {
    const { state, model, selection, pointed, places } = this.#app, here = places.get(this.#id);
    if (!here || !state) { this.#draw([]); return; }
    const marks: Mark[] = [];
    const mark = (span: Bytes, name: string) => {
      const [start, end] = here.range(span);
      marks.push({ start, end: Math.max(end, start + 1), name });
    };
    for (const message of state.diagnostics) {
      if (source_of(message, state.sources)?.id === this.#id) mark([message.span.start, message.span.end], message.severity);
    }
    const seen = new Set<string>();
    this.#codes = [];
    for (const { kind, span, file } of model?.parts ?? []) {
      if (kind !== 'part' || file !== this.#id || !span || seen.has(`${span}`)) continue;
      seen.add(`${span}`);
      const [start, end] = here.range(span);
      this.#codes.push({ start, end, span });
      marks.push({ start, end, name: 'code' });
    }
    this.#codes.sort((a, b) => a.start - b.start);
    const lit = (parts: number[], name: string) => {
      for (const span of new Set(parts.map(part => this.#app.spot_of(part)).filter(s => s?.id === this.#id).map(s => `${s!.span}`))) {
        mark(span.split(',').map(Number) as Bytes, name);
      }
    };
    lit(selection === null ? [] : [selection], 'selected');
    lit(pointed.parts, 'pointed');
    if (this.#spot?.id === this.#id) mark(this.#spot.span, 'spot');
    this.#draw(pieces_of(here.text, here.lines, marks));
  }

  /** Draws the lines that look different from what is shown; those before and behind them stay. */
  #draw(lines: Piece[][]) {
    const old = this.#looks, looks = lines.map(look_of), root = this.#lines, { scrollTop } = root;
    const both = Math.min(old.length, looks.length);
    let same = 0, behind = 0;
    while (same < both && old[same] === looks[same]) same++;
    while (behind < both - same && old[old.length - 1 - behind] === looks[looks.length - 1 - behind]) behind++;
    if (same === looks.length && same === old.length) return;
    if (old.length === looks.length) {
      // Marks of places far from one another come and go together.
      for (let i = same; i < looks.length - behind; i++) {
        if (old[i] !== looks[i]) root.children[i]!.replaceChildren(...line_of(lines[i]!).childNodes);
      }
    } else {
      const gone = [...root.children].slice(same, old.length - behind), next = root.children[old.length - behind] ?? null;
      for (const line of gone) line.remove();
      const fresh = document.createDocumentFragment();
      fresh.append(...lines.slice(same, looks.length - behind).map(line_of));
      root.insertBefore(fresh, next);
      for (let i = same; i < looks.length; i++) (root.children[i] as HTMLElement).dataset.line = `${i + 1}`;
    }
    this.#looks = looks;
    root.scrollTop = scrollTop;
  }

  /** Scrolls to a place. */
  #reveal(spot: Spot | null) {
    const here = this.#app.places.get(this.#id);
    if (this.element.hidden || !spot || spot.id !== this.#id || !here) return;
    const line = this.#lines.children[here.line(here.unit(spot.span[0]))] as HTMLElement | undefined;
    if (!line) return;
    const { offsetTop } = line, { scrollTop, clientHeight } = this.#lines;
    const top = offsetTop - this.#lines.offsetTop;
    if (top < scrollTop || top > scrollTop + clientHeight - 40) this.#lines.scrollTop = top - clientHeight / 3;
  }

  #choose(char: number) {
    const code = this.#codes.find(({ start, end }) => start <= char && char < end);
    if (code) this.#app.select_at({ id: this.#id, span: code.span });
  }

  /** From part to part without a mouse. */
  #key(event: KeyboardEvent) {
    const { selection } = this.#app, step = event.key === 'ArrowRight' ? 1 : event.key === 'ArrowLeft' ? -1 : 0;
    const spot = selection === null ? null : this.#app.spot_of(selection);
    if (event.key === 'Enter' && spot) void this.#app.open(spot);
    else if (step && this.#codes.length) {
      const at = this.#codes.findIndex(({ span }) => spot?.id === this.#id && `${span}` === `${spot.span}`);
      const next = this.#codes[at < 0 ? (step > 0 ? 0 : this.#codes.length - 1) : at + step];
      if (next) this.#app.select_at({ id: this.#id, span: next.span });
    } else return;
    event.preventDefault();
  }
}

/** A stretch of a line that looks the same from end to end. */
interface Piece {
  /** From the beginning of the line, characters. */
  start: number;
  text: string;
  names: string;
}

/** The pieces of each line. */
function pieces_of(text: string, starts: number[], marks: Mark[]): Piece[][] {
  const sorted = [...marks].sort((a, b) => a.start - b.start);
  let first = 0;
  return starts.map((from, i) => {
    const to = (starts[i + 1] ?? text.length + 1) - 1;
    while (first < sorted.length && sorted[first]!.end <= from && sorted[first]!.start < from) first++;
    const here: Mark[] = [];
    for (let k = first; k < sorted.length && sorted[k]!.start <= to; k++) if (sorted[k]!.end > from) here.push(sorted[k]!);
    const edges = [...new Set([from, to, ...here.flatMap(m => [m.start, m.end])])].filter(c => c >= from && c <= to).sort((a, b) => a - b);
    const names = (of: Mark[]) => [...new Set(of.map(m => m.name))].join(' ');
    const pieces = edges.slice(1).map((end, k) => {
      const start = edges[k]!;
      return { start: start - from, text: text.slice(start, end), names: names(here.filter(m => m.start <= start && m.end >= end)) };
    });
    // A message about the end of a line still has to be seen.
    const behind = here.filter(m => m.start >= to && m.name !== 'code');
    if (behind.length) pieces.push({ start: to - from, text: ' ', names: names(behind) });
    return pieces;
  });
}

const line_of = (pieces: Piece[]) => h('div', { class: 'source-line' },
  ...pieces.map(({ start, text, names }) => names ? h('span', { class: names, 'data-start': start }, text) : text));

/** What two lines that look the same have in common. */
const look_of = (pieces: Piece[]) => pieces.map(({ text, names }) => `${names}\t${text}`).join('\n');
