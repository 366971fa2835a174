// What becomes of a place when its text is changed.

/** Where a span of an old text lies in a new one that differs from it in one stretch; null where it was changed itself. */
export function carried(span: [start: number, end: number], old: string, now: string): [start: number, end: number] | null {
  if (old === now) return span;
  const most = Math.min(old.length, now.length);
  let front = 0;
  while (front < most && old.charCodeAt(front) === now.charCodeAt(front)) front++;
  let back = 0;
  while (back < most - front && old.charCodeAt(old.length - 1 - back) === now.charCodeAt(now.length - 1 - back)) back++;
  const [start, end] = span, by = now.length - old.length;
  if (end <= front) return span;
  if (start >= old.length - back) return [start + by, end + by];
  // The stretch lies inside: what was between stays what it was.
  if (start <= front && end >= old.length - back) return end + by > start ? [start, end + by] : null;
  return null;
}
