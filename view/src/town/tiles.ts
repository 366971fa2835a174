// Streams the tiles of a town: a script of its own, which is loaded with the first town.
//
// Frame: metres, x east, y up, -z north of the town's origin. A root that places the town on the globe is taken back.

import * as THREE from 'three';
import { TilesRenderer } from '3d-tiles-renderer/three';
import { GLTFExtensionsPlugin } from '3d-tiles-renderer/three/plugins';
import {
  DEFAULT_DOWNLOAD_QUEUE, DEFAULT_LRU_CACHE, DEFAULT_NODE_QUEUE, DEFAULT_PARSE_QUEUE, DownloadPriorityQueue, LRUCache, PriorityQueue, type Tile,
} from '3d-tiles-renderer/core';
import { unpacking } from '../model/unpacking.ts';
import type { TownFeature } from '../server/api.ts';
import { releaseTextures, sharedTextures, texturesInUse, type TextureUser } from './textures.ts';

/** The attribute that names the feature of a vertex. */
const FEATURE = '_feature_id_0';

/** The attribute that names the feature of a tree, of which a tile has many instances. */
const OF_INSTANCE = '_FEATURE_ID_0';

/** Error on the screen up to which a level of detail will do, pixels. */
const ERROR_TARGET = 12;

/** How often tiles that are being loaded are asked for, milliseconds. */
const PAUSE = 80;

/** How far tiles may be from the first one in the middle of a town, metres. */
const PART = 330;

/** What the library reads from `EXT_structural_metadata`, as far as it is used here. */
interface Metadata {
  getPropertyTableInfo(): { name: string }[] | null;
  getPropertyTableData(table: number, id: number): Record<string, unknown>;
}

/** What a tile has. */
interface Loaded {
  scene: THREE.Object3D;
  metadata: Metadata | null;
  /** Rows of the table by layer and key, filled when first asked. */
  rows: Map<string, number> | null;
}

/** What the library's types leave out. */
interface Inside {
  /** Tiles by the step of loading at which they are. */
  stats: { queued: number; downloading: number; parsing: number };
  parseTile(content: ArrayBuffer, tile: Tile, extension: string, url: string, signal: AbortSignal): Promise<void>;
}

/** A tile as its root describes it, as far as it is used here. */
interface TileJson {
  transform?: number[];
  boundingVolume: { box?: number[] };
  content?: object;
  children?: TileJson[];
}

/** The tiles with content that hang below no other such tile. */
const contentsOf = (tile: TileJson): TileJson[] => tile.content ? [tile] : (tile.children ?? []).flatMap(contentsOf);

/** The bounds of a tile in the frame of its root; null if they are no box. */
function boxOf({ boundingVolume: { box } }: TileJson): THREE.Box3 | null {
  if (!box) return null;
  const reach = (axis: number) => Math.abs(box[3 + axis]!) + Math.abs(box[6 + axis]!) + Math.abs(box[9 + axis]!);
  const middle = new THREE.Vector3(box[0], box[1], box[2]), half = new THREE.Vector3(reach(0), reach(1), reach(2));
  return new THREE.Box3(middle.clone().sub(half), middle.add(half));
}

/** Of a box of many tiles, which is a file of its own, the part that is near to a point; a box of one tile as it is. */
function nearTo(point: THREE.Vector3, box: THREE.Box3): THREE.Box3 {
  const { x, z } = box.getSize(new THREE.Vector3());
  if (Math.max(x, z) < 3 * PART) return box;
  const { min, max } = box, near = box.clampPoint(point, new THREE.Vector3()), half = PART / 2;
  return new THREE.Box3(new THREE.Vector3(near.x - half, min.y, near.z - half), new THREE.Vector3(near.x + half, max.y, near.z + half)).intersect(box);
}

/** A surface that was hit: of a feature, or of the ground. */
export interface TileHit {
  feature: TownFeature | null;
  point: THREE.Vector3;
}

const nameOf = (layer: string, key: string) => `${layer}\n${key}`;

