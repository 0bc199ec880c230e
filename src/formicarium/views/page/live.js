// Frames, events and answers of a running trial, over one WebSocket.

const HEAD = 8; // 32-bit numbers

function frameOf(buffer) {
  const [, cycle, robots, devices, packets, turns, frontier, jump] = new Int32Array(buffer, 0, HEAD);
  let at = HEAD * 4;
  const take = (Kind, count) => {
    const found = new Kind(buffer, at, count);
    at += count * Kind.BYTES_PER_ELEMENT;
    return found;
  };
  const [x, y, heading] = [0, 0, 0].map(() => take(Float32Array, robots));
  const heard = take(Uint16Array, 2 * packets);
  const joined = take(Int16Array, robots);
  const [role, carried, colour] = [0, 0, 0].map(() => take(Int8Array, robots));
  const lit = take(Int8Array, devices);
  return { cycle, x, y, heading, packets: heard, joined, role, carried, colour, lit, turns, frontier, jump: !!jump };
}

export function connect(told) {
  const socket = new WebSocket(location.origin.replace(/^http/, "ws") + "/socket");
  socket.binaryType = "arraybuffer";
  socket.onmessage = ({ data }) => {
    if (typeof data !== "string") return told.frame(frameOf(data));
    const { kind, ...content } = JSON.parse(data);
    told[kind](content);
  };
  socket.onclose = () => told.lost();
  return {
    ask(wish) {
      if (socket.readyState === WebSocket.OPEN) socket.send(JSON.stringify(wish));
    },
  };
}
