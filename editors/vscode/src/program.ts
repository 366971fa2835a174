// Where the program `hsd` is: where the settings say, else on the path, else where cargo puts programs.
import { execFile } from 'node:child_process';
import { constants } from 'node:fs';
import { access, stat } from 'node:fs/promises';
import { homedir } from 'node:os';
import { delimiter, isAbsolute, join } from 'node:path';
import { promisify } from 'node:util';
import { ConfigurationTarget, workspace } from 'vscode';

const NAME = process.platform === 'win32' ? 'hsd.exe' : 'hsd';

/** What the settings name, with `~` and `${workspaceFolder}` written out; empty where they name nothing. */
export function chosen(): string {
  const path = workspace.getConfiguration('hsd').get<string>('serverPath', '').trim();
  const folder = workspace.workspaceFolders?.[0]?.uri.fsPath ?? '';
  const full = path.replace(/^~(?=[/\\]|$)/, () => homedir()).replaceAll('${workspaceFolder}', () => folder);
  return full && !isAbsolute(full) && /[/\\]/.test(full) ? join(folder, full) : full;
}

/** The program, or nothing. */
export async function find(): Promise<string | undefined> {
  const name = chosen();
  if (name && isAbsolute(name)) return (await runs(name)) ? name : undefined;
  const folders = (process.env['PATH'] ?? '').split(delimiter).filter(Boolean);
  const cargo = join(process.env['CARGO_HOME'] ?? join(homedir(), '.cargo'), 'bin');
  for (const folder of [...folders, cargo]) {
    const path = join(folder, name || NAME);
    if (await runs(path)) return path;
  }
  return undefined;
}

/** Why a program is no language server, or nothing: an older `hsd`, or something else altogether. */
export async function fault(program: string): Promise<string | undefined> {
  try {
    await promisify(execFile)(program, ['lsp', '--help'], { timeout: 10_000, windowsHide: true });
    return undefined;
  } catch (error) {
    const said = (error as { stderr?: string }).stderr?.trim().split('\n')[0];
    return said || (error instanceof Error ? error.message : String(error));
  }
}

/** Writes the program's place into the settings, which starts it. */
export async function show(path: string): Promise<void> {
  await workspace.getConfiguration('hsd').update('serverPath', path, ConfigurationTarget.Global);
}

async function runs(path: string): Promise<boolean> {
  try {
    await access(path, constants.X_OK);
    return (await stat(path)).isFile();
  } catch {
    return false;
  }
}
