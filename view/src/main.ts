// The page: the model of a text, kept up with what is saved.

import { Loader } from './load.ts';
import { hello, listen, model_url, state } from './server.ts';
import { Stage } from './stage.ts';

const canvas = document.createElement('canvas');
document.body.append(canvas);
const stage = new Stage(canvas), loader = new Loader();

async function show(file: string) {
  const now = await state(file);
  stage.show(await loader.load(model_url(file, now.revision), now.pictures));
  document.documentElement.dataset.revision = `${now.revision}`;
}

const { file } = await hello();
if (file) {
  await show(file);
  listen(file, { state: () => void show(file), cursor: () => {}, files: () => {}, lost: () => {} });
}
