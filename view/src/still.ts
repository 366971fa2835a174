// Pictures of a model under an afternoon sun, for documents: the page is opened headless with
// `/?file=F&render=front,above,back&size=960x640&samples=16`, draws them and hands them to the server. The light of sun and
// sky is a sum over many small lights, each with its own shadow, so that eaves and lattices are dark where the sky does not
// reach; the camera trembles by less than a pixel from light to light, which smooths edges as well.

import { Loader } from './load.ts';
import { state } from './server.ts';
import { Studio } from './studio.ts';
import { type View, VIEWS } from './views.ts';
import { words } from './words.ts';

/** Draws the pictures that were asked for; each goes to the server, and in the end what went wrong. */
export async function stills(asked: URLSearchParams) {
  const errors: string[] = [];
  document.title = words.rendering;
  try {
    const file = asked.get('file');
    if (!file) throw new Error('no file');
    const [width = 960, height = 640] = (asked.get('size') ?? '').split('x').map(Number).filter(n => n > 0);
    const samples = Math.max(1, Number(asked.get('samples') ?? 16));
    const views = (asked.get('render') ?? 'front').split(',');
    const wrong = views.filter(view => !(VIEWS as readonly string[]).includes(view));
    if (wrong.length) throw new Error(`no view is called ${wrong.join(', ')}; there are ${VIEWS.join(', ')}`);
    const now = await state(file);
    const loader = new Loader(), fetched = await loader.fetch(file, now.revision);
    const model = fetched && await loader.load(fetched, file, now);
    if (!model || model.chunks.length === 0) throw new Error('the text leaves no house');
    await loader.pictures();
    const studio = new Studio(model, width, height, now.plan.houses[0]?.azimuth ?? 180);
    await studio.take(views as View[], samples, async (view, blob) => {
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
