// node tutorial.mjs HSD OUT_DIR
// Builds every source file of grammar/tutorial.md under the name given before it (`wall.hsd`). The page's images are made with
// `hsd render --view front --size 480x320 --samples 8`.
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const [hsd, folder] = process.argv.slice(2);
if (!folder) throw new Error('usage: tutorial.mjs HSD OUT_DIR');
mkdirSync(folder, { recursive: true });
const page = join(dirname(fileURLToPath(import.meta.url)), '../grammar/tutorial.md');
const text = readFileSync(page, 'utf8');
for (const [, name, body] of text.matchAll(/`(\w+\.hsd)`:\n\n```(?:text|xml)\n([^]*?)```/g)) {
  const file = join(folder, name);
  writeFileSync(file, body);
  execFileSync(hsd, ['build', '--quiet', file, '-o', file.replace(/hsd$/, 'glb')], { stdio: 'inherit' });
}
