// The page's interface for tests and scripts, `globalThis.hsd`.

import * as THREE from 'three';
import type { Page } from './page.ts';
import { trianglesIn } from './walk/surfaces.ts';

declare global {
  var hsd: ReturnType<typeof scriptInterface>;
}

export function scriptInterface({ app, plan, draw, review, front }: Page) {
  const { viewport } = app.renderer;
  const camera = () => [...viewport.camera.position.toArray(), ...viewport.controls.target.toArray()];
  return {
    app, plan, draw, review, front, viewport,
    /** Revision of the shown state; 0 before the first. */
    get revision() { return app.state?.revision ?? 0; },
    /** Statistics of the last frame, and the number of frames so far. */
    get stats() { return { ...viewport.stats }; },
    /** Timings of the last reload, milliseconds from the server's event. */
    get reload() { return app.reloadTimes; },
    /** Camera position and target, metres: six numbers. */
    get camera() { return camera(); },
    set camera(at: number[]) {
      viewport.camera.position.fromArray(at);
      viewport.lookAt(new THREE.Vector3().fromArray(at, 3));
    },
    /** The selected part: kind, code, storey, span. */
    get selection() {
      const part = app.selection === null ? null : app.model?.parts[app.selection];
      return part ? { number: app.selection, kind: part.kind, code: part.code?.trim() ?? null, storey: part.storey, span: part.span, name: part.name } : null;
    },
    /** Codes of the parts highlighted by the editor's cursor or the tree. */
    get lit() { return app.renderer.pointed.parts.map(part => app.model!.parts[part]!.code?.trim() ?? app.model!.parts[part]!.kind); },
    select: (part: number | null) => app.select(part),
    /** Indices of the parts with a code. */
    find: (code: string) => app.model?.parts.flatMap((part, i) => part.code?.trim() === code ? [i] : []) ?? [],
    /** The part at a position of the canvas, CSS pixels. */
    pick: (x: number, y: number) => app.renderer.hitAt(x, y)?.part ?? null,
    /** The point of the model at a position of the canvas, metres. */
    hit: (x: number, y: number) => app.renderer.hitAt(x, y)?.point.toArray() ?? null,
    /** The first point of the town's tiles in a direction, metres. */
    surface: (from: number[], way: number[]) =>
      app.town.tiles?.pointAt(new THREE.Raycaster(new THREE.Vector3().fromArray(from), new THREE.Vector3().fromArray(way)))?.toArray() ?? null,
    /** A ray from a place in a direction. */
    ray: (from: number[], way: number[]) => new THREE.Raycaster(new THREE.Vector3().fromArray(from), new THREE.Vector3().fromArray(way)),
    /** The corners of all triangles that a walker may meet: nine numbers each. */
    triangles: () => trianglesIn(new THREE.Box3(new THREE.Vector3().setScalar(-1e4), new THREE.Vector3().setScalar(1e4)), app.renderer.meshes()),
    /** Where the centre of a part is drawn, CSS pixels of the canvas. */
    positionOf(part: number) {
      const { x, y } = app.model!.parts[part]!.box.getCenter(viewport.camera.position.clone()).project(viewport.camera);
      return [(x + 1) / 2 * viewport.canvas.clientWidth, (1 - y) / 2 * viewport.canvas.clientHeight];
    },
    /** Draws a frame and returns its colours at positions of the canvas, CSS pixels. */
    pixels(places: [number, number][], quick = false) {
      viewport.frame(quick);
      const gl = viewport.renderer.getContext(), ratio = viewport.renderer.getPixelRatio();
      const { drawingBufferWidth: width, drawingBufferHeight: height } = gl, all = new Uint8Array(width * height * 4);
      gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, all);
      return places.map(([x, y]) => {
        const at = ((height - 1 - Math.round(y * ratio)) * width + Math.round(x * ratio)) * 4;
        return [...all.slice(at, at + 3)];
      });
    },
    /** Resolves when nothing is left to draw. */
    settled: () => new Promise<void>(done => viewport.draw(() => { viewport.settle(); done(); })),
  };
}
