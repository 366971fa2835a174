// A bounding volume hierarchy: finds what lies in a beam without testing everything.

import * as THREE from 'three';

/** Largest number of boxes in a leaf. */
const LEAF = 4;

type Node = { box: THREE.Box3 } & ({ items: number[] } | { low: Node; high: Node });

/** An item with a bounding box. */
export interface Boxed {
  box: THREE.Box3;
}

export class BoxTree<T extends Boxed> {
  /** Boxes tested since the tree was built. */
  tested = 0;
  #items: T[];
  #root: Node | null;

  constructor(items: T[]) {
    this.#items = items.filter(item => !item.box.isEmpty());
    const all = this.#items.map((_, i) => i);
    this.#root = all.length === 0 ? null : this.#node(all);
  }

  /** The items whose boxes touch the space in front of all planes. */
  within(planes: THREE.Plane[]): T[] {
    const found: T[] = [];
    if (this.#root) this.#visit(this.#root, planes, found);
    return found;
  }

  #node(items: number[]): Node {
    const box = new THREE.Box3(), middles = new THREE.Box3(), middle = new THREE.Vector3();
    for (const i of items) {
      const own = this.#items[i]!.box;
      box.union(own);
      middles.expandByPoint(own.getCenter(middle));
    }
    if (items.length <= LEAF) return { box, items };
    const { x, y, z } = middles.getSize(middle);
    const axis = x >= y && x >= z ? 'x' : y >= z ? 'y' : 'z';
    const place = (i: number) => this.#items[i]!.box.min[axis] + this.#items[i]!.box.max[axis];
    const sorted = [...items].sort((a, b) => place(a) - place(b) || a - b), half = sorted.length >> 1;
    return { box, low: this.#node(sorted.slice(0, half)), high: this.#node(sorted.slice(half)) };
  }

  #visit(node: Node, planes: THREE.Plane[], found: T[]) {
    const left = this.#crossed(node.box, planes);
    if (!left) return;
    if ('items' in node) {
      for (const i of node.items) {
        const item = this.#items[i]!;
        if (left.length === 0 || this.#crossed(item.box, left)) found.push(item);
      }
    } else {
      this.#visit(node.low, left, found);
      this.#visit(node.high, left, found);
    }
  }

  /** The planes that cross a box; null if it lies entirely behind one. */
  #crossed(box: THREE.Box3, planes: THREE.Plane[]): THREE.Plane[] | null {
    this.tested++;
    const left: THREE.Plane[] = [];
    for (const plane of planes) {
      const { normal, constant } = plane;
      const reach = (sign: number) => constant
        + normal.x * (normal.x * sign > 0 ? box.max.x : box.min.x)
        + normal.y * (normal.y * sign > 0 ? box.max.y : box.min.y)
        + normal.z * (normal.z * sign > 0 ? box.max.z : box.min.z);
      if (reach(1) < 0) return null;
      if (reach(-1) < 0) left.push(plane);
    }
    return left;
  }
}
