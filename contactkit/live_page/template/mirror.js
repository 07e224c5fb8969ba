// The view of a micromirror: its release by the springs alone or by a reset pulse, the force that holds a
// tip over its gap, and the smallest pulse over the humidity.

const FLIGHT = ["time", "tilt", "rate", "gap", "force", "film", "state", "far_gap", "far_state", "degrees", "holds", "pulls"];
const FLOWN = 9; // columns that the kernel gives; degrees, and forces of all tips of the side, follow
const AWAY = 0.5; // of the landing tilt, below which a mirror has left: as models/micromirror/release.py
const COARSE = 2, FINE = 0.05; // [V] between the pulses tried first, and in the end: as there
const DRY = 1e-9; // of the tension and the viscosity of water that is not there
const HUMID = 25; // points of the curve over the humidity
const GAPS = 160; // points of the forces over the gap
const BUSY = 12; // [ms] of a sweep between two looks at what the reader does
const [LANDING, SPAN] = [8, 12]; // places of numbers of the mirror: landing tilt, length of the pulse

let dry = false, humid = { rows: [], limit: NaN }, forces = [], parts, over;

// Numbers of the tips, with the attraction of the solids that is set.
function tipNumbers(given) {
  const was = values.humidity;
  if (given.humidity !== undefined) values.humidity = given.humidity;
  const [numbers, logs] = numbersNow();
  values.humidity = was;
  const found = numbers.slice(), h = data.hamaker, isGrid = numbers.buffer !== data.numbers.buffer;
  if (h) for (const [first, count] of isGrid ? h.family : h.scene)
    for (let i = first; i < first + count; i++) found[i] *= values[h.name] / start[h.name];
  return [found, logs];
}

function loadTips(given) {
  const [numbers, logs] = tipNumbers(given), { calls } = kernel, set = [];
  for (const s of data.sliders)
    for (const [model, reference] of s.targets)
      if (model === "tip" && values[s.name] !== s.value) set.push([reference, values[s.name]]);
  kernel.load(numbers, set, { force: 0, rise: 0, limit: 1 });
  kernel.fill("ck_mirror", numbers);
  calls.ck_mirror_reset();
  const all = [...set];
  for (const name of ["gamma", "eta"]) {
    const reference = data.references[name];
    if (dry && reference) all.push([reference, DRY * calls.ck_page_get(reference)]);
  }
  for (const [reference, value] of all)
    if (!calls.ck_page_set(reference, value) || !calls.ck_mirror_tip(reference, value)) throw new Error(kernel.said());
  data.mirror.forEach((value, i) => calls.ck_mirror_set(i, value));
  for (const s of data.sliders)
    for (const [model, number] of s.targets) if (model === "mirror") calls.ck_mirror_set(number, values[s.name]);
  return logs;
}

// Release by a pulse of a voltage, 0 for none: its time, NaN if there is none; rows where they are wanted.
function flight(voltage, rows, given = {}) {
  const logs = loadTips(given), { calls } = kernel, { wait, step } = data.run, away = AWAY * data.mirror[LANDING];
  if (!calls.ck_mirror_start(voltage, wait, step)) throw new Error(kernel.said());
  const bend = calls.ck_mirror_bend();
  const read = () => {
    const count = calls.ck_mirror_count(), all = new Float64Array(calls.memory.buffer, calls.ck_mirror_rows(), count * FLOWN);
    for (let i = 0; i < count; i++) {
      const row = Array.from(all.subarray(i * FLOWN, (i + 1) * FLOWN)), tips = calls.ck_page_get(data.references.N);
      row.push((row[1] * 180) / Math.PI, tips * row[5], row[4]);
      rows.push(row);
    }
  };
  if (rows) read();
  let ended = 0, free = NaN;
  while (ended === 0) {
    ended = calls.ck_mirror_run(away);
    if (rows) read();
  }
  if (ended < 0) throw new Error(kernel.said());
  if (ended === 1) free = calls.ck_mirror_held();
  return { free, bend, logs };
}

