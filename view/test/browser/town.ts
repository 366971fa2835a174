// Towns for measuring reflections: a street with houses on both sides, some on the north side with a glass front, and rows
// of houses to the north that no glass faces.

const WIDE = 6; // units of a house's front
const STEP = 7; // metres between houses
const STREET = 9;

/**
 * The source of a town: `long` houses on each side, `glass` of them with glass fronts, and `rows` rows of houses behind
 * them. With `apart`, each front is set back by a different distance; else all are coplanar.
 */
export function town(long: number, glass: number, rows: number, apart: boolean): string {
  const houses: string[] = [];
  for (let i = 0; i < long; i++) {
    const x = i * STEP, front = i % (long / glass) === 0;
    houses.push(front ? glazed(x, apart ? (i * 7 % long) / (long / 2) : 0) : plain(`n${i}`, x, 0, 180), plain(`s${i}`, x - WIDE * 10 / 11, -STREET, 0));
    for (let row = 1; row <= rows; row++) houses.push(plain(`b${i}-${row}`, x, row * 12, 180));
  }
  return `<Houses>\n${houses.join('\n')}\n</Houses>\n`;
}

const facade = (code: string, num: number, more = '') =>
  `<Facade${more}>${`<Floor><repeat num="${num}"><Part code="${code}"/></repeat></Floor>`.repeat(2)}</Facade>`;

const glazed = (x: number, y: number) => `<House x="${x}" y="${y}"><Structure><Texture texturecode="NGC" reflection="0.7"/><Facades>${
  facade('NGC', WIDE, ' reflection="enable"')}${facade('NAP', 6)}${facade('NAP', WIDE)}${facade('NAP', 6)}</Facades></Structure></House>`;

const plain = (name: string, x: number, y: number, azimuth: number) => `<House name="${name}" x="${x}" y="${y}" azimuth="${azimuth}"><Storey>${
  ['KTU  KTU  TKD 2KTU  KTU', 'APW  APW  APW  APW  APW  APW', 'KTU  KTU  KTU  KTU  KTU  KTU', 'APW  APW  APW  APW  APW  APW'].map(row => `<Row>${row}</Row>`).join('')
}</Storey></House>`;
