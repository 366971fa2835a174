// Loads models from the server. Textures are kept between revisions, and so are the meshes of unchanged houses.

import * as THREE from 'three';
import { GLTFLoader, type GLTF, type GLTFParser } from 'three/addons/loaders/GLTFLoader.js';
import { updateModel } from './houses.ts';
import { DecoderError, unpacking } from './unpacking.ts';
import { keepOrigin, type Model, buildModel, surrounds } from './model.ts';
import { modelUrl, fetchHouses, type State, GLB_TYPE } from '../server/api.ts';
import { strings } from '../ui/strings.ts';

/** HTTP status for a superseded revision. */
const GONE = 410;

/** First four bytes of a binary glTF: `glTF`. */
const GLB_MAGIC = 0x676c5446;

/** A model is damaged or not a binary glTF. */
export class InvalidModelError extends Error {}

/** The server's answer. */
export interface Fetched {
  bytes: ArrayBuffer;
  /** True for a complete model, false for the difference from `before`. */
  whole: boolean;
  /** The model that the page showed when it asked. */
  before: Model | null;
}

/** The parts of the glTF JSON that describe materials. */
interface MaterialJson {
  materials: object[];
  textures: { source?: number; sampler?: number }[];
  images: { uri?: string }[];
}

/** Loads models and keeps the textures that they share. */
export class Loader {
  #textures = new Map<string, Promise<THREE.Texture>>();
  /** Texture keys by the base URL of a revision. */
  #keys = new Map<string, Record<string, string>>();
  /** Base URLs for which a texture failed to load. */
  #incomplete = new Set<string>();
  #loader = new GLTFLoader();

  constructor() {
    this.#loader.register(parser => ({ name: 'shared-textures', loadTexture: index => this.#texture(parser, index) }));
    this.#loader.register(parser => ({ name: 'appearance', afterRoot: ({ scene }) => this.#recordAppearance(parser, scene as THREE.Group | undefined) }));
    this.#loader.register(unpacking);
  }

  /** Fetches what the page lacks of a revision, or all of it if nothing is shown yet; null if a newer revision exists. */
  async fetch(file: string, revision: number, before: Model | null = null): Promise<Fetched | null> {
    const had = before?.keys ?? [];
    const response = await (had.length ? fetchHouses(file, revision, had) : fetch(modelUrl(file, revision)));
    if (response.status === GONE) return null;
    if (!response.ok) throw new Error(await response.text() || `${response.status}`);
    return { bytes: await response.arrayBuffer(), whole: response.headers.get('content-type') === GLB_TYPE, before };
  }

  /** Parses a fetched answer for a state of the file; null if a newer revision exists. */
  async load(fetched: Fetched, file: string, now: State): Promise<Model | null> {
    const url = modelUrl(file, now.revision), folder = url.slice(0, url.lastIndexOf('/') + 1), { before } = fetched;
    this.#keys.set(folder, now.pictures);
    try {
      let model = await this.#assemble(fetched, now.houses, folder);
      if (!model) {
        const whole = await this.fetch(file, now.revision);
        model = whole && await this.#assemble({ ...whole, before }, now.houses, folder);
      }
      // Without keys the next revision is fetched whole, which retries the texture.
      if (model && this.#incomplete.has(folder)) model.keys = [];
      return model;
    } finally {
      this.#keys.delete(folder);
      this.#incomplete.delete(folder);
    }
  }

  /** Builds the model of these houses; null if it has to be fetched whole. */
  async #assemble({ bytes, whole, before }: Fetched, houses: State['houses'], folder: string): Promise<Model | null> {
    const read = (glb: ArrayBuffer) => this.#read(glb, folder);
    if (!whole && before) {
      const model = await updateModel(before, houses, bytes, read);
      return model && surrounds(before.origin, model.box.clone().translate(before.origin)) ? model : null;
    }
    const model = buildModel(await read(bytes), before ? keepOrigin(before) : undefined);
    if (model.houses === houses.length) model.keys = houses.map(([key]) => key);
    return model;
  }

