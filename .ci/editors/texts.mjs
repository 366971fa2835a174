// The texts that every client of the language server opens: right ones, and a broken one with what must be said of it.
import { execFileSync, spawnSync } from 'node:child_process';
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';

/** Signs of one, three and four bytes, of one and two code units, before the mistake in its line. */
export const broken = `<!-- 𠮷野家 -->
<House name="𠮷野家の店" stret="yes">
  <Storey height="9.5">
    <Row>KKS  TKD 2MRE</Row>
    <Row>KSK  MRE  KSK</Row>
    <Row>KKS  TIT 2KKS</Row>
    <Row>KSK  KSK  KSK</Row>
  </Storey>
</House>
`;

/** The mistake, where it stands and what mends it. */
export const mistake = { code: 'HSD0222', line: 1, word: 'stret', mend: 'street' };

/** What `hsd check` says of a file: code, line from 0 and the span in bytes of the file. */
export function checked(hsd, file) {
  const { stdout } = spawnSync(hsd, ['check', '--lang', 'en', '--format', 'json', file], { encoding: 'utf8', maxBuffer: 1 << 26 });
  return JSON.parse(stdout);
}

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
