// Hands at the drawing tools: where points are on the screen, clicks and drags, and what an edit has made of the text.

import assert from 'node:assert/strict';
import type { Page } from 'playwright-core';
import { type Preview, until } from './preview.ts';

export type Place = [x: number, y: number];

/** What `drawing` gives for the page and the file of a test. */
export interface Drawing {
  text: () => string;
  tool: (name: string) => Promise<void>;
  status: () => Promise<string | null>;
  /** Screen position of a place. */
  at: (...place: Place) => Promise<{ x: number; y: number }>;
  click: (...place: Place) => Promise<void>;
  /** Drags from place to place, and holds. */
  pull: (from: Place, to: Place) => Promise<void>;
  drag: (from: Place, to: Place) => Promise<void>;
  /** Waits until the text holds what is wanted, and page and model show that text. */
  becomes: (wanted: string | ((text: string) => boolean), what?: string) => Promise<void>;
  /** Puts a text back if the file has another one, and waits until page and model show it. */
  restore: (original: string) => Promise<void>;
}

/** Works on the page of a file. Places are units of its first house, left and back, or metres east and north. */
export function drawing(file: string, now: () => { preview: Preview; page: Page }, metres = false): Drawing {
  const text = () => now().preview.read(file), status = () => now().page.locator('.status').textContent();
  const at = (...[a, b]: Place) => now().page.evaluate(([a, b, metres]) => {
    const scale = metres ? -1 : hsd.app.state!.plan.houses[0]!.unit_m;
    const { x, y } = new DOMPoint(-a * scale, -b * Math.abs(scale)).matrixTransform(hsd.plan.sheet.svg.getScreenCTM()!);
    return { x, y };
  }, [a, b, metres] as const);
  const pull = async (from: Place, to: Place) => {
    const { mouse } = now().page, [p, q] = [await at(...from), await at(...to)];
    await mouse.move(p.x, p.y);
    await mouse.down();
    await mouse.move((p.x + q.x) / 2, (p.y + q.y) / 2, { steps: 3 });
    await mouse.move(q.x, q.y, { steps: 3 });
  };
  const becomes: Drawing['becomes'] = async (wanted, what = `the text has ${wanted}`) => {
    const holds = typeof wanted === 'string' ? (text: string) => text.includes(wanted) : wanted, { page } = now();
    await until(() => holds(text()), what).catch(async error => { throw new Error(`${(error as Error).message}; ${await status()}\n${text()}`); });
    await until(() => page.evaluate(text => [hsd.plan.state, hsd.app.state].every(state => state?.sources[0]?.text === text) && hsd.reload?.revision === hsd.revision, text()), 'the page shows it');
    await page.waitForTimeout(60);
  };
  return {
    text, status, at, pull, becomes,
    tool: name => now().page.locator(`.tools input[value=${name}]`).check(),
    click: async (...place) => {
      const { x, y } = await at(...place);
      assert.ok(await now().page.evaluate(([x, y]) => hsd.plan.element.contains(document.elementFromPoint(x, y)), [x, y] as const), `${place} is in view`);
      await now().page.mouse.click(x, y);
    },
    drag: async (from, to) => { await pull(from, to); await now().page.mouse.up(); },
    restore: async original => {
      if (text() === original) return;
      await now().preview.save(now().page, file, original);
      await becomes(text => text === original, 'the text is put back');
    },
  };
}
