// Filters the semantic tokens of the language server. The TextMate grammar colours the syntax immediately, with adjacent codes in
// alternating colours; from the server come only the tokens that a grammar cannot determine: unknown parts, and the kinds of names
// in expressions.
import { type SemanticTokens, type SemanticTokensLegend } from 'vscode';

const KINDS = new Set(['parameter', 'variable', 'function']);
// Custom parts keep the alternating colours, which separate adjacent codes.
const MODIFIERS = ['unknown'];
/** Numbers per token: line and column relative to the previous token, length, type, modifiers. */
const STEP = 5;

/** Drops the tokens that the grammar colours as well or better. */
export function filterTokens(tokens: SemanticTokens, legend: SemanticTokensLegend): Uint32Array {
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
