// Maps over the window of a contact: cells in colours, edges of areas, a cross, a colour bar.

// Viridis at 17 places (van der Walt and Smith), which people who see fewer colours can read; blue over
// white to orange where values have both signs.
const VIRIDIS = "440154 48186a 472d7b 424086 3b528b 33638d 2c728e 26828e 21918c 1fa088 28ae80 3fbc73 5ec962 84d44b addc30 d8e219 fde725";
const SIGNED = "0b3c5d 2c6f9c 6aa5c9 b1d0e3 f7f7f7 f2c9a1 e39a55 c26a1a 7f3b08";
const NOTHING = [240, 240, 236], HOLE = [181, 181, 174];
const EDGES = { contact: "#ffffff", plastic: "#ff7f0e", meniscus: "#56b4e9", stick: "#cc79a7" };

const colours = (text) => text.split(" ").map((hex) => [0, 2, 4].map((i) => parseInt(hex.slice(i, i + 2), 16)));
const SCALES = { viridis: colours(VIRIDIS), signed: colours(SIGNED) };
const css = (colour) => `rgb(${colour.map(Math.round).join()})`;

function colourAt(scale, t) {
  const place = Math.min(Math.max(t, 0), 1) * (scale.length - 1), i = Math.min(Math.floor(place), scale.length - 2);
  return [0, 1, 2].map((k) => scale[i][k] + (place - i) * (scale[i + 1][k] - scale[i][k]));
}

// images.py: levels as differences from the cell before, of a first cell from the one above it.
function levelsAt(bytes, start, size, [ny, nx]) {
  const n = ny * nx, most = 256 ** size, found = new Uint16Array(n);
  for (let row = 0, k = 0; row < ny; row++) {
    let last = row ? found[k - nx] : 0;
    for (let column = 0; column < nx; column++, k++) {
      const change = bytes[start + k] + (size > 1 ? 256 * bytes[start + n + k] : 0);
      found[k] = last = (last + change) % most;
    }
  }
  return found;
}

function valuesOf(bytes, image, shape) {
  const none = 256 ** image.bytes - 1;
  return Float64Array.from(levelsAt(bytes, image.start, image.bytes, shape), (level) =>
    level === none ? NaN : image.low + image.step * level);
}

class MapView {
  constructor(parent, { onPoint }) {
    this.box = made("div", undefined, { class: "map" });
    this.canvas = made("canvas", undefined, { "aria-hidden": "true" });
    this.title = made("p", undefined, { class: "title" });
    this.svg = node("svg", { role: "img", tabindex: 0, "font-family": "system-ui, sans-serif" }, this.box);
    this.box.prepend(this.canvas);
    parent.append(this.title, this.box);
    const at = (event) => {
      const box = this.svg.getBoundingClientRect();
      onPoint(...this.cellAt(event.clientX - box.left, event.clientY - box.top));
    };
    this.svg.addEventListener("pointermove", (event) => (event.pointerType === "mouse" || event.buttons) && at(event));
    this.svg.addEventListener("pointerdown", at);
  }

  // `shown` has values, shape, factor, window of {x, y, width, height}, pixel, title, unit, low, high, hasNothing, flags, outlines
  // of {name, bit}, holes (a bit or 0), top of [value, x, y].
  draw(shown) {
    const { window: { width: side, height: depth }, pixel, shape: [ny, nx], factor } = shown;
    const width = Math.max(this.box.clientWidth, 300), left = 50, right = 66, top = 10, bottom = 42;
    const w = width - left - right, toScale = (w * depth) / side, h = Math.min(Math.max(toScale, 70), 1.4 * w);
    Object.assign(this, { shown, left, top, w, h, cell: [(w * factor * pixel[1]) / side, (h * factor * pixel[0]) / depth] });
    const height = top + h + bottom;
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    Object.assign(this.svg.style, { width: `${width}px`, height: `${height}px` });
    this.svg.setAttribute("aria-label", `map of ${shown.title}; arrow keys move the sections`);
    Object.assign(this.canvas.style, { left: `${left}px`, top: `${top}px`, width: `${w}px`, height: `${h}px` });
    this.paint(w, h, nx, ny);
    this.svg.replaceChildren();
    this.frame(Math.abs(toScale - h) > 1);
    this.title.textContent = `${shown.title} [${this.bar(left + w + 10)}]`;
    const ring = { cx: this.xAt(shown.top[1]), cy: this.yAt(shown.top[2]), r: 7, fill: "none" };
    node("circle", { ...ring, stroke: "#000000", "stroke-width": 3.5 }, this.svg);
    node("circle", { ...ring, stroke: "#ffffff", "stroke-width": 1.5 }, this.svg);
    this.cross = ["#000000", "#ffffff"].map((stroke, i) =>
      node("path", { fill: "none", stroke, "stroke-width": i ? 1 : 2.2, "stroke-opacity": i ? 1 : 0.55 }, this.svg));
  }

