// The extension: finds the program `hsd`, runs `hsd lsp` as the language server, and restarts it when a setting changes.
import {
  type ConfigurationChangeEvent, type ExtensionContext, type LogOutputChannel, type ProviderResult, SemanticTokens, type TextEditor, Uri, commands, env,
  l10n, window, workspace,
} from 'vscode';
import { LanguageClient, type LanguageClientOptions, State } from 'vscode-languageclient/node';
import { filterTokens } from './colours';
import { configuredPath, findProgram, setServerPath, startupError } from './program';
import { fitTabs, isComplete, refitTabs } from './typing';

/** Settings passed to the language server at startup. */
const SETTINGS = [
  'serverPath', 'language', 'textures', 'catalogs', 'parameters', 'seed', 'root', 'pictures', 'inlayHints',
] as const;

let client: LanguageClient | undefined;
/** True once a preview is open, which follows the cursor. */
let previewOpen = false;
let output: LogOutputChannel;
/** Serialises starting and stopping, however fast settings change. */
let queue: Promise<void> = Promise.resolve();

export async function activate(context: ExtensionContext): Promise<void> {
  output = window.createOutputChannel('hsd', { log: true });
  context.subscriptions.push(
    output,
    commands.registerCommand('hsd.restartServer', () => restart()),
    commands.registerCommand('hsd.showOutput', () => output.show()),
    commands.registerCommand('hsd.format', () => commands.executeCommand('editor.action.formatDocument')),
    commands.registerCommand('hsd.chooseServer', () => choose()),
    commands.registerCommand('hsd.showHouse', () => showHouse()),
    window.onDidChangeTextEditorSelection(({ textEditor }) => sendCursor(textEditor)),
    workspace.onDidChangeConfiguration((change: ConfigurationChangeEvent) => {
      if (SETTINGS.some(name => change.affectsConfiguration(`hsd.${name}`))) void restart();
    }),
    workspace.onDidGrantWorkspaceTrust(() => restart()),
    window.onDidChangeActiveTextEditor(fitTabs),
    workspace.onDidChangeTextDocument(refitTabs),
  );
  fitTabs(window.activeTextEditor);
  await restart();
}

export async function deactivate(): Promise<void> {
  await enqueue(stop);
}

function restart(): Promise<void> {
  return enqueue(async () => {
    await stop();
    await start();
  });
}

function enqueue(work: () => Promise<void>): Promise<void> {
  queue = queue.then(work).catch((error: unknown) => {
    output.error(error instanceof Error ? error : String(error));
  });
  return queue;
}

async function stop(): Promise<void> {
  const running = client;
  client = undefined;
  await commands.executeCommand('setContext', 'hsd.running', false);
  if (running?.state === State.Running) await running.stop();
  await running?.dispose();
}

/** Language of messages: the setting, else the editor's language. */
function language(): 'en' | 'ja' {
  const setting = workspace.getConfiguration('hsd').get<string>('language', 'auto');
  if (setting === 'en' || setting === 'ja') return setting;
  return env.language.startsWith('ja') ? 'ja' : 'en';
}

async function start(): Promise<void> {
  const settings = workspace.getConfiguration('hsd');
  const program = await findProgram();
  if (!program) return missing();
  const why = await startupError(program);
  if (why) return failed(program, why);
  output.info(`${program} lsp --lang ${language()}`);
  const options: LanguageClientOptions = {
    documentSelector: [{ language: 'hsd', scheme: 'file' }, { language: 'hsd', scheme: 'untitled' }],
    outputChannel: output,
    // The error is reported once, below.
    initializationFailedHandler: () => false,
    initializationOptions: {
      ...Object.fromEntries(SETTINGS.map(name => [name, settings.get<unknown>(name)])),
      language: language(),
    },
    middleware: {
      provideCompletionItem: async (document, position, context, token, next) => {
        const found = await next(document, position, context, token);
        const items = Array.isArray(found) ? found : found?.items ?? [];
        return isComplete(document, position, items) ? undefined : found;
      },
      provideDocumentSemanticTokens: async (document, token, next) => semanticTokens(await next(document, token)),
      provideDocumentRangeSemanticTokens: async (document, range, token, next) => semanticTokens(await next(document, range, token)),
    },
    markdown: { isTrusted: false, supportHtml: false },
  };
  const run = { command: program, args: ['lsp', '--lang', language()] };
  const started = new LanguageClient('hsd', 'hsd', run, options);
  try {
    await started.start();
  } catch (error) {
    await started.dispose().catch(() => undefined);
    return failed(program, error);
  }
  client = started;
  await commands.executeCommand('setContext', 'hsd.running', true);
}

/** The server's semantic tokens without those that the grammar colours. */
function semanticTokens(tokens: Awaited<ProviderResult<SemanticTokens>>): SemanticTokens | undefined {
  const offered = client?.initializeResult?.capabilities.semanticTokensProvider;
  if (!tokens || !offered) return undefined;
  return new SemanticTokens(filterTokens(tokens, offered.legend));
}

/** Opens the live preview of the active document, including unsaved changes. */
async function showHouse(): Promise<void> {
  const editor = window.activeTextEditor;
  if (!client || editor?.document.languageId !== 'hsd') return;
  const uri = client.code2ProtocolConverter.asUri(editor.document.uri);
  try {
    // Opened by the editor, which can forward the port if it runs remotely or in a browser.
    const url: string = await client.sendRequest('workspace/executeCommand', { command: 'hsd.view', arguments: [uri, false] });
    previewOpen = true;
    await env.openExternal(Uri.parse(url, true));
  } catch (error) {
    void window.showErrorMessage(error instanceof Error ? error.message : String(error));
  }
}

/** Highlights the part under the cursor in the preview. */
function sendCursor({ document, selection }: TextEditor): void {
  if (!client || !previewOpen || document.languageId !== 'hsd') return;
  void client.sendNotification('hsd/cursor', {
    textDocument: { uri: client.code2ProtocolConverter.asUri(document.uri) },
    position: client.code2ProtocolConverter.asPosition(selection.active),
  });
}

/** Reports that the program was not found and offers help; does not wait for the answer. */
function missing(): void {
  const path = configuredPath();
  const message = path
    ? l10n.t('The program `hsd` was not found at {0}, the value of the setting hsd.serverPath.', path)
    : l10n.t('The program `hsd` was not found. Without it source files are highlighted but not checked.');
  output.error(message);
  offer(message);
}

function failed(program: string, error: unknown): void {
  const why = error instanceof Error ? error.message : String(error);
  const message = l10n.t('{0} could not be started as a language server: {1}', program, why);
  output.error(message);
  offer(message);
}

function offer(message: string): void {
  const how = l10n.t('How to install it');
  const where = l10n.t('Choose the program…');
  const log = l10n.t('Show output');
  void window.showErrorMessage(message, how, where, log).then(answer => {
    if (answer === how) return commands.executeCommand('workbench.action.openWalkthrough', 'hsd.hsd#start', false);
    if (answer === where) return choose();
    if (answer === log) output.show();
    return undefined;
  });
}

async function choose(): Promise<void> {
  const found = await window.showOpenDialog({ title: l10n.t('The program hsd'), canSelectMany: false });
  if (found?.[0]) await setServerPath(found[0].fsPath);
}
