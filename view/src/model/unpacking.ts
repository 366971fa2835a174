// Unpacks compressed models while they are read: the decoders are a script of their own, which is loaded with the first of them.

import type { GLTFLoaderPlugin, GLTFParser } from 'three/addons/loaders/GLTFLoader.js';

/** glTF extensions that need a decoder. */
const DECODED_EXTENSIONS = new Set(['EXT_meshopt_compression', 'KHR_meshopt_compression', 'KHR_texture_basisu']);

/** The decoders are loaded once, on first use. */
let decoders: ReturnType<typeof import('./decoders.ts')['loadDecoders']> | null = null;
const loadDecoders = () => decoders ??= import('./decoders.ts').then(module => module.loadDecoders())
  .catch((error: unknown) => { decoders = null; throw error; });

/** The decoders could not be loaded. */
export class DecoderError extends Error {}

/** A plugin of the loader: gives it the decoders if the model needs them. */
export const unpacking = (parser: GLTFParser): GLTFLoaderPlugin => ({ name: 'decoders', beforeRoot: () => attachDecoders(parser) });

async function attachDecoders(parser: GLTFParser) {
  const { json, options } = parser as unknown as { json: { extensionsUsed?: string[] }; options: object };
  if (!json.extensionsUsed?.some(name => DECODED_EXTENSIONS.has(name))) return;
  const { meshopt, ktx2 } = await loadDecoders().catch((error: Error) => { throw new DecoderError(error.message); });
  Object.assign(options, { meshoptDecoder: meshopt, ktx2Loader: ktx2 });
}
