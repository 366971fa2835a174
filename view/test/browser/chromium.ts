// Chromium for the tests, and a small server for pages bundled for one test.

import { build } from 'esbuild';
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { join } from 'node:path';
import { type Browser, chromium } from 'playwright-core';
import { temporaryFolder } from './temporary.ts';

const PLACES = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'];

/** Renders in software, so that results are the same on every machine. */
export function browser(): Promise<Browser> {
  const executablePath = process.env['CHROMIUM'] ?? PLACES.find(existsSync);
  if (!executablePath) throw new Error('no Chromium: set CHROMIUM');
  return chromium.launch({ executablePath, args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'] });
}

/** Builds a source file with the program under test; returns the GLB. */
export function built(text: string, ...options: string[]): Uint8Array {
  const out = join(temporaryFolder(), 'house.glb');
  buildTo(out, text, ...options);
  return new Uint8Array(readFileSync(out));
}

/** Builds a source file into another file. */
export function buildTo(out: string, text: string, ...options: string[]) {
  const hsd = process.env['HSD'];
  if (!hsd) throw new Error('HSD names no program: use test/browser/run.mjs');
  execFileSync(hsd, ['build', '--quiet', text, ...options, '-o', out], { stdio: ['ignore', 'ignore', 'inherit'] });
}

/** Serves a page with one script and some files on localhost; returns its URL and a function that stops it. */
export async function served(script: string, files: Record<string, Uint8Array>): Promise<{ url: string; close: () => void }> {
  const bundle = await build({ entryPoints: [script], bundle: true, format: 'esm', target: 'es2022', write: false, sourcemap: 'inline' });
  const body = '<!doctype html><meta charset="utf-8"><title>test</title><link rel="icon" href="data:,"><style>body{margin:0}canvas{display:block}</style><script type="module" src="/page.js"></script>';
  const server: Server = createServer((request, response) => {
    const path = (request.url ?? '/').split('?')[0]!, file = files[path.slice(1)];
    if (path === '/') response.setHeader('content-type', 'text/html').end(body);
    else if (path === '/page.js') response.setHeader('content-type', 'text/javascript').end(bundle.outputFiles[0]!.text);
    else if (file) response.end(file);
    else response.writeHead(404).end();
  });
  await new Promise<void>(done => server.listen(0, '127.0.0.1', done));
  return { url: `http://127.0.0.1:${(server.address() as AddressInfo).port}/`, close: () => { server.close(); server.closeAllConnections(); } };
}
