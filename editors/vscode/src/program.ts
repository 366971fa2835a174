// Finds the program `hsd`: in the configured place, else on the PATH, else in cargo's folder of programs.
import { execFile } from 'node:child_process';
import { constants } from 'node:fs';
import { access, stat } from 'node:fs/promises';
import { homedir } from 'node:os';
import { delimiter, isAbsolute, join } from 'node:path';
import { promisify } from 'node:util';
import { ConfigurationTarget, workspace } from 'vscode';

const NAME = process.platform === 'win32' ? 'hsd.exe' : 'hsd';

/** The configured path, with `~` and `${workspaceFolder}` expanded; empty if there is none. */
export function configuredPath(): string {
  const path = workspace.getConfiguration('hsd').get<string>('serverPath', '').trim();
  const folder = workspace.workspaceFolders?.[0]?.uri.fsPath ?? '';
  const full = path.replace(/^~(?=[/\\]|$)/, () => homedir()).replaceAll('${workspaceFolder}', () => folder);
  return full && !isAbsolute(full) && /[/\\]/.test(full) ? join(folder, full) : full;
}

/** The path of the program; undefined if it is not found. */
export async function findProgram(): Promise<string | undefined> {
  const name = configuredPath();
  if (name && isAbsolute(name)) return (await isExecutable(name)) ? name : undefined;
  const folders = (process.env['PATH'] ?? '').split(delimiter).filter(Boolean);
  const cargo = join(process.env['CARGO_HOME'] ?? join(homedir(), '.cargo'), 'bin');
  for (const folder of [...folders, cargo]) {
    const path = join(folder, name || NAME);
    if (await isExecutable(path)) return path;
  }
  return undefined;
}

/** The reason why a program cannot run as the language server (an older `hsd`, or a different program); undefined if it can. */
export async function startupError(program: string): Promise<string | undefined> {
  try {
    await promisify(execFile)(program, ['lsp', '--help'], { timeout: 10_000, windowsHide: true });
    return undefined;
  } catch (error) {
    const output = (error as { stderr?: string }).stderr?.trim().split('\n')[0];
    return output || (error instanceof Error ? error.message : String(error));
  }
}

/** Stores the program's path in the settings, which restarts the server. */
export async function setServerPath(path: string): Promise<void> {
  await workspace.getConfiguration('hsd').update('serverPath', path, ConfigurationTarget.Global);
}

async function isExecutable(path: string): Promise<boolean> {
  try {
    await access(path, constants.X_OK);
    return (await stat(path)).isFile();
  } catch {
    return false;
  }
}