  paint(w, h, nx, ny) {
    const { values, low, high, hasNothing, nearZero, flags, holes, outlines } = this.shown;
    const scale = low < 0 && high > 0 ? SCALES.signed : SCALES.viridis, most = Math.max(high, -low);
    const [first, last] = scale === SCALES.signed ? [-most, most] : [low, high];
    Object.assign(this, { scale, first, last });
    const table = Array.from({ length: 256 }, (_, i) => colourAt(scale, i / 255));
    const picture = new ImageData(nx, ny);
    for (let row = 0, k = 0; row < ny; row++)
      for (let column = 0; column < nx; column++, k++) {
        const value = values[k], t = last > first ? (value - first) / (last - first) : 0;
        const isHole = holes & flags[k] || Number.isNaN(value);
        const colour = isHole ? HOLE : hasNothing && Math.abs(value) <= nearZero ? NOTHING : table[Math.min(Math.max(Math.round(255 * t), 0), 255)];
        picture.data.set([...colour, 255], 4 * ((ny - 1 - row) * nx + column));
      }
    const own = made("canvas", undefined, { width: nx, height: ny });
    own.getContext("2d").putImageData(picture, 0, 0);
    const ratio = globalThis.devicePixelRatio || 1, [cw, ch] = this.cell;
    Object.assign(this.canvas, { width: Math.round(w * ratio), height: Math.round(h * ratio) });
    const context = this.canvas.getContext("2d");
    context.scale(ratio, ratio);
    context.imageSmoothingEnabled = false;
    context.drawImage(own, 0, h - ny * ch, nx * cw, ny * ch); // the last cells may reach beyond the window
    const fine = Math.min(1, Math.max(0.4, Math.min(cw, ch) / 3)); // of cells of a pixel or two, thin edges
    // The smallest area on top: where edges coincide, that of the larger one is hidden for a short way.
    const size = ({ bit }) => flags.reduce((sum, one) => sum + (one & bit ? 1 : 0), 0);
    for (const { bit, colour, thin } of outlines.slice().sort((a, b) => size(b) - size(a))) {
      const path = this.edges(flags, bit, nx, ny, h);
      for (const [style, lineWidth] of thin ? [[colour, fine]] : [["#000000a0", 2.2 * fine], [colour, 1.1 * fine]]) {
        Object.assign(context, { strokeStyle: style, lineWidth });
        context.stroke(path);
      }
    }
  }

  // Edges between the cells of an area and others.
  edges(flags, bit, nx, ny, h) {
    const path = new Path2D(), [cw, ch] = this.cell;
    for (let row = 0, k = 0; row < ny; row++)
      for (let column = 0; column < nx; column++, k++) {
        const own = flags[k] & bit, x = (column + 1) * cw, y = h - (row + 1) * ch;
        if (column + 1 < nx && own !== (flags[k + 1] & bit)) {
          path.moveTo(x, y);
          path.lineTo(x, y + ch);
        }
        if (row + 1 < ny && own !== (flags[k + nx] & bit)) {
          path.moveTo(x - cw, y);
          path.lineTo(x, y);
        }
      }
    return path;
  }

