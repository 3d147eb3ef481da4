// The one WebSocket: questions with numbers, answers by number, and what happens when the server goes away.

/** How long to wait before each new attempt, in milliseconds; the last one is repeated. */
const PAUSES = [200, 500, 1000, 2000, 5000];
/** The questions of a drag, whose answers are waited for; only their times count. */
const QUICK = new Set(["move", "four_bar", "truss"]);
/** Answers whose times are kept, for the statistics. */
const TIMES_KEPT = 600;
/** Close codes with which the server gives its reason: messages of a kind or size it does not take, and too many pages. Any other close is its end. */
const WITH_REASON = new Set([1003, 1009, 1013]);
/** Bytes of UTF-8 for one unit of a string, at most. */
const BYTES_PER_UNIT = 3;

/** A question that was refused, with a sentence for people. */
export class Refused extends Error {}
/** A question that was not answered, since the server is gone. */
export class Unanswered extends Error {}

export class Connection {
  /** @param {(state: "connecting" | "open" | "closed", reason?: string) => void} onState the reason is the server's own, if it gave one */
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
    this.connect();
  }

  connect() {
    this.onState("connecting");
    const address = new URL("socket", location.href);
    address.protocol = "ws:";
    address.hash = "";
    const socket = new WebSocket(address);
    this.socket = socket;
    socket.onopen = () => this.onState("open");
    socket.onmessage = (message) => {
      // Who is only let in to be turned away again waits longer each time.
      this.attempts = 0;
      this.take(JSON.parse(message.data));
    };
    socket.onclose = ({ code, reason }) => {
      this.socket = null;
      this.onState("closed", WITH_REASON.has(code) ? reason : undefined);
      this.giveUp(new Unanswered("the server did not answer"));
      const pause = PAUSES[Math.min(this.attempts, PAUSES.length - 1)];
      this.attempts += 1;
      setTimeout(() => this.connect(), pause);
    };
  }

  /** @param {{ id: number | null, answer?: any, error?: string }} message */
  take(message) {
    // A question so wrong that its number could not be read: one of those that wait.
    if (message.id === null) return this.giveUp(new Refused(message.error ?? "the question cannot be read"));
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

  /** @param {Error} error */
  giveUp(error) {
    const waiting = [...this.waiting.values()];
    this.waiting.clear();
    for (const { reject } of waiting) reject(error);
  }

  /** For how long the oldest question has been waiting for its answer, in milliseconds. */
  waits() {
    const [first] = this.waiting.values();
    return first ? performance.now() - first.asked : 0;
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
    // Measured only where it may matter: a drag asks sixty times a second.
    const bytes = text.length * BYTES_PER_UNIT > this.largest ? new TextEncoder().encode(text).length : 0;
    if (bytes > this.largest) return Promise.reject(new Refused(`that is too large: ${bytes} of at most ${this.largest} bytes`));
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
