// The worker of the page of house types: compiles texts, so that the page stays awake. A fault ends the module: it is begun anew.
import { begin } from '../web/module.mjs';

let bytes, compile;
onmessage = async ({ data: { number, module, job } }) => {
  try {
    if (!bytes) {
      const answer = await fetch(module);
      if (!answer.ok) throw new Error(`${module}: ${answer.status}`);
      bytes = await answer.arrayBuffer();
    }
    compile ??= await begin(bytes);
    const { model, messages } = compile(job);
    postMessage({ number, model: model.buffer, messages }, [model.buffer]);
  } catch (error) {
    compile = undefined;
    postMessage({ number, fault: String(error) });
  }
};
