// The lengths written beside the walls of the plan. They keep their size on the screen, and those without room are left out.

import { s } from '../ui/dom.ts';
import { SHAKU } from '../ui/lengths.ts';
import { strings } from '../ui/strings.ts';
import type { XY } from './coordinates.ts';

/** Size of the letters, their distance from the wall, and the width of a letter, CSS pixels. */
const SIZE = 12, GAP = 11, LETTER = 6.8;

export interface WallLength {
  element: SVGTextElement;
  ends: readonly [XY, XY];
  middle: XY;
  /** Outward. */
  normal: XY;
  /** Metres. */
  long: number;
}

/** The length of a wall in shaku, outside of it: the interior lies to the right of its direction. */
export function wallLength(ends: readonly [XY, XY]): WallLength {
  const [[x1, y1], [x2, y2]] = ends;
  const long = Math.hypot(x2 - x1, y2 - y1), normal: XY = [(y2 - y1) / long, -(x2 - x1) / long];
  const sideways = Math.abs(normal[0]) > 0.5;
  const element = s('text', { class: 'length', 'text-anchor': !sideways ? 'middle' : normal[0] > 0 ? 'start' : 'end' },
    strings.length(`${Number((long / SHAKU).toFixed(2))}`));
  return { element, ends, middle: [(x1 + x2) / 2, (y1 + y2) / 2], normal, long };
}

/** True if a text at a place of the screen lies over a wall. */
function covers({ ends: [p, q] }: WallLength, pixel: number, left: number, y: number, width: number): boolean {
  const [x0, x1] = [p[0], q[0]].map(n => n / pixel).sort((a, b) => a - b) as XY, [y0, y1] = [p[1], q[1]].map(n => n / pixel).sort((a, b) => a - b) as XY;
  return left < x1 && x0 < left + width && y - SIZE / 3 < y1 && y0 < y + SIZE / 3;
}

/** Writes the lengths at a scale, metres per pixel. */
export function placeLengths(lengths: WallLength[], pixel: number) {
  const taken: { x: number; y: number; width: number }[] = [];
  // Long walls first: where two lengths would cover each other the shorter wall has none.
  for (const { element, middle, normal: [nx, ny], long } of [...lengths].sort((a, b) => b.long - a.long)) {
    const width = element.textContent!.length * LETTER;
    const [x, y] = [middle[0] / pixel + nx * GAP, middle[1] / pixel + ny * GAP];
    const left = x + { start: 0, middle: -width / 2, end: -width }[element.getAttribute('text-anchor') as 'start' | 'middle' | 'end'];
    const room = long / pixel > Math.max(SIZE * 1.5, Math.abs(ny) * width);
    const free = room && !lengths.some(other => covers(other, pixel, left, y, width)) && !taken.some(other => Math.abs(other.y - y) < SIZE && left < other.x + other.width && other.x < left + width);
    element.style.display = free ? '' : 'none';
    if (!free) continue;
    taken.push({ x: left, y, width });
    for (const [name, value] of [['x', x * pixel], ['y', y * pixel], ['font-size', SIZE * pixel]] as const) element.setAttribute(name, `${value}`);
  }
}
