// The environment of a model: sky, ground, sun and sky light, dim at night. The colours are those of paper and ink rather
// than of a photograph.

import * as THREE from 'three';
import { type Sun, sunDirection } from './sun.ts';

const DAY = { horizon: 0xf4efe3, zenith: 0xa9c0d0, ground: 0xcfc5b0 };
const DUSK = { horizon: 0xe9b48c, zenith: 0x5d7391, ground: 0x9a8a78 };
const NIGHT = { horizon: 0x2b3440, zenith: 0x0e141d, ground: 0x2a2a2c };
/** Strength of the sky by day: it stands for its reflections on glossy surfaces too, which have none of their own here. */
const SKY = 2.3;
type Colours = Record<keyof typeof DAY, THREE.Color>;

const colours = (of: typeof DAY): Colours => ({
  horizon: new THREE.Color(of.horizon), zenith: new THREE.Color(of.zenith), ground: new THREE.Color(of.ground),
});

export class Environment {
  readonly group = new THREE.Group();
  readonly sun = new THREE.DirectionalLight(0xfff2dd, 2.9);
  readonly sky = new THREE.HemisphereLight(0xeaf1f8, 0xb0a288, SKY);
  #now: Sun = { azimuth: 215, altitude: 42 };
  #middle = new THREE.Vector3();
  #reach = 10;
  #dome: THREE.Mesh<THREE.SphereGeometry, THREE.ShaderMaterial>;
  #ground: THREE.Mesh<THREE.CircleGeometry, THREE.ShaderMaterial>;
  #colours = colours(DAY);

  constructor() {
    const { horizon, zenith, ground } = this.#colours;
    this.#dome = new THREE.Mesh(new THREE.SphereGeometry(1, 32, 16), new THREE.ShaderMaterial({
      side: THREE.BackSide, depthWrite: false, depthTest: false, fog: false,
      uniforms: { horizon: { value: horizon }, zenith: { value: zenith } },
      vertexShader: `varying vec3 way; void main() { way = position;
        gl_Position = (projectionMatrix * vec4(mat3(modelViewMatrix) * position, 1.0)).xyww; }`,
      fragmentShader: `varying vec3 way; uniform vec3 horizon, zenith; void main() {
        float up = pow(clamp(normalize(way).y, 0.0, 1.0), 0.6);
        gl_FragColor = vec4(mix(horizon, zenith, up), 1.0);
        #include <colorspace_fragment>
      }`,
    }));
    this.#dome.frustumCulled = false;
    this.#dome.renderOrder = -2;
    this.#dome.name = 'sky';
    this.#ground = new THREE.Mesh(new THREE.CircleGeometry(1, 64), groundMaterial(ground, horizon));
    this.#ground.rotation.x = -Math.PI / 2;
    this.#ground.name = 'ground';
    this.#ground.receiveShadow = true;
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.setScalar(2048);
    this.group.add(this.#dome, this.#ground, this.sky, this.sun, this.sun.target);
    this.fit(new THREE.Box3(new THREE.Vector3(-5, 0, -5), new THREE.Vector3(5, 5, 5)));
  }

  /** Adjusts light and ground to a model's bounds. */
  fit(box: THREE.Box3) {
    const ball = box.getBoundingSphere(new THREE.Sphere());
    const reach = Math.max(1, ball.radius * 1.15);
    this.shade(ball.center, reach);
    // A town on high ground stands on its lowest place.
    const level = (box.min.y > 2 ? box.min.y : Math.min(0, box.min.y)) - 0.003;
    this.#ground.position.set(ball.center.x, level, ball.center.z);
    this.#ground.scale.setScalar(Math.max(60, reach * 14));
  }

  /** The height of the ground, metres. */
  get level(): number { return this.#ground.position.y; }

  /** Adjusts the shadows to what lies within a reach of a place, metres. */
  shade(middle: THREE.Vector3, reach: number) {
    const { sun } = this, { camera } = sun.shadow;
    this.#middle.copy(middle);
    this.#reach = reach;
    Object.assign(camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: 0, far: reach * 4 });
    camera.updateProjectionMatrix();
    sun.shadow.normalBias = reach / 2048 * 2.5;
    this.#place();
  }

  /** Moves the sun. */
  light(sun: Sun) {
    this.#now = sun;
    this.#place();
  }

  get now(): Readonly<Sun> { return this.#now; }

  /** Current colours of sky and ground; updated with the sun. */
  get colours(): Readonly<Colours> { return this.#colours; }

  #place() {
    const { sun, sky } = this, { altitude } = this.#now;
    const [x, y, z] = sunDirection({ azimuth: this.#now.azimuth, altitude: Math.max(altitude, -5) });
    sun.target.position.copy(this.#middle);
    sun.position.set(x, y, z).multiplyScalar(this.#reach * 2).add(this.#middle);
    // Full light above 25 degrees, none below the horizon.
    const high = THREE.MathUtils.smoothstep(altitude, -1, 25), day = THREE.MathUtils.smoothstep(altitude, -9, 6);
    sun.intensity = 2.9 * Math.sqrt(THREE.MathUtils.smoothstep(altitude, -0.8, 25)) * (altitude > -0.8 ? 1 : 0);
    sun.castShadow = altitude > -0.8;
    sun.color.set(0xff9a52).lerp(new THREE.Color(0xfff2dd), high);
    sky.intensity = 0.12 + (SKY - 0.12) * day;
    sky.color.set(0x9fb4d8).lerp(new THREE.Color(0xeaf1f8), day);
    const of = colours(NIGHT), dusk = colours(DUSK), noon = colours(DAY);
    for (const name of ['horizon', 'zenith', 'ground'] as const) {
      this.#colours[name].copy(of[name]).lerp(dusk[name], day).lerp(noon[name], high);
    }
  }
}

/**
 * Plain ground that fades into the horizon and receives the sun's shadows. It is one surface: two discs close above each other
 * could not be told apart in the depth buffer from afar.
 */
function groundMaterial(ground: THREE.Color, horizon: THREE.Color): THREE.ShaderMaterial {
  const material = new THREE.ShaderMaterial({
    lights: true,
    // Roads lie a few centimetres over it, which nobody can tell from afar.
    polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 8,
    uniforms: THREE.UniformsUtils.merge([THREE.UniformsLib.lights, { shade: { value: new THREE.Color(0x2a2418) }, depth: { value: 0.6 } }]),
    vertexShader: `varying vec2 at;
      #include <common>
      #include <shadowmap_pars_vertex>
      void main() {
        at = position.xy;
        #include <beginnormal_vertex>
        #include <defaultnormal_vertex>
        #include <begin_vertex>
        #include <project_vertex>
        #include <worldpos_vertex>
        #include <shadowmap_vertex>
      }`,
    defines: { REACHED: '0.43' }, // Share of the ground that shadows reach.
    fragmentShader: `varying vec2 at; uniform vec3 ground, horizon, shade; uniform float depth;
      #include <common>
      #include <bsdfs>
      #include <lights_pars_begin>
      #include <shadowmap_pars_fragment>
      #include <shadowmask_pars_fragment>
      void main() {
        vec3 lit = mix(ground, horizon, smoothstep(0.06, 0.95, length(at)));
        if (length(at) < REACHED) lit = mix(lit, shade, depth * (1.0 - getShadowMask()));
        gl_FragColor = vec4(lit, 1.0);
        #include <colorspace_fragment>
      }`,
  });
  Object.assign(material.uniforms, { ground: { value: ground }, horizon: { value: horizon } }); // Shared, not copied.
  return material;
}
