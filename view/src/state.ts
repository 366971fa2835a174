// State of the page: the open file, its compiled state, its model and the selection, with the lookups in them.

import { EventBus } from './event-bus.ts';
import type { Chunk, Model } from './model/model.ts';
import type { OffsetMap } from './server/offsets.ts';
import { type ByteRange, type Cursor, type Diagnostic, type ServerInfo, type State, sourceOf } from './server/api.ts';
import { strings } from './ui/strings.ts';

/** A byte range in a source file. */
export interface SourceLocation {
  id: number;
  span: ByteRange;
}

/** Timings of a reload, milliseconds since the server announced the revision. */
export interface ReloadTimes {
  revision: number;
  fetched: number;
  parsed: number;
  painted: number;
}

/** State of the page; it reports its changes as events. */
export class PageState extends EventBus {
  serverInfo!: ServerInfo;
  file: string | null = null;
  state: State | null = null;
  model: Model | null = null;
  selection: number | null = null;
  cursor: Cursor | null = null;
  /** The name of the view of the file that is shown, until the camera is moved. */
  visited: string | null = null;
  lost = false;
  /** True while the camera moves to a preset view. */
  movingToView = false;
  /** True while the initial settings are restored. */
  resetting = false;
  /** Display names of parts, by code. */
  names = new Map<string, string>();
  /** Codes of doors. */
  doors = new Set<string>();
  reloadTimes: ReloadTimes | null = null;
  /** Offset maps of the sources, by source id. */
  offsets = new Map<number, OffsetMap>();
  /** Hidden layers: `storey 1`, `roof 2`, `other`. */
  readonly hidden = new Set<string>();

  get revision(): number { return this.state?.revision ?? 0; }

  /** A short description of a part. */
  describe(part: number): string {
    const { kind, code, name, storey } = this.model!.parts[part]!;
    const what = strings.kind[kind] ?? kind;
    return [what, code?.trim() || name, storey > 0 && kind !== 'storey' ? strings.storey(storey) : ''].filter(Boolean).join(strings.comma);
  }

  /** The 1-based line number on which a location begins, and the text of that line. */
  lineAt({ id, span }: SourceLocation): { line: number; text: string } | null {
    const offsets = this.offsets.get(id);
    if (!offsets) return null;
    const line = offsets.line(offsets.unit(span[0]));
    return { line: line + 1, text: offsets.text.slice(offsets.lines[line], offsets.lines[line + 1] ?? undefined).trimEnd() };
  }

  /** A line of the open file, from 1; null if there is none. */
  lineLocation(line: number): SourceLocation | null {
    const offsets = this.offsets.get(0), start = offsets?.lines[line - 1];
    if (!offsets || start === undefined) return null;
    const text = offsets.text.slice(start, offsets.lines[line] ?? undefined), blanks = text.length - text.trimStart().length;
    return { id: 0, span: [offsets.byte(start + blanks), offsets.byte(start + text.trimEnd().length)] };
  }

  /** The `for` with a number, from 1, in the open file. */
  ruleLocation(rule: number): SourceLocation | null {
    const offsets = this.offsets.get(0);
    // Comments keep their length, so that places stay.
    const plain = offsets?.text.replace(/<!--.*?-->/gs, comment => ' '.repeat(comment.length)) ?? '';
    const found = [...plain.matchAll(/<for\b[^>]*>/g)][rule - 1];
    return found ? { id: 0, span: [offsets!.byte(found.index), offsets!.byte(found.index + found[0].length)] } : null;
  }

  locationOf(part: number): SourceLocation | null {
    for (let at: number | null = part; at !== null; at = this.model!.parts[at]!.parent) {
      const { span, file } = this.model!.parts[at]!;
      if (span) return { id: file, span };
    }
    return null;
  }

  /** The visibility layer of a chunk. */
  layerOf({ owner, storey }: Chunk): string {
    const kind = this.model?.parts[owner]?.kind;
    if (kind === 'roof' || kind === 'finial') return `roof ${storey}`;
    return storey > 0 ? `storey ${storey}` : 'other';
  }

  layers(): string[] {
    const layers = new Set(this.model?.chunks.map(chunk => this.layerOf(chunk)));
    const order = ['storey', 'roof', 'other'];
    const rank = (layer: string) => order.indexOf(layer.split(' ')[0]!) * 1e6 + Number(layer.split(' ')[1] ?? 0);
    return [...layers].sort((a, b) => rank(a) - rank(b));
  }

  /** Azimuth of the front of the first house, degrees. */
  azimuth(): number { return this.state?.plan.houses[0]?.azimuth ?? 180; }
}

/** The location of a diagnostic; null for diagnostics of a model file. */
export function locationOfDiagnostic(message: Diagnostic, { sources }: State): SourceLocation | null {
  const source = sourceOf(message, sources);
  return source ? { id: source.id, span: [message.span.start, message.span.end] } : null;
}
