// Browser side of tiles.mjs: loads a tileset with 3d-tiles-renderer, near enough that every level is wanted.
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { KTX2Loader } from 'three/addons/loaders/KTX2Loader.js';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';
import { TilesRenderer } from '3d-tiles-renderer/three';
import { GLTFExtensionsPlugin } from '3d-tiles-renderer/three/plugins';
import { GLTFMeshFeaturesExtension, GLTFStructuralMetadataExtension } from '3d-tiles-renderer/three/plugins';

const renderer = new THREE.WebGLRenderer();
renderer.setSize(320, 240);
document.body.append(renderer.domElement);
const textures = new KTX2Loader().setTranscoderPath('/node_modules/three/examples/jsm/libs/basis/').detectSupport(renderer);

/** Waits until nothing is loading for some frames. */
async function settled(tiles) {
  for (let quiet = 0, frames = 0; quiet < 10 && frames < 3000; frames++) {
    tiles.update();
    await new Promise(done => setTimeout(done, 10));
    const { downloading = 0, parsing = 0, queued = 0 } = tiles.stats;
    quiet = downloading + parsing + queued > 0 || !tiles.root ? 0 : quiet + 1;
  }
}

/** Loads all of a tileset; returns what was named and drawn. */
window.visit = async url => {
  const errors = [], names = new Set();
  const tiles = new TilesRenderer(url);
  tiles.registerPlugin(new GLTFExtensionsPlugin({
    meshoptDecoder: MeshoptDecoder,
    ktxLoader: textures,
    plugins: [() => new GLTFMeshFeaturesExtension(), () => new GLTFStructuralMetadataExtension()],
  }));
  tiles.addEventListener('load-error', ({ error, url: of }) => errors.push(`${of}: ${error}`));
  tiles.addEventListener('load-model', ({ scene }) => {
    scene.traverse(({ userData }) => {
      const metadata = userData.structuralMetadata, features = userData.meshFeatures;
      if (!metadata || !features) return;
      const count = features.getFeatureInfo()[0].featureCount;
      for (let id = 0; id < count; id++) names.add(metadata.getPropertyTableData(0, id).key);
    });
  });
  const camera = new THREE.PerspectiveCamera(60, 4 / 3, 1, 1e8);
  tiles.setCamera(camera);
  tiles.setResolution(camera, 320, 240);
  // So little is small enough that every tile is replaced by the nearest level.
  tiles.errorTarget = 1e-9;
  const scene = new THREE.Scene();
  scene.add(tiles.group, new THREE.HemisphereLight());
  let triangles = 0;
  for (let pass = 0; pass < 2; pass++) {
    await settled(tiles);
    const ball = new THREE.Sphere();
    tiles.getBoundingSphere(ball);
    camera.position.copy(ball.center).addScaledVector(new THREE.Vector3(0.3, 0.2, 1).normalize(), ball.radius * 2.2);
    camera.lookAt(ball.center);
    camera.updateMatrixWorld();
    await settled(tiles);
    renderer.render(scene, camera);
    triangles = renderer.info.render.triangles;
  }
  return { errors, features: names.size, triangles };
};
window.ready = true;
