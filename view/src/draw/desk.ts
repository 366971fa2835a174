// What all tools of the drawing share: sending strokes, what the server answers, the ghost of what is being drawn.

import type { App } from '../app.ts';
import { h, s } from '../dom.ts';
import { path, to_plan } from '../plan/frame.ts';
import type { PlanView } from '../plan/view.ts';
import { type Answer, type House, type Point, redo, stroke, undo } from '../server.ts';
import { words } from '../words.ts';
import type { Stroke } from './strokes.ts';

export class Desk {
  /** What was refused and why; what a stroke would come to. */
  readonly said = h('p', { class: 'said', role: 'status' });
  readonly #app: App;
  readonly #plan: PlanView;
  #busy = false;

  constructor(app: App, plan: PlanView) {
    this.#app = app;
    this.#plan = plan;
  }

  /** Draws a stroke into the text; the ghost stays until the answer. */
  async send(what: Stroke): Promise<boolean> {
    const { file, revision } = this.#app;
    if (file === null) return false;
    return this.#ask(() => stroke(file, revision, what), words.drawn);
  }

  undo() { return this.#ask(() => undo(this.#app.file!), words.undone); }
  redo() { return this.#ask(() => redo(this.#app.file!), words.redone); }

  async #ask(send: () => Promise<Answer>, done: string): Promise<boolean> {
    if (this.#busy || this.#app.file === null) return false;
    this.#busy = true;
    try {
      const { refused, revision } = await send();
      if (refused !== undefined) this.refuse(refused);
      else {
        this.say(done);
        void this.#app.reload(revision);
      }
      return refused === undefined;
    } catch (error) {
      this.refuse((error as Error).message);
      return false;
    } finally {
      this.#busy = false;
      this.clear();
    }
  }

  say(text: string) {
    this.said.classList.remove('refused');
    this.said.textContent = text;
  }

  refuse(why: string) {
    this.clear();
    this.said.classList.add('refused');
    this.said.textContent = words.refused + why;
  }

  /** Why something cannot be changed, in words; null where it can. */
  reason(fixed: string | null | undefined): string | null {
    return fixed ? this.#app.state?.plan.reasons[fixed] ?? fixed : null;
  }

  /** Draws lines that are not yet, with a word beside them. */
  ghost(house: House, points: Point[], label: string, closed = false) {
    const at = points.map(point => to_plan(house, point));
    const [x, y] = [0, 1].map(k => at.reduce((sum, p) => sum + p[k]!, 0) / at.length) as [number, number];
    const size = this.#plan.sheet.pixel * 15;
    this.#plan.marks.replaceChildren(s('path', { class: `ghost${closed ? ' closed' : ''}`, d: path(at, closed) }),
      s('text', { class: 'ghost-label', x, y, 'font-size': size }, label));
    this.say(label);
  }

  clear() { this.#plan.marks.replaceChildren(); }
}
