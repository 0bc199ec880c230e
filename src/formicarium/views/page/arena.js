// The arena from above on a canvas: what does not move is drawn once, robots are stamps that are made once.

const TRAIL = 150; // cycles that a trail lasts
const GAP = 50; // cycles between two pictures, over which no trail is drawn
const MOST_PLACES = 80; // of one trail
const STAMP_SCALES = [24, 40, 64, 96, 160]; // pixels across a stamped robot

export class Arena {
  constructor(canvas) {
    this.canvas = canvas;
    this.layers = { trails: true, chain: true, packets: false, ranges: false, names: false };
    this.selected = -1; // column
    this.blocked = new Set();
    this.held = null; // robot being dragged: {column, x, y}
    this.zoom = 1;
    this.drawn = 0;
    this.stamps = new Map();
    this.still = document.createElement("canvas");
    new ResizeObserver(() => this.resize()).observe(canvas);
  }

  hello({ scene, styles, colours, identity }) {
    Object.assign(this, { scene, styles, colours, identity });
    const points = scene.polygons.flatMap(([outline]) => outline);
    const [xs, ys] = [points.map((p) => p[0]), points.map((p) => p[1])];
    this.low = [Math.min(...xs), Math.min(...ys)];
    this.high = [Math.max(...xs), Math.max(...ys)];
    this.devices = scene.polygons.filter(([, colour]) => colour !== "wall" && !colour.startsWith("floor "));
    this.names = this.devices.map(([, colour], k) => {
      const alike = this.devices.flatMap(([, other], j) => (other === colour ? [j] : []));
      return alike.length > 1 ? `${colour} ${alike.indexOf(k) + 1}` : colour;
    });
    this.resize();
  }

  get(name) {
    return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  }

