// The scan that a house was read from, under its plan.

import { type ScanSheet, type State, scanUrl } from '../server/api.ts';
import { checkbox, field, h, s } from '../ui/dom.ts';
import { strings } from '../ui/strings.ts';
import { metresToPlan } from './coordinates.ts';

export class ScanLayer {
  readonly element = s('g', { class: 'scan', 'aria-hidden': 'true' });
  readonly controls: HTMLElement;
  #svg: SVGSVGElement;
  #on = checkbox(strings.scan, true, () => this.#light());
  #opacity = h('input', { type: 'range', min: 0, max: 1, step: 0.05, value: 0.7, 'data-scan': 'opacity', oninput: () => this.#light() });
  /** The pictures, so that a change of the text loads none again. */
  #pictures = new Map<string, SVGImageElement>();

  constructor(svg: SVGSVGElement) {
    this.#svg = svg;
    this.#on.box.dataset.scan = 'on';
    this.controls = h('div', { class: 'scan-controls', hidden: true }, this.#on, field(strings.scanOpacity, this.#opacity));
  }

  /** Shows the scan of a storey; it belongs to the first house. */
  show({ file, plan, scan }: State, storey: number) {
    const house = plan.houses[0], before = this.#pictures;
    this.#pictures = new Map();
    const sheets = house ? scan?.sheets.filter(sheet => sheet.storey === storey) ?? [] : [];
    this.element.replaceChildren(...sheets.map(sheet => {
      const url = scanUrl(file, sheet), image = before.get(url) ?? picture(url, sheet);
      image.setAttribute('transform', `matrix(${metresToPlan(house!, sheet.to_house).join(' ')})`);
      this.#pictures.set(url, image);
      return image;
    }));
    this.controls.hidden = !scan?.sheets.length;
    this.#light();
  }

  #light() {
    const { checked } = this.#on.box;
    this.element.style.display = checked ? '' : 'none';
    this.element.style.opacity = this.#opacity.value;
    this.#opacity.disabled = !checked;
    // Floors would cover it.
    this.#svg.classList.toggle('scanned', checked && this.element.childElementCount > 0);
  }
}

const picture = (href: string, { size: [width, height] }: ScanSheet) => s('image', { href, width, height, preserveAspectRatio: 'none' });
