// Reads a model from the server. Its pictures are kept from one revision to the next, so that a save costs only what
// has changed: the shapes.

import * as THREE from 'three';
import { GLTFLoader, type GLTF, type GLTFParser } from 'three/addons/loaders/GLTFLoader.js';
import { type Model, model_of } from './model.ts';
import { model_url } from './server.ts';

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
  }

  /** The bytes of a model; null where a text leaves none. */
  async fetch(file: string, revision: number): Promise<ArrayBuffer | null> {
    const response = await fetch(model_url(file, revision));
    return response.ok ? await response.arrayBuffer() : null;
  }

  /** Reads a model; `pictures` = the keys of the pictures beside it. */
  async load(bytes: ArrayBuffer, file: string, revision: number, pictures: Record<string, string>): Promise<Model> {
    this.#keys = pictures;
    const url = model_url(file, revision), [path, query] = url.split('?');
    this.#query = `?${query}`;
    const gltf: GLTF = await this.#loader.parseAsync(bytes, path!.slice(0, path!.lastIndexOf('/') + 1));
    return model_of(gltf.scene);
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
    const name = uri?.split('?')[0]!.split('/').pop() ?? '';
    const key = this.#keys[decodeURIComponent(name)];
    if (source === undefined || !key) return null;
    const whole = `${key} ${sampler ?? ''}`;
    let texture = this.#textures.get(whole);
    if (!texture) {
      const loader = (parser as unknown as { textureLoader: THREE.Loader<THREE.Texture> }).textureLoader;
      texture = parser.loadTextureImage(index, source, loader);
      this.#textures.set(whole, texture);
    }
    return texture;
  }
}
