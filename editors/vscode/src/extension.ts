// The extension: it finds the program `hsd`, runs `hsd lsp` beside the editor, and starts it anew when a setting changes.
// All knowledge of houses is the program's; here is nothing but wires.
import {
  type ConfigurationChangeEvent, type ExtensionContext, type LogOutputChannel, type ProviderResult, SemanticTokens, type TextEditor, Uri, commands, env,
  l10n, window, workspace,
} from 'vscode';
import { LanguageClient, type LanguageClientOptions, State } from 'vscode-languageclient/node';
import { told } from './colours';
import { chosen, fault, find, show } from './program';
import { fitTabs, refitTabs, written } from './typing';

/** Settings that reach the program when it starts. */
const SETTINGS = [
  'serverPath', 'language', 'textures', 'catalogs', 'parameters', 'seed', 'root', 'pictures', 'inlayHints',
] as const;

let client: LanguageClient | undefined;
/** Whether a preview was shown, which wants to know where the cursor stands. */
let previewed = false;
let output: LogOutputChannel;
/** Starting and stopping follow one another, however fast settings change. */
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
    window.onDidChangeTextEditorSelection(({ textEditor }) => point(textEditor)),
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

/** The language of messages: what the settings say, else that of the editor. */
function language(): 'en' | 'ja' {
  const asked = workspace.getConfiguration('hsd').get<string>('language', 'auto');
  if (asked === 'en' || asked === 'ja') return asked;
  return env.language.startsWith('ja') ? 'ja' : 'en';
}

async function start(): Promise<void> {
  const settings = workspace.getConfiguration('hsd');
  const program = await find();
  if (!program) return missing();
  const why = await fault(program);
  if (why) return failed(program, why);
  output.info(`${program} lsp --lang ${language()}`);
  const options: LanguageClientOptions = {
    documentSelector: [{ language: 'hsd', scheme: 'file' }, { language: 'hsd', scheme: 'untitled' }],
    outputChannel: output,
    // What went wrong is said below, once.
    initializationFailedHandler: () => false,
    initializationOptions: {
      ...Object.fromEntries(SETTINGS.map(name => [name, settings.get<unknown>(name)])),
      language: language(),
    },
    middleware: {
      provideCompletionItem: async (document, position, context, token, next) => {
        const found = await next(document, position, context, token);
        const items = Array.isArray(found) ? found : found?.items ?? [];
        return written(document, position, items) ? undefined : found;
      },
      provideDocumentSemanticTokens: async (document, token, next) => colours(await next(document, token)),
      provideDocumentRangeSemanticTokens: async (document, range, token, next) => colours(await next(document, range, token)),
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

/** The colours of the program that are no grammar's work. */
function colours(tokens: Awaited<ProviderResult<SemanticTokens>>): SemanticTokens | undefined {
  const offered = client?.initializeResult?.capabilities.semanticTokensProvider;
  if (!tokens || !offered) return undefined;
  return new SemanticTokens(told(tokens, offered.legend));
}

/** Shows the house of the text in the live preview, as it stands in the editor. */
async function showHouse(): Promise<void> {
  const editor = window.activeTextEditor;
  if (!client || editor?.document.languageId !== 'hsd') return;
  const uri = client.code2ProtocolConverter.asUri(editor.document.uri);
  try {
    // The page is opened here: where the editor runs in a browser itself, only it knows the way to this machine.
    const url: string = await client.sendRequest('workspace/executeCommand', { command: 'hsd.view', arguments: [uri, false] });
    previewed = true;
    await env.openExternal(Uri.parse(url, true));
  } catch (error) {
    void window.showErrorMessage(error instanceof Error ? error.message : String(error));
  }
}

/** The part under the cursor lights up in the preview. */
function point({ document, selection }: TextEditor): void {
  if (!client || !previewed || document.languageId !== 'hsd') return;
  void client.sendNotification('hsd/cursor', {
    textDocument: { uri: client.code2ProtocolConverter.asUri(document.uri) },
    position: client.code2ProtocolConverter.asPosition(selection.active),
  });
}

/** Says that there is no program, and how to come by it. Nothing waits for the answer. */
function missing(): void {
  const path = chosen();
  const message = path
    ? l10n.t('The program `hsd` is not at {0}, which the setting hsd.serverPath names.', path)
    : l10n.t('The program `hsd` was not found. Without it houses are only coloured, not checked.');
  output.error(message);
  offer(message);
}

function failed(program: string, error: unknown): void {
  const why = error instanceof Error ? error.message : String(error);
  const message = l10n.t('{0} did not start as a language server: {1}', program, why);
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
  if (found?.[0]) await show(found[0].fsPath);
}
