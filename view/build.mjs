// Bundles the page into dist/, each file packed with gzip as the server hands it out. `cargo build` embeds what lies there.
import { build } from 'esbuild';
import { mkdir, readdir, readFile, rm, writeFile } from 'node:fs/promises';
import { gzipSync } from 'node:zlib';

const made = await build({
  entryPoints: { view: 'src/main.ts' },
  bundle: true,
  minify: true,
  format: 'esm',
  target: 'es2022',
  legalComments: 'eof', // licences of what is bundled
  write: false,
  outdir: 'dist',
});
const files = [
  ...made.outputFiles.map(file => [file.path.split(/[\\/]/).pop(), file.contents]),
  ...await Promise.all(['index.html', 'view.css'].map(async name => [name, await readFile(name)])),
];
await mkdir('dist', { recursive: true });
for (const name of await readdir('dist')) if (name.endsWith('.gz')) await rm(`dist/${name}`);
for (const [name, bytes] of files) {
  const packed = gzipSync(bytes, { level: 9 });
  packed[9] = 255; // The system that packed it: same input, same bytes.
  await writeFile(`dist/${name}.gz`, packed);
  console.log(`dist/${name}.gz ${(packed.length / 1024).toFixed(0)} kB`);
}
