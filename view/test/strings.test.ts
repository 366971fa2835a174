import assert from 'node:assert/strict';
import { test } from 'node:test';
import { translations } from '../src/ui/strings.ts';

test('every string has a Japanese translation', () => {
  const walk = (en: unknown, ja: unknown, name: string) => {
    assert.equal(typeof ja, typeof en, name);
    if (typeof en === 'object') {
      assert.deepEqual(Object.keys(ja as object), Object.keys(en as object), name);
      for (const key of Object.keys(en as object)) walk((en as never)[key], (ja as never)[key], `${name}.${key}`);
    } else if (typeof ja === 'string') assert.match(ja, /[\u3001\u3040-\u30ff\u4e00-\u9fff]/, name);
  };
  walk(translations.en, translations.ja, 'strings');
});
