// The page: sliders move values, the kernel computes, curves and numbers follow, the address keeps it.

const data = JSON.parse(document.getElementById("data").textContent);
const by = (id) => document.getElementById(id);
const column = (name) => COLUMNS.indexOf(name);
const start = Object.fromEntries(data.sliders.map((s) => [s.name, s.value]));
const values = { ...start };
let kernel, shown, charts, logarithmic = null;

function made(tag, text, attributes = {}) {
  const found = document.createElement(tag);
  if (text !== undefined) found.textContent = text;
  for (const key in attributes) found.setAttribute(key, attributes[key]);
  return found;
}

// Sliders --------------------------------------------------------------------------------------

const STEPS = 600;
const along = (s, value) => (s.scale === "log" ? Math.log(value) : value);

function positionOf(s, value) {
  const low = along(s, s.low), high = along(s, s.high);
  return Math.round((STEPS * (along(s, value) - low)) / (high - low));
}

// Value at a position, rounded to what is written beside it.
function valueAt(s, position) {
  const low = along(s, s.low), high = along(s, s.high), place = low + ((high - low) * position) / STEPS;
  const exact = s.scale === "log" ? Math.exp(place) : place;
  const rounded = Number(((exact - s.shift) / s.factor).toPrecision(3)) * s.factor + s.shift;
  return Math.min(Math.max(rounded, s.low), s.high);
}

function makeSliders() {
  for (const s of data.sliders) {
    const box = made("div", undefined, { class: "slider" }), id = `move-${s.name}`;
    const input = made("input", undefined, { id, type: "range", min: 0, max: STEPS, step: 1 });
    s.show = () => {
      input.value = positionOf(s, values[s.name]);
      const text = `${written((values[s.name] - s.shift) / s.factor)} ${s.unit}`.trim();
      output.textContent = text;
      input.setAttribute("aria-valuetext", text);
      box.classList.toggle("moved", values[s.name] !== start[s.name]);
    };
    const output = made("output", undefined, { for: id });
    input.addEventListener("input", () => {
      values[s.name] = valueAt(s, Number(input.value));
      s.show();
      later();
    });
    box.append(made("label", s.label, { for: id }), output, input);
    by("sliders").append(box);
    s.show();
  }
  by("held").textContent = data.held.join(" ");
}

// From values to what the kernel takes ---------------------------------------------------------

// Numbers of the kernel, then those of validity: of the scene as it was the tables themselves.
function numbersNow() {
  const moved = data.family?.sliders.some((name) => values[name] !== start[name]);
  if (!moved) return [data.numbers.subarray(0, data.count), data.numbers.subarray(data.count)];
  const sliders = data.family.sliders.map((name) => data.sliders.find((s) => s.name === name));
  const found = numbersAt(data.family, sliders, sliders.map((s) => values[s.name]));
  return [found.subarray(0, data.family.count), found.subarray(data.family.count)];
}

// Properties of the liquid now, over those at the start.
function liquidNow() {
  const found = {}, { temperature } = values;
  for (const s of data.sliders) if (s.by === "liquid") found[s.name] = values[s.name] / s.value;
  const moves = data.sliders.some((s) => s.by === "temperature") && temperature !== start.temperature;
  if (moves)
    for (const name in data.liquid.logs)
      found[name] = propertyAt(data.liquid, name, temperature) / propertyAt(data.liquid, name, start.temperature);
  return found;
}

function variablesNow(liquid) {
  const found = [];
  for (const s of data.sliders)
    if (s.by === "kernel" && values[s.name] !== s.value) found.push([s.reference, values[s.name]]);
  for (const { name, reference, value } of data.properties)
    if (liquid[name] !== undefined && liquid[name] !== 1) found.push([reference, value * liquid[name]]);
  return found;
}

function compute() {
  const [numbers, logs] = numbersNow(), liquid = liquidNow();
  const pull = { force: values.force ?? data.pull.force, rise: values.rise_time ?? data.pull.rise, limit: data.pull.limit };
  kernel.begin(numbers, variablesNow(liquid), pull);
  const found = data.imposed === "force"
    ? kernel.motion()
    : kernel.opening(values.initial_gap ?? data.gaps[0], values.final_gap ?? data.gaps[1], values.speed);
  const strength = (values.strength ?? 1) / (start.strength ?? 1);
  const path = found.path.filter((row) => row[column("state")] !== data.broken && row[column("gap")] > 0)
    .map((row) => [row[column("gap")], row[column("speed")]]);
  found.validity = data.rules.map((rule, i) => ({ ...rule,
    value: worstOf(data.rules, logs, data.points, i, path, liquid, strength) }));
  return found;
}