  resize() {
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!this.scene || !width || !height) return;
    for (const canvas of [this.canvas, this.still]) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    const span = Math.max(this.high[0] - this.low[0], 0.1), rise = Math.max(this.high[1] - this.low[1], 0.1);
    this.whole = Math.min(width / (span * 1.06), height / (rise * 1.06)) * ratio; // pixels a metre, unmagnified
    this.scale = this.whole * this.zoom;
    this.middle ??= [(this.low[0] + this.high[0]) / 2, (this.low[1] + this.high[1]) / 2];
    this.ratio = ratio;
    this.ink = this.get("--ink");
    this.floor = this.get("--floor");
    this.pale = this.get("--pale");
    this.accent = this.get("--accent");
    this.stamps.clear();
    this.drawStill();
    this.stale = true;
  }

  at(x, y) {
    return [
      this.canvas.width / 2 + (x - this.middle[0]) * this.scale,
      this.canvas.height / 2 - (y - this.middle[1]) * this.scale,
    ];
  }

  // Metres of a place on the page.
  metres(event) {
    const box = this.canvas.getBoundingClientRect();
    const px = (event.clientX - box.left) * this.ratio, py = (event.clientY - box.top) * this.ratio;
    return [
      (px - this.canvas.width / 2) / this.scale + this.middle[0],
      (this.canvas.height / 2 - py) / this.scale + this.middle[1],
    ];
  }

  // Magnify by a factor; the place [x, y] stays where it is.
  magnify(factor, [x, y]) {
    const before = this.scale;
    this.zoom = Math.min(Math.max(this.zoom * factor, 1), 20);
    const kept = before / (this.whole * this.zoom);
    this.middle = this.zoom === 1 ? null : [x - (x - this.middle[0]) * kept, y - (y - this.middle[1]) * kept];
    this.resize();
  }

  // Move what is seen by so many pixels of the page.
  shift(dx, dy) {
    if (this.zoom === 1) return;
    this.middle = [this.middle[0] - (dx * this.ratio) / this.scale, this.middle[1] + (dy * this.ratio) / this.scale];
    this.drawStill();
    this.stale = true;
  }

  // Where a robot is drawn, in pixels of the page.
  place(column) {
    const box = this.canvas.getBoundingClientRect();
    const [px, py] = this.at(this.shown.x[column], this.shown.y[column]);
    return [box.left + px / this.ratio, box.top + py / this.ratio];
  }

  robotAt([x, y], slack = 1.5) {
    if (!this.shown) return -1;
    let best = -1, least = this.scene.radius * slack;
    for (let i = 0; i < this.shown.x.length; i++) {
      const gap = Math.hypot(this.shown.x[i] - x, this.shown.y[i] - y);
      if (gap < least) [best, least] = [i, gap];
    }
    return best;
  }

  outline(context, points) {
    context.beginPath();
    points.forEach(([x, y], k) => context[k ? "lineTo" : "moveTo"](...this.at(x, y)));
    context.closePath();
  }

  drawStill() {
    const context = this.still.getContext("2d");
    context.clearRect(0, 0, this.still.width, this.still.height);
    context.lineJoin = "round";
    for (const [points, colour] of this.scene.polygons) {
      if (colour.startsWith("floor ")) {
        this.outline(context, points);
        context.fillStyle = this.shade(Number(colour.slice(6)));
        context.fill();
      }
      if (colour !== "wall") continue;
      this.outline(context, points);
      const whole = this.area(points) > 0.4 * (this.high[0] - this.low[0]) * (this.high[1] - this.low[1]);
      context.fillStyle = this.get(whole ? "--floor" : "--wall");
      context.strokeStyle = this.get("--wall");
      context.lineWidth = 3 * this.ratio;
      context.fill();
      context.stroke();
    }
    const length = (this.high[0] - this.low[0]) / this.zoom > 1.2 ? 0.5 : 0.1;
    const [left, bottom] = [14 * this.ratio, this.still.height - 14 * this.ratio];
    context.strokeStyle = context.fillStyle = this.ink;
    context.lineWidth = 2 * this.ratio;
    context.beginPath();
    context.moveTo(left, bottom);
    context.lineTo(left + length * this.scale, bottom);
    context.stroke();
    context.font = `${12 * this.ratio}px system-ui, sans-serif`;
    context.fillText(`${length} m`, left, bottom - 6 * this.ratio);
  }

  // The colour of a floor, from black (0) to white (1).
  shade(share) {
    const [black, white] = [this.get("--black"), this.get("--white")].map((text) =>
      [1, 3, 5].map((at) => parseInt(text.slice(at, at + 2), 16)));
    return `rgb(${black.map((value, k) => Math.round(value + share * (white[k] - value))).join()})`;
  }

  area(points) {
    return Math.abs(points.reduce((sum, [x, y], k) => {
      const [u, v] = points[(k + 1) % points.length];
      return sum + x * v - u * y;
    }, 0)) / 2;
  }

  hull(points) {
    const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
    const half = (list) => {
      const kept = [];
      for (const p of list) {
        while (kept.length > 1) {
          const [[ax, ay], [bx, by]] = kept.slice(-2);
          if ((bx - ax) * (p[1] - ay) - (by - ay) * (p[0] - ax) > 0) break;
          kept.pop();
        }
        kept.push(p);
      }
      return kept.slice(0, -1);
    };
    return [...half(sorted), ...half(sorted.reverse())];
  }

  // A robot of one role as a picture, heading to the right.
  stamp(role, text) {
    const size = STAMP_SCALES.find((s) => s >= 2.9 * this.scene.radius * this.scale) || STAMP_SCALES.at(-1);
    const key = `${role}/${text}`;
    if (!this.stamps.has(key)) {
      const style = this.styles[role], canvas = document.createElement("canvas");
      canvas.width = canvas.height = size;
      const context = canvas.getContext("2d"), unit = size / 3; // three radii across
      context.translate(size / 2, size / 2);
      context.beginPath();
      context.arc(0, 0, unit, 0, 2 * Math.PI);
      context.fillStyle = style.fill;
      context.fill();
      context.lineWidth = Math.max(1, size / 48);
      context.strokeStyle = "#22262b";
      context.stroke();
      context.fillStyle = style.ink;
      context.font = `700 ${unit * 1.05}px "DejaVu Sans", sans-serif`;
      context.textAlign = "center";
      context.textBaseline = "middle";
      context.fillText(text, 0, unit * 0.06);
      this.stamps.set(key, canvas);
    }
    return this.stamps.get(key);
  }

  drawDevices(context, lit) {
    this.devices.forEach(([points, name], k) => {
      const own = this.colours[name] || name, colour = lit[k] === 2 ? this.colours.red : own;
      const around = this.hull(points);
      this.outline(context, around);
      context.fillStyle = this.floor;
      context.fill(); // a booth may stand in a wall
      context.fillStyle = colour;
      context.globalAlpha = lit[k] ? 0.45 : 0.05;
      context.fill();
      context.globalAlpha = 1;
      const bent = this.area(points) < 0.9 * this.area(around);
      this.outline(context, points);
      context.strokeStyle = context.fillStyle = own;
      context.lineWidth = 2 * this.ratio;
      if (bent || (name === "object" && lit[k])) context.fill();
      context.stroke();
      if (name === "object") return;
      const middle = around.reduce(([a, b], [x, y]) => [a + x / around.length, b + y / around.length], [0, 0]);
      const [px, py] = this.at(...middle);
      context.fillStyle = lit[k] && !bent ? "#fff" : this.ink;
      const text = name[0].toUpperCase() + (this.names[k].split(" ")[1] ?? "");
      context.font = `700 ${Math.max((13 - 2 * text.length) * this.ratio, 0.045 * this.scale)}px system-ui, sans-serif`;
      context.textAlign = "center";
      context.textBaseline = "middle";
      context.fillText(text, px, py);
      if (this.blocked.has(k)) {
        context.strokeStyle = this.ink;
        context.lineWidth = 3 * this.ratio;
        context.beginPath();
        for (const [a, b] of [[0, 0.5], [0.25, 0.75]].map((f) => f.map((g) => around[Math.floor(g * around.length)]))) {
          context.moveTo(...this.at(...a));
          context.lineTo(...this.at(...b));
        }
        context.stroke();
      }
    });
  }

  remember(shown, cycle) {
    if (!this.trails || cycle < this.trailed || cycle > this.trailed + GAP) {
      this.trails = Array.from(shown.x, () => []);
      this.trailed = -1e9;
    }
    if (cycle - this.trailed < 3) return;
    this.trailed = cycle;
    this.trails.forEach((trail, i) => {
      trail.push([shown.x[i], shown.y[i], cycle]);
      while (trail.length > MOST_PLACES || trail[0][2] < cycle - TRAIL) trail.shift();
    });
  }

  forget() {
    this.trails = null;
  }

  lines(context, pairs, colour, width, alpha) {
    if (!pairs.length) return;
    context.beginPath();
    for (const [ax, ay, bx, by] of pairs) {
      context.moveTo(...this.at(ax, ay));
      context.lineTo(...this.at(bx, by));
    }
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.globalAlpha = alpha;
    context.lineCap = "round";
    context.stroke();
    context.globalAlpha = 1;
  }

  // shown: {x, y, heading} as they are drawn now; frame: the frame they belong to.
  draw(shown, frame, seconds) {
    if (!this.scene || !this.still.width || !this.whole) return;
    this.shown = shown;
    const context = this.canvas.getContext("2d"), { x, y, heading } = shown, { role, carried, joined } = frame;
    const radius = this.scene.radius, count = x.length;
    const longest = Math.max(18 * radius, ...this.scene.ranges.filter(([name]) => name === "radio").map(([, r]) => r));
    this.remember(shown, frame.cycle);
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    context.drawImage(this.still, 0, 0);
    this.drawDevices(context, frame.lit);
    if (this.layers.trails && this.trails) this.drawTrails(context, role);
    this.drawRanges(context, x, y, role);
    if (this.layers.chain) {
      const pairs = [];
      for (let i = 0; i < count; i++) {
        const j = joined[i];
        if (j >= 0 && Math.hypot(x[i] - x[j], y[i] - y[j]) < longest) pairs.push([x[i], y[i], x[j], y[j]]);
      }
      this.lines(context, pairs, "#c9a400", 0.5 * radius * this.scale, 0.55);
    }
    if (this.layers.packets) this.drawPackets(context, frame.packets, x, y, seconds);
    const across = 3 * radius * this.scale;
    for (let i = 0; i < count; i++) {
      const style = this.styles[role[i]], number = carried[i] && !this.scene.load ? String(carried[i]) : "";
      const text = style.letter || number;
      const [px, py] = this.at(x[i], y[i]);
      context.drawImage(this.stamp(role[i], text), px - across / 2, py - across / 2, across, across);
    }
    if (this.scene.load) this.drawLoads(context, x, y, heading, carried);
    const ways = [];
    for (let i = 0; i < count; i++) {
      const [dx, dy] = [Math.cos(heading[i]) * radius, Math.sin(heading[i]) * radius];
      ways.push([x[i] + 0.72 * dx, y[i] + 0.72 * dy, x[i] + 1.4 * dx, y[i] + 1.4 * dy]);
    }
    this.lines(context, ways, this.ink, Math.max(1.5 * this.ratio, 0.22 * radius * this.scale), 1);
    if (this.selected >= 0 && this.selected < count) {
      this.ring(context, x[this.selected], y[this.selected], radius * 1.75, this.accent, 3);
    }
    if (this.held) this.ring(context, this.held.x, this.held.y, radius, this.accent, 2);
    if (this.layers.names) this.drawNames(context, x, y);
    this.drawn += 1;
  }

  // What robots carry: a box at the back, so that letter and heading stay readable.
  drawLoads(context, x, y, heading, carried) {
    const radius = this.scene.radius, side = 0.9 * radius * this.scale;
    context.fillStyle = this.colours.object;
    context.strokeStyle = "#22262b";
    context.lineWidth = this.ratio;
    for (let i = 0; i < x.length; i++) {
      if (!carried[i]) continue;
      const [px, py] = this.at(x[i] - Math.cos(heading[i]) * radius, y[i] - Math.sin(heading[i]) * radius);
      context.fillRect(px - side / 2, py - side / 2, side, side);
      context.strokeRect(px - side / 2, py - side / 2, side, side);
    }
  }

  drawTrails(context, role) {
    const byRole = new Map();
    this.trails.forEach((trail, i) => {
      if (!byRole.has(role[i])) byRole.set(role[i], []);
      byRole.get(role[i]).push(trail);
    });
    context.lineWidth = 1.4 * this.ratio;
    context.globalAlpha = 0.45;
    for (const [number, trails] of byRole) {
      context.strokeStyle = this.styles[number].chained ? this.styles[number].fill : this.pale;
      context.beginPath();
      for (const trail of trails) trail.forEach(([x, y], k) => context[k ? "lineTo" : "moveTo"](...this.at(x, y)));
      context.stroke();
    }
    context.globalAlpha = 1;
  }

  drawRanges(context, x, y) {
    const whose = this.layers.ranges && this.selected < 0 ? [...x.keys()] : this.selected >= 0 ? [this.selected] : [];
    if (!this.layers.ranges && this.selected < 0) return;
    for (const i of whose) {
      this.scene.ranges.forEach(([name, reach], k) => {
        this.ring(context, x[i], y[i], reach, this.accent, 1, whose.length > 1 ? 0.25 : 0.8, k ? [] : [6, 5]);
        if (whose.length > 1) return;
        const side = y[i] + reach > this.high[1] ? -1 : 1; // above the circle if there is room
        const [px, py] = this.at(x[i], y[i] + side * reach);
        context.fillStyle = this.accent;
        context.font = `${11 * this.ratio}px system-ui, sans-serif`;
        context.textAlign = "center";
        context.textBaseline = side > 0 ? "bottom" : "top";
        this.write(context, `${name} ${reach.toFixed(2)} m`, px, py - 4 * side);
      });
    }
  }

  ring(context, x, y, radius, colour, width, alpha = 1, dash = []) {
    context.beginPath();
    context.arc(...this.at(x, y), radius * this.scale, 0, 2 * Math.PI);
    context.strokeStyle = colour;
    context.globalAlpha = alpha;
    context.lineWidth = width * this.ratio;
    context.setLineDash(dash.map((d) => d * this.ratio));
    context.stroke();
    context.setLineDash([]);
    context.globalAlpha = 1;
  }

  drawPackets(context, packets, x, y, seconds) {
    const pairs = [];
    for (let k = 0; k < packets.length; k += 2) {
      const [to, from] = [packets[k], packets[k + 1]];
      if (this.selected >= 0 && to !== this.selected && from !== this.selected) continue;
      pairs.push([x[from], y[from], x[to], y[to], to * 0.37 + from * 0.61]);
    }
    this.lines(context, pairs, this.accent, this.ratio, 0.28);
    context.fillStyle = this.accent;
    context.beginPath();
    for (const [ax, ay, bx, by, start] of pairs) {
      const t = (seconds * 1.6 + start) % 1, [px, py] = this.at(ax + t * (bx - ax), ay + t * (by - ay));
      context.moveTo(px + 2.6 * this.ratio, py);
      context.arc(px, py, 2.6 * this.ratio, 0, 2 * Math.PI);
    }
    context.fill();
  }

  drawNames(context, x, y) {
    context.fillStyle = this.ink;
    context.font = `${11 * this.ratio}px system-ui, sans-serif`;
    context.textAlign = "left";
    context.textBaseline = "bottom";
    for (let i = 0; i < x.length; i++) {
      const [px, py] = this.at(x[i] + this.scene.radius, y[i] + this.scene.radius);
      this.write(context, this.identity[i], px, py);
    }
  }

  // A text that stays readable on whatever it lies on.
  write(context, text, px, py) {
    context.strokeStyle = this.floor;
    context.lineWidth = 3 * this.ratio;
    context.lineJoin = "round";
    context.strokeText(text, px, py);
    context.fillText(text, px, py);
  }
}
