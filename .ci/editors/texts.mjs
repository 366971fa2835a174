// The texts that the protocol's client opens: right ones, and broken ones with what must be said of them. neovim.lua and emacs.el
// have the same.
import { execFileSync } from 'node:child_process';
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';

/** A broken text of each form, and the one mistake in it: signs of one, three and four bytes, of one and two code units. */
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
    code: 'HSD0122', line: 6, word: 'ＭＲＥ', mend: 'MRE',
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
    code: 'HSD0222', line: 1, word: 'stret', mend: 'street',
  },
];

/** What `hsd fmt` makes of a text. */
export function laid_out(hsd, text) {
  return execFileSync(hsd, ['fmt', '-'], { encoding: 'utf8', input: text });
}

/** The examples. */
export function examples(root) {
  const folder = join(root, 'examples');
  return readdirSync(folder).filter(name => name.endsWith('.hsd')).map(name => join(folder, name));
}

export const read = file => readFileSync(file, 'utf8');
