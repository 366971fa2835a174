// node test/words.mjs
// All strings of package.json and of the source exist in English and Japanese.
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { root } from './tokens.mjs';

const read = name => readFileSync(join(root, name), 'utf8');
const keys = name => new Set(Object.keys(JSON.parse(read(name))));
const used = new Set([...read('package.json').matchAll(/"%([\w.]+)%"/g)].map(([, key]) => key));
const source = readdirSync(join(root, 'src')).map(name => read(join('src', name))).join('\n');
const translated = new Set([...source.matchAll(/l10n\.t\('((?:[^'\\]|\\.)*)'/g)].map(([, text]) => text));
if (!used.size || !translated.size) throw new Error('no strings found');

const faults = [];
for (const [file, wanted] of [['package.nls.json', used], ['package.nls.ja.json', used], ['l10n/bundle.l10n.ja.json', translated]]) {
  const there = keys(file);
  for (const key of wanted) if (!there.has(key)) faults.push(`${file} lacks ${key}`);
  for (const key of there) if (!wanted.has(key)) faults.push(`${file} has ${key}, which nothing uses`);
}
// Only literals are found by the expression above.
const calls = source.match(/l10n\.t\(/g).length;
if (calls !== source.match(/l10n\.t\('/g).length) faults.push('l10n.t is called without a literal');
for (const fault of faults) console.error(fault);
console.log(`${used.size + translated.size} strings in two languages, ${faults.length} faults`);
process.exit(faults.length ? 1 : 0);
