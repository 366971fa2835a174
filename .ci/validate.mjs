// node validate.mjs FILE.glb...
// Runs the Khronos validator on each file. Exits with 1 on errors or warnings; hints and notes are only counted.
import { readFile } from 'node:fs/promises';
import { dirname, resolve } from 'node:path';
import { load } from './modules.mjs';

const validator = load('gltf-validator');
const files = process.argv.slice(2);
if (files.length === 0) throw new Error('no files');

/** Says whether an image of a model is KTX2: by its type, or by the name of its file. */
const isKtx2 = image => image?.mimeType === 'image/ktx2' || Boolean(image?.uri?.endsWith('.ktx2'));

/** Returns a filter for the validator's messages that drops those about KTX2, which it does not support. */
function ofTheCore(bytes) {
  const { images = [] } = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + bytes.readUInt32LE(12))));
  const foreign = new Set(images.flatMap((image, k) => isKtx2(image) ? [`/images/${k}`] : []));
  return ({ code, message, pointer }) => !(
    code === 'VALUE_NOT_IN_LIST' && message.includes("'image/ktx2'") && foreign.has(pointer.replace('/mimeType', ''))
    || code === 'IMAGE_UNRECOGNIZED_FORMAT' && foreign.has(pointer));
}

let bad = 0;
for (const file of files) {
  const bytes = await readFile(file);
  const report = await validator.validateBytes(new Uint8Array(bytes), {
    uri: file,
    maxIssues: 0, // no limit
    writeTimestamp: false,
    externalResourceFunction: async uri => new Uint8Array(await readFile(resolve(dirname(file), decodeURIComponent(uri)))),
  });
  const { numErrors, numInfos, numHints } = report.issues;
  const messages = report.issues.messages.filter(ofTheCore(bytes));
  const numWarnings = messages.filter(m => m.severity === 1).length;
  const { drawCallCount = 0, totalTriangleCount = 0 } = report.info ?? {};
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} notes, ${numHints} hints; `
    + `${drawCallCount} draw calls, ${totalTriangleCount} triangles`);
  for (const { severity, code, pointer, offset, message } of messages) {
    if (severity <= 1) console.log(`  ${['error', 'warning'][severity]} ${code} at ${pointer ?? offset}: ${message}`);
  }
  bad += numErrors + numWarnings;
}
process.exit(bad > 0 ? 1 : 0);
