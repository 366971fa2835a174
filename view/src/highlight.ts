// Lights up parts: a tint over their surfaces and their edges drawn, above whatever stands before them only faintly.

import * as THREE from 'three';
import type { Model } from './model.ts';
import { shape_of } from './parts.ts';
import type { Stage } from './stage.ts';

/** One colour of marks on a stage. */
export class Highlight {
  #group = new THREE.Group();
  #stage: Stage;
  #tint: THREE.MeshBasicMaterial;
  #through: THREE.LineBasicMaterial;
  parts: number[] = [];

  constructor(stage: Stage, name: string, colour: number) {
    this.#stage = stage;
    this.#group.name = name;
    this.#tint = new THREE.MeshBasicMaterial({
      color: colour, transparent: true, opacity: 0.42, depthWrite: false, polygonOffset: true, polygonOffsetFactor: -2,
      polygonOffsetUnits: -2, toneMapped: false,
    });
    this.#through = new THREE.LineBasicMaterial({ color: colour, depthTest: false, transparent: true, opacity: 0.75, toneMapped: false });
    stage.marks.add(this.#group);
  }

  /** Lights up these parts and no others. */
  set(model: Model | null, parts: number[]) {
    if (!parts.length && !this.parts.length) return;
    for (const child of [...this.#group.children] as (THREE.Mesh | THREE.LineSegments)[]) {
      child.geometry.dispose();
      child.removeFromParent();
    }
    this.parts = parts;
    for (const part of model ? parts.slice(0, 400) : []) {
      const shape = shape_of(model!, part);
      if (!shape) continue;
      this.#group.add(new THREE.Mesh(shape, this.#tint), new THREE.LineSegments(edges_of(shape), this.#through));
    }
    this.#stage.draw();
  }

  /** How many marks are drawn. */
  get drawn(): number { return this.#group.children.length; }
}

/** The edges of a shape; those of its box where it is too fine to draw all. */
function edges_of(shape: THREE.BufferGeometry): THREE.BufferGeometry {
  if (shape.getAttribute('position').count < 6000) return new THREE.EdgesGeometry(shape, 40);
  shape.computeBoundingBox();
  const box = shape.boundingBox!, size = box.getSize(new THREE.Vector3()), middle = box.getCenter(new THREE.Vector3());
  const cuboid = new THREE.BoxGeometry(size.x, size.y, size.z).translate(middle.x, middle.y, middle.z);
  return new THREE.EdgesGeometry(cuboid);
}
