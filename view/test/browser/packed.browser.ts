// Compressed models: what `hsd build --compress` writes looks the same in the page as its source file. Needs an hsd with the
// feature `compress`; HSD_PACKED=1 declares that it has it.

import assert from 'node:assert/strict';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { built } from './chromium.ts';
import { brightness, differ, EXAMPLES, Preview } from './preview.ts';

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

test('an uncompressed model does not load the decoders', async t => {
  if (!packed) return t.skip(MISSING);
  const page = await preview.open('?file=machiya.hsd');
  const fetched = await page.evaluate(() => performance.getEntriesByType('resource').map(entry => new URL(entry.name).pathname));
  assert.deepEqual(fetched.filter(path => /decoders|unpack|wasm/.test(path)), []);
  preview.assertClean();
});
