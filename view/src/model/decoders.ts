// Decoders for compressed models (`hsd build --compress`): meshopt buffers and KTX2 textures. Loaded only when needed.

import * as THREE from 'three';
import { KTX2Loader } from 'three/addons/loaders/KTX2Loader.js';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';

/**
 * Transcodes textures in workers with a separate script: the transcoder generates code at run time, which the page's content
 * security policy forbids (see `build.mjs` and `src/view`).
 */
class WorkerKtx2Loader extends KTX2Loader {
  override init(): Promise<void> {
    return this.transcoderPending ??= this.#prepare().catch((error: unknown) => {
      this.transcoderPending = null;
      throw error;
    });
  }

  async #prepare() {
    const bytes = await new THREE.FileLoader().setResponseType('arraybuffer').loadAsync('/basis_transcoder.wasm') as ArrayBuffer;
    this.workerPool.setWorkerCreator(() => {
      const worker = new Worker('/unpack.js'), transcoderBinary = bytes.slice(0);
      // Pending textures fail instead of waiting for ever.
      worker.addEventListener('error', ({ message }) => {
        worker.dispatchEvent(new MessageEvent('message', { data: { type: 'error', error: message, data: {} } }));
      });
      worker.postMessage({ type: 'init', config: this.workerConfig, transcoderBinary }, [transcoderBinary]);
      return worker;
    });
  }
}

/** The decoders for the glTF loader. */
export async function loadDecoders(): Promise<{ meshopt: typeof MeshoptDecoder; ktx2: KTX2Loader }> {
  // A temporary context tells which texture formats the GPU supports.
  const renderer = new THREE.WebGLRenderer({ canvas: document.createElement('canvas') });
  const ktx2 = new WorkerKtx2Loader().detectSupport(renderer);
  renderer.dispose();
  renderer.forceContextLoss();
  await MeshoptDecoder.ready;
  return { meshopt: MeshoptDecoder, ktx2 };
}
