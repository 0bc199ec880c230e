// Tables about the chosen robot, the list of events, the legend, the marks under the time line.

const MOST_LISTED = 300; // events in the list; all of them have marks and can be chosen by kind

export function clock(seconds, tenths = false) {
  const whole = Math.floor(seconds + 1e-9), hours = Math.floor(whole / 3600);
  const two = (n) => String(n).padStart(2, "0");
  const text = hours
    ? `${hours}:${two(Math.floor(whole / 60) % 60)}:${two(whole % 60)}`
    : `${Math.floor(whole / 60)}:${two(whole % 60)}`;
  return tenths ? `${text}.${Math.floor((seconds - whole) * 10 + 1e-6)}` : text;
}

export function element(name, properties = {}, ...children) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}

function table({ columns, rows }) {
  const head = element("tr", {}, ...columns.map((text) => element("th", { scope: "col", textContent: text })));
  const body = rows.map((row) => element("tr", {}, ...row.map((text, k) =>
    k ? element("td", { textContent: text }) : element("th", { scope: "row", textContent: text }))));
  return element("div", { className: "wide" },
    element("table", {}, element("thead", {}, head), element("tbody", {}, ...body)));
}

const OPEN = new Set(["Memory", "Messages heard", "Messages sent"]);

// Sections stay open or closed, and scrolled, while their content changes.
export function showInspection(place, { sections }) {
  const known = new Map([...place.querySelectorAll("details")].map((d) => [d.dataset.title, d]));
  const scrolled = place.scrollTop;
  const made = sections.map((section, k) => {
    const before = known.get(section.title);
    const size = section.rows.length ? "" : "none";
    const details = element("details", { open: before ? before.open : !k || OPEN.has(section.title) },
      element("summary", {}, section.title, " ", element("small", { textContent: size })));
    details.dataset.title = section.title;
    if (section.rows.length) details.append(table(section));
    return details;
  });
  place.replaceChildren(...made);
  place.scrollTop = scrolled;
}

export function showEvents(list, events, cycleTime, cycle, kind, go) {
  const chosen = [];
  for (let k = events.length - 1; k >= 0 && chosen.length < MOST_LISTED; k--) {
    if (events[k][0] <= cycle && (!kind || events[k][1] === kind)) chosen.push(events[k]);
  }
  list.replaceChildren(...chosen.map(([at, what, , text]) => {
    const button = element("button", { type: "button" },
      element("time", { textContent: clock(at * cycleTime) }),
      element("span", { textContent: text, className: what === "you" ? "hand" : "" }));
    button.onclick = () => go(at);
    return element("li", {}, button);
  }));
}

export function showLegend(place, { roles, load }, styles, { role, carried }, colours) {
  const counts = roles.map(() => 0), loaded = carried.reduce((sum, number) => sum + (number > 0), 0);
  for (const r of role) counts[r]++;
  const text = [counts, loaded].join();
  if (place.dataset.counts === text) return;
  place.dataset.counts = text;
  place.replaceChildren(...roles.map((name, k) => {
    const dot = element("i", { textContent: styles[k].letter || "1" });
    dot.style.background = styles[k].fill;
    dot.style.color = styles[k].ink;
    return element("div", {}, dot, element("b", { textContent: counts[k] }), element("span", { textContent: name }));
  }));
  if (!load) return;
  const box = element("i", { className: "box" });
  box.style.background = colours[load];
  place.append(element("div", {}, box, element("b", { textContent: loaded }), element("span", { textContent: `with ${load}` })));
}

export function showMarks(canvas, events, last, frontier, colours) {
  const ratio = window.devicePixelRatio || 1, width = (canvas.width = canvas.clientWidth * ratio);
  const height = (canvas.height = canvas.clientHeight * ratio), context = canvas.getContext("2d");
  const inset = 8 * ratio, span = (width - 2 * inset) / Math.max(last, 1);
  context.fillStyle = colours.line;
  context.fillRect(inset, height / 2, width - 2 * inset, ratio);
  context.fillStyle = colours.pale;
  context.fillRect(inset, height / 2 - ratio, frontier * span, 3 * ratio);
  for (const [cycle, kind] of events) {
    if (kind !== "you" && kind !== "chain" && kind !== "sequence" && kind !== "died") continue;
    context.fillStyle = kind === "you" || kind === "died" ? colours.mark : colours.accent;
    context.fillRect(inset + cycle * span - ratio, 0, 2 * ratio, height);
  }
}
