// The photograph: four corners that are dragged or moved by keys, and a mask that is painted over what stands before the wall.

import type { Marked, Photograph, Place, Stroke } from '../server/front.ts';
import { photoUrl } from '../server/front.ts';
import { h, newId, s } from '../ui/dom.ts';
import { strings } from '../ui/strings.ts';
import { Loupe } from './loupe.ts';

export type Tool = 'corners' | 'brush' | 'eraser';

/** What is beside the photograph, as a part of it: corners may lie there, and those that lie further off are seen up to a limit. */
const MARGIN = 0.04, BEYOND = 0.5;
/** Radius of a corner, CSS pixels. */
const CORNER = 9;
/** How far a key leads the brush, as a part of its width; how much further with Shift. */
const STEP = 0.25, FURTHER = 10;

const ARROWS: Record<string, Place> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/** How an arrow key moves, with Shift ten times as far; null for other keys. */
export const arrow = ({ key, shiftKey }: KeyboardEvent): Place | null => {
  const way = ARROWS[key], by = shiftKey ? FURTHER : 1;
  return way ? [way[0] * by, way[1] * by] : null;
};

export interface PhotoEvents {
  /** A corner is moved; `done` ends a drag. */
  corner: (corner: number, at: Place, done: boolean) => void;
  /** A stroke was painted. */
  stroke: (stroke: Stroke) => void;
  /** The brush was made wider, or narrower. */
  widen: (by: number) => void;
  announce: (text: string) => void;
}

export class PhotoSheet {
  readonly element = h('div', { class: 'photo-sheet' });
  readonly svg = s('svg', { class: 'photo', tabindex: 0, role: 'group' });
  tool: Tool = 'corners';
  /** The width of the brush, pixels of the photograph. */
  width = 40;
  #events: PhotoEvents;
  #photo: Photograph | null = null;
  #marked: Marked | null = null;
  #number = 0;
  #scale = 1;
  #loupe = new Loupe();
  #image = s('image', {});
  #mask = s('mask', { id: newId(), maskUnits: 'userSpaceOnUse' });
  #veil = s('rect', { class: 'veil', mask: `url(#${this.#mask.id})` });
  #wall = s('polygon', { class: 'wall' });
  #brush = s('circle', { class: 'brush' });
  #corners = [0, 1, 2, 3].map(corner => this.#corner(corner));
  /** The stroke that is being painted, by the pointer or by keys. */
  #stroke: Stroke | null = null;
  #place: Place = [0, 0];

