// Trees by the season: the colours of their leaves at a date, over those of the model, which are of summer.

import * as THREE from 'three';

/** Red, green and blue by which the colours of summer are multiplied. */
type Tint = [number, number, number];

/** From which day of the year on leaves have which colour, by species; what is not named stays green. Dates are those of Kyoto. */
const TINTS: Record<string, [month: number, day: number, tint: Tint][]> = {
  // Blossom at the turn of March to April, red in November, bare branches in winter. Leaves hold little blue, so pink takes much of it.
  cherry: [[1, 1, [1.2, 0.6, 2.5]], [3, 26, [4.6, 2.3, 13]], [4, 14, [1.2, 1.1, 1]], [5, 1, [1, 1, 1]], [10, 20, [2.7, 0.4, 0.7]], [12, 1, [1.2, 0.6, 2.5]]],
  plane: [[1, 1, [1.2, 0.55, 2.5]], [4, 10, [1.2, 1.15, 1]], [5, 5, [1, 1, 1]], [10, 25, [3.4, 1.1, 1.5]], [12, 5, [1.2, 0.55, 2.5]]],
  willow: [[1, 1, [1.8, 0.85, 2.8]], [3, 10, [1.3, 1.2, 0.9]], [4, 20, [1, 1, 1]], [11, 10, [3.4, 1.8, 2.5]], [12, 20, [1.8, 0.85, 2.8]]],
};

/** The tint of the leaves of a material on a day; null for what is green all year, or is no leaves. */
export function tintOf(material: string, month: number, day: number): Tint | null {
  const species = material.match(/^leaves_(\w+)$/)?.[1];
  if (!species || !Object.hasOwn(TINTS, species)) return null;
  return TINTS[species]!.findLast(([m, d]) => m < month || m === month && d <= day)?.[2] ?? null;
}

/** Gives the leaves of a material the colour that they have on a day. */
export function colourLeaves(material: THREE.Material, { month, day }: { month: number; day: number }) {
  const tint = tintOf(material.name, month, day);
  if (!tint || !(material instanceof THREE.MeshStandardMaterial)) return;
  const summer: THREE.Color = material.userData['summer'] ??= material.color.clone();
  material.color.setRGB(summer.r * tint[0], summer.g * tint[1], summer.b * tint[2]);
}
