// The model in the output of a notebook: turn, zoom, and click a part to read its code, names and line.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { RoomEnvironment } from 'three/addons/environments/RoomEnvironment.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

const caption = document.querySelector('p');

/** The bytes of the model, which stand in the page as base64. */
function bytes() {
  const text = atob(document.querySelector('script[type="model/gltf-binary"]').textContent.trim());
  return Uint8Array.from(text, letter => letter.charCodeAt(0)).buffer;
}

/** What the text says of a thing: of it, or of the nearest thing that it is part of. */
function told(node) {
  for (let at = node; at; at = at.parent) {
    const { code, ja, en, kind, line } = at.userData;
    if (kind) return [code?.trim(), ja, en ?? kind, line && `${caption.dataset.line} ${line}`].filter(Boolean).join(' · ');
  }
  return '';
}

async function start() {
  const renderer = new THREE.WebGLRenderer({ antialias: true });
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  renderer.shadowMap.enabled = true;
  renderer.toneMapping = THREE.NeutralToneMapping;
  document.body.prepend(renderer.domElement);
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0xe9edf0);
  const light = new THREE.PMREMGenerator(renderer);
  scene.environment = light.fromScene(new RoomEnvironment()).texture;
  scene.environmentIntensity = 0.4;
  const { scene: model } = await new GLTFLoader().parseAsync(bytes(), '');
  model.traverse(node => { node.castShadow = node.receiveShadow = true; });
  scene.add(model);
  const ball = new THREE.Box3().setFromObject(model).getBoundingSphere(new THREE.Sphere());
  const sun = new THREE.DirectionalLight(0xfff4e0, 2.5);
  sun.position.copy(ball.center).add(new THREE.Vector3(-1.1, 1.2, 0.6).multiplyScalar(ball.radius * 2));
  sun.target.position.copy(ball.center);
  sun.castShadow = true;
  sun.shadow.mapSize.set(2048, 2048);
  sun.shadow.bias = -0.0005;
  sun.shadow.normalBias = 0.03;
  Object.assign(sun.shadow.camera, { left: -ball.radius * 1.5, right: ball.radius * 1.5, top: ball.radius * 1.5, bottom: -ball.radius * 1.5, far: ball.radius * 6 });
  scene.add(sun, sun.target);
  // The ground shows nothing but the shadow.
  const ground = new THREE.Mesh(new THREE.CircleGeometry(ball.radius * 2, 64).rotateX(-Math.PI / 2), new THREE.ShadowMaterial({ opacity: 0.35 }));
  ground.position.set(ball.center.x, new THREE.Box3().setFromObject(model).min.y, ball.center.z);
  ground.receiveShadow = true;
  scene.add(ground);
  const camera = new THREE.PerspectiveCamera(35, 1, ball.radius / 200, ball.radius * 40);
  camera.position.copy(ball.center).add(new THREE.Vector3(0.8, 0.35, 1.2).normalize().multiplyScalar(ball.radius * 2.2));
  const controls = new OrbitControls(camera, renderer.domElement);
  controls.target.copy(ball.center);

  // Drawn when something changes, so that many models in a notebook cost nothing.
  const draw = () => renderer.render(scene, camera);
  const size = () => {
    renderer.setSize(innerWidth, innerHeight);
    camera.aspect = innerWidth / Math.max(innerHeight, 1);
    camera.updateProjectionMatrix();
    draw();
  };
  addEventListener('resize', size);
  controls.addEventListener('change', draw);
  controls.update();
  size();
  let down;
  renderer.domElement.addEventListener('pointerdown', event => { down = [event.clientX, event.clientY]; });
  renderer.domElement.addEventListener('pointerup', event => {
    if (Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 4) return;
    const ray = new THREE.Raycaster();
    ray.setFromCamera(new THREE.Vector2(event.clientX / innerWidth * 2 - 1, 1 - event.clientY / innerHeight * 2), camera);
    caption.textContent = told(ray.intersectObject(model)[0]?.object);
  });
  document.body.dataset.triangles = renderer.info.render.triangles;
}

start().catch(error => { caption.textContent = String(error); });