  constructor(events: PhotoEvents) {
    this.#events = events;
    this.svg.append(s('defs', {}, this.#mask), this.#image, this.#veil, this.#wall, ...this.#corners, this.#brush);
    this.element.append(this.svg, this.#loupe.element);
    this.svg.addEventListener('pointerdown', event => this.#paint(event));
    this.svg.addEventListener('pointermove', event => { if (this.tool !== 'corners') this.#lead(this.at(event)); });
    this.svg.addEventListener('pointerleave', () => { if (!this.#stroke && document.activeElement !== this.svg) this.#brush.toggleAttribute('hidden', true); });
    this.svg.addEventListener('keydown', event => this.#key(event));
    for (const change of ['focus', 'blur'] as const) this.svg.addEventListener(change, () => { if (change === 'blur') this.#lift(); this.#drawBrush(); });
    new ResizeObserver(() => this.#draw()).observe(this.element);
  }

  /** Shows a photograph with what is told of it. */
  show(number: number, photo: Photograph, marked: Marked) {
    const [width, height] = photo.size, url = photoUrl(number);
    if (this.#photo !== photo) {
      for (const [name, value] of Object.entries({ href: url, width, height })) this.#image.setAttribute(name, `${value}`);
      for (const area of [this.#mask, this.#veil]) for (const [name, value] of Object.entries({ x: 0, y: 0, width, height })) area.setAttribute(name, `${value}`);
      const edge = MARGIN * Math.max(width, height), span = (most: number, axis: 0 | 1) => {
        const places = marked.corners.map(at => Math.min(Math.max(at[axis], -BEYOND * most), (1 + BEYOND) * most));
        const [least, last] = [Math.min(0, ...places) - edge, Math.max(most, ...places) + edge];
        return [least, last - least] as const;
      };
      const [x, wide] = span(width, 0), [y, high] = span(height, 1);
      this.svg.setAttribute('viewBox', `${x} ${y} ${wide} ${high}`);
      this.#place = [width / 2, height / 2];
    }
    [this.#number, this.#photo, this.#marked] = [number, photo, marked];
    this.svg.setAttribute('aria-label', strings.photos.sheet(photo.name));
    this.#draw();
  }

  choose(tool: Tool) {
    this.#lift();
    this.tool = tool;
    this.svg.dataset['tool'] = tool;
    this.#drawBrush();
  }

  /** The place of the photograph under the pointer. */
  at({ clientX, clientY }: { clientX: number; clientY: number }): Place {
    const matrix = this.svg.getScreenCTM();
    if (!matrix) return [0, 0];
    const { x, y } = new DOMPoint(clientX, clientY).matrixTransform(matrix.inverse());
    return [x, y];
  }

  #corner(corner: number): SVGGElement {
    const handle = s('g', { class: 'corner', tabindex: 0, role: 'button', 'data-corner': corner }, s('circle', { class: 'grip' }), s('circle', { class: 'dot' }));
    let from: { pointer: Place; corner: Place } | null = null;
    const moved = (event: PointerEvent): Place => {
      const now = this.at(event), by = event.shiftKey ? 0.1 : 1;
      return [from!.corner[0] + (now[0] - from!.pointer[0]) * by, from!.corner[1] + (now[1] - from!.pointer[1]) * by];
    };
    handle.addEventListener('pointerdown', event => {
      if (this.tool !== 'corners' || event.button !== 0) return;
      event.preventDefault();
      handle.focus();
      handle.setPointerCapture(event.pointerId);
      from = { pointer: this.at(event), corner: this.#marked!.corners[corner]! };
    });
    handle.addEventListener('pointermove', event => { if (from) this.#events.corner(corner, moved(event), false); });
    for (const end of ['pointerup', 'pointercancel'] as const) {
      handle.addEventListener(end, event => {
        if (from) this.#events.corner(corner, end === 'pointerup' ? moved(event) : from.corner, true);
        from = null;
      });
    }
    handle.addEventListener('keydown', event => {
      const by = arrow(event), at = this.#marked?.corners[corner];
      if (!by || !at || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      event.stopPropagation();
      this.#events.corner(corner, [at[0] + by[0], at[1] + by[1]], true);
      this.#events.announce(this.#told(corner));
    });
    for (const change of ['focus', 'blur'] as const) handle.addEventListener(change, () => this.#draw());
    return handle;
  }

  #told(corner: number): string {
    const [x, y] = this.#marked!.corners[corner]!;
    return strings.photos.corner(strings.photos.cornerName[corner]!, x.toFixed(1), y.toFixed(1));
  }

  #draw() {
    const marked = this.#marked, photo = this.#photo, matrix = this.svg.getScreenCTM();
    if (!marked || !photo || !matrix?.a) return;
    this.#scale = matrix.a;
    const { corners } = marked;
    this.#wall.setAttribute('points', corners.map(at => at.join(',')).join(' '));
    this.#corners.forEach((handle, i) => {
      const [x, y] = corners[i]!;
      handle.setAttribute('transform', `translate(${x} ${y}) scale(${1 / this.#scale})`);
      handle.firstElementChild!.setAttribute('r', `${CORNER}`);
      handle.lastElementChild!.setAttribute('r', '1.5');
      handle.setAttribute('aria-label', this.#told(i));
    });
    this.#drawMask();
    this.#drawBrush();
    const held = this.#corners.indexOf(document.activeElement as SVGGElement);
    if (held < 0) return this.#loupe.hide();
    const box = this.element.getBoundingClientRect(), [x, y] = corners[held]!;
    const at: Place = [matrix.a * x + matrix.e - box.left, matrix.d * y + matrix.f - box.top];
    this.#loupe.show(photoUrl(this.#number), photo, corners, held, { scale: this.#scale, at, wide: box.width, high: box.height });
  }

  #drawMask() {
    const strokes = [...this.#marked!.mask, ...this.#stroke ? [this.#stroke] : []];
    const drawn = strokes.map(({ erases, width, points }) => s('path', {
      d: `M${points.map(at => at.join(',')).join('L')}${points.length === 1 ? 'l0,0' : ''}`, fill: 'none', stroke: erases ? 'black' : 'white',
      'stroke-width': width, 'stroke-linecap': 'round', 'stroke-linejoin': 'round',
    }));
    this.#mask.replaceChildren(...drawn);
    this.#veil.toggleAttribute('hidden', !strokes.length);
  }

  #drawBrush() {
    const [x, y] = this.#place;
    for (const [name, value] of Object.entries({ cx: x, cy: y, r: this.width / 2 })) this.#brush.setAttribute(name, `${value}`);
    this.#brush.classList.toggle('down', this.#stroke !== null);
    this.#brush.toggleAttribute('hidden', this.tool === 'corners' || !(this.#stroke || this.svg.matches(':hover') || document.activeElement === this.svg));
  }

  #paint(event: PointerEvent) {
    if (this.tool === 'corners' || event.button !== 0) return;
    event.preventDefault();
    this.svg.focus();
    this.svg.setPointerCapture(event.pointerId);
    this.#lower(this.at(event));
    const end = () => {
      for (const name of ['pointerup', 'pointercancel'] as const) this.svg.removeEventListener(name, end);
      this.#lift();
    };
    for (const name of ['pointerup', 'pointercancel'] as const) this.svg.addEventListener(name, end);
  }

  #lower(at: Place) {
    this.#place = at;
    this.#stroke = { erases: this.tool === 'eraser', width: this.width, points: [rounded(at)] };
    this.#drawMask();
    this.#drawBrush();
  }

  /** Leads the brush to a place. */
  #lead(at: Place) {
    this.#place = at;
    const points = this.#stroke?.points, last = points?.at(-1);
    if (last && Math.hypot(at[0] - last[0], at[1] - last[1]) > this.width / 16) {
      points!.push(rounded(at));
      this.#drawMask();
    }
    this.#drawBrush();
  }

  #lift() {
    const stroke = this.#stroke;
    if (!stroke) return;
    this.#stroke = null;
    this.#events.stroke(stroke);
  }

  #key(event: KeyboardEvent) {
    if (event.target !== this.svg || this.tool === 'corners' || event.ctrlKey || event.metaKey || event.altKey) return;
    const by = arrow(event), { key } = event;
    if (by) {
      const [width, height] = this.#photo!.size, inside = (at: number, most: number) => Math.min(Math.max(at, 0), most);
      this.#lead([inside(this.#place[0] + by[0] * STEP * this.width, width), inside(this.#place[1] + by[1] * STEP * this.width, height)]);
    } else if (key === ' ' || key === 'Enter') {
      if (this.#stroke) this.#lift(); else this.#lower(this.#place);
      this.#events.announce(this.#stroke ? strings.photos.brushDown : strings.photos.brushUp);
    } else if (key === '[' || key === ']') this.#events.widen(key === ']' ? 1.25 : 0.8);
    else if (key === 'Escape' && this.#stroke) this.#lift();
    else return;
    event.preventDefault();
  }
}

const rounded = ([x, y]: Place): Place => [Math.round(x * 10) / 10, Math.round(y * 10) / 10];
