// node test/files.mjs [FILE...]
// Every character of the examples and of the library has a scope, and nothing is marked as invalid. Source files with errors have
// a scope for every character too. HSD_REPOSITORY is the repository, two folders up by default. With files as arguments it prints
// their tokens instead.
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { grammar, root, tokens } from './tokens.mjs';

const hsd = await grammar();
const asked = process.argv.slice(2);
for (const path of asked) {
  for (const line of tokens(hsd, readFileSync(path, 'utf8'))) {
    console.log(line.map(t => `${JSON.stringify(t.text)} ${t.scopes.join(' ')}`).join('\n'), '\n');
  }
}

const house = /\.hsd$/;
const repository = process.env.HSD_REPOSITORY ?? join(root, '..', '..');
const broken = join('tests', 'suite', 'diagnostics');
const files = asked.length ? [] : ['examples', 'library', broken]
  .flatMap(folder => readdirSync(join(repository, folder), { recursive: true }).map(name => join(folder, name)))
  .filter(name => house.test(name)).sort();
if (!asked.length && files.length < 200) throw new Error(`only ${files.length} files found`);

let faults = 0;
for (const file of files) {
  tokens(hsd, readFileSync(join(repository, file), 'utf8')).forEach((line, number) => {
    for (const { text, scopes } of line) {
      const missing = text.trim() && !scopes.some(scope => !scope.startsWith('meta.'));
      const invalid = !file.startsWith(broken) && scopes.find(scope => scope.startsWith('invalid'));
      if (!missing && !invalid) continue;
      faults += 1;
      console.error(`${file}:${number + 1}: ${JSON.stringify(text)} ${invalid || 'has no scope'}`);
    }
  });
}
if (files.length) console.log(`${files.length} files highlighted, ${faults} faults`);
process.exit(faults > 0 ? 1 : 0);
