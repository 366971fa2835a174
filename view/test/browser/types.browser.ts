// In every type of house that has rooms, a walker gets from the street to each of them, and nowhere through a wall.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { explore } from './explorer.ts';
import { Preview } from './preview.ts';
import { temporaryFolder } from './temporary.ts';

/** What differs most: low storeys, shutters of today. The others take minutes. */
const ALWAYS = ['chu-nikai', 'kanban'], THOROUGH = ['buke-nagaya', 'so-nikai', 'sangai', 'hiraya', 'shimotaya', 'hei-tsuki', 'kura', 'ura-nagaya'];
const TYPES = process.env['HSD_THOROUGH'] ? [...ALWAYS, ...THOROUGH] : ALWAYS;
if (TYPES === ALWAYS) console.log(`left out: ${THOROUGH.join(', ')} (HSD_THOROUGH=1 explores them too)`);

/** The text of a new house of a type, with rooms. */
function withRooms(type: string): string {
  const file = join(temporaryFolder(), `${type}.hsd`);
  execFileSync(process.env['HSD']!, ['new', type, '-o', file], { stdio: 'ignore' });
  const text = readFileSync(file, 'utf8'), rooms = text.replace(/(<Param name="rooms" default=)"no"/, '$1"yes"');
  assert.notEqual(rooms, text, `${type} has rooms`);
  return rooms;
}

let preview: Preview;

before(async () => { preview = await Preview.of(TYPES.map(type => [`${type}.hsd`, withRooms(type)] as [string, string])); });
after(async () => { await preview?.close(); });

for (const type of TYPES) {
  test(`${type}: a walker who opens doors gets to every room, and never through a wall`, async () => {
    const page = await preview.open(`?file=${type}.hsd`), { rooms, missed, opened, through, afloat } = await explore(page, true);
    assert.deepEqual(through, []);
    assert.deepEqual(afloat, [], 'the way up is by stairs alone');
    assert.deepEqual(missed, []);
    assert.ok(rooms.size >= 2, [...rooms].join());
    if (type === 'kanban') assert.ok(opened.includes('NSH 2'), `in by the shutters: ${opened}`);
    await page.context().close();
  });
}

test('no requests to other hosts, no errors', () => preview.assertClean());
