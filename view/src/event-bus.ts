// Events of the page. Panels and panes subscribe to them.

/**
 * `files`: the file list changed. `state`: a file was compiled. `model`: the model was replaced. `select`, `cursor`: the
 * highlighted parts changed. `shown`: visibility changed. `visited`: the camera went to a named view, or left it.
 * `town`: the town, its selected feature or the progress of its build changed. `walk`: a walk began or ended.
 */
export type PageEvent = 'files' | 'state' | 'model' | 'select' | 'cursor' | 'shown' | 'visited' | 'connection' | 'reload' | 'town' | 'walk';

export class EventBus {
  /** Announces a text in the live region. */
  announce: (text: string) => void = () => {};
  #listeners = new Map<PageEvent, (() => void)[]>();

  on(event: PageEvent, then: () => void) {
    this.#listeners.set(event, [...this.#listeners.get(event) ?? [], then]);
  }

  emit(event: PageEvent) {
    for (const then of this.#listeners.get(event) ?? []) then();
  }
}
