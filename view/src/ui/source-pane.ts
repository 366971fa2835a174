// The source pane: numbered lines with diagnostics underlined, and the selected part and the part at the editor's cursor
// highlighted. Read-only; the text is edited in the user's editor.

import type { App } from '../app.ts';
import { field, h } from './dom.ts';
import { type ByteRange, displayName, sourceOf } from '../server/api.ts';
import type { SourceLocation } from '../state.ts';
import { strings } from './strings.ts';

/** A highlighted range, in characters. */
interface Mark {
  start: number;
  end: number;
  name: string;
}

export class SourcePane {
  readonly element: HTMLElement;
  #app: App;
  #id = 0;
  #lines = h('div', { class: 'lines', tabindex: 0, role: 'region', 'aria-label': strings.sourceText });
  #chooser = h('select', { onchange: () => { this.#id = Number(this.#chooser.value); this.#render(); } });
  /** Appearance of each shown line. */
  #keys: string[] = [];
  #codes: { start: number; end: number; span: ByteRange }[] = [];
  #location: SourceLocation | null = null;

  constructor(app: App) {
    this.#app = app;
    this.element = h('section', { class: 'pane text', 'aria-label': strings.text, hidden: true },
      h('div', { class: 'bar' }, field(strings.source, this.#chooser)), this.#lines);
    this.#lines.addEventListener('click', event => {
      const run = (event.target as Element).closest<HTMLElement>('[data-start]');
      const line = run?.closest<HTMLElement>('[data-line]');
      const from = this.#app.offsets.get(this.#id)?.lines[Number(line?.dataset.line) - 1];
      if (from !== undefined) this.#selectAt(from + Number(run!.dataset.start));
    });
    this.#lines.addEventListener('keydown', event => this.#key(event));
    app.on('state', () => { this.#location = null; this.#updateChooser(); this.update(); });
    app.on('model', () => this.update());
    app.on('select', () => { this.#location = null; this.update(); this.#reveal(app.selection === null ? null : app.locationOf(app.selection)); });
    app.on('cursor', () => { this.update(); this.#reveal(app.cursor); });
  }

  /** Shows and marks a location. */
  show(location: SourceLocation) {
    this.#id = location.id;
    this.#location = location;
    this.#updateChooser();
    this.update();
    this.#reveal(location);
  }

  #updateChooser() {
    const { sources } = this.#app.state!;
    if (!sources.some(source => source.id === this.#id)) this.#id = sources[0]?.id ?? 0;
    this.#chooser.replaceChildren(...sources.map(source => h('option', { value: source.id, selected: source.id === this.#id }, displayName(source))));
  }

  /** Redraws the text if the pane is visible. */
  update() {
    if (this.element.hidden || !this.#app.state) return;
    this.#render();
  }

  #render() {
    const { state, model, selection, offsets, renderer: { pointed } } = this.#app, here = offsets.get(this.#id);
    if (!here || !state) { this.#show([]); return; }
    const marks: Mark[] = [];
    const mark = (span: ByteRange, name: string) => {
      const [start, end] = here.range(span);
      marks.push({ start, end: Math.max(end, start + 1), name });
    };
    for (const message of state.diagnostics) {
      if (sourceOf(message, state.sources)?.id === this.#id) mark([message.span.start, message.span.end], message.severity);
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
      for (const span of new Set(parts.map(part => this.#app.locationOf(part)).filter(s => s?.id === this.#id).map(s => `${s!.span}`))) {
        mark(span.split(',').map(Number) as ByteRange, name);
      }
    };
    lit(selection === null ? [] : [selection], 'selected');
    lit(pointed.parts, 'pointed');
    if (this.#location?.id === this.#id) mark(this.#location.span, 'spot');
    this.#show(runsOf(here.text, here.lines, marks));
  }

  /** Replaces the lines whose appearance has changed. */
  #show(lines: Run[][]) {
    const old = this.#keys, keys = lines.map(lineKey), root = this.#lines, { scrollTop } = root;
    const both = Math.min(old.length, keys.length);
    let same = 0, behind = 0;
    while (same < both && old[same] === keys[same]) same++;
    while (behind < both - same && old[old.length - 1 - behind] === keys[keys.length - 1 - behind]) behind++;
    if (same === keys.length && same === old.length) return;
    if (old.length === keys.length) {
      // The number of lines is unchanged: highlights may change in distant places at once.
      for (let i = same; i < keys.length - behind; i++) {
        if (old[i] !== keys[i]) root.children[i]!.replaceChildren(...lineElement(lines[i]!).childNodes);
      }
    } else {
      const gone = [...root.children].slice(same, old.length - behind), next = root.children[old.length - behind] ?? null;
      for (const line of gone) line.remove();
      const fresh = document.createDocumentFragment();
      fresh.append(...lines.slice(same, keys.length - behind).map(lineElement));
      root.insertBefore(fresh, next);
      for (let i = same; i < keys.length; i++) (root.children[i] as HTMLElement).dataset.line = `${i + 1}`;
    }
    this.#keys = keys;
    root.scrollTop = scrollTop;
  }

  /** Scrolls to a location. */
  #reveal(location: SourceLocation | null) {
    const here = this.#app.offsets.get(this.#id);
    if (this.element.hidden || !location || location.id !== this.#id || !here) return;
    const line = this.#lines.children[here.line(here.unit(location.span[0]))] as HTMLElement | undefined;
    if (!line) return;
    const { offsetTop } = line, { scrollTop, clientHeight } = this.#lines;
    const top = offsetTop - this.#lines.offsetTop;
    if (top < scrollTop || top > scrollTop + clientHeight - 40) this.#lines.scrollTop = top - clientHeight / 3;
  }

  #selectAt(char: number) {
    const code = this.#codes.find(({ start, end }) => start <= char && char < end);
    if (code) this.#app.selectAt({ id: this.#id, span: code.span });
  }

  /** Arrow keys move from part to part. */
  #key(event: KeyboardEvent) {
    const { selection } = this.#app, step = event.key === 'ArrowRight' ? 1 : event.key === 'ArrowLeft' ? -1 : 0;
    const location = selection === null ? null : this.#app.locationOf(selection);
    if (event.key === 'Enter' && location) void this.#app.open(location);
    else if (step && this.#codes.length) {
      const at = this.#codes.findIndex(({ span }) => location?.id === this.#id && `${span}` === `${location.span}`);
      const next = this.#codes[at < 0 ? (step > 0 ? 0 : this.#codes.length - 1) : at + step];
      if (next) this.#app.selectAt({ id: this.#id, span: next.span });
    } else return;
    event.preventDefault();
  }
}

/** A run of a line with uniform appearance. */
interface Run {
  /** Offset in the line, characters. */
  start: number;
  text: string;
  names: string;
}

/** Splits each line into runs. */
function runsOf(text: string, starts: number[], marks: Mark[]): Run[][] {
  const sorted = [...marks].sort((a, b) => a.start - b.start);
  let first = 0;
  return starts.map((from, i) => {
    const to = (starts[i + 1] ?? text.length + 1) - 1;
    while (first < sorted.length && sorted[first]!.end <= from && sorted[first]!.start < from) first++;
    const here: Mark[] = [];
    for (let k = first; k < sorted.length && sorted[k]!.start <= to; k++) if (sorted[k]!.end > from) here.push(sorted[k]!);
    const edges = [...new Set([from, to, ...here.flatMap(m => [m.start, m.end])])].filter(c => c >= from && c <= to).sort((a, b) => a - b);
    const names = (of: Mark[]) => [...new Set(of.map(m => m.name))].join(' ');
    const runs = edges.slice(1).map((end, k) => {
      const start = edges[k]!;
      return { start: start - from, text: text.slice(start, end), names: names(here.filter(m => m.start <= start && m.end >= end)) };
    });
    // A diagnostic at the end of a line needs a visible mark.
    const behind = here.filter(m => m.start >= to && m.name !== 'code');
    if (behind.length) runs.push({ start: to - from, text: ' ', names: names(behind) });
    return runs;
  });
}

const lineElement = (runs: Run[]) => h('div', { class: 'source-line' },
  ...runs.map(({ start, text, names }) => names ? h('span', { class: names, 'data-start': start }, text) : text));

/** A key that equal-looking lines share. */
const lineKey = (runs: Run[]) => runs.map(({ text, names }) => `${names}\t${text}`).join('\n');
