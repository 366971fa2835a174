// The script of the page of house types: a list of types, sliders, and the model that belongs to them.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { RoomEnvironment } from 'three/addons/environments/RoomEnvironment.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

const { root, language, words, types, live } = JSON.parse(document.querySelector('#types').textContent);
const place = document.querySelector('#houses');

/** An element with attributes and children. */
function make(name, attributes, ...children) {
  const element = Object.assign(document.createElement(name), attributes);
  element.append(...children);
  return element;
}

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
renderer.toneMapping = THREE.NeutralToneMapping;
renderer.shadowMap.enabled = true;
const scene = new THREE.Scene(), camera = new THREE.PerspectiveCamera(35, 1, 0.1, 1000);
scene.background = new THREE.Color(0xe9edf0);
scene.environment = new THREE.PMREMGenerator(renderer).fromScene(new RoomEnvironment()).texture;
scene.environmentIntensity = 0.4;
const sun = new THREE.DirectionalLight(0xfff4e0, 2.5);
sun.castShadow = true;
sun.shadow.mapSize.set(2048, 2048);
sun.shadow.normalBias = 0.03;
const ground = new THREE.Mesh(new THREE.CircleGeometry(1, 64).rotateX(-Math.PI / 2), new THREE.ShadowMaterial({ opacity: 0.35 }));
ground.receiveShadow = true;
scene.add(sun, sun.target, ground);
const controls = new OrbitControls(camera, renderer.domElement);
const draw = () => renderer.render(scene, camera);
controls.addEventListener('change', draw);

let model, asked = 0;

/** Frees what a model holds. */
function drop(old) {
  scene.remove(old);
  old.traverse(node => {
    node.geometry?.dispose();
    for (const value of Object.values(node.material ?? {})) if (value?.isTexture) value.dispose();
    node.material?.dispose();
  });
}

const worker = live ? new Worker(`${root}types-worker.js`) : undefined;
const text = make('textarea', { spellcheck: false, rows: 16 }), said = make('pre', {});
text.setAttribute('aria-label', words.text);

let turn = Promise.resolve();

/** Compiles the text with parameters in its turn, unless something else is wanted by then: the loaded model. */
function compiled(number, name, parameters) {
  const mine = turn.then(() => number === asked ? posted(number, name, parameters) : undefined);
  turn = mine.catch(() => {});
  return mine;
}

/** Compiles in the worker. Says what was found. */
function posted(number, name, parameters) {
  const module = new URL(`${root}hsd.wasm`, location.href).href;
  return new Promise((done, failed) => {
    const listen = ({ data }) => {
      if (data.number !== number) return;
      worker.removeEventListener('message', listen);
      if (number === asked) said.textContent = data.fault ?? data.messages;
      if (data.fault) failed(new Error(data.fault));
      else if (data.model.byteLength === 0) done(undefined);
      else new GLTFLoader().parseAsync(data.model, '').then(done, failed);
    };
    worker.addEventListener('message', listen);
    worker.postMessage({ number, module, job: { name, text: text.value, parameters, detail: 1, japanese: language === 'ja' } });
  });
}

/** Shows a model, that of a file or the one that `wish` begins; the camera stays unless it is that of another type. */
async function show(wish, anew) {
  const number = ++asked;
  place.dataset.state = 'loading';
  const made = await (typeof wish === 'string' ? new GLTFLoader().loadAsync(root + wish) : wish(number));
  // A text with errors leaves the model as it was.
  if (!made) {
    if (number === asked) place.dataset.state = 'shown';
    return;
  }
  const next = made.scene;
  if (number !== asked) return drop(next);
  if (model) drop(model);
  model = next;
  model.traverse(node => { node.castShadow = node.receiveShadow = true; });
  scene.add(model);
  const box = new THREE.Box3().setFromObject(model), { center, radius } = box.getBoundingSphere(new THREE.Sphere());
  sun.position.copy(center).add(new THREE.Vector3(-1.1, 1.2, 0.6).multiplyScalar(radius * 2));
  sun.target.position.copy(center);
  Object.assign(sun.shadow.camera, { left: -radius * 1.5, right: radius * 1.5, top: radius * 1.5, bottom: -radius * 1.5, far: radius * 6 }).updateProjectionMatrix();
  ground.position.set(center.x, box.min.y, center.z);
  ground.scale.setScalar(radius * 2);
  if (anew) {
    Object.assign(camera, { near: radius / 100, far: radius * 40 }).updateProjectionMatrix();
    camera.position.copy(center).add(new THREE.Vector3(0.8, 0.35, 1.2).normalize().multiplyScalar(radius * 2.2));
    controls.target.copy(center);
  }
  controls.update();
  draw();
  place.dataset.triangles = renderer.info.render.triangles;
  place.dataset.state = 'shown';
}

const failed = error => { place.dataset.state = String(error); };
const sliders = make('div', { className: 'sliders' });

/** Shows a type with its sliders. */
function open(type) {
  text.value = type.text;
  const build = number => compiled(number, `${type.type}.hsd`, Object.fromEntries(inputs
    .filter(({ slider, input }) => Number(input.value) !== slider.at && text.value.includes(`<Param name="${slider.name}"`))
    .map(({ slider, input }) => [slider.name, slider.values[input.value]])));
  text.oninput = () => show(build, false).catch(failed);
  const inputs = type.sliders.map(slider => {
    const said = make('output', {}), input = make('input', { type: 'range', min: 0, max: slider.values.length - 1, step: 1, value: slider.at });
    const tell = () => {
      const value = slider.values[input.value], shown = words[value] ?? value;
      said.value = `${shown}${slider.unit ? ` ${slider.unit}` : ''}${Number(input.value) === slider.at ? ` (${words.as})` : ''}`;
    };
    input.addEventListener('input', () => {
      if (!live) for (const other of inputs) if (other.input !== input) { other.input.value = other.slider.at; other.tell(); }
      tell();
      show(live ? build : slider.files[input.value], false).catch(failed);
    });
    tell();
    return { slider, input, tell, row: make('label', { title: slider.doc[language] }, make('span', { textContent: slider.name }), input, said, make('small', { textContent: slider.doc[language] })) };
  });
  sliders.replaceChildren(...inputs.map(({ row }) => row));
  show(type.file, true).catch(failed);
}

const list = make('select', {}, ...types.map(({ type }) => make('option', { textContent: type, value: type })));
list.addEventListener('change', () => open(types[list.selectedIndex]));
place.append(make('label', {}, `${words.type} `, list), renderer.domElement, sliders);
if (live) place.append(make('details', {}, make('summary', { textContent: words.text }), text), said);
const size = () => {
  const width = place.clientWidth, height = Math.round(width * 0.6);
  renderer.setSize(width, height);
  camera.aspect = width / height;
  camera.updateProjectionMatrix();
  draw();
};
addEventListener('resize', size);
size();
open(types[0]);
