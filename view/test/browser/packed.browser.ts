// Compressed models: what `hsd build --compress` writes looks the same in the page as its source file. Needs an hsd with the
// feature `compress`; HSD_PACKED=1 declares that it has it.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { built } from './chromium.ts';
import { brightness, differ, EXAMPLES, Preview, until } from './preview.ts';

let preview: Preview, packed: Uint8Array | null = null;

before(async () => {
  try {
    packed = built(join(EXAMPLES, 'machiya.hsd'), '--compress');
  } catch (error) {
    // The exit status of a usage error: the option does not exist.
    if (process.env['HSD_PACKED'] || (error as { status?: number }).status !== 2) throw error;
    return;
  }
  preview = await Preview.of(['machiya.hsd']);
  preview.write('packed.glb', packed);
});
after(async () => { await preview?.close(); });

const MISSING = 'hsd was built without --features compress';

test('a compressed model looks like its source', async t => {
  if (!packed) return t.skip(MISSING);
  const plain = await preview.open('?file=machiya.hsd'), seen = await brightness(plain);
  const triangles = await plain.evaluate(() => hsd.app.model!.triangles);
  const page = await preview.open('?file=packed.glb');
  assert.equal(await page.evaluate(() => hsd.app.model!.triangles), triangles);
  const textures = await page.evaluate(() => hsd.app.model!.chunks.filter(c => (c.mesh.material.map as { isCompressedTexture?: boolean } | null)?.isCompressedTexture).length);
  assert.ok(textures > 5, `${textures} chunks with compressed textures`);
  assert.ok(differ(seen, await brightness(page), 0.08) < 0.02, 'both look alike');
  preview.assertClean();
});

test('packed tiles show as many triangles as plain ones', async t => {
  if (!packed) return t.skip(MISSING);
  const counts: number[] = [];
  for (const options of [[], ['--compress']]) {
    const name = `tiles${options.length}`;
    execFileSync(process.env['HSD']!, ['town', join(EXAMPLES, 'towns/block.hsd'), '-o', `${join(preview.folder, name)}/`, '--detail', '0', '--quiet', ...options]);
    const page = await preview.open(`?file=${name}/tileset.json`);
    await until(() => page.evaluate(() => hsd.app?.town.state?.whole === true && !hsd.app.town.busy && (hsd.app.town.tiles?.shown ?? 0) > 0), 'tiles are shown', 60_000);
    counts.push(await page.evaluate(() => [...hsd.app.town.tiles!.meshes()].reduce((sum, { geometry }) => sum + (geometry.index?.count ?? 0) / 3, 0)));
    await page.context().close();
  }
  assert.ok(counts[0]! > 1000, `${counts}`);
  assert.equal(counts[1], counts[0]);
  preview.assertClean();
});

test('an uncompressed model does not load the decoders', async t => {
  if (!packed) return t.skip(MISSING);
  const page = await preview.open('?file=machiya.hsd');
  const fetched = await page.evaluate(() => performance.getEntriesByType('resource').map(entry => new URL(entry.name).pathname));
  assert.deepEqual(fetched.filter(path => /decoders|unpack|wasm/.test(path)), []);
  preview.assertClean();
});
