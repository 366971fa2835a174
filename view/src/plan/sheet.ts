// The drawing sheet of the plan: pan and zoom by touch, mouse and keyboard.

import { isField, s } from '../ui/dom.ts';
import type { XY } from './coordinates.ts';

export interface Frame { x: number; y: number; width: number; height: number }

/** True if a frame contains a rectangle. */
export const contains = (frame: Frame, { x, y, width, height }: Frame) =>
  x >= frame.x && y >= frame.y && x + width <= frame.x + frame.width && y + height <= frame.y + frame.height;

/** CSS pixels: width of the edge; room for the lengths beside and above a fitted rectangle, or a share where there is little. */
const EDGE = 6, BESIDE = 86, ABOVE = 38, SHARE = 0.3;

export class Sheet {
  readonly svg = s('svg', { class: 'sheet', tabindex: 0, role: 'group' });
  frame: Frame = { x: -5, y: -5, width: 10, height: 10 };
  /** True if a drag that begins on an element pans the sheet. */
  moves: (target: Element) => boolean = () => true;
  /** Called after a pan or zoom. */
  moved: () => void = () => {};
  #pointers = new Map<number, [x: number, y: number]>();
  /** The fitted rectangle, until the sheet is moved. */
  #fitted: Frame | null = null;

  constructor() {
    const { svg } = this;
    svg.addEventListener('wheel', event => {
      event.preventDefault();
      this.zoom(Math.exp(event.deltaY * 0.0015), this.place(event));
    }, { passive: false });
    svg.addEventListener('pointerdown', event => {
      if (!this.moves(event.target as Element)) return;
      this.#pointers.set(event.pointerId, [event.clientX, event.clientY]);
    });
    window.addEventListener('pointermove', event => this.#drag(event));
    for (const end of ['pointerup', 'pointercancel'] as const) window.addEventListener(end, ({ pointerId }) => this.#pointers.delete(pointerId));
    svg.addEventListener('keydown', event => {
      if (event.defaultPrevented || isField(event.target) || !this.key(event)) return;
      event.preventDefault();
    });
    new ResizeObserver(() => this.#fitted ? this.fit(this.#fitted) : this.apply()).observe(svg);
  }

  /** Fits a rectangle into view. */
  fit(all: Frame | null) {
    const { x, y, width, height } = this.#fitted = all ?? { x: -5, y: -5, width: 10, height: 10 };
    const box = this.svg.getBoundingClientRect(), [wide, high] = [box.width || 400, box.height || 400];
    const [beside, above] = [Math.min(BESIDE, wide * SHARE), Math.min(ABOVE, high * SHARE)];
    const pixel = Math.max(width / (wide - 2 * beside), height / (high - 2 * above), 0.002);
    this.frame = { x: x + (width - wide * pixel) / 2, y: y + (height - high * pixel) / 2, width: wide * pixel, height: high * pixel };
    this.apply();
  }

  /** Widens the view so that a rectangle is in it. */
  reveal(rectangle: Frame) {
    if (contains(this.frame, rectangle)) return;
    const edge = this.pixel * ABOVE, { x, y, width, height } = this.frame;
    const [x0, y0] = [Math.min(x, rectangle.x - edge), Math.min(y, rectangle.y - edge)];
    const x1 = Math.max(x + width, rectangle.x + rectangle.width + edge), y1 = Math.max(y + height, rectangle.y + rectangle.height + edge);
    this.#fitted = null;
    this.frame = { x: x0, y: y0, width: x1 - x0, height: y1 - y0 };
    this.apply();
  }

  /** Zooms by a factor; below 1 moves closer. */
  zoom(by: number, [x, y]: XY = this.#middle()) {
    this.#fitted = null;
    const { frame } = this, factor = Math.min(Math.max(by * frame.width, 0.5), 1e5) / frame.width;
    this.frame = {
      x: x + (frame.x - x) * factor, y: y + (frame.y - y) * factor, width: frame.width * factor, height: frame.height * factor,
    };
    this.apply();
  }

  pan(x: number, y: number) {
    this.#fitted = null;
    this.frame = { ...this.frame, x: this.frame.x + x, y: this.frame.y + y };
    this.apply();
  }

  /** Plan coordinates of a pointer. */
  place({ clientX, clientY }: { clientX: number; clientY: number }): XY {
    const matrix = this.svg.getScreenCTM();
    if (!matrix) return [0, 0];
    const { x, y } = new DOMPoint(clientX, clientY).matrixTransform(matrix.inverse());
    return [x, y];
  }

  /** The way in which a pointer at an edge of the sheet, or beyond it, points out of it: -1, 0 or 1 on each axis. */
  outOf({ clientX, clientY }: { clientX: number; clientY: number }): XY {
    const { left, top, right, bottom } = this.svg.getBoundingClientRect();
    const way = (at: number, low: number, high: number) => at < low + EDGE ? -1 : at > high - EDGE ? 1 : 0;
    return [way(clientX, left, right), way(clientY, top, bottom)];
  }

  /** Metres per pixel. */
  get pixel(): number {
    const { width, height } = this.svg.getBoundingClientRect();
    return width ? Math.max(this.frame.width / width, this.frame.height / height) : 0.01;
  }

  apply() {
    const { x, y, width, height } = this.frame;
    this.svg.setAttribute('viewBox', `${x} ${y} ${width} ${height}`);
    this.moved();
  }

  key({ key, ctrlKey, metaKey, altKey }: KeyboardEvent): boolean {
    if (ctrlKey || metaKey || altKey) return false;
    const step = Math.min(this.frame.width, this.frame.height) * 0.08;
    switch (key) {
      case 'ArrowLeft': this.pan(-step, 0); break;
      case 'ArrowRight': this.pan(step, 0); break;
      case 'ArrowUp': this.pan(0, -step); break;
      case 'ArrowDown': this.pan(0, step); break;
      case '+': case '=': this.zoom(1 / 1.2); break;
      case '-': case '_': this.zoom(1.2); break;
      default: return false;
    }
    return true;
  }

  #middle(): XY {
    const { x, y, width, height } = this.frame;
    return [x + width / 2, y + height / 2];
  }

  #drag(event: PointerEvent) {
    const before = this.#pointers.get(event.pointerId);
    if (!before) return;
    const others = [...this.#pointers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
    const now: [number, number] = [event.clientX, event.clientY];
    this.#pointers.set(event.pointerId, now);
    const pixel = this.pixel, other = others[0];
    if (!other) this.pan((before[0] - now[0]) * pixel, (before[1] - now[1]) * pixel);
    else {
      const far = (p: [number, number]) => Math.hypot(p[0] - other[0], p[1] - other[1]) || 1;
      this.zoom(far(before) / far(now), this.place({ clientX: (now[0] + other[0]) / 2, clientY: (now[1] + other[1]) / 2 }));
    }
  }
}
