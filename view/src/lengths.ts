// Lengths in the measures of the houses: 1 shaku = 10/33 m (law of 1891), 1 ken = 6 shaku.

import { words } from './words.ts';

export const SHAKU = 10 / 33;
export const KEN = 6 * SHAKU;

/** `2.73 m`, in metres, shaku and ken, with the words of the page. */
export function length_words(metres: number): { metres: string; shaku: string; ken: string } {
  return {
    metres: `${metres.toFixed(metres < 100 ? 3 : 2)} m`,
    shaku: `${(metres / SHAKU).toFixed(2)} ${words.shaku}`,
    ken: `${(metres / KEN).toFixed(2)} ${words.ken}`,
  };
}