export class TownTiles {
  readonly group = new THREE.Group();
  /** The town's bounds; empty until its root is loaded. */
  readonly box = new THREE.Box3();
  /** The bounds of the tiles near the middle of the town, where there are any. */
  readonly middle = new THREE.Box3();
  /** Called when its root is loaded. */
  onRoot: () => void = () => {};
  /** Called when something else is to be drawn. */
  onChange: () => void = () => {};
  /** Called when other tiles are shown. */
  onTiles: () => void = () => {};
  /** Called with what cannot be loaded. */
  onError: (message: string) => void = () => {};
  #tiles: TilesRenderer;
  #loaded = new Map<Tile, Loaded>();
  /** What uses the textures of tiles that are parsed. */
  #users = new Map<Tile, TextureUser>();
  #camera: THREE.PerspectiveCamera;
  #renderer: THREE.WebGLRenderer;

  constructor(url: string, camera: THREE.PerspectiveCamera, renderer: THREE.WebGLRenderer, dim: (material: THREE.Material) => void) {
    this.#camera = camera;
    this.#renderer = renderer;
    const tiles = this.#tiles = new TilesRenderer(url);
    let user: TextureUser = {};
    tiles.registerPlugin(new GLTFExtensionsPlugin({ plugins: [sharedTextures(() => user), unpacking], autoDispose: false }));
    const inside = tiles as unknown as Inside, parse = inside.parseTile.bind(tiles);
    inside.parseTile = async (content, tile, extension, url, signal) => {
      const own = user = {}; // The parser is made before anything is waited for.
      try {
        await parse(content, tile, extension, url, signal);
        if (!signal.aborted) this.#users.set(tile, own);
      } finally {
        if (this.#users.get(tile) !== own) releaseTextures(own);
      }
    };
    tiles.errorTarget = ERROR_TARGET;
    // The next tiles are loaded while the ones before are still shown: a cache for both would have no room for them, and
    // what is left in the queues of tiles that are gone would be waited for.
    tiles.lruCache = new LRUCache();
    tiles.lruCache.unloadPriorityCallback = DEFAULT_LRU_CACHE.unloadPriorityCallback;
    const { maxJobsPerOrigin, priorityCallback } = DEFAULT_DOWNLOAD_QUEUE;
    tiles.downloadQueue = Object.assign(new DownloadPriorityQueue(), { maxJobsPerOrigin, priorityCallback });
    tiles.parseQueue = ownQueue(DEFAULT_PARSE_QUEUE);
    tiles.processNodeQueue = ownQueue(DEFAULT_NODE_QUEUE);
    Object.assign(tiles, { calculateBytesUsed: (_tile: Tile, scene: THREE.Object3D | undefined) => bytesOf(scene) });
    tiles.setCamera(camera);
    this.group.name = 'town';
    this.group.add(tiles.group);
    tiles.addEventListener('load-root-tileset', () => this.#rooted());
    tiles.addEventListener('load-error', ({ tile, error }) => {
      this.#settled = !tile; // Without a root there is nothing to wait for.
      this.onError(error.message);
      this.onChange();
    });
    tiles.addEventListener('needs-update', () => { this.#settled = false; this.onChange(); });
    tiles.addEventListener('update-after', () => this.#settle());
    tiles.addEventListener('load-model', ({ scene, tile }) => this.#enter(scene as THREE.Object3D, tile, dim));
    tiles.addEventListener('dispose-model', ({ tile }) => this.#leave(tile));
    tiles.addEventListener('tile-visibility-change', () => { this.onTiles(); this.onChange(); });
  }

  /** True while something is being loaded, also before anything was asked for. */
  get busy(): boolean { return !this.#settled; }
  #settled = false;

  /**
   * After tiles were chosen for the camera: all is there once none of them is on its way. The library's own word for it will
   * not do: in `tiles-load-end` and `loadProgress` tiles do not count between the head of an answer and its last byte.
   */
  #settle() {
    const { queued, downloading, parsing } = (this.#tiles as unknown as Inside).stats, before = this.#settled;
    this.#settled = queued + downloading + parsing === 0 && !this.#tiles.processNodeQueue.running;
    if (this.#settled && !before) this.onChange();
  }

  /** Number of tiles that are shown. */
  get shown(): number { return [...this.#tiles.visibleTiles].filter(tile => this.#loaded.has(tile)).length; }

  /** Chooses the tiles for the camera; to be called before each frame. */
  update() {
    this.#camera.updateMatrixWorld();
    this.#tiles.setResolutionFromRenderer(this.#camera, this.#renderer);
    this.#tiles.update();
    // The library says when something has come, but not always when it was the last.
    if (this.busy) this.#timer ||= window.setTimeout(() => { this.#timer = 0; this.update(); }, PAUSE);
  }
  #timer = 0;

  /** Puts the town into the page's frame. */
  #rooted() {
    const root = this.#tiles.rootTileset?.root as unknown as TileJson | undefined;
    const own = new THREE.Matrix4(), up = new THREE.Matrix4().makeRotationX(-Math.PI / 2);
    if (root?.transform) own.fromArray(root.transform);
    const { group } = this.#tiles;
    group.matrix.copy(up).multiply(own.clone().invert());
    group.matrix.decompose(group.position, group.quaternion, group.scale);
    group.updateMatrixWorld(true);
    const box = root && boxOf(root);
    if (box) this.box.copy(box.applyMatrix4(up));
    else {
      const ball = new THREE.Sphere();
      if (this.#tiles.getBoundingSphere(ball)) this.box.setFromCenterAndSize(ball.center.applyMatrix4(group.matrixWorld), new THREE.Vector3().setScalar(ball.radius * 2));
    }
    const centre = this.box.getCenter(new THREE.Vector3());
    const tiles = (root ? contentsOf(root) : []).flatMap(tile => boxOf(tile)?.applyMatrix4(up) ?? []).map(box => nearTo(centre, box));
    const first = tiles.sort((a, b) => a.distanceToPoint(centre) - b.distanceToPoint(centre))[0]?.getCenter(new THREE.Vector3());
    for (const tile of tiles) if (first && tile.getCenter(new THREE.Vector3()).distanceTo(first) < PART) this.middle.union(tile);
    this.onRoot();
    this.onChange();
  }

  #enter(scene: THREE.Object3D, tile: Tile, dim: (material: THREE.Material) => void) {
    let metadata: Metadata | null = null;
    scene.traverse(node => {
      metadata ??= (node.userData['structuralMetadata'] as Metadata | undefined) ?? null;
      if (!(node instanceof THREE.Mesh)) return;
      node.castShadow = node.receiveShadow = true;
      for (const material of [node.material].flat() as THREE.Material[]) dim(material);
    });
    this.#loaded.set(tile, { scene, metadata, rows: null });
    this.onChange();
  }

  #leave(tile: Tile) {
    const user = this.#users.get(tile);
    if (user) releaseTextures(user);
    this.#users.delete(tile);
    this.#loaded.delete(tile);
  }

  /** The number of images that the page's tiles use. */
  get textures(): number { return texturesInUse(); }

  /** The feature or the ground that a ray meets first. */
  hit(ray: THREE.Raycaster): TileHit | null {
    const found = ray.intersectObject(this.#tiles.group, true).find(({ object }) => object instanceof THREE.Mesh);
    if (!found?.face) return null;
    const mesh = found.object as THREE.Mesh, id = idsOf(mesh)?.getX(found.instanceId ?? found.face.a);
    for (const { scene, metadata } of this.#loaded.values()) {
      let holds = false;
      scene.traverse(node => { holds ||= node === mesh; });
      if (holds && metadata && id !== undefined) return { feature: featureOf(metadata, id), point: found.point };
    }
    return { feature: null, point: found.point };
  }

  /** The point that a ray meets first. */
  pointAt(ray: THREE.Raycaster): THREE.Vector3 | null {
    return ray.intersectObject(this.#tiles.group, true).find(({ object }) => object instanceof THREE.Mesh)?.point ?? null;
  }

  /** The materials of all tiles that are there. */
  *materials(): Iterable<THREE.Material> {
    for (const { scene } of this.#loaded.values()) {
      const found: THREE.Material[] = [];
      scene.traverse(node => { if (node instanceof THREE.Mesh) found.push(...[node.material].flat() as THREE.Material[]); });
      yield* found;
    }
  }

  /** What is drawn of the tiles that are shown. */
  *meshes(): Iterable<THREE.Mesh> {
    for (const tile of this.#tiles.visibleTiles) {
      const meshes: THREE.Mesh[] = [];
      this.#loaded.get(tile)?.scene.traverse(node => { if (node instanceof THREE.Mesh) meshes.push(node); });
      yield* meshes;
    }
  }

  /** The triangles of a feature in the tiles that are shown; null if it is in none of them. */
  shapeOf(layer: string, key: string): { shape: THREE.BufferGeometry; feature: TownFeature } | null {
    for (const tile of this.#tiles.visibleTiles) {
      const loaded = this.#loaded.get(tile), id = loaded && rowsOf(loaded).get(nameOf(layer, key));
      if (!loaded?.metadata || id === undefined) continue;
      const shape = trianglesOf(loaded.scene, id);
      if (shape) return { shape, feature: featureOf(loaded.metadata, id) };
    }
    return null;
  }

  dispose() {
    clearTimeout(this.#timer);
    this.onRoot = this.onChange = this.onTiles = this.onError = () => {};
    this.group.removeFromParent();
    this.#tiles.dispose();
    for (const tile of [...this.#users.keys()]) this.#leave(tile);
  }
}

/** A queue that works as another one. */
const ownQueue = ({ maxJobs, priorityCallback }: PriorityQueue) => Object.assign(new PriorityQueue(), { maxJobs, priorityCallback });

/** The bytes of the geometry of a tile: its textures are shared with others, and would be counted with each. */
function bytesOf(scene: THREE.Object3D | undefined): number {
  let bytes = 0;
  scene?.traverse(node => {
    if (!(node instanceof THREE.Mesh)) return;
    const { attributes, index } = node.geometry;
    for (const { array } of [...Object.values(attributes), ...index ? [index] : []] as THREE.BufferAttribute[]) bytes += array?.byteLength ?? 0;
  });
  return bytes;
}

/** The features of the vertices of a mesh, or of its instances. */
const idsOf = (mesh: THREE.Mesh) => mesh.geometry.getAttribute(mesh instanceof THREE.InstancedMesh ? OF_INSTANCE : FEATURE) as THREE.BufferAttribute | undefined;

/** The row of a table as the page names it. */
function featureOf(metadata: Metadata, id: number): TownFeature {
  const row = metadata.getPropertyTableData(0, id);
  const text = (name: string) => `${row[name] ?? ''}`, number = (name: string) => Number(row[name] ?? 0);
  return {
    key: text('key'), layer: text('layer'), type: text('type'), year: text('year'), evidence: text('evidence'),
    parameters: text('parameters'), rule: number('rule'), line: number('line'),
  };
}

/** The rows of a tile by layer and key. */
function rowsOf(loaded: Loaded): Map<string, number> {
  if (loaded.rows) return loaded.rows;
  const rows = loaded.rows = new Map<string, number>();
  let last = -1;
  loaded.scene.traverse(node => {
    const ids = node instanceof THREE.Mesh ? idsOf(node) : undefined;
    for (let i = 0; i < (ids?.count ?? 0); i++) last = Math.max(last, ids!.getX(i));
  });
  for (let id = 0; loaded.metadata && id <= last; id++) {
    const { layer, key } = featureOf(loaded.metadata, id);
    rows.set(nameOf(layer, key), id);
  }
  return rows;
}

/** The triangles of a feature in a tile, in the page's frame. */
function trianglesOf(scene: THREE.Object3D, id: number): THREE.BufferGeometry | null {
  const points: number[] = [], point = new THREE.Vector3();
  scene.updateMatrixWorld();
  scene.traverse(node => {
    if (!(node instanceof THREE.Mesh)) return;
    const { index } = node.geometry, position = node.geometry.getAttribute('position'), ids = idsOf(node);
    const instances = node instanceof THREE.InstancedMesh ? node.count : 1, own = new THREE.Matrix4();
    for (let instance = 0; ids && instance < instances; instance++) {
      const instanced = node instanceof THREE.InstancedMesh;
      if (instanced && ids.getX(instance) !== id) continue;
      if (instanced) node.getMatrixAt(instance, own);
      const place = own.clone().premultiply(node.matrixWorld);
      for (let i = 0; i < (index?.count ?? position.count); i += 3) {
        const corner = (k: number) => index ? index.getX(i + k) : i + k;
        if (!instanced && ids.getX(corner(0)) !== id) continue;
        for (let k = 0; k < 3; k++) points.push(...point.fromBufferAttribute(position, corner(k)).applyMatrix4(place).toArray());
      }
    }
  });
  if (!points.length) return null;
  const shape = new THREE.BufferGeometry();
  shape.setAttribute('position', new THREE.Float32BufferAttribute(points, 3));
  shape.computeBoundingBox();
  return shape;
}
