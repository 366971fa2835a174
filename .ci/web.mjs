// node web.mjs MODULE HSD
// Compiles houses with hsd as a module of WebAssembly and with the program HSD. Exits with 1 if they do not give the same bytes, or if
// an error is not told.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { begin } from '../web/module.mjs';

const [module, hsd] = process.argv.slice(2);
if (!hsd) throw new Error('usage: web.mjs MODULE HSD');
const root = resolve(dirname(fileURLToPath(import.meta.url)), '..'), work = mkdtempSync(join(tmpdir(), 'hsd-web-')), found = [];
const bytes = readFileSync(module);
let start = performance.now();
const compile = await begin(bytes);
console.log(`  begun in ${Math.round(performance.now() - start)} ms`);

const houses = [
  ['chu-nikai.hsd', 1, { front: 'sake' }], ['kura.hsd', 3, {}], ['examples/machiya.hsd', 3, {}],
  ['examples/kura.hsd', 0, {}], ['examples/ninomaru.hsd', 2, {}], ['examples/pagoda.hsd', 1, {}], ['examples/street.hsd', 0, {}],
];
try {
  for (const [file, detail, parameters] of houses) {
    // A type is made as `hsd new` makes it, with what it includes.
    const type = !file.includes('/'), path = type ? join(work, file) : join(root, file), name = basename(file), target = join(work, 'm.glb');
    if (type) execFileSync(hsd, ['new', file.replace('.hsd', ''), '-o', path], { stdio: 'ignore' });
    start = performance.now();
    const { model, messages } = compile({ name, text: readFileSync(path, 'utf8'), parameters, detail });
    const took = Math.round(performance.now() - start);
    const options = Object.entries(parameters).flatMap(([key, value]) => ['--param', `${key}=${value}`]);
    execFileSync(hsd, ['build', '--quiet', name, '--detail', String(detail), ...options, '-o', target], { cwd: dirname(path), stdio: ['ignore', 'ignore', 'ignore'] });
    const same = readFileSync(target).equals(model);
    console.log(`  ${file} at detail ${detail}: ${took} ms, ${model.length} bytes${same ? '' : ', not those of the program'}`);
    if (!same) found.push(`${file}: other bytes\n${messages}`);
  }
  const wrong = compile({ text: '0 0 180\n9.5\n\nKSX\n' });
  if (wrong.model.length > 0 || !wrong.messages.includes('4:1: error[HSD0301]')) found.push(`an error is not told: ${wrong.messages}`);
} finally {
  rmSync(work, { recursive: true });
}
for (const line of found) console.log(line);
process.exit(found.length > 0 ? 1 : 0);
