// Reads a model from the server. Its pictures are kept from one revision to the next, so that a save costs only what
// has changed: the shapes.

import * as THREE from 'three';
import { GLTFLoader, type GLTF, type GLTFParser } from 'three/addons/loaders/GLTFLoader.js';
import { type Model, model_of } from './model.ts';

/** Loads models; keeps what they share. */
export class Loader {
  #textures = new Map<string, Promise<THREE.Texture>>();
  #keys: Record<string, string> = {};
  #loader = new GLTFLoader();

  constructor() {
    this.#loader.register(parser => ({ name: 'kept-pictures', loadTexture: index => this.#texture(parser, index) }));
  }

  /** Reads a model; `pictures` = the keys of the pictures beside it. */
  async load(url: string, pictures: Record<string, string>): Promise<Model> {
    this.#keys = pictures;
    const gltf: GLTF = await this.#loader.loadAsync(url);
    return model_of(gltf.scene);
  }

  /** A texture by what its picture is and how it is read, not by where it lies. */
  #texture(parser: GLTFParser, index: number): Promise<THREE.Texture> | null {
    const { json } = parser as unknown as { json: { textures: { source?: number; sampler?: number }[]; images: { uri?: string }[] } };
    const { source, sampler } = json.textures[index]!;
    const uri = source === undefined ? undefined : json.images[source]?.uri;
    const name = uri?.split('/').pop() ?? '';
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
