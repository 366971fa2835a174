// A loupe beside a corner: the photograph round it, enlarged, with the two sides that meet there.

import { s } from '../ui/dom.ts';
import type { Corners, Photograph, Place } from '../server/front.ts';

/** Its width, CSS pixels; the distance from its corner; how much it enlarges what the sheet shows, and a pixel at the least. */
const WIDE = 168, BESIDE = 26, LARGER = 5, LEAST = 2.5;

export class Loupe {
  readonly element = s('svg', { class: 'loupe', 'aria-hidden': 'true', width: WIDE, height: WIDE });
  #picture = s('image', {});
  #sides = s('polyline', { class: 'side' });
  #cross = s('path', { class: 'middle' });

  constructor() {
    this.element.append(this.#picture, this.#sides, this.#cross);
    this.hide();
  }

  hide() { this.element.toggleAttribute('hidden', true); }

  show(url: string, { size: [width, height] }: Photograph, corners: Corners, corner: number, sheet: { scale: number; at: Place; wide: number; high: number }) {
    const zoom = Math.max(LEAST, LARGER * sheet.scale), seen = WIDE / zoom, [x, y] = corners[corner]!;
    this.element.toggleAttribute('hidden', false);
    this.element.setAttribute('viewBox', `${x - seen / 2} ${y - seen / 2} ${seen} ${seen}`);
    for (const [name, value] of Object.entries({ href: url, width, height })) if (this.#picture.getAttribute(name) !== `${value}`) this.#picture.setAttribute(name, `${value}`);
    const around = [3, 0, 1].map(step => corners[(corner + step) % 4]!.join(','));
    this.#sides.setAttribute('points', around.join(' '));
    const [gap, arm] = [3 / zoom, 14 / zoom];
    this.#cross.setAttribute('d', [[1, 0], [-1, 0], [0, 1], [0, -1]].map(([a, b]) => `M${x + a! * gap},${y + b! * gap}l${a! * arm},${b! * arm}`).join(''));
    // Away from the middle of the wall, but within the sheet.
    const [left, top] = sheet.at, fit = (at: number, room: number) => Math.min(Math.max(at, 4), Math.max(room - WIDE - 4, 4));
    const beside = (at: number, room: number) => at + BESIDE + WIDE < room ? at + BESIDE : at - BESIDE - WIDE;
    this.element.style.left = `${fit(beside(left, sheet.wide), sheet.wide)}px`;
    this.element.style.top = `${fit(top - WIDE / 2, sheet.high)}px`;
  }
}
