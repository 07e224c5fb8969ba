// The view of an injector: its film and its valve over the first cycle, and the delay of the opening
// over the pressure of the oil around the face.

const CYCLE = ["time", "gap", "speed", "pull", "force", "static", "viscous", "magnet", "spring", "stop", "current", "cavity", "state", "drive", "net"];
const READ = 13; // columns that the kernel gives; magnet less spring, and the net force, follow
const SHORT = 0.2; // of the longest step with which the stop can be coupled to the mass: an impact to some per cent
const THIN = 1e-15; // [Pa.s], of a film that is none: as models/injector/delays.py has it
const POINTS = 48; // of the curve over the pressure, 7 % apart
const HALVINGS = 6; // of the two points between which it ends: 0.1 %
const BAR = 1e5; // [Pa]
const SLICE = 12; // [ms] of a sweep between two looks at what the reader does

let driveNumbers, whole = false, sweep = { rows: [], names: [] };

// Film and drive with the values of the sliders, but for what `given` has of them.
function beginValve(given = {}) {
  const now = { ...values, ...given }, calls = kernel.calls;
  const [numbers, logs] = numbersNow(), liquid = given.temperature === undefined ? liquidNow() : liquidAt(given.temperature);
  const film = [...variablesNow(liquid), ...tensionsOf(now)], drive = [];
  for (const s of data.sliders)
    for (const [model, reference, offset] of s.targets ?? [])
      if (now[s.name] !== s.value) (model === "film" ? film : drive).push([reference, now[s.name] + offset]);
  if (given.dry) film.push(...dryFilm());
  kernel.fill("ck_valve", driveNumbers);
  calls.ck_valve_reset();
  kernel.load(numbers, film, { force: 0, rise: 0, limit: data.times.cycle });
  for (const [reference, value] of drive) if (!calls.ck_valve_set(reference, value)) throw new Error(kernel.said());
  if (!calls.ck_valve_start()) throw new Error(kernel.said());
  return { logs, liquid };
}

// Drops of the pressure at which the film cavitates, and in its cavity, from absolute pressures. A cavity
// bears no more tension than the oil does.
function tensionsOf(now) {
  if (data.limit < 0) return [];
  const { dp_inception, dp_hold } = data.references, inside = Math.max(now.cavity, -now.tension);
  return [[dp_inception, now.ambient + now.tension], [dp_hold, now.ambient - inside]];
}

function dryFilm() {
  const { dp_inception, dp_hold, dp_cav, eta } = data.references;
  return [[eta, THIN], ...[dp_inception, dp_hold, dp_cav].filter((one) => one).map((one) => [one, 0])];
}

function rowsOfValve(rows) {
  const count = kernel.calls.ck_valve_count(), first = kernel.calls.ck_valve_rows();
  const all = new Float64Array(kernel.calls.memory.buffer, first, count * READ);
  for (let i = 0; i < count; i++) {
    const row = Array.from(all.subarray(i * READ, (i + 1) * READ));
    row.push(row[7] - row[8], row[2] === 0 ? 0 : row[3] - row[4]); // at rest the end cap carries the rest
    rows.push(row);
  }
}

// Up to an end, or to the first release; rows where they are wanted.
function runValve(end, untilRelease, rows) {
  const longest = Math.min(data.step, SHORT * kernel.calls.ck_valve_longest());
  const length = end / Math.ceil(end / longest - 1e-9);
  let ended = 0;
  if (rows) rowsOfValve(rows);
  while (ended === 0) {
    ended = kernel.calls.ck_valve_run(length, end, untilRelease ? 1 : 0);
    if (rows) rowsOfValve(rows);
  }
  if (ended < 0) throw new Error(kernel.said());
  return kernel.numbers();
}

// Delay of the first opening within the pulse; NaN if there is none.
function delayOf(given) {
  beginValve(given);
  const { release } = runValve(data.times.pulse, true);
  return release >= 0 ? release : NaN;
}

