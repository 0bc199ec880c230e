"""The controller of one robot: reads Readings from a socket, decides, answers. A program: PORT IDENTITY.

It knows its memory, what it was told before it was switched on, and what it senses. Nothing else reaches it.
"""

import json
import socket
import sys
from importlib import import_module

import numpy as np

from formicarium.compiled import INTERPRETED
from formicarium.trial.onboard import layout_of, received, send


def main(port: int, identity: int) -> None:
    """Be the controller of a robot until the line is closed."""
    np.seterr(all="ignore")  # as compiled code has it
    with socket.create_connection(("127.0.0.1", port)) as line:
        line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        send(line, str(identity).encode())
        brief = json.loads(received(line))
        sys.path[:] = brief["path"]
        module, _, name = brief["decide"].partition(":")
        decide = getattr(import_module(module), name)
        reading_layout, memory_layout, command_layout = map(layout_of, brief["layouts"])
        memory, command = (
            np.frombuffer(bytearray(received(line)), layout).view(np.recarray)
            for layout in (memory_layout, command_layout)
        )
        arrays = [np.frombuffer(received(line), layout_of(text)) for text in brief["tables"]]
        tables = [array.view(np.recarray)[0] if array.dtype.names else array[0] for array in arrays]
        while True:
            try:
                content = received(line)
            except ConnectionError:
                return
            reading = np.frombuffer(content, reading_layout).view(np.recarray)
            decide(reading[0], memory[0], command[0], *tables)
            send(line, command.tobytes() + memory.tobytes())


if __name__ == "__main__":
    assert INTERPRETED
    main(int(sys.argv[1]), int(sys.argv[2]))
