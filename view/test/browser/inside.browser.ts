// A walker gets from the street to every room by the doors that open, up the stairs, and nowhere through a wall.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import type { Page } from 'playwright-core';
import { explore } from './explorer.ts';
import { Preview } from './preview.ts';

/** A room behind two pairs of fusuma side by side. */
const PAIRS = `<House name="pairs">
  <Storey height="9">
    <Row>TKD 2KTU  KTU  KTU  </Row>
    <Row><repeat num="6"><Part code="KTU"/></repeat></Row>
    <Row><repeat num="5"><Part code="KTU"/></repeat></Row>
    <Row><repeat num="6"><Part code="KTU"/></repeat></Row>
    <Loop inner="yes" start="0 3"><Row>KTU  TFU 2TFU 2</Row></Loop>
    <Room name="a" at="2 1"/>
    <Room name="b" at="2 5"/>
  </Storey>
  <Roofs kind="K" shape="KIR"/>
</House>
`;

let preview: Preview;

before(async () => { preview = await Preview.of(['rooms.hsd', 'tsushi.hsd', ['pairs.hsd', PAIRS], ['mirrored.hsd', PAIRS.replace('KTU  TFU 2TFU 2', 'TFU 2TFU 2KTU  ')]]); });
after(async () => { await preview?.close(); });

for (const file of ['rooms.hsd', 'tsushi.hsd']) {
  let page: Page;
  test(`${file}: shut doors keep a walker out of the rooms`, async () => {
    page = await preview.open(`?file=${file}`);
    const { rooms, through, stands } = await explore(page, false);
    assert.deepEqual(through, []);
    // The bay beside the great door stands open.
    assert.deepEqual([...rooms].map(room => room.split(' at ')[0]), ['1: 通り庭']);
    assert.ok(stands.length > 100, `${stands.length} places outside`);
  });

  test(`${file}: a walker who opens doors gets to every room, and never through a wall`, async () => {
    const { missed, opened, through, afloat } = await explore(page, true);
    assert.deepEqual(through, []);
    assert.deepEqual(afloat, [], 'the way up is by stairs alone');
    assert.deepEqual(missed, []);
    assert.ok(opened.length >= 8, `${opened}`);
    await page.context().close();
  });
}

for (const file of ['pairs.hsd', 'mirrored.hsd']) test(`${file}: pairs of doors side by side do not shut each other`, async () => {
  const page = await preview.open(`?file=${file}`), { missed, opened, through } = await explore(page, true);
  assert.deepEqual([missed, through], [[], []]);
  assert.deepEqual(opened.filter(code => code === 'TFU 2').length, 2);
  await page.context().close();
});

test('no requests to other hosts, no errors', () => preview.assertClean());
