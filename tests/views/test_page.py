"""The page, in a browser: robots move, pause stops the clock, a click opens the right robot, killing kills."""

import time

import numpy as np
import pytest

from formicarium.commands.main import exit_code
from formicarium.systems.registry import resolve
from formicarium.views.live.session import Session
from formicarium.views.notebook import Replay
from formicarium.views.recording.log import read_recording
from views.conftest import command, placed, until

SEED = 5
CYCLE = "watching.now.frame.cycle"
PLACES = "[...watching.now.frame.x, ...watching.now.frame.y]"


@pytest.fixture(scope="module")
def watched(tmp_path_factory):
    folder = tmp_path_factory.mktemp("watched")
    with command("watch", "mark-i3", "--seed", str(SEED), "--speed", "20", "--out", "rec", folder=folder) as address:
        yield address


def ask(page, **wish):
    page.evaluate("wish => watching.ask(wish)", wish)


def settled(page):
    """Pause, and wait until the page shows where the trial stands."""
    ask(page, do="pause")
    until(page, "!watching.now.status.playing && watching.now.status.cycle === watching.now.frame.cycle")
    time.sleep(0.3)
    return page.evaluate(CYCLE)


def sought(page, cycle):
    ask(page, do="seek", cycle=cycle)
    until(page, f"{CYCLE} === {cycle} && !watching.now.status.seeking")


def test_robots_move_and_pause_stops_the_clock(watched, opened):
    page = opened(watched)
    ask(page, do="play")
    first = page.evaluate(PLACES)
    until(page, f"{CYCLE} > {page.evaluate(CYCLE) + 60}")
    assert np.abs(np.subtract(page.evaluate(PLACES), first)).max() > 0.02
    page.click("#play")
    until(page, "!watching.now.status.playing")
    cycle = settled(page)
    clock = page.evaluate("time.value")
    time.sleep(0.6)
    assert page.evaluate(CYCLE) == cycle and page.evaluate("time.value") == clock
    page.click("#step")
    until(page, f"{CYCLE} === {cycle + 1}")
    page.click("#back")
    until(page, f"{CYCLE} === {cycle}")


def test_something_else_is_drawn_when_robots_have_moved(watched, opened):
    page = opened(watched)
    settled(page)
    sought(page, 50)
    before = page.locator("#arena").screenshot()
    sought(page, 150)
    time.sleep(0.2)
    assert page.locator("#arena").screenshot() != before


def test_a_click_opens_the_right_robot_with_its_messages_decoded(watched, opened):
    page = opened(watched)
    settled(page)
    sought(page, 900)
    system = resolve("mark-i3")
    session = Session(system, system.configure(), SEED)
    session.seek(900)
    for column in (2, 7, 13):
        x, y = placed(page, column)
        page.mouse.click(x, y)
        identity = int(session.identity[column])
        until(page, f"watching.now.inspection && watching.now.inspection.identity === {identity}")
        until(page, "watching.now.inspection.cycle === 900")
        assert page.input_value("#choose") == str(identity)
        told = session.inspect(identity)
        assert page.evaluate("summary.value") == told.summary
        shown = page.evaluate("watching.now.inspection.sections")
        assert [(s["title"], s["columns"], s["rows"]) for s in shown] == [
            (s.title, list(s.columns), [list(row) for row in s.rows]) for s in told.sections
        ]
        text = page.inner_text("#inside")
        assert "link_number" in text and "inhibition_heard" in text and "predecessor" in text


def test_messages_fly_between_those_who_send_and_those_who_hear(watched, opened):
    page = opened(watched)
    settled(page)
    sought(page, 900)

    def seen_twice():
        first = page.locator("#arena").screenshot()
        page.wait_for_timeout(300)
        return first, page.locator("#arena").screenshot()

    page.wait_for_timeout(300)
    first, second = seen_twice()
    assert first == second  # the clock stands and so does the picture
    page.keyboard.press("m")
    until(page, "watching.now.frame.packets.length > 0")
    first, second = seen_twice()
    assert first != second  # messages are under way
    system = resolve("mark-i3")
    session = Session(system, system.configure(), SEED)
    session.seek(900)
    pairs = np.reshape(page.evaluate("[...watching.now.frame.packets]"), (-1, 2))
    assert pairs.tolist() == session.packets().tolist() and len(pairs) > 5
    x, y = page.evaluate("[[...watching.now.frame.x], [...watching.now.frame.y]]")
    assert max(np.hypot(x[to] - x[sender], y[to] - y[sender]) for to, sender in pairs) < 0.81  # the radio's range
    page.keyboard.press("m")


