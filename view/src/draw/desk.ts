// What all tools of the drawing share: sending strokes, what the server answers, the ghost of what is being drawn.

import type { App } from '../app.ts';
import { h, s } from '../dom.ts';
import { path, to_plan } from '../plan/frame.ts';
import type { PlanView } from '../plan/view.ts';
import { type Answer, type House, type Point, redo, stroke, undo } from '../server.ts';
import { words } from '../words.ts';
import { same_place, type Stroke } from './strokes.ts';

/** How long a stroke waits until the page shows the one before, milliseconds. */
const PATIENCE = 10_000;

export class Desk {
  /** What was refused and why; what a stroke would come to. */
  readonly said = h('p', { class: 'said', role: 'status' });
  readonly #app: App;
  readonly #plan: PlanView;
  /** Ends when all strokes so far are drawn and shown. */
  #turn: Promise<unknown> = Promise.resolve();

  constructor(app: App, plan: PlanView) {
    this.#app = app;
    this.#plan = plan;
  }

  /** Draws a stroke into the text, after those before; the ghost stays until the answer. */
  send(what: Stroke): Promise<boolean> {
    const meant = this.#plan.state;
    return this.#ask(file => {
      const { state, revision } = this.#app;
      // It was meant for the plan that was seen; what was drawn before it may have moved its place.
      if (!meant || !state || !same_place(what, meant, state)) return Promise.resolve({ refused: words.changed_meanwhile });
      return stroke(file, revision, what);
    }, words.drawn);
  }

  undo() { return this.#ask(undo, words.undone, why => this.say(why)); }
  redo() { return this.#ask(redo, words.redone, why => this.say(why)); }

  #ask(send: (file: string) => Promise<Answer>, done: string, refuse = (why: string) => this.refuse(why)): Promise<boolean> {
    const { file } = this.#app;
    const asked = this.#turn.then(() => file !== null && file === this.#app.file && this.#asked(() => send(file), done, refuse));
    this.#turn = asked;
    return asked;
  }

  async #asked(send: () => Promise<Answer>, done: string, refuse: (why: string) => void): Promise<boolean> {
    try {
      const { refused, revision } = await send();
      if (refused !== undefined) refuse(refused);
      else {
        this.say(done);
        await this.#shown(revision!);
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
  async #shown(revision: number) {
    await this.#app.reload(revision);
    for (const end = performance.now() + PATIENCE; this.#app.revision < revision && performance.now() < end;) {
      await new Promise(done => setTimeout(done, 10)); // it was heard of before, and is on its way
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
