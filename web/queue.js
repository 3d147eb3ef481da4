// What is wished for is carried out in order, and what changes often is shown seldom.

/**
 * Carries out wishes one at a time, in their order. A wish may replace the one that waits before it, as the next step of a drag does: so a drag is never behind, and a command beside
 * it is never lost.
 * @template T
 * @param {(wish: T) => Promise<void>} task
 * @param {(wish: T, before: T) => boolean} replaces
 */
export function inOrder(task, replaces = () => false) {
  /** @type {{ wish?: { of: T }, done: () => void, failed: (error: unknown) => void }[]} Without a wish: somebody who waits for all before. */
  const waiting = [];
  let busy = false;
  const run = async () => {
    busy = true;
    for (let next = waiting.shift(); next; next = waiting.shift()) {
      try {
        if (next.wish) await task(next.wish.of);
        next.done();
      } catch (error) {
        next.failed(error);
      }
    }
    busy = false;
  };
  const put = (/** @type {{ of: T } | undefined} */ wish) => /** @type {Promise<void>} */ (new Promise((done, failed) => {
    const before = waiting.at(-1);
    if (wish && before?.wish && replaces(wish.of, before.wish.of)) waiting.pop()?.done();
    waiting.push({ wish, done, failed });
    if (!busy) run();
  }));
  return {
    /** Resolves once the wish is carried out, or another has taken its place. @param {T} wish */
    push: (wish) => put({ of: wish }),
    /** Resolves once everything is done that was wished so far. */
    settled: () => (busy ? put(undefined) : Promise.resolve()),
  };
}

/**
 * Acts no more often than every so many milliseconds, and once more for what came meanwhile; or at once.
 * @param {number} pause
 * @param {() => void} act
 */
export function seldom(pause, act) {
  let last = -Infinity;
  let timer = 0;
  const go = () => {
    clearTimeout(timer);
    timer = 0;
    last = performance.now();
    act();
  };
  return (/** @type {boolean} */ atOnce) => {
    const wait = last + pause - performance.now();
    if (atOnce || wait <= 0) go();
    else timer ||= setTimeout(go, wait);
  };
}