def test_scrubbing_back_shows_the_state_that_was(watched, opened):
    page = opened(watched)
    ask(page, do="speed", times=0)
    ask(page, do="play")
    until(page, f"{CYCLE} > 2500")
    ask(page, do="speed", times=20)
    settled(page)
    system = resolve("mark-i3")
    session = Session(system, system.configure(), SEED)
    for cycle in (1234, 317):
        page.locator("#scrub").fill(str(cycle))
        until(page, f"{CYCLE} === {cycle}")
        session.seek(cycle)
        frame = session.frame()
        assert page.evaluate(PLACES) == np.concatenate([frame.x[0], frame.y[0]]).tolist()
        assert page.evaluate("[...watching.now.frame.role]") == frame.role[0].tolist()


def test_what_is_done_by_hand_happens_is_listed_recorded_and_replayed(opened, serving, tmp_path):
    with serving("watch", "mark-i3", "--seed", "6", "--paused", "--out", "rec", folder=tmp_path) as address:
        page = opened(address)
        sought(page, 200)
        x, y = placed(page, 4)
        page.mouse.click(x, y)
        identity = page.evaluate("watching.now.selected")
        page.click("#kill")
        page.click("#booths button >> nth=1")
        until(page, "watching.now.status.interventions.length === 2")
        ask(page, do="seek", cycle=260)
        until(page, f"{CYCLE} === 260")
        assert page.evaluate("watching.now.frame.role[4]") == 4  # dead
        before = page.evaluate(PLACES)
        ask(page, do="seek", cycle=500)
        until(page, f"{CYCLE} === 500")
        gone = np.abs(np.subtract(page.evaluate(PLACES), before)).reshape(2, -1)
        assert gone[:, 4].max() < 0.1 and gone.max() > 0.3  # others may push what is dead
        column = 9
        start = placed(page, column)
        page.mouse.move(*start)
        page.mouse.down()
        page.mouse.move(start[0] + 40, start[1] + 3, steps=4)
        page.mouse.up()
        until(page, "watching.now.status.interventions.length === 3 || !notice.hidden")
        until(page, "/you kill/.test(events.innerText) && /you block/.test(events.innerText)")
        deeds = page.evaluate("watching.now.status.interventions")
        assert deeds[0][:3] == [200, "kill", identity] and deeds[1][:3] == [200, "block", 1]
        ask(page, do="seek", cycle=700)
        until(page, f"{CYCLE} === 700")
    path = tmp_path / "rec" / "seed-6.recording"
    recording = read_recording(path)
    assert [list(deed) for deed in recording.interventions] == deeds and recording.end >= 695
    assert exit_code(["replay", str(path), "--check"]) == 0
    with serving("replay", str(path), "--speed", "0", folder=tmp_path) as address:
        page = opened(address)
        until(page, "watching.now.status.cycle >= 700")
        state = page.inner_text("#state")
        assert "verified up to" in state or "verified to the end" in state
        ask(page, do="pause")
        ask(page, do="seek", cycle=500)  # the list holds the latest events alone
        until(page, f"{CYCLE} === 500 && /you kill/.test(events.innerText)")


