// From the values of sliders to what the kernel of a film takes, and the validity of a motion.

let kernel;

async function kernelReady() {
  data.numbers = new Float64Array(await unpacked(data.numbers));
  if (data.family) {
    data.family.base = new Float64Array(await unpacked(data.family.base));
    data.family.changes = new Float32Array(await unpacked(data.family.changes));
  }
  kernel = await Kernel.from(by("kernel").textContent.trim());
}

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
  return liquidAt(values.temperature);
}

function liquidAt(temperature) {
  const found = {};
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

// Numbers of validity along rows of a motion.
function validityOf(path, logs, liquid, strength) {
  const spanned = path.filter((row) => row[column("state")] !== data.broken && row[column("gap")] > 0)
    .map((row) => [row[column("gap")], row[column("speed")]]);
  return data.rules.map((rule, i) => ({ ...rule,
    value: worstOf(data.rules, logs, data.points, i, spanned, liquid, strength) }));
}
