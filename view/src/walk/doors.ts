// Doors and screens that a walker slides open: what of a door is below its lintel moves aside along its wall, before what stands
// beside it, and is in nobody's way there.

import * as THREE from 'three';
import type { App } from '../app.ts';
import { hit } from '../model/parts.ts';
import { type Model, rangesOf } from '../model/model.ts';
import { strings } from '../ui/strings.ts';

/** Codes of doors and screens; `TTB` is the box for shutters. */
const DOOR = /^T(?!TB)/;

/** As far as a hand reaches with a key, and with the pointer, metres. */
const NEAR = 1.6, FAR = 6;

/** Leaves are lower than this, metres. */
const LEAF = 1.95;

/** What a door leaves of its width, and how far it stands before what is beside it, metres. */
const LEFT = 0.04, BEFORE = 0.05;

/** How long a door slides, milliseconds. */
const SLIDES = 350;

/** The corners of a door in one mesh. */
interface Leaf {
  position: THREE.BufferAttribute;
  vertices: number[];
  /** Their places when the door is shut. */
  shut: Float32Array;
}

interface Moved {
  leaves: Leaf[];
  /** From shut to open. */
  way: THREE.Vector3;
  open: boolean;
  /** 0 shut, 1 open. */
  at: number;
}

export class Doors {
  #app: App;
  #model: Model | null = null;
  #moved = new Map<number, Moved>();
  #sliding = new Set<Moved>();
  #last = 0;

  constructor(app: App) {
    this.#app = app;
    app.on('model', () => this.shut());
  }

