// The parameters of a file: sliders, lists and ticks that build the house or the town anew, in Chromium with the real server.

import assert from 'node:assert/strict';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import type { Page } from 'playwright-core';
import { AXE, violations } from './axe.ts';
import { EXAMPLES, Preview, until } from './preview.ts';

const HOUSE = `<House>
  <Param name="bays" default="4" min="2" max="9" step="1" unit="bays" doc="width of the front" doc-ja="間口"/>
  <Param name="wall" default="KSK" choices="KSK, KTI"/>
  <Param name="wide" default="no"/>
  <Storey>
    <Row><repeat num="{bays}"><Part code="{wall}"/></repeat></Row>
    <Row><repeat num="{if(wide, 6, 3)}"><Part code="KSK"/></repeat></Row>
    <Row><repeat num="{bays}"><Part code="KSK"/></repeat></Row>
    <Row><repeat num="{if(wide, 6, 3)}"><Part code="KSK"/></repeat></Row>
  </Storey>
</House>
`;

let preview: Preview, page: Page;

before(async () => {
  const towns = join(EXAMPLES, 'towns');
  preview = await Preview.of([['house.hsd', HOUSE], ['plain.hsd', '<House><Storey><Row>KSK  KSK</Row><Row>KSK  </Row><Row>KSK  KSK</Row><Row>KSK  </Row></Storey></House>'],
    ...['kyoto.hsd', 'kyoto-shares.csv', 'block-houses.geojson', 'block-roads.geojson'].map(name => join(towns, name))]);
  preview.script = AXE;
  page = await preview.open('?file=house.hsd');
});
after(async () => { await preview?.close(); });

const parts = (code: string) => page.evaluate(code => hsd.find(code).length, code);
const control = (name: string) => page.locator(`[data-parameter="${name}"]`).locator('input, select');

test('each parameter has the control of its kind, with name and description', async () => {
  assert.equal(await control('bays').getAttribute('type'), 'range');
  assert.equal(await control('bays').inputValue(), '4');
  assert.equal(await page.getByLabel('bays (bays)').count(), 1);
  assert.equal(await page.locator('[data-parameter="bays"] p').textContent(), 'width of the front');
  assert.deepEqual(await control('wall').locator('option').allTextContents(), ['KSK', 'KTI']);
  assert.equal(await control('wide').isChecked(), false);
  assert.deepEqual(await violations(page), []);
});

test('a slider, a list and a tick build the house anew, and the usual values come back', async () => {
  const all = await parts('KSK');
  await control('bays').fill('7');
  await until(async () => await parts('KSK') === all + 6, 'three bays more on both long sides');
  await control('wall').selectOption('KTI');
  await until(async () => await parts('KTI') === 7, 'the front is of clay');
  await control('wide').check();
  await until(async () => await parts('KSK') === 7 + 12, 'the short sides are twice as long');
  assert.equal(await page.locator('[data-parameter="bays"] output').textContent(), '7');
  await page.getByRole('button', { name: 'Usual values' }).click();
  await until(async () => await parts('KSK') === all && await parts('KTI') === 0, 'all is as written');
  assert.equal(await control('bays').inputValue(), '4');
  assert.equal(await control('wide').isChecked(), false);
});

test('what is set outlives a change of the text, unless its parameter goes', async () => {
  await control('bays').fill('6');
  await until(async () => await parts('KSK') === 18, 'six bays');
  await preview.save(page, 'house.hsd', HOUSE.replaceAll('3)}', '4)}'));
  await until(async () => await parts('KSK') === 20, 'still six bays');
  await preview.save(page, 'house.hsd', HOUSE.replace(/ {2}<Param name="bays".*\n/, '').replaceAll('{bays}', '3'));
  await until(async () => await parts('KSK') === 12, 'its parameter is gone');
  assert.equal(await control('bays').count(), 0);
  assert.equal(await page.evaluate(() => hsd.app.state!.diagnostics.length), 0);
  await page.evaluate(() => hsd.app.openFile('plain.hsd'));
  await until(() => page.evaluate(() => hsd.app.state?.file === 'plain.hsd'), 'a file without parameters');
  await until(async () => !await page.locator('[data-fold="parameters"]').isVisible(), 'no panel');
});

test('the year of a town is a slider, and the town is built at that date', async () => {
  await page.evaluate(() => hsd.app.openFile('kyoto.hsd'));
  const kind = (key: string) => page.evaluate(async key => {
    const { id } = hsd.app.state!.town!;
    const answer = await fetch(`/api/town/${id}/feature?layer=houses&key=${key}`);
    return (await answer.json() as { type: string } | null)?.type;
  }, key);
  await until(async () => await page.evaluate(() => hsd.app.state?.town?.built === 19) && await kind('n1') === 'chu-nikai', 'the block of 1928', 120_000);
  assert.equal(await control('year').getAttribute('min'), '1868');
  await control('year').fill('1998');
  await until(async () => await kind('n1') === 'kanban', 'a new front', 120_000);
  assert.equal(await kind('n2'), 'so-nikai');
  preview.assertClean();
});
