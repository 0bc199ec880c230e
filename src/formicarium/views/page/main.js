// Joins the source of frames, the arena and the panels. The other modules know nothing of each other.

import { Arena } from "./arena.js";
import { openFilm } from "./film.js";
import { connect } from "./live.js";
import { clock, element, showEvents, showInspection, showLegend, showMarks } from "./panels.js";

const LISTING = 300; // ms between two listings of the events while the trial runs

const find = (id) => document.getElementById(id);
const arena = new Arena(find("arena"));
const now = { events: [], hands: [], status: {}, frame: null, before: null, arrived: 0, listed: 0, interval: 100, selected: 0 };
let hello = null;
let scrubbing = false;
let listed = "";

const told = {
  hello(content) {
    hello = content;
    arena.hello(content);
    document.title = content.title;
    find("choose").append(...content.identity.map((id) => element("option", { value: id, textContent: id })));
    find("kinds").append(...content.kinds.map((kind) => element("option", { value: kind, textContent: kind.replaceAll("_", " ") })));
    if (content.touchable) {
      find("devices").hidden = !content.blockable || arena.devices.length === 0;
      find("booths").replaceChildren(...arena.devices.map(([, name], k) => {
        if (name === "object") return element("span", { hidden: true });
        const square = element("i");
        square.style.background = content.colours[name] || name;
        const numbered = arena.names[k] !== name; // 14 booths have no room for whole words
        const text = numbered ? name[0].toUpperCase() + arena.names[k].split(" ")[1] : name;
        const button = element("button", { type: "button", ariaLabel: `Block booth ${arena.names[k]}` }, square, text);
        button.onclick = () => ask({ do: arena.blocked.has(k) ? "unblock" : "block", subject: k });
        return button;
      }));
      showBlocked();
    }
    document.querySelector("[data-layer=packets]").hidden = !content.radio;
    document.querySelector("[data-layer=chain]").hidden = !content.styles.some((style) => style.chained);
    if (!content.touchable) {
      find("inside").firstElementChild.textContent = "Recorded frames hold places, headings and roles, not what is in a robot.";
    }
    if (content.identity.length > 80) setLayer("trails", false);
  },
  frame(frame) {
    const time = performance.now();
    if (frame.jump || !now.frame || frame.cycle < now.frame.cycle) {
      now.before = null;
      if (frame.jump || (now.frame && frame.cycle < now.frame.cycle)) arena.forget();
    } else {
      now.before = blended(time);
      if (frame.cycle > now.frame.cycle) now.interval = 0.7 * now.interval + 0.3 * Math.min(time - now.arrived, 1200);
    }
    if (!now.frame || frame.cycle !== now.frame.cycle || frame.jump) now.arrived = time;
    now.frame = frame;
    if (frame.joined.some((other) => other >= 0)) document.querySelector("[data-layer=chain]").hidden = false;
    find("time").value = clock(frame.cycle * hello.scene.cycle_time, true);
    if (!scrubbing) find("scrub").value = frame.cycle;
    arena.stale = true;
  },
  status(status) {
    const before = now.status;
    now.status = status;
    const last = status.ended ? status.frontier : hello.last_cycle;
    find("scrub").max = last;
    find("scrub").setAttribute("aria-valuetext", clock(status.cycle * hello.scene.cycle_time));
    const play = find("play");
    play.textContent = status.playing && !status.finished ? "❚❚" : "▶";
    play.setAttribute("aria-label", status.playing && !status.finished ? "Pause" : "Play");
    if (document.activeElement !== find("speed")) chooseSpeed(status.speed);
    const doing = status.finished ? "finished" : status.seeking ? "seeking" : status.playing ? "running" : "paused";
    const share = hello.last_cycle ? `${Math.floor((100 * status.cycle) / hello.last_cycle)} % of at most ${clock(hello.last_cycle * hello.scene.cycle_time)}` : "";
    say(find("state"), [doing, share, status.note].filter(Boolean).join(" · "));
    now.hands = status.interventions.map(([cycle, deed, subject]) => [cycle, "you", subject, `you ${deed} ${nameOf(deed, subject)}`]);
    if (JSON.stringify(before.interventions) !== JSON.stringify(status.interventions)) arena.stale = true;
    showBlocked();
    if (!status.playing || performance.now() - now.listed > LISTING) list();
  },
  events({ again, rows }) {
    if (again) [now.events, now.size] = [[], ""];
    now.events.push(...rows);
    list();
  },
  inspection(content) {
    if (content.identity !== now.selected) return;
    find("summary").value = content.summary;
    showInspection(find("inside"), content);
    now.inspection = content;
  },
  notice({ text }) {
    const place = find("notice");
    place.textContent = text;
    place.hidden = false;
    clearTimeout(told.timer);
    told.timer = setTimeout(() => (place.hidden = true), 6000);
  },
  lost() {
    find("state").textContent = "the connection is closed: the command has ended";
    find("play").disabled = true;
  },
};

