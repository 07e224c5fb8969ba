// The page of a contact: maps under each load and at each depth, sections through a point, curves over
// the load. Nothing is computed here: what is shown was solved when the page was made.

const SERIES = [["#0072b2", "none"], ["#d55e00", "7 4"], ["#009e73", "2 3"], ["#cc79a7", "10 3 2 3"], ["#000000", "1 2"]];
// Maps of each view: the whole window, and a close-up if its cells are wider than the pixels.
const mapsOf = (view) => ["surface", "stress"].flatMap((kind) =>
  (view[kind]?.maps ?? []).map((one) => ({ ...one, kind, view, of: view[kind] })));
const views = data.views.map(mapsOf), hasStress = data.planes.length > 0;
const initial = {};
const now = { edges: new Set(data.outlines.map((one) => one.name)) };
const known = new Map();
let bytes, view, sections, charts;

const mapNow = () => views[now.close].find((one) => one.name === now.map);
const isStress = () => mapNow().kind === "stress";
const imageNow = () => mapNow().images[now.load][isStress() ? now.plane : 0];

function valuesNow() {
  const image = imageNow(), source = isStress() ? bytes.planes : bytes.maps, key = `${isStress()} ${image.start}`;
  if (!known.has(key)) {
    if (known.size > 40) known.clear();
    known.set(key, valuesOf(source, image, mapNow().of.shape));
  }
  return known.get(key);
}

// Bits of the outlines on the cells of the map: stress may have wider ones than they do.
function flagsNow() {
  const { view } = mapNow(), { shape, factor, flags } = view.surface, fine = levelsAt(bytes.maps, flags[now.load], 1, shape);
  if (!isStress() || view.stress.factor === factor) return fine;
  const [ny, nx] = view.stress.shape, ratio = view.stress.factor / factor, found = new Uint16Array(ny * nx);
  const reached = (i, n) => [Math.floor(i * ratio), Math.min(Math.ceil((i + 1) * ratio), n)];
  for (let row = 0; row < ny; row++)
    for (let column = 0; column < nx; column++) {
      const [top, bottom] = reached(row, shape[0]), [left, right] = reached(column, shape[1]);
      for (let j = top; j < bottom; j++) for (let i = left; i < right; i++) found[row * nx + column] |= fine[j * shape[1] + i];
    }
  return found;
}

// Range of the colours: of this map, or of all loads and depths.
function rangeNow() {
  const whole = views[0].find((one) => one.name === now.map);
  const images = now.same ? whole.images.flat() : [imageNow()], levels = isStress() ? data.levels.planes : data.levels.maps;
  return [Math.min(...images.map((one) => one.low)), Math.max(...images.map((one) => one.low + levels * one.step))];
}

// Centres of the cells along a side, the last of which may be narrower.
function centres(n, pixel, first, side) {
  const width = mapNow().of.factor * pixel;
  return Array.from({ length: n }, (_, i) => first + 0.5 * (i * width + Math.min((i + 1) * width, side)));
}

function axesNow() {
  const { of: { shape: [ny, nx] }, view: { x, y, width, height } } = mapNow(), [dy, dx] = data.pixel;
  return { xs: centres(nx, dx, x, width), ys: centres(ny, dy, y, height) };
}

const nearest = (places, value) => places.reduce((best, one, i) => (Math.abs(one - value) < Math.abs(places[best] - value) ? i : best), 0);

// Sections of the map through the point: [place, value], without what has none.
function sectionsNow() {
  const values = valuesNow(), { xs, ys } = axesNow(), column = nearest(xs, now.x), row = nearest(ys, now.y);
  const kept = (rows) => rows.filter((one) => !Number.isNaN(one[1]));
  return {
    column, row, xs, ys, value: values[row * xs.length + column],
    along: [kept(xs.map((x, i) => [x, values[row * xs.length + i]])), kept(ys.map((y, i) => [y, values[i * xs.length + column]]))],
  };
}

// What is shown --------------------------------------------------------------------------------

function showMap() {
  const map = mapNow(), image = imageNow(), [low, high] = rangeNow(), { outlines } = data;
  const flat = map.name === "gap" || map.name === "heights" || isStress();
  const drawn = outlines.map((one, i) => ({ ...one, bit: 1 << i, colour: edgeColour(one.name, i), thin: !flat && one.name === "meniscus" }))
    .filter((one) => one.name !== "holes" && now.edges.has(one.name) && (flat || one.name !== "contact"));
  const holes = outlines.findIndex((one) => one.name === "holes");
  view.draw({
    ...map.of, values: valuesNow(), flags: flagsNow(), window: map.view, pixel: data.pixel, unit: map.unit, low, high, outlines: drawn,
    title: isStress() ? `${map.label}, ${data.planes[now.plane]}` : map.label,
    hasNothing: !flat, nearZero: 0.5 * image.step, holes: holes < 0 ? 0 : 1 << holes, top: image.top,
  });
  const [value, x, y] = image.top;
  by("top").textContent = `ring: ${value < 0 ? "minimum" : "maximum"} ${quantity(value, map.unit)} at x = ${quantity(x, "m")}, y = ${quantity(y, "m")}`;
  makeSections([low, high]);
  showPoint();
}

