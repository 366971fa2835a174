// Models made small for the web: what `hsd build --compress` writes looks in the page like the text it was made from. Needs an
// hsd that was built with `--features compress`; HSD_PACKED=1 says that it is.

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
    // The exit status of wrong usage: there is no such option.
    if (process.env['HSD_PACKED'] || (error as { status?: number }).status !== 2) throw error;
    return;
  }
  preview = await Preview.of(['machiya.hsd']);
  preview.write('packed.glb', packed);
});
after(async () => { await preview?.close(); });

const MISSING = 'hsd was built without --features compress';

test('a packed model looks like the text it was made from', async t => {
  if (!packed) return t.skip(MISSING);
  const plain = await preview.open('?file=machiya.hsd'), seen = await brightness(plain);
  const triangles = await plain.evaluate(() => hsd.app.model!.triangles);
  const page = await preview.open('?file=packed.glb');
  assert.equal(await page.evaluate(() => hsd.app.model!.triangles), triangles);
  const pictures = await page.evaluate(() => hsd.app.model!.chunks.filter(c => (c.mesh.material.map as { isCompressedTexture?: boolean } | null)?.isCompressedTexture).length);
  assert.ok(pictures > 5, `${pictures} chunks with packed pictures`);
  assert.ok(differ(seen, await brightness(page), 0.08) < 0.02, 'both look alike');
  preview.blameless();
});

test('a plain model fetches nothing that unpacks', async t => {
  if (!packed) return t.skip(MISSING);
  const page = await preview.open('?file=machiya.hsd');
  const fetched = await page.evaluate(() => performance.getEntriesByType('resource').map(entry => new URL(entry.name).pathname));
  assert.deepEqual(fetched.filter(path => /packed|unpack|wasm/.test(path)), []);
  preview.blameless();
});
