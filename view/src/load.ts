// Reads a model from the server. Pictures are kept from one revision to the next, and so are the shapes of houses that have
// not changed.

import * as THREE from 'three';
import { GLTFLoader, type GLTF, type GLTFParser } from 'three/addons/loaders/GLTFLoader.js';
import { renewed } from './houses.ts';
import { kept_middle, type Model, model_of, stands_round } from './model.ts';
import { model_url, others, type State, WHOLE } from './server.ts';
import { words } from './words.ts';

/** Extensions that the loader leaves to others. */
const PACKED = new Set(['EXT_meshopt_compression', 'KHR_meshopt_compression', 'KHR_texture_basisu']);

/** The status of an answer where there is a newer revision. */
const GONE = 410;

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
  /** What the page showed when it asked. */
  before: Model | null;
}

/** What a model says of its looks. */
interface Looks {
  materials: object[];
  textures: { source?: number; sampler?: number }[];
  images: { uri?: string }[];
}

/** Loads models; keeps what they share. */
export class Loader {
  #textures = new Map<string, Promise<THREE.Texture>>();
  /** The keys of pictures, by the folder that they lie in: one of each revision. */
  #keys = new Map<string, Record<string, string>>();
  /** Folders of which a picture could not be had. */
  #lacking = new Set<string>();
  #loader = new GLTFLoader();

  constructor() {
    this.#loader.register(parser => ({ name: 'kept-pictures', loadTexture: index => this.#texture(parser, index) }));
    this.#loader.register(parser => ({ name: 'looks', afterRoot: ({ scene }) => this.#name_looks(parser, scene as THREE.Group | undefined) }));
    this.#loader.register(parser => ({ name: 'unpacked', beforeRoot: () => unpack(parser) }));
  }

  /** What a page lacks that shows an earlier revision, or nothing yet; null where there is a newer revision. */
  async fetch(file: string, revision: number, before: Model | null = null): Promise<Fetched | null> {
    const had = before?.keys ?? [];
    const response = await (had.length ? others(file, revision, had) : fetch(model_url(file, revision)));
    if (response.status === GONE) return null;
    if (!response.ok) throw new Error(await response.text() || `${response.status}`);
    return { bytes: await response.arrayBuffer(), whole: response.headers.get('content-type') === WHOLE, before };
  }

  /** Reads what was fetched for a state of a file; null where there is a newer one. */
  async load(fetched: Fetched, file: string, now: State): Promise<Model | null> {
    const url = model_url(file, now.revision), folder = url.slice(0, url.lastIndexOf('/') + 1), { before } = fetched;
    this.#keys.set(folder, now.pictures);
    try {
      let model = await this.#made(fetched, now.houses, folder);
      if (!model) {
        const whole = await this.fetch(file, now.revision);
        model = whole && await this.#made({ ...whole, before }, now.houses, folder);
      }
      // A picture that could not be had may be had with the next save, if all is read again.
      if (model && this.#lacking.has(folder)) model.keys = [];
      return model;
    } finally {
      this.#keys.delete(folder);
      this.#lacking.delete(folder);
    }
  }

  /** The model of these houses; null where it has to be read as a whole. */
  async #made({ bytes, whole, before }: Fetched, houses: State['houses'], folder: string): Promise<Model | null> {
    const read = (glb: ArrayBuffer) => this.#read(glb, folder);
    if (!whole && before) {
      const model = await renewed(before, houses, bytes, read);
      return model && stands_round(before.middle, model.box.clone().translate(before.middle)) ? model : null;
    }
    const model = model_of(await read(bytes), before ? kept_middle(before) : undefined);
    if (model.houses === houses.length) model.keys = houses.map(([key]) => key);
    return model;
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

  /** What the picture of a texture is, and how it is read, not where it lies; null where it lies in the model. */
  #key({ json, options }: GLTFParser, index: number): { source: number; key: string | undefined; sampler: string } | null {
    const { textures, images } = json as Looks, { source, sampler } = textures[index]!;
    const uri = source === undefined ? undefined : images[source]?.uri;
    if (source === undefined || uri === undefined || uri.startsWith('data:')) return null;
    const key = this.#keys.get((options as { path: string }).path)?.[plain(uri)];
    return { source, key, sampler: `${sampler ?? ''}` };
  }

  #texture(parser: GLTFParser, index: number): Promise<THREE.Texture> | null {
    const picture = this.#key(parser, index);
    if (!picture) return null;
    const { key, source, sampler } = picture;
    if (!key) return Promise.resolve(null as unknown as THREE.Texture); // the server has told that it is missing
    const whole = `${key} ${sampler}`;
    let texture = this.#textures.get(whole);
    if (!texture) {
      const loader = (parser as unknown as { textureLoader: THREE.Loader<THREE.Texture> }).textureLoader;
      texture = parser.loadTextureImage(index, source, loader).then(found => {
        if (found as THREE.Texture | null) found.userData['kept'] = true;
        else {
          // What could not be had now may be had next time.
          this.#textures.delete(whole);
          this.#lacking.add((parser.options as { path: string }).path);
        }
        return found;
      });
      this.#textures.set(whole, texture);
    }
    return texture;
  }

  /** Notes what is the same for materials that look the same, in models whose pictures lie beside them. */
  async #name_looks(parser: GLTFParser, scene: THREE.Group | undefined) {
    const { materials } = parser.json as Looks, named = new Set<THREE.Material>();
    const texture = (index: number) => {
      const picture = this.#key(parser, index);
      return picture?.key ? `${picture.key} ${picture.sampler}` : `none like ${THREE.MathUtils.generateUUID()}`;
    };
    scene?.traverse(node => {
      const material = (node as Partial<THREE.Mesh>).material as THREE.MeshStandardMaterial | undefined;
      const index = material && (parser.associations.get(material) as { materials?: number } | undefined)?.materials;
      if (index === undefined || named.has(material!)) return;
      const told = JSON.stringify(materials[index], (name, value) => name === 'index' && typeof value === 'number' ? texture(value) : value as unknown);
      const { vertexColors, flatShading, normalScale } = material!;
      material!.userData['look'] = `${told} ${vertexColors} ${flatShading} ${normalScale?.y}`; // the loader makes kinds of one material
      named.add(material!);
    });
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
