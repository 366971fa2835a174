// Occlusion queries for walls of glass. Each frame asks the GPU whether any of a wall's panes are visible; the answer comes
// a little later. Occluded walls are not mirrored in the next frame; when one becomes visible, another frame is requested.

import * as THREE from 'three';
import type { Wall } from './walls.ts';

/** Offset of the query geometry in front of the glass, metres: more than the depth buffer's rounding. */
const OFFSET = 0.004;
/** Interval for polling the answers, milliseconds. */
const POLL_MS = 12;

interface Probe {
  mesh: THREE.Mesh;
  query: WebGLQuery | null;
  pending: boolean;
  hidden: boolean;
}

export class OcclusionQueries {
  /** Requests another frame. */
  requestFrame: () => void = () => {};
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

  /** True if the wall was occluded when it was last queried. */
  hidden(wall: Wall): boolean {
    return this.#probes.get(wall)?.hidden ?? false;
  }

  /** True while answers are outstanding. */
  get pending(): boolean {
    return [...this.#probes.values()].some(probe => probe.pending);
  }

  /** Queries walls against the frame just drawn. */
  query(walls: Wall[], camera: THREE.Camera) {
    this.collect();
    this.#scene.children = walls.flatMap(wall => {
      const probe = this.#probe(wall);
      return probe.pending ? [] : [probe.mesh];
    });
    if (this.#scene.children.length === 0) return;
    const renderer = this.#renderer, { autoClear } = renderer;
    renderer.autoClear = false;
    renderer.render(this.#scene, camera);
    renderer.autoClear = autoClear;
    this.#wait();
  }

  /** Collects the answers that have arrived. */
  collect() {
    const gl = this.#gl;
    let forth = false;
    for (const probe of this.#probes.values()) {
      if (!probe.pending || !probe.query || !gl.getQueryParameter(probe.query, gl.QUERY_RESULT_AVAILABLE)) continue;
      const hidden = gl.getQueryParameter(probe.query, gl.QUERY_RESULT) === 0;
      probe.pending = false;
      forth ||= probe.hidden && !hidden;
      probe.hidden = hidden;
    }
    if (forth) this.requestFrame();
  }

  /** Drops all queries. */
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
      this.collect();
      if (this.pending) this.#wait();
    }, POLL_MS) as unknown as number;
  }

  #probe(wall: Wall): Probe {
    let probe = this.#probes.get(wall);
    if (probe) return probe;
    const mesh = new THREE.Mesh(shapeOf(wall), this.#material), gl = this.#gl;
    mesh.matrixAutoUpdate = false;
    const made: Probe = probe = { mesh, query: gl.createQuery(), pending: false, hidden: false };
    mesh.onBeforeRender = () => {
      if (!made.query) return;
      gl.beginQuery(gl.ANY_SAMPLES_PASSED, made.query);
      made.pending = true;
    };
    mesh.onAfterRender = () => { if (made.query) gl.endQuery(gl.ANY_SAMPLES_PASSED); };
    this.#probes.set(wall, made);
    return made;
  }
}

/** The polygons of a wall's panes, moved slightly forward. */
function shapeOf({ layers, normal }: Wall): THREE.BufferGeometry {
  const points: THREE.Vector3[] = [];
  for (const { polygon } of layers) {
    for (let i = 2; i < polygon.length; i++) points.push(polygon[0]!, polygon[i - 1]!, polygon[i]!);
  }
  return new THREE.BufferGeometry().setFromPoints(points.map(point => point.clone().addScaledVector(normal, OFFSET)));
}