function say(place, text) {
  if (place.textContent !== text) place.textContent = text;
}

function nameOf(deed, subject) {
  return deed.endsWith("block") ? `booth ${arena.names[subject]}` : `robot ${subject}`;
}

function ask(wish) {
  source.ask(wish);
}

// What is drawn: between the frame before and the latest, as time passes.
function blended(time) {
  const { frame, before } = now;
  if (!before) return frame;
  const t = Math.min(Math.max((time - now.arrived) / Math.max(now.interval, 8), 0), 1); // a frame may come after ``time``
  if (t >= 1) return frame;
  const mix = (a, b) => b.map((value, i) => a[i] + t * (value - a[i]));
  return { x: mix(before.x, frame.x), y: mix(before.y, frame.y), heading: mix(before.heading, frame.heading) };
}

function draw(time) {
  requestAnimationFrame(draw);
  if (!now.frame || !hello) return;
  const moving = now.before && time - now.arrived < now.interval + 50;
  if (!moving && !arena.stale && !arena.layers.packets) return;
  arena.stale = moving;
  const shown = blended(time);
  arena.draw(shown, now.frame, time / 1000);
  showLegend(find("legend"), hello.scene, hello.styles, now.frame, hello.colours);
}

function list() {
  now.listed = performance.now();
  const kind = find("kinds").value, cycle = now.status.cycle ?? 0;
  const size = `${now.events.length}/${now.hands.length}/${now.status.turns}`;
  if (now.size !== size) {
    now.size = size;
    now.all = [...now.events, ...now.hands].sort((a, b) => a[0] - b[0]);
  }
  const all = now.all, shown = before(all, cycle);
  const key = [kind, shown, all.length, now.status.frontier === cycle ? Math.floor(cycle / 50) : cycle, find("scrub").max].join();
  if (key === listed) return;
  listed = key;
  if (!find("events").matches(":hover, :focus-within") || !now.status.playing) {
    showEvents(find("events"), all, hello.scene.cycle_time, cycle, kind, (at) => ask({ do: "seek", cycle: at }));
  }
  const colours = Object.fromEntries(["line", "pale", "mark", "accent"].map((name) => [name, arena.get(`--${name}`)]));
  showMarks(find("marks"), all, Number(find("scrub").max), now.status.frontier ?? 0, colours);
}

// How many of the sorted events are no later than a cycle.
function before(all, cycle) {
  let [low, high] = [0, all.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (all[middle][0] <= cycle) low = middle + 1;
    else high = middle;
  }
  return low;
}

function showBlocked() {
  const blocked = new Set();
  for (const [cycle, deed, subject] of now.status.interventions ?? []) {
    if (cycle > now.status.cycle) continue;
    if (deed === "block") blocked.add(subject);
    if (deed === "unblock") blocked.delete(subject);
  }
  arena.blocked = blocked;
  [...find("booths").children].forEach((button, k) => {
    button.setAttribute("aria-pressed", blocked.has(k));
  });
}

function select(column) {
  arena.selected = column;
  arena.stale = true;
  now.selected = column >= 0 ? hello.identity[column] : 0;
  find("choose").value = now.selected;
  find("touch").hidden = column < 0 || !hello.touchable;
  find("summary").value = "";
  if (column < 0) find("inside").replaceChildren(element("p", { className: "hint", textContent: "Click a robot to look into it." }));
  else if (now.frame) [find("x").value, find("y").value] = [now.frame.x[column].toFixed(2), now.frame.y[column].toFixed(2)];
  ask({ do: "select", robot: now.selected });
}

function setLayer(name, on) {
  arena.layers[name] = on;
  arena.stale = true;
  document.querySelector(`[data-layer=${name}]`).setAttribute("aria-pressed", on);
  if (name === "packets") ask({ do: "packets", on });
}

function chooseSpeed(times) {
  const options = [...find("speed").options];
  if (!options.some((option) => Number(option.value) === times)) {
    find("speed").append(element("option", { value: times, textContent: `${times}×` }));
  }
  find("speed").value = String(times);
}

function faster(by) {
  const options = [...find("speed").options].map((option) => Number(option.value));
  const place = options.indexOf(now.status.speed) + by;
  if (place >= 0 && place < options.length) ask({ do: "speed", times: options[place] });
}

function setTheme(theme) {
  document.documentElement.dataset.theme = theme;
  arena.resize();
  listed = "";
}

function middleOfChosen() {
  const { selected, shown, middle } = arena;
  return selected >= 0 && shown ? [shown.x[selected], shown.y[selected]] : middle;
}

const deeds = {
  play: () => ask({ do: now.status.playing && !now.status.finished ? "pause" : "play" }),
  step: (cycles = 1) => ask(cycles === 1 ? { do: "step", cycles } : { do: "seek", cycle: now.frame.cycle + cycles }),
  back: (cycles = 1) => {
    ask({ do: "pause" });
    ask({ do: "seek", cycle: Math.max(0, now.frame.cycle - cycles) });
  },
};

