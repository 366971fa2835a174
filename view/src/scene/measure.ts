// Measuring: a chain of points on surfaces that snap to nearby vertices, with the length of each segment and the total.

import * as THREE from 'three';
import { h } from '../ui/dom.ts';
import { formatLength } from '../ui/lengths.ts';
import { trianglesIn } from '../walk/surfaces.ts';
import type { Viewport } from './viewport.ts';

/** Snap radius, CSS pixels. */
const SNAP = 14;
const INK = 0xb5341f;

export class Measure {
  readonly points: THREE.Vector3[] = [];
  on = false;
  /** Called when the chain changes. */
  changed: () => void = () => {};
  #viewport: Viewport;
  #meshes: () => Iterable<THREE.Mesh>;
  #line = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: INK, depthTest: false, toneMapped: false }));
  #dots = new THREE.Points(new THREE.BufferGeometry(), new THREE.PointsMaterial({
    color: INK, size: 8, sizeAttenuation: false, depthTest: false, toneMapped: false,
  }));
  /** Labels over the canvas; the panel lists the same lengths as text. */
  readonly labels = h('div', { class: 'labels', 'aria-hidden': 'true' });

  constructor(viewport: Viewport, meshes: () => Iterable<THREE.Mesh>) {
    this.#viewport = viewport;
    this.#meshes = meshes;
    this.#line.frustumCulled = this.#dots.frustumCulled = false;
    this.#line.renderOrder = this.#dots.renderOrder = 10;
    viewport.marks.add(this.#line, this.#dots);
    viewport.onFrame.push(() => this.#place());
  }

  /** Adds a point on a surface, snapped to the nearest vertex within the radius. */
  add(point: THREE.Vector3) {
    const { camera, canvas } = this.#viewport;
    // Size of a pixel at the point's distance.
    const pixel = 2 * Math.tan(camera.fov / 2 * Math.PI / 180) * camera.position.distanceTo(point) / canvas.clientHeight;
    const round = new THREE.Sphere(point, SNAP * pixel), vertex = new THREE.Vector3();
    let best = point, least = SNAP;
    const there = this.#pixels(point);
    const corners = trianglesIn(round.getBoundingBox(new THREE.Box3()), this.#meshes());
    for (let i = 0; i < corners.length; i += 3) {
      if (!round.containsPoint(vertex.fromArray(corners, i))) continue;
      const far = this.#pixels(vertex).distanceTo(there);
      if (far < least) { least = far; best = vertex.clone(); }
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

  /** Segment lengths, metres. */
  segments(): number[] {
    return this.points.slice(1).map((p, i) => p.distanceTo(this.points[i]!));
  }

  total(): number {
    return this.segments().reduce((sum, length) => sum + length, 0);
  }

  /** Projects a point to CSS pixels of the canvas. */
  #pixels(point: THREE.Vector3): THREE.Vector2 {
    const { canvas, camera } = this.#viewport, { x, y } = point.clone().project(camera);
    return new THREE.Vector2((x + 1) / 2 * canvas.clientWidth, (1 - y) / 2 * canvas.clientHeight);
  }

  #draw() {
    for (const object of [this.#line, this.#dots]) {
      object.geometry.dispose();
      object.geometry = new THREE.BufferGeometry().setFromPoints(this.points);
      object.visible = this.points.length > 0;
    }
    this.labels.replaceChildren(...this.segments().map(length => {
      const { metres, shaku } = formatLength(length);
      return h('span', {}, `${metres} · ${shaku}`);
    }));
    this.changed();
    this.#viewport.draw();
  }

  #place() {
    const { camera } = this.#viewport;
    for (const [i, label] of ([...this.labels.children] as HTMLElement[]).entries()) {
      const middle = this.points[i]!.clone().lerp(this.points[i + 1]!, 0.5);
      const { x, y } = this.#pixels(middle);
      label.hidden = middle.clone().applyMatrix4(camera.matrixWorldInverse).z > 0;
      label.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -130%)`;
    }
  }
}
