// Doors and screens that a walker opens: what of a door is below its lintel slides aside along its wall, before what stands
// beside it, and is in nobody's way there. A roller shutter goes up into its box.

import * as THREE from 'three';
import { hit } from '../model/parts.ts';
import { type Model, type Part, rangesOf } from '../model/model.ts';
import type { Viewport } from '../scene/viewport.ts';
import type { PageState } from '../state.ts';
import type { Town } from '../town/town.ts';
import { strings } from '../ui/strings.ts';

/** The box for shutters, which stays, and shutters that are rolled up. */
const BOX = 'TTB', ROLLED = /^NSH/;

/** As wide as a guide of rolled shutters at most, and as high as they are when rolled up, metres. */
const GUIDE = 0.09, ROLL = 0.02;

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
  /** Their places when the door is shut, and when it is open. */
  shut: Float32Array;
  opened: Float32Array;
}

interface Moved {
  leaves: Leaf[];
  open: boolean;
  /** 0 shut, 1 open. */
  at: number;
}

export class Doors {
  /** Called when a door has moved. */
  onMoved: () => void = () => {};
  #state: PageState;
  #viewport: Viewport;
  #town: Town;
  #model: Model | null = null;
  #moved = new Map<number, Moved>();
  #sliding = new Set<Moved>();
  #last = 0;

