// Accessibility: keyboard, screen reader, phone, Japanese, dark mode.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import type { Page } from 'playwright-core';
import { AXE, violations } from './axe.ts';
import { translations } from '../../src/ui/strings.ts';
import { does, Preview, until } from './preview.ts';

let preview: Preview;
const WIDE = { width: 1280, height: 800 }, PHONE = { width: 360, height: 740 };

before(async () => {
  preview = await Preview.of(['machiya.hsd', 't-house.hsd', ['wrong.hsd', '9\n\nKSK  XYZ  KSK\nKSK\nKSK  KSK  KSK\nKSK\n']]);
  preview.script = AXE;
});
after(async () => { await preview?.close(); });

/** Opens all panes and sections. */
async function openAll(page: Page) {
  for (const fold of await page.locator('.fold').all()) {
    // Some are for towns alone.
    const isShut = await fold.evaluate(e => !(e as HTMLDetailsElement).open && !(e as HTMLElement).hidden);
    if (isShut) await fold.locator('summary').first().click();
  }
}

// Covers each pair of layout, language and colour scheme.
const LOOKS = [['wide', 'en', 'light'], ['wide', 'ja', 'dark'], ['phone', 'en', 'dark'], ['phone', 'ja', 'light']] as const;

for (const [layout, language, colorScheme] of LOOKS) {
  const viewport = layout === 'wide' ? WIDE : PHONE;
  test(`axe finds nothing: ${layout}, ${language}, ${colorScheme}`, async () => {
    const page = await preview.open(`?file=wrong.hsd&lang=${language}`, { viewport, colorScheme });
    assert.equal(await page.locator('html').getAttribute('lang'), language);
    if (layout === 'phone') await does(page, 'panel').click();
    await openAll(page);
    assert.deepEqual(await violations(page), [], 'panel');
    if (layout === 'phone') await does(page, 'panel').click();
    await does(page, 'text').click();
    assert.deepEqual(await violations(page), [], 'text');
    await does(page, 'plan').click();
    await page.locator('.legend summary').click();
    assert.deepEqual(await violations(page), [], 'plan');
    await does(page, 'draw').click();
    await until(async () => await page.locator('.palette button').count() > 50, 'the palette is loaded');
    for (const tool of ['part', 'wall', 'break', 'outline']) {
      await page.locator(`.tools input[value=${tool}]`).check();
      assert.deepEqual(await violations(page), [], `drawing, ${tool}`);
    }
    await page.evaluate(() => hsd.select(hsd.find('KSK')[0]!));
    if (layout === 'phone') await does(page, 'panel').click();
    assert.deepEqual(await violations(page), [], 'card');
    await page.context().close();
  });
}

test('the Japanese page has no English strings', async () => {
  const page = await preview.open('?file=machiya.hsd&lang=ja');
  await openAll(page);
  await does(page, 'plan').click();
  await does(page, 'draw').click();
  await page.evaluate(() => hsd.select(hsd.find('GDE 2')[0]!));
  const text = await page.evaluate(() => document.body.innerText);
  const flat = (of: object): string[] => Object.values(of).flatMap(v => typeof v === 'string' ? [v] : typeof v === 'object' ? flat(v as object) : []);
  const english = flat(translations.en).filter(word => /[a-z]{4}/.test(word) && new RegExp(`(^|\\n)${word.replace(/[.*+?^${}()|[\]\\]/g, '\\$&')}($|\\n)`).test(text));
  assert.deepEqual(english, []);
  for (const word of [translations.ja.section, translations.ja.sun, translations.ja.measure, translations.ja.toolName.wall, translations.ja.storey(1)]) assert.ok(text.includes(word), word);
  await page.context().close();
});

test('on a phone nothing overflows, one pane is visible at a time, and the panel is a sheet at the bottom', async () => {
  const page = await preview.open('?file=machiya.hsd', { viewport: PHONE, hasTouch: true });
  const wide = () => page.evaluate(() => [document.documentElement.scrollWidth, document.body.scrollWidth, innerWidth]);
  const panes = () => page.locator('.pane:visible').evaluateAll(all => all.map(e => e.className.replace('pane ', '')));
  assert.deepEqual(await panes(), ['model']);
  const box = (await page.locator('canvas.viewport').boundingBox())!;
  assert.ok(box.width === 360 && box.height > 450, JSON.stringify(box));
  for (const pane of ['plan', 'text', 'model']) {
    await does(page, pane).tap();
    assert.deepEqual(await panes(), [pane]);
    assert.deepEqual(await wide(), [360, 360, 360], pane);
  }
  await does(page, 'panel').tap();
  const panel = (await page.locator('.panel').boundingBox())!;
  assert.ok(panel.x === 0 && panel.width === 360 && panel.y > 250 && panel.y + panel.height <= 740, JSON.stringify(panel));
  await openAll(page);
  assert.deepEqual(await wide(), [360, 360, 360], 'panel');
  const over = await page.locator('.panel').evaluate(e => e.scrollWidth - e.clientWidth);
  assert.equal(over, 0, 'nothing in the panel is cut off');
  // The whole house is visible beside the sheet.
  await page.evaluate(() => hsd.settled());
  assert.ok(await page.evaluate(() => hsd.viewport.canvas.clientHeight > 100));
  await page.context().close();
});

