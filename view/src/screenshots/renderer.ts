// Renders screenshots: the model on gravel under the sky. See screenshots.ts for the lighting.

import * as THREE from 'three';
import { Mirrors } from '../mirror/mirrors.ts';
import type { Model } from '../model/model.ts';
import { REFLECTION, skyReflections } from './reflections.ts';
import { type Elevation, elevationCamera, ELEVATIONS, projectedBounds, cornersOf, type View, directionOf } from '../scene/views.ts';

const EYE_HEIGHT = 1.5; // metres
/** Direction to the usual sun: from the south-west, a little behind the camera of the front view. */
const AFTERNOON = new THREE.Vector3(-0.55, 0.72, 0.62).normalize();
const SUN_COLOUR = new THREE.Color(1.0, 0.93, 0.82), SKY_COLOUR = new THREE.Color(0.86, 0.93, 1.0);
const SUN_STRENGTH = 3.8, SKY_STRENGTH = 2.1, SUN_SHARE = 0.4; // fraction of the lights that represent the sun
const HAZE = new THREE.Color(0.66, 0.77, 0.88), ZENITH = new THREE.Color(0.13, 0.32, 0.70);

/** A low-discrepancy number in [0, 1): the van der Corput sequence. */
export function vanDerCorput(index: number, base: number): number {
  let result = 0;
  for (let share = 1 / base; index > 0; index = Math.floor(index / base), share /= base) result += share * (index % base);
  return result;
}

/** A dome coloured from the haze at the horizon to the zenith. */
function skyDome(radius: number, sun: THREE.Vector3): THREE.Mesh {
  const material = new THREE.ShaderMaterial({
    side: THREE.BackSide, depthWrite: false,
    uniforms: { haze: { value: HAZE }, zenith: { value: ZENITH }, sun: { value: sun } },
    vertexShader: 'varying vec3 way; void main() { way = position; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }',
    fragmentShader: `varying vec3 way; uniform vec3 haze, zenith, sun; void main() {
      vec3 d = normalize(way); float up = pow(clamp(d.y, 0.0, 1.0), 0.55);
      float glow = pow(max(dot(d, sun), 0.0), 6.0) * 0.25;
      gl_FragColor = vec4(mix(haze, zenith, up) + glow * vec3(1.0, 0.9, 0.7), 1.0); }`,
  });
  return new THREE.Mesh(new THREE.SphereGeometry(radius, 48, 24), material);
}

/** Colour of the ground in reflections without an image. */
const GROUND = new THREE.Color(0x8c8474);

/** Procedural gravel texture. */
function groundTexture(): THREE.Texture {
  const size = 512, canvas = new OffscreenCanvas(size, size), context = canvas.getContext('2d')!;
  const image = context.createImageData(size, size);
  let grain = 12345;
  for (let i = 0; i < image.data.length; i += 4) {
    grain = (Math.imul(grain, 1664525) + 1013904223) >>> 0;
    const value = 226 + (grain >>> 24) / 255 * 29;
    image.data.set([value, value, value, 255], i);
  }
  context.putImageData(image, 0, 0);
  const texture = new THREE.CanvasTexture(canvas);
  texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.anisotropy = 2;
  return texture;
}

/** The ground: a disc that fades into the haze. */
function ground(ball: THREE.Sphere, level: number): THREE.Mesh {
  const radius = ball.radius * 40, map = groundTexture();
  map.repeat.setScalar(radius / 4);
  const plane = new THREE.Mesh(new THREE.CircleGeometry(radius, 96), new THREE.MeshLambertMaterial({ color: 0xa3967f, map }));
  plane.rotation.x = -Math.PI / 2;
  plane.position.set(ball.center.x, level, ball.center.z);
  plane.receiveShadow = true;
  return plane;
}

const copy = new THREE.ShaderMaterial({
  uniforms: { source: { value: null as THREE.Texture | null }, share: { value: 1 } },
  vertexShader: 'varying vec2 at; void main() { at = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }',
  fragmentShader: 'varying vec2 at; uniform sampler2D source; uniform float share; void main() { gl_FragColor = vec4(texture2D(source, at).rgb * share, 1.0); }',
  blending: THREE.AdditiveBlending, depthTest: false, depthWrite: false, transparent: true,
});
const toneMap = new THREE.ShaderMaterial({
  uniforms: { source: { value: null as THREE.Texture | null } },
  vertexShader: copy.vertexShader,
  fragmentShader: `varying vec2 at; uniform sampler2D source; void main() { gl_FragColor = vec4(texture2D(source, at).rgb, 1.0);
    #include <tonemapping_fragment>
    #include <colorspace_fragment>
  }`,
  depthTest: false, depthWrite: false,
});

/** Metres east, north and up in the file's frame. */
export type Place = [number, number, number];

