// Modules of the page import each other in one direction only. Imports of types count too.

import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join, normalize } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

const SOURCES = fileURLToPath(new URL('../src', import.meta.url));

/** Relative paths after `from`, `import` or `import(`. */
const RELATIVE_IMPORT = /\b(?:from|import)\s*\(?\s*(['"])(\.[^'"]*)\1/g;

/** Imported modules of each module. */
type ImportGraph = Map<string, string[]>;

/** Returns the modules that a source file imports, relative to the folder of sources. */
const importsOf = (module: string, source: string) =>
  [...source.matchAll(RELATIVE_IMPORT)].map(found => normalize(join(dirname(module), found[2]!)));

function readImports(folder: string): ImportGraph {
  const modules = readdirSync(folder, { recursive: true, encoding: 'utf8' }).filter(file => file.endsWith('.ts'));
  return new Map(modules.map(module => [module, importsOf(module, readFileSync(join(folder, module), 'utf8'))]));
}

/** Returns the modules of an import cycle, the first one repeated at the end; null if there is no cycle. */
function findCycle(graph: ImportGraph): string[] | null {
  const finished = new Set<string>();
  const follow = (module: string, path: string[]): string[] | null => {
    if (path.includes(module)) return [...path.slice(path.indexOf(module)), module];
    if (finished.has(module)) return null;
    for (const imported of graph.get(module) ?? []) {
      const cycle = follow(imported, [...path, module]);
      if (cycle) return cycle;
    }
    finished.add(module);
    return null;
  };
  for (const module of graph.keys()) {
    const cycle = follow(module, []);
    if (cycle) return cycle;
  }
  return null;
}

test('the modules of the page have no import cycle', () => {
  const graph = readImports(SOURCES);
  for (const [module, imported] of graph) for (const one of imported) assert.ok(graph.has(one), `${module} imports ${one}, which does not exist`);
  assert.ok(graph.get('main.ts')!.includes('page.ts'));
  assert.equal(findCycle(graph)?.join(' -> '), undefined);
});

test('every form of import counts', () => {
  const source = `
    import './a.ts';
    import * as b from "../b.ts";
    import type { C } from './c.ts';
    import { d,
      type D } from './d.ts';
    export { e } from './e.ts';
    const f = await import('./f.ts'); type G = typeof import('./g.ts')['g'];
    import * as THREE from 'three';`;
  assert.deepEqual(importsOf('town/town.ts', source), ['town/a.ts', 'b.ts', 'town/c.ts', 'town/d.ts', 'town/e.ts', 'town/f.ts', 'town/g.ts'].map(normalize));
});

test('a cycle is found behind modules without one', () => {
  const chain: ImportGraph = new Map([['a', ['b', 'c']], ['b', ['c']], ['c', []]]);
  assert.equal(findCycle(chain), null);
  assert.deepEqual(findCycle(new Map([...chain, ['c', ['d']], ['d', ['b']]])), ['b', 'c', 'd', 'b']);
  assert.deepEqual(findCycle(new Map([['a', ['a']]])), ['a', 'a']);
});
