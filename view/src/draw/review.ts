// Review of a house that was read from a plan: its walls in doubt, one after the other, each in the middle of the plan with
// the scan under it. What is settled goes into the text like every other edit.

import type { App } from '../app.ts';
import { collapsible } from '../panel/collapsible.ts';
import { toPlan, type XY } from '../plan/coordinates.ts';
import type { PlanView } from '../plan/plan-view.ts';
import type { Doubt, State, Unit } from '../server/api.ts';
import { button, h, isField, newId, s } from '../ui/dom.ts';
import { strings } from '../ui/strings.ts';
import { DOUBT_KINDS, type DoubtKind, type Edit } from './edits.ts';
import { EditSession } from './session.ts';

/** Half the width of what is shown round a wall in doubt, metres. */
const AROUND = 2;

export class Review {
  readonly element: HTMLDetailsElement;
  /** Index of the wall that is shown; null before the first. */
  current: number | null = null;
  readonly #app: App;
  readonly #plan: PlanView;
  readonly #session: EditSession;
  readonly #showPlan: () => void;
  #list = h('ul', { class: 'list doubt-list', role: 'listbox', tabindex: 0, 'aria-label': strings.doubts });
  #count = h('span', { class: 'count' });
  #none = h('p', { class: 'quiet' }, strings.noDoubts);
  #acts: HTMLButtonElement[];
  /** The wall that was shown last, to tell whether an edit has brought another one. */
  #shown: string | null = null;
  /** True while an edit is under way. */
  #busy = false;
  #file: string | null = null;

