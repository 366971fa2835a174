// In the browser: pictures of a model under an afternoon sun. The light of sun and sky is a sum over many small lights,
// each with its own shadow, so that eaves and lattices are dark where the sky does not reach; the camera trembles by
// less than a pixel from light to light, which smooths edges as well.
import * as THREE from 'three';
import { model_loader } from './loader.mjs';

const EYE = 1.5; // metres
let WIDTH = 960, HEIGHT = 640;
const SUN = new THREE.Vector3(-0.55, 0.72, 0.62).normalize(); // from the south-west, a little behind the front viewer
const SUN_COLOR = new THREE.Color(1.0, 0.93, 0.82), SKY_COLOR = new THREE.Color(0.72, 0.84, 1.0);
const SUN_STRENGTH = 3.8, SKY_STRENGTH = 2.1, SUN_SHARE = 0.4; // share of the lights that stand for the sun
const HAZE = new THREE.Color(0.66, 0.77, 0.88), ZENITH = new THREE.Color(0.13, 0.32, 0.70);

const renderer = new THREE.WebGLRenderer({ antialias: false, preserveDrawingBuffer: true });
renderer.shadowMap.enabled = true;
renderer.shadowMap.type = THREE.BasicShadowMap; // the sum over many lights softens it
renderer.shadowMap.autoUpdate = false;
document.body.append(renderer.domElement);
const reflections = sky_reflections();

/** A number in [0, 1) that fills the interval evenly: van der Corput's sequence. */
function even(index, base) {
  let result = 0;
  for (let share = 1 / base; index > 0; index = Math.floor(index / base), share /= base) result += share * (index % base);
  return result;
}

/** A dome whose colour runs from the haze at the horizon to the zenith. */
function sky_dome(radius) {
  const material = new THREE.ShaderMaterial({
    side: THREE.BackSide, depthWrite: false,
    uniforms: { haze: { value: HAZE }, zenith: { value: ZENITH }, sun: { value: SUN } },
    vertexShader: 'varying vec3 way; void main() { way = position; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }',
    fragmentShader: `varying vec3 way; uniform vec3 haze, zenith, sun; void main() {
      vec3 d = normalize(way); float up = pow(clamp(d.y, 0.0, 1.0), 0.55);
      float glow = pow(max(dot(d, sun), 0.0), 6.0) * 0.25;
      gl_FragColor = vec4(mix(haze, zenith, up) + glow * vec3(1.0, 0.9, 0.7), 1.0); }`,
  });
  return new THREE.Mesh(new THREE.SphereGeometry(radius, 48, 24), material);
}

/** What glass and glazed tiles mirror: the sky above, the ground below. */
function sky_reflections() {
  const scene = new THREE.Scene();
  scene.add(sky_dome(50));
  const ground = new THREE.Mesh(new THREE.CircleGeometry(60, 48), new THREE.MeshBasicMaterial({ color: 0x8c8474 }));
  ground.rotation.x = -Math.PI / 2;
  ground.position.y = -2;
  scene.add(ground);
  const maker = new THREE.PMREMGenerator(renderer);
  const texture = maker.fromScene(scene, 0, 0.1, 200).texture;
  maker.dispose();
  return texture;
}

/** Raked gravel, drawn once: fine grain without a visible repeat. */
function ground_texture() {
  const size = 512, canvas = new OffscreenCanvas(size, size), context = canvas.getContext('2d');
  const image = context.createImageData(size, size);
  let state = 12345;
  for (let i = 0; i < image.data.length; i += 4) {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    const grain = 226 + (state >>> 24) / 255 * 29;
    image.data.set([grain, grain, grain, 255], i);
  }
  context.putImageData(image, 0, 0);
  const texture = new THREE.CanvasTexture(canvas);
  texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.anisotropy = 2;
  return texture;
}

/** The ground: a disc that fades into the haze. */
function ground(ball, level) {
  const radius = ball.radius * 40;
  const map = ground_texture();
  map.repeat.setScalar(radius / 4);
  const plane = new THREE.Mesh(new THREE.CircleGeometry(radius, 96), new THREE.MeshLambertMaterial({ color: 0xa3967f, map }));
  plane.rotation.x = -Math.PI / 2;
  plane.position.set(ball.center.x, level, ball.center.z);
  plane.receiveShadow = true;
  return plane;
}

