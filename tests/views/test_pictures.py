"""Pictures show what they are given: checked on the artists, and on the pixels where that says more."""

import math

import numpy as np
import pytest
from matplotlib.image import imread

import random_walk
from formicarium.campaigns.files import StoreError
from formicarium.statistics.runtimes import run_times
from formicarium.trial.record import Frames, Polygon, Scene
from formicarium.views import movie
from formicarium.views.chain import bands
from formicarium.views.frames import draw_frame
from formicarium.views.movie import draw_movie, images
from formicarium.views.outlines import area, hull
from formicarium.views.overhead import Overhead
from formicarium.views.runtimes import draw_run_times
from formicarium.views.style import role_styles
from formicarium.views.timeline import draw_timeline

PARAMETERS = random_walk.configure()


@pytest.fixture(scope="module")
def trial():
    return random_walk.run(PARAMETERS, 3, frames_every=10.0)


def pixel(picture, x, y):
    """Colour of the picture at a place of the arena, 0..255."""
    picture.figure.canvas.draw()
    column, row = picture.axes.transData.transform((x, y))
    image = np.asarray(picture.figure.canvas.buffer_rgba())
    return image[image.shape[0] - 1 - round(row), round(column), :3].astype(int)


def test_a_frame_is_a_picture_of_the_promised_size(trial, tmp_path):
    path = draw_frame(trial.scene, trial.frames, tmp_path / "frame.png")
    assert imread(path).shape == (800, 1000, 4)
    assert [file.name for file in tmp_path.iterdir()] == ["frame.png"]


def test_equal_frames_are_equal_bytes(trial, tmp_path):
    one, two = (draw_frame(trial.scene, trial.frames, tmp_path / name) for name in ("one.png", "two.png"))
    assert one.read_bytes() == two.read_bytes()


def test_robots_stand_where_the_frame_says_in_their_role_colour(trial):
    picture = Overhead(trial.scene)
    for robot, role in [(0, "guardian"), (1, "link"), (19, "dead")]:
        picture.show(trial.frames, -1)
        x, y = trial.frames.x[-1, robot], trial.frames.y[-1, robot]
        style = role_styles(trial.scene.roles)[trial.scene.roles.index(role)]
        wanted = [int(style.fill[i : i + 2], 16) for i in (1, 3, 5)]
        heading = trial.frames.heading[-1, robot] + math.pi  # behind the letter, away from the heading
        seen = pixel(picture, x + 0.027 * math.cos(heading), y + 0.027 * math.sin(heading))
        assert np.abs(seen - wanted).max() < 12, role


def test_a_booth_is_filled_when_lit_and_hollow_when_dark(trial):
    picture = Overhead(trial.scene)
    corner = trial.scene.polygons[1].points[0] * 0.85 + trial.scene.polygons[1].points.mean(axis=0) * 0.15
    for lit in (0, 1):
        frames = trial.frames._replace(lit=np.full_like(trial.frames.lit, lit))
        picture.show(frames, 0)
        red, green, _ = pixel(picture, *(corner * 0.4 + trial.scene.polygons[1].points.mean(axis=0) * 0.6))
        assert (red - green > 80) == bool(lit)


def test_the_side_tells_time_and_counts(trial):
    picture = Overhead(trial.scene)
    picture.show(trial.frames, 31)
    assert picture.time.get_text() == "5:10"
    counts = np.bincount(trial.frames.role[31], minlength=5)
    assert [int(text.get_text()) for text in picture.counts] == list(counts)


def test_what_is_drawn_over_a_copy_is_what_is_drawn_anew(trial):
    """Movie pictures come from a shortcut; they must be the pictures that the long way gives."""
    picture = Overhead(trial.scene)
    shortcut = [image.copy() for image in images(picture, trial.frames, np.array([0, 20, 60]), lambda *_: None)]
    for image, index in zip(shortcut, (0, 20, 60)):
        fresh = Overhead(trial.scene)
        fresh.show(trial.frames, index)
        fresh.figure.canvas.draw()
        difference = np.abs(image.astype(int) - np.asarray(fresh.figure.canvas.buffer_rgba()))
        assert (difference.max(axis=2) > 8).mean() < 1e-3


def test_roles_that_nobody_thought_of_are_drawn_too(trial, tmp_path):
    scene = trial.scene._replace(roles=("runner", "scout", "carrier", "tail", "dead"))
    assert [style.letter for style in role_styles(scene.roles)] == ["", "S", "C", "T", "×"]
    draw_frame(scene, trial.frames, tmp_path / "frame.png")


