// A frame of few pixels, for machines that take long for one while things move: it is drawn into a picture, which is then
// spread over the canvas. The canvas keeps its size, since to give it another one takes longer than to draw a house.

import * as THREE from 'three';
import { FullScreenQuad } from 'three/addons/postprocessing/Pass.js';

/** Of the canvas's sides, at least and at most. */
const LEAST = 0.25, MOST = 0.7;

export class Draft {
  #renderer: THREE.WebGLRenderer;
  // What is drawn into it is what the canvas would get: tones mapped, in the colours of the screen.
  #picture = Object.assign(new THREE.WebGLRenderTarget(1, 1, { colorSpace: THREE.SRGBColorSpace, internalFormat: 'RGBA8' }), { isXRRenderTarget: true });
  #copy = new FullScreenQuad(new THREE.ShaderMaterial({
    depthTest: false, depthWrite: false, toneMapped: false,
    uniforms: { picture: { value: this.#picture.texture } },
    vertexShader: 'varying vec2 at; void main() { at = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }',
    fragmentShader: 'varying vec2 at; uniform sampler2D picture; void main() { gl_FragColor = vec4(texture2D(picture, at).rgb, 1.0); }',
  }));

  constructor(renderer: THREE.WebGLRenderer) {
    this.#renderer = renderer;
  }

  /** What is drawn from now on goes into the picture; `share` = that of the canvas's pixels that there is time for. */
  begin(share: number) {
    const side = THREE.MathUtils.clamp(Math.sqrt(share), LEAST, MOST);
    const size = this.#renderer.getDrawingBufferSize(new THREE.Vector2()).multiplyScalar(side).ceil();
    this.#picture.setSize(size.x, size.y);
    this.#renderer.setRenderTarget(this.#picture);
  }

  /** Shows the picture. */
  end() {
    this.#renderer.setRenderTarget(null);
    this.#copy.render(this.#renderer);
  }
}
