// Textures that tiles share: each image is loaded once, and freed with the last tile that shows it. The library frees the
// textures of each tile that ends; those that are shared do not listen to it.

import * as THREE from 'three';
import type { GLTFLoaderPlugin, GLTFParser } from 'three/addons/loaders/GLTFLoader.js';

interface Shared {
  texture: Promise<THREE.Texture>;
  /** The number of tiles that show it. */
  users: number;
  /** Frees it. */
  free: () => void;
}

/** By the address of the image and the way it is sampled. */
const textures = new Map<string, Shared>();

/** Keys of the textures that are shared. */
const keys = new WeakMap<THREE.Texture, string>();

/** The parser's own way to load a texture, which its types leave out. */
interface OwnLoading {
  loadTextureImage(texture: number, source: number, loader: THREE.Loader): Promise<THREE.Texture>;
  textureLoader: THREE.Loader;
}

/** A plugin of the loader. */
export function sharedTextures(parser: GLTFParser): GLTFLoaderPlugin {
  return { name: 'town-textures', loadTexture: index => load(parser, index) };
}

function load(parser: GLTFParser, index: number): Promise<THREE.Texture> | null {
  const json = parser.json as { textures: { source?: number; sampler?: number }[]; samplers?: object[]; images: { uri?: string }[] };
  const { source, sampler } = json.textures[index]!, uri = source === undefined ? undefined : json.images[source]?.uri;
  if (source === undefined || !uri || uri.startsWith('data:')) return null;
  const folder = new URL((parser.options as { path: string }).path, location.href);
  const key = `${new URL(uri, folder)} ${JSON.stringify(json.samplers?.[sampler ?? -1] ?? {})}`;
  const known = textures.get(key);
  if (known) return known.texture;
  const own = parser as unknown as OwnLoading;
  const shared: Shared = { users: 0, free: () => {}, texture: own.loadTextureImage(index, source, own.textureLoader).then(texture => keep(texture, key)) };
  textures.set(key, shared);
  shared.texture.catch(() => textures.delete(key));
  return shared.texture;
}

/** Takes a texture out of the library's hands. */
function keep(texture: THREE.Texture, key: string): THREE.Texture {
  const dispose = texture.dispose.bind(texture), image = texture.image as Partial<ImageBitmap>, close = image.close?.bind(image);
  if (close) image.close = () => {};
  texture.dispose = () => {};
  keys.set(texture, key);
  const shared = textures.get(key);
  if (shared) shared.free = () => { dispose(); close?.(); };
  return texture;
}

/** Counts the shared textures of a tile as used; returns them. */
export function holdTextures(scene: THREE.Object3D): Set<string> {
  const held = new Set<string>();
  scene.traverse(node => {
    if (!(node instanceof THREE.Mesh)) return;
    for (const material of [node.material].flat() as THREE.Material[]) {
      for (const value of Object.values(material)) {
        const key = value instanceof THREE.Texture ? keys.get(value) : undefined;
        if (key !== undefined) held.add(key);
      }
    }
  });
  for (const key of held) {
    const shared = textures.get(key);
    if (shared) shared.users++;
  }
  return held;
}

/** Frees textures of a tile that no other one shows. */
export function releaseTextures(held: Set<string>) {
  for (const key of held) {
    const shared = textures.get(key);
    if (!shared || --shared.users > 0) continue;
    textures.delete(key);
    shared.free();
  }
}

/** Frees what was loaded for tiles that never came to be shown. */
export function sweepTextures() {
  for (const [key, shared] of textures) {
    if (shared.users > 0) continue;
    textures.delete(key);
    void shared.texture.then(() => shared.free(), () => {});
  }
}
