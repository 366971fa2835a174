// Support for typing codes of five columns.
import {
  type CompletionItem, CompletionItemKind, type Position, Range, type TextDocument, type TextDocumentChangeEvent, type TextEditor, window,
} from 'vscode';

const COLUMNS = 5;
const INDENT = 2;
/** Number of lines that determine the form of a source file. */
const HEAD = 50;

/** Sets the tab size: to the next code in the legacy form, as the compiler reads tabs, and an indent in XML. */
export function fitTabs(editor: TextEditor | undefined): void {
  if (editor?.document.languageId !== 'hsd') return;
  const xml = /^\s*</.test(editor.document.getText(new Range(0, 0, HEAD, 0)));
  const tabSize = xml ? INDENT : COLUMNS;
  if (editor.options.tabSize !== tabSize) editor.options = { insertSpaces: true, tabSize };
}

/** Updates the tab size when the first lines of the document change. */
export function refitTabs({ document, contentChanges }: TextDocumentChangeEvent): void {
  const editor = window.activeTextEditor;
  if (editor?.document === document && contentChanges.some(change => change.range.start.line < HEAD)) fitTabs(editor);
}

/**
 * True if a complete code ends the line. Completion is then suppressed, because Enter would pad the code instead of starting a
 * new line.
 */
export function isComplete(document: TextDocument, position: Position, items: readonly CompletionItem[]): boolean {
  const line = document.lineAt(position);
  if (line.text.slice(position.character).trim()) return false;
  return items.some(({ kind, range, insertText }) => {
    if (kind !== CompletionItemKind.EnumMember && kind !== CompletionItemKind.Constant) return false;
    const from = range && ('inserting' in range ? range.inserting : range);
    if (!from || typeof insertText !== 'string') return false;
    return document.getText(new Range(from.start, position)) === insertText.trimEnd();
  });
}
