// Plays frames that are inside the page itself: the same page without a server.

async function unpacked(base64) {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

// Columns are differences in time: sums give the values back.
function column(buffer, at, Kind, frames, width) {
  const values = new Kind(buffer, at, frames * width);
  for (let k = width; k < values.length; k++) values[k] += values[k - width];
  return values;
}

export function openFilm(told) {
  const { hello, film, events, note } = JSON.parse(document.getElementById("film").textContent);
  const state = { playing: false, speed: 10, cycle: film.first, frame: -1 };
  const end = film.first + film.every * (film.frames - 1);
  let columns = null, before = 0;

  function rows(name, k) {
    const width = columns[name].length / film.frames;
    return columns[name].subarray(k * width, (k + 1) * width);
  }

  function show(jump) {
    const k = Math.min(Math.floor((state.cycle - film.first) / film.every), film.frames - 1);
    const next = Math.min(k + 1, film.frames - 1), t = (state.cycle - film.first) / film.every - k;
    const mix = (name, scale) => {
      const [a, b] = [rows(name, k), rows(name, next)];
      return Float32Array.from(a, (value, i) => (value + t * (b[i] - value)) * scale);
    };
    told.frame({
      cycle: Math.round(state.cycle), x: mix("x", film.place), y: mix("y", film.place), heading: mix("heading", film.turn),
      packets: [], joined: rows("joined", k), role: rows("role", k), carried: rows("carried", k), colour: [],
      lit: rows("lit", k), jump,
    });
  }

  function status() {
    const finished = state.cycle >= end;
    told.status({
      cycle: Math.round(state.cycle), frontier: end, playing: state.playing, seeking: false, speed: state.speed || 1000,
      finished, ended: true, interventions: film.interventions, note,
    });
  }

  function go(cycle, jump) {
    state.cycle = Math.max(film.first, Math.min(cycle, end));
    show(jump);
    status();
  }

  function play(time) {
    requestAnimationFrame(play);
    if (!columns) return;
    const passed = Math.min(time - before, 200) / 1000;
    before = time;
    if (!state.playing) return;
    if (state.cycle >= end) state.playing = false;
    go(state.cycle + (passed * (state.speed || 1000)) / hello.scene.cycle_time, false);
  }

  unpacked(film.data).then((buffer) => {
    columns = {};
    let at = 0;
    for (const [name, Kind, width] of [
      ["x", Int32Array, film.robots], ["y", Int32Array, film.robots], ["heading", Int32Array, film.robots],
      ["joined", Int16Array, film.robots], ["role", Int8Array, film.robots], ["carried", Int8Array, film.robots],
      ["lit", Int8Array, film.devices],
    ]) {
      columns[name] = column(buffer, at, Kind, film.frames, width);
      at += columns[name].byteLength;
    }
    told.hello(hello);
    told.events({ again: true, rows: events });
    go(film.first, true);
    requestAnimationFrame(play);
  });

  return {
    ask(wish) {
      if (wish.do === "play") {
        state.playing = true;
        if (state.cycle >= end) go(film.first, true);
      } else if (wish.do === "pause") state.playing = false;
      else if (wish.do === "step") { state.playing = false; go(state.cycle + wish.cycles, true); }
      else if (wish.do === "speed") state.speed = wish.times;
      else if (wish.do === "seek") go(wish.cycle, true);
      if (columns) status();
    },
  };
}
