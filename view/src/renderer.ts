// Renderer of the page: the 3D view and the tools that draw in it.

import * as THREE from 'three';
import { Mirrors } from './mirror/mirrors.ts';
import { type Hit, hit } from './model/parts.ts';
import { Highlight } from './scene/highlight.ts';
import { Measure } from './scene/measure.ts';
import { Turntable } from './scene/orbit.ts';
import { Section } from './scene/section.ts';
import { Viewport } from './scene/viewport.ts';

export class PageRenderer {
  readonly viewport: Viewport;
  readonly section: Section;
  readonly measure: Measure;
  readonly turntable: Turntable;
  readonly mirrors: Mirrors;
  readonly selected: Highlight;
  readonly pointed: Highlight;
  /** Meshes of the town's tiles; null if no tiles are shown. */
  tileMeshes: () => Iterable<THREE.Mesh> | null = () => null;

  constructor(canvas: HTMLCanvasElement) {
    this.viewport = new Viewport(canvas);
    this.section = new Section(this.viewport);
    this.measure = new Measure(this.viewport, () => this.meshes());
    this.turntable = new Turntable(this.viewport);
    this.mirrors = createMirrors(this.viewport);
    this.pointed = new Highlight(this.viewport, 'cursor', 0x2f6f9f);
    this.selected = new Highlight(this.viewport, 'selection', 0xc8431f);
    this.section.overlays.push(...this.pointed.materials, ...this.selected.materials);
  }

  /** Visible meshes of the model, or of the town's tiles. */
  *meshes(): Iterable<THREE.Mesh> {
    const tiles = this.tileMeshes();
    if (tiles) yield* tiles;
    else for (const { mesh } of this.viewport.model?.chunks ?? []) if (mesh.visible) yield mesh;
  }

  /** The ray through a position of the canvas, CSS pixels. */
  rayAt(x: number, y: number): THREE.Raycaster {
    const { canvas, camera } = this.viewport, ray = new THREE.Raycaster();
    camera.updateMatrixWorld();
    ray.setFromCamera(new THREE.Vector2(x / canvas.clientWidth * 2 - 1, 1 - y / canvas.clientHeight * 2), camera);
    return ray;
  }

  /** The surface drawn at a position of the canvas, CSS pixels. */
  hitAt(x: number, y: number): Hit | null {
    const { model } = this.viewport;
    return model && hit(model, this.rayAt(x, y), this.section.keeps);
  }
}

/** Connects reflective glass to a viewport. */
function createMirrors(viewport: Viewport): Mirrors {
  const mirrors = new Mirrors(viewport.renderer, viewport.scene);
  mirrors.options.sky = viewport.environment.colours;
  mirrors.occlusion.requestFrame = () => viewport.draw();
  viewport.marks.userData['mirrored'] = false;
  viewport.onModel.push(model => mirrors.show(model));
  viewport.onRestored.push(() => mirrors.occlusion.clear());
  // A coarse frame must not mark small panes as occluded.
  viewport.paint = () => mirrors.paint(viewport.camera, !viewport.coarse);
  return mirrors;
}