// The smallest pulse that releases, looked for upwards from the bias; NaN if there is none.
function smallestPulse(given) {
  const releases = (voltage) => Number.isFinite(flight(voltage, null, given).free);
  const bias = Math.abs(data.mirror[9]), now = data.sliders.find(({ targets }) => targets.some(([m, n]) => m === "mirror" && n === 9));
  let low = now ? Math.abs(values[now.name]) : bias, high = low;
  try {
    while (!releases(high)) {
      if (high >= data.run.largest) return NaN;
      [low, high] = [high, Math.min(high + COARSE, data.run.largest)];
    }
  } catch {
    return NaN; // it would reach the electrode
  }
  while (high - low > FINE) {
    const middle = 0.5 * (low + high);
    if (releases(middle)) high = middle;
    else low = middle;
  }
  return high;
}

// Forces that hold all tips of a side at rest, over the gap.
function holding() {
  loadTips({});
  const { calls } = kernel, low = calls.ck_page_get(data.references.h0), tips = calls.ck_page_get(data.references.N);
  if (!calls.ck_page_start()) throw new Error(kernel.said());
  const found = [];
  for (let i = 0; i < GAPS; i++) {
    const gap = low * (data.run.free / low) ** (i / (GAPS - 1));
    if (!calls.ck_page_at(gap, 0)) throw new Error("a force is no finite number");
    const row = kernel.rows()[0];
    const each = data.parts.map(({ laws }) => tips * laws.reduce((sum, k) => sum + row[COLUMNS.indexOf("law0") + k], 0));
    found.push([gap, tips * row[5], ...each]);
  }
  return found;
}

function mirrorNow() {
  const rows = [], alone = flight(0, null), pulsed = flight(values.reset, rows);
  forces = holding();
  const kelvin = Math.exp(pulsed.logs[0]);
  const [first, ...held] = forces[0].slice(1);
  return {
    rows, how: pulsed.free >= 0 ? "released" : "stuck", free: pulsed.free, alone: alone.free,
    bend: pulsed.bend, presses: -rows[0][11], adhesion: first, held,
    smallest: smallestPulse({}),
    validity: dry ? [] : data.rules.map((rule) => ({ ...rule, value: kelvin })),
  };
}

// Over the humidity, while nobody moves anything.
let flying = 0;
function humidSoon() {
  const s = data.sliders.find(({ name }) => name === "humidity"), mine = ++flying;
  delete document.body.dataset.swept;
  if (!s || !shown.rows.length) return void (document.body.dataset.swept = "yes");
  const [low, high] = [Math.log(-Math.log(s.low)), Math.log(-Math.log(s.high))];
  const rows = [], alone = (humidity) => Number.isFinite(flight(0, null, { humidity }).free);
  let next = 0;
  const slice = () => {
    if (mine !== flying) return;
    const begun = performance.now();
    try {
      while (next < HUMID && performance.now() - begun < BUSY) {
        const place = low + ((high - low) * next++) / (HUMID - 1), humidity = Math.min(Math.max(Math.exp(-Math.exp(place)), s.low), s.high);
        rows.push([100 * humidity, smallestPulse({ humidity }), alone(humidity)]);
      }
      if (next < HUMID) {
        setTimeout(slice);
      } else {
        let i = rows.findIndex((row) => !row[2]), limit = i > 0 ? [rows[i - 1][0], rows[i][0]] : null;
        while (limit && limit[1] - limit[0] > 0.1) {
          const middle = 0.5 * (limit[0] + limit[1]);
          limit[alone(middle / 100) ? 0 : 1] = middle;
        }
        humid = { rows, limit: limit ? limit[1] : NaN };
        showResults();
        document.body.dataset.swept = "yes";
      }
    } catch {
      return; // what is set is refused, and the page says so
    }
    humid = { ...humid, rows };
    drawHumid();
  };
  setTimeout(slice, 120);
}

// Charts ---------------------------------------------------------------------------------------

const HUES = { holds: ["#d55e00", "2 3"], pulls: ["#0072b2", "10 3 2 3"], tilt: ["#0072b2", "none"], all: ["#000000", "none"] };
const EACH = [["#009e73", "7 4"], ["#d55e00", "2 3"], ["#cc79a7", "8 3 2 3"], ["#e69f00", "4 4"]];

