// node build.mjs THREE OUT: writes the viewer as one script; THREE is a folder of node modules with three and esbuild in it.
import { createRequire } from 'node:module';
import { resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const [modules, out] = process.argv.slice(2).map(path => resolve(path));
const { build } = createRequire(`${modules}/`)('esbuild');
await build({
  entryPoints: [fileURLToPath(new URL('viewer.mjs', import.meta.url))],
  outfile: out,
  bundle: true,
  minify: true,
  format: 'iife',
  target: 'es2022',
  legalComments: 'inline',
  nodePaths: [modules],
});
