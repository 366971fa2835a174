// The source files that client.mjs opens: the examples, and broken files with the expected diagnostics. neovim.lua and emacs.el use
// the same.
import { execFileSync } from 'node:child_process';
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';

/** A broken file of each form with one error; characters of one, three and four bytes, of one and two UTF-16 units. */
export const broken = [
  {
    name: '長屋.hsd',
    text: `# 𠮷野家
0 0 180
9.5
name 𠮷野家の店

KKS  TKD 2MRE
KSK  ＭＲＥ  KSK
KKS  TIT 2KKS
KSK  KSK  KSK
`,
    code: 'HSD0122', line: 6, word: 'ＭＲＥ', fix: 'MRE',
  },
  {
    name: '町家.hsd',
    text: `<!-- 𠮷野家 -->
<House name="𠮷野家の店" stret="yes">
  <Storey height="9.5">
    <Row>KKS  TKD 2MRE</Row>
    <Row>KSK  MRE  KSK</Row>
    <Row>KKS  TIT 2KKS</Row>
    <Row>KSK  KSK  KSK</Row>
  </Storey>
</House>
`,
    code: 'HSD0222', line: 1, word: 'stret', fix: 'street',
  },
];

/** The output of `hsd fmt` for a text. */
export function laidOut(hsd, text) {
  return execFileSync(hsd, ['fmt', '-'], { encoding: 'utf8', input: text });
}

/** Paths of the examples. */
export function examples(root) {
  const folder = join(root, 'examples');
  return readdirSync(folder).filter(name => name.endsWith('.hsd')).map(name => join(folder, name));
}

export const read = file => readFileSync(file, 'utf8');
