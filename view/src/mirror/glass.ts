// Shader of reflective glass, added to flat and physically based materials.
//
// The image that a pane reflects lies in an atlas, at a place that follows from the pane's position on the screen. A table
// gives it for each view and layer of panes: u = x * scale + shift, v alike. The pane reflects
//
//     weight = share + (1 - share) * (1 - cos)^5
//
// of the light, where cos is the cosine of the angle between the view and the pane's normal (Schlick's approximation, with
// the texture's share at normal incidence); the rest is the pane's own colour and what is seen through it. Glass without a
// mirror image reflects the plain sky or ground: with its own share where its facade reflects, faintly elsewhere.

import * as THREE from 'three';
import { ATTRIBUTE } from './walls.ts';

/** Share of glass that reflects only the sky: that of plain glass (refractive index 1.5). */
export const FAINT = 0.04;
/** Entries per row of the table's texture. */
const WIDTH = 256;

/** Transform from screen to atlas: u = x * scale + shift, v alike. A scale of 0 means no image. */
export type Entry = [uScale: number, uShift: number, vScale: number, vShift: number];

/** The uniforms and the table shared by all glass of a scene. */
export class Glass {
  readonly uniforms = {
    mirrorAtlas: { value: null as THREE.Texture | null },
    mirrorTable: { value: null as THREE.DataTexture | null },
    /** Offset of the current view in the table; -1 if it sees no mirrors. */
    mirrorFirst: { value: -1 },
    mirrorZenith: { value: new THREE.Color(0xcfdde6) },
    mirrorHorizon: { value: new THREE.Color(0xcfdde6) },
    mirrorGround: { value: new THREE.Color(0xcfdde6) },
  };
  #layers = 0;
  #known = new WeakSet<THREE.Material>();
  #entries = new Float32Array(0);

  constructor() { this.#make(1); }

  /** Allocates the table for a number of views and layers. */
  beginTable(views: number, layers: number) {
    this.#layers = layers;
    this.#make(Math.max(1, views * layers));
    this.#entries.fill(0);
  }

  set(view: number, layer: number, entry: Entry) {
    this.#entries.set(entry, (view * this.#layers + layer) * 4);
  }

  /** Uploads the table. */
  endTable() {
    this.uniforms.mirrorTable.value!.needsUpdate = true;
  }

  /** Selects the view to draw next: its row in the table, -1 for no mirrors, and the atlas with their images. */
  selectView(number: number, atlas: THREE.Texture | null) {
    this.uniforms.mirrorFirst.value = number < 0 ? -1 : number * this.#layers;
    this.uniforms.mirrorAtlas.value = atlas;
  }

  /** Adds the reflection shader to a material. */
  attach(material: THREE.MeshStandardMaterial, environment: THREE.Texture | null) {
    if (this.#known.has(material)) return;
    this.#known.add(material);
    const { reflection } = material.userData as { reflection?: number };
    const share = { value: reflection ?? 0 }, before = material.onBeforeCompile;
    // Environment maps and baked reflections (for viewers without this shader) would reflect twice.
    // The one of the scene is weighed by the scene, that of a material by the material.
    if ('envMapIntensity' in material) Object.assign(material, { envMap: environment, envMapIntensity: 0 });
    if ('emissiveIntensity' in material) material.emissiveIntensity = 0;
    material.onBeforeCompile = (shader, renderer) => {
      before.call(material, shader, renderer);
      Object.assign(shader.uniforms, this.uniforms, { mirrorShare: share });
      shader.vertexShader = shader.vertexShader
        .replace('#include <common>', `#include <common>${VERTEX}`)
        .replace('#include <project_vertex>', `#include <project_vertex>${AT_VERTEX}`);
      shader.fragmentShader = shader.fragmentShader
        .replace('#include <common>', `#include <common>${FRAGMENT}`)
        .replace('#include <opaque_fragment>', `${AT_FRAGMENT}\n#include <opaque_fragment>`);
    };
    material.customProgramCacheKey = () => 'mirror';
    material.needsUpdate = true;
  }

  dispose() { this.uniforms.mirrorTable.value?.dispose(); }

  #make(entries: number) {
    const rows = Math.ceil(entries / WIDTH);
    if (this.#entries.length >= rows * WIDTH * 4) return;
    this.uniforms.mirrorTable.value?.dispose();
    this.#entries = new Float32Array(rows * WIDTH * 4);
    this.uniforms.mirrorTable.value = new THREE.DataTexture(this.#entries, WIDTH, rows, THREE.RGBAFormat, THREE.FloatType);
    this.endTable();
  }
}

const VERTEX = `
attribute float ${ATTRIBUTE};
uniform highp sampler2D mirrorTable;
uniform int mirrorFirst;
flat varying vec4 vMirrorPlace;
flat varying float vMirrorLayer;
varying vec3 vMirrorAt;
varying vec3 vMirrorNormal;
`;

const AT_VERTEX = `
vMirrorAt = (modelMatrix * vec4(transformed, 1.0)).xyz;
vMirrorNormal = mat3(modelMatrix) * normal;
vMirrorLayer = ${ATTRIBUTE};
vMirrorPlace = vec4(0.0);
if (${ATTRIBUTE} >= 0.0 && mirrorFirst >= 0) {
  int mirrorEntry = mirrorFirst + int(${ATTRIBUTE} + 0.5);
  vMirrorPlace = texelFetch(mirrorTable, ivec2(mirrorEntry % ${WIDTH}, mirrorEntry / ${WIDTH}), 0);
}
`;

const FRAGMENT = `
uniform sampler2D mirrorAtlas;
uniform float mirrorShare;
uniform vec3 mirrorZenith, mirrorHorizon, mirrorGround;
flat varying vec4 vMirrorPlace;
flat varying float vMirrorLayer;
varying vec3 vMirrorAt;
varying vec3 vMirrorNormal;
`;

const AT_FRAGMENT = `
{
  vec3 mirrorWay = isOrthographic ? -vec3(viewMatrix[0][2], viewMatrix[1][2], viewMatrix[2][2]) : normalize(vMirrorAt - cameraPosition);
  vec3 mirrorNormal = normalize(vMirrorNormal);
  float mirrorFirstShare = vMirrorLayer >= 0.0 ? mirrorShare : ${FAINT};
  float mirrorCos = abs(dot(mirrorNormal, mirrorWay));
  float mirrorWeight = mirrorFirstShare + (1.0 - mirrorFirstShare) * pow(1.0 - mirrorCos, 5.0);
  vec3 mirrored;
  if (vMirrorPlace.x != 0.0) {
    mirrored = texture2D(mirrorAtlas, gl_FragCoord.xy * vMirrorPlace.xz + vMirrorPlace.yw).rgb;
  } else {
    float mirrorUp = reflect(mirrorWay, mirrorNormal).y;
    mirrored = mix(mirrorHorizon, mirrorZenith, pow(max(mirrorUp, 0.0), 0.6));
    mirrored = mix(mirrorGround, mirrored, smoothstep(-0.02, 0.02, mirrorUp));
  }
  #ifdef OPAQUE
  float mirrorCover = 1.0;
  #else
  float mirrorCover = diffuseColor.a;
  #endif
  // What lies behind is seen through the remaining share.
  float mirrorAll = 1.0 - (1.0 - mirrorWeight) * (1.0 - mirrorCover);
  outgoingLight = ((1.0 - mirrorWeight) * mirrorCover * outgoingLight + mirrorWeight * mirrored) / max(mirrorAll, 1e-4);
  diffuseColor.a = mirrorAll;
}
`;
