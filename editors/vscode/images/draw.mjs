// node images/draw.mjs [--check]
// Draws the icons: a town house seen from the street, with a lattice and a door. The same shapes are written as SVG, for the file
// icon, and as PNG, for the icon of the extension. With --check it only compares.
import { readFileSync, writeFileSync } from 'node:fs';
import { crc32, deflateSync } from 'node:zlib';

const box = (x0, y0, x1, y1) => [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
const range = (n, make) => Array.from({ length: n }, (_, i) => make(i));

/** The shapes from back to front, on a 32 x 32 grid: colour name and outline. */
const shapes = [
  ['wall', box(5, 14, 27, 29)],
  ['roof', [[16, 3], [31, 14], [31, 16], [1, 16], [1, 14]]],
  ['ridge', [[16, 3], [17, 3.7], [17, 5.5], [16, 4.8], [15, 5.5], [15, 3.7]]],
  ['wood', box(5, 27, 27, 29)],
  ...range(5, i => ['wood', box(7 + 2 * i, 19, 8 + 2 * i, 27)]),
  ['wood', box(7, 19, 16, 20)],
  ['wood', box(19, 18, 25, 29)],
  ['wall', box(21.75, 19.5, 22.25, 29)],
];

const palettes = {
  light: { roof: '#46525e', ridge: '#2f3943', wall: '#e6d9bd', wood: '#8a4524' },
  dark: { roof: '#8fa1b3', ridge: '#c0ccd8', wall: '#f0e6d0', wood: '#a4572f' },
};

function svg(palette) {
  const paths = shapes.map(([kind, points]) => `  <path fill="${palette[kind]}" d="M${points.map(p => p.join(' ')).join('L')}Z"/>\n`);
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 32 32">\n${paths.join('')}</svg>\n`;
}

const inside = (points, x, y) => points.reduce((within, [x0, y0], i) => {
  const [x1, y1] = points[(i + 1) % points.length];
  return (y0 > y) !== (y1 > y) && x < x0 + (x1 - x0) * (y - y0) / (y1 - y0) ? !within : within;
}, false);

const rgb = colour => [1, 3, 5].map(at => parseInt(colour.slice(at, at + 2), 16));

/** A PNG of `size` x `size` pixels on the background `ground`, with 16 samples per pixel. */
function png(palette, ground, size) {
  const rows = range(size, y => Buffer.from([0, ...range(size, x => {
    const sum = [0, 0, 0];
    for (let point = 0; point < 16; point += 1) {
      const at = [x + (point % 4 + 0.5) / 4, y + (Math.floor(point / 4) + 0.5) / 4].map(v => v * 40 / size - 4);
      const hit = shapes.findLast(([, points]) => inside(points, ...at));
      rgb(hit ? palette[hit[0]] : ground).forEach((value, channel) => { sum[channel] += value; });
    }
    return sum.map(value => Math.round(value / 16));
  }).flat()]));
  const chunk = (kind, data) => {
    const body = Buffer.concat([Buffer.from(kind, 'latin1'), data]);
    const length = Buffer.alloc(4), sum = Buffer.alloc(4);
    length.writeUInt32BE(data.length);
    sum.writeUInt32BE(crc32(body));
    return Buffer.concat([length, body, sum]);
  };
  const head = Buffer.alloc(13);
  head.writeUInt32BE(size, 0);
  head.writeUInt32BE(size, 4);
  head.set([8, 2], 8);
  return Buffer.concat([
    Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'),
    chunk('IHDR', head), chunk('IDAT', deflateSync(Buffer.concat(rows), { level: 9 })), chunk('IEND', Buffer.alloc(0)),
  ]);
}

const files = {
  'house-light.svg': Buffer.from(svg(palettes.light)),
  'house-dark.svg': Buffer.from(svg(palettes.dark)),
  'icon.png': png(palettes.light, '#cfe0ea', 128),
};
for (const [name, bytes] of Object.entries(files)) {
  const path = new URL(name, import.meta.url);
  if (process.argv[2] !== '--check') writeFileSync(path, bytes);
  else if (!name.endsWith('.png') && !bytes.equals(readFileSync(path))) throw new Error(`images/${name}: run node images/draw.mjs`);
}
