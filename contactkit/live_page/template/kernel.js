// The kernel of contactkit, compiled to WebAssembly (kernel/page.c). It imports nothing.

const COLUMNS = ["time", "gap", "speed", "pull", "force", "static", "viscous", "limit", "cavity", "state", "unlimited",
  ...Array.from({ length: 8 }, (_, i) => `law${i}`)];
const MOST_STEPS = 20000;

class Kernel {
  static async from(text) {
    const made = await WebAssembly.instantiate(await unpacked(text), {});
    made.instance.exports._initialize();
    return new Kernel(made.instance.exports);
  }

  constructor(calls) {
    this.calls = calls;
  }

  said() {
    const bytes = new Uint8Array(this.calls.memory.buffer), first = this.calls.ck_page_said();
    return new TextDecoder().decode(bytes.slice(first, bytes.indexOf(0, first)));
  }

  rows() {
    const first = this.calls.ck_page_rows(), count = this.calls.ck_page_count();
    const all = new Float64Array(this.calls.memory.buffer, first, count * COLUMNS.length);
    return Array.from({ length: count }, (_, i) =>
      Array.from(all.subarray(i * COLUMNS.length, (i + 1) * COLUMNS.length)));
  }

  // Numbers of a model, by the calls that begin with a name.
  fill(calls, numbers) {
    const at = this.calls[`${calls}_room`](numbers.length);
    new Float64Array(this.calls.memory.buffer, at, numbers.length).set(numbers);
    if (!this.calls[`${calls}_open`](numbers.length)) throw new Error(this.said());
  }

  // Numbers of the scene; then variables by value reference, and the pull. Throws what is wrong.
  load(numbers, variables, pull) {
    this.fill("ck_page", numbers);
    this.calls.ck_page_reset(pull.force, pull.rise, pull.limit);
    for (const [reference, value] of variables)
      if (!this.calls.ck_page_set(reference, value)) throw new Error(this.said());
  }

  begin(numbers, variables, pull) {
    this.load(numbers, variables, pull);
    if (!this.calls.ck_page_start()) throw new Error(this.said());
  }

  // Numbers of the motion so far; -1 of times of what has not happened.
  numbers() {
    this.calls.ck_page_numbers();
    const [peak, peakTime, release, speed, rupture, work, viscous, still, steps, inception] = this.rows()[0];
    return { peak, peakTime, release, speed, rupture, work, viscous, still, steps, inception };
  }

  // Rows of a motion to its release, and how it ended.
  motion() {
    const rows = this.rows(), path = rows.slice();
    let ended = 0;
    while (ended === 0 && this.calls.ck_page_numbers() < MOST_STEPS) {
      ended = this.calls.ck_page_step();
      const step = this.rows();
      rows.push(...step);
      path.push(...step.slice(-2)); // its end, and just before: there a film may break
    }
    const trouble = this.said(), how = { [-1]: "failed", 0: "steps", 1: "released", 2: "stuck", 3: "late" }[ended];
    return { rows, path, how, trouble, ...this.numbers() };
  }

  // Rows over the gap at one speed, with one just before the film breaks.
  opening(low, high, speed, count = 240) {
    const end = this.calls.ck_page_end(), gaps = [];
    for (let i = 0; i < count; i++) gaps.push(low * (high / low) ** (i / (count - 1)));
    if (low < end && end < high) gaps.push(end * (1 - 1e-9), end * (1 + 1e-9));
    gaps.sort((a, b) => a - b);
    const rows = gaps.map((gap) => {
      if (!this.calls.ck_page_at(gap, speed)) throw new Error("a force is no finite number");
      const row = this.rows()[0];
      row[0] = (gap - low) / speed;
      return row;
    });
    return { rows, path: rows, how: "opened", end };
  }
}