  constructor(app: App, plan: PlanView, showPlan: () => void) {
    [this.#app, this.#plan, this.#showPlan] = [app, plan, showPlan];
    this.#session = new EditSession(app, plan);
    this.#session.status.className = 'review-status';
    const act = (label: string, keys: string, name: string, then: () => void) =>
      button(label, then, { 'data-do': name, 'aria-keyshortcuts': keys, title: keys });
    const kinds = DOUBT_KINDS.map((kind, i) => act(`${i + 1} ${strings.doubtKind[kind]}`, `${i + 1}`, `doubt-${kind}`, () => this.#change(kind)));
    this.#acts = [
      act(strings.acceptDoubt, 'Enter', 'accept-doubt', () => this.#accept()),
      act(strings.deleteDoubt, 'Delete', 'delete-doubt', () => this.#delete()), ...kinds,
    ];
    this.element = collapsible('doubts', strings.doubts, true, this.#none,
      h('div', { class: 'buttons' }, act(strings.previousDoubt, 'P', 'previous-doubt', () => this.step(-1)), act(strings.nextDoubt, 'N', 'next-doubt', () => this.step(1))),
      this.#list, h('div', { class: 'buttons' }, ...this.#acts.slice(0, 2)),
      h('div', { class: 'buttons', role: 'group', 'aria-label': strings.kindOfDoubt }, ...kinds),
      h('div', { class: 'buttons' }, button(strings.undo, () => void this.#after(this.#session.undo()), { title: 'Ctrl+Z', 'data-do': 'undo-doubt' }), button(strings.redo, () => void this.#after(this.#session.redo()), { title: 'Ctrl+Shift+Z', 'data-do': 'redo-doubt' })),
      this.#session.status, h('p', { class: 'quiet' }, strings.doubtHelp));
    this.element.querySelector('h2')!.append(' ', this.#count);
    this.element.hidden = true;
    plan.drawDoubts = () => this.#draw();
    app.on('files', () => {
      if (app.file === this.#file) return;
      [this.#file, this.current, this.#shown] = [app.file, null, null];
      this.element.hidden = true;
      this.#session.report('');
    });
    app.on('state', () => this.#renew());
    app.on('select', () => this.#fill()); // Names of parts have come.
    for (const place of [this.element, plan.element]) place.addEventListener('keydown', event => this.#key(event));
    window.addEventListener('keydown', event => this.#undo(event));
  }

  get #doubts(): Doubt[] { return this.#app.state?.plan.doubts ?? []; }

  /** Goes to the next wall in doubt, or the one before; behind the last comes the first. */
  step(by: number) {
    const count = this.#doubts.length;
    if (count) this.go(this.current === null ? by > 0 ? 0 : count - 1 : (this.current + by + count) % count);
  }

  /** Shows a wall in doubt. */
  go(index: number) {
    const doubt = this.#doubts[index], { state } = this.#app;
    if (!doubt || !state) return;
    this.current = index;
    this.#shown = keyOf(doubt);
    this.#showPlan();
    const found = located(state, doubt);
    if (found) {
      if (this.#plan.storey !== found.storey) this.#plan.choose(found.storey);
      const [x, y] = found.middle;
      this.#plan.sheet.fit({ x: x - AROUND, y: y - AROUND, width: 2 * AROUND, height: 2 * AROUND });
      this.#app.highlight({ id: found.unit.file, span: found.unit.span });
    } else this.#app.highlight(null);
    this.#fill();
    this.#draw();
    this.#tell();
  }

  /** Tells which wall in doubt is shown. */
  #tell() {
    const doubt = this.current === null ? undefined : this.#doubts[this.current];
    this.#session.report(doubt ? strings.doubtOf(this.current! + 1, this.#doubts.length, this.#told(doubt)) : strings.noDoubts);
  }

  /** The text has changed: what comes after a settled wall is shown, or what an undo has brought back. */
  #renew() {
    const count = this.#doubts.length;
    if (count || this.#app.state?.scan) this.element.hidden = false;
    if (this.current !== null) {
      this.current = count ? Math.min(this.current, count - 1) : null;
      const now = this.current === null ? null : keyOf(this.#doubts[this.current]!);
      if (now !== this.#shown) {
        this.#shown = now;
        if (this.current !== null) return this.go(this.current);
        this.#app.highlight(null);
        this.#tell();
      }
    }
    this.#fill();
    this.#draw();
  }

  #fill() {
    const doubts = this.#doubts, { writes } = this.#app.serverInfo;
    this.#count.textContent = doubts.length ? `${doubts.length}` : '';
    this.#none.hidden = doubts.length > 0;
    const rows = doubts.map((doubt, i) => h('li', {
      role: 'option', id: newId(), class: 'row', 'aria-selected': `${i === this.current}`, onclick: () => { this.#list.focus(); this.go(i); },
    }, this.#told(doubt)));
    this.#list.replaceChildren(...rows);
    const row = this.current === null ? undefined : rows[this.current];
    if (row) this.#list.setAttribute('aria-activedescendant', row.id); else this.#list.removeAttribute('aria-activedescendant');
    row?.scrollIntoView({ block: 'nearest' });
    this.#list.hidden = !doubts.length;
    for (const act of this.#acts) act.disabled = !writes || this.current === null;
    for (const name of ['previous-doubt', 'next-doubt']) this.element.querySelector<HTMLButtonElement>(`[data-do=${name}]`)!.disabled = !doubts.length;
  }

  /** A wall in doubt in words. */
  #told(doubt: Doubt): string {
    const { state } = this.#app, found = state && located(state, doubt), code = found?.unit.code || doubt.code;
    const [a, b] = (found?.unit.from ?? doubt.at).map(n => `${Number(n.toFixed(2))}`) as [string, string];
    const name = this.#app.names.get(code)?.split(' · ')[0];
    const words = [name ? `${code} ${name}` : code, found && found.storey > 1 ? strings.storey(found.storey) : '', strings.pointAt(a, b), found ? '' : strings.doubtGone];
    return words.filter(Boolean).join(strings.comma);
  }

  /** Marks the walls in doubt of the storey in the plan. */
  #draw() {
    const { state } = this.#plan, marks: SVGElement[] = [];
    for (const [i, doubt] of (state?.plan.doubts ?? []).entries()) {
      const found = located(state!, doubt);
      if (found?.storey !== this.#plan.storey) continue;
      const [[x1, y1], [x2, y2]] = found.ends, current = i === this.current;
      const mark = s('g', { class: current ? 'doubt current' : 'doubt', onclick: () => this.go(i) }, s('line', { x1, y1, x2, y2 }), s('title', {}, this.#told(doubt)));
      if (current) mark.append(s('circle', { cx: found.middle[0], cy: found.middle[1], r: Math.hypot(x2 - x1, y2 - y1) / 2 + 0.35 }));
      marks.push(mark);
    }
    this.#plan.doubts.replaceChildren(...marks);
  }

  #accept() { void this.#send(doubt => ({ do: 'accept-doubt', doubt })); }
  #delete() { void this.#send(doubt => ({ do: 'delete-doubt', doubt })); }
  #change(kind: DoubtKind) { void this.#send(doubt => ({ do: 'change-doubt', doubt, kind })); }

  async #send(edit: (doubt: number) => Edit) {
    // A key that is pressed before the next wall is shown is not meant for it.
    if (this.current === null || this.#busy || !this.#app.serverInfo.writes) return;
    this.#busy = true;
    this.#showPlan();
    await this.#after(this.#session.send(edit(this.current)));
    this.#busy = false;
  }

  /** The page may show a change before the answer to it, whose message then stands where the wall was told. */
  async #after(edit: Promise<boolean>) {
    if (await edit && (this.current !== null || !this.#doubts.length)) this.#tell();
  }

  #key(event: KeyboardEvent) {
    const { key, target, ctrlKey, metaKey, altKey } = event;
    if (event.defaultPrevented || ctrlKey || metaKey || altKey || isField(target) || this.element.hidden || !this.element.open) return;
    // The keys of a drawing tool are its own.
    if (this.#plan.element.classList.contains('drawing') && this.#plan.element.contains(target as Node)) return;
    // What has a use of Enter or Delete of its own keeps it.
    const own = (target as Element).closest('button, summary, a, [role=button]') !== null, inside = this.element.contains(target as Node), inList = target === this.#list;
    const kind = DOUBT_KINDS[Number(key) - 1];
    if (key === 'n' || key === 'N' || inList && key === 'ArrowDown') this.step(1);
    else if (key === 'p' || key === 'P' || inList && key === 'ArrowUp') this.step(-1);
    else if (inList && key === 'Home') this.go(0);
    else if (inList && key === 'End') this.go(this.#doubts.length - 1);
    else if (key === 'Enter' && !own) this.#accept();
    else if (key === 'Delete' && (inside || !own)) this.#delete();
    else if (/^[1-5]$/.test(key) && kind) this.#change(kind);
    else return;
    event.preventDefault();
  }

  /** Undo by keys; the drawing tools do it themselves while they are on. */
  #undo(event: KeyboardEvent) {
    const { key, ctrlKey, metaKey, shiftKey, target } = event, letter = key.toLowerCase();
    const here = [this.element, this.#plan.element].some(place => place.contains(target as Node));
    if (event.defaultPrevented || !(ctrlKey || metaKey) || !here || isField(target) || this.element.hidden) return;
    if (letter === 'z' && !shiftKey) void this.#after(this.#session.undo());
    else if (letter === 'z' || letter === 'y') void this.#after(this.#session.redo());
    else return;
    event.preventDefault();
  }
}

const keyOf = ({ code, at, unit }: Doubt) => `${code} ${at} ${unit?.house} ${unit?.storey}`;

/** The part of a wall in doubt, and where it is in the plan; null if it is gone. */
function located({ plan }: State, { unit: at }: Doubt): { unit: Unit; storey: number; ends: [XY, XY]; middle: XY } | null {
  if (!at) return null;
  const house = plan.houses[at.house], storey = house?.storeys[at.storey], unit = storey?.rings[at.ring]?.walls[at.wall]?.units[at.unit];
  if (!house || !storey || !unit) return null;
  const ends: [XY, XY] = [toPlan(house, unit.from), toPlan(house, unit.to)];
  return { unit, storey: storey.storey, ends, middle: [(ends[0][0] + ends[1][0]) / 2, (ends[0][1] + ends[1][1]) / 2] };
}
