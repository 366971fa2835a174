// Checks the links of a site: broken ones, and resources from other hosts.
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { dirname, join, relative } from 'node:path';

/** Returns the problems with the links of all pages in a folder. */
export function deadLinks(folder) {
  const pages = readdirSync(folder, { recursive: true }).filter(n => n.endsWith('.html') && !n.startsWith('files'));
  const texts = new Map(pages.map(page => [join(folder, page), readFileSync(join(folder, page), 'utf8')]));
  const marks = new Map([...texts].map(([path, text]) => [path, new Set([...text.matchAll(/ id="([^"]*)"/g)].map(m => m[1]))]));
  const wrong = [];
  for (const [path, text] of texts) {
    for (const [, kind, value] of text.matchAll(/ (href|src)="([^"]*)"/g)) {
      const link = value.replace(/&amp;/g, '&');
      const report = why => wrong.push(`${relative(folder, path)}: ${link}: ${why}`);
      if (link.startsWith('data:')) continue;
      if (/^[a-z]+:/.test(link)) {
        if (kind === 'src') report('from another host');
        continue;
      }
      const [file, hash] = decodeURI(link).split('#');
      const to = file ? join(dirname(path), file) : path;
      if (!existsSync(to)) report('does not exist');
      else if (hash && marks.has(to) && !marks.get(to).has(hash)) report('has no such anchor');
    }
    if (/url\(\s*['"]?https?:/.test(text)) wrong.push(`${relative(folder, path)}: a style sheet from another host`);
  }
  return wrong;
}
