// Highlights parts with a tint on their surfaces and with their edges, which show faintly through whatever is in front.

import * as THREE from 'three';
import type { Model } from '../model/model.ts';
import { shapeOf } from '../model/parts.ts';
import type { Viewport } from './viewport.ts';

/** A highlight of one colour. */
export class Highlight {
  #group = new THREE.Group();
  #viewport: Viewport;
  #tint: THREE.MeshBasicMaterial;
  #through: THREE.LineBasicMaterial;
  parts: number[] = [];

  constructor(viewport: Viewport, name: string, colour: number) {
    this.#viewport = viewport;
    this.#group.name = name;
    this.#tint = new THREE.MeshBasicMaterial({
      color: colour, transparent: true, opacity: 0.42, depthWrite: false, polygonOffset: true, polygonOffsetFactor: -2,
      polygonOffsetUnits: -2, toneMapped: false,
    });
    this.#through = new THREE.LineBasicMaterial({ color: colour, depthTest: false, transparent: true, opacity: 0.75, toneMapped: false });
    viewport.marks.add(this.#group);
  }

  /** Highlights exactly these parts. */
  set(model: Model | null, parts: number[]) {
    if (!parts.length && !this.parts.length) return;
    this.parts = parts;
    this.#replace((model ? parts.slice(0, 400) : []).flatMap(part => shapeOf(model!, part) ?? []), edgesOf);
  }

  /** Highlights whole houses, which have too many edges, or other shapes that are no parts of a model. */
  show(shapes: THREE.BufferGeometry[]) {
    if (!shapes.length && !this.drawn) return;
    this.parts = [];
    this.#replace(shapes, boxOf);
  }

  #replace(shapes: THREE.BufferGeometry[], edgesOf: (shape: THREE.BufferGeometry) => THREE.BufferGeometry) {
    for (const child of [...this.#group.children] as (THREE.Mesh | THREE.LineSegments)[]) {
      child.geometry.dispose();
      child.removeFromParent();
    }
    for (const shape of shapes) {
      this.#group.add(new THREE.Mesh(shape, this.#tint), new THREE.LineSegments(edgesOf(shape), this.#through));
    }
    this.#viewport.draw();
  }

  /** The materials of its marks. */
  get materials(): THREE.Material[] { return [this.#tint, this.#through]; }

  /** Number of drawn marks. */
  get drawn(): number { return this.#group.children.length; }
}

/** The edges of a shape; those of its bounding box where there are too many. */
function edgesOf(shape: THREE.BufferGeometry): THREE.BufferGeometry {
  return shape.getAttribute('position').count < 6000 ? new THREE.EdgesGeometry(shape, 40) : boxOf(shape);
}

/** The edges of the bounding box of a shape. */
function boxOf(shape: THREE.BufferGeometry): THREE.BufferGeometry {
  shape.computeBoundingBox();
  const box = shape.boundingBox!, size = box.getSize(new THREE.Vector3()), middle = box.getCenter(new THREE.Vector3());
  const cuboid = new THREE.BoxGeometry(size.x, size.y, size.z).translate(middle.x, middle.y, middle.z);
  return new THREE.EdgesGeometry(cuboid);
}