  /** Parses a `.glb`; textures are relative to `folder`. */
  async #read(bytes: ArrayBuffer, folder: string): Promise<THREE.Object3D> {
    const head = new DataView(bytes), whole = bytes.byteLength < 12 ? Infinity : head.getUint32(8, true);
    if (bytes.byteLength < 4 || head.getUint32(0) !== GLB_MAGIC) throw new InvalidModelError(strings.noGlb);
    if (bytes.byteLength < whole) throw new InvalidModelError(strings.cutOff);
    const gltf: GLTF = await this.#loader.parseAsync(bytes, folder).catch((error: Error) => {
      throw error instanceof DecoderError ? error : new InvalidModelError(error.message);
    });
    return gltf.scene as THREE.Group | undefined ?? new THREE.Group(); // A file without houses has no scene.
  }

  /** Waits for all textures. */
  async texturesLoaded() {
    await Promise.all(this.#textures.values());
  }

  /** Identifies a texture by its content and sampler rather than its URL; null for embedded images. */
  #key({ json, options }: GLTFParser, index: number): { source: number; key: string | undefined; sampler: string } | null {
    const { textures, images } = json as MaterialJson, { source, sampler } = textures[index]!;
    const uri = source === undefined ? undefined : images[source]?.uri;
    if (source === undefined || uri === undefined || uri.startsWith('data:')) return null;
    const key = this.#keys.get((options as { path: string }).path)?.[decodeUri(uri)];
    return { source, key, sampler: `${sampler ?? ''}` };
  }

  #texture(parser: GLTFParser, index: number): Promise<THREE.Texture> | null {
    const image = this.#key(parser, index);
    if (!image) return null;
    const { key, source, sampler } = image;
    if (!key) return Promise.resolve(null as unknown as THREE.Texture); // The server has reported that it is missing.
    const whole = `${key} ${sampler}`;
    let texture = this.#textures.get(whole);
    if (!texture) {
      const loader = (parser as unknown as { textureLoader: THREE.Loader<THREE.Texture> }).textureLoader;
      texture = parser.loadTextureImage(index, source, loader).then(found => {
        if (found as THREE.Texture | null) found.userData['kept'] = true;
        else {
          // Retried with the next revision.
          this.#textures.delete(whole);
          this.#incomplete.add((parser.options as { path: string }).path);
        }
        return found;
      });
      this.#textures.set(whole, texture);
    }
    return texture;
  }

  /** Records the appearance of each material, so that equal ones can be shared; only for models with external textures. */
  async #recordAppearance(parser: GLTFParser, scene: THREE.Group | undefined) {
    const { materials } = parser.json as MaterialJson, named = new Set<THREE.Material>();
    const texture = (index: number) => {
      const image = this.#key(parser, index);
      return image?.key ? `${image.key} ${image.sampler}` : `none like ${THREE.MathUtils.generateUUID()}`;
    };
    scene?.traverse(node => {
      const material = (node as Partial<THREE.Mesh>).material as THREE.MeshStandardMaterial | undefined;
      const index = material && (parser.associations.get(material) as { materials?: number } | undefined)?.materials;
      if (index === undefined || named.has(material!)) return;
      const description = JSON.stringify(materials[index], (name, value) => name === 'index' && typeof value === 'number' ? texture(value) : value as unknown);
      const { vertexColors, flatShading, normalScale } = material!;
      material!.userData['appearance'] = `${description} ${vertexColors} ${flatShading} ${normalScale?.y}`; // The loader makes variants of one material.
      named.add(material!);
    });
  }
}

/** Decodes a URI as the server does. */
function decodeUri(uri: string): string {
  return uri.replace(/(%[0-9a-f]{2})+/gi, bytes => {
    try { return decodeURIComponent(bytes); } catch { return bytes; }
  });
}