function mirrorCharts() {
  const onPoint = (row) => charts.forEach((chart) => chart.point(row));
  const line = (label, name, [colour, dashes]) => ({ label, column: column(name), colour, dashes });
  const chart = (unit, title, ...series) => new Chart(by("charts"), { unit, title, series, onPoint });
  const made = [
    chart("N", "force", line("springs pull at the tips, below 0 they press", "pulls", HUES.pulls), line("water and solids hold", "holds", HUES.holds)),
    chart("m", "gap under a tip", line("gap under a tip", "gap", HUES.tilt)),
  ];
  const still = data.parts.filter(({ name }) => name !== "viscous_force");
  parts = new Chart(by("charts"), { unit: "N", title: "holding force over the gap", onPoint: (row) => parts.point(row), series: [
    { label: "all together", column: 1, colour: HUES.all[0], dashes: "none" },
    ...still.map((one, i) => ({ label: one.label, column: 2 + data.parts.indexOf(one), colour: EACH[i % 4][0], dashes: EACH[i % 4][1] }))] });
  if (data.family)
    over = new Chart(by("charts"), { unit: "V", title: "smallest reset pulse", onPoint: (row) => over.point(row), series: [
      { label: "smallest pulse that releases", column: 1, colour: HUES.all[0], dashes: "none", none: `none up to ${data.run.largest} V` }] });
  made.push(chart("\u00b0", "tilt", line("tilt", "degrees", HUES.tilt)));
  return made;
}

function drawHumid() {
  over?.draw(humid.rows, { column: 0, unit: "%", label: "relative humidity", isLog: false, mark: 100 * values.humidity });
}

function drawMirror() {
  const until = shown.free > 0 ? 1.25 * shown.free : Infinity; // beyond, the mirror is on its way over
  const rows = shown.rows.filter((row) => row[0] <= until);
  charts.forEach((chart) => chart.draw(rows, { column: 0, unit: "s", label: "time since the pulse begins, or the bias ends", isLog: false }));
  parts.draw(shown.rows.length ? forces : [], { column: 0, unit: "m", label: "gap", isLog: true });
  drawHumid();
}

function mirrorOutcome() {
  if (shown.how === "failed") return `no result: ${shown.trouble}`;
  const after = (time) => quantity(time, "s", 3), by = values.reset > 0 ? `a pulse of ${written(values.reset, 3)} V` : "the springs";
  const alone = shown.alone >= 0 ? `the springs alone release it after ${after(shown.alone)}` : "the springs alone do not";
  if (values.reset === 0) return shown.alone >= 0 ? `released by the springs alone after ${after(shown.free)}` : "stuck: the springs alone do not release it";
  return shown.how === "released" ? `released by ${by} after ${after(shown.free)}; ${alone}` : `stuck: ${by} does not release it; ${alone}`;
}

function mirrorResults() {
  const held = data.parts.map(({ label, name }, i) => [label, name, shown.held[i], "N"]).filter(([, name]) => name !== "viscous_force");
  return [
    ["free after the pulse begins", "free_time", shown.free, "s", "stuck"],
    ["free by the springs alone after", "alone_time", shown.alone, "s", "stuck"],
    ["smallest pulse that releases", "smallest_pulse", shown.smallest, "V", `none up to ${data.run.largest} V`],
    ["the springs alone fail from a humidity of", "humidity_limit", humid.limit, "%", "-"],
    ["tips press at rest with", "preload", shown.presses, "N"],
    ["bend of a tip at rest", "bend", shown.bend, "m"],
    ["tips are held by", "adhesion", shown.adhesion, "N"],
    ...held,
  ];
}

run({
  names: FLIGHT,
  async prepare() {
    await kernelReady();
    tickBox("dry", "dry: nothing condenses", (ticked) => {
      dry = ticked;
      update();
    });
  },
  makeCharts: mirrorCharts,
  compute: mirrorNow,
  draw: drawMirror,
  settled: humidSoon,
  outcome: mirrorOutcome,
  isFine: () => shown.how === "released",
  results: mirrorResults,
  written: (scene) => {
    if (values.reset !== start.reset) scene.mirror.waveform.reset_voltage = data.run.sign * values.reset;
  },
  columns: [["time", "s"], ["tilt", "rad"], ["rate", "rad/s"], ["gap", "m"], ["force", "N"], ["film", "N"]],
});
