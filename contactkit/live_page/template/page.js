// The page: sliders move values, its view computes and draws, the address keeps it. A view, such as
// film.js, has
//   names       of the columns of the rows that `compute` returns, as {rows, validity, ...}
//   columns     that are saved, as [name, unit]
//   prepare, makeCharts, draw   what its name says; `settled` is called after each change, if it is there
//   outcome, isFine   one sentence, and whether it is a good one
//   results     as [label, id, value, unit, what stands for no value]
//   isLog       whether the axis is logarithmic unless the reader chose; a view without it has no choice
//   written     changes the scene that is saved, where fields follow several sliders; if it is there

const column = (name) => view.names.indexOf(name);
const start = Object.fromEntries(data.sliders.map((s) => [s.name, s.value]));
const values = { ...start };
let view, shown, charts, logarithmic = null;

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
  if (s.whole) return Math.round(exact);
  const rounded = Number(((exact - s.shift) / s.factor).toPrecision(3)) * s.factor + s.shift;
  return Math.min(Math.max(rounded, s.low), s.high);
}

// Place of the sliders of a group; groups are told by headings, and the last ones are closed at first.
const GROUPS = {};
function placeOfGroup(name = "") {
  if (!name) return by("sliders");
  if (!GROUPS[name]) {
    GROUPS[name] = made("details");
    GROUPS[name].open = Object.keys(GROUPS).length === 1;
    GROUPS[name].append(made("summary", name));
    by("sliders").append(GROUPS[name]);
  }
  return GROUPS[name];
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
    placeOfGroup(s.group).append(box);
    s.show();
  }
  by("held").textContent = data.held.join(" ");
}

// What is shown --------------------------------------------------------------------------------

function show() {
  view.draw();
  by("status").textContent = view.outcome();
  by("status").className = view.isFine() ? "" : "bad";
  showResults();
  showValidity(shown.validity, data.missing);
}

function showResults() {
  by("results").replaceChildren(...view.results().map(([label, name, value, unit, none]) =>
    row(label, "", none && !Number.isFinite(value) ? none : quantity(value, unit), { id: `n-${name}`, "data-value": value })));
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
  view.draw();
  for (const id of ["results", "validity", "verdict"]) by(id).replaceChildren();
}

const later = atNextFrame(() => update());

function update() {
  try {
    shown = view.compute();
    show();
  } catch (error) {
    shown = { rows: [], how: "failed", trouble: error.message };
    refused(error);
  }
  view.settled?.();
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

function sceneNow() {
  const scene = structuredClone(data.scene);
  for (const s of data.sliders) {
    if (values[s.name] === s.value) continue;
    s.places.forEach((place, i) => {
      let at = scene;
      for (const key of place.slice(0, -1)) at = at[key] ??= {};
      at[place.at(-1)] = values[s.name] + (s.offsets?.[i] ?? 0);
    });
  }
  view.written?.(scene);
  return toml(scene).join("\n") + "\n";
}

function curves() {
  const places = view.columns.map(([name]) => column(name));
  const lines = shown.rows.map((one) => places.map((place) => one[place]).join(","));
  return [view.columns.map(([name, unit]) => `${name} [${unit}]`).join(","), ...lines].join("\n") + "\n";
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
  by("order").hidden = !data.fmu;
  by("fmus").hidden = !data.fmus.length;
  for (const { name, content } of data.fmus) {
    const button = made("button", `FMU as built: ${name}`);
    button.onclick = () => save(name, Uint8Array.from(atob(content), (c) => c.charCodeAt(0)));
    by("fmus").append(button, " ");
  }
}

function makeAxisChoice() {
  const box = made("label", " logarithmic axis"), tick = made("input", undefined, { type: "checkbox", id: "log" });
  box.prepend(tick);
  by("look").prepend(box);
  tick.checked = view.isLog();
  tick.onchange = () => {
    logarithmic = tick.checked;
    show();
  };
}

async function main() {
  if (!globalThis.DecompressionStream || !globalThis.WebAssembly)
    throw new Error("this browser has no WebAssembly or DecompressionStream: take one of 2023 or later");
  await view.prepare();
  showEffects();
  charts = view.makeCharts();
  readAddress();
  makeSliders();
  makeButtons();
  update();
  if (view.isLog) makeAxisChoice();
  addEventListener("resize", () => shown.rows.length && show());
  addEventListener("hashchange", () => {
    readAddress();
    data.sliders.forEach((s) => s.show());
    update();
  });
  new ResizeObserver(announce).observe(document.body);
  document.body.dataset.ready = "yes";
}

function run(its) {
  view = its;
  main().catch(failed);
}