find("play").onclick = deeds.play;
find("step").onclick = () => deeds.step();
find("back").onclick = () => deeds.back();
find("speed").onchange = ({ target }) => { ask({ do: "speed", times: Number(target.value) }); target.blur(); };
find("scrub").oninput = ({ target }) => { scrubbing = true; ask({ do: "seek", cycle: Number(target.value) }); };
find("scrub").onchange = () => (scrubbing = false);
find("choose").onchange = ({ target }) => select(hello.identity.indexOf(Number(target.value)));
find("kinds").onchange = () => { listed = ""; list(); };
find("kill").onclick = () => ask({ do: "kill", subject: now.selected });
find("move").onsubmit = (event) => {
  event.preventDefault();
  ask({ do: "move", subject: now.selected, x: Number(find("x").value), y: Number(find("y").value) });
};
find("theme").onclick = () => setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark");
find("help").onclick = () => find("keys").showModal();
find("layers").onclick = ({ target }) => {
  const name = target.dataset.layer;
  if (name) setLayer(name, !arena.layers[name]);
};

const canvas = find("arena");
let pressed = null;
canvas.onpointerdown = (event) => {
  const place = arena.metres(event), column = arena.robotAt(place, event.pointerType === "touch" ? 2.5 : 1.5);
  pressed = { column, x: event.clientX, y: event.clientY };
  if (column >= 0) canvas.setPointerCapture(event.pointerId);
};
canvas.onpointermove = (event) => {
  if (!pressed) {
    canvas.style.cursor = arena.robotAt(arena.metres(event)) >= 0 ? "pointer" : "";
    return;
  }
  if (pressed.column < 0) {
    arena.shift(event.movementX, event.movementY);
    return;
  }
  if (!hello.touchable || Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) < 6) return;
  const [x, y] = arena.metres(event);
  arena.held = { column: pressed.column, x, y };
  arena.stale = true;
};
canvas.onpointerup = () => {
  if (arena.held) ask({ do: "move", subject: hello.identity[arena.held.column], x: arena.held.x, y: arena.held.y });
  else if (pressed && (pressed.column >= 0 || arena.zoom === 1)) select(pressed.column);
  arena.held = pressed = null;
  arena.stale = true;
};
canvas.addEventListener("touchstart", (event) => { // or the page would be scrolled instead of the robot dragged
  if (arena.robotAt(arena.metres(event.touches[0]), 2.5) >= 0) event.preventDefault();
}, { passive: false });
canvas.onwheel = (event) => {
  event.preventDefault();
  arena.magnify(Math.exp(-event.deltaY / 400), arena.metres(event));
};
canvas.ondblclick = () => arena.magnify(0, [0, 0]);
canvas.onpointercancel = () => { arena.held = pressed = null; };

document.onkeydown = (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || !hello || find("keys").open) return;
  const typing = event.target.matches("input[type=number], select");
  const sliding = event.target.matches("input[type=range]");
  const pressing = event.target.matches("button");
  const second = Math.round(10 / hello.scene.cycle_time);
  const step = (by) => {
    const column = arena.selected + by, count = hello.identity.length;
    select(((column % count) + count) % count);
  };
  const keys = {
    " ": pressing ? null : deeds.play,
    ArrowRight: sliding ? null : () => deeds.step(event.shiftKey ? second : 1),
    ArrowLeft: sliding ? null : () => deeds.back(event.shiftKey ? second : 1),
    Home: sliding ? null : () => ask({ do: "seek", cycle: 0 }),
    End: sliding ? null : () => ask({ do: "seek", cycle: now.status.frontier }),
    "+": () => faster(1),
    "=": () => faster(1),
    "-": () => faster(-1),
    "]": () => step(1),
    "[": () => step(-1),
    k: () => now.selected && hello.touchable && ask({ do: "kill", subject: now.selected }),
    t: () => setLayer("trails", !arena.layers.trails),
    c: () => setLayer("chain", !arena.layers.chain),
    m: () => setLayer("packets", !arena.layers.packets),
    r: () => setLayer("ranges", !arena.layers.ranges),
    n: () => setLayer("names", !arena.layers.names),
    d: () => find("theme").click(),
    z: () => arena.magnify(1.5, middleOfChosen()),
    Z: () => arena.magnify(1 / 1.5, middleOfChosen()),
    Escape: () => select(-1),
    "?": () => find("keys").showModal(),
  };
  const deed = typing ? null : keys[event.key];
  if (deed) {
    event.preventDefault();
    deed();
  }
};

const dark = matchMedia("(prefers-color-scheme: dark)");
document.documentElement.dataset.theme = dark.matches ? "dark" : "light";
dark.addEventListener("change", () => setTheme(dark.matches ? "dark" : "light"));
window.addEventListener("resize", () => { listed = ""; list(); });
const source = (document.getElementById("film") ? openFilm : connect)(told);
window.watching = { arena, now, ask, get hello() { return hello; } };
requestAnimationFrame(draw);
