// Runs the browser tests in Chromium: `node test/browser/run.mjs HSD [NAME...]`. HSD is the program under test, NAME a part of
// the names of the test files to run (*.browser.ts); CHROMIUM sets the path of the browser.
import { spawnSync } from 'node:child_process';
import { readdirSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const [hsd, ...names] = process.argv.slice(2);
if (!hsd) {
  console.error('node test/browser/run.mjs HSD [NAME...]');
  process.exit(2);
}
const here = dirname(fileURLToPath(import.meta.url));
const files = readdirSync(here).filter(file => /\.browser\.(ts|mjs)$/.test(file) && (names.length === 0 || names.some(name => file.includes(name))));
const { status } = spawnSync(process.execPath, ['--import', 'tsx', '--test', '--test-concurrency=1', ...files.sort().map(file => join(here, file))], {
  cwd: resolve(here, '../..'), stdio: 'inherit', env: { ...process.env, HSD: resolve(hsd) },
});
process.exit(status ?? 1);
