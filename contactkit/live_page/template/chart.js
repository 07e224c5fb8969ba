// Curves over a common axis, with the values under the pointer. Lines differ in colour and in dashes
// (Okabe and Ito's colours, which people who see fewer colours can tell apart).

const PREFIXES = [[1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "\u00b5"], [1e-9, "n"], [1e-12, "p"]];
const SVG = "http://www.w3.org/2000/svg";

// Factor and name of the unit in which a size reads best.
function readable(size, unit) {
  if (unit === "-") return [1, ""];
  if (!(size > 0) || unit === "" || unit === "m/s") return [1, unit];
  const power = Number(/^m([23])$/.exec(unit)?.[1] ?? 1); // an area from 0.1 of its unit on
  const found = PREFIXES.find(([factor]) => size >= 0.9999 * factor ** power * 0.1 ** (power - 1)) ?? PREFIXES.at(-1);
  return [found[0] ** power, found[1] + unit.replace("2", "\u00b2").replace("3", "\u00b3")];
}

function written(value, digits = 4) {
  if (!Number.isFinite(value)) return "-";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3) {
    const [mantissa, power] = value.toExponential(digits - 1).split("e");
    const raised = [...String(Number(power))].map((c) => "\u207b\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"["-0123456789".indexOf(c)]);
    return `${Number(mantissa)}\u00d710${raised.join("")}`;
  }
  return String(Number(value.toPrecision(digits)));
}

function quantity(value, unit, digits = 4) {
  if (!Number.isFinite(value)) return "none";
  const [factor, name] = readable(Math.abs(value), unit);
  return `${written(value / factor, digits)} ${name}`.trim();
}

function ticksOf(low, high, isLog, most) {
  if (isLog) {
    const first = Math.ceil(Math.log10(low) - 1e-9), last = Math.floor(Math.log10(high) + 1e-9);
    const step = Math.max(1, Math.ceil((last - first + 1) / most)), found = [];
    for (let power = first; power <= last; power += step) found.push(10 ** power);
    if (found.length > 2) return found;
    const between = [1, 2, 5].flatMap((n) => [first - 1, first, last].map((power) => n * 10 ** power));
    return [...new Set(between)].filter((value) => value >= low && value <= high).sort((a, b) => a - b);
  }
  const rough = (high - low) / most || 1, unit = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].find((n) => n * unit >= rough) * unit, found = [];
  for (let value = Math.ceil(low / step - 1e-9) * step; value <= high + 1e-9 * step; value += step)
    found.push(Math.abs(value) < 1e-9 * step ? 0 : value);
  return found;
}

function node(name, attributes, parent, text) {
  const made = document.createElementNS(SVG, name);
  for (const key in attributes) made.setAttribute(key, attributes[key]);
  if (text !== undefined) made.textContent = text;
  parent?.append(made);
  return made;
}

// Lines from point to point, with gaps where there is no value.
function pathOf(rows, x, y) {
  let path = "", isOn = false;
  for (const row of rows) {
    const height = y(row);
    if (Number.isFinite(height)) path += `${isOn ? "L" : "M"}${x(row).toFixed(1)} ${height.toFixed(1)}`;
    isOn = Number.isFinite(height);
  }
  return path;
}

function cross(x, y, colour, parent) {
  node("path", { d: `M${x - 3} ${y - 3}l6 6m0 -6l-6 6`, stroke: colour, "stroke-width": 1.6, fill: "none" }, parent);
}

// One chart: `series` of {label, column, colour, dashes} of one unit over a column of the rows. A clipped
// series does not widen the axis; `none` says what no value means, which is marked at the top. A series
// may have a `band`, the columns of its bounds, and `dots` at its rows. `range` of values is shown at
// least, and `ratio` is height over width.
class Chart {
  constructor(parent, { unit, title, series, range = [0, 0], ratio = 0.72, onPoint }) {
    Object.assign(this, { unit, title, series, range, ratio });
    this.box = document.createElement("figure");
    this.box.className = "chart";
    this.svg = node("svg", { role: "img", "aria-label": title }, this.box);
    this.keys = document.createElement("div");
    this.keys.className = "keys";
    this.box.append(this.keys);
    parent.append(this.box);
    this.values = series.map((one) => {
      const key = document.createElement("span"), swatch = node("svg", { viewBox: "0 0 26 10" });
      node("line", { x1: 0, x2: 26, y1: 5, y2: 5, stroke: one.colour, "stroke-width": 2.5, "stroke-dasharray": one.dashes }, swatch);
      const value = document.createElement("b");
      key.append(swatch, ` ${one.label} `, value);
      this.keys.append(key);
      return value;
    });
    const at = (event) => this.shown.length && onPoint(this.rowAt(event.clientX));
    this.shown = [];
    this.svg.addEventListener("pointermove", at);
    this.svg.addEventListener("pointerdown", at);
  }

  // The label of a series, where it changes; without one its key is not shown.
  name(number, label) {
    this.values[number].previousSibling.textContent = ` ${label} `;
    this.values[number].parentNode.hidden = !label;
  }

