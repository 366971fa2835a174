// Measures how fast a town is drawn at eye height: `HSD=hsd node --import tsx test/browser/walk-rate.ts TOWN EAST NORTH`. It stands
// at that place, turns round in steps, and tells the frames a second: as one walks, in full, without shadows, and with plain
// colours; what changes most is what dominates. With it the most features in sight, triangles, draw calls, and the share of
// the picture's points that are drawn as one walks.

import { spawn } from 'node:child_process';
import { browser } from './chromium.ts';

const [town, ...place] = process.argv.slice(2), [east = 0, north = 0] = place.map(Number);
const chromium = await browser(), server = spawn(process.env['HSD']!, ['view', town!, '--no-open', '--port', '0'], { stdio: ['ignore', 'pipe', 'inherit'] });
const url = await new Promise<string>(done => {
  let output = '';
  server.stdout.on('data', data => { const found = (output += data).match(/http:\S+/); if (found) done(found[0]); });
});
const page = await chromium.newPage({ viewport: { width: 1280, height: 720 } });
await page.addInitScript('globalThis.__name = f => f');
await page.goto(url);
await page.waitForFunction(() => hsd.app.town.state?.whole && !hsd.app.town.busy, null, { timeout: 600_000, polling: 50 });

type Way = 'walking' | 'full' | 'no shadows' | 'plain';
const turn = (way: Way) => page.evaluate(async ({ east, north, way }) => {
  const { renderer: { viewport }, town } = hsd.app, { camera, controls, renderer, scene } = viewport, steps = 24, eyes = viewport.environment.level + 1.6;
  const settled = () => new Promise<void>(done => { const wait = () => { if (town.busy) setTimeout(wait, 50); else done(); }; setTimeout(wait, 300); });
  const look = (step: number) => {
    const angle = step / steps * 2 * Math.PI;
    camera.position.set(east, eyes, -north);
    controls.target.set(east + Math.sin(angle) * 5, eyes, -north - Math.cos(angle) * 5);
    camera.lookAt(controls.target);
    camera.updateMatrixWorld();
  };
  for (let step = 0; step < steps; step += 3) { look(step); viewport.frame(); await settled(); }
  renderer.shadowMap.enabled = way !== 'no shadows';
  for (const mesh of way === 'plain' ? town.tiles!.meshes() : []) {
    for (const material of [mesh.material].flat()) Object.assign(material, { map: null, normalMap: null, roughnessMap: null, metalnessMap: null, needsUpdate: true });
  }
  const ms: number[] = [], calls: number[] = [], triangles: number[] = [], gl = renderer.getContext();
  for (let step = -4; step < steps; step++) {
    look(step);
    const begun = performance.now();
    viewport.frame(way === 'walking');
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // Waits for the picture.
    if (way !== 'walking') viewport.settle();
    if (step < 0) continue;
    ms.push(performance.now() - begun);
    calls.push(viewport.stats.calls);
    triangles.push(viewport.stats.triangles);
  }
  let sight = 0;
  for (let step = 0; step < steps; step += 4) {
    look(step);
    const seen = new Set<string>(), at = camera.position.clone();
    for (const mesh of town.tiles!.meshes()) {
      const positions = mesh.geometry.getAttribute('position'), ids = mesh.geometry.getAttribute('_feature_id_0');
      let root: typeof mesh.parent = mesh;
      while (root?.parent && root.parent !== scene) root = root.parent;
      for (let i = 0; ids && i < ids.count; i += 7) {
        at.fromBufferAttribute(positions, i).applyMatrix4(mesh.matrixWorld).project(camera);
        if (Math.abs(at.x) < 1 && Math.abs(at.y) < 1 && Math.abs(at.z) < 1) seen.add(`${mesh.parent?.uuid} ${ids.getX(i)}`);
      }
    }
    sight = Math.max(sight, seen.size);
  }
  const mean = (list: number[]) => Math.round(list.reduce((a, b) => a + b, 0) / list.length), middle = ms.sort((a, b) => a - b)[ms.length / 2]!;
  return { frames: +(1000 / middle).toFixed(1), ms: +middle.toFixed(1), calls: mean(calls), triangles: mean(triangles), sight };
}, { east, north, way });
for (const way of ['full', 'walking', 'no shadows', 'plain'] as const) console.log(way, JSON.stringify(await turn(way)));
await page.close();
await chromium.close();
server.kill();
