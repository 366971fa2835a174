// Tests of the extension in VS Code: highlighting, squiggles, problems panel, completion, hovers, fixes, formatting. The contents of
// files are checked on disk after saving.
import { cpSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { until, withWindow } from './vscode_window.mjs';

/** Files with an error each, an unformatted one, an unfinished one. */
const texts = {
  'a-slip.hsd': '0 0 180\n9.5\nname 町家\n\nKKS  TKD 2MRR\nKSK  MRE  KSK\nKKS  TIT 2KKS\nKSK  KSK  KSK\n',
  'b-slip.hsd': '<!-- 全角の文字 -->\n<House name="町家">\n  <Storey height="9.5">\n    <Row>KKS  TKD 2MRE</Row>\n'
    + '    <Row>KSK  MRE  KSK</Row>\n    <Row>KKS  TIT 2KKS</Row>\n    <Rwo>KSK  KSK  KSK</Rwo>\n  </Storey>\n</House>\n',
  'c-layout.hsd': '<House><Storey height="9"><Row>KSK  KSK</Row>\n<Row>KSK</Row>\n   <Row>KSK  KSK</Row><Row>KSK</Row></Storey></House>\n',
  'd-writing.hsd': '0 0 180\n9.5\n\nKKS  TKD 2\nKSK  MRE  KSK\nKKS  TIT 2KKS\nKSK  KSK  KSK\n',
};
texts['f-comment.hsd'] = texts['d-writing.hsd'];
/** An old file in Shift_JIS, without a declaration of the encoding. */
const old = Buffer.concat([
  Buffer.from('0 0 180\n9.5\nname '), Buffer.from('92ac89c6', 'hex'), Buffer.from('\n# '),
  Buffer.from('8b9e82cc92ac89c682cc8b4c985e', 'hex'), Buffer.from('\n\nKSK  KSK\nKSK\nKSK  KSK\nKSK\n'),
]);

function workspace(out, repository) {
  const folder = join(out, 'workspace');
  mkdirSync(folder, { recursive: true });
  for (const [name, text] of Object.entries(texts)) writeFileSync(join(folder, name), text);
  writeFileSync(join(folder, 'e-old.hsd'), old);
  cpSync(join(repository, 'examples', 'machiya.hsd'), join(folder, 'machiya.hsd'));
  return folder;
}

const line = (text, number) => text.split('\n')[number - 1];
function same(found, wanted, what) {
  if (found !== wanted) throw new Error(`${what}: ${JSON.stringify(found)}, not ${JSON.stringify(wanted)}`);
}

/** Adjacent codes of a line have alternating colours. */
async function colours(window) {
  await window.open('machiya.hsd');
  const colour = async column => {
    const { x, y, width, height } = await window.place(8, column);
    return window.page.evaluate(([x, y]) => getComputedStyle(document.elementsFromPoint(x, y)
      .find(element => element.tagName === 'SPAN' && element.closest('.view-line'))).color, [x + width / 2, y + height / 2]);
  };
  const turns = async () => {
    const all = [];
    for (const column of [1, 6, 11, 16, 21]) all.push(await colour(column));
    const [odd, even] = all;
    return odd !== even && all.every((each, i) => each === [odd, even][i % 2]) && all;
  };
  console.log(`adjacent codes: ${(await until('alternating colours', turns)).slice(0, 2).join(' and ')}`);
  await window.clean();
}

/** A legacy file: the squiggle, the problems panel, and the fix. */
async function legacy(window, picture) {
  await window.open('a-slip.hsd');
  await window.squiggle(5, 11, 13);
  const rows = await window.problem('MRR');
  if (!rows.some(row => row.includes('[Ln 5, Col 11]') && row.includes('HSD0301'))) throw new Error(`no such problem: ${rows.join('\n')}`);
  console.log(`problems: ${rows.join(' | ')}`);
  await picture('squiggle');
  await window.fix('a-slip.hsd', 5, 11, 'MRE', text => line(text, 5) === 'KKS  TKD 2MRE', () => picture('fixes'));
}

/** The same in XML, after full-width characters. */
async function xml(window) {
  await window.open('b-slip.hsd');
  await window.squiggle(7, 6, 8);
  await window.problem('HSD0221');
  await window.fix('b-slip.hsd', 7, 6, 'Row', text => line(text, 7) === '    <Row>KSK  KSK  KSK</Row>');
}

/** Completions fill five columns; Tab moves to the next code, and Enter after a complete code starts a new line. */
async function completion(window, picture) {
  const name = 'd-writing.hsd';
  await window.open(name);
  await window.go(4, 11);
  await window.keys.type('MR', { delay: 60 });
  const rows = await window.suggestions('MRE');
  console.log(`suggestions: ${rows.slice(0, 3).join(' | ')}`);
  await picture('completion');
  await window.choose('MRE');
  for (const key of ['Tab', 'Enter']) {
    await window.keys.type('KSK', { delay: 60 });
    await until('the suggestions close after a complete code', async () => !await window.page.locator('.suggest-widget.visible').count());
    await window.keys.press(key);
  }
  const text = await window.saved(name, text => line(text, 5) === '', 'a new line');
  same(line(text, 4), 'KKS  TKD 2MRE  KSK  KSK', 'a completed line');
  // Completion by the Japanese name.
  await window.go(5, 1);
  await window.keys.insertText('大戸');
  await window.propose('TOD');
  await window.choose('TOD');
  await window.saved(name, text => line(text, 5) === 'TOD  ', 'a part by its name');
}

async function hover(window, picture) {
  await window.open('machiya.hsd');
  const found = await window.hover(8, 2, '格子');
  await picture('hover');
  console.log(`hover: ${found.text.replace(/\s+/g, ' ').slice(0, 120)}; image widths ${found.images.join(', ')}`);
  if (!found.images.some(width => width > 0)) throw new Error('the hover of a part has no image');
}

async function layout(window, picture) {
  await window.open('c-layout.hsd');
  await window.command('hsd: Format Source File');
  const wanted = '<House>\n  <Storey height="9">\n    <Row>KSK  KSK</Row>\n    <Row>KSK</Row>\n    <Row>KSK  KSK</Row>\n'
    + '    <Row>KSK</Row>\n  </Storey>\n</House>\n';
  await window.saved('c-layout.hsd', text => text === wanted, 'the formatted file');
  await picture('layout');
}

/** Snippets and comments follow the form at the cursor; the encoding of an old file is detected. */
async function forms(window) {
  await window.open('b-slip.hsd');
  await window.go(8, 12);
  await window.keys.type('\nreplac', { delay: 30 });
  await window.suggestions('replace, Snippet');
  await window.keys.press('Escape');
  await window.go(4, 5);
  await window.keys.press('Control+/');
  await window.saved('b-slip.hsd', text => line(text, 4) === '    <!-- <Row>KKS  TKD 2MRE</Row> -->', 'a line of XML as a comment');
  await window.open('f-comment.hsd');
  await window.go(5, 1);
  await window.keys.press('Control+/');
  await window.saved('f-comment.hsd', text => line(text, 5) === '# KSK  MRE  KSK', 'a line of codes as a comment');
  await window.open('e-old.hsd');
  const status = window.page.locator('[id="status.editor.encoding"]');
  await until('the encoding of an old file', async () => (await status.textContent()).includes('Shift JIS'));
  await window.clean();
}

/** A missing program is reported; once it is back, everything works again. */
async function without(window, settings, write, picture) {
  write({ ...settings, 'hsd.serverPath': '/nowhere/hsd' });
  await until('a message about the program', async () => (await window.notifications()).some(text => text.includes('/nowhere/hsd')));
  await picture('lost');
  write(settings);
  await window.open('a-slip.hsd');
  await window.go(5, 11);
  await window.keys.press('Shift+End');
  await window.keys.type('XXX');
  await window.keys.press('Escape');
  await window.squiggle(5, 11, 13);
}

/** Runs the steps named in `only`, or all; `serve` starts VS Code with a data folder. */
export async function drive({ program, repository, out, only, took, serve }) {
  const folder = workspace(out, repository);
  const data = join(out, 'data');
  const settings = {
    'hsd.serverPath': program,
    'hsd.language': process.env.HSD_LANGUAGE ?? 'ja',
    'security.workspace.trust.enabled': false,
    'telemetry.telemetryLevel': 'off',
    'workbench.startupEditor': 'none',
    'extensions.autoCheckUpdates': false,
    'extensions.ignoreRecommendations': true,
    'problems.autoReveal': false,
  };
  const write = now => {
    for (const part of ['User', 'Machine']) writeFileSync(join(data, 'data', part, 'settings.json'), JSON.stringify(now));
  };
  await serve(data, settings, url => withWindow(url, folder, async window => {
    const picture = name => window.picture(join(out, `${name}.png`));
    const lost = () => without(window, settings, write, picture);
    const steps = { colours, legacy, xml, completion, hover, layout, forms, lost };
    try {
      for (const [name, step] of Object.entries(steps)) {
        if (only.length && !only.includes(name)) continue;
        await step(window, picture);
        took(name);
      }
    } catch (error) {
      await picture('fault');
      for (const name of Object.keys(texts)) console.error(`${name}:\n${readFileSync(join(folder, name), 'utf8')}`);
      console.error(`screenshot of the window: ${join(out, 'fault.png')}`);
      throw error;
    }
  }));
}
