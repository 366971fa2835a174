// The drawing sheet of the plan: pan and zoom by touch, mouse and keyboard.

import { isField, s } from '../ui/dom.ts';
import type { XY } from './coordinates.ts';

export interface Frame { x: number; y: number; width: number; height: number }

export class Sheet {
  readonly svg = s('svg', { class: 'sheet', tabindex: 0, role: 'group' });
  frame: Frame = { x: -5, y: -5, width: 10, height: 10 };
  /** True if a drag that begins on an element pans the sheet. */
  moves: (target: Element) => boolean = () => true;
  /** Called after a pan or zoom. */
  moved: () => void = () => {};
  #pointers = new Map<number, [x: number, y: number]>();

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
    new ResizeObserver(() => this.apply()).observe(svg);
  }

  /** Fits a rectangle into view. */
  fit(all: Frame | null) {
    const { x, y, width, height } = all ?? { x: -5, y: -5, width: 10, height: 10 };
    const edge = Math.max(width, height, 2) * 0.14;
    this.frame = { x: x - edge, y: y - edge, width: width + 2 * edge, height: height + 2 * edge };
    this.apply();
  }

  /** Zooms by a factor; below 1 moves closer. */
  zoom(by: number, [x, y]: XY = this.#middle()) {
    const { frame } = this, factor = Math.min(Math.max(by * frame.width, 0.5), 1e5) / frame.width;
    this.frame = {
      x: x + (frame.x - x) * factor, y: y + (frame.y - y) * factor, width: frame.width * factor, height: frame.height * factor,
    };
    this.apply();
  }

  pan(x: number, y: number) {
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
