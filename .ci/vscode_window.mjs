// A window of VS Code in a headless browser, operated with keyboard and mouse.
import { readFile } from 'node:fs/promises';
import { join } from 'node:path';
import { browser } from './browser.mjs';

const TIMEOUT = 30000;

/** Opens a window on a folder and calls `use(window)`. */
export async function withWindow(url, folder, use) {
  const running = await browser();
  try {
    const page = await running.newPage({ viewport: { width: 1280, height: 800 } });
    page.setDefaultTimeout(TIMEOUT);
    await page.goto(`${url}/?folder=${encodeURIComponent(folder)}`);
    await page.waitForSelector('.monaco-workbench', { timeout: 2 * TIMEOUT });
    return await use(new Window(page, folder));
  } finally {
    await running.close();
  }
}

/** Polls until the answer is truthy. */
export async function until(what, ask, patience = TIMEOUT) {
  const end = Date.now() + patience;
  for (;;) {
    const answer = await ask();
    if (answer) return answer;
    if (Date.now() > end) throw new Error(`timeout: ${what}`);
    await new Promise(done => setTimeout(done, 50));
  }
}

/** Repeats an action until its effect is visible: a busy editor may drop key presses and mouse moves. */
async function insist(what, act, seen, once = TIMEOUT / 6) {
  const end = Date.now() + 2 * TIMEOUT;
  for (;;) {
    await act();
    try {
      return await seen(once);
    } catch (error) {
      if (Date.now() > end) throw new Error(`timeout: ${what}`, { cause: error });
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
    await row.first().waitFor({ timeout: 2 * TIMEOUT });
    await row.first().dblclick();
    await this.page.waitForSelector(`.tab.active[aria-label^="${name}"]`);
    await this.page.waitForSelector('.editor-instance .view-line');
    // The explorer keeps the focus for a moment.
    await until(`${name} has the focus`, () => this.page.evaluate(() => {
      const focus = document.activeElement?.closest('.editor-instance');
      return Boolean(focus);
    }));
  }

  /** Opens the quick input with a key. */
  async askFor(key) {
    const input = this.page.locator('.quick-input-widget input').first();
    await insist(`the quick input for ${key}`, async () => {
      if (!await input.isVisible()) await this.keys.press(key);
    }, timeout => input.waitFor({ timeout }));
    return input;
  }

  /** Moves the cursor to a position, counted from 1. */
  async go(line, column) {
    const input = await this.askFor('Control+g');
    await input.fill(`:${line}:${column}`);
    await this.keys.press('Enter');
    await input.waitFor({ state: 'hidden' });
    await until(`the cursor is at ${line}:${column}`, async () => {
      const status = await this.page.locator('[id="status.editor.selection"]').textContent();
      return status.includes(`Ln ${line}, Col ${column}`);
    });
  }

  /** Saves and waits until the file has the expected contents. */
  async saved(name, wanted, what) {
    await this.keys.press('Control+s');
    let text;
    try {
      return await until(what, async () => {
        text = await readFile(join(this.folder, name), 'utf8');
        return wanted(text) && text;
      }, 10000);
    } catch (error) {
      throw new Error(`${error.message}; ${name} contains\n${text}`);
    }
  }

  /** Runs a command from the command palette. */
  async command(name) {
    const input = await this.askFor('F1');
    await input.fill(`>${name}`);
    const row = this.page.locator('.quick-input-list .monaco-list-row').filter({ hasText: name }).first();
    await row.click();
    await input.waitFor({ state: 'hidden' });
  }

  /** Screen rectangle of a character; line and column counted from 1. */
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
    if (!found) throw new Error(`no character at ${line}:${column}`);
    return found;
  }

  /** The squiggles of a kind: left, right and vertical centre on the screen. */
  squiggles(kind = 'error') {
    return this.page.$$eval(`.editor-instance .squiggly-${kind}`, all => all.map(one => {
      const { left, right, top, bottom } = one.getBoundingClientRect();
      return { left, right, middle: (top + bottom) / 2 };
    }));
  }

  /** Waits for a squiggle under exactly these columns, the only one of its kind in the window. */
  async squiggle(line, from, to) {
    const what = `the squiggle under ${line}:${from} to ${to}`;
    let all;
    try {
      await until(what, async () => {
        all = await this.squiggles();
        if (all.length !== 1) return false;
        const [first, last] = [await this.place(line, from), await this.place(line, to)];
        const [{ left, right, middle }] = all;
        return Math.abs(left - first.x) < 2 && Math.abs(right - last.x - last.width) < 2
          && middle > first.y && middle < first.y + first.height;
      });
    } catch (error) {
      throw new Error(`${error.message}; found ${JSON.stringify(all)}`);
    }
  }

  /** Applies the fix with a title at a position, and waits until it is saved and no squiggle is left. */
  async fix(name, line, column, title, wanted, look = () => undefined) {
    await this.go(line, column);
    const row = this.page.locator('.action-widget .monaco-list-row.action').filter({ hasText: title }).first();
    await insist(`the fix ${title}`, async () => {
      // Opened too early, the list is empty or shows other fixes.
      await this.keys.press('Escape');
      await this.keys.press('Control+.');
    }, timeout => row.waitFor({ timeout }));
    await look();
    const focused = this.page.locator('.action-widget .monaco-list-row.focused');
    for (let steps = 0; !(await focused.textContent()).includes(title); steps += 1) {
      if (steps === 50) throw new Error(`the fix ${title} cannot be reached`);
      await this.keys.press('ArrowDown');
    }
    await this.keys.press('Enter');
    await this.saved(name, wanted, `the fix ${title}`);
    await this.clean();
  }

  /** Waits until no error squiggle is left. */
  clean() {
    return until('no squiggle is left', async () => (await this.squiggles()).length === 0);
  }

  /** The rows of the problems panel, once one of them contains a text. */
  async problem(text) {
    const panel = this.page.locator('.markers-panel');
    await insist('the problems panel', async () => {
      if (!await panel.isVisible()) await this.keys.press('Control+Shift+m');
    }, timeout => panel.waitFor({ timeout }));
    const rows = () => this.page.$$eval('.markers-panel .monaco-list-row', all => all.map(row => row.textContent));
    return until(`a problem with ${text}`, async () => {
      const all = await rows();
      return all.some(row => row.includes(text)) && all;
    });
  }

  /** The rows of the suggestion list, once all of these texts occur in it. */
  async suggestions(...texts) {
    let rows = [];
    try {
      return await until(`suggestions with ${texts.join(', ')}`, async () => {
        rows = await this.page.$$eval('.suggest-widget.visible .monaco-list-row', all => all.map(row => row.ariaLabel || row.textContent));
        return texts.every(text => rows.some(row => row.includes(text))) && rows.length && rows;
      });
    } catch (error) {
      throw new Error(`${error.message}; found ${JSON.stringify(rows)}`);
    }
  }

  /** Triggers suggestions until one contains a text. */
  propose(text) {
    const row = this.page.locator('.suggest-widget.visible .monaco-list-row').filter({ hasText: text }).first();
    return insist(`the suggestion ${text}`, async () => {
      // A list opened too early is not updated.
      if (await this.page.locator('.suggest-widget.visible').count()) await this.keys.press('Escape');
      await this.keys.press('Control+Space');
    }, timeout => row.waitFor({ timeout }));
  }

  /** Accepts the first suggestion that contains a text. */
  async choose(text) {
    await this.page.locator('.suggest-widget.visible .monaco-list-row').filter({ hasText: text }).first().click();
    await this.page.waitForSelector('.suggest-widget.visible', { state: 'detached' });
  }

  /** The text of the hover at a position, and the widths of its images. */
  async hover(line, column, text) {
    const hover = this.page.locator('.monaco-hover:visible').filter({ hasText: text }).first();
    await insist(`the hover with ${text}`, async () => {
      // The pointer has to enter the text, since a resting one triggers no hover.
      await this.page.mouse.move(2, 2);
      const { x, y, width, height } = await this.place(line, column);
      await this.page.mouse.move(x + width / 2, y + height / 2 + 1);
      await this.page.mouse.move(x + width / 2, y + height / 2);
    }, timeout => hover.waitFor({ timeout }));
    const images = await until('the images of the hover', () => hover.evaluate(element => {
      const all = [...element.querySelectorAll('img')];
      return all.every(image => image.complete) && [all.map(image => image.naturalWidth)];
    }));
    return { text: await hover.textContent(), images: images[0] };
  }

  /** The visible notifications. */
  notifications() {
    return this.page.$$eval('.notifications-toasts .notification-list-item-message', all => all.map(one => one.textContent));
  }

  picture(path) {
    return this.page.screenshot({ path });
  }
}