  constructor(state: PageState, viewport: Viewport, town: Town) {
    this.#state = state;
    this.#viewport = viewport;
    this.#town = town;
    state.on('model', () => this.shut());
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

  /** The parts that are doors. */
  get all(): number[] { return this.#state.model?.parts.flatMap((door, part) => this.#opens(door) ? [part] : []) ?? []; }

  #opens({ kind, code, box }: Part): boolean {
    const known = code?.trim() ?? '';
    return kind === 'part' && this.#state.doors.has(known) && !known.startsWith(BOX) && !box.isEmpty();
  }

  /** The nearest door on a ray, before which nothing else stands; open ones count where they were shut. */
  #along(ray: THREE.Raycaster, reach: number): number | null {
    const { model } = this.#state, at = new THREE.Vector3();
    if (!model || this.#town.state) return null;
    let found: number | null = null, least = Math.min(reach, (hit(model, ray, () => true)?.distance ?? Infinity) + 0.15);
    for (const part of this.all) {
      const far = ray.ray.intersectBox(model.parts[part]!.box, at)?.distanceTo(ray.ray.origin) ?? Infinity;
      if (far < least) { least = far; found = part; }
    }
    return found;
  }

  /** The nearest door before a walker who looks a little beside it. */
  #beside({ ray: { origin, direction } }: THREE.Raycaster): number | null {
    const { model } = this.#state, at = new THREE.Vector3();
    if (!model || this.#town.state) return null;
    let found: number | null = null, least = NEAR;
    for (const part of this.all) {
      const { box } = model.parts[part]!;
      if (box.min.y > origin.y || box.max.y < origin.y - 1) continue; // On another storey.
      box.clampPoint(origin, at).sub(origin).setY(0);
      const far = at.length();
      if (far < least && (far < 0.3 || at.dot(direction) > 0.6 * far)) { least = far; found = part; }
    }
    return found;
  }

  #slide(part: number | null): boolean {
    const { model } = this.#state;
    if (part === null || !model) return false;
    if (this.#model !== model) { this.shut(); this.#model = model; }
    const moved = this.#moved.get(part) ?? this.#movable(model, part);
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
    const { code, name } = model.parts[part]!, label = this.#state.names.get(code?.trim() ?? '') ?? code?.trim() ?? name;
    this.#state.announce(moved.open ? strings.doorOpened(label) : strings.doorShut(label));
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
    this.onMoved();
    this.#viewport.refresh();
  }

  /** The leaves of a door, shut and open. */
  #movable(model: Model, part: number): Moved {
    const { box, facade, code } = model.parts[part]!, size = box.getSize(new THREE.Vector3()), middle = box.getCenter(new THREE.Vector3());
    const wall = facade === null ? null : model.parts[facade]!;
    const front = wall?.front?.clone() ?? new THREE.Vector3(size.x < size.z ? 1 : 0, 0, size.x < size.z ? 0 : 1);
    const along = new THREE.Vector3(-front.z, 0, front.x), ends = Math.abs(size.dot(along)) / 2;
    if (ROLLED.test(code ?? '')) {
      // Its curtain hangs between guides that stay.
      const curtain = leavesOf(model, part, at => Math.abs(at.sub(middle).dot(along)) < ends - GUIDE && at.y < middle.y + size.y / 2 - (size.y - LEAF) / 2);
      const [low, high] = spread(curtain, new THREE.Vector3(0, 1, 0));
      for (const { shut, opened } of curtain) for (let i = 1; i < shut.length; i += 3) opened[i] = high - (high - shut[i]!) / (high - low) * ROLL;
      return { leaves: curtain, open: false, at: 0 };
    }
    const leaves = leavesOf(model, part, at => at.y < box.min.y + LEAF), [low, high] = spread(leaves, along);
    const width = Math.max(0, high - low - LEFT);
    // To a side on which the wall goes on, rather not before another door: two that stood open side by side would shut each other.
    const beside = (side: number) => middle.clone().addScaledVector(along, side * width);
    const there = (side: number) => (wall?.box.distanceToPoint(beside(side)) ?? 0) < 0.1;
    const isDoor = (side: number) => model.parts.some((door, other) => other !== part && this.#opens(door) && door.box.containsPoint(beside(side)));
    const worth = (side: number) => (there(side) ? 2 : 0) + (isDoor(side) ? 0 : 1);
    const way = along.clone().multiplyScalar(worth(1) >= worth(-1) ? width : -width).addScaledVector(front, BEFORE).toArray();
    for (const { opened } of leaves) for (let i = 0; i < opened.length; i++) opened[i]! += way[i % 3]!;
    return { leaves, open: false, at: 0 };
  }
}

function place(moved: Moved, at: number) {
  moved.at = at;
  for (const { position, vertices, shut, opened } of moved.leaves) {
    const now = (i: number) => shut[i]! + (opened[i]! - shut[i]!) * at;
    for (const [i, vertex] of vertices.entries()) position.setXYZ(vertex, now(3 * i), now(3 * i + 1), now(3 * i + 2));
    position.needsUpdate = true;
  }
}

/** The corners of a door's triangles that move, by their middles. */
function leavesOf(model: Model, part: number, moves: (middle: THREE.Vector3) => boolean): Leaf[] {
  return model.chunks.flatMap(chunk => {
    const { geometry } = chunk.mesh, position = geometry.getAttribute('position') as THREE.BufferAttribute, index = geometry.index!, vertices = new Set<number>();
    const place = (vertex: number) => new THREE.Vector3().fromBufferAttribute(position, vertex);
    for (const { start, count } of rangesOf(chunk, model.parts, part)) {
      for (let i = start; i < start + count; i += 3) {
        const corners = [0, 1, 2].map(k => index.getX(i + k));
        if (moves(corners.reduce((sum, corner) => sum.add(place(corner)), new THREE.Vector3()).divideScalar(3))) for (const corner of corners) vertices.add(corner);
      }
    }
    const shut = new Float32Array([...vertices].flatMap(vertex => place(vertex).toArray()));
    return vertices.size ? [{ position, vertices: [...vertices], shut, opened: shut.slice() }] : [];
  });
}

/** From where to where leaves reach in a direction. */
function spread(leaves: Leaf[], direction: THREE.Vector3): [low: number, high: number] {
  const along = leaves.flatMap(({ shut }) => Array.from({ length: shut.length / 3 }, (_, i) => new THREE.Vector3().fromArray(shut, 3 * i).dot(direction)));
  return along.reduce(([low, high], at) => [Math.min(low, at), Math.max(high, at)], [Infinity, -Infinity]);
}