def test_foraging_shows_floor_path_objects_and_a_blocked_booth(opened, serving, tmp_path):
    with serving("watch", "partitioning", "--seed", "110001", "--paused", "--out", "rec", folder=tmp_path) as address:
        page = opened(address)
        sought(page, 2000)
        page.wait_for_timeout(500)
        system = resolve("partitioning")
        session = Session(system, system.configure(), 110001)
        session.seek(2000)
        frame = session.frame()
        assert page.evaluate("[...watching.now.frame.carried]") == frame.carried[0].tolist()
        loaded = int(frame.carried.sum())
        assert 0 < loaded < 10 and f"{loaded}\nwith object" in page.inner_text("#legend")
        brightness = """(places) => {
            const picture = arena.getContext("2d").getImageData(0, 0, arena.width, arena.height);
            const [px, py] = [0, 1].map((k) => places.map((place) => Math.round(watching.arena.at(...place)[k])));
            return px.map((x, k) => picture.data[4 * (py[k] * arena.width + x)]);
        }"""
        page.click("[data-layer=trails]")
        page.wait_for_timeout(200)
        path, bottom, nest = page.evaluate(brightness, [[0.8, 0.225], [0.8, 0.03], [1.25, 2.05]])
        assert path > bottom + 20 > nest + 20  # shades 1.0, 0.5 and 0.14
        page.click("#booths button >> nth=2")
        page.click("#step")
        until(page, f"{CYCLE} === 2001 && watching.now.status.interventions.length === 1")
        assert page.evaluate("watching.now.frame.lit[2]") == 0
        assert "you block booth green 3" in page.inner_text("#events")


@pytest.mark.parametrize(("width", "height"), [(1280, 800), (390, 844)])
def test_coverage_shows_arms_links_and_how_word_floods(opened, serving, tmp_path, width, height):
    with serving("watch", "coverage", "--seed", "900101", "--paused", "--out", "rec", folder=tmp_path) as address:
        page = opened(address, width, height)
        page.keyboard.press("m")
        system = resolve("coverage")
        session = Session(system, system.configure(), 900101)
        session.seek(203)
        while session.state.memories.epoch.max() < 2:
            session.seek(int(session.state.clock[0].cycle) + 1)
        called = int(session.state.clock[0].cycle)
        told = []
        for cycle in range(called, called + 4):
            sought(page, cycle)
            told.append(page.evaluate("[...watching.now.frame.role].filter((role) => role === 2).length"))
        assert told[0] > 8 > told[-1] == 0  # one hop a cycle: those who flock have not heard of the eruption
        sought(page, 700)
        session.seek(700)
        until(page, "watching.now.frame.packets.length > 0")
        frame = session.frame()
        pairs = np.reshape(page.evaluate("[...watching.now.frame.packets]"), (-1, 2))
        assert pairs.tolist() == session.packets().tolist() and len(pairs) > 30
        assert page.evaluate("[...watching.now.frame.carried]") == frame.carried[0].tolist()
        assert {1, 2, 3} <= set(frame.carried[0].tolist())  # each robot wears the number of its arm
        joined = page.evaluate("[...watching.now.frame.joined]")
        assert joined == frame.joined[0].tolist() and sum(other >= 0 for other in joined) == 15  # all but the master
        pixels = """(places) => {
            const picture = arena.getContext("2d").getImageData(0, 0, arena.width, arena.height);
            const at = places.map((place) => watching.arena.at(...place).map(Math.round));
            const starts = at.map(([x, y]) => 4 * (y * arena.width + x));
            return starts.map((start) => [...picture.data.slice(start, start + 3)]);
        }"""
        page.keyboard.press("m")
        page.click("[data-layer=trails]")
        page.wait_for_timeout(300)
        x, y = frame.x[0], frame.y[0]
        middles = [[float(x[i] + x[j]) / 2, float(y[i] + y[j]) / 2] for i, j in enumerate(joined) if j >= 0]
        floor, *links = page.evaluate(pixels, [[float(x.min()) - 0.5, float(y.max())], *middles])
        assert all(np.abs(np.subtract(link, floor)).max() > 20 for link in links)  # lines from each to the next
        assert page.is_hidden("#devices")  # a task is no booth: nobody can block it


