// node client.mjs HSD
// Tests the language server with a client, once for each position encoding: opens the examples, finds an error at its position, fixes
// it with a code action, completes a part, hovers, formats and renames. Exits with 1 on failure.
import assert from 'node:assert/strict';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { Session, editsOf } from './session.mjs';
import { broken, examples, laidOut, read } from './texts.mjs';

const [hsd] = process.argv.slice(2);
if (!hsd) throw new Error('usage: node client.mjs HSD');
const root = join(dirname(fileURLToPath(import.meta.url)), '../..');
const work = mkdtempSync(join(tmpdir(), 'hsd-client-'));
process.on('exit', () => rmSync(work, { recursive: true, force: true }));

async function cleanExamples(session) {
  for (const path of examples(root)) {
    const file = await session.open(path);
    assert.deepEqual(await session.diagnostics(file), [], `${path} has no diagnostics`);
    await session.tell('textDocument/didClose', { textDocument: { uri: file.uri } });
  }
}

/** Checks the position of the error in a broken file and applies its fix. */
async function fixes(session, mistake) {
  const file = await session.open(join(work, mistake.name), mistake.text);
  const diagnostics = await session.diagnostics(file);
  assert.deepEqual(diagnostics.map(d => d.code), [mistake.code]);
  const [diagnostic] = diagnostics;
  assert.equal(diagnostic.range.start.line, mistake.line);
  assert.equal(file.covered(diagnostic.range), mistake.word);
  const actions = await session.ask('textDocument/codeAction', {
    textDocument: { uri: file.uri },
    range: diagnostic.range,
    context: { diagnostics, only: ['quickfix'] },
  });
  let action = actions.find(a => a.kind?.startsWith('quickfix'));
  assert(action, 'a quick fix is offered');
  if (!action.edit) action = await session.ask('codeAction/resolve', action);
  const fixed = file.edited(editsOf(action.edit, file));
  assert.equal(fixed, mistake.text.replace(mistake.word, mistake.fix));
  for (const edit of editsOf(action.edit, file)) await session.change(file, edit.range, edit.newText);
  assert.equal(file.text, fixed);
  assert.deepEqual(await session.diagnostics(file), []);
  return file;
}

async function answers(session, file) {
  const before = '    <Row>KKS  TK';
  const [line, whole] = [3, file.text];
  const at = file.position(line, before);
  const here = { textDocument: { uri: file.uri }, position: at };

  const hover = JSON.stringify(await session.ask('textDocument/hover', here));
  assert(hover.includes('格子'), `the hover of TKD contains its name: ${hover}`);

  // Replaces a code by the beginning of it, as if it were being typed.
  const code = { start: file.position(line, '    <Row>KKS  '), end: file.position(line, '    <Row>KKS  TKD 2') };
  await session.change(file, code, 'TK');
  const list = await session.ask('textDocument/completion', here);
  const items = Array.isArray(list) ? list : list.items;
  const item = items.find(i => (i.textEdit?.newText ?? i.insertText ?? i.label).trimEnd() === 'TKD 2');
  assert(item?.textEdit, `TKD 2 is offered with a range: ${items.slice(0, 5).map(i => i.label)}`);
  const range = item.textEdit.range ?? item.textEdit.insert;
  await session.change(file, range, item.textEdit.newText);
  assert.equal(file.text, whole);
  assert.deepEqual(await session.diagnostics(file), []);

  const untidy = file.text.replace('    <Row>KSK  MRE', '  <Row>KSK  MRE');
  await session.replace(file, untidy);
  const layout = { textDocument: { uri: file.uri }, options: { tabSize: 2, insertSpaces: true } };
  const edits = await session.ask('textDocument/formatting', layout);
  assert.equal(file.edited(edits ?? []), laidOut(hsd, untidy));
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
  const renamed = file.edited(editsOf(edit, file));
  // The comment at the top contains the word too, but is not renamed.
  const [comment, house] = file.text.split(/(?<=-->\n)(?=<House)/);
  assert.equal(renamed, comment + house.replaceAll(/\bfrontage\b/g, '間口'));
  await session.replace(file, renamed);
  assert.deepEqual(await session.diagnostics(file), []);
}

for (const encoding of ['utf-8', 'utf-16', undefined]) {
  const session = new Session(hsd);
  await session.start(encoding);
  await cleanExamples(session);
  const files = [];
  for (const mistake of broken) files.push(await fixes(session, mistake));
  await answers(session, files.at(-1));
  await renames(session);
  await session.stop();
  console.log(`protocol client, ${encoding ?? 'no'} encoding requested: passed`);
}
