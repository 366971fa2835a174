// Browser side: a loader for uncompressed and compressed models.
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { KTX2Loader } from 'three/addons/loaders/KTX2Loader.js';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';

export function modelLoader(renderer) {
  const textures = new KTX2Loader().setTranscoderPath('/node_modules/three/examples/jsm/libs/basis/').detectSupport(renderer);
  return new GLTFLoader().setKTX2Loader(textures).setMeshoptDecoder(MeshoptDecoder);
}