function valveNow() {
  const { logs, liquid } = beginValve(), rows = [], { pulse, cycle } = data.times;
  const found = runValve(cycle, false, rows);
  const opened = found.release >= 0 && found.release <= pulse;
  const drop = (now) => (data.limit < 0 ? now.strength ?? 1 : now.ambient + now.tension);
  const path = rows.filter((row) => row[0] <= pulse);
  const result = {
    rows, how: opened ? "released" : "never",
    delay: opened ? found.release : NaN,
    peak: found.peak,
    inception: found.inception,
    closes: closingOf(rows),
    rests: opened ? rows.at(-1)[1] - (data.gaps.rest + (values.initial_gap ?? 0) - (start.initial_gap ?? 0)) : NaN,
    validity: validityOf(path, logs, liquid, drop(values) / drop(start)),
  };
  const dry = [];
  beginValve({ dry: true });
  const { release } = runValve(cycle, false, dry);
  return { ...result, dry: release >= 0 && release <= pulse ? release : NaN, dryCloses: closingOf(dry) };
}

// Time from the end of the pulse until half of the stroke is left; NaN if it never was that far open.
function closingOf(rows) {
  const moved = (values.initial_gap ?? 0) - (start.initial_gap ?? 0);
  const mark = 0.5 * (data.gaps.rest + data.gaps.stop) + moved, { pulse } = data.times;
  if (Math.max(...rows.filter((row) => row[0] <= pulse).map((row) => row[1])) < mark) return NaN;
  const i = rows.findIndex((row, n) => n > 0 && row[0] > pulse && row[1] < mark && rows[n - 1][1] >= mark);
  if (i < 0) return NaN;
  const [a, b] = [rows[i - 1], rows[i]];
  return a[0] + ((b[0] - a[0]) * (a[1] - mark)) / (a[1] - b[1]) - pulse;
}

// The delay over the pressure around the face, at some temperatures, computed while nobody moves anything.
function sweepCases() {
  const others = data.temperatures.filter((one) => Math.abs(one - values.temperature) > 0.01);
  const degrees = (kelvin) => `${written(kelvin - 273.15, 3)} \u00b0C`;
  if (!data.temperatures.length) return [["as set", undefined]];
  return [[`${degrees(values.temperature)}, as set`, values.temperature], ...others.map((one) => [degrees(one), one])];
}

// Pressures [bar] between which a column goes over to "never", and that half way between; none if it does not.
function flipOf(rows, column) {
  const sorted = rows.slice().sort((a, b) => a[0] - b[0]), i = sorted.findIndex((row) => !Number.isFinite(row[column]));
  if (i < 1) return [];
  const [low, high] = [sorted[i - 1][0], sorted[i][0]];
  return [low, high, Math.sqrt(low * high)];
}

let sweeping = 0;
function sweepSoon() {
  if (!data.pressures.length) return;
  const mine = ++sweeping, [low, high] = data.pressures, cases = sweepCases(), rows = [];
  delete document.body.dataset.swept;
  if (!shown.rows.length) return;
  const wanted = Array.from({ length: POINTS }, (_, i) => low * (high / low) ** (i / (POINTS - 1)));
  let halvings = HALVINGS * cases.length;
  const slice = () => {
    if (mine !== sweeping) return;
    const begun = performance.now();
    try {
      while (wanted.length && performance.now() - begun < SLICE) {
        const ambient = wanted.shift();
        rows.push([ambient / BAR, ...cases.map(([, temperature]) => delayOf({ ambient, temperature }))]);
        if (!wanted.length && halvings > 0) wanted.push(...flipOf(rows, 1 + (halvings-- % cases.length)).slice(2).map((one) => one * BAR));
      }
    } catch {
      return; // what is set is refused, and the page says so
    }
    rows.sort((a, b) => a[0] - b[0]);
    sweep = { rows, names: cases.map(([name]) => name) };
    drawSweep();
    if (wanted.length) return void setTimeout(slice);
    showResults();
    document.body.dataset.swept = "yes";
  };
  setTimeout(slice, 120);
}

// Charts ---------------------------------------------------------------------------------------

const INK = { net: "#000000", drive: "#0072b2", film: "#d55e00", gap: "#0072b2", cavity: "#cc79a7", current: "#009e73" };
const SWEPT = [["#000000", "none"], ["#0072b2", "7 4"], ["#d55e00", "2 3"]];
let delays;

