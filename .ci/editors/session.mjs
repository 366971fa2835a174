// A minimal client of the language server, on vscode-languageserver-protocol: open files, and one run of a server.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { pathToFileURL } from 'node:url';
import { load } from '../modules.mjs';
import { read } from './texts.mjs';

const { createProtocolConnection, StreamMessageReader, StreamMessageWriter } = load('vscode-languageserver-protocol/node');

/** Length of a text in the units of an encoding. */
const width = {
  'utf-8': text => Buffer.byteLength(text),
  'utf-16': text => text.length,
  'utf-32': text => [...text].length,
};

/** An open file: text, version and positions. */
export class File {
  constructor(path, text, encoding) {
    Object.assign(this, { uri: pathToFileURL(path).href, text, encoding, version: 1 });
  }

  /** The position after `before` in a line. */
  position(line, before) {
    return { line, character: width[this.encoding](before) };
  }

  /** The offset of a position in the text. */
  offset({ line, character }) {
    const lines = this.text.split('\n');
    const start = lines.slice(0, line).reduce((sum, l) => sum + l.length + 1, 0);
    let [taken, at] = [0, 0];
    for (const sign of lines[line] ?? '') {
      if (taken >= character) break;
      taken += width[this.encoding](sign);
      at += sign.length;
    }
    assert.equal(taken, character, `a position lies inside a character or after the end of line ${line + 1}`);
    return start + at;
  }

  /** The text of a range. */
  covered({ start, end }) {
    return this.text.slice(this.offset(start), this.offset(end));
  }

  /** The text after applying edits, which must not overlap. */
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
export class Session {
  constructor(hsd) {
    this.process = spawn(hsd, ['lsp'], { stdio: ['pipe', 'pipe', 'inherit'] });
    this.ended = new Promise(done => this.process.once('exit', (code, signal) => done(signal ?? code)));
    this.connection = createProtocolConnection(
      new StreamMessageReader(this.process.stdout), new StreamMessageWriter(this.process.stdin));
    this.published = new Map();
    this.waiting = [];
    this.connection.onNotification('textDocument/publishDiagnostics', params => {
      this.published.set(params.uri, params);
      this.waiting = this.waiting.filter(test => !test());
    });
    // Handlers of the server's requests, by method.
    this.handlers = { 'workspace/configuration': params => params.items.map(() => null) };
    this.connection.onRequest((method, params) => this.handlers[method]?.(params) ?? null);
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
        workspace: { workspaceEdit: { documentChanges: true }, applyEdit: true },
        window: { showDocument: { support: true } },
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

  /** Replaces a range, as an editor does during typing. */
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

  /** The diagnostics of the current version of a file. */
  diagnostics(file) {
    const now = () => {
      const last = this.published.get(file.uri);
      return last && (last.version ?? file.version) === file.version ? last.diagnostics : undefined;
    };
    return new Promise((done, fail) => {
      if (now()) return done(now());
      const timer = setTimeout(fail, 20_000, new Error(`no diagnostics for ${file.uri} version ${file.version}`));
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
    assert.equal(await this.ended, 0, 'the server exits with 0');
  }
}

/** The edits of a workspace edit to one file. */
export function editsOf(edit, file) {
  const changes = edit.documentChanges?.map(c => [c.textDocument.uri, c.edits]) ?? Object.entries(edit.changes ?? {});
  return changes.filter(([uri]) => uri === file.uri).flatMap(([, edits]) => edits);
}
