// One window of a real VS Code in a headless browser, and what a person does in it with keys and mouse.
import { readFile } from 'node:fs/promises';
import { join } from 'node:path';
import { browser } from './browser.mjs';

const PATIENCE = 30000;

/** Opens a window on a folder, and calls `use(window)`. */
export async function with_window(url, folder, use) {
  const running = await browser();
  try {
    const page = await running.newPage({ viewport: { width: 1280, height: 800 } });
    page.setDefaultTimeout(PATIENCE);
    await page.goto(`${url}/?folder=${encodeURIComponent(folder)}`);
    await page.waitForSelector('.monaco-workbench', { timeout: 2 * PATIENCE });
    return await use(new Window(page, folder));
  } finally {
    await running.close();
  }
}

/** Asks again and again until the answer is neither empty nor false. */
export async function until(what, ask, patience = PATIENCE) {
  const end = Date.now() + patience;
  for (;;) {
    const answer = await ask();
    if (answer) return answer;
    if (Date.now() > end) throw new Error(`in vain: ${what}`);
    await new Promise(done => setTimeout(done, 50));
  }
}

/** Does something again, as a person would, until what it is for is seen: a busy editor lets a key or a move of the mouse go by. */
async function insist(what, act, seen, once = PATIENCE / 6) {
  const end = Date.now() + 2 * PATIENCE;
  for (;;) {
    await act();
    try {
      return await seen(once);
    } catch (error) {
      if (Date.now() > end) throw new Error(`in vain: ${what}`, { cause: error });
    }
  }
}

class Window {
  constructor(page, folder) {
    this.page = page;
    this.folder = folder;
    this.keys = page.keyboard;
  }

  /** Opens a file of the folder from the explorer. */
  async open(name) {
    const row = this.page.locator(`.explorer-folders-view .monaco-list-row[aria-label^="${name}"]`);
    await row.first().waitFor({ timeout: 2 * PATIENCE });
    await row.first().dblclick();
    await this.page.waitForSelector(`.tab.active[aria-label^="${name}"]`);
    await this.page.waitForSelector('.editor-instance .view-line');
    // Rows of the explorer keep the focus for a moment.
    await until(`${name} has the focus`, () => this.page.evaluate(() => {
      const focus = document.activeElement?.closest('.editor-instance');
      return Boolean(focus);
    }));
  }

  /** Opens the line at the top that asks for something, by a key. */
  async ask_for(key) {
    const input = this.page.locator('.quick-input-widget input').first();
    await insist(`the line of ${key}`, async () => {
      if (!await input.isVisible()) await this.keys.press(key);
    }, timeout => input.waitFor({ timeout }));
    return input;
  }

  /** Puts the caret at a place, counted from 1. */
  async go(line, column) {
    const input = await this.ask_for('Control+g');
    await input.fill(`:${line}:${column}`);
    await this.keys.press('Enter');
    await input.waitFor({ state: 'hidden' });
    await until(`the caret is in ${line}:${column}`, async () => {
      const said = await this.page.locator('[id="status.editor.selection"]').textContent();
      return said.includes(`Ln ${line}, Col ${column}`);
    });
  }

  /** Saves, and reads the file until it is as wanted. */
  async saved(name, wanted, what) {
    await this.keys.press('Control+s');
    let text;
    try {
      return await until(what, async () => {
        text = await readFile(join(this.folder, name), 'utf8');
        return wanted(text) && text;
      }, 10000);
    } catch (error) {
      throw new Error(`${error.message}; ${name} is now\n${text}`);
    }
  }

  /** Runs a command by its name in the palette. */
  async command(name) {
    const input = await this.ask_for('F1');
    await input.fill(`>${name}`);
    const row = this.page.locator('.quick-input-list .monaco-list-row').filter({ hasText: name }).first();
    await row.click();
    await input.waitFor({ state: 'hidden' });
  }

  /** Where a column of a line is on the screen, both counted from 1. */
  async place(line, column) {
    const found = await this.page.evaluate(([line, column]) => {
      const number = row => Number.parseFloat(row.style.top);
      const rows = [...document.querySelectorAll('.editor-instance .view-lines > .view-line')].sort((a, b) => number(a) - number(b));
      const row = rows[line - 1];
      if (!row) return null;
      const walk = document.createTreeWalker(row, NodeFilter.SHOW_TEXT);
      for (let left = column - 1; walk.nextNode();) {
        const text = walk.currentNode;
        if (left >= text.length) {
          left -= text.length;
          continue;
        }
        const range = document.createRange();
        range.setStart(text, left);
        range.setEnd(text, left + 1);
        const { x, y, width, height } = range.getBoundingClientRect();
        return { x, y, width, height };
      }
      return null;
    }, [line, column]);
    if (!found) throw new Error(`nothing stands at ${line}:${column}`);
    return found;
  }

  /** The squiggles of a kind: left and right ends and middle heights on the screen. */
  squiggles(kind = 'error') {
    return this.page.$$eval(`.editor-instance .squiggly-${kind}`, all => all.map(one => {
      const { left, right, top, bottom } = one.getBoundingClientRect();
      return { left, right, middle: (top + bottom) / 2 };
    }));
  }

