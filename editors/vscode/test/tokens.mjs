// Tokenises a source file with the grammar and the engine of VS Code.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';

const load = createRequire(import.meta.url);
const oniguruma = load('vscode-oniguruma');
const { INITIAL, Registry, parseRawGrammar } = load('vscode-textmate');

export const root = fileURLToPath(new URL('..', import.meta.url));
const path = `${root}syntaxes/hsd.tmLanguage.json`;

/** Loads the grammar. */
export async function grammar() {
  await oniguruma.loadWASM(readFileSync(load.resolve('vscode-oniguruma/release/onig.wasm')).buffer);
  const registry = new Registry({
    onigLib: Promise.resolve({
      createOnigScanner: patterns => new oniguruma.OnigScanner(patterns),
      createOnigString: text => new oniguruma.OnigString(text),
    }),
    loadGrammar: async () => parseRawGrammar(readFileSync(path, 'utf8'), path),
  });
  return registry.loadGrammar('source.hsd');
}

/** The tokens of each line: text and scopes, without the outermost scope. */
export function tokens(grammar, text) {
  let stack = INITIAL;
  return text.replace(/^\uFEFF/, '').split(/\r\n|\r|\n/).map(line => {
    const { tokens, ruleStack } = grammar.tokenizeLine(line, stack);
    stack = ruleStack;
    return tokens.map(t => ({ text: line.slice(t.startIndex, t.endIndex), scopes: t.scopes.slice(1) }));
  });
}
