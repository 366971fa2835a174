// node grammar.mjs TREE-SITTER
// Tests the tree-sitter grammar: the parser is up to date with grammar.js, its own tests pass, incremental parsing after random edits
// gives the same tree as a fresh parse, and all examples and library files are parsed without errors, with any line endings, and with
// a highlight for each character that is not blank.
import { execFileSync, spawnSync } from 'node:child_process';
import { cpSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';

const program = process.argv[2];
if (!program) throw new Error('usage: node grammar.mjs TREE-SITTER');
const root = join(dirname(fileURLToPath(import.meta.url)), '../..');
const grammar = join(root, 'grammar/tree-sitter-hsd');
const work = mkdtempSync(join(tmpdir(), 'hsd-grammar-'));
process.on('exit', () => rmSync(work, { recursive: true, force: true }));

// Ignores the user's configuration and parsers.
writeFileSync(join(work, 'config.json'), '{"parser-directories":[]}');
const env = { ...process.env, TREE_SITTER_DIR: work, XDG_CACHE_HOME: join(work, 'cache') };

function run(...args) {
  return execFileSync(program, args, { cwd: grammar, env, encoding: 'utf8', maxBuffer: 1 << 28, stdio: ['ignore', 'pipe', 'pipe'] });
}

function fail(message) {
  console.error(message);
  process.exit(1);
}

/** Checks that `src` is up to date with `grammar.js`. */
function generated() {
  const folder = join(work, 'generated');
  mkdirSync(folder);
  for (const name of ['grammar.js', 'tree-sitter.json', 'package.json']) cpSync(join(grammar, name), join(folder, name));
  // ABI 14 is the newest that Neovim 0.7 supports.
  execFileSync(program, ['generate', '--abi', '14'], { cwd: folder, env, stdio: 'pipe' });
  for (const name of ['parser.c', 'grammar.json', 'node-types.json']) {
    if (!readFileSync(join(folder, 'src', name)).equals(readFileSync(join(grammar, 'src', name)))) {
      fail(`src/${name} is out of date: run \`tree-sitter generate --abi 14\` in grammar/tree-sitter-hsd`);
    }
  }
}

/** Runs the tests of test/corpus and test/highlight, then random edits of the corpus. */
function tested() {
  const test = spawnSync(program, ['test'], { cwd: grammar, env, encoding: 'utf8' });
  if (test.status !== 0) fail(test.stdout + test.stderr);
  console.log(test.stdout.match(/Total parses.*/)?.[0] ?? 'no tests');
  const fuzz = spawnSync(program, ['fuzz', '--iterations', '100', '--edits', '6'], { cwd: grammar, env, encoding: 'utf8' });
  if (fuzz.status !== 0) fail(fuzz.stdout + fuzz.stderr);
}

/** All files of the repository that must be parsed without errors. */
function texts() {
  const found = [];
  for (const folder of ['examples', 'library']) {
    for (const name of readdirSync(join(root, folder), { recursive: true })) {
      if (name.endsWith('.hsd')) found.push(join(root, folder, name));
    }
  }
  return found.sort();
}

/** The syntax trees of files, without positions. */
function trees(files) {
  const output = run('parse', '--no-ranges', ...files);
  if (/\((ERROR|MISSING|UNEXPECTED|unclosed)/.test(output)) {
    fail(run('parse', '--quiet', ...files));
  }
  return output;
}

/** Checks that other line endings, a missing last line ending and a byte order mark do not change the trees. */
function sameTrees(files) {
  const expected = trees(files);
  const changes = {
    crlf: text => text.replaceAll('\n', '\r\n'),
    cr: text => text.replaceAll('\n', '\r'),
    'no-last': text => text.trimEnd(),
    mark: text => `\ufeff${text}`,
  };
  for (const [name, change] of Object.entries(changes)) {
    const copies = files.map((file, i) => {
      const copy = join(work, `${name}-${i}.hsd`);
      writeFileSync(copy, change(readFileSync(file, 'utf8')));
      return copy;
    });
    if (trees(copies) !== expected) fail(`trees differ for the variant ${name}`);
  }
}

/** Checks that every character that is not blank has a capture of queries/highlights.scm. */
function coloured(files) {
  const bare = [];
  for (const file of files) {
    const lines = readFileSync(file).toString('latin1').split('\n');
    const open = lines.map(line => [...line].map(c => !' \t\r'.includes(c)));
    const captures = run('query', '--captures', 'queries/highlights.scm', file);
    const place = /start: \((\d+), (\d+)\), end: \((\d+), (\d+)\)/g;
    for (const [, ...numbers] of captures.matchAll(place)) {
      const [fromRow, fromColumn, toRow, toColumn] = numbers.map(Number);
      for (let row = fromRow; row <= toRow && row < open.length; row++) {
        const end = row === toRow ? toColumn : open[row].length;
        open[row].fill(false, row === fromRow ? fromColumn : 0, Math.max(end, 0));
      }
    }
    open.forEach((columns, row) => {
      const column = columns.indexOf(true);
      if (column >= 0) bare.push(`${relative(root, file)}:${row + 1}:${column + 1} has no highlight`);
    });
  }
  if (bare.length > 0) fail(bare.join('\n'));
}

generated();
tested();
const files = texts();
sameTrees(files);
coloured(files);
for (const query of readdirSync(join(grammar, 'queries'))) run('query', `queries/${query}`, files[0]);
console.log(`${files.length} files parsed without errors and fully highlighted`);