  /** True while one slides. */
  get busy(): boolean { return this.#sliding.size > 0; }

  /** Shuts all doors at once. */
  shut() {
    for (const moved of this.#moved.values()) place(moved, 0);
    this.#moved.clear();
    this.#sliding.clear();
    this.#model = null;
  }

  /** Slides the door that a walker faces; false if there is none. */
  use(ray: THREE.Raycaster): boolean { return this.#slide(this.faced(ray)); }

  /** The door that a walker faces; null if there is none within reach. */
  faced(ray: THREE.Raycaster): number | null { return this.#along(ray, NEAR) ?? this.#beside(ray); }

  /** Slides the door under a pointer; false if there is none. */
  press(ray: THREE.Raycaster): boolean { return this.#slide(this.#along(ray, FAR)); }

  #doors(): number[] {
    return this.#app.model?.parts.flatMap(({ kind, code, box }, part) => kind === 'part' && DOOR.test(code ?? '') && !box.isEmpty() ? [part] : []) ?? [];
  }

  /** The nearest door on a ray, before which nothing else stands; open ones count where they were shut. */
  #along(ray: THREE.Raycaster, reach: number): number | null {
    const { model } = this.#app, at = new THREE.Vector3();
    if (!model || this.#app.town.state) return null;
    let found: number | null = null, least = Math.min(reach, (hit(model, ray, () => true)?.distance ?? Infinity) + 0.15);
    for (const part of this.#doors()) {
      const far = ray.ray.intersectBox(model.parts[part]!.box, at)?.distanceTo(ray.ray.origin) ?? Infinity;
      if (far < least) { least = far; found = part; }
    }
    return found;
  }

  /** The nearest door before a walker who looks a little beside it. */
  #beside({ ray: { origin, direction } }: THREE.Raycaster): number | null {
    const { model } = this.#app, at = new THREE.Vector3();
    if (!model || this.#app.town.state) return null;
    let found: number | null = null, least = NEAR;
    for (const part of this.#doors()) {
      const { box } = model.parts[part]!;
      if (box.min.y > origin.y || box.max.y < origin.y - 1) continue; // On another storey.
      box.clampPoint(origin, at).sub(origin).setY(0);
      const far = at.length();
      if (far < least && (far < 0.3 || at.dot(direction) > 0.6 * far)) { least = far; found = part; }
    }
    return found;
  }

  #slide(part: number | null): boolean {
    const { model } = this.#app;
    if (part === null || !model) return false;
    if (this.#model !== model) { this.shut(); this.#model = model; }
    const moved = this.#moved.get(part) ?? movable(model, part);
    this.#moved.set(part, moved);
    moved.open = !moved.open;
    const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
    // A walker is stopped by a door as soon as it shuts, and goes on as soon as it is open.
    if (still) this.#put(moved, Number(moved.open));
    else {
      this.#sliding.add(moved);
      this.#last = performance.now();
      requestAnimationFrame(this.#step);
    }
    const { code, name } = model.parts[part]!, label = this.#app.names.get(code?.trim() ?? '') ?? code?.trim() ?? name;
    this.#app.announce(moved.open ? strings.doorOpened(label) : strings.doorShut(label));
    return true;
  }

  #step = (now: number) => {
    const by = Math.max(0, now - this.#last) / SLIDES;
    this.#last = now;
    for (const moved of this.#sliding) {
      this.#put(moved, THREE.MathUtils.clamp(moved.at + (moved.open ? by : -by), 0, 1));
      if (moved.at === Number(moved.open)) this.#sliding.delete(moved);
    }
    if (this.#sliding.size) requestAnimationFrame(this.#step);
  };

  #put(moved: Moved, at: number) {
    place(moved, at);
    this.#app.walk.forget();
    this.#app.viewport.refresh();
  }
}

function place(moved: Moved, at: number) {
  moved.at = at;
  for (const { position, vertices, shut } of moved.leaves) {
    for (const [i, vertex] of vertices.entries()) {
      position.setXYZ(vertex, shut[3 * i]! + moved.way.x * at, shut[3 * i + 1]! + moved.way.y * at, shut[3 * i + 2]! + moved.way.z * at);
    }
    position.needsUpdate = true;
  }
}

/** The leaves of a door, and the way that they slide. */
function movable(model: Model, part: number): Moved {
  const { box, facade } = model.parts[part]!, leaves: Leaf[] = [], size = box.getSize(new THREE.Vector3());
  for (const chunk of model.chunks) {
    const { geometry } = chunk.mesh, position = geometry.getAttribute('position') as THREE.BufferAttribute, index = geometry.index!, vertices = new Set<number>();
    for (const { start, count } of rangesOf(chunk, model.parts, part)) {
      for (let i = start; i < start + count; i += 3) {
        const corners = [0, 1, 2].map(k => index.getX(i + k));
        if (corners.reduce((sum, corner) => sum + position.getY(corner), 0) / 3 < box.min.y + LEAF) for (const corner of corners) vertices.add(corner);
      }
    }
    if (vertices.size) leaves.push({ position, vertices: [...vertices], shut: new Float32Array([...vertices].flatMap(v => [position.getX(v), position.getY(v), position.getZ(v)])) });
  }
  const wall = facade === null ? null : model.parts[facade]!;
  const front = wall?.front?.clone() ?? new THREE.Vector3(size.x < size.z ? 1 : 0, 0, size.x < size.z ? 0 : 1);
  const along = new THREE.Vector3(-front.z, 0, front.x);
  let [low, high] = [Infinity, -Infinity];
  for (const { shut } of leaves) {
    for (let i = 0; i < shut.length; i += 3) {
      const at = shut[i]! * along.x + shut[i + 2]! * along.z;
      [low, high] = [Math.min(low, at), Math.max(high, at)];
    }
  }
  const width = Math.max(0, high - low - LEFT), middle = box.getCenter(new THREE.Vector3());
  // To a side on which the wall goes on, rather not before another door: two that stood open side by side would shut each other.
  const beside = (side: number) => middle.clone().addScaledVector(along, side * width);
  const there = (side: number) => (wall?.box.distanceToPoint(beside(side)) ?? 0) < 0.1;
  const isDoor = (side: number) => model.parts.some(({ kind, code, box }, other) => other !== part && kind === 'part' && DOOR.test(code ?? '') && box.containsPoint(beside(side)));
  const worth = (side: number) => (there(side) ? 2 : 0) + (isDoor(side) ? 0 : 1);
  const way = along.clone().multiplyScalar(worth(1) >= worth(-1) ? width : -width).addScaledVector(front, BEFORE);
  return { leaves, way, open: false, at: 0 };
}
