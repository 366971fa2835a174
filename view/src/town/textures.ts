// Textures that tiles share: each image is loaded once, and freed with the last tile that shows it.

import type * as THREE from 'three';
import type { GLTFLoaderPlugin, GLTFParser } from 'three/addons/loaders/GLTFLoader.js';

interface Shared {
  texture: Promise<THREE.Texture>;
  /** The number of tiles that show it. */
  users: number;
}

const textures = new Map<string, Shared>();

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
  if (known) {
    known.users++;
    return known.texture;
  }
  const own = parser as unknown as OwnLoading;
  const shared: Shared = { users: 1, texture: own.loadTextureImage(index, source, own.textureLoader).then(texture => guard(texture, key)) };
  textures.set(key, shared);
  shared.texture.catch(() => textures.delete(key));
  return shared.texture;
}

/** Lets a texture go only with its last user: each tile that ends closes the image and disposes of the texture. */
function guard(texture: THREE.Texture, key: string): THREE.Texture {
  const dispose = texture.dispose.bind(texture), image = texture.image as Partial<ImageBitmap>;
  const close = image.close?.bind(image);
  if (close) image.close = () => {};
  texture.dispose = () => {
    const shared = textures.get(key);
    if (shared && --shared.users > 0) return;
    textures.delete(key);
    dispose();
    close?.();
  };
  return texture;
}
