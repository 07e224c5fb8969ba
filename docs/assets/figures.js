// Figures that open large, and live pages as tall as what they show.

// A figure fills the screen; from there a click, a tap or Enter shows it at its own size, which
// scrolls. Arrows: the next one of the page. Escape, or a click beside it: closed.
function enlarge(figures) {
  const box = document.createElement("dialog");
  box.className = "large";
  box.innerHTML =
    '<button class="close" aria-label="Close">\u00d7</button>' +
    '<div class="pane" tabindex="0"><img></div><p class="words"></p>';
  document.body.append(box);
  const [pane, image, words] = [".pane", "img", ".words"].map((name) => box.querySelector(name));
  let now = 0;

  function show(at) {
    now = (at + figures.length) % figures.length;
    const small = figures[now].querySelector("img");
    image.src = figures[now].href;
    image.alt = words.textContent = small.alt;
    // On a phone a whole figure is too small to read: its own size at once.
    box.classList.toggle("own", small.naturalWidth > 2 * innerWidth || small.width > 2 * innerWidth);
    pane.scrollTo(0, 0);
    if (!box.open) box.showModal();
    pane.focus();
  }

  // Own size, around the point of the picture that was touched.
  function zoom(event) {
    const before = image.getBoundingClientRect();
    const x = event ? (event.clientX - before.left) / before.width : 0.5;
    const y = event ? (event.clientY - before.top) / before.height : 0.5;
    box.classList.toggle("own");
    const after = image.getBoundingClientRect();
    pane.scrollTo(x * after.width - pane.clientWidth / 2, y * after.height - pane.clientHeight / 2);
  }

  figures.forEach((figure, at) =>
    figure.addEventListener("click", (event) => {
      if (event.ctrlKey || event.metaKey || event.shiftKey) return;
      event.preventDefault();
      show(at);
    })
  );
  box.addEventListener("click", (event) => (event.target === image ? zoom(event) : box.close()));
  box.addEventListener("close", () => figures[now].focus());
  box.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    const scrolls = box.classList.contains("own") && pane.scrollWidth > pane.clientWidth;
    if (step && !scrolls) show(now + step);
    else if (event.key === "Enter" && event.target === pane) zoom();
    else return;
    event.preventDefault();
  });
}

// A live page says how tall it is, and what its sliders are at: its own page opens with the same.
function fit(frames) {
  addEventListener("message", ({ source, data }) => {
    const frame = frames.find((one) => one.contentWindow === source);
    if (!frame || !(data?.height > 0)) return;
    frame.style.height = `${Math.ceil(data.height) + 2}px`;
    const alone = frame.parentElement.querySelector(".alone");
    alone.href = alone.href.split("#")[0] + String(data.hash);
  });
}

// On a phone a table of sentences becomes a card for each row; another one that is too wide fades
// out at its edge until it is scrolled there.
function fitTables(boxes) {
  const long = (cell) => cell.textContent.length > 60;
  const mark = (box) => box.classList.toggle("more", box.scrollLeft + box.clientWidth < box.scrollWidth - 4);
  const fitOne = (box) => {
    const table = box.querySelector("table");
    table.toggleAttribute("data-stacked", false); // no class: the theme styles tables without one
    const isWide = box.scrollWidth > box.clientWidth + 4;
    const isText = [...table.querySelectorAll("td")].some(long);
    table.toggleAttribute("data-stacked", isWide && isText && innerWidth < 720);
    mark(box);
  };
  for (const box of boxes) {
    const names = [...box.querySelectorAll("thead th")].map((cell) => cell.textContent.trim());
    for (const row of box.querySelectorAll("tbody tr"))
      [...row.children].forEach((cell, i) => (cell.dataset.label = names[i] ?? ""));
    fitOne(box);
    box.addEventListener("scroll", () => mark(box), { passive: true });
  }
  addEventListener("resize", () => boxes.forEach(fitOne));
  // What is folded has no width until it opens.
  document.addEventListener("toggle", () => boxes.forEach(fitOne), true);
}

const all = (name) => [...document.querySelectorAll(name)];

document.addEventListener("DOMContentLoaded", () => {
  const figures = all("a.figure");
  if (figures.length) enlarge(figures);
  fit(all(".live iframe"));
});

// The theme has put the tables into boxes by then.
addEventListener("load", () => fitTables(all(".md-typeset__scrollwrap").filter((box) => box.querySelector("table"))));