def test_a_system_without_devices_or_chain_is_drawn(trial, tmp_path):
    scene = trial.scene._replace(polygons=trial.scene.polygons[:1])
    frames = trial.frames._replace(lit=trial.frames.lit[:, :0], role=np.zeros_like(trial.frames.role))
    draw_frame(scene, frames, tmp_path / "frame.png")


def test_a_chain_is_joined_from_neighbour_to_neighbour_and_not_over_gaps():
    line = np.array([[0.0, 0.0], [0.3, 0.0], [0.15, 0.0], [1.0, 0.0], [1.15, 0.0]])
    joined = sorted(tuple(sorted(segment[:, 0])) for segment in bands(line, 0.35))
    assert joined == [(0.0, 0.15), (0.15, 0.3), (1.0, 1.15)]
    assert bands(line[:1], 0.35) == []


@pytest.mark.parametrize("kind", [".mp4", ".gif"])
def test_a_movie_holds_every_frame(trial, tmp_path, monkeypatch, kind):
    if kind == ".mp4":
        ffmpeg = pytest.importorskip("imageio_ffmpeg")
    monkeypatch.setattr(movie, "suffix", lambda: kind)
    told = []
    path = draw_movie(
        trial.scene, trial.frames, tmp_path / "movie", progress=lambda done, total: told.append((done, total))
    )
    assert path == tmp_path / f"movie{kind}"
    assert told[-1] == (61, 61)
    assert len(list(tmp_path.iterdir())) == 1
    if kind == ".mp4":
        frames, seconds = ffmpeg.count_frames_and_secs(str(path))
        assert frames == 61
        assert seconds == pytest.approx(61 / 30, abs=0.05)
    else:
        from PIL import Image  # noqa: PLC0415

        with Image.open(path) as image:
            assert image.n_frames == 61
            assert image.size == (500, 400)


def test_a_timeline_is_drawn_for_one_and_for_many_robots(trial, tmp_path):
    timeline = random_walk.timeline(trial)
    draw_timeline(timeline, trial.scene.roles, tmp_path / "few.png", "twenty")
    many = random_walk.run(random_walk.configure(robots=80), 1)
    draw_timeline(random_walk.timeline(many), trial.scene.roles, tmp_path / "many.png", "eighty")
    nothing = timeline._replace(marks=(), counts=())
    draw_timeline(nothing, trial.scene.roles, tmp_path / "nothing.png", "nothing happened")
    assert imread(tmp_path / "many.png").shape[0] > imread(tmp_path / "few.png").shape[0]


def test_run_times_are_drawn_with_and_without_published_runs(tmp_path):
    reached = run_times([10.0, 20.0, None], [30.0] * 3)
    never = run_times([None, None], [30.0] * 2)
    draw_run_times({"one": reached, "two": never}, {"one": reached}, tmp_path / "both.png", published_label="x")
    draw_run_times({"one": reached, "two": never}, {}, tmp_path / "ours.png")
    assert imread(tmp_path / "both.png").shape == imread(tmp_path / "ours.png").shape == (700, 1000, 4)


def test_a_picture_that_cannot_be_written_is_named(trial, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(StoreError, match=r"cannot write .*frame\.png"):
        draw_frame(trial.scene, trial.frames, tmp_path / "file" / "frame.png")


def test_a_booth_with_an_opening_is_lit_inside():
    wall = 0.1
    bent = np.array([[0, 0], [3, 0], [3, 3], [0, 3], [0, 3 - wall], [3 - wall, 3 - wall], [3 - wall, wall], [0, wall]])
    assert area(bent) == pytest.approx(3 * wall * 2 + (3 - 2 * wall) * wall)
    assert area(hull(bent)) == pytest.approx(9)
    scene = Scene(
        (Polygon(np.array([[-2, -2], [5, -2], [5, 5], [-2, 5.0]]), "wall"), Polygon(bent, "red")),
        0.1,
        ("a",),
        1.0,
    )
    frames = Frames(
        np.array([0, 1]),
        *np.full((4, 2, 1), -1.0)[:3],
        np.zeros((2, 1), int),
        np.zeros((2, 1), int),
        np.array([[1], [0]]),
        np.array([1]),
    )
    picture = Overhead(scene)
    for index, lit in enumerate((True, False)):
        picture.show(frames, index)
        red, green, _ = pixel(picture, 0.6, 0.6)
        assert (red - green > 80) == lit
        red, green, _ = pixel(picture, 3 - wall / 2, 0.6)
        assert red - green > 80
