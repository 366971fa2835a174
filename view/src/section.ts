// The section: a plane that cuts the model. What it opens looks solid, since the backs of surfaces, which show only where
// a body is cut open, are drawn in one flat colour.

import * as THREE from 'three';
import type { Chunk } from './model.ts';
import type { Stage } from './stage.ts';

export type Axis = 'x' | 'y' | 'z';

export interface Cut {
  on: boolean;
  axis: Axis;
  /** Share of the model's extent along the axis. */
  at: number;
  /** Which side is taken away: the far one of the axis, or the near one. */
  flip: boolean;
}

export class Section {
  readonly cut: Cut = { on: false, axis: 'z', at: 0.5, flip: false };
  readonly plane = new THREE.Plane();
  #stage: Stage;
  #caps: THREE.Mesh[] = [];
  #cap = new THREE.MeshBasicMaterial({
    color: 0x8c3b2a, side: THREE.BackSide, clippingPlanes: [this.plane], toneMapped: false,
    polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 4, // behind fronts in the same plane
  });
  #of: unknown = null;

  constructor(stage: Stage) {
    this.#stage = stage;
    stage.on_model.push(() => this.apply());
  }

  /** Changes the cut. */
  set(change: Partial<Cut>) {
    Object.assign(this.cut, change);
    this.apply();
    this.#stage.refresh();
  }

  /** Whether a point is not cut away. */
  keeps = (point: THREE.Vector3) => !this.cut.on || this.plane.distanceToPoint(point) > -1e-4;

  /** Where the plane stands on its axis, metres in the frame of the page. */
  position(): number {
    const { axis, at } = this.cut, box = this.#stage.model?.box;
    return box ? box.min[axis] + (box.max[axis] - box.min[axis]) * at : 0;
  }

  apply() {
    const { on, axis, flip } = this.cut, { model } = this.#stage;
    this.plane.normal.set(0, 0, 0)[axis] = flip ? 1 : -1;
    this.plane.constant = this.position() * (flip ? -1 : 1);
    const planes = on ? [this.plane] : null;
    for (const { mesh } of model?.chunks ?? []) {
      const { material } = mesh;
      if ((material.clippingPlanes !== null) !== on) material.needsUpdate = true;
      material.clippingPlanes = planes;
      material.clipShadows = on;
      material.shadowSide = on ? THREE.DoubleSide : null; // light comes in where a body is open
    }
    const of = on ? model : null;
    if (this.#of === of) return;
    this.#of = of;
    for (const cap of this.#caps.splice(0)) cap.removeFromParent();
    for (const chunk of of?.chunks ?? []) {
      if (is_sheet(chunk)) continue;
      const cap = new THREE.Mesh(chunk.mesh.geometry, this.#cap);
      cap.matrixAutoUpdate = false;
      chunk.mesh.add(cap); // shown as long as the chunk is
      this.#caps.push(cap);
    }
  }

  /** Bodies that are drawn closed. */
  get caps(): number { return this.#caps.length; }
}

/** Both sides of a sheet are drawn already, and glass has no inside. */
const is_sheet = ({ mesh: { material } }: Chunk) => material.side === THREE.DoubleSide || material.transparent;