def test_the_keyboard_does_what_the_buttons_do(watched, opened):
    page = opened(watched)
    cycle = settled(page)
    page.keyboard.press("Escape")
    page.keyboard.press("ArrowRight")
    until(page, f"{CYCLE} === {cycle + 1}")
    page.keyboard.press("Shift+ArrowLeft")
    until(page, f"{CYCLE} === {max(cycle + 1 - 100, 0)}")
    page.keyboard.press("]")
    until(page, "watching.now.inspection")
    page.keyboard.press("Escape")
    for key, layer in zip("tcmrn", ("trails", "chain", "packets", "ranges", "names")):
        pressed = page.get_attribute(f"[data-layer={layer}]", "aria-pressed")
        page.keyboard.press(key)
        assert page.get_attribute(f"[data-layer={layer}]", "aria-pressed") != pressed
    page.keyboard.press(" ")
    until(page, "watching.now.status.playing")
    page.keyboard.press(" ")
    until(page, "!watching.now.status.playing")


def test_one_can_go_nearer_and_still_click_the_right_robot(watched, opened):
    page = opened(watched)
    settled(page)
    x, y = placed(page, 11)
    page.mouse.move(x, y)
    before = page.evaluate("watching.arena.scale")
    page.mouse.wheel(0, -500)
    until(page, f"watching.arena.scale > {2 * before}")
    nearer = placed(page, 11)
    assert np.hypot(nearer[0] - x, nearer[1] - y) < 5  # a wheel event has whole pixels, magnified
    page.mouse.click(*nearer)
    until(page, "watching.now.inspection")
    assert page.evaluate("watching.now.selected === watching.hello.identity[11]")
    page.mouse.dblclick(*nearer)
    until(page, f"watching.arena.scale === {before}")


def test_every_control_has_a_name(watched, opened):
    page = opened(watched)
    nameless = page.evaluate(
        """[...document.querySelectorAll('button, select, input, canvas[role]')].filter((e) => !(
        e.getAttribute('aria-label') || e.innerText.trim() || e.closest('label')?.innerText.trim())).map((e) => e.id)"""
    )
    assert nameless == []


@pytest.mark.parametrize("scheme", ["dark", "light"])
def test_a_phone_is_wide_enough(watched, opened, scheme):
    page = opened(watched, 390, 844, color_scheme=scheme, device_scale_factor=2)
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    box = page.locator("#arena").bounding_box()
    assert box["width"] > 350 and box["y"] + box["height"] <= 844
    assert page.locator("#play").is_visible() and page.locator("#play").bounding_box()["y"] < 844
    background = page.evaluate("getComputedStyle(document.body).backgroundColor")
    assert (sum(map(int, background[4:-1].split(","))) < 200) == (scheme == "dark")


def test_one_html_file_plays_without_server_or_network(opened, tmp_path):
    run = ["run", "mark-i3", "--seed", "4", "--record", "--set", "time_cap=120", "--out", str(tmp_path / "r")]
    assert exit_code([*run, "--workers", "1"]) == 0
    out = tmp_path / "replay.html"
    assert exit_code(["movie", str(tmp_path / "r"), "--out", str(out)]) == 0
    page = opened(out.as_uri(), offline=True)
    page.keyboard.press(" ")
    until(page, f"{CYCLE} > 30")
    page.keyboard.press(" ")
    page.locator("#scrub").fill("600")
    until(page, f"{CYCLE} === 600")
    frames = read_recording(tmp_path / "r" / "recordings" / "seed-4.recording").frames
    k = int(np.searchsorted(frames.cycle, 600))
    wanted = np.concatenate([frames.x[k], frames.y[k]])
    assert np.abs(np.subtract(page.evaluate(PLACES), wanted)).max() < 1e-3
    assert "http" not in "".join(page.evaluate("performance.getEntriesByType('resource').map((e) => e.name)"))


def test_a_notebook_cell_plays(browser, tmp_path):
    run = ["run", "mark-i3", "--seed", "4", "--record", "--set", "time_cap=60", "--out", str(tmp_path / "r")]
    assert exit_code([*run, "--workers", "1"]) == 0
    page = browser.new_page()
    page.set_content(f"<p>a cell</p>{Replay(tmp_path / 'r' / 'recordings' / 'seed-4.recording')._repr_html_()}")
    frame = page.frames[1]
    until(frame, "window.watching && watching.now.frame")
    frame.locator("#play").click()
    until(frame, f"{CYCLE} > 30")
    page.close()
