// What every live page has: its data, elements, rows of its tables, files, scenes as TOML.

const data = JSON.parse(document.getElementById("data").textContent);
const by = (id) => document.getElementById(id);

function made(tag, text, attributes = {}) {
  const found = document.createElement(tag);
  if (text !== undefined) found.textContent = text;
  for (const key in attributes) found.setAttribute(key, attributes[key]);
  return found;
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

// Numbers of validity, and in the verdict those out of range; `missing` are names with reasons.
function showValidity(numbers, missing) {
  const outside = numbers.filter((one) => !(one.value >= (one.low ?? -Infinity) && one.value <= (one.high ?? Infinity)));
  by("verdict").textContent = outside.length
    ? `validity: out of range: ${outside.map((one) => one.name).join(", ")}`
    : `validity: ${["nothing is left to evaluate", "the number evaluated here is within its range"][numbers.length] ??
      `all ${numbers.length} numbers evaluated here are within their range`}`;
  by("verdict").className = outside.length ? "bad" : "";
  by("validity").replaceChildren(
    ...numbers.map((one) => {
      const bad = outside.includes(one) ? { class: "number bad" } : {};
      return row(one.name, `${bounds(one)}; ${one.detail}`, (bad.class ? "\u2717 " : "\u2713 ") + written(one.value, 3), { "data-value": one.value, "data-number": one.name, ...bad });
    }),
    ...Object.entries(missing).map(([name, why]) => row(name, `not evaluated: ${why}`, "-", {})));
}

function showEffects() {
  for (const id of ["on", "off"]) by(id).replaceChildren(...data[id].map((text) => made("li", text)));
}

// What calls `act` at the next frame of the screen, once however often it is asked before.
function atNextFrame(act) {
  let waiting = false;
  return () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      act();
    });
  };
}

// A box to tick, with its label, before the other things to look at.
function tickBox(id, text, changed) {
  const box = made("label", ` ${text}`), tick = made("input", undefined, { type: "checkbox", id });
  box.prepend(tick);
  by("look").prepend(box);
  tick.onchange = () => changed(tick.checked);
}

function failed(error) {
  by("status").textContent = error.message;
  by("status").className = "bad";
}

function save(name, content) {
  const link = made("a", undefined, { download: name, href: URL.createObjectURL(new Blob([content])) });
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

async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}
