// Textures that tiles share: each image is loaded once, and freed with the last tile that uses it, in this town or in the one
// that takes its place. A tile uses a texture from the moment at which it asks for it, not only once it is shown. The library
// frees the textures of each tile that ends; those that are shared do not listen to it.

import type * as THREE from 'three';
import type { GLTFLoaderPlugin, GLTFParser } from 'three/addons/loaders/GLTFLoader.js';

/** One try to load a tile: while it lasts, and as long as the tile is there, it uses its textures. */
export type TextureUser = object;

interface Shared {
  /** Null if the image cannot be loaded. */
  texture: Promise<THREE.Texture | null>;
  users: Set<TextureUser>;
  /** Frees it. */
  free: () => void;
}

/** By the address of the image and the way it is sampled. */
const textures = new Map<string, Shared>();

/** The parser's own way to load a texture, which its types leave out; null if it cannot be loaded. */
interface OwnLoading {
  loadTextureImage(texture: number, source: number, loader: THREE.Loader): Promise<THREE.Texture | null>;
  textureLoader: THREE.Loader;
}

/** A plugin of the loader; `user` tells for which tile a parser is made. */
export function sharedTextures(user: () => TextureUser): (parser: GLTFParser) => GLTFLoaderPlugin {
  return parser => {
    const own = user();
    return { name: 'town-textures', loadTexture: index => load(parser, index, own) as Promise<THREE.Texture> | null };
  };
}

function load(parser: GLTFParser, index: number, user: TextureUser): Promise<THREE.Texture | null> | null {
  const json = parser.json as { textures: { source?: number; sampler?: number }[]; samplers?: object[]; images: { uri?: string }[] };
  const { source, sampler } = json.textures[index]!, uri = source === undefined ? undefined : json.images[source]?.uri;
  if (source === undefined || !uri || uri.startsWith('data:')) return null;
  const folder = new URL((parser.options as { path: string }).path, location.href);
  const key = `${new URL(uri, folder)} ${JSON.stringify(json.samplers?.[sampler ?? -1] ?? {})}`;
  let shared = textures.get(key);
  if (!shared) {
    const own = parser as unknown as OwnLoading, made: Shared = { users: new Set(), free: () => {}, texture: Promise.resolve(null) };
    made.texture = own.loadTextureImage(index, source, own.textureLoader).then(texture => {
      if (texture) return keep(texture, made);
      if (textures.get(key) === made) textures.delete(key); // The next tile tries again.
      return null;
    });
    textures.set(key, shared = made);
  }
  shared.users.add(user);
  return shared.texture;
}

/** Takes a texture out of the library's hands. */
function keep(texture: THREE.Texture, shared: Shared): THREE.Texture {
  const dispose = texture.dispose.bind(texture), image = texture.image as Partial<ImageBitmap>, close = image.close?.bind(image);
  if (close) image.close = () => {};
  texture.dispose = () => {};
  shared.free = () => { dispose(); close?.(); };
  return texture;
}

/** Frees the textures that no one but this user used. */
export function releaseTextures(user: TextureUser) {
  for (const [key, shared] of textures) {
    if (!shared.users.delete(user) || shared.users.size > 0) continue;
    textures.delete(key);
    void shared.texture.then(() => shared.free());
  }
}

/** The number of textures in use. */
export const texturesInUse = () => textures.size;
