// What makes codes of five columns easy to type, and keeps them in their columns.
import {
  type CompletionItem, CompletionItemKind, type Position, Range, type TextDocument, type TextDocumentChangeEvent, type TextEditor, window,
} from 'vscode';

const COLUMNS = 5;
const INDENT = 2;
/** Lines at the head of a text that tell its form. */
const HEAD = 50;

/** A tab leads to the next code in the legacy form, as the program reads tabs, and indents in XML. */
export function fitTabs(editor: TextEditor | undefined): void {
  if (editor?.document.languageId !== 'hsd') return;
  const xml = /^\s*</.test(editor.document.getText(new Range(0, 0, HEAD, 0)));
  const tabSize = xml ? INDENT : COLUMNS;
  if (editor.options.tabSize !== tabSize) editor.options = { insertSpaces: true, tabSize };
}

/** The same when the head of a text has changed. */
export function refitTabs({ document, contentChanges }: TextDocumentChangeEvent): void {
  const editor = window.activeTextEditor;
  if (editor?.document === document && contentChanges.some(change => change.range.start.line < HEAD)) fitTabs(editor);
}

/**
 * Whether a code is written out at the end of its line. Then the list of proposals would only stand in the way: the key for
 * the next line would fill up the code instead, which its end does not need.
 */
export function written(document: TextDocument, position: Position, items: readonly CompletionItem[]): boolean {
  const line = document.lineAt(position);
  if (line.text.slice(position.character).trim()) return false;
  return items.some(({ kind, range, insertText }) => {
    if (kind !== CompletionItemKind.EnumMember && kind !== CompletionItemKind.Constant) return false;
    const from = range && ('inserting' in range ? range.inserting : range);
    if (!from || typeof insertText !== 'string') return false;
    return document.getText(new Range(from.start, position)) === insertText.trimEnd();
  });
}