/** The model on its ground, under the sky, with one light that `shine` moves about. */
async function stage(n) {
  const { scene: model } = await model_loader(renderer).loadAsync(`/models/${n}`);
  const scene = new THREE.Scene();
  model.traverse(node => {
    if (!node.isMesh) return;
    const glass = node.material.transparent || node.material.transmission > 0;
    node.castShadow = !glass;
    node.receiveShadow = true;
    node.material.envMapIntensity = glass ? 1.0 : 0.35;
    for (const map of [node.material.map, node.material.normalMap]) if (map) map.anisotropy = 2;
  });
  const box = new THREE.Box3().setFromObject(model), ball = box.getBoundingSphere(new THREE.Sphere());
  const level = Math.min(0, box.min.y) - 0.002;
  scene.add(model, ground(ball, level), sky_dome(ball.radius * 60));
  scene.fog = new THREE.Fog(HAZE, ball.radius * 8, ball.radius * 38);
  scene.environment = reflections;
  const bounce = new THREE.HemisphereLight(0xffffff, 0xd8c4a0, 0.35); // what ground and neighbours throw back
  const light = new THREE.DirectionalLight(0xffffff, 1);
  light.castShadow = true;
  light.shadow.mapSize.setScalar(2048);
  const reach = ball.radius * 1.1;
  Object.assign(light.shadow.camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: 0, far: reach * 6 });
  light.shadow.normalBias = reach / 2048 * 2;
  light.target.position.copy(ball.center);
  scene.add(bounce, light, light.target);
  return { model, scene, light, box, ball, corners: corners_of(model) };
}

/** Moves the light to place `i` of `of`: some stand for the sun's disc, the others for the sky. */
function shine({ light, ball }, i, of) {
  const suns = Math.max(1, Math.round(of * SUN_SHARE)), skies = of - suns;
  const u = even(i + 1, 2), v = even(i + 1, 3), way = new THREE.Vector3();
  if (i < suns) {
    way.set(u - 0.5, v - 0.5, even(i + 1, 5) - 0.5).multiplyScalar(0.035).add(SUN);
    light.color.copy(SUN_COLOR);
    light.intensity = SUN_STRENGTH * of / suns;
  } else {
    // Evenly over the dome by the cosine to the zenith, so that equal weights make an even sky.
    const height = Math.sqrt(1 - u * 0.94), around = v * 2 * Math.PI, flat = Math.sqrt(1 - height * height);
    way.set(flat * Math.cos(around), height, flat * Math.sin(around));
    light.color.copy(SKY_COLOR);
    light.intensity = SKY_STRENGTH * of / skies;
  }
  light.position.copy(ball.center).addScaledVector(way.normalize(), ball.radius * 3);
}

/** Corners that the picture has to hold: those of the box of each mesh in place. */
function corners_of(model) {
  const corners = [], box = new THREE.Box3();
  model.updateMatrixWorld();
  model.traverse(node => {
    if (!node.isMesh) return;
    if (!node.geometry.boundingBox) node.geometry.computeBoundingBox();
    box.copy(node.geometry.boundingBox);
    for (let i = 0; i < 8; i++) {
      const corner = new THREE.Vector3(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z);
      corners.push(corner.applyMatrix4(node.matrixWorld));
    }
  });
  return corners;
}

/** Bounds of the corners in the picture, from -1 to 1 where it holds them; `null` if one is behind the camera. */
function bounds_in(camera, corners) {
  camera.clearViewOffset();
  camera.updateMatrixWorld();
  const whole = new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
  const seen = new THREE.Vector4(), bounds = new THREE.Box2();
  for (const { x, y, z } of corners) {
    seen.set(x, y, z, 1).applyMatrix4(whole);
    if (seen.w < 0.1) return null;
    bounds.expandByPoint(new THREE.Vector2(seen.x / seen.w, seen.y / seen.w));
  }
  return bounds;
}

/**
 * A camera that sees the model from a direction, as near as the whole of it allows. With an eye height it looks level, so
 * that posts stay parallel. Its lens is shifted so that the model stands in the middle.
 */
function camera_from({ box, corners }, way, eye) {
  const camera = new THREE.PerspectiveCamera(26, WIDTH / HEIGHT, 0.1, 100000);
  const middle = box.getCenter(new THREE.Vector3()), size = box.getSize(new THREE.Vector3()).length();
  const bounds_from = far => {
    camera.position.copy(middle).addScaledVector(way, far);
    if (eye !== undefined) camera.position.y = eye;
    camera.lookAt(middle.x, eye ?? middle.y, middle.z);
    return bounds_in(camera, corners);
  };
  let near = size * 0.3, far = size * 6;
  for (let step = 0; step < 24; step++) {
    const half = (near + far) / 2, extent = bounds_from(half)?.getSize(new THREE.Vector2());
    if (!extent || extent.x > 2 * 0.9 || extent.y > 2 * 0.8) near = half; else far = half;
  }
  const centre = bounds_from(far).getCenter(new THREE.Vector2());
  camera.userData.shift = new THREE.Vector2(centre.x * WIDTH / 2, -centre.y * HEIGHT / 2); // pixels
  camera.near = size / 200;
  camera.far = size * 80;
  tremble(camera, 0, 0);
  return camera;
}

