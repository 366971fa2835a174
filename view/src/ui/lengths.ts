// Traditional units of length: 1 shaku = 10/33 m (law of 1891), 1 ken = 6 shaku.

import { strings } from './strings.ts';

export const SHAKU = 10 / 33;
export const KEN = 6 * SHAKU;

/** A length in metres, shaku and ken, with unit names in the page's language. */
export function formatLength(metres: number): { metres: string; shaku: string; ken: string } {
  return {
    metres: `${metres.toFixed(metres < 100 ? 3 : 2)} m`,
    shaku: `${(metres / SHAKU).toFixed(2)} ${strings.shaku}`,
    ken: `${(metres / KEN).toFixed(2)} ${strings.ken}`,
  };
}
