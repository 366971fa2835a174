// node test/words.mjs
// What the extension says, it says in English and in Japanese: the words of package.json, and those of its source.
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { root } from './tokens.mjs';

const read = name => readFileSync(join(root, name), 'utf8');
const keys = name => new Set(Object.keys(JSON.parse(read(name))));
const used = new Set([...read('package.json').matchAll(/"%([\w.]+)%"/g)].map(([, key]) => key));
const source = readdirSync(join(root, 'src')).map(name => read(join('src', name))).join('\n');
const said = new Set([...source.matchAll(/l10n\.t\('((?:[^'\\]|\\.)*)'/g)].map(([, text]) => text));
if (!used.size || !said.size) throw new Error('no words found');

const faults = [];
for (const [file, wanted] of [['package.nls.json', used], ['package.nls.ja.json', used], ['l10n/bundle.l10n.ja.json', said]]) {
  const there = keys(file);
  for (const key of wanted) if (!there.has(key)) faults.push(`${file} lacks ${key}`);
  for (const key of there) if (!wanted.has(key)) faults.push(`${file} has ${key}, which nothing uses`);
}
// A text that is no literal would slip through.
const calls = source.match(/l10n\.t\(/g).length;
if (calls !== source.match(/l10n\.t\('/g).length) faults.push('l10n.t with something else than a text');
for (const fault of faults) console.error(fault);
console.log(`${used.size + said.size} words in two languages, ${faults.length} faults`);
process.exit(faults.length ? 1 : 0);
