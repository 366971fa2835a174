// Which walls of glass are hidden behind other things. The card is asked with each frame how much of a wall's panes comes
// through, and answers a little later: a wall that was wholly hidden is not mirrored in the next frame. Where one
// comes forth, another frame is asked for.

import * as THREE from 'three';
import type { Wall } from './walls.ts';

/** How far before its glass a wall is looked for, metres: more than depths are rounded. */
const PROUD = 0.004;
/** Pause before answers are fetched, milliseconds. */
const PAUSE = 12;

interface Probe {
  mesh: THREE.Mesh;
  query: WebGLQuery | null;
  asked: boolean;
  hidden: boolean;
}

export class Probes {
  /** Asks for another frame. */
  wake: () => void = () => {};
  #gl: WebGL2RenderingContext;
  #renderer: THREE.WebGLRenderer;
  #scene = new THREE.Scene();
  #material = new THREE.MeshBasicMaterial({
    colorWrite: false, depthWrite: false, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -4,
  });
  #probes = new Map<Wall, Probe>();
  #timer = 0;

  constructor(renderer: THREE.WebGLRenderer) {
    this.#renderer = renderer;
    this.#gl = renderer.getContext() as WebGL2RenderingContext;
    this.#scene.matrixWorldAutoUpdate = false;
  }

  /** Whether nothing of a wall came through when it was last looked for. */
  hidden(wall: Wall): boolean {
    return this.#probes.get(wall)?.hidden ?? false;
  }

  /** Whether answers are still to come. */
  get asking(): boolean {
    return [...this.#probes.values()].some(probe => probe.asked);
  }

  /** Looks for walls in what has just been drawn. */
  ask(walls: Wall[], camera: THREE.Camera) {
    this.fetch();
    this.#scene.children = walls.flatMap(wall => {
      const probe = this.#probe(wall);
      return probe.asked ? [] : [probe.mesh];
    });
    if (this.#scene.children.length === 0) return;
    const renderer = this.#renderer, { autoClear } = renderer;
    renderer.autoClear = false;
    renderer.render(this.#scene, camera);
    renderer.autoClear = autoClear;
    this.#wait();
  }

  /** Takes the answers that have come. */
  fetch() {
    const gl = this.#gl;
    let forth = false;
    for (const probe of this.#probes.values()) {
      if (!probe.asked || !probe.query || !gl.getQueryParameter(probe.query, gl.QUERY_RESULT_AVAILABLE)) continue;
      const hidden = gl.getQueryParameter(probe.query, gl.QUERY_RESULT) === 0;
      probe.asked = false;
      forth ||= probe.hidden && !hidden;
      probe.hidden = hidden;
    }
    if (forth) this.wake();
  }

  /** Forgets all walls. */
  clear() {
    for (const { mesh, query } of this.#probes.values()) {
      mesh.geometry.dispose();
      this.#gl.deleteQuery(query);
    }
    this.#probes.clear();
    clearTimeout(this.#timer);
    this.#timer = 0;
  }

  #wait() {
    this.#timer ||= setTimeout(() => {
      this.#timer = 0;
      this.fetch();
      if (this.asking) this.#wait();
    }, PAUSE) as unknown as number;
  }

  #probe(wall: Wall): Probe {
    let probe = this.#probes.get(wall);
    if (probe) return probe;
    const mesh = new THREE.Mesh(shape_of(wall), this.#material), gl = this.#gl;
    mesh.matrixAutoUpdate = false;
    const made: Probe = probe = { mesh, query: gl.createQuery(), asked: false, hidden: false };
    mesh.onBeforeRender = () => {
      if (!made.query) return;
      gl.beginQuery(gl.ANY_SAMPLES_PASSED, made.query);
      made.asked = true;
    };
    mesh.onAfterRender = () => { if (made.query) gl.endQuery(gl.ANY_SAMPLES_PASSED); };
    this.#probes.set(wall, made);
    return made;
  }
}

/** What the panes of a wall lie within, a little before them. */
function shape_of({ layers, normal }: Wall): THREE.BufferGeometry {
  const points: THREE.Vector3[] = [];
  for (const { polygon } of layers) {
    for (let i = 2; i < polygon.length; i++) points.push(polygon[0]!, polygon[i - 1]!, polygon[i]!);
  }
  return new THREE.BufferGeometry().setFromPoints(points.map(point => point.clone().addScaledVector(normal, PROUD)));
}
