// node preview.mjs HSD
// Tests the live preview with an editor: the language server shows unsaved changes, follows every keystroke, opens clicked parts in
// the editor, edits the document through it, and sends the cursor position to the page. Exits with 1 on failure.
import assert from 'node:assert/strict';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { Session } from './session.mjs';

const [hsd] = process.argv.slice(2);
if (!hsd) throw new Error('usage: node preview.mjs HSD');
const work = mkdtempSync(join(tmpdir(), 'hsd-preview-'));
process.on('exit', () => rmSync(work, { recursive: true, force: true }));

const HOUSE = '# 町家\n0 0 180\n9.5\n\nKKS  TKD 2MRE\nKSK  MRE  KSK\nKKS  TIT 2KKS\nKSK  KSK  KSK\n';
const path = join(work, '家.hsd');
writeFileSync(path, HOUSE.replace('MRE', 'MHI'));

/** The server-sent events of a file. */
async function* events(url, file) {
  const { body } = await fetch(new URL(`/api/events?file=${encodeURIComponent(file)}`, url));
  let text = '';
  for await (const bytes of body.pipeThrough(new TextDecoderStream())) {
    text += bytes;
    for (let end; (end = text.indexOf('\n\n')) >= 0; text = text.slice(end + 2)) {
      const [, name, data] = /^event: (.*)\ndata: (.*)$/m.exec(text.slice(0, end)) ?? [];
      if (name) yield { name, data: JSON.parse(data) };
    }
  }
}

const late = (what, promise) => Promise.race([
  promise, new Promise((_, fail) => setTimeout(fail, 20_000, new Error(`timeout: ${what}`)).unref()),
]);

const session = new Session(hsd);
await session.start('utf-16');
const shown = [];
session.handlers['window/showDocument'] = params => { shown.push(params); return { success: true }; };

// Unsaved changes are shown.
const file = await session.open(path, HOUSE);
const page = await session.ask('workspace/executeCommand', { command: 'hsd.view', arguments: [file.uri, true] });
assert.match(page, /^http:\/\/127\.0\.0\.1:\d+\/\?file=%E5%AE%B6\.hsd$/);
await late('the page is opened', (async () => { while (shown.length === 0) await new Promise(r => setTimeout(r, 10)); })());
assert.deepEqual(shown.pop(), { uri: page, external: true });
const state = async () => (await fetch(new URL('/api/state?file=%E5%AE%B6.hsd', page))).json();
const first = await state();
assert.equal(first.sources[0].text, HOUSE);
assert.equal((await fetch(page)).status, 200, 'the page is served');

const heard = events(page, '家.hsd');
const next = async name => {
  for (;;) {
    const { value } = await late(`an event ${name}`, heard.next());
    if (value.name === name) return value.data;
  }
};
assert.equal((await next('state')).revision, first.revision);

// Every keystroke is followed.
const begun = performance.now();
await session.change(file, { start: file.position(4, 'KKS  '), end: file.position(4, 'KKS  TKD 2') }, 'TIT 2');
const { revision } = await next('state');
const took = performance.now() - begun;
assert(revision > first.revision);
const second = await state();
const unit = second.plan.houses[0].storeys[0].rings[0].walls[0].units[1];
assert.equal(unit.code, 'TIT 2');

// A click in the page opens the location in the editor.
const post = async (what, body) => {
  const headers = { 'content-type': 'application/json', origin: new URL(page).origin };
  const answer = await fetch(new URL(`/api/${what}`, page), { method: 'POST', headers, body: JSON.stringify({ file: '家.hsd', ...body }) });
  assert.equal(answer.status, 200, await answer.clone().text());
  return answer.json();
};
await post('open', { id: unit.file, span: unit.span });
await late('the editor is opened at the location', (async () => { while (shown.length === 0) await new Promise(r => setTimeout(r, 10)); })());
const [{ uri, selection }] = shown.splice(0);
assert.equal(uri, file.uri);
assert.equal(file.covered(selection), 'TIT 2');

// The part at the cursor is highlighted.
await session.tell('hsd/cursor', { textDocument: { uri: file.uri }, position: file.position(4, 'KKS  T') });
const { id, span: [at] } = await next('cursor');
assert.equal(id, 0);
assert(unit.span[0] <= at && at < unit.span[1], `${at} lies in ${unit.span}`);

// An edit is applied by the editor, which can undo it.
session.handlers['workspace/applyEdit'] = async ({ edit }) => {
  const edits = Object.entries(edit.changes).flatMap(([of, list]) => (of === file.uri ? list : []));
  assert.equal(edits.length, 1);
  await session.change(file, edits[0].range, edits[0].newText);
  return { applied: true };
};
const stroke = { do: 'set-part', house: 0, storey: 0, ring: 0, wall: 0, unit: 2, part: 'MGA' };
const drawn = await post('stroke', { revision, stroke });
assert(drawn.revision > revision, JSON.stringify(drawn));
assert.equal(file.text, HOUSE.replace('TKD 2MRE', 'TIT 2MGA'));
await post('undo', {});
assert.equal(file.text, HOUSE.replace('TKD 2', 'TIT 2'));
await session.stop();
console.log(`preview with an editor: passed; from a keystroke to the page's event in ${took.toFixed(0)} ms`);
process.exit(0);
