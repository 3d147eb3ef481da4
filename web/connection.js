// The one WebSocket: questions with numbers, answers by number, and what happens when the server goes away.

/** How long to wait before each new attempt, in milliseconds; the last one is repeated. */
const PAUSES = [200, 500, 1000, 2000, 5000];
/** The questions of a drag, whose answers are waited for; only their times count. */
const QUICK = new Set(["move", "four_bar", "truss"]);
/** Answers whose times are kept, for the statistics. */
const TIMES_KEPT = 600;

/** A question that was refused, with a sentence for people. */
export class Refused extends Error {}
/** A question that was not answered, since the server is gone. */
export class Unanswered extends Error {}

export class Connection {
  /** @param {(state: "connecting" | "open" | "closed") => void} onState */
  constructor(onState) {
    this.onState = onState;
    /** @type {WebSocket | null} */
    this.socket = null;
    /** @type {Map<number, { resolve: (answer: any) => void, reject: (error: Error) => void, asked: number, quick: boolean }>} */
    this.waiting = new Map();
    this.next = 1;
    this.attempts = 0;
    /** The largest message that the server takes, in bytes; it says so itself. */
    this.largest = 64 * 1024;
    /** @type {number[]} */
    this.times = [];
    /** @type {(() => void)[]} */
    this.whenOpen = [];
    this.connect();
  }

  connect() {
    this.onState("connecting");
    const address = new URL("socket", location.href);
    address.protocol = "ws:";
    address.hash = "";
    const socket = new WebSocket(address);
    this.socket = socket;
    socket.onopen = () => {
      this.attempts = 0;
      this.onState("open");
      this.whenOpen.splice(0).forEach((go) => go());
    };
    socket.onmessage = (message) => this.take(JSON.parse(message.data));
    socket.onclose = () => {
      this.socket = null;
      this.onState("closed");
      for (const { reject } of this.waiting.values()) reject(new Unanswered("the server did not answer"));
      this.waiting.clear();
      const pause = PAUSES[Math.min(this.attempts, PAUSES.length - 1)];
      this.attempts += 1;
      setTimeout(() => this.connect(), pause);
    };
  }

  /** @param {{ id: number | null, answer?: any, error?: string }} message */
  take(message) {
    if (message.id === null) return;
    const question = this.waiting.get(message.id);
    if (!question) return;
    this.waiting.delete(message.id);
    if (message.error !== undefined) {
      question.reject(new Refused(message.error));
      return;
    }
    if (question.quick) this.times.push(performance.now() - question.asked);
    if (this.times.length > TIMES_KEPT) this.times.shift();
    question.resolve(message.answer);
  }

  /** Resolves once the server can be asked. */
  opened() {
    const open = this.socket?.readyState === WebSocket.OPEN;
    return open ? Promise.resolve() : new Promise((go) => this.whenOpen.push(() => go(undefined)));
  }

  /**
   * @param {string} kind
   * @param {object} question
   * @returns {Promise<any>}
   */
  ask(kind, question) {
    const socket = this.socket;
    if (!socket || socket.readyState !== WebSocket.OPEN) return Promise.reject(new Unanswered("the server is gone"));
    const id = this.next++;
    const text = JSON.stringify({ id, ask: kind, ...question });
    if (text.length > this.largest) return Promise.reject(new Refused(`that is too large: ${text.length} of at most ${this.largest} bytes`));
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject, asked: performance.now(), quick: QUICK.has(kind) });
      socket.send(text);
    });
  }

  /** The last round trip and the 95th percentile, in milliseconds. */
  timing() {
    if (this.times.length === 0) return null;
    const sorted = [...this.times].sort((a, b) => a - b);
    return { last: this.times[this.times.length - 1], p95: sorted[Math.ceil(0.95 * sorted.length) - 1] };
  }
}

/**
 * Runs one task at a time; of those that come meanwhile only the last, so that a drag is never behind.
 * @template T
 * @param {(wish: T) => Promise<void>} task
 */
export function latest(task) {
  let busy = false;
  /** @type {{ wish: T } | null} */
  let pending = null;
  /** @type {(() => void)[]} */
  let idle = [];
  const run = async (/** @type {T} */ wish) => {
    busy = true;
    try {
      await task(wish);
    } finally {
      busy = false;
      const next = pending;
      pending = null;
      if (next) run(next.wish);
      else idle.splice(0).forEach((go) => go());
    }
  };
  return {
    /** @param {T} wish */
    push(wish) {
      if (busy) pending = { wish };
      else run(wish);
    },
    /** Resolves when nothing is left to do. */
    settled: () => (busy ? new Promise((go) => idle.push(() => go(undefined))) : Promise.resolve()),
  };
}
