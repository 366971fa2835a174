// Reads a model from the server. Pictures are kept from one revision to the next, and so are houses that have not
// changed: a save costs only what has.

import * as THREE from 'three';
import { GLTFLoader, type GLTF, type GLTFParser } from 'three/addons/loaders/GLTFLoader.js';
import { renewed } from './houses.ts';
import { kept_middle, type Model, model_of } from './model.ts';
import { model_url, others, type State, WHOLE } from './server.ts';
import { words } from './words.ts';

/** Extensions that the loader leaves to others. */
const PACKED = new Set(['EXT_meshopt_compression', 'KHR_meshopt_compression', 'KHR_texture_basisu']);

/** How each binary glTF begins: `glTF`. */
const MAGIC = 0x676c5446;

/** Fetched once, where they are asked for. */
let waiting: ReturnType<typeof import('./packed.ts')['unpackers']> | null = null;
const unpackers = () => waiting ??= import('./packed.ts').then(made => made.unpackers())
  .catch((error: unknown) => { waiting = null; throw error; });

/** What unpacks a model cannot be had. */
class Unpacking extends Error {}

/** A model is damaged, or is none. */
export class Unreadable extends Error {}

/** What the server has answered. */
export interface Fetched {
  bytes: ArrayBuffer;
  /** Whether it is a whole model, or what differs from the one before. */
  whole: boolean;
  before: Model | null;
}

/** Loads models; keeps what they share. */
export class Loader {
  #textures = new Map<string, Promise<THREE.Texture>>();
  #keys: Record<string, string> = {};
  #query = '';
  #manager = new THREE.LoadingManager();
  #loader = new GLTFLoader(this.#manager);

  constructor() {
    // The pictures beside a model are asked for with the same words as the model.
    this.#manager.setURLModifier(url => url.startsWith('/api/') && !url.includes('?') ? url + this.#query : url);
    this.#loader.register(parser => ({ name: 'kept-pictures', loadTexture: index => this.#texture(parser, index) }));
    this.#loader.register(parser => ({ name: 'unpacked', beforeRoot: () => unpack(parser) }));
  }

  /** What a page lacks that shows an earlier revision, or nothing yet; null where a text leaves no model. */
  async fetch(file: string, revision: number, before: Model | null = null): Promise<Fetched | null> {
    const had = before?.keys ?? [];
    const response = await (had.length ? others(file, revision, had) : fetch(model_url(file, revision)));
    if (!response.ok) return null;
    return { bytes: await response.arrayBuffer(), whole: response.headers.get('content-type') === WHOLE, before };
  }

  /** Reads what was fetched for a state of a file; null where there is a newer one. */
  async load({ bytes, whole, before }: Fetched, file: string, now: State): Promise<Model | null> {
    const { revision, pictures, houses } = now;
    this.#keys = pictures;
    const url = model_url(file, revision), [path, query] = url.split('?');
    this.#query = `?${query}`;
    const read = (glb: ArrayBuffer) => this.#read(glb, path!.slice(0, path!.lastIndexOf('/') + 1));
    if (whole || !before) {
      const model = model_of(await read(bytes), before ? kept_middle(before) : undefined);
      return { ...model, keys: model.houses === houses.length ? houses.map(([key]) => key) : [] };
    }
    const model = await renewed(before, houses, bytes, read);
    if (model && kept_middle(before)(model.box.clone().translate(before.middle)) === before.middle) return model;
    const anew = await this.fetch(file, revision);
    return anew && this.load(anew, file, now);
  }

  /** Reads a `.glb`; pictures lie below `folder`. */
  async #read(bytes: ArrayBuffer, folder: string): Promise<THREE.Object3D> {
    const head = new DataView(bytes), whole = bytes.byteLength < 12 ? Infinity : head.getUint32(8, true);
    if (bytes.byteLength < 4 || head.getUint32(0) !== MAGIC) throw new Unreadable(words.no_glb);
    if (bytes.byteLength < whole) throw new Unreadable(words.cut_off);
    const gltf: GLTF = await this.#loader.parseAsync(bytes, folder).catch((error: Error) => {
      throw error instanceof Unpacking ? error : new Unreadable(error.message);
    });
    return gltf.scene as THREE.Group | undefined ?? new THREE.Group(); // a text without houses has no scene
  }

  /** Waits for all pictures. */
  async pictures() {
    await Promise.all(this.#textures.values());
  }

  /** A texture by what its picture is and how it is read, not by where it lies. */
  #texture(parser: GLTFParser, index: number): Promise<THREE.Texture> | null {
    const { json } = parser as unknown as { json: { textures: { source?: number; sampler?: number }[]; images: { uri?: string }[] } };
    const { source, sampler } = json.textures[index]!;
    const uri = source === undefined ? undefined : json.images[source]?.uri;
    if (source === undefined || uri === undefined || uri.startsWith('data:')) return null; // lies in the model
    const key = this.#keys[plain(uri)];
    if (!key) return Promise.resolve(null as unknown as THREE.Texture); // the server has told that it is missing
    const whole = `${key} ${sampler ?? ''}`;
    let texture = this.#textures.get(whole);
    if (!texture) {
      const loader = (parser as unknown as { textureLoader: THREE.Loader<THREE.Texture> }).textureLoader;
      texture = parser.loadTextureImage(index, source, loader).then(found => {
        // What could not be had now may be had next time.
        if (found as THREE.Texture | null) found.userData['kept'] = true; else this.#textures.delete(whole);
        return found;
      });
      this.#textures.set(whole, texture);
    }
    return texture;
  }
}

/** The name that an address stands for, as the server reads it (src/view/beside.rs). */
function plain(uri: string): string {
  return uri.replace(/(%[0-9a-f]{2})+/gi, bytes => {
    try { return decodeURIComponent(bytes); } catch { return bytes; }
  });
}

/** Lets a model that is packed be read. */
async function unpack(parser: GLTFParser) {
  const { json, options } = parser as unknown as { json: { extensionsUsed?: string[] }; options: object };
  if (!json.extensionsUsed?.some(name => PACKED.has(name))) return;
  const { arrays, pictures } = await unpackers().catch((error: Error) => { throw new Unpacking(error.message); });
  Object.assign(options, { meshoptDecoder: arrays, ktx2Loader: pictures });
}
