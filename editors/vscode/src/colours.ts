// Which colours come from the program. The grammar of the extension knows the form of a text at once, with neighbouring codes in
// two colours; the program knows what words mean. So only that is taken from it which no grammar can tell: that nobody knows
// a part, and what a name in an expression is.
import { type SemanticTokens, type SemanticTokensLegend } from 'vscode';

const KINDS = new Set(['parameter', 'variable', 'function']);
// One's own parts too keep the two colours: without them neighbours could not be told apart.
const MODIFIERS = ['unknown'];
/** Numbers that one token takes: lines and columns from the token before, length, kind, modifiers. */
const STEP = 5;

/** Leaves out what the grammar colours as well or better. */
export function told(tokens: SemanticTokens, legend: SemanticTokensLegend): Uint32Array {
  const worth = new Set(legend.tokenTypes.flatMap((kind, number) => (KINDS.has(kind) ? [number] : [])));
  const marks = legend.tokenModifiers.reduce((bits, name, bit) => (MODIFIERS.includes(name) ? bits | (1 << bit) : bits), 0);
  const kept: number[] = [];
  let [line, column, lastLine, lastColumn] = [0, 0, 0, 0];
  for (let at = 0; at + STEP <= tokens.data.length; at += STEP) {
    const [down = 0, along = 0, length = 0, kind = 0, modifiers = 0] = tokens.data.subarray(at, at + STEP);
    column = down > 0 ? along : column + along;
    line += down;
    if (!worth.has(kind) && !(modifiers & marks)) continue;
    kept.push(line - lastLine, line > lastLine ? column : column - lastColumn, length, kind, modifiers);
    [lastLine, lastColumn] = [line, column];
  }
  return Uint32Array.from(kept);
}
