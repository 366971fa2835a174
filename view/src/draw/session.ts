// Shared by the drawing tools: sending edits to the server, reporting the results, the preview of the edit in progress.

import type { App } from '../app.ts';
import { h, s } from '../ui/dom.ts';
import { bounds, path, toPlan, type XY } from '../plan/coordinates.ts';
import type { PlanView } from '../plan/plan-view.ts';
import { type EditResult, type House, type Point, applyEdit, redo, undo } from '../server/api.ts';
import { strings } from '../ui/strings.ts';
import { sameTarget, type Edit } from './edits.ts';

/** How long an edit waits for the page to show the previous one, milliseconds. */
const TIMEOUT = 10_000;

export class EditSession {
  /** The last result or refusal, or the effect of the edit in progress. */
  readonly status = h('p', { class: 'status', role: 'status' });
  readonly #app: App;
  readonly #plan: PlanView;
  /** Settles when all edits so far have been applied and shown. */
  #queue: Promise<unknown> = Promise.resolve();

  constructor(app: App, plan: PlanView) {
    this.#app = app;
    this.#plan = plan;
  }

  /** Applies an edit after those before it; the preview stays until the server answers. */
  send(edit: Edit): Promise<boolean> {
    const intended = this.#plan.state;
    return this.#enqueue(file => {
      const { state, revision } = this.#app;
      // An earlier edit may have moved the place that this one was intended for.
      if (!intended || !state || !sameTarget(edit, intended, state)) return Promise.resolve({ refused: strings.changedMeanwhile });
      return applyEdit(file, revision, edit);
    }, strings.drawn);
  }

  undo() { return this.#enqueue(undo, strings.undone, why => this.report(why)); }
  redo() { return this.#enqueue(redo, strings.redone, why => this.report(why)); }

  #enqueue(send: (file: string) => Promise<EditResult>, done: string, refuse = (why: string) => this.refuse(why)): Promise<boolean> {
    const { file } = this.#app;
    const result = this.#queue.then(() => file !== null && file === this.#app.file && this.#run(() => send(file), done, refuse));
    this.#queue = result;
    return result;
  }

  async #run(send: () => Promise<EditResult>, done: string, refuse: (why: string) => void): Promise<boolean> {
    try {
      const { refused, revision } = await send();
      if (refused !== undefined) refuse(refused);
      else {
        this.report(done);
        await this.#waitFor(revision!);
      }
      return refused === undefined;
    } catch (error) {
      this.refuse((error as Error).message);
      return false;
    } finally {
      this.clear();
    }
  }

  /** Waits until the page shows a revision. */
  async #waitFor(revision: number) {
    await this.#app.reload(revision);
    for (const end = performance.now() + TIMEOUT; this.#app.revision < revision && performance.now() < end;) {
      await new Promise(done => setTimeout(done, 10)); // The revision was announced earlier and is still loading.
    }
  }

  report(text: string) {
    this.status.classList.remove('refused');
    this.status.textContent = text;
  }

  refuse(why: string) {
    this.clear();
    this.status.classList.add('refused');
    this.status.textContent = strings.refused + why;
  }

  /** The reason why something is fixed, for display; null where it can be edited. */
  reason(fixed: string | null | undefined): string | null {
    return fixed ? this.#app.state?.plan.reasons[fixed] ?? fixed : null;
  }

  /** Draws the preview of an edit with its label. */
  ghost(house: House, points: Point[], label: string, closed = false) {
    this.sketch([points.map(point => toPlan(house, point))], label, closed);
  }

  /** Draws lines of the plan as a preview, with a label in their middle. */
  sketch(lines: XY[][], label: string, closed: boolean) {
    const at = lines.flat();
    if (!at.length) return;
    const [x, y] = [0, 1].map(k => at.reduce((sum, p) => sum + p[k]!, 0) / at.length) as [number, number];
    const size = this.#plan.sheet.pixel * 15;
    this.#plan.marks.replaceChildren(...lines.map(line => s('path', { class: `ghost${closed ? ' closed' : ''}`, d: path(line, closed) })),
      s('text', { class: 'ghost-label', x, y, 'font-size': size }, label));
    if (!this.#plan.isDragging()) this.#plan.sheet.reveal(bounds(at)!);
    this.report(label);
  }

  clear() { this.#plan.marks.replaceChildren(); }
}