  frame(isStretched) {
    const { left, top, w, h, shown: { window: { x, y, width, height } } } = this, small = { "font-size": 12.5, fill: "#444" };
    const [factor, unit] = readable(Math.max(x + width, y + height), "m");
    node("rect", { x: left, y: top, width: w, height: h, fill: "none", stroke: "#888" }, this.svg);
    for (const tick of ticksOf(x / factor, (x + width) / factor, false, 4)) {
      const at = this.xAt(tick * factor);
      node("line", { x1: at, x2: at, y1: top + h, y2: top + h + 5, stroke: "#888" }, this.svg);
      node("text", { x: at, y: top + h + 18, "text-anchor": "middle", ...small }, this.svg, written(tick));
    }
    for (const tick of ticksOf(y / factor, (y + height) / factor, false, h < 150 ? 2 : 4)) {
      const at = this.yAt(tick * factor);
      node("line", { x1: left - 5, x2: left, y1: at, y2: at, stroke: "#888" }, this.svg);
      node("text", { x: left - 8, y: at + 4, "text-anchor": "end", ...small }, this.svg, written(tick));
    }
    node("text", { x: left + w, y: top + h + 36, "text-anchor": "end", ...small }, this.svg, `x [${unit}]${isStretched ? ", not to scale" : ""}`);
    node("text", { transform: `translate(12 ${top + h / 2}) rotate(-90)`, "text-anchor": "middle", ...small }, this.svg, `y [${unit}]`);
  }

  // Draw the colour bar, and return its unit.
  bar(x) {
    const { top, h, first, last } = this, steps = this.scale.length - 1;
    const gradient = node("linearGradient", { id: "colours", x1: 0, x2: 0, y1: 1, y2: 0 }, node("defs", {}, this.svg));
    this.scale.forEach((colour, i) => node("stop", { offset: i / steps, "stop-color": css(colour) }, gradient));
    node("rect", { x, y: top, width: 13, height: h, fill: "url(#colours)", stroke: "#888" }, this.svg);
    const [factor, unit] = readable(Math.max(Math.abs(first), Math.abs(last)), this.shown.unit);
    for (const tick of last > first ? ticksOf(first / factor, last / factor, false, 5) : []) {
      const at = top + h - ((tick * factor - first) / (last - first)) * h;
      node("line", { x1: x + 13, x2: x + 17, y1: at, y2: at, stroke: "#888" }, this.svg);
      node("text", { x: x + 20, y: at + 4, "font-size": 12.5, fill: "#444" }, this.svg, written(tick, 3));
    }
    return unit;
  }

  xAt(x) {
    return this.left + ((x - this.shown.window.x) / this.shown.window.width) * this.w;
  }

  yAt(y) {
    return this.top + this.h - ((y - this.shown.window.y) / this.shown.window.height) * this.h;
  }

  // Column and row of the cell under a place of the picture.
  cellAt(x, y) {
    const [ny, nx] = this.shown.shape, within = (value, n) => Math.min(Math.max(Math.floor(value), 0), n - 1);
    return [within((x - this.left) / this.cell[0], nx), within((this.top + this.h - y) / this.cell[1], ny)];
  }

  point(x, y) {
    const { left, top, w, h } = this, [px, py] = [this.xAt(x), this.yAt(y)];
    for (const line of this.cross) line.setAttribute("d", `M${left} ${py}H${left + w}M${px} ${top}V${top + h}`);
  }

  // The picture with its axes and colour bar, for a file.
  picture(done) {
    const ratio = 2, head = 26, size = this.svg.viewBox.baseVal;
    const page = made("canvas", undefined, { width: ratio * size.width, height: ratio * (size.height + head) });
    const text = new XMLSerializer().serializeToString(this.svg), context = page.getContext("2d"), image = new Image();
    image.onload = () => {
      context.scale(ratio, ratio);
      context.fillStyle = "#ffffff";
      context.fillRect(0, 0, size.width, size.height + head);
      Object.assign(context, { fillStyle: "#1b1b1b", font: "600 13.5px sans-serif" });
      context.fillText(this.title.textContent, 6, 18, size.width - 12);
      context.translate(0, head);
      context.drawImage(this.canvas, this.left, this.top, this.w, this.h);
      context.drawImage(image, 0, 0, size.width, size.height);
      page.toBlob(done, "image/png");
    };
    image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;
  }
}
