// node build.mjs: bundles src/extension.ts and its imports into dist/extension.js, and collects their licences in dist/LICENSES.txt.
import { readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { build } from 'esbuild';

const { metafile } = await build({
  entryPoints: ['src/extension.ts'],
  outfile: 'dist/extension.js',
  bundle: true,
  minify: true,
  platform: 'node',
  format: 'cjs',
  target: 'node20',
  external: ['vscode'],
  legalComments: 'none',
  logLevel: 'warning',
  metafile: true,
});

const inside = /^(?:.*\/)?node_modules\/(?:@[^/]+\/)?[^/]+/;
const folders = [...new Set(Object.keys(metafile.inputs).map(path => inside.exec(path)?.[0]).filter(Boolean))].sort();
const licences = folders.map(folder => {
  const { name, version } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
  const file = readdirSync(folder).find(entry => /^licen[cs]e/i.test(entry));
  if (!file) throw new Error(`${name} has no licence file`);
  return `${name} ${version}\n\n${readFileSync(join(folder, file), 'utf8').trim()}\n`;
});
writeFileSync('dist/LICENSES.txt', licences.join('\n\n'));
