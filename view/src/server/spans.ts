// Moves byte ranges and text spans through an edit.

/**
 * Returns where a span of the old text lies in the new text, which differs in one stretch; null where the span itself was
 * edited.
 */
export function movedSpan(span: [start: number, end: number], old: string, now: string): [start: number, end: number] | null {
  if (old === now) return span;
  const most = Math.min(old.length, now.length);
  let front = 0;
  while (front < most && old.charCodeAt(front) === now.charCodeAt(front)) front++;
  let back = 0;
  while (back < most - front && old.charCodeAt(old.length - 1 - back) === now.charCodeAt(now.length - 1 - back)) back++;
  const [start, end] = span, by = now.length - old.length;
  if (end <= front) return span;
  if (start >= old.length - back) return [start + by, end + by];
  // The edit lies inside the span, which grows or shrinks with it.
  if (start <= front && end >= old.length - back) return end + by > start ? [start, end + by] : null;
  return null;
}
