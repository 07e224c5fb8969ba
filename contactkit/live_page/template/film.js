// The view of a film: a motion over time, or the forces over the gap.

function filmNow() {
  const [numbers, logs] = numbersNow(), liquid = liquidNow();
  const pull = { force: values.force ?? data.pull.force, rise: values.rise_time ?? data.pull.rise, limit: data.pull.limit };
  kernel.begin(numbers, variablesNow(liquid), pull);
  const found = data.imposed === "force"
    ? kernel.motion()
    : kernel.opening(values.initial_gap ?? data.gaps[0], values.final_gap ?? data.gaps[1], values.speed);
  for (const row of found.rows) row.push(...data.parts.map(({ laws }) => laws.reduce((sum, i) => sum + row[COLUMNS.indexOf("law0") + i], 0)));
  const strength = (values.strength ?? 1) / (start.strength ?? 1);
  found.validity = validityOf(found.path, logs, liquid, strength);
  return found;
}

const COLOURS = { total: "#000000", pull: "#0072b2", gap: "#0072b2", cavity: "#cc79a7" };
// Of the parts of the force; the viscous one always looks the same.
const VISCOUS = ["#d55e00", "2 3"];
const PARTS = [["#009e73", "7 4"], ["#cc79a7", "8 3 2 3"], ["#e69f00", "4 4"], ["#56b4e9", "1 3"], ["#882255", "12 4"]];

function filmCharts() {
  const onPoint = (row) => charts.forEach((chart) => chart.point(row));
  const line = (label, name, colour, dashes = "none") => ({ label, column: column(name), colour, dashes });
  const looks = PARTS.slice();
  const forces = data.parts.map(({ label, name }) => line(label, name, ...(name === "viscous_force" ? VISCOUS : looks.shift() ?? PARTS[0])));
  if (forces.length > 1) forces.unshift(line("all together", "force", COLOURS.total));
  if (data.imposed === "force") forces.push(line("pull", "pull", COLOURS.pull, "10 3 2 3"));
  if (data.limits) forces.push({ ...line(`viscous force without ${data.limits}`, "unlimited", "#999999", "1 2"), clipped: true });
  const made = [new Chart(by("charts"), { unit: "N", title: "force", series: forces, onPoint })];
  if (data.imposed !== "force") return made;
  made.push(new Chart(by("charts"), { unit: "m", title: "gap", series: [line("gap", "gap", COLOURS.gap)], onPoint }));
  made.push(new Chart(by("charts"), { unit: "m/s", title: "opening speed", series: [line("opening speed", "speed", COLOURS.gap)], onPoint }));
  if (data.cavitates)
    made.push(new Chart(by("charts"), { unit: "m", title: "radius of the cavity", series: [line("radius of the cavity", "cavity", COLOURS.cavity)], onPoint }));
  return made;
}

function axisNow() {
  if (data.imposed !== "force") return { column: column("gap"), unit: "m", label: "gap", isLog: isLog() };
  return { column: column("time"), unit: "s", label: "time", isLog: isLog() };
}

// Where all happens at the start or over decades, the axis is logarithmic unless the reader chose.
function isLog() {
  if (logarithmic !== null) return logarithmic;
  if (data.imposed !== "force") return true;
  return shown.rows.length > 0 && shown.peakTime >= 0 && shown.peakTime < 0.01 * shown.rows.at(-1)[0];
}

function outcome() {
  const { how } = shown, since = (time) => quantity(time, "s");
  if (how === "opened") return shown.end < (values.final_gap ?? data.gaps[1]) ? `the film breaks at a gap of ${quantity(shown.end, "m")}` : "the film spans the gap";
  if (how === "released") return `released after ${since(shown.release)} at ${quantity(shown.speed, "m/s")}`;
  if (how === "stuck") return "stuck: the pull does not exceed what holds the bodies at rest; pull harder, or start from a larger gap";
  if (how === "late") return `not released within ${since(data.pull.limit)}`;
  if (how === "steps") return `not released within ${MOST_STEPS} steps of the solver, ${since(shown.rows.at(-1)[0])}`;
  return `no result: ${shown.trouble}`;
}

function results() {
  if (shown.how === "opened") {
    const first = shown.rows[0], force = shown.rows.map((row) => row[column("force")]);
    return [
      ["force at the smallest gap", "first_force", first[column("force")], "N"],
      ["largest force", "peak_force", Math.max(...force), "N"],
      ["gap at which the film breaks", "break_gap", shown.end < 1 ? shown.end : NaN, "m"],
    ];
  }
  const released = shown.how === "released";
  return [
    ["release time", "release_time", released ? shown.release : NaN, "s"],
    ["speed at release", "release_speed", released ? shown.speed : NaN, "m/s"],
    ["peak force", "peak_force", shown.peak, "N"],
    ["time of the peak", "peak_time", shown.peakTime < 0 ? NaN : shown.peakTime, "s"],
    ["rupture of the film", "break_time", shown.rupture < 0 ? NaN : shown.rupture, "s"],
    ["work dissipated in the film", "dissipated_work", shown.work, "J"],
    ["impulse of the viscous force", "viscous_impulse", shown.viscous, "N\u00b7s"],
    ["impulse of the other forces", "static_impulse", shown.still, "N\u00b7s"],
  ];
}

run({
  names: [...COLUMNS, ...data.parts.map(({ name }) => name)],
  prepare: kernelReady,
  makeCharts: filmCharts,
  compute: filmNow,
  draw: () => charts.forEach((chart) => chart.draw(shown.rows, axisNow())),
  outcome,
  isFine: () => ["released", "opened"].includes(shown.how),
  results,
  columns: [["time", "s"], ["gap", "m"], ["speed", "m/s"], ["pull", "N"], ["force", "N"], ...data.parts.map(({ name }) => [name, "N"]), ...(data.limits ? [["unlimited", "N"]] : []), ["cavity", "m"]],
  isLog,
});
