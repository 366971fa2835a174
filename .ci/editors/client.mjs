// node client.mjs HSD
// A client of the language server that does nothing but the protocol (vscode-languageserver-protocol), once for each encoding of
// positions: it opens the examples, sees a mistake at its place, mends it by a code action, completes a part, hovers, formats and
// renames. Exit 1 if anything is not as it should be.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { load } from '../modules.mjs';
import { broken, examples, laid_out, read } from './texts.mjs';

const { createProtocolConnection, StreamMessageReader, StreamMessageWriter } = load('vscode-languageserver-protocol/node');
const [hsd] = process.argv.slice(2);
if (!hsd) throw new Error('usage: node client.mjs HSD');
const root = join(dirname(fileURLToPath(import.meta.url)), '../..');
const work = mkdtempSync(join(tmpdir(), 'hsd-client-'));
process.on('exit', () => rmSync(work, { recursive: true, force: true }));

/** How many units of an encoding a text takes. */
const width = {
  'utf-8': text => Buffer.byteLength(text),
  'utf-16': text => text.length,
  'utf-32': text => [...text].length,
};

/** A file as a client holds it: its text, its version, and places in it. */
class File {
  constructor(path, text, encoding) {
    Object.assign(this, { uri: pathToFileURL(path).href, text, encoding, version: 1 });
  }

  /** The position of a byte-exact place: behind `before` in line `line`. */
  position(line, before) {
    return { line, character: width[this.encoding](before) };
  }

  /** The offset in the text of a position. */
  offset({ line, character }) {
    const lines = this.text.split('\n');
    const start = lines.slice(0, line).reduce((sum, l) => sum + l.length + 1, 0);
    let [taken, at] = [0, 0];
    for (const sign of lines[line] ?? '') {
      if (taken >= character) break;
      taken += width[this.encoding](sign);
      at += sign.length;
    }
    assert.equal(taken, character, `a position stands within a character or behind line ${line + 1}`);
    return start + at;
  }

  /** What a range covers. */
  covered({ start, end }) {
    return this.text.slice(this.offset(start), this.offset(end));
  }

  /** The text with edits done, none of which may overlap. */
  edited(edits) {
    const places = edits.map(e => [this.offset(e.range.start), this.offset(e.range.end), e.newText]);
    places.sort((a, b) => b[0] - a[0] || b[1] - a[1]);
    let text = this.text;
    let last = text.length;
    for (const [start, end, put] of places) {
      assert(start <= end && end <= last, 'edits overlap');
      text = text.slice(0, start) + put + text.slice(end);
      last = start;
    }
    return text;
  }
}

/** One run of the server. */
class Session {
  constructor() {
    this.process = spawn(hsd, ['lsp'], { stdio: ['pipe', 'pipe', 'inherit'] });
    this.ended = new Promise(done => this.process.once('exit', (code, signal) => done(signal ?? code)));
    this.connection = createProtocolConnection(
      new StreamMessageReader(this.process.stdout), new StreamMessageWriter(this.process.stdin));
    this.published = new Map();
    this.waiting = [];
    this.connection.onNotification('textDocument/publishDiagnostics', said => {
      this.published.set(said.uri, said);
      this.waiting = this.waiting.filter(test => !test());
    });
    // What servers ask of clients.
    this.connection.onRequest((method, params) =>
      method === 'workspace/configuration' ? params.items.map(() => null) : null);
    this.connection.listen();
  }

  ask(method, params) {
    const late = new Promise((_, fail) => setTimeout(fail, 20_000, new Error(`no answer to ${method}`)).unref());
    return Promise.race([this.connection.sendRequest(method, params), late]);
  }

  tell(method, params) {
    return this.connection.sendNotification(method, params);
  }

  async start(encoding) {
    const { capabilities } = await this.ask('initialize', {
      processId: process.pid,
      rootUri: null,
      workspaceFolders: null,
      capabilities: {
        general: encoding ? { positionEncodings: [encoding, 'utf-16'] } : {},
        textDocument: {
          publishDiagnostics: { relatedInformation: true, versionSupport: true },
          codeAction: { codeActionLiteralSupport: { codeActionKind: { valueSet: ['quickfix'] } } },
          hover: { contentFormat: ['markdown', 'plaintext'] },
          completion: { completionItem: { documentationFormat: ['markdown'] } },
          rename: { prepareSupport: true },
        },
        workspace: { workspaceEdit: { documentChanges: true } },
      },
    });
    await this.tell('initialized', {});
    assert.equal(capabilities.positionEncoding ?? 'utf-16', encoding ?? 'utf-16');
    this.encoding = encoding ?? 'utf-16';
  }

  async open(path, text = read(path)) {
    const file = new File(path, text, this.encoding);
    this.published.delete(file.uri);
    await this.tell('textDocument/didOpen', {
      textDocument: { uri: file.uri, languageId: 'hsd', version: file.version, text },
    });
    return file;
  }

  /** Replaces a range, as an editor does while somebody types. */
  async change(file, range, text) {
    const next = file.edited([{ range, newText: text }]);
    file.version += 1;
    await this.tell('textDocument/didChange', {
      textDocument: { uri: file.uri, version: file.version },
      contentChanges: [{ range, text }],
    });
    file.text = next;
  }

  /** Replaces the whole text by one incremental change. */
  replace(file, text) {
    const lines = file.text.split('\n');
    const end = file.position(lines.length - 1, lines.at(-1));
    return this.change(file, { start: { line: 0, character: 0 }, end }, text);
  }

  /** What is said of a file's last version. */
  diagnostics(file) {
    const now = () => {
      const said = this.published.get(file.uri);
      return said && (said.version ?? file.version) === file.version ? said.diagnostics : undefined;
    };
    return new Promise((done, fail) => {
      if (now()) return done(now());
      const timer = setTimeout(fail, 20_000, new Error(`nothing is said of ${file.uri} version ${file.version}`));
      this.waiting.push(() => {
        if (!now()) return false;
        clearTimeout(timer);
        done(now());
        return true;
      });
    });
  }

  async stop() {
    await this.ask('shutdown');
    await this.tell('exit');
    assert.equal(await this.ended, 0, 'the server ends well');
  }
}

/** The edits of a workspace edit that concern a file. */
function edits_of(edit, file) {
  const changes = edit.documentChanges?.map(c => [c.textDocument.uri, c.edits]) ?? Object.entries(edit.changes ?? {});
  return changes.filter(([uri]) => uri === file.uri).flatMap(([, edits]) => edits);
}

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
  const session = new Session();
  await session.start(encoding);
  await clean_examples(session);
  const files = [];
  for (const mistake of broken) files.push(await mends(session, mistake));
  await answers(session, files.at(-1));
  await renames(session);
  await session.stop();
  console.log(`protocol client, ${encoding ?? 'no'} encoding asked for: well`);
}
