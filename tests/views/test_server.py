"""The server: closed to the outside, patient with nobody, and not to be upset by what it is sent."""

import contextlib
import http.client
import json
import socket
import threading
import time

import pytest
import uvicorn
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from formicarium.systems.registry import resolve
from formicarium.views.live.player import Player
from formicarium.views.live.server import MISTAKES, MOST_BYTES, Audience, PortTaken, application, listening
from formicarium.views.live.session import Session
from formicarium.views.live.wire import HEAD, greeting

SYSTEM = resolve("mark-i3")


class Served:
    """A trial on a page, in this process."""

    def __init__(self, speed=20.0, playing=True):
        self.session = Session(SYSTEM, SYSTEM.configure(), 3)
        self.session.warm_up()
        self.player = Player(self.session, speed, playing, lambda: {"note": ""})
        hello = greeting(self.session, "t", SYSTEM.kinds)
        audience = Audience(self.player, hello, SYSTEM.watching.tell, SYSTEM.kinds)
        listener = listening("127.0.0.1", 0)
        self.port = listener.getsockname()[1]
        self.server = uvicorn.Server(
            uvicorn.Config(
                application(audience, "127.0.0.1", "t"), log_level="error", ws_max_size=MOST_BYTES,
                ws_per_message_deflate=False, timeout_graceful_shutdown=1,
            )
        )  # fmt: skip
        self.thread = threading.Thread(target=self.server.run, kwargs={"sockets": [listener]}, daemon=True)
        self.thread.start()
        while not self.server.started:
            time.sleep(0.01)

    def stop(self):
        self.server.should_exit = True
        self.thread.join(15)
        assert not self.thread.is_alive() and not self.player.thread.is_alive()

    def page(self, **options):
        return connect(f"ws://127.0.0.1:{self.port}/socket", compression=None, **options)

    def get(self, path, **headers):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=5)
        connection.request("GET", path, headers=headers)
        answer = connection.getresponse()
        return answer.status, answer.read()


@pytest.fixture(scope="module")
def served():
    found = Served()
    yield found
    found.stop()


def heard(page, kind, patience=5.0):
    """Return the next message of a kind; "frame" is the head of a binary one."""
    end = time.monotonic() + patience
    while True:
        message = page.recv(timeout=end - time.monotonic())
        if isinstance(message, bytes):
            if kind == "frame":
                return HEAD.unpack_from(message)
        elif json.loads(message)["kind"] == kind:
            return json.loads(message)


def test_a_page_is_told_what_there_is_and_then_frames(served):
    with served.page() as page:
        assert heard(page, "hello")["identity"] == served.session.identity.tolist()
        first = heard(page, "frame")
        assert first[0] == 1 and first[2:4] == (20, 3)
        assert heard(page, "status")["speed"] == 20
        while heard(page, "frame")[1] <= first[1]:
            pass


@pytest.mark.parametrize(
    "path",
    ["/../pyproject.toml", "/page/../../pyproject.toml", "/page/%2e%2e/__init__.py", "/page/__init__.py", "/etc/passwd",
     "/page/", "//etc/passwd", "/page/style.css/..", "/recordings/x"],
)  # fmt: skip
def test_nothing_but_the_page_is_served(served, path):
    assert served.get(path)[0] in (404, 400, 307) and b"formicarium" not in served.get(path)[1].lower()


def test_the_page_is_served_with_a_policy_that_lets_nothing_else_in(served):
    connection = http.client.HTTPConnection("127.0.0.1", served.port)
    connection.request("GET", "/")
    answer = connection.getresponse()
    policy = answer.getheader("Content-Security-Policy")
    assert answer.status == 200 and "default-src 'none'" in policy and "script-src 'self';" in policy
    text = answer.read().decode()
    assert "http://" not in text and "https://" not in text


@pytest.mark.parametrize("host", ["evil.example", "evil.example:80", "localhost.evil.example", ""])
def test_a_wrong_host_is_refused(served, host):
    assert served.get("/", Host=host)[0] in (400, 403)


@pytest.mark.parametrize("origin", ["http://evil.example", "null", "https://127.0.0.1", "http://127.0.0.1:1"])
def test_a_wrong_origin_is_refused(served, origin):
    with pytest.raises(InvalidStatus) as refusal:
        served.page(origin=origin)
    assert refusal.value.response.status_code == 403
    with served.page(origin=f"http://127.0.0.1:{served.port}") as page:
        assert heard(page, "hello")


@pytest.mark.parametrize(
    "nonsense",
    ["", "{", "[]", "null", '{"do":"fly"}', '{"do":"seek","cycle":-1}', '{"do":"seek","cycle":1e99}', '{"do":"seek"}',
     '{"do":"speed","times":NaN}', '{"do":"move","subject":1,"x":Infinity,"y":0}', '{"do":"play","more":1}',
     '{"do":"seek","cycle":"1"}', b"\x00\x01", "\x00" * 1000, "[" * 10_000],
)  # fmt: skip
def test_nonsense_is_answered_and_nothing_happens(served, nonsense):
    with served.page() as page:
        page.send(nonsense)
        assert "no sense" in heard(page, "notice")["text"]
        page.send('{"do":"select","robot":0}')
        assert heard(page, "frame")


def test_who_talks_only_nonsense_is_shown_the_door(served):
    with served.page() as page, pytest.raises(ConnectionClosed):
        for _ in range(MISTAKES):
            page.send("nonsense")
        heard(page, "never")


def test_an_oversized_message_ends_that_page_alone(served):
    with served.page() as other, served.page() as page:
        with pytest.raises(ConnectionClosed):
            page.send("x" * (MOST_BYTES + 1))
            heard(page, "never")
        assert heard(other, "frame")


def test_what_cannot_be_done_is_said(served):
    with served.page() as page:
        page.send(json.dumps({"do": "move", "subject": int(served.session.identity[0]), "x": 50.0, "y": 0.0}))
        assert "outside the arena" in heard(page, "notice")["text"]


def test_a_port_that_is_taken_is_named_with_a_way_out(served):
    with pytest.raises(PortTaken, match=rf"port {served.port} of 127\.0\.0\.1 is taken.*--port"):
        listening("127.0.0.1", served.port)


def test_only_this_machine_is_listened_to_unless_told_otherwise():
    with listening("127.0.0.1", 0) as found:
        assert found.getsockname()[0] == "127.0.0.1"


def test_slow_and_vanished_pages_never_hold_the_trial():
    served = Served(speed=0.0, playing=False)
    try:
        with served.page() as awake:
            for _ in range(3):  # take nothing at all
                slow = socket.create_connection(("127.0.0.1", served.port))
                slow.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1024)
                slow.sendall(
                    f"GET /socket HTTP/1.1\r\nHost: 127.0.0.1:{served.port}\r\nUpgrade: websocket\r\n"
                    "Connection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
                    "Sec-WebSocket-Version: 13\r\n\r\n".encode()
                )
            gone = served.page()
            gone.socket.shutdown(socket.SHUT_RDWR)
            assert served.session.cycle == 0  # all are there before it begins
            awake.send('{"do":"play"}')
            end = time.monotonic() + 20
            seen = 0
            while not served.session.finished and time.monotonic() < end:
                with contextlib.suppress(TimeoutError):
                    seen += heard(awake, "frame", 0.5)[0]
            assert served.session.finished and seen > 3
    finally:
        served.stop()
    alone = SYSTEM.run(SYSTEM.configure(), 3)
    assert served.session.events.tobytes() == alone.events.tobytes()
    assert dict(served.session.outcome()) == dict(alone.outcome)
