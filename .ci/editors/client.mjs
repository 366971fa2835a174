// node client.mjs HSD
// A client of the language server, once for each encoding of
// positions: it opens the examples, sees a mistake at its place, mends it by a code action, completes a part, hovers, formats and
// renames. Exit 1 if anything is not as it should be.
import assert from 'node:assert/strict';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { Session, edits_of } from './session.mjs';
import { broken, examples, laid_out, read } from './texts.mjs';

const [hsd] = process.argv.slice(2);
if (!hsd) throw new Error('usage: node client.mjs HSD');
const root = join(dirname(fileURLToPath(import.meta.url)), '../..');
const work = mkdtempSync(join(tmpdir(), 'hsd-client-'));
process.on('exit', () => rmSync(work, { recursive: true, force: true }));

async function clean_examples(session) {
  for (const path of examples(root)) {
    const file = await session.open(path);
    assert.deepEqual(await session.diagnostics(file), [], `${path} is right`);
    await session.tell('textDocument/didClose', { textDocument: { uri: file.uri } });
  }
}

/** Sees the mistake of a broken text at its place, and mends it. */
async function mends(session, mistake) {
  const file = await session.open(join(work, mistake.name), mistake.text);
  const said = await session.diagnostics(file);
  assert.deepEqual(said.map(d => d.code), [mistake.code]);
  const [diagnostic] = said;
  assert.equal(diagnostic.range.start.line, mistake.line);
  assert.equal(file.covered(diagnostic.range), mistake.word);
  const actions = await session.ask('textDocument/codeAction', {
    textDocument: { uri: file.uri },
    range: diagnostic.range,
    context: { diagnostics: said, only: ['quickfix'] },
  });
  let action = actions.find(a => a.kind?.startsWith('quickfix'));
  assert(action, 'a quick fix is offered');
  if (!action.edit) action = await session.ask('codeAction/resolve', action);
  const mended = file.edited(edits_of(action.edit, file));
  assert.equal(mended, mistake.text.replace(mistake.word, mistake.mend));
  for (const edit of edits_of(action.edit, file)) await session.change(file, edit.range, edit.newText);
  assert.equal(file.text, mended);
  assert.deepEqual(await session.diagnostics(file), []);
  return file;
}

async function answers(session, file) {
  const before = '    <Row>KKS  TK';
  const [line, whole] = [3, file.text];
  const at = file.position(line, before);
  const here = { textDocument: { uri: file.uri }, position: at };

  const hover = JSON.stringify(await session.ask('textDocument/hover', here));
  assert(hover.includes('格子'), `the card of TKD has its name: ${hover}`);

  // Somebody takes the code out and begins it anew.
  const code = { start: file.position(line, '    <Row>KKS  '), end: file.position(line, '    <Row>KKS  TKD 2') };
  await session.change(file, code, 'TK');
  const list = await session.ask('textDocument/completion', here);
  const items = Array.isArray(list) ? list : list.items;
  const item = items.find(i => (i.textEdit?.newText ?? i.insertText ?? i.label).trimEnd() === 'TKD 2');
  assert(item?.textEdit, `TKD 2 is proposed with its place: ${items.slice(0, 5).map(i => i.label)}`);
  const range = item.textEdit.range ?? item.textEdit.insert;
  await session.change(file, range, item.textEdit.newText);
  assert.equal(file.text, whole);
  assert.deepEqual(await session.diagnostics(file), []);

  const untidy = file.text.replace('    <Row>KSK  MRE', '  <Row>KSK  MRE');
  await session.replace(file, untidy);
  const layout = { textDocument: { uri: file.uri }, options: { tabSize: 2, insertSpaces: true } };
  const edits = await session.ask('textDocument/formatting', layout);
  assert.equal(file.edited(edits ?? []), laid_out(hsd, untidy));
}

async function renames(session) {
  const path = join(root, 'examples/param-machiya.hsd');
  const file = await session.open(path);
  assert.deepEqual(await session.diagnostics(file), []);
  const lines = file.text.split('\n');
  const line = lines.findIndex(l => l.includes('"{frontage}"'));
  const before = lines[line].slice(0, lines[line].indexOf('frontage}'));
  const edit = await session.ask('textDocument/rename', {
    textDocument: { uri: file.uri }, position: file.position(line, before), newName: '間口',
  });
  const renamed = file.edited(edits_of(edit, file));
  // The comment at the top speaks of it too, and is no name.
  const [comment, house] = file.text.split(/(?<=-->\n)(?=<House)/);
  assert.equal(renamed, comment + house.replaceAll(/\bfrontage\b/g, '間口'));
  await session.replace(file, renamed);
  assert.deepEqual(await session.diagnostics(file), []);
}

for (const encoding of ['utf-8', 'utf-16', undefined]) {
  const session = new Session(hsd);
  await session.start(encoding);
  await clean_examples(session);
  const files = [];
  for (const mistake of broken) files.push(await mends(session, mistake));
  await answers(session, files.at(-1));
  await renames(session);
  await session.stop();
  console.log(`protocol client, ${encoding ?? 'no'} encoding asked for: well`);
}
