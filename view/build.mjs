// Bundles the page into dist/, each file gzipped as the server sends it. `cargo build` embeds the files of dist/.
import { build, transform } from 'esbuild';
import { mkdir, readdir, readFile, rm, writeFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { KTX2Loader } from 'three/addons/loaders/KTX2Loader.js';

const made = await build({
  entryPoints: { view: 'src/main.ts' },
  bundle: true,
  splitting: true, // decoders are loaded only for the models that need them
  minify: true,
  format: 'esm',
  target: 'es2022',
  external: ['@mapbox/vector-tile', 'pbf', 'pmtiles'], // the library of tiles asks for them where a town has vector tiles: none has
  legalComments: 'eof', // licences of the bundled packages
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

/**
 * The script of the texture workers, which three.js otherwise assembles at run time. As a separate file it can have a content
 * security policy of its own.
 */
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
  packed[9] = 255; // the gzip header's operating system: unknown, so that the bytes are the same everywhere
  // Unchanged files are not rewritten, so that cargo does not recompile.
  const old = await readFile(`dist/${name}.gz`).catch(() => null);
  if (!old?.equals(packed)) await writeFile(`dist/${name}.gz`, packed);
  console.log(`dist/${name}.gz ${(packed.length / 1024).toFixed(0)} kB`);
}
