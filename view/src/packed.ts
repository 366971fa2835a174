// What unpacks models made small for the web (`hsd build --compress`): arrays packed by meshopt, pictures as KTX2. Fetched
// only when such a model comes.

import * as THREE from 'three';
import { KTX2Loader } from 'three/addons/loaders/KTX2Loader.js';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';

/** Unpacks pictures in workers of a script of their own, since what they run makes functions from text, which the page does
 * not allow itself (see `build.mjs`, `src/view/guard.rs`). */
class Pictures extends KTX2Loader {
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
      // Whoever waits for a picture is told that it does not come.
      worker.addEventListener('error', ({ message }) => {
        worker.dispatchEvent(new MessageEvent('message', { data: { type: 'error', error: message, data: {} } }));
      });
      worker.postMessage({ type: 'init', config: this.workerConfig, transcoderBinary }, [transcoderBinary]);
      return worker;
    });
  }
}

/** What a loader of glTF asks for. */
export async function unpackers(): Promise<{ arrays: typeof MeshoptDecoder; pictures: KTX2Loader }> {
  // Which formats the graphics card takes is asked of a context that is given back at once.
  const renderer = new THREE.WebGLRenderer({ canvas: document.createElement('canvas') });
  const pictures = new Pictures().detectSupport(renderer);
  renderer.dispose();
  renderer.forceContextLoss();
  await MeshoptDecoder.ready;
  return { arrays: MeshoptDecoder, pictures };
}
