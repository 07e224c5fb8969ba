// Numbers that the kernel is given, or that are read off tables: each as a function of contactkit of
// the same name in Python, which states the error of the tables.

// family.py: numbers of the kernel, and of validity, at values of the geometry ------------------

function placeOf(slider, value) {
  if (slider.scale === "kelvin") return Math.log(-Math.log(value));
  return slider.scale === "log" ? Math.log(value) : value;
}

function lagrange(nodes, place) {
  return nodes.map((a, i) =>
    nodes.reduce((product, b, j) => (j === i ? product : (product * (place - b)) / (a - b)), 1));
}

function products(weights) {
  return weights.reduce((found, one) => found.flatMap((a) => one.map((b) => a * b)), [1]);
}

function numbersAt(family, sliders, values) {
  const weights = sliders.map((s, i) => lagrange(family.nodes[i], placeOf(s, values[i])));
  const isAngle = (s) => s.scale === "angle";
  const powers = products(weights.filter((_, i) => !isAngle(sliders[i])));
  const angles = products(weights.filter((_, i) => isAngle(sliders[i])));
  const found = family.base.slice(), count = family.columns.length;
  for (let column = 0; column < count; column++) {
    const of = family.base[family.columns[column]], isLog = family.logs[column];
    let sum = 0;
    for (let k = 0; k < angles.length; k++) {
      let change = 0;
      for (let i = 0; i < powers.length; i++)
        change += powers[i] * family.changes[(i * angles.length + k) * count + column];
      sum += angles[k] * (isLog ? of * Math.exp(change) : of + change);
    }
    found[family.columns[column]] = sum;
  }
  return found;
}

// liquid.py: a property at a temperature -------------------------------------------------------

function propertyAt(liquid, name, temperature) {
  const values = liquid.logs[name];
  const place = ((temperature - liquid.low) / (liquid.high - liquid.low)) * (values.length - 1);
  const first = Math.min(Math.max(Math.trunc(place) - 1, 0), values.length - 4);
  const t = place - first, [a, b, c, d] = values.slice(first, first + 4);
  return Math.exp(
    (-a * (t - 1) * (t - 2) * (t - 3)) / 6 + (b * t * (t - 2) * (t - 3)) / 2 -
    (c * t * (t - 1) * (t - 3)) / 2 + (d * t * (t - 1) * (t - 2)) / 6);
}

// validity.py: the worst of a number along gaps and speeds -------------------------------------

function between(logs, at, count, gap) {
  const x = Math.log(gap);
  let i = 0;
  while (i < count - 2 && (x > logs[i + 1] || logs[i + 1] <= logs[i])) i++;
  const t = (x - logs[i]) / (logs[i + 1] - logs[i]);
  return Math.exp(logs[at + i] + t * (logs[at + i + 1] - logs[at + i]));
}

// `liquid` has each property over that of the scene as it was, `strength` likewise.
function worstOf(rules, logs, count, index, path, liquid, strength) {
  const rule = rules[index], bounded = (one) => (one.is_bounded ? 1 : 0);
  const at = count * (1 + rules.slice(0, index).reduce((sum, one) => sum + 1 + bounded(one), 0));
  const largest = rule.worst === "largest";
  let scale = 1, worst = largest ? 0 : Infinity;
  for (const name in rule.liquid) scale *= (liquid[name] ?? 1) ** rule.liquid[name];
  for (const [gap, speed] of path) {
    if ((rule.opening_only && speed <= 0) || (rule.speed_power < 0 && speed === 0)) continue;
    let value = between(logs, at, count, gap) * scale * Math.abs(speed) ** rule.speed_power;
    if (rule.is_bounded) value = Math.min(value, strength * between(logs, at + count, count, gap));
    worst = largest ? Math.max(worst, value) : Math.min(worst, value);
  }
  return worst;
}