// What is shown --------------------------------------------------------------------------------

const COLOURS = { total: "#000000", static: "#009e73", viscous: "#d55e00", pull: "#0072b2", gap: "#0072b2", cavity: "#cc79a7" };

function makeCharts() {
  const onPoint = (row) => charts.forEach((chart) => chart.point(row));
  const line = (label, name, colour, dashes = "none") => ({ label, column: column(name), colour, dashes });
  const forces = [line("all together", "force", COLOURS.total)];
  if (data.parts.static) forces.push(line(data.parts.static, "static", COLOURS.static, "7 4"));
  if (data.parts.viscous) forces.push(line(data.parts.viscous, "viscous", COLOURS.viscous, "2 3"));
  if (data.imposed === "force") forces.push(line("pull", "pull", COLOURS.pull, "10 3 2 3"));
  if (forces.length === 2) forces.shift();
  charts = [new Chart(by("charts"), { unit: "N", title: "force", series: forces, onPoint })];
  if (data.imposed !== "force") return;
  charts.push(new Chart(by("charts"), { unit: "m", title: "gap", series: [line("gap", "gap", COLOURS.gap)], onPoint }));
  charts.push(new Chart(by("charts"), { unit: "m/s", title: "opening speed", series: [line("opening speed", "speed", COLOURS.gap)], onPoint }));
  if (data.cavitates)
    charts.push(new Chart(by("charts"), { unit: "m", title: "radius of the cavity", series: [line("radius of the cavity", "cavity", COLOURS.cavity)], onPoint }));
}

function axisNow() {
  if (data.imposed !== "force") return { column: column("gap"), unit: "m", label: "gap", isLog: isLog() };
  return { column: column("time"), unit: "s", label: "time", isLog: isLog() };
}

// Where all happens at the start or over decades, the axis is logarithmic unless the reader chose.
function isLog() {
  if (logarithmic !== null) return logarithmic;
  if (data.imposed !== "force") return true;
  return shown.peakTime >= 0 && shown.peakTime < 0.01 * shown.rows.at(-1)[0];
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

function row(label, small, text, attributes) {
  const line = made("tr"), cell = made("td", label);
  if (small) cell.append(made("span", small, { class: "small" }));
  line.append(cell, made("td", text, { class: "number", ...attributes }));
  return line;
}

function bounds(one) {
  if (one.low === null) return `at most ${written(one.high, 3)}`;
  return one.high === null ? `at least ${written(one.low, 3)}` : `${written(one.low, 3)} to ${written(one.high, 3)}`;
}

function show() {
  const axis = axisNow();
  charts.forEach((chart) => chart.draw(shown.rows, axis));
  by("status").textContent = outcome();
  by("status").className = ["released", "opened"].includes(shown.how) ? "" : "bad";
  by("results").replaceChildren(...results().map(([label, name, value, unit]) =>
    row(label, "", quantity(value, unit), { id: `n-${name}`, "data-value": value })));
  const outside = shown.validity.filter((one) => !(one.value >= (one.low ?? -Infinity) && one.value <= (one.high ?? Infinity)));
  by("verdict").textContent = outside.length
    ? `validity: out of range: ${outside.map((one) => one.name).join(", ")}`
    : `validity: all ${shown.validity.length} numbers evaluated here are within their range`;
  by("verdict").className = outside.length ? "bad" : "";
  by("validity").replaceChildren(
    ...shown.validity.map((one) => {
      const bad = outside.includes(one) ? { class: "number bad" } : {};
      return row(one.name, `${bounds(one)}; ${one.detail}`, (bad.class ? "\u2717 " : "\u2713 ") + written(one.value, 3), { "data-value": one.value, "data-number": one.name, ...bad });
    }),
    ...Object.entries(data.missing).map(([name, why]) => row(name, `not evaluated: ${why}`, "-", {})));
}

// What the kernel says, in the words of the sliders.
function inWords(message) {
  const text = message.replace(/^initialization: /, "").replace(/; reset the FMU.*/, "");
  return data.sliders.filter((s) => s.port).reduce(
    (found, s) => found.replaceAll(new RegExp(`\\b${s.port}\\b`, "g"), s.label), text);
}

function refused(error) {
  by("status").textContent = inWords(error.message);
  by("status").className = "bad";
  charts.forEach((chart) => chart.draw([], axisNow()));
  for (const id of ["results", "validity", "verdict"]) by(id).replaceChildren();
}

let waiting = false;
function later() {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => {
    waiting = false;
    update();
  });
}

