// An independent ray caster: reads the triangles of a GLB itself and follows the ray of each pixel, reflecting it at glass.
// The page's reflections are compared with its images.

import { bytesOf, type Colour, colourOf, encoded, linear } from './colours.ts';

type Vec = [x: number, y: number, z: number];

const sub = (a: Vec, b: Vec): Vec => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const add = (a: Vec, b: Vec, k = 1): Vec => [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]];
const dot = (a: Vec, b: Vec) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: Vec, b: Vec): Vec => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a: Vec): Vec => {
  const length = Math.hypot(...a);
  return [a[0] / length, a[1] / length, a[2] / length];
};

interface Json {
  scene?: number;
  scenes: { nodes: number[] }[];
  nodes: { children?: number[]; mesh?: number; translation?: Vec; rotation?: [number, number, number, number]; scale?: Vec; extras?: { kind?: string } }[];
  meshes: { primitives: { attributes: { POSITION: number }; indices: number; material: number }[] }[];
  materials: { doubleSided?: boolean; extras?: { reflection?: number } }[];
  accessors: { bufferView: number; byteOffset?: number; componentType: number; count: number; normalized?: boolean }[];
  bufferViews: { byteOffset?: number; byteStride?: number }[];
}

/** A rotation and scale with an offset. */
interface Frame {
  x: Vec;
  y: Vec;
  z: Vec;
  at: Vec;
}

interface Triangle {
  a: Vec;
  ab: Vec;
  ac: Vec;
  normal: Vec;
  both: boolean;
  colour: Colour;
  /** Share at normal incidence; null if it is not glass. */
  share: number | null;
  mirrors: boolean;
}

interface Branch {
  low: Vec;
  high: Vec;
  triangles: Triangle[] | null;
  kids: [Branch, Branch] | null;
}

export interface Camera {
  eye: Vec;
  target: Vec;
  /** Vertical field of view, degrees. */
  fov: number;
  width: number;
  height: number;
}

/** Share of glass that reflects only the sky. */
const PLAIN = 0.04;

export class Scene {
  triangles: Triangle[];
  /** Opacity of glass. */
  cover = 1;
  #root: Branch;

  constructor(glb: Uint8Array) {
    this.triangles = read(glb);
    this.#root = branch(this.triangles);
  }

  /** The image of a camera: RGB bytes from the lower left corner. `depth` is the number of reflections. */
  picture(camera: Camera, depth: number, sky: Colour): Uint8Array {
    const { width, height } = camera, picture = new Uint8Array(width * height * 3);
    for (let y = 0; y < height; y++) {
      for (let x = 0; x < width; x++) picture.set(this.seen(camera, x + 0.5, y + 0.5, depth, sky), (y * width + x) * 3);
    }
    return picture;
  }

  /** The colour at a position of the image, pixels from the lower left corner. */
  seen(camera: Camera, x: number, y: number, depth: number, sky: Colour): Colour {
    return bytesOf(this.#light(camera.eye, directionOf(camera, x, y), depth, sky, true));
  }

  /** The reflecting share of the glass at a position and its point in space; null if there is none. */
  glass(camera: Camera, x: number, y: number): { share: number; at: Vec } | null {
    const way = directionOf(camera, x, y), hit = this.#first(camera.eye, way);
    return hit?.triangle.mirrors ? { share: hit.triangle.share!, at: add(camera.eye, way, hit.far) } : null;
  }

  /**
   * The light from a direction; `screen` for direct rays, since the screen blends what is seen through glass in sRGB rather
   * than in linear light.
   */
  #light(from: Vec, way: Vec, depth: number, sky: Colour, screen: boolean): Colour {
    const hit = this.#first(from, way);
    if (!hit) return sky;
    const { triangle: { colour, share, mirrors, normal }, far } = hit;
    if (share === null) return colour;
    const least = mirrors ? share : PLAIN, slant = Math.abs(dot(normal, way));
    const weight = least + (1 - least) * (1 - slant) ** 5;
    const turned = add(way, normal, -2 * dot(normal, way));
    const at = add(from, way, far), mirrored = mirrors && depth > 0 ? this.#light(at, turned, depth - 1, sky, false) : sky;
    const cover = 1 - (1 - weight) * (1 - this.cover), behind = cover < 1 ? this.#light(at, way, depth, sky, screen) : colour;
    const mix = (i: 0 | 1 | 2) => {
      const own = ((1 - weight) * this.cover * colour[i] + weight * mirrored[i]) / cover;
      return screen ? linear(cover * encoded(own) + (1 - cover) * encoded(behind[i])) : cover * own + (1 - cover) * behind[i];
    };
    return [mix(0), mix(1), mix(2)];
  }

  #first(from: Vec, way: Vec): { triangle: Triangle; far: number } | null {
    let found: Triangle | null = null, far = Infinity;
    const inverse: Vec = [1 / way[0], 1 / way[1], 1 / way[2]], open = [this.#root];
    while (open.length > 0) {
      const { low, high, triangles, kids } = open.pop()!;
      let enter = 1e-4, leave = far;
      for (const i of [0, 1, 2] as const) {
        const a = (low[i] - from[i]) * inverse[i], b = (high[i] - from[i]) * inverse[i];
        enter = Math.max(enter, Math.min(a, b));
        leave = Math.min(leave, Math.max(a, b));
      }
      if (enter > leave) continue;
      if (kids) open.push(...kids);
      for (const triangle of triangles ?? []) {
        const t = met(triangle, from, way);
        if (t > 1e-4 && t < far) {
          far = t;
          found = triangle;
        }
      }
    }
    return found && { triangle: found, far };
  }
}

