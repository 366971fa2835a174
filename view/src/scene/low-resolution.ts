// Low-resolution frames for slow machines: while the view changes, the scene is drawn into a small render target that is
// scaled up to the canvas. The canvas itself is not resized, because that costs more than drawing a house.

import * as THREE from 'three';
import { FullScreenQuad } from 'three/addons/postprocessing/Pass.js';

/** Bounds of the scale, as a fraction of the canvas's sides. */
const MIN_SCALE = 0.25, MAX_SCALE = 0.7;

export class LowResolutionPass {
  #renderer: THREE.WebGLRenderer;
  // The target receives what the canvas would: tone-mapped colours in the screen's colour space.
  #target = Object.assign(new THREE.WebGLRenderTarget(1, 1, { colorSpace: THREE.SRGBColorSpace, internalFormat: 'RGBA8' }), { isXRRenderTarget: true });
  #copy = new FullScreenQuad(new THREE.ShaderMaterial({
    depthTest: false, depthWrite: false, toneMapped: false,
    uniforms: { target: { value: this.#target.texture } },
    vertexShader: 'varying vec2 at; void main() { at = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }',
    fragmentShader: 'varying vec2 at; uniform sampler2D target; void main() { gl_FragColor = vec4(texture2D(target, at).rgb, 1.0); }',
  }));

  constructor(renderer: THREE.WebGLRenderer) {
    this.#renderer = renderer;
  }

  /** Redirects drawing into the target; `share` is the fraction of the canvas's pixels that the time budget allows. */
  begin(share: number) {
    const side = THREE.MathUtils.clamp(Math.sqrt(share), MIN_SCALE, MAX_SCALE);
    const size = this.#renderer.getDrawingBufferSize(new THREE.Vector2()).multiplyScalar(side).ceil();
    this.#target.setSize(size.x, size.y);
    this.#renderer.setRenderTarget(this.#target);
  }

  /** Copies the target to the canvas. */
  end() {
    this.#renderer.setRenderTarget(null);
    this.#copy.render(this.#renderer);
  }
}
