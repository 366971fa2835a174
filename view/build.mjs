// Bundles the page into dist/, each file packed with gzip as the server hands it out. `cargo build` embeds what lies there.
import { build, transform } from 'esbuild';
import { mkdir, readdir, readFile, rm, writeFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { KTX2Loader } from 'three/addons/loaders/KTX2Loader.js';

const made = await build({
  entryPoints: { view: 'src/main.ts' },
  bundle: true,
  splitting: true, // what only some models need is fetched when one comes
  minify: true,
  format: 'esm',
  target: 'es2022',
  legalComments: 'eof', // licences of what is bundled
  write: false,
  outdir: 'dist',
});
const basis = name => readFile(fileURLToPath(import.meta.resolve(`three/addons/libs/basis/basis_transcoder.${name}`)));
const files = [
  ...made.outputFiles.map(file => [file.path.split(/[\\/]/).pop(), file.contents]),
  ...await Promise.all(['index.html', 'view.css'].map(async name => [name, await readFile(name)])),
  ['unpack.js', await worker()],
  ['basis_transcoder.wasm', await basis('wasm')],
];

/** The script of the workers that unpack pictures, as three.js puts it together at run time. Here, so that it is a file that
 * may do what the page itself may not. */
async function worker() {
  const { EngineFormat, EngineType, TranscoderFormat, BasisFormat } = KTX2Loader;
  const names = Object.entries({ EngineFormat, EngineType, TranscoderFormat, BasisFormat });
  const body = String(KTX2Loader.BasisWorker);
  const script = [
    ...names.map(([name, value]) => `let _${name} = ${JSON.stringify(value)};`),
    await basis('js'),
    body.slice(body.indexOf('{') + 1, body.lastIndexOf('}')),
  ].join('\n');
  return Buffer.from((await transform(script, { minify: true, legalComments: 'eof' })).code);
}

await mkdir('dist', { recursive: true });
const names = new Set(files.map(([name]) => `${name}.gz`));
for (const name of await readdir('dist')) if (name.endsWith('.gz') && !names.has(name)) await rm(`dist/${name}`);
for (const [name, bytes] of files) {
  const packed = gzipSync(bytes, { level: 9 });
  packed[9] = 255; // The system that packed it: same input, same bytes.
  // What is the same stays as it is, so that cargo compiles nothing again.
  const old = await readFile(`dist/${name}.gz`).catch(() => null);
  if (!old?.equals(packed)) await writeFile(`dist/${name}.gz`, packed);
  console.log(`dist/${name}.gz ${(packed.length / 1024).toFixed(0)} kB`);
}