const edgeColour = (name, i) => EDGES[name] ?? SERIES[i % SERIES.length][0];

function makeSections(range) {
  const map = mapNow(), key = `${map.name} ${range} ${now.close}`;
  if (sections?.key === key) return;
  by("sections").replaceChildren();
  sections = ["x", "y"].map((axis) => new Chart(by("sections"), {
    unit: map.unit, title: `${map.label} along ${axis}`, ratio: 0.5, range: [Math.min(range[0], 0), Math.max(range[1], 0)],
    series: [{ label: map.label, column: 1, colour: SERIES[0][0], dashes: "none" }],
    onPoint: (row) => {
      now[axis] = row[0];
      showPoint();
      keepAddress();
    },
  }));
  sections.key = key;
}

function showPoint() {
  const { column, row, xs, ys, value, along } = sectionsNow(), map = mapNow();
  [now.x, now.y] = [xs[column], ys[row]];
  view.point(now.x, now.y);
  sections.forEach((chart, i) => {
    chart.draw(along[i], { column: 0, unit: "m", label: "xy"[i], isLog: false });
    chart.point([i ? now.y : now.x, value]);
  });
  by("here").textContent = `${quantity(value, map.unit)} at x = ${quantity(now.x, "m")}, y = ${quantity(now.y, "m")}`;
}

function showLoad() {
  const load = data.loads[now.load], { label, unit } = data.axis;
  by("status").textContent = `${label} ${load.text}: ${load.outcome}`;
  by("status").className = load.is_fine ? "" : "bad";
  showValidity(load.validity, load.missing);
  by("results").replaceChildren(...load.numbers.map((one) =>
    row(one.label, one.remark, one.text, { id: `n-${one.name}`, "data-value": one.value })));
  const axis = { column: 0, unit, label, isLog: data.rows[0][0] > 0 && data.rows.at(-1)[0] > 10 * data.rows[0][0] };
  charts.forEach((chart) => {
    chart.draw(data.rows, axis);
    chart.point(data.rows[now.load]);
  });
}

function show() {
  const set = (name, position, text) => {
    const box = by(`${name}-box`), input = by(name);
    input.value = position;
    input.setAttribute("aria-valuetext", text);
    box.querySelector("output").textContent = text;
  };
  set("load", now.load, data.loads[now.load].text);
  if (hasStress) set("plane", now.plane, data.planes[now.plane]);
  by("plane-box").hidden = !isStress();
  by("which").value = now.map;
  by("same").checked = now.same;
  by("close").checked = now.close === 1;
  showLoad();
  showMap();
  keepAddress();
}

// Address and files ----------------------------------------------------------------------------

// Browsers refuse a hundred changes in half a minute: the address waits until the point rests.
let waitingAddress;
function keepAddress() {
  clearTimeout(waitingAddress);
  waitingAddress = setTimeout(writeAddress, 400);
}

function writeAddress() {
  const { map, plane, close, same, x, y } = now, load = data.loads[now.load].value;
  const kept = { map, load, plane, close, same: Number(same), x: x.toPrecision(6), y: y.toPrecision(6) };
  const hash = Object.entries(kept).map(([name, value]) => `${name}=${encodeURIComponent(value)}`).join("&");
  history.replaceState(null, "", `#${hash}`);
}

function readAddress() {
  const given = new URLSearchParams(location.hash.slice(1));
  const number = (name) => (given.has(name) && Number.isFinite(Number(given.get(name))) ? Number(given.get(name)) : undefined);
  Object.assign(now, initial);
  if (views[0].some((one) => one.name === given.get("map"))) now.map = given.get("map");
  if (number("load") !== undefined) now.load = nearest(data.loads.map((one) => one.value), number("load"));
  const within = (name, n) => Math.min(Math.max(Math.round(number(name) ?? now[name]), 0), Math.max(n - 1, 0));
  now.plane = within("plane", data.planes.length);
  now.close = within("close", views.length);
  if (number("same") !== undefined) now.same = number("same") !== 0;
  toTop();
  now.x = number("x") ?? now.x;
  now.y = number("y") ?? now.y;
}

// The point goes to the maximum of the map.
function toTop() {
  [, now.x, now.y] = imageNow().top;
}

function sceneNow() {
  const { value } = data.loads[now.load], { loading, ...rest } = data.scene;
  return toml({ ...rest, loading: { ...loading, [data.axis.name]: value } }).join("\n") + "\n";
}

function sectionsText() {
  const { along } = sectionsNow(), map = mapNow(), heading = `${map.label} [${map.unit}]`;
  const lines = Array.from({ length: Math.max(along[0].length, along[1].length) }, (_, i) =>
    along.map((one) => (one[i] ?? ["", ""]).join()).join());
  return [`x [m],${heading},y [m],${heading}`, ...lines].join("\n") + "\n";
}

