// Measuring: a chain of points on surfaces, which snap to vertices nearby; the length of each stretch and of all.

import * as THREE from 'three';
import { h } from './dom.ts';
import { length_words } from './lengths.ts';
import type { Hit } from './parts.ts';
import type { Stage } from './stage.ts';

/** CSS pixels within which a point snaps to a vertex. */
const SNAP = 14;
const INK = 0xb5341f;

export class Measure {
  readonly points: THREE.Vector3[] = [];
  on = false;
  /** Told whenever the chain has changed. */
  changed: () => void = () => {};
  #stage: Stage;
  #line = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: INK, depthTest: false, toneMapped: false }));
  #dots = new THREE.Points(new THREE.BufferGeometry(), new THREE.PointsMaterial({
    color: INK, size: 8, sizeAttenuation: false, depthTest: false, toneMapped: false,
  }));
  /** Over the canvas; the labels are no controls, and the panel says the same in words. */
  readonly labels = h('div', { class: 'labels', 'aria-hidden': 'true' });

  constructor(stage: Stage) {
    this.#stage = stage;
    this.#line.frustumCulled = this.#dots.frustumCulled = false;
    this.#line.renderOrder = this.#dots.renderOrder = 10;
    stage.marks.add(this.#line, this.#dots);
    stage.on_frame.push(() => this.#place());
  }

  /** Adds a point where a surface was met; the nearest vertex round it takes its place. */
  add({ point }: Pick<Hit, 'point'>) {
    const { camera, canvas, model } = this.#stage;
    // So far a few pixels are at its distance.
    const pixel = 2 * Math.tan(camera.fov / 2 * Math.PI / 180) * camera.position.distanceTo(point) / canvas.clientHeight;
    const round = new THREE.Sphere(point, SNAP * pixel), vertex = new THREE.Vector3();
    let best = point, least = SNAP;
    const there = this.#pixels(point);
    for (const { mesh, box } of model?.chunks ?? []) {
      if (!mesh.visible || !box.intersectsSphere(round)) continue;
      const position = mesh.geometry.getAttribute('position');
      for (let i = 0; i < position.count; i++) {
        if (!round.containsPoint(vertex.fromBufferAttribute(position, i))) continue;
        const far = this.#pixels(vertex).distanceTo(there);
        if (far < least) { least = far; best = vertex.clone(); }
      }
    }
    this.points.push(best.clone());
    this.#draw();
  }

  undo() {
    this.points.pop();
    this.#draw();
  }

  clear() {
    this.points.length = 0;
    this.#draw();
  }

  /** Metres from each point to the next. */
  stretches(): number[] {
    return this.points.slice(1).map((p, i) => p.distanceTo(this.points[i]!));
  }

  total(): number {
    return this.stretches().reduce((sum, length) => sum + length, 0);
  }

  /** Where a point is drawn, CSS pixels. */
  #pixels(point: THREE.Vector3): THREE.Vector2 {
    const { canvas, camera } = this.#stage, { x, y } = point.clone().project(camera);
    return new THREE.Vector2((x + 1) / 2 * canvas.clientWidth, (1 - y) / 2 * canvas.clientHeight);
  }

  #draw() {
    for (const object of [this.#line, this.#dots]) {
      object.geometry.dispose();
      object.geometry = new THREE.BufferGeometry().setFromPoints(this.points);
      object.visible = this.points.length > 0;
    }
    this.labels.replaceChildren(...this.stretches().map(length => {
      const { metres, shaku } = length_words(length);
      return h('span', {}, `${metres} · ${shaku}`);
    }));
    this.changed();
    this.#stage.draw();
  }

  #place() {
    const { camera } = this.#stage;
    for (const [i, label] of ([...this.labels.children] as HTMLElement[]).entries()) {
      const middle = this.points[i]!.clone().lerp(this.points[i + 1]!, 0.5);
      const { x, y } = this.#pixels(middle);
      label.hidden = middle.clone().applyMatrix4(camera.matrixWorldInverse).z > 0;
      label.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -130%)`;
    }
  }
}
