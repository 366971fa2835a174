// The section plane. Cut bodies look solid: their back faces, visible only where they are cut open, are drawn in one flat
// colour.

import * as THREE from 'three';
import type { Chunk } from '../model/model.ts';
import type { Viewport } from './viewport.ts';

export type Axis = 'x' | 'y' | 'z';

export interface Cut {
  on: boolean;
  axis: Axis;
  /** Position along the axis, as a fraction of the model's extent. */
  at: number;
  /** Removes the near side of the axis instead of the far side. */
  flip: boolean;
}

export class Section {
  readonly cut: Cut = { on: false, axis: 'z', at: 0.5, flip: false };
  readonly plane = new THREE.Plane();
  /** Materials of overlays that are cut with the model. */
  readonly overlays: THREE.Material[] = [];
  #viewport: Viewport;
  #caps: THREE.Mesh[] = [];
  #cap = new THREE.MeshBasicMaterial({
    color: 0x8c3b2a, side: THREE.BackSide, clippingPlanes: [this.plane], toneMapped: false,
    polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 4, // Behind front faces in the same plane.
  });
  #of: unknown = null;

  constructor(viewport: Viewport) {
    this.#viewport = viewport;
    viewport.onModel.push(() => this.apply());
  }

  /** Changes the cut. */
  set(change: Partial<Cut>) {
    Object.assign(this.cut, change);
    this.apply();
    this.#viewport.refresh();
  }

  /** True if a point is not cut away. */
  keeps = (point: THREE.Vector3) => !this.cut.on || this.plane.distanceToPoint(point) > -1e-4;

  /** Position of the plane on its axis, metres in the page's frame. */
  position(): number {
    const { axis, at } = this.cut, box = this.#viewport.model?.box;
    return box ? box.min[axis] + (box.max[axis] - box.min[axis]) * at : 0;
  }

  apply() {
    const { on, axis, flip } = this.cut, { model } = this.#viewport;
    this.plane.normal.set(0, 0, 0)[axis] = flip ? 1 : -1;
    this.plane.constant = this.position() * (flip ? -1 : 1);
    const planes = on ? [this.plane] : null;
    for (const material of this.overlays) material.clippingPlanes = planes;
    for (const { mesh } of model?.chunks ?? []) {
      const { material } = mesh;
      if ((material.clippingPlanes !== null) !== on) material.needsUpdate = true;
      material.clippingPlanes = planes;
      material.clipShadows = on;
      material.shadowSide = on ? THREE.DoubleSide : null; // Light enters where a body is cut open.
    }
    const of = on ? model : null;
    if (this.#of === of) return;
    this.#of = of;
    for (const cap of this.#caps.splice(0)) cap.removeFromParent();
    for (const chunk of of?.chunks ?? []) {
      if (isSheet(chunk)) continue;
      const cap = new THREE.Mesh(chunk.mesh.geometry, this.#cap);
      cap.matrixAutoUpdate = false;
      chunk.mesh.add(cap); // Visible with its chunk.
      this.#caps.push(cap);
    }
  }

  /** Number of bodies drawn closed. */
  get caps(): number { return this.#caps.length; }
}

/** Sheets are double-sided already, and glass has no inside. */
const isSheet = ({ mesh: { material } }: Chunk) => material.side === THREE.DoubleSide || material.transparent;
