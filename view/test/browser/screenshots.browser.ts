// Screenshots as taken by `hsd render`, and reflections in glass.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { writeFileSync } from 'node:fs';
import { built } from './chromium.ts';
import { brightness, differ, does, Preview, unfold, until } from './preview.ts';

const here = dirname(fileURLToPath(import.meta.url));
let preview: Preview;

before(async () => { preview = await Preview.of(['machiya.hsd', join(here, '../scenes/two.hsd')]); });
after(async () => { await preview?.close(); });

test('screenshots are rendered and posted, then the end is reported', async () => {
  const page = await preview.open('', {}, false);
  const pictures = new Map<string, Buffer>(), ends: string[] = [];
  await page.route('**/api/picture?**', route => {
    pictures.set(new URL(route.request().url()).searchParams.get('view')!, route.request().postDataBuffer()!);
    return route.fulfill({ json: {} });
  });
  await page.route('**/api/rendered', route => { ends.push(route.request().postData()!); return route.fulfill({ json: {} }); });
  await page.goto(`${preview.url}?file=machiya.hsd&render=front,above&size=320x200&samples=3`);
  await until(() => ends.length > 0, 'the end is reported', 60_000);
  assert.deepEqual(ends.map(end => JSON.parse(end)), [{ errors: [] }]);
  assert.deepEqual([...pictures.keys()], ['front', 'above']);
  for (const bytes of pictures.values()) {
    assert.equal(bytes.subarray(1, 4).toString(), 'PNG');
    assert.deepEqual([bytes.readUInt32BE(16), bytes.readUInt32BE(20)], [320, 200]);
    assert.ok(bytes.length > 20_000, 'the image is not empty');
  }
  await page.goto(`${preview.url}?file=machiya.hsd&render=nowhere`);
  await until(() => ends.length > 1, 'the failure is reported');
  assert.match(JSON.parse(ends[1]!).errors[0], /nowhere/);
  await page.context().close();
});

test('reflections can be switched, with a chosen depth', async () => {
  const page = await preview.open('?file=two.hsd', { viewport: { width: 900, height: 560 } });
  const glass = await unfold(page, 'glass');
  assert.ok(await page.evaluate(() => hsd.app.renderer.mirrors.walls.length > 0));
  // A view in which glass has something to reflect.
  for (const view of ['front', 'above', 'back', 'left', 'right']) {
    await does(page, 'view').selectOption(view);
    await page.evaluate(() => hsd.settled());
    if (await page.evaluate(() => hsd.app.renderer.mirrors.stats.drawn > 0)) break;
  }
  assert.ok(await page.evaluate(() => hsd.app.renderer.mirrors.stats.drawn > 0), 'visible mirrors');
  const mirrored = await brightness(page), calls = await page.evaluate(() => hsd.stats.calls);
  await glass.getByLabel('Reflect neighbouring buildings').uncheck();
  const plain = await brightness(page);
  assert.equal(await page.evaluate(() => hsd.app.renderer.mirrors.stats.drawn), 0);
  assert.ok(await page.evaluate(() => hsd.stats.calls) < calls, 'fewer draw calls');
  assert.ok(differ(mirrored, plain, 0.01) > 0, 'the image changes');
  await glass.getByLabel('Reflect neighbouring buildings').check();
  assert.equal(differ(mirrored, await brightness(page), 0.01), 0);
  await glass.getByLabel('Reflection depth').fill('3');
  assert.equal(await page.evaluate(() => hsd.app.renderer.mirrors.options.depth), 3);
  await does(page, 'reset').click();
  assert.equal(await page.evaluate(() => hsd.app.renderer.mirrors.options.depth), 1);
  const stats = await unfold(page, 'stats');
  await until(async () => /Visible mirrors\d+ \/ \d+/.test(await stats.textContent() ?? ''), 'statistics of mirrors');
  await page.context().close();
});

test('a model file is shown without a source', async () => {
  writeFileSync(join(preview.folder, 'built.glb'), built(join(preview.folder, 'machiya.hsd')));
  const page = await preview.open('?file=built.glb');
  assert.equal(await page.evaluate(() => hsd.find('GDE 2').length), 1);
  await page.evaluate(() => hsd.select(hsd.find('GDE 2')[0]!));
  assert.match(await page.locator('.card').textContent() ?? '', /GDE 2.*Storey 1/);
  assert.equal(await page.locator('[data-layer]').count(), 4);
  await does(page, 'plan').click();
  assert.ok(await page.getByText('There is no plan to draw.').isVisible());
  await page.context().close();
});

test('no requests to other hosts, no errors', () => preview.assertClean());
