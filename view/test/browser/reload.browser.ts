// Live reload: the page follows the saved file quickly and keeps the reader's settings.

import assert from 'node:assert/strict';
import { readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import type { Page } from 'playwright-core';
import { buildTo, built } from './chromium.ts';
import { brightness, differ, does, EXAMPLES, mean, Preview, unfold, until } from './preview.ts';

/** Milliseconds from a save to the painted frame; machines without a GPU under other load need more. */
const BAR = Number(process.env['HSD_BAR'] ?? 400);

let preview: Preview, page: Page, text: string;

before(async () => {
  preview = await Preview.of(['machiya.hsd']);
  page = await preview.open('?file=machiya.hsd');
  text = preview.read('machiya.hsd');
});
after(async () => { await preview?.close(); });

test('after a save, camera, toggles, section and selection stay', async () => {
  await does(page, 'text').click();
  const section = await unfold(page, 'section');
  await section.getByLabel('Axis').selectOption('x');
  await section.getByLabel('Position').fill('0.8');
  await (await unfold(page, 'shown')).getByLabel('Roofs of storey 2').uncheck();
  const camera = [3, 5, 14, 0.5, 2, 1];
  await page.evaluate(camera => { hsd.camera = camera; hsd.select(hsd.find('TOD')[0]!); }, camera);
  const before = await page.evaluate(() => hsd.selection), pictures = await page.evaluate(() => hsd.viewport.renderer.info.memory.textures);
  // A comment before it moves the part's span; another part beside it changes.
  await preview.save(page, 'machiya.hsd', `# 町家\n${text.replace('KKS', 'KSK')}`);
  await page.evaluate(() => hsd.settled());
  assert.equal((await page.evaluate(() => hsd.find('KKS'))).length, 0);
  const now = await page.evaluate(() => hsd.selection);
  assert.equal(now?.code, 'TOD');
  assert.equal(now!.span![0], before!.span![0] + new TextEncoder().encode('# 町家\n').length);
  assert.ok((await page.evaluate(() => hsd.camera)).every((n, i) => Math.abs(n - camera[i]!) < 1e-9), 'the camera stays');
  assert.ok(await page.evaluate(() => hsd.app.renderer.section.cut.on && hsd.app.renderer.section.cut.at === 0.8 && hsd.app.renderer.section.caps > 0));
  assert.ok(await page.evaluate(() => hsd.app.model!.chunks.every(c => c.mesh.visible !== (hsd.app.layerOf(c) === 'roof 2'))));
  assert.equal((await page.locator('.source-line .selected').textContent())?.trim(), 'TOD');
  assert.ok(await page.evaluate(() => hsd.viewport.renderer.info.memory.textures) <= pictures + 3, 'textures are kept');
  assert.match(await page.locator('.live').textContent() ?? '', /reloaded, revision/);
  await does(page, 'reset').click();
});

test('repeated saves do not leak GPU resources', async () => {
  const held = () => page.evaluate(() => ({ ...hsd.viewport.renderer.info.memory, programs: hsd.viewport.renderer.info.programs!.length }));
  for (const change of ['\n', '\n\n']) await preview.save(page, 'machiya.hsd', text + change);
  await page.evaluate(() => hsd.settled());
  const first = await held();
  for (let i = 0; i < 6; i++) await preview.save(page, 'machiya.hsd', i % 2 ? `${text}\n` : text.replace('GSI  GSI', 'KSK  GSI'));
  await page.evaluate(() => hsd.settled());
  const last = await held();
  assert.ok(last.geometries <= first.geometries + 2 && last.textures <= first.textures + 2 && last.programs <= first.programs + 1,
    `${JSON.stringify(first)} became ${JSON.stringify(last)}`);
});

test('repeated saves of a model file do not leak GPU resources', async () => {
  const models = ['machiya.hsd', 'kura.hsd'].map(name => built(join(EXAMPLES, name)));
  preview.write('made.glb', models[0]!);
  const page = await preview.open('?file=made.glb');
  const held = () => page.evaluate(() => hsd.viewport.renderer.info.memory);
  await preview.save(page, 'made.glb', models[1]!);
  await preview.save(page, 'made.glb', models[0]!);
  await page.evaluate(() => hsd.settled());
  const first = await held();
  for (const model of [1, 0, 1, 0]) await preview.save(page, 'made.glb', models[model]!);
  await page.evaluate(() => hsd.settled());
  const last = await held();
  assert.ok(last.textures <= first.textures + 2 && last.geometries <= first.geometries + 2, `${JSON.stringify(first)} became ${JSON.stringify(last)}`);
  await page.close();
});

test('a damaged model is reported, and no other file stays in its place', async () => {
  preview.write('broken.glb', built(join(EXAMPLES, 'kura.hsd')).slice(0, 5000));
  const page = await preview.open('?file=machiya.hsd');
  await page.locator('.files button').filter({ hasText: 'broken' }).click();
  await page.locator('.messages .error').filter({ hasText: 'broken.glb cannot be read as a model: the file is truncated' }).waitFor();
  assert.match(await page.locator('.live').textContent() ?? '', /no model to show.* 1 error/);
  const { triangles, hit } = await page.evaluate(() => {
    const { clientWidth, clientHeight } = hsd.viewport.canvas;
    return { triangles: hsd.viewport.model!.triangles, hit: hsd.viewport.canvas.dispatchEvent(new MouseEvent('click', { clientX: clientWidth / 2, clientY: clientHeight / 2 })) };
  });
  assert.ok(hit && triangles === 0, `${triangles} triangles are shown`);
  assert.equal(await page.evaluate(() => hsd.selection), null);
  await page.close();
});

test('missing textures are reported, and the model is shown without them', async () => {
  buildTo(join(preview.folder, 'apart.glb'), join(EXAMPLES, 'kura.hsd'), '--textures-beside');
  const pictures = join(preview.folder, 'apart_textures'), lost = readdirSync(pictures)[0]!, kept = new Uint8Array(readFileSync(join(pictures, lost)));
  rmSync(join(pictures, lost));
  const page = await preview.open('?file=apart.glb'), message = page.locator('.messages .warning');
  assert.match(await message.textContent() ?? '', new RegExp(`HSD0605 .*${lost}.*the file does not exist`));
  await message.click(); // It has no location and causes no error.
  assert.ok(await page.evaluate(() => hsd.viewport.model!.triangles) > 100);
  assert.match(await page.locator('.live').textContent() ?? '', /reloaded.* 1 warning/);
  writeFileSync(join(pictures, lost), kept);
  await until(async () => await message.count() === 0, 'the texture is back');
  await page.close();
});

test('a low-resolution frame shows the same image', async () => {
  const whole = await brightness(page), frameTime = await page.evaluate(() => hsd.viewport.frameTime);
  await page.evaluate(() => { hsd.viewport.frameTime = 300; });
  const quick = await brightness(page, true);
  assert.ok(differ(whole, quick) > 0, 'the frame differs');
  assert.ok(differ(whole, quick, 0.1) < 0.1, `${differ(whole, quick, 0.1)} of the places differ`);
  assert.ok(Math.abs(mean(whole) - mean(quick)) < 0.01, `${mean(whole)} and ${mean(quick)}`);
  await until(() => page.evaluate(() => !hsd.viewport.coarse), 'a full frame is drawn');
  assert.equal(differ(whole, await brightness(page)), 0);
  await page.evaluate(frameTime => { hsd.viewport.frameTime = frameTime; }, frameTime);
});

test(`a save is painted within ${BAR} ms`, async t => {
  const took: number[] = [], inPage: number[] = [];
  for (let i = 0; i < 7; i++) {
    await page.waitForTimeout(700);
    took.push(await preview.save(page, 'machiya.hsd', text.replace('GSI  GSI', i % 2 ? 'KSK  GSI' : 'GSI  KSK')));
    inPage.push((await page.evaluate(() => hsd.reload))!.painted);
  }
  const median = (of: number[]) => [...of].sort((a, b) => a - b)[of.length >> 1]!;
  t.diagnostic(`median ${median(took)} ms from the save, ${median(inPage).toFixed(0)} ms from the event; all: ${took.join(' ')}`);
  assert.ok(median(took) <= BAR);
});

test('with errors that leave no house the last model stays, and messages link to their locations', async () => {
  await preview.save(page, 'machiya.hsd', text);
  await page.evaluate(() => hsd.settled());
  const seen = await brightness(page), parts = await page.evaluate(() => hsd.app.model!.parts.length);
  await preview.save(page, 'machiya.hsd', '<Houses><House name="x"/>\n<Haus/></Houses>\n');
  await until(async () => /last model stays/.test(await page.locator('.live').textContent() ?? ''), 'the message is shown');
  assert.equal(await page.evaluate(() => hsd.app.model!.parts.length), parts);
  assert.equal(differ(seen, await brightness(page)), 0);
  const messages = page.locator('.message');
  const diagnostics = await page.evaluate(() => hsd.app.state!.diagnostics);
  assert.equal(await messages.count(), diagnostics.length);
  const index = diagnostics.findIndex(d => d.severity === 'error' && d.line === 2);
  assert.ok(index >= 0);
  const row = await messages.nth(index).textContent() ?? '';
  assert.ok(row.includes('error') && row.includes(diagnostics[index]!.code) && row.includes('line 2') && row.includes(diagnostics[index]!.message), row);
  if (diagnostics[index]!.help) assert.ok(row.includes(diagnostics[index]!.help!));
  await messages.nth(index).click();
  assert.equal(await page.locator('.source-line:has(.spot)').getAttribute('data-line'), '2');
  assert.ok(await page.locator('.source-line .error').count() > 0, 'it is underlined');
  const [file, line, column] = await preview.sent();
  assert.deepEqual([file, line, column], ['machiya.hsd', 2, diagnostics[index]!.column]);
  await preview.save(page, 'machiya.hsd', text);
  await until(async () => await messages.count() === 0, 'the messages disappear');
});

test('a lost connection is reported and restored, with files saved in the meantime', async () => {
  const alert = page.locator('.lost');
  // The second time, its revisions have numbers that the page has seen before.
  for (const code of ['KSK', 'KTU']) {
    await preview.stop();
    await alert.waitFor({ state: 'visible' });
    assert.match(await alert.textContent() ?? '', /is not responding/);
    preview.write('machiya.hsd', text.replace('KKS', code).replace('GSI  GSI', `${code}  GSI`));
    await preview.serve();
    await until(() => alert.isHidden(), 'the connection is restored');
    await until(() => page.evaluate(code => hsd.find('KKS').length === 0 && hsd.app.state!.sources[0]!.text.includes(`${code}  GSI`), code), `${code} is shown`);
  }
});

test('no requests to other hosts, no errors', () => preview.assertClean());