test('every control is reachable by Tab, shows its focus, and has a name', async () => {
  const page = await preview.open('?file=machiya.hsd');
  await openAll(page);
  await does(page, 'plan').click();
  await does(page, 'text').click();
  await does(page, 'draw').click();
  await until(async () => await page.locator('.palette button').count() > 50, 'the palette is loaded');
  await page.evaluate(() => { hsd.select(hsd.find('GDE 2')[0]!); (document.activeElement as HTMLElement).blur(); });
  // All focusable elements; Tab reaches one element of a tree, of a radio group and of the plan's units.
  const all = await page.evaluate(() => [...document.querySelectorAll<HTMLElement>('button, input, select, summary, canvas, [tabindex="0"]')]
    .filter(e => e.checkVisibility() && !(e as HTMLButtonElement).disabled && !e.closest('[role=tree]:not(:scope)') && !(e as HTMLInputElement).matches('input[type=radio]:not(:checked)'))
    .map((e, i) => { e.dataset.stop = `${i}`; return `${i} ${e.tagName} ${e.textContent?.slice(0, 20)}`; }));
  const reached = new Set<string>(), unseen: string[] = [], unnamed: string[] = [];
  for (let i = 0; i < all.length + 60; i++) {
    await page.keyboard.press('Tab');
    const here = await page.evaluate(() => {
      const e = document.activeElement as HTMLElement, style = getComputedStyle(e), inner = e.querySelector(':scope > .label, .base');
      const shown = [style, ...(inner ? [getComputedStyle(inner)] : [])].some(s => s.outlineStyle !== 'none' && parseFloat(s.outlineWidth) >= 2 || s.strokeWidth === '9px');
      const name = e.getAttribute('aria-label') || (e as HTMLInputElement).labels?.[0]?.textContent || e.textContent || '';
      return { stop: e.dataset.stop, shown, name: name.trim(), what: `${e.tagName} ${(e as HTMLInputElement).type ?? ''} ${e.className} ${e.textContent?.slice(0, 20)}` };
    });
    if (here.stop !== undefined) reached.add(here.stop);
    if (!here.shown && !here.what.startsWith('BODY')) unseen.push(here.what);
    if (!here.name && !here.what.startsWith('BODY')) unnamed.push(here.what);
    if (reached.size >= all.length) break;
  }
  assert.deepEqual(all.filter((_, i) => !reached.has(`${i}`)), [], 'not reached');
  assert.deepEqual([...new Set(unseen)], [], 'focus is not seen');
  assert.deepEqual([...new Set(unnamed)], [], 'without a name');
  await page.context().close();
});

test('a session by keyboard: choose a file, hide a roof, cut, set the sun, measure, select, open', async () => {
  const page = await preview.open('?file=t-house.hsd');
  const tabTo = async (what: string) => {
    for (let i = 0; i < 150; i++) {
      if (await page.evaluate(what => document.activeElement?.matches(what), what)) return;
      await page.keyboard.press('Tab');
    }
    assert.fail(`${what} is not reached`);
  };
  const enter = async (fold: string) => {
    await tabTo(`[data-fold=${fold}] > summary`);
    if (!await page.evaluate(() => (document.activeElement!.parentElement as HTMLDetailsElement).open)) await page.keyboard.press('Enter');
  };
  await tabTo('.files li:first-child button');
  await page.keyboard.press('Enter');
  await until(() => page.evaluate(() => hsd.app.state?.file === 'machiya.hsd' && hsd.app.model !== null && document.querySelectorAll('[data-layer]').length === 4), 'the file is shown');
  await enter('shown');
  await tabTo('[data-layer="roof 2"] input');
  await page.keyboard.press('Space');
  assert.ok(await page.evaluate(() => hsd.app.hidden.has('roof 2')));
  await enter('parts');
  await tabTo('[role=treeitem]');
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('ArrowDown');
  await page.keyboard.press('Enter');
  assert.equal((await page.evaluate(() => hsd.selection))?.kind, 'storey');
  await enter('section');
  await tabTo('[data-fold=section] input[type=range]');
  await page.keyboard.press('ArrowRight');
  assert.ok(await page.evaluate(() => hsd.app.renderer.section.cut.on && hsd.app.renderer.section.cut.at === 0.505));
  await enter('sun');
  await tabTo('[data-fold=sun] input[type=range]');
  await page.keyboard.press('Home');
  assert.ok(await page.evaluate(() => hsd.viewport.environment.now.altitude < 0), 'midnight');
  await page.keyboard.press('Shift+Tab');
  await enter('measure');
  await tabTo('[data-fold=measure] input[type=checkbox]');
  await page.keyboard.press('Space');
  assert.ok(await page.evaluate(() => hsd.app.renderer.measure.on));
  await page.context().close();
});

test('no requests to other hosts, no errors', () => preview.assertClean());