/** A camera at a place of its own; `fov` is the vertical angle of view, degrees. */
export interface StandPoint { from: Place; to: Place; fov: number }

/** A preset view, an elevation, or a camera at a place of its own. */
export type Viewpoint = View | Elevation | StandPoint;

type Camera = THREE.PerspectiveCamera | THREE.OrthographicCamera;

/** What the views show: all houses of the model, or the one with this number; and the direction to the sun. */
export interface Shown { azimuth: number; house: number | null; sun: THREE.Vector3 | null }

const isElevation = (view: string): view is Elevation => (ELEVATIONS as readonly string[]).includes(view);

export class ScreenshotRenderer {
  readonly renderer = new THREE.WebGLRenderer({ antialias: false, preserveDrawingBuffer: true });
  readonly scene = new THREE.Scene();
  readonly #mirrors: Mirrors;
  #light = new THREE.DirectionalLight(0xffffff, 1);
  #ball: THREE.Sphere;
  #sun: THREE.Vector3;
  #azimuth: number;
  #corners: THREE.Vector3[];
  #box: THREE.Box3;
  #quad = new THREE.Mesh(new THREE.PlaneGeometry(2, 2));
  #screen = new THREE.Scene();

  constructor(readonly model: Model, readonly width: number, readonly height: number, shown: Shown) {
    const { renderer, scene } = this;
    const sun = this.#sun = shown.sun ?? AFTERNOON;
    this.#azimuth = shown.azimuth;
    renderer.setSize(width, height);
    renderer.shadowMap.enabled = true;
    renderer.shadowMap.type = THREE.BasicShadowMap; // The sum over many lights softens the shadows.
    renderer.shadowMap.autoUpdate = false;
    document.body.append(renderer.domElement);
    const reflections = scene.environment = skyReflections(renderer);
    scene.environmentIntensity = REFLECTION;
    for (const { mesh } of model.chunks) {
      const { material } = mesh, glass = material.transparent || (material as THREE.MeshPhysicalMaterial).transmission > 0;
      mesh.castShadow = !glass;
      if (glass) material.envMap = reflections; // In full; the other surfaces see less of the sky.
      for (const map of [material.map, material.normalMap]) if (map) map.anisotropy = 2;
      scene.add(mesh);
    }
    const ball = this.#ball = model.box.getBoundingSphere(new THREE.Sphere());
    const level = Math.min(0, model.box.min.y) - 0.002;
    const parts = model.parts.filter(part => shown.house === null || part.house === shown.house);
    this.#corners = cornersOf(parts.map(part => part.box));
    this.#box = new THREE.Box3().setFromPoints(this.#corners);
    scene.add(ground(ball, level), skyDome(ball.radius * 60, sun));
    scene.fog = new THREE.Fog(HAZE, ball.radius * 8, ball.radius * 38);
    const bounce = new THREE.HemisphereLight(0xffffff, 0xd8c4a0, 0.35); // Light reflected by the ground and the neighbours.
    const light = this.#light, reach = ball.radius * 1.1;
    light.castShadow = true;
    light.shadow.mapSize.setScalar(2048);
    Object.assign(light.shadow.camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: 0, far: reach * 6 });
    light.shadow.normalBias = reach / 2048 * 2;
    light.target.position.copy(ball.center);
    scene.add(bounce, light, light.target);
    this.#mirrors = new Mirrors(renderer, scene);
    Object.assign(this.#mirrors.options, { cullOccluded: false, depth: 2, shift: 1, sky: { zenith: ZENITH, horizon: HAZE, ground: GROUND } });
    this.#mirrors.show(model);
    this.#quad.frustumCulled = false;
    this.#screen.add(this.#quad);
  }