  /** Waits for a squiggle under exactly these columns, and no other of its kind in the window. */
  async squiggle(line, from, to) {
    const say = `the squiggle under ${line}:${from} to ${to}`;
    let all;
    try {
      await until(say, async () => {
        all = await this.squiggles();
        if (all.length !== 1) return false;
        const [first, last] = [await this.place(line, from), await this.place(line, to)];
        const [{ left, right, middle }] = all;
        return Math.abs(left - first.x) < 2 && Math.abs(right - last.x - last.width) < 2
          && middle > first.y && middle < first.y + first.height;
      });
    } catch (error) {
      throw new Error(`${error.message}; there are ${JSON.stringify(all)}`);
    }
  }

  /** Takes the mend that says `title` for what stands at a place, and waits until it is done and nothing is underlined. */
  async mend(name, line, column, title, wanted, look = () => undefined) {
    await this.go(line, column);
    const row = this.page.locator('.action-widget .monaco-list-row.action').filter({ hasText: title }).first();
    await insist(`the mend ${title}`, async () => {
      // What asked too early says that there are no mends, or shows others.
      await this.keys.press('Escape');
      await this.keys.press('Control+.');
    }, timeout => row.waitFor({ timeout }));
    await look();
    const focused = this.page.locator('.action-widget .monaco-list-row.focused');
    for (let steps = 0; !(await focused.textContent()).includes(title); steps += 1) {
      if (steps === 50) throw new Error(`the mend ${title} cannot be reached`);
      await this.keys.press('ArrowDown');
    }
    await this.keys.press('Enter');
    await this.saved(name, wanted, `the mend ${title}`);
    await this.clean();
  }

  /** Waits until nothing is underlined as an error. */
  clean() {
    return until('no squiggle is left', async () => (await this.squiggles()).length === 0);
  }

  /** The rows of the panel of problems, once one of them holds a text. */
  async problem(text) {
    const panel = this.page.locator('.markers-panel');
    await insist('the panel of problems', async () => {
      if (!await panel.isVisible()) await this.keys.press('Control+Shift+m');
    }, timeout => panel.waitFor({ timeout }));
    const rows = () => this.page.$$eval('.markers-panel .monaco-list-row', all => all.map(row => row.textContent));
    return until(`a problem that says ${text}`, async () => {
      const all = await rows();
      return all.some(row => row.includes(text)) && all;
    });
  }

  /** The rows of the list of completions, once there are some that hold all of these texts. */
  async suggestions(...texts) {
    let rows = [];
    try {
      return await until(`suggestions with ${texts.join(', ')}`, async () => {
        rows = await this.page.$$eval('.suggest-widget.visible .monaco-list-row', all => all.map(row => row.ariaLabel || row.textContent));
        return texts.every(text => rows.some(row => row.includes(text))) && rows.length && rows;
      });
    } catch (error) {
      throw new Error(`${error.message}; there are ${JSON.stringify(rows)}`);
    }
  }

  /** Asks for suggestions by key until there is one that holds a text. */
  propose(text) {
    const row = this.page.locator('.suggest-widget.visible .monaco-list-row').filter({ hasText: text }).first();
    return insist(`the suggestion ${text}`, async () => {
      // A list that came too early stays as it is.
      if (await this.page.locator('.suggest-widget.visible').count()) await this.keys.press('Escape');
      await this.keys.press('Control+Space');
    }, timeout => row.waitFor({ timeout }));
  }

  /** Takes the first suggestion that holds a text. */
  async choose(text) {
    await this.page.locator('.suggest-widget.visible .monaco-list-row').filter({ hasText: text }).first().click();
    await this.page.waitForSelector('.suggest-widget.visible', { state: 'detached' });
  }

  /** The text of the hint at a place, and how wide its pictures are. */
  async hint(line, column, text) {
    const hint = this.page.locator('.monaco-hover:visible').filter({ hasText: text }).first();
    await insist(`the hint that says ${text}`, async () => {
      // From outside, since a mouse that stays where it is asks for nothing.
      await this.page.mouse.move(2, 2);
      const { x, y, width, height } = await this.place(line, column);
      await this.page.mouse.move(x + width / 2, y + height / 2 + 1);
      await this.page.mouse.move(x + width / 2, y + height / 2);
    }, timeout => hint.waitFor({ timeout }));
    const pictures = await until('the pictures of the hint', () => hint.evaluate(element => {
      const all = [...element.querySelectorAll('img')];
      return all.every(image => image.complete) && [all.map(image => image.naturalWidth)];
    }));
    return { text: await hint.textContent(), pictures: pictures[0] };
  }

  /** The notifications that are shown. */
  notifications() {
    return this.page.$$eval('.notifications-toasts .notification-list-item-message', all => all.map(one => one.textContent));
  }

  picture(path) {
    return this.page.screenshot({ path });
  }
}