/** Shifts the picture by a share of a pixel, beside the shift of its lens. */
function tremble(camera, x, y) {
  const { shift } = camera.userData;
  camera.setViewOffset(WIDTH, HEIGHT, shift.x + x, shift.y + y, WIDTH, HEIGHT);
}

const copy = new THREE.ShaderMaterial({
  uniforms: { picture: { value: null }, share: { value: 1 } },
  vertexShader: 'varying vec2 at; void main() { at = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }',
  fragmentShader: 'varying vec2 at; uniform sampler2D picture; uniform float share; void main() { gl_FragColor = vec4(texture2D(picture, at).rgb * share, 1.0); }',
  blending: THREE.AdditiveBlending, depthTest: false, depthWrite: false, transparent: true,
});
const develop = new THREE.ShaderMaterial({
  uniforms: { picture: { value: null } },
  vertexShader: copy.vertexShader,
  fragmentShader: `varying vec2 at; uniform sampler2D picture; void main() { gl_FragColor = vec4(texture2D(picture, at).rgb, 1.0);
    #include <tonemapping_fragment>
    #include <colorspace_fragment>
  }`,
  depthTest: false, depthWrite: false,
});
const screen_camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 1);

/** Draws a picture over the whole target (the canvas if there is none). */
function draw(material, target) {
  const scene = new THREE.Scene();
  const quad = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material);
  quad.frustumCulled = false;
  scene.add(quad);
  renderer.setRenderTarget(target);
  renderer.render(scene, screen_camera);
  quad.geometry.dispose();
}

/** Takes pictures of the Nth model with so many lights, of a size in pixels: data URLs by the name of the view. */
window.take = async (n, of, views, size) => {
  [WIDTH, HEIGHT] = size;
  renderer.setSize(WIDTH, HEIGHT);
  const set = await stage(n);
  const level = Math.min(0, set.box.min.y);
  const from = {
    front: () => camera_from(set, new THREE.Vector3(-0.62, 0, 1).normalize(), level + EYE),
    eaves: () => camera_from(set, new THREE.Vector3(-0.62, 0, 1).normalize(), level + 0.55 * (set.box.max.y - level)),
    above: () => camera_from(set, new THREE.Vector3(0.72, 0.5, 1).normalize()),
    back: () => camera_from(set, new THREE.Vector3(-0.75, 0.5, -1).normalize()),
  };
  const cameras = Object.fromEntries(views.map(view => [view, from[view]()]));
  const shot = new THREE.WebGLRenderTarget(WIDTH, HEIGHT, { type: THREE.HalfFloatType });
  const sums = Object.keys(cameras).map(() => new THREE.WebGLRenderTarget(WIDTH, HEIGHT, { type: THREE.FloatType, depthBuffer: false }));
  for (const sum of sums) { renderer.setRenderTarget(sum); renderer.clear(); }
  renderer.autoClear = true;
  for (let i = 0; i < of; i++) {
    shine(set, i, of);
    renderer.shadowMap.needsUpdate = true;
    for (const [k, camera] of Object.values(cameras).entries()) {
      tremble(camera, even(i + 1, 2) - 0.5, even(i + 1, 3) - 0.5);
      renderer.toneMapping = THREE.NoToneMapping;
      renderer.autoClear = true;
      renderer.setRenderTarget(shot);
      renderer.render(set.scene, camera);
      copy.uniforms.picture.value = shot.texture;
      copy.uniforms.share.value = 1 / of;
      renderer.autoClear = false;
      draw(copy, sums[k]);
    }
  }
  const pictures = {};
  renderer.toneMapping = THREE.ACESFilmicToneMapping;
  renderer.toneMappingExposure = 0.8;
  renderer.autoClear = true;
  for (const [k, view] of Object.keys(cameras).entries()) {
    develop.uniforms.picture.value = sums[k].texture;
    draw(develop, null);
    pictures[view] = renderer.domElement.toDataURL('image/jpeg', 0.88);
  }
  for (const target of [shot, ...sums]) target.dispose();
  set.light.dispose();
  set.model.traverse(node => node.geometry?.dispose());
  return pictures;
};
window.ready = true;
