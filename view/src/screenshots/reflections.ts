// What glossy surfaces reflect where no mirror shows it: a sky that is bright at the horizon, and the ground. Under a deep blue sky
// smoked tiles (ibushi) would be blue; the page, which has no time for reflections of the sky, shows them as silver too.

import * as THREE from 'three';

/** Linear colours; the white balance of daylight has taken most of the blue from the sky. */
const REFLECTED = { horizon: new THREE.Color(0.86, 0.89, 0.92), zenith: new THREE.Color(0.42, 0.50, 0.60), ground: new THREE.Color(0x8c8474) };

/** Strength of the reflected sky by day, beside the lights that stand for it in the open. */
export const REFLECTION = 0.6;

/** Side of the map's faces, texels: it holds two smooth colours. */
const SIZE = 64;

/** An environment map of sky and ground. */
export function skyReflections(renderer: THREE.WebGLRenderer): THREE.Texture {
  const scene = new THREE.Scene(), { horizon, zenith, ground } = REFLECTED;
  const sky = new THREE.ShaderMaterial({
    side: THREE.BackSide, depthWrite: false, uniforms: { horizon: { value: horizon }, zenith: { value: zenith } },
    vertexShader: 'varying vec3 way; void main() { way = position; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }',
    fragmentShader: `varying vec3 way; uniform vec3 horizon, zenith; void main() {
      gl_FragColor = vec4(mix(horizon, zenith, pow(clamp(normalize(way).y, 0.0, 1.0), 0.55)), 1.0); }`,
  });
  const floor = new THREE.Mesh(new THREE.CircleGeometry(60, 48), new THREE.MeshBasicMaterial({ color: ground }));
  floor.rotation.x = -Math.PI / 2;
  floor.position.y = -2;
  scene.add(new THREE.Mesh(new THREE.SphereGeometry(50, 48, 24), sky), floor);
  const maker = new THREE.PMREMGenerator(renderer), { texture } = maker.fromScene(scene, 0, 0.1, 200, { size: SIZE });
  maker.dispose();
  return texture;
}
