// In the browser: a loader of models, plain ones and those for the web.
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { KTX2Loader } from 'three/addons/loaders/KTX2Loader.js';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';

export function model_loader(renderer) {
  const pictures = new KTX2Loader().setTranscoderPath('/node_modules/three/examples/jsm/libs/basis/').detectSupport(renderer);
  return new GLTFLoader().setKTX2Loader(pictures).setMeshoptDecoder(MeshoptDecoder);
}
