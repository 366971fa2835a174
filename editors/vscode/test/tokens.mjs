// The tokens that the grammar makes of a text, by the same engine that VS Code runs.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';

const load = createRequire(import.meta.url);
const oniguruma = load('vscode-oniguruma');
const { INITIAL, Registry, parseRawGrammar } = load('vscode-textmate');

export const root = fileURLToPath(new URL('..', import.meta.url));
const path = `${root}syntaxes/hsd.tmLanguage.json`;

/** The grammar, ready for `tokens`. */
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

/** Each line with its tokens: their text and their scopes, the outermost left out. */
export function tokens(grammar, text) {
  let stack = INITIAL;
  return text.replace(/^\uFEFF/, '').split(/\r\n|\r|\n/).map(line => {
    const { tokens, ruleStack } = grammar.tokenizeLine(line, stack);
    stack = ruleStack;
    return tokens.map(t => ({ text: line.slice(t.startIndex, t.endIndex), scopes: t.scopes.slice(1) }));
  });
}
