// node test/snippets.mjs
// Every snippet, with each of its choices, gives a source file that the program HSD (default `hsd`) checks without diagnostics and
// would not format differently. Snippets that are not whole houses are placed in a frame.
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { root } from './tokens.mjs';

const hsd = process.env.HSD ?? 'hsd';
const none = text => text;
const walls = (...rows) => rows.join('\n');
const plain = 'KSK  KSK  KSK';
const legacy = { head: '0 0 180\n9 8\n\n', low: '0 0 180\n9\n\n' };
const xml = inside => `<House>\n${indent(inside, 2)}\n</House>\n`;
const storey = inside => xml(`<Storey height="9">\n${indent(inside, 2)}\n</Storey>`);
const rows = (first, n) => storey(walls(
  `<Row>${first}</Row>`, ...[4, n, 4].map(units => `<Row><repeat num="${units}">KSK</repeat></Row>`)));
const bay = '<define name="bay" width="2">\n  <repeat num="{width}">KSK</repeat>\n</define>\n';

/** The frame of each snippet, by file and name; whole houses need none. */
const frames = {
  legacy: {
    'house': none, 'two storeys': none, 'house in XML': none,
    'storey': text => `${legacy.head}${text}${walls('KSK  KSK  KSK  KSK', plain, 'KSK  KSK  KSK  KSK', plain)}\n`,
    'wall': text => `${legacy.low}${text}${walls('KSK  KSK', `${plain}${wide(text)}`, 'KSK  KSK')}\n`,
    'left': text => `${legacy.low}${walls('KSK  KSK  KSK  KSK  KSK  KSK', 'KSK  KSK  KSK  KSK', plain)}\n`
      + `${text}${walls(plain, 'KSK')}\n`,
    'roof': text => `${legacy.low}${walls(...big(6, 8))}\n\n${text}`,
    'hisashi': text => `${legacy.head}${walls(...big(6, 8))}  ^\n${walls(...big(6, 8))}\n\n`
      + `K X  17.0 KIR   0   0   6   8\n${text}`,
    'settings': text => `0 0 180\n9\n${text}\n${walls(...big(6, 8))}\n`,
  },
  xml: {
    'storey': xml, 'replace': text => storey(`${walls(...[4, 2, 4, 2].map(row))}\n${text}`),
    'row': text => storey(`${text}${walls(row(2), row(text.includes('TKD 2') ? 4 : 3), row(2))}`),
    'repeat': text => rows(text, 4),
    'random': text => rows(text, 1), 'random pieces': text => rows(`\n${indent(text, 2)}\n`, 2),
    'define': text => xml(`${text}${body('<Row><use name="bay"/></Row>', 2)}`),
    'use': text => xml(`${bay}${body(`<Row>${text}</Row>`, 2)}`),
    'Param number': text => xml(`${text}${body('<Row><repeat num="{frontage}">KSK</repeat></Row>', 6)}`),
    'Param choice': text => xml(`${text}${body(`<Row><if test="{front = 'rice'}">GKO</if><else>GIT</else></Row>`, 1)}`),
    'let': text => xml(`${text}${body('<Row><repeat num="{depth}">KSK</repeat></Row>', 8)}`),
    'if': text => rows(`\n${indent(text, 2)}\n`, 2), 'split': text => rows(text, 1),
    'roofs': text => xml(`${body(row(6), 6)}\n${text}`),
    'roof': text => xml(`${body(row(6), 6, 8)}\n${text}`),
    'courtyard': text => storey(`${walls(row(8), row(8), row(8), row(8))}\n${text}`),
    'part': text => xml(`${text}${body('<Row><repeat num="2">GCH 2</repeat></Row>', 4)}`),
  },
};

function row(units) { return `<Row><repeat num="${units}">KSK</repeat></Row>`; }
function body(first, units, depth = 4) {
  return `<Storey height="9">\n${indent(walls(first, row(depth), row(units), row(depth)), 2)}\n</Storey>`;
}
function big(front, depth) { return [front, depth, front, depth].map(n => 'KSK  '.repeat(n).trimEnd()); }
function wide(text) { return text.includes('TKD 2') ? '  KSK' : ''; }
function indent(text, by) { return text.trimEnd().replace(/^(?=.)/gm, ' '.repeat(by)); }

/** One source file per choice of a snippet, with the first values of all other choices. */
function expansions(lines) {
  const source = lines.join('\n');
  const choices = [...source.matchAll(/\$\{(\d+)\|([^|]*)\|\}/g)].map(([, n, list]) => [n, list.split(',')]);
  const variants = [{}, ...choices.flatMap(([n, list]) => list.slice(1).map(value => ({ [n]: value })))];
  return variants.map(picked => {
    const values = {};
    let text = source.replace(/\$\{(\d+)\|([^|]*)\|\}/g, (_, n, list) => values[n] = picked[n] ?? list.split(',')[0]);
    text = text.replace(/\$\{TM_FILENAME_BASE:(\w+)\}/g, '$1');
    for (let before; before !== text;) {
      before = text;
      text = text.replace(/\$\{(\d+):((?:[^${}]|\{[^{}]*\})*)\}/g, (_, n, value) => values[n] = value);
      text = text.replace(/\$\{(\d+)\}/g, (whole, n) => values[n] ?? whole);
    }
    return text.replace(/\$0/, '').replace(/\n$/, '\n');
  });
}

const folder = mkdtempSync(join(tmpdir(), 'hsd-snippets-'));
let count = 0, faults = 0;
try {
  const paths = [];
  for (const form of ['legacy', 'xml']) {
    const snippets = JSON.parse(readFileSync(join(root, 'snippets', `${form}.json`), 'utf8'));
    for (const name of Object.keys(frames[form])) if (!snippets[name]) throw new Error(`frame without a snippet: ${name}`);
    for (const [name, { body }] of Object.entries(snippets)) {
      const frame = frames[form][name];
      if (!frame) throw new Error(`${form}.json: ${name} has no frame in test/snippets.mjs`);
      for (const text of expansions(body)) {
        if (/\$/.test(text)) throw new Error(`${name}: not expanded: ${text}`);
        const path = join(folder, `${form}-${name.replaceAll(' ', '-')}-${paths.length}.hsd`);
        writeFileSync(path, frame(text).replace(/\n+$/, '\n'));
        paths.push(path);
      }
    }
  }
  count = paths.length;
  const check = spawnSync(hsd, ['check', '--format', 'short', '--lang', 'en', ...paths], { encoding: 'utf8' });
  const layout = spawnSync(hsd, ['fmt', '--check', '--lang', 'en', ...paths], { encoding: 'utf8' });
  for (const run of [check, layout]) {
    if (run.error) throw run.error;
    const output = `${run.stdout}${run.stderr}`.split('\n').filter(line => line.includes(folder));
    if (run.status !== 0 && !output.length) throw new Error(`${run.stdout}${run.stderr}`);
    faults += output.length;
    for (const line of output) console.error(line);
  }
  for (const path of paths) {
    if (process.env.SHOW && path.includes(process.env.SHOW)) console.log(readFileSync(path, 'utf8'));
  }
} finally {
  rmSync(folder, { recursive: true });
}
console.log(`${count} snippets checked, ${faults} faults`);
process.exit(faults > 0 ? 1 : 0);