function directionOf({ eye, target, fov, width, height }: Camera, x: number, y: number): Vec {
  const back = unit(sub(eye, target)), right = unit(cross([0, 1, 0], back)), up = cross(back, right);
  const half = Math.tan(fov * Math.PI / 360);
  const across = (2 * x / width - 1) * half * width / height, high = (2 * y / height - 1) * half;
  return unit(add(add([-back[0], -back[1], -back[2]], right, across), up, high));
}

/** The distance along a ray to a triangle, culling back faces unless it is double-sided; NaN for a miss. */
function met({ a, ab, ac, both }: Triangle, from: Vec, way: Vec): number {
  const p = cross(way, ac), det = dot(ab, p);
  if (both ? det === 0 : det <= 0) return NaN;
  const s = sub(from, a), u = dot(s, p) / det;
  if (u < 0 || u > 1) return NaN;
  const q = cross(s, ab), v = dot(way, q) / det;
  return v < 0 || u + v > 1 ? NaN : dot(ac, q) / det;
}

function branch(triangles: Triangle[]): Branch {
  const low: Vec = [Infinity, Infinity, Infinity], high: Vec = [-Infinity, -Infinity, -Infinity];
  for (const t of triangles) {
    for (const corner of [t.a, add(t.a, t.ab), add(t.a, t.ac)]) {
      for (const i of [0, 1, 2] as const) {
        low[i] = Math.min(low[i], corner[i] - 1e-6);
        high[i] = Math.max(high[i], corner[i] + 1e-6);
      }
    }
  }
  if (triangles.length <= 8) return { low, high, triangles, kids: null };
  const size = sub(high, low), axis = size.indexOf(Math.max(...size)) as 0 | 1 | 2;
  const middle = (t: Triangle) => 3 * t.a[axis] + t.ab[axis] + t.ac[axis];
  const sorted = [...triangles].sort((a, b) => middle(a) - middle(b)), half = sorted.length >> 1;
  return { low, high, triangles: null, kids: [branch(sorted.slice(0, half)), branch(sorted.slice(half))] };
}

/** The triangles of a GLB, in its own frame. */
function read(glb: Uint8Array): Triangle[] {
  const data = new DataView(glb.buffer, glb.byteOffset, glb.byteLength), length = data.getUint32(12, true);
  const json = JSON.parse(new TextDecoder().decode(glb.subarray(20, 20 + length))) as Json;
  const start = 20 + length + 8, triangles: Triangle[] = [];
  const value = (accessor: number, i: number, k: number, of: number) => {
    const { bufferView, byteOffset = 0, componentType } = json.accessors[accessor]!;
    const view = json.bufferViews[bufferView]!, bytes = ({ 5121: 1, 5123: 2, 5125: 4, 5126: 4 } as Record<number, number>)[componentType]!;
    const at = start + (view.byteOffset ?? 0) + byteOffset + i * (view.byteStride ?? bytes * of) + k * bytes;
    if (componentType === 5126) return data.getFloat32(at, true);
    return componentType === 5125 ? data.getUint32(at, true) : componentType === 5123 ? data.getUint16(at, true) : data.getUint8(at);
  };
  let parts = 0;
  const visit = (index: number, above: Frame, part: number, front: Vec | null) => {
    const node = json.nodes[index]!, frame = within(above, node);
    if (node.extras?.kind !== undefined) part = parts++;
    if (node.extras?.kind === 'facade') front = unit(frame.z);
    for (const { attributes, indices, material } of node.mesh === undefined ? [] : json.meshes[node.mesh]!.primitives) {
      const { doubleSided, extras } = json.materials[material]!;
      const corner = (i: number): Vec => {
        const vertex = value(indices, i, 0, 1);
        return place(frame, [0, 1, 2].map(k => value(attributes.POSITION, vertex, k, 3)) as Vec);
      };
      for (let i = 0; i < json.accessors[indices]!.count; i += 3) {
        const a = corner(i), ab = sub(corner(i + 1), a), ac = sub(corner(i + 2), a), normal = unit(cross(ab, ac));
        const share = extras?.reflection ?? null;
        const mirrors = share !== null && share > 0 && front !== null && dot(normal, front) > 0.2;
        triangles.push({ a, ab, ac, normal, both: doubleSided ?? false, colour: colourOf(part), share, mirrors });
      }
    }
    for (const child of node.children ?? []) visit(child, frame, part, front);
  };
  const world: Frame = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1], at: [0, 0, 0] };
  for (const root of json.scenes[json.scene ?? 0]!.nodes) visit(root, world, 0, null);
  return triangles;
}

const turned = (f: Frame, v: Vec): Vec => add(add([v[0] * f.x[0], v[0] * f.x[1], v[0] * f.x[2]], f.y, v[1]), f.z, v[2]);
const place = (f: Frame, v: Vec): Vec => add(turned(f, v), f.at);

function within(above: Frame, { translation = [0, 0, 0], rotation = [0, 0, 0, 1], scale = [1, 1, 1] }: Json['nodes'][number]): Frame {
  const [x, y, z, w] = rotation;
  const columns: [Vec, Vec, Vec] = [
    [1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)],
    [2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)],
    [2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)],
  ];
  const axis = (i: 0 | 1 | 2): Vec => turned(above, [columns[i][0] * scale[i], columns[i][1] * scale[i], columns[i][2] * scale[i]]);
  return { x: axis(0), y: axis(1), z: axis(2), at: place(above, translation) };
}
