// Browser side of load.mjs: loads a model, draws it and counts triangles and textures.
import * as THREE from 'three';
import { modelLoader } from './loader.mjs';

const renderer = new THREE.WebGLRenderer();
renderer.setSize(320, 240);
document.body.append(renderer.domElement);
const loader = modelLoader(renderer);
const camera = new THREE.PerspectiveCamera(40, 4 / 3, 0.1, 10000);

/** Frees the GPU resources of a mesh, so that models are counted separately. */
function dispose({ geometry, material }) {
  geometry?.dispose();
  for (const value of Object.values(material ?? {})) if (value?.isTexture) value.dispose();
}

/** Draws the Nth model; returns the counts of three.js. */
window.show = async n => {
  try {
    const { scene: model } = await loader.loadAsync(`/models/${n}`);
    const scene = new THREE.Scene();
    scene.add(model, new THREE.HemisphereLight());
    const ball = new THREE.Box3().setFromObject(model).getBoundingSphere(new THREE.Sphere());
    camera.position.copy(ball.center).addScaledVector(new THREE.Vector3(1, 1, 1), ball.radius * 2);
    camera.lookAt(ball.center);
    model.traverse(node => { node.frustumCulled = false; });
    renderer.render(scene, camera);
    const counts = { triangles: renderer.info.render.triangles, textures: renderer.info.memory.textures };
    model.traverse(node => dispose(node));
    return counts;
  } catch (error) {
    return { error: String(error) };
  }
};
window.ready = true;
