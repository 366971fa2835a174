// The wall seen straight, with its lattice: lines between bays and storeys are dragged, moved by keys, added and removed.

import type { Place, Straight } from '../server/front.ts';
import { h, s } from '../ui/dom.ts';
import { strings } from '../ui/strings.ts';
import { type Way, room } from './draft.ts';
import { arrow } from './photo-sheet.ts';

/** What is beside the wall for the grips of the lines, CSS pixels. */
const EDGE = 26;
const WAYS: Way[] = ['columns', 'rows'];

export interface WallEvents {
  /** A line is moved to a part of the wall; `done` ends a drag. */
  move: (way: Way, line: number, at: number, done: boolean) => void;
  remove: (way: Way, line: number) => void;
  /** A line is added at a part of the wall. */
  add: (way: Way, at: number) => void;
  announce: (text: string) => void;
}

/** What is shown: the lattice, and width and height of the wall in metres. */
export interface Lattice { columns: number[]; rows: number[]; metres: [number, number] }

export class WallSheet {
  readonly element = h('div', { class: 'wall-sheet' });
  readonly svg = s('svg', { class: 'wall', role: 'group' });
  /** The line that was focused last. */
  held: { way: Way; line: number } | null = null;
  #events: WallEvents;
  #image = s('image', { preserveAspectRatio: 'none' });
  #lines = { columns: s('g', {}), rows: s('g', {}) };
  #size: [number, number] = [100, 100];
  #lattice: Lattice = { columns: [], rows: [], metres: [1, 1] };

  constructor(events: WallEvents) {
    this.#events = events;
    this.svg.append(this.#image, this.#lines.rows, this.#lines.columns);
    this.element.append(this.svg);
    this.svg.setAttribute('aria-label', strings.photos.wall);
    this.#image.addEventListener('dblclick', event => {
      const [x, y] = this.#at(event);
      this.#events.add(event.shiftKey ? 'rows' : 'columns', event.shiftKey ? y : x);
    });
    new ResizeObserver(() => this.#draw()).observe(this.element);
  }

  /** Shows a wall. */
  show({ picture, size }: Straight) {
    this.#size = size;
    for (const [name, value] of Object.entries({ href: picture, width: size[0], height: size[1] })) this.#image.setAttribute(name, `${value}`);
    this.#draw();
  }

  /** Shows the lattice of the wall. */
  set(lattice: Lattice) {
    this.#lattice = lattice;
    this.#draw();
  }

  focus(way: Way, line: number) {
    (this.#lines[way].children[line] as SVGGElement | undefined)?.focus();
  }

  /** The part of the wall under the pointer. */
  #at({ clientX, clientY }: { clientX: number; clientY: number }): Place {
    const matrix = this.svg.getScreenCTM();
    if (!matrix) return [0, 0];
    const { x, y } = new DOMPoint(clientX, clientY).matrixTransform(matrix.inverse());
    return [x / this.#size[0], y / this.#size[1]];
  }

  #draw() {
    const [width, height] = this.#size, wide = this.element.clientWidth, high = this.element.clientHeight;
    if (!wide || !high) return;
    // A pixel of the page in those of the wall.
    const pixel = Math.max(width / Math.max(wide - 2 * EDGE, 40), height / Math.max(high - 2 * EDGE, 40));
    this.svg.setAttribute('viewBox', `${(width - wide * pixel) / 2} ${(height - high * pixel) / 2} ${wide * pixel} ${high * pixel}`);
    for (const way of WAYS) {
      const group = this.#lines[way], places = this.#lattice[way];
      while (group.children.length > places.length) group.lastElementChild!.remove();
      while (group.children.length < places.length) group.append(this.#line(way, group.children.length));
      places.forEach((at, line) => this.#place(group.children[line] as SVGGElement, way, line, at, pixel));
    }
  }

  #place(element: SVGGElement, way: Way, line: number, at: number, pixel: number) {
    const isColumn = way === 'columns', [width, height] = this.#size, across = at * (isColumn ? width : height), long = isColumn ? height : width;
    const length = this.#lattice.metres[isColumn ? 0 : 1], [least, most] = room(this.#lattice[way], line);
    const metres = (part: number) => (part * length).toFixed(2);
    element.setAttribute('transform', isColumn ? `translate(${across} 0)` : `matrix(0 1 1 0 0 ${across})`);
    const [reach, stroke, grip] = element.children as unknown as SVGElement[];
    for (const drawn of [reach!, stroke!]) for (const [name, value] of Object.entries({ x1: 0, x2: 0, y1: -12 * pixel, y2: long + 12 * pixel })) drawn.setAttribute(name, `${value}`);
    for (const [name, value] of Object.entries({ cx: 0, cy: -12 * pixel, r: 7 * pixel })) grip!.setAttribute(name, `${value}`);
    for (const [name, value] of Object.entries({
      'aria-label': isColumn ? strings.photos.column(line + 1) : strings.photos.row(line + 1), 'aria-valuetext': strings.photos.metres(metres(at)),
      'aria-valuemin': metres(least), 'aria-valuemax': metres(most), 'aria-valuenow': metres(at),
    })) element.setAttribute(name, value);
  }

  #line(way: Way, line: number): SVGGElement {
    const isColumn = way === 'columns';
    const element = s('g', {
      class: `lattice-line ${way}`, tabindex: 0, role: 'slider', 'aria-orientation': isColumn ? 'horizontal' : 'vertical', 'data-line': `${way} ${line}`,
    }, s('line', { class: 'reach' }), s('line', { class: 'stroke' }), s('circle', { class: 'grip' }));
    let from: { pointer: number; line: number } | null = null;
    const place = (event: PointerEvent) => this.#at(event)[isColumn ? 0 : 1];
    const moved = (event: PointerEvent) => from!.line + (place(event) - from!.pointer) * (event.shiftKey ? 0.1 : 1);
    element.addEventListener('focus', () => { this.held = { way, line }; });
    element.addEventListener('pointerdown', event => {
      if (event.button !== 0) return;
      event.preventDefault();
      element.focus();
      element.setPointerCapture(event.pointerId);
      from = { pointer: place(event), line: this.#lattice[way][line]! };
    });
    element.addEventListener('pointermove', event => { if (from) this.#events.move(way, line, moved(event), false); });
    for (const end of ['pointerup', 'pointercancel'] as const) {
      element.addEventListener(end, event => {
        if (from) this.#events.move(way, line, end === 'pointerup' ? moved(event) : from.line, true);
        from = null;
      });
    }
    element.addEventListener('keydown', event => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const by = arrow(event)?.[isColumn ? 0 : 1];
      if (by) this.#events.move(way, line, this.#lattice[way][line]! + by / this.#size[isColumn ? 0 : 1], true);
      else if (event.key === 'Delete' || event.key === 'Backspace') this.#events.remove(way, line);
      else return;
      event.preventDefault();
    });
    return element;
  }
}
