// node validate.mjs FILE.glb...
// Runs the Khronos validator on each file. Exits with 1 on errors or warnings; hints and notes are only counted.
import { readFile } from 'node:fs/promises';
import { dirname, resolve } from 'node:path';
import { load } from './modules.mjs';

const validator = load('gltf-validator');
const files = process.argv.slice(2);
if (files.length === 0) throw new Error('no files');

/** Returns a filter for the validator's messages that drops those about KTX2, which it does not support. */
function ofTheCore(messages) {
  const ktx2 = messages.filter(m => m.code === 'VALUE_NOT_IN_LIST' && m.message.includes("'image/ktx2'"));
  const images = new Set(ktx2.map(m => m.pointer.replace('/mimeType', '')));
  return m => !ktx2.includes(m) && !(m.code === 'IMAGE_UNRECOGNIZED_FORMAT' && images.has(m.pointer));
}

let bad = 0;
for (const file of files) {
  const report = await validator.validateBytes(new Uint8Array(await readFile(file)), {
    uri: file,
    maxIssues: 0, // no limit
    writeTimestamp: false,
    externalResourceFunction: async uri => new Uint8Array(await readFile(resolve(dirname(file), decodeURIComponent(uri)))),
  });
  const { numErrors, numInfos, numHints } = report.issues;
  const messages = report.issues.messages.filter(ofTheCore(report.issues.messages));
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