  /** Renders the views with `of` lights each. */
  async render(views: Viewpoint[], of: number, then: (view: Viewpoint, png: Blob) => Promise<void>) {
    const { renderer, width, height } = this;
    const cameras = views.map(view => this.#cameraOf(view));
    const shot = new THREE.WebGLRenderTarget(width, height, { type: THREE.HalfFloatType });
    const sums = cameras.map(() => new THREE.WebGLRenderTarget(width, height, { type: THREE.FloatType, depthBuffer: false }));
    for (const sum of sums) {
      renderer.setRenderTarget(sum);
      renderer.clear();
    }
    for (let i = 0; i < of; i++) {
      this.#placeLight(i, of);
      renderer.shadowMap.needsUpdate = true;
      for (const [k, { camera, shift }] of cameras.entries()) {
        camera.setViewOffset(width, height, shift.x + vanDerCorput(i + 1, 2) - 0.5, shift.y + vanDerCorput(i + 1, 3) - 0.5, width, height);
        renderer.toneMapping = THREE.NoToneMapping;
        renderer.autoClear = true;
        renderer.setRenderTarget(shot);
        this.#mirrors.paint(camera);
        copy.uniforms.source!.value = shot.texture;
        copy.uniforms.share!.value = 1 / of;
        renderer.autoClear = false;
        this.#draw(copy, sums[k]!);
      }
    }
    renderer.toneMapping = THREE.ACESFilmicToneMapping;
    renderer.toneMappingExposure = 0.8;
    renderer.autoClear = true;
    for (const [k, view] of views.entries()) {
      toneMap.uniforms.source!.value = sums[k]!.texture;
      this.#draw(toneMap, null);
      const png = await new Promise<Blob | null>(done => renderer.domElement.toBlob(done, 'image/png'));
      if (png) await then(view, png);
    }
    for (const target of [shot, ...sums]) target.dispose();
  }

  #cameraOf(view: Viewpoint): { camera: Camera; shift: THREE.Vector2 } {
    if (typeof view !== 'string') return this.standing(view);
    if (!isElevation(view)) return this.camera(view);
    const camera = elevationCamera(view, this.#azimuth, this.#corners, this.width / this.height);
    return { camera, shift: new THREE.Vector2() };
  }

  /**
   * A camera in a view's direction, as close as the model's size allows. With an eye height it is level, so that posts stay
   * vertical, and the lens is shifted (pixels) to centre the model.
   */
  camera(view: View): { camera: THREE.PerspectiveCamera; shift: THREE.Vector2 } {
    const box = this.#box, { way, level } = directionOf(view, this.#azimuth);
    const camera = new THREE.PerspectiveCamera(26, this.width / this.height, 0.1, 100000);
    const middle = box.getCenter(new THREE.Vector3()), size = box.getSize(new THREE.Vector3()).length();
    const low = Math.min(0, box.min.y);
    const eye = level === undefined ? undefined : low + (level === null ? EYE_HEIGHT : level * (box.max.y - low));
    const boundsFrom = (far: number) => {
      camera.position.copy(middle).addScaledVector(way, far);
      if (eye !== undefined) camera.position.y = eye;
      camera.lookAt(middle.x, eye ?? middle.y, middle.z);
      return projectedBounds(camera, this.#corners);
    };
    let near = size * 0.3, far = size * 6;
    for (let step = 0; step < 24; step++) {
      const half = (near + far) / 2, extent = boundsFrom(half)?.getSize(new THREE.Vector2());
      if (!extent || extent.x > 2 * 0.9 || extent.y > 2 * 0.8) near = half; else far = half;
    }
    const centre = boundsFrom(far)?.getCenter(new THREE.Vector2()) ?? new THREE.Vector2();
    camera.near = size / 200;
    camera.far = this.#ball.radius * 160;
    return { camera, shift: new THREE.Vector2(centre.x * this.width / 2, -centre.y * this.height / 2) };
  }

  /** A camera at a place of its own. */
  standing({ from, to, fov }: StandPoint): { camera: THREE.PerspectiveCamera; shift: THREE.Vector2 } {
    const place = ([east, north, up]: Place) => new THREE.Vector3(east, up, -north).sub(this.model.origin);
    const size = this.model.box.getSize(new THREE.Vector3()).length();
    const camera = new THREE.PerspectiveCamera(fov, this.width / this.height, 0.05, 1);
    camera.position.copy(place(from));
    camera.lookAt(place(to));
    camera.far = size * 80;
    return { camera, shift: new THREE.Vector2() };
  }

  /** Moves the light to sample `i` of `of`: the first ones sample the sun's disc, the others the sky. */
  #placeLight(i: number, of: number) {
    const light = this.#light, ball = this.#ball;
    const suns = Math.max(1, Math.round(of * SUN_SHARE)), skies = of - suns;
    const u = vanDerCorput(i + 1, 2), v = vanDerCorput(i + 1, 3), way = new THREE.Vector3();
    if (i < suns) {
      way.set(u - 0.5, v - 0.5, vanDerCorput(i + 1, 5) - 0.5).multiplyScalar(0.035).add(this.#sun);
      light.color.copy(SUN_COLOUR);
      light.intensity = SUN_STRENGTH * of / suns;
    } else {
      // Uniform in the cosine to the zenith, so that equal weights give an even sky.
      const height = Math.sqrt(1 - u * 0.94), around = v * 2 * Math.PI, flat = Math.sqrt(1 - height * height);
      way.set(flat * Math.cos(around), height, flat * Math.sin(around));
      light.color.copy(SKY_COLOUR);
      light.intensity = SKY_STRENGTH * of / skies;
    }
    light.position.copy(ball.center).addScaledVector(way.normalize(), ball.radius * 3);
  }

  /** Draws a full-screen quad into a target, or the canvas if there is none. */
  #draw(material: THREE.Material, target: THREE.WebGLRenderTarget | null) {
    this.#quad.material = material;
    this.renderer.setRenderTarget(target);
    this.renderer.render(this.#screen, this.#quadCamera);
  }

  #quadCamera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 1);
}
