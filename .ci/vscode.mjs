// node vscode.mjs HSD OUT [STEP...]
// Builds the extension of editors/vscode into OUT/hsd.vsix, runs its tests, and tests it in VS Code with the program HSD, in all
// steps or in those named (see vscode_drive.mjs). The npm modules and VS Code are installed in HSD_NODE. VS Code comes from the npm
// package `code-server`, whose folder lib/vscode is Microsoft's editor for browsers; its own front end is not used.
import { spawn, spawnSync } from 'node:child_process';
import { cpSync, existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { basename, dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { folder as modules } from './modules.mjs';
import { drive } from './vscode_drive.mjs';

const SERVER = 'code-server@4.100.3'; // VS Code 1.100; later ones need a later Node
const repository = resolve(dirname(fileURLToPath(import.meta.url)), '..');
const source = join(repository, 'editors', 'vscode');

/** Runs a program to its end, with several `tries` for network operations. */
function run(folder, program, args, { tries = 1, env = {} } = {}) {
  const options = { cwd: folder, stdio: ['ignore', 'inherit', 'inherit'], env: { ...process.env, ...env } };
  for (let attempt = 1; ; attempt += 1) {
    const { status, error } = spawnSync(program, args, options);
    if (status === 0) return;
    if (attempt >= tries) throw error ?? new Error(`${program} ${args.join(' ')} ended with ${status}`);
    console.error(`try ${attempt} of ${tries} failed`);
  }
}

/** Calls `make` unless it succeeded for the same text before; the marker is written last, so that a failed run is repeated. */
function once(folder, text, make) {
  const marker = join(folder, 'installed');
  if (existsSync(marker) && readFileSync(marker, 'utf8') === text) return;
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  make();
  writeFileSync(marker, text);
}

/** Copies the extension out of the tree and installs its modules. */
function copy() {
  const folder = join(modules, 'vscode-extension');
  const lock = readFileSync(join(source, 'package-lock.json'), 'utf8');
  once(folder, lock, () => {
    for (const name of ['package.json', 'package-lock.json', '.npmrc']) cpSync(join(source, name), join(folder, name));
    run(folder, 'npm', ['ci', '--no-audit', '--no-fund', '--loglevel=error', '--ignore-scripts'], { tries: 3 });
  });
  const built = new Set(['node_modules', 'dist', 'hsd.vsix']);
  for (const name of ['src', 'syntaxes', 'snippets', 'test', 'dist']) rmSync(join(folder, name), { recursive: true, force: true });
  cpSync(source, folder, { recursive: true, filter: path => dirname(path) !== source || !built.has(basename(path)) });
  return folder;
}

/** Installs VS Code; returns its main script. */
function editor() {
  const folder = join(modules, 'vscode');
  const code = join(folder, 'node_modules', 'code-server', 'lib', 'vscode');
  once(folder, SERVER, () => {
    // Native modules are not compiled; VS Code works without them here.
    const quiet = ['--no-audit', '--no-fund', '--loglevel=error', '--ignore-scripts'];
    writeFileSync(join(folder, 'package.json'), '{ "private": true }\n');
    run(folder, 'npm', ['install', ...quiet, SERVER], { tries: 3 });
    run(code, 'npm', ['install', '--omit=dev', ...quiet], { tries: 3 });
  });
  return join(code, 'out', 'server-main.js');
}

/** Runs VS Code with the extension on a free port during `use(url)`. */
async function serve(main, vsix, data, settings, use) {
  for (const part of ['User', 'Machine']) {
    mkdirSync(join(data, 'data', part), { recursive: true });
    writeFileSync(join(data, 'data', part, 'settings.json'), JSON.stringify(settings));
  }
  const common = [main, '--accept-server-license-terms', '--server-data-dir', data];
  // Its warnings about missing native modules are ignored.
  const installed = spawnSync('node', [...common, '--install-extension', vsix, '--force'], { encoding: 'utf8' });
  if (installed.status !== 0 || !/successfully installed/.test(installed.stdout)) throw new Error(`${installed.stdout}${installed.stderr}`);
  const address = ['--host', '127.0.0.1', '--port', '0', '--without-connection-token', '--telemetry-level', 'off'];
  const server = spawn('node', [...common, ...address], { stdio: ['ignore', 'pipe', 'pipe'] });
  try {
    let output = '';
    const port = await new Promise((found, failed) => {
      server.once('exit', code => failed(new Error(`VS Code ended with ${code}: ${output}`)));
      for (const stream of [server.stdout, server.stderr]) {
        stream.on('data', text => {
          output += text;
          const listens = /listening on (\d+)/.exec(output);
          if (listens) found(listens[1]);
        });
      }
    });
    await use(`http://127.0.0.1:${port}`);
  } finally {
    server.kill();
  }
}

const [program, out] = process.argv.slice(2, 4).map(path => resolve(path));
if (!out) throw new Error('node vscode.mjs HSD OUT [STEP...]');
mkdirSync(out, { recursive: true });
const started = Date.now();
const took = what => console.log(`${what} (after ${((Date.now() - started) / 1000).toFixed(1)} s)`);

const extension = copy();
took('modules of the extension');
run(extension, 'npm', ['test', '--silent'], { env: { HSD: program, HSD_REPOSITORY: repository } });
took('tests of grammar and snippets');
run(extension, 'npm', ['run', '--silent', 'package']);
const vsix = join(out, 'hsd.vsix');
cpSync(join(extension, 'hsd.vsix'), vsix);
took('hsd.vsix');
const main = editor();
took('VS Code');
const only = process.argv.slice(4);
await drive({ program, repository, out, only, took, serve: (data, settings, use) => serve(main, vsix, data, settings, use) });
took('VS Code tests');
process.exit(0);
