// Screenshots for documents, under an afternoon sun: the page is opened headless with
// `/?file=F&render=front,above,back&size=960x640&samples=16`, renders the views and posts them to the server; `cameras` has
// views at places of their own, JSON by their names in `render`. Sun and sky
// are a sum over many small lights, each with its own shadow, so that eaves and lattices are dark where the sky does not
// reach; the camera is jittered by less than a pixel per light for antialiasing.

import { Loader } from '../model/loader.ts';
import { fetchState } from '../server/api.ts';
import * as THREE from 'three';
import { ScreenshotRenderer, type StandPoint, type Viewpoint } from './renderer.ts';
import { KYOTO, parseDate, sunDirection, sunPosition } from '../scene/sun.ts';
import { ELEVATIONS, VIEWS } from '../scene/views.ts';
import { strings } from '../ui/strings.ts';

/** Renders the requested views and posts each to the server, then the list of errors. */
export async function renderScreenshots(asked: URLSearchParams) {
  const errors: string[] = [];
  document.title = strings.rendering;
  try {
    const file = asked.get('file');
    if (!file) throw new Error('no file given');
    const [width = 960, height = 640] = (asked.get('size') ?? '').split('x').map(Number).filter(n => n > 0);
    const samples = Math.max(1, Number(asked.get('samples') ?? 16));
    const views = (asked.get('render') ?? 'front').split(',');
    const cameras: Record<string, StandPoint> = JSON.parse(asked.get('cameras') || '{}');
    const known: readonly string[] = [...VIEWS, ...ELEVATIONS, ...Object.keys(cameras)];
    const wrong = views.filter(view => !known.includes(view));
    if (wrong.length) throw new Error(`unknown view ${wrong.join(', ')}; available: ${known.join(', ')}`);
    const sun = sunAsked(asked);
    const now = await fetchState(file);
    const loader = new Loader(), fetched = await loader.fetch(file, now.revision);
    const model = fetched && await loader.load(fetched, file, now);
    if (!model || model.chunks.length === 0) throw new Error('no house can be built from the file');
    await loader.texturesLoaded();
    const name = asked.get('house'), { houses } = now.plan;
    const house = name === null ? null : houses.findIndex(h => h.name === name);
    if (house === -1) throw new Error(`no house is called ${name}; there are ${houses.map(h => h.name || '(without a name)').join(', ')}`);
    const renderer = new ScreenshotRenderer(model, width, height, { azimuth: houses[house ?? 0]?.azimuth ?? 180, house, sun });
    const shots = views.map(view => cameras[view] ?? view as Viewpoint);
    await renderer.render(shots, samples, async (shot, blob) => {
      const view = views[shots.indexOf(shot)]!;
      const answer = await fetch(`/api/picture?view=${view}`, { method: 'POST', headers: { 'content-type': 'image/png' }, body: blob });
      if (!answer.ok) errors.push(`${view}: ${await answer.text()}`);
    });
  } catch (error) {
    errors.push((error as Error).message);
  }
  await fetch('/api/rendered', {
    method: 'POST', headers: { 'content-type': 'application/json' }, body: JSON.stringify({ errors }),
  });
  document.documentElement.dataset.rendered = `${errors.length}`;
}

/** Direction to the sun over Kyoto at the `date` and `hour` that the page was asked for; null without. */
function sunAsked(asked: URLSearchParams): THREE.Vector3 | null {
  const date = parseDate(asked.get('date') ?? '');
  if (!date) return null;
  const hour = Number(asked.get('hour') ?? 12), sun = sunPosition(date, hour, KYOTO);
  if (sun.altitude < 0) throw new Error(`the sun is ${Math.ceil(-sun.altitude)} degrees below the horizon then`);
  return new THREE.Vector3(...sunDirection(sun));
}
