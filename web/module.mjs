// Calls hsd as a module of WebAssembly: in a page, a worker or Node.

/** Returns a function that compiles a text: `{ model, messages }`, with a model of no bytes if the text has errors. */
export async function begin(bytes) {
  const { instance } = await WebAssembly.instantiate(bytes, {});
  const hsd = instance.exports, read = (at, length) => new Uint8Array(hsd.memory.buffer, at, length).slice();
  return ({ name = 'house.hsd', text, parameters = {}, detail = 3, japanese = false }) => {
    const job = new TextEncoder().encode(JSON.stringify({ name, text, parameters, detail, japanese }));
    const at = hsd.input(job.length);
    new Uint8Array(hsd.memory.buffer, at, job.length).set(job);
    const length = hsd.compile();
    return { model: read(hsd.model(), length), messages: new TextDecoder().decode(read(hsd.messages(), hsd.messages_length())) };
  };
}