function numbersText() {
  const names = data.loads[0].numbers.map((one) => one.name), of = (load, name) => load.numbers.find((one) => one.name === name)?.value ?? "";
  const heading = data.loads[0].numbers.map((one) => `${one.name} [${one.unit}]`);
  const lines = data.loads.map((load) => [load.value, ...names.map((name) => of(load, name))].join());
  return [[`${data.axis.label} [${data.axis.unit}]`, ...heading].join(), ...lines].join("\n") + "\n";
}

// Controls -------------------------------------------------------------------------------------

function makeControls() {
  for (const one of views[0]) by("which").append(made("option", one.kind === "stress" ? `${one.label}, below the surface` : one.label, { value: one.name }));
  by("which").onchange = () => {
    now.map = by("which").value;
    show();
  };
  by("load-box").querySelector("label").textContent = data.axis.label;
  const slide = (name, last) => {
    by(name).max = last;
    by(name).disabled = last === 0;
    by(name).addEventListener("input", () => {
      now[name] = Number(by(name).value);
      later();
    });
  };
  slide("load", data.loads.length - 1);
  if (hasStress) slide("plane", data.planes.length - 1);
  by("same").onchange = () => {
    now.same = by("same").checked;
    show();
  };
  by("close-box").hidden = views.length < 2;
  by("close-size").textContent = quantity(data.views.at(-1).width, "m");
  by("close").onchange = () => {
    now.close = Number(by("close").checked);
    toTop();
    show();
  };
  data.outlines.forEach((one, i) => {
    if (one.name === "holes") return;
    const tick = made("input", undefined, { type: "checkbox", checked: "" }), label = made("label"), swatch = made("i");
    swatch.style.background = edgeColour(one.name, i);
    label.append(tick, swatch, ` ${one.label}`);
    tick.onchange = () => {
      now.edges[tick.checked ? "add" : "delete"](one.name);
      showMap();
    };
    by("edges").append(label);
  });
  by("held").textContent = data.held.join(" ");
}

const later = atNextFrame(() => show());

function makeCharts() {
  const onPoint = (row) => {
    if (data.rows.indexOf(row) === now.load) return;
    now.load = data.rows.indexOf(row);
    later();
  };
  by("curves").hidden = data.rows.length < 2;
  charts = data.rows.length < 2 ? [] : data.charts.map(({ title, unit, series }) => new Chart(by("charts"), {
    unit, title, onPoint,
    series: series.map(({ label, column }, i) => ({
      label, column, band: [column + 1, column + 2], dots: true,
      colour: SERIES[i % SERIES.length][0], dashes: SERIES[i % SERIES.length][1],
    })),
  }));
}

function makeButtons() {
  by("toml").onclick = () => save(`${data.name}.toml`, sceneNow());
  by("toml").disabled = data.scene === null;
  by("reason").textContent = data.reason && `No scene as TOML: ${data.reason}`;
  by("csv").onclick = () => save(`${data.name}-sections.csv`, sectionsText());
  by("loads-csv").onclick = () => save(`${data.name}-loads.csv`, numbersText());
  by("png").onclick = () => view.picture((blob) => save(`${data.name}-${now.map}.png`, blob));
  by("link").onclick = () => {
    writeAddress();
    navigator.clipboard?.writeText(location.href);
  };
  by("reset").onclick = () => {
    Object.assign(now, initial);
    toTop();
    show();
  };
}

function onKey(event) {
  const step = event.shiftKey ? 10 : 1, { xs, ys } = axesNow(), at = sectionsNow();
  const move = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] }[event.key];
  if (!move && event.key !== "Home") return;
  event.preventDefault();
  if (move) {
    now.x = xs[Math.min(Math.max(at.column + move[0], 0), xs.length - 1)];
    now.y = ys[Math.min(Math.max(at.row + move[1], 0), ys.length - 1)];
  } else toTop();
  showPoint();
  keepAddress();
}

async function main() {
  if (!globalThis.DecompressionStream) throw new Error("this browser has no DecompressionStream: take one of 2023 or later");
  bytes = Object.fromEntries(await Promise.all(["maps", "planes"].map(async (name) =>
    [name, new Uint8Array(await unpacked(by(name).textContent.trim()))])));
  Object.assign(initial, { map: views[0][0].name, load: data.own, plane: 0, close: 0, same: true });
  view = new MapView(by("view"), { onPoint: (column, line) => {
    const { xs, ys } = axesNow();
    [now.x, now.y] = [xs[column], ys[line]];
    showPoint();
    keepAddress();
  } });
  view.svg.addEventListener("keydown", onKey);
  showEffects();
  by("sources").append(...data.sources.map((text) => made("li", text)));
  makeControls();
  makeCharts();
  makeButtons();
  readAddress();
  show();
  addEventListener("resize", show);
  addEventListener("hashchange", () => {
    readAddress();
    show();
  });
  document.body.dataset.ready = "yes";
}

main().catch(failed);