function update() {
  try {
    shown = compute();
    show();
  } catch (error) {
    shown = { rows: [], how: "failed", peakTime: -1, trouble: error.message };
    refused(error);
  }
  const moved = Object.keys(values).filter((name) => values[name] !== start[name]);
  const hash = moved.map((name) => `${name}=${values[name]}`).join("&");
  history.replaceState(null, "", hash ? `#${hash}` : location.pathname + location.search);
  announce();
}

// The address, and files -----------------------------------------------------------------------

// Inside another page: shorter (page.css), and that page hears how tall it is and what is moved.
const embedded = globalThis.parent !== globalThis;
document.documentElement.classList.toggle("embedded", embedded);
function announce() {
  if (embedded) parent.postMessage({ height: document.body.offsetHeight, hash: location.hash }, "*");
}

function readAddress() {
  Object.assign(values, start);
  for (const [name, text] of new URLSearchParams(location.hash.slice(1))) {
    const s = data.sliders.find((one) => one.name === name), value = Number(text);
    if (s && Number.isFinite(value)) values[name] = Math.min(Math.max(value, s.low), s.high);
  }
}

function save(name, text) {
  const link = made("a", undefined, { download: name, href: URL.createObjectURL(new Blob([text])) });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

const isTable = (value) => value !== null && typeof value === "object" && !Array.isArray(value);
const isTables = (value) => Array.isArray(value) && value.length > 0 && value.every(isTable);

// Tables of TOML: first what is plain, then the tables below.
function toml(table, path = []) {
  const lines = [], below = [];
  for (const [key, value] of Object.entries(table)) {
    const at = [...path, /^[\w-]+$/.test(key) ? key : JSON.stringify(key)];
    if (isTables(value)) for (const one of value) below.push(`\n[[${at.join(".")}]]`, ...toml(one, at));
    else if (isTable(value)) below.push(`\n[${at.join(".")}]`, ...toml(value, at));
    else lines.push(`${at.at(-1)} = ${JSON.stringify(value)}`);
  }
  return [...lines, ...below];
}

function sceneNow() {
  const scene = structuredClone(data.scene);
  for (const s of data.sliders) {
    if (values[s.name] === s.value) continue;
    for (const place of s.places) {
      let at = scene;
      for (const key of place.slice(0, -1)) at = at[key] ??= {};
      at[place.at(-1)] = values[s.name];
    }
  }
  return toml(scene).join("\n") + "\n";
}

function curves() {
  const names = ["time", "gap", "speed", "pull", "force", "static", "viscous", "cavity"];
  const units = { time: "s", gap: "m", speed: "m/s", cavity: "m" };
  const lines = shown.rows.map((one) => names.map((name) => one[column(name)]).join(","));
  return [names.map((name) => `${name} [${units[name] ?? "N"}]`).join(","), ...lines].join("\n") + "\n";
}

function makeButtons() {
  by("toml").onclick = () => save(`${data.name}.toml`, sceneNow());
  by("csv").onclick = () => save(`${data.name}.csv`, curves());
  by("link").onclick = () => navigator.clipboard?.writeText(location.href);
  by("reset").onclick = () => {
    Object.assign(values, start);
    data.sliders.forEach((s) => s.show());
    update();
  };
  by("fmu").textContent = data.fmu;
  const box = made("label", " logarithmic axis"), tick = made("input", undefined, { type: "checkbox", id: "log" });
  box.prepend(tick);
  by("look").prepend(box);
  tick.onchange = () => {
    logarithmic = tick.checked;
    show();
  };
  return tick;
}

async function main() {
  if (!globalThis.DecompressionStream || !globalThis.WebAssembly)
    throw new Error("this browser has no WebAssembly or DecompressionStream: take one of 2023 or later");
  data.numbers = new Float64Array(await unpacked(data.numbers));
  if (data.family) {
    data.family.base = new Float64Array(await unpacked(data.family.base));
    data.family.changes = new Float32Array(await unpacked(data.family.changes));
  }
  kernel = await Kernel.from(by("kernel").textContent.trim());
  data.on.forEach((text) => by("on").append(made("li", text)));
  data.off.forEach((text) => by("off").append(made("li", text)));
  makeCharts();
  readAddress();
  makeSliders();
  const tick = makeButtons();
  update();
  tick.checked = isLog();
  addEventListener("resize", () => shown.rows.length && show());
  addEventListener("hashchange", () => {
    readAddress();
    data.sliders.forEach((s) => s.show());
    update();
  });
  new ResizeObserver(announce).observe(document.body);
  document.body.dataset.ready = "yes";
}

main().catch((error) => {
  by("status").textContent = error.message;
  by("status").className = "bad";
});
