// What the page shows to tests and to those who drive it by script, as `globalThis.hsd`.

import * as THREE from 'three';
import type { Page } from './page.ts';
import { hit_at } from './canvas.ts';

declare global {
  var hsd: ReturnType<typeof exposed>;
}

export function exposed({ app, plan, draw }: Page) {
  const { stage } = app;
  const camera = () => [...stage.camera.position.toArray(), ...stage.controls.target.toArray()];
  return {
    app, plan, draw, stage,
    /** Revision of the state that is shown; 0 = none yet. */
    get revision() { return app.state?.revision ?? 0; },
    /** The last frame: draw calls, triangles, milliseconds; and how many frames there were. */
    get stats() { return { ...stage.stats }; },
    /** The last reload: milliseconds from the event to the painted frame, and on the way. */
    get reload() { return app.reload_times; },
    /** Six numbers: the eye, and what it looks at, metres. */
    get camera() { return camera(); },
    set camera(at: number[]) {
      stage.camera.position.fromArray(at);
      stage.look_at(new THREE.Vector3().fromArray(at, 3));
    },
    /** What is selected: its kind, code, storey, span. */
    get selection() {
      const part = app.selection === null ? null : app.model?.parts[app.selection];
      return part ? { number: app.selection, kind: part.kind, code: part.code?.trim() ?? null, storey: part.storey, span: part.span, name: part.name } : null;
    },
    /** Codes of the parts that the editor's cursor, or the tree, lights up. */
    get lit() { return app.pointed.parts.map(part => app.model!.parts[part]!.code?.trim() ?? app.model!.parts[part]!.kind); },
    select: (part: number | null) => app.select(part),
    /** Parts with a code, by number. */
    find: (code: string) => app.model?.parts.flatMap((part, i) => part.code?.trim() === code ? [i] : []) ?? [],
    /** The part at a place of the canvas, CSS pixels. */
    pick: (x: number, y: number) => hit_at(app, x, y)?.part ?? null,
    /** The place of the model that is drawn there, metres. */
    hit: (x: number, y: number) => hit_at(app, x, y)?.point.toArray() ?? null,
    /** Where a part's middle is drawn, CSS pixels of the canvas. */
    place_of(part: number) {
      const { x, y } = app.model!.parts[part]!.box.getCenter(stage.camera.position.clone()).project(stage.camera);
      return [(x + 1) / 2 * stage.canvas.clientWidth, (1 - y) / 2 * stage.canvas.clientHeight];
    },
    /** Colours at places of the canvas, CSS pixels, of a frame drawn now. */
    pixels(places: [number, number][], quick = false) {
      stage.frame(quick);
      const gl = stage.renderer.getContext(), ratio = stage.renderer.getPixelRatio();
      const { drawingBufferWidth: width, drawingBufferHeight: height } = gl, all = new Uint8Array(width * height * 4);
      gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, all);
      return places.map(([x, y]) => {
        const at = ((height - 1 - Math.round(y * ratio)) * width + Math.round(x * ratio)) * 4;
        return [...all.slice(at, at + 3)];
      });
    },
    /** Waits until nothing is left to draw. */
    settled: () => new Promise<void>(done => stage.draw(() => { stage.settle(); done(); })),
  };
}