function valveCharts() {
  const onPoint = (row) => charts.forEach((chart) => chart.point(row));
  const line = (label, name, colour, dashes = "none", more = {}) => ({ label, column: column(name), colour, dashes, ...more });
  const chart = (unit, title, ...series) => new Chart(by("charts"), { unit, title, series, onPoint });
  const made = [
    chart("m", "gap", line("gap", "gap", INK.gap)),
    chart("N", "force", line("magnet less spring", "drive", INK.drive, "10 3 2 3"), line("film", "force", INK.film, "2 3"),
      line("net, with the stop", "net", INK.net, "none", { clipped: true })),
  ];
  if (data.pressures.length) {
    const series = sweepCases().map(([label], i) => ({ label, column: i + 1, colour: SWEPT[i][0], dashes: SWEPT[i][1], none: "never" }));
    while (series.length < 1 + data.temperatures.length)
      series.push({ label: "", column: series.length + 1, colour: SWEPT[series.length][0], dashes: SWEPT[series.length][1], none: "never" });
    delays = new Chart(by("charts"), { unit: "s", title: "opens after", series, onPoint: (row) => delays.point(row) });
  }
  if (data.cavitates) made.push(chart("m", "radius of the cavity", line("radius of the cavity", "cavity", INK.cavity)));
  made.push(chart("m/s", "speed", line("speed, > 0 opens", "speed", INK.gap)), chart("A", "current", line("current", "current", INK.current)));
  return made;
}

function drawSweep() {
  if (!delays) return;
  delays.series.forEach((_, i) => delays.name(i, sweep.names[i] ?? ""));
  delays.draw(sweep.rows, { column: 0, unit: "bar", label: "pressure of the oil around the face", isLog: true, mark: values.ambient / BAR, top: data.times.pulse });
}

function drawValve() {
  const { pulse, cycle } = data.times;
  const end = whole ? cycle : shown.delay > 0 ? Math.min(2.5 * shown.delay, pulse) : pulse;
  const rows = shown.rows.filter((row) => row[0] <= end * (1 + 1e-9));
  charts.forEach((chart) => chart.draw(rows, { column: 0, unit: "s", label: "time since the current is on", isLog: false }));
  drawSweep();
}

function valveOutcome() {
  if (shown.how === "failed") return `no result: ${shown.trouble}`;
  const since = (time) => quantity(time, "s", 3);
  if (shown.how === "never" && !(shown.dry > 0)) return `never opens within the pulse of ${since(data.times.pulse)}: the magnet is too weak, with or without a film`;
  if (shown.how === "never") return `never opens within the pulse of ${since(data.times.pulse)}: the film holds it`;
  return `opens after ${since(shown.delay)}: the film holds it for ${since(shown.delay - shown.dry)}`;
}

function valveResults() {
  return [
    ["opens after, from the start of the pulse", "release_delay", shown.delay, "s", "never"],
    ["without a film", "dry_release_delay", shown.dry, "s", "never"],
    ["the film holds it for", "sticking_time", shown.delay - shown.dry, "s", "all of the pulse"],
    ["largest force of the film", "peak_force", shown.peak, "N"],
    ["the film cavitates after", "inception_time", shown.inception < 0 ? NaN : shown.inception, "s", "never"],
    ["closes after, from the end of the pulse", "closing_delay", shown.closes, "s", "it never was open"],
    ["later than without a film", "closing_lag", shown.closes - shown.dryCloses, "s", "it never was open"],
    ["gap that remains when the next pulse begins", "residual_gap", shown.rests, "m", "it never was open"],
    ...(data.pressures.length ? [["never opens from a pressure around the face of", "flip_pressure", flipOf(sweep.rows, 1)[1] ?? NaN, "bar", "-"]] : []),
  ];
}

// The three pressures stand in the scene as one absolute one, the drop at which the oil cavitates, and
// the pressure in the cavity.
function writeTensions(scene) {
  if (data.limit < 0 || ["ambient", "tension", "cavity"].every((name) => values[name] === start[name])) return;
  const { ambient, tension, cavity } = values;
  Object.assign(scene.effects[data.limit], {
    ambient_pressure: ambient, strength: ambient + tension, cavity_pressure: Math.max(cavity, -tension) });
}

run({
  names: CYCLE,
  async prepare() {
    await kernelReady();
    driveNumbers = new Float64Array(await unpacked(data.drive));
    tickBox("whole", "the whole cycle", (ticked) => {
      whole = ticked;
      drawValve();
    });
  },
  makeCharts: valveCharts,
  compute: valveNow,
  draw: drawValve,
  settled: sweepSoon,
  outcome: valveOutcome,
  isFine: () => shown.how === "released",
  results: valveResults,
  written: writeTensions,
  columns: [["time", "s"], ["gap", "m"], ["speed", "m/s"], ["pull", "N"], ["force", "N"], ["magnet", "N"], ["spring", "N"], ["stop", "N"], ["current", "A"], ["cavity", "m"]],
});