  // `axis` is {column, unit, label, isLog}, with a `mark` to be drawn on it and a `top` of the values.
  draw(rows, axis) {
    const width = Math.max(this.box.clientWidth, 300), height = Math.round(Math.min(this.ratio * width, 360));
    const left = 58, right = 12, top = 26, bottom = 44;
    Object.assign(this, { rows, axis, width, left, right, top, height, bottom });
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.svg.replaceChildren();
    const shown = rows.filter((row) => !axis.isLog || row[axis.column] > 0);
    this.shown = shown;
    if (shown.length < 2) return;
    const xs = shown.map((row) => row[axis.column]);
    this.low = xs[0], this.high = xs.at(-1);
    let bottomValue = this.range[0], topValue = axis.top ?? this.range[1];
    for (const { column, band = [], clipped } of this.series)
      for (const row of clipped ? [] : shown)
        for (const value of [column, ...band].map((one) => row[one])) {
          if (!Number.isFinite(value)) continue;
          bottomValue = Math.min(bottomValue, value);
          topValue = Math.max(topValue, value);
        }
    if (topValue === bottomValue) topValue = bottomValue + 1;
    const [yFactor, yUnit] = readable(Math.max(topValue, -bottomValue), this.unit);
    const [xFactor, xUnit] = axis.isLog ? [1, axis.unit] : readable(this.high, axis.unit);
    const y = (value) => height - bottom - ((value - bottomValue) / (1.05 * (topValue - bottomValue))) * (height - top - bottom);
    const x = (value) => this.xOf(value);
    const small = { "font-size": 12.5, fill: "#444" };
    for (const tick of ticksOf(bottomValue / yFactor, topValue / yFactor, false, 5)) {
      const at = y(tick * yFactor);
      node("line", { x1: left, x2: width - right, y1: at, y2: at, stroke: tick === 0 ? "#888" : "#e4e4e4" }, this.svg);
      node("text", { x: left - 6, y: at + 4, "text-anchor": "end", ...small }, this.svg, written(tick));
    }
    let free = -Infinity; // where the last label ends: those that would touch it are left out
    for (const tick of ticksOf(this.low / xFactor, this.high / xFactor, axis.isLog, width < 420 ? 4 : 7)) {
      const at = x(tick * xFactor), label = axis.isLog ? quantity(tick, axis.unit, 3) : written(tick), half = 3.6 * label.length;
      node("line", { x1: at, x2: at, y1: height - bottom, y2: height - bottom + 5, stroke: "#888" }, this.svg);
      if (at - half < free + 4) continue;
      free = at + half;
      const edge = at > width - right - 14 ? "end" : "middle"; // whole at the edge of a phone
      node("text", { x: edge === "end" ? width - 2 : at, y: height - bottom + 19, "text-anchor": edge, ...small }, this.svg, label);
    }
    node("text", { x: 4, y: 15, "font-size": 13.5, fill: "#1b1b1b", "font-weight": 600 }, this.svg, `${this.title} [${yUnit}]`);
    node("text", { x: width - right, y: height - 6, "text-anchor": "end", ...small }, this.svg,
      axis.isLog ? `${axis.label}, logarithmic` : `${axis.label} [${xUnit}]`);
    const clip = node("clipPath", { id: `clip-${this.title.replaceAll(/\W/g, "-")}` }, this.svg);
    node("rect", { x: left, y: top - 4, width: width - left - right, height: height - top - bottom + 5 }, clip);
    if (axis.mark > this.low && axis.mark < this.high)
      node("line", { x1: x(axis.mark), x2: x(axis.mark), y1: top, y2: height - bottom, stroke: "#888", "stroke-width": 1.5, "stroke-dasharray": "4 3" }, this.svg);
    const along = (rows, column) => pathOf(rows, (row) => x(row[axis.column]), (row) => y(row[column]));
    for (const { band, colour } of this.series)
      if (band) node("path", { d: `${along(shown, band[0])}${along([...shown].reverse(), band[1]).replace("M", "L")}Z`, fill: colour, "fill-opacity": 0.16 }, this.svg);
    this.series.forEach(({ column, colour, dashes, none, dots }, number) => {
      const path = along(shown, column);
      for (const row of dots ? shown : []) node("circle", { cx: x(row[axis.column]), cy: y(row[column]), r: 3, fill: colour }, this.svg);
      node("path", { d: path, fill: "none", stroke: colour, "stroke-width": 2, "stroke-dasharray": dashes, "stroke-linejoin": "round", "clip-path": `url(#${clip.id})` }, this.svg);
      for (const row of none ? shown : [])
        if (!Number.isFinite(row[column])) cross(x(row[axis.column]), top + 4 + 11 * number, colour, this.svg);
    });
    const marked = this.series.find(({ column, none }) => none && shown.some((row) => !Number.isFinite(row[column])));
    if (marked) node("text", { x: left + 8, y: top + 8, ...small }, this.svg, `\u00d7 ${marked.none}`);
    this.cross = node("line", { y1: top, y2: height - bottom, stroke: "#1b1b1b", "stroke-width": 1, visibility: "hidden" }, this.svg);
  }

  xOf(value) {
    const of = this.axis.isLog ? Math.log : (v) => v;
    const t = (of(value) - of(this.low)) / (of(this.high) - of(this.low));
    return this.left + t * (this.width - this.left - this.right);
  }

  // Row of the curve nearest to a place on the screen.
  rowAt(clientX) {
    const box = this.svg.getBoundingClientRect(), x = ((clientX - box.left) / box.width) * this.width;
    return this.shown.reduce((best, row) =>
      Math.abs(this.xOf(row[this.axis.column]) - x) < Math.abs(this.xOf(best[this.axis.column]) - x) ? row : best);
  }

  point(row) {
    this.values.forEach((value, i) => {
      const { column, none } = this.series[i];
      value.textContent = row ? (none && !Number.isFinite(row[column]) ? none : quantity(row[column], this.unit)) : "";
    });
    if (!this.cross) return;
    this.cross.setAttribute("visibility", row ? "visible" : "hidden");
    if (row) for (const end of ["x1", "x2"]) this.cross.setAttribute(end, this.xOf(row[this.axis.column]));
  }
}
