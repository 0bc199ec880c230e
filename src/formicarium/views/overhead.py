"""The arena from above: what does not move is drawn once, robots and lights are moved from frame to frame."""

import numpy as np
from matplotlib.collections import EllipseCollection, LineCollection, PathCollection, PolyCollection
from matplotlib.colors import to_rgba
from matplotlib.path import Path
from matplotlib.text import Text
from matplotlib.transforms import AffineDeltaTransform

from formicarium.trial.record import FLOOR as FLOOR_SHADE
from formicarium.trial.record import OBJECT, Frames, Scene
from formicarium.views.chain import bands
from formicarium.views.figure import new_figure
from formicarium.views.glyphs import glyph
from formicarium.views.outlines import area, hull
from formicarium.views.style import FLOOR, INK, NAMED, PALE_INK, PAPER, clock, colour, role_styles

WIDTH, HEIGHT = 8.0, 6.4  # inches
MARGIN = 0.06  # metres around the arena
BOX = 0.45 * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1)])  # what a robot carries, in radii of the robot


class Overhead:
    """A figure of one frame that can be turned to another frame."""

    def __init__(self, scene: Scene, title: str = ""):
        """Draw the arena, the devices and the legend."""
        self.scene = scene
        self.styles = role_styles(scene.roles)
        self.figure = new_figure(WIDTH, HEIGHT)
        self.axes = self.figure.add_axes((0.0, 0.0, HEIGHT / WIDTH, 1.0))
        self.side = self.figure.add_axes((HEIGHT / WIDTH, 0.0, 1 - HEIGHT / WIDTH, 1.0))
        for axes in (self.axes, self.side):
            axes.set_axis_off()
        self._fills = np.array([_rgba(style.fill) for style in self.styles])
        self._inks = np.array([_rgba(style.ink) for style in self.styles])
        self._draw_arena()
        self._draw_side(title)
        self._make_moving()

    @property
    def moving(self) -> list:
        """Artists that change from frame to frame, in drawing order."""
        return [
            self.booths,
            self.booth_letters,
            self.chain,
            self.bodies,
            self.headings,
            self.letters,
            self.loads,
            self.time,
            *self.counts,
        ]

    def show(self, frames: Frames, index: int) -> None:
        """Turn the figure to frame number ``index``."""
        x, y, heading = frames.x[index], frames.y[index], frames.heading[index]
        role = frames.role[index]
        places = np.column_stack([x, y])
        forward = np.column_stack([np.cos(heading), np.sin(heading)])
        radius = self.scene.radius
        ends = np.stack([places + 0.85 * radius * forward, places + 1.45 * radius * forward], axis=1)
        self.bodies.set(offsets=places, facecolors=self._fills[role])
        self.headings.set_segments(list(ends))
        self.letters.set(offsets=places, facecolors=self._inks[role])
        self.letters.set_paths([self._letter(*pair) for pair in zip(role, frames.carried[index])])
        loaded = (frames.carried[index] > 0) & bool(self.scene.load)
        self.loads.set_offsets((places - radius * forward)[loaded])
        self.chain.set_segments(self._links(frames, index, places))
        self._light(frames.lit[index])
        self.time.set_text(clock(frames.cycle[index] * self.scene.cycle_time))
        for text, number in zip(self.counts, np.bincount(role, minlength=len(self.styles))):
            text.set_text(str(number))

    def _links(self, frames: Frames, index: int, places: np.ndarray) -> list[np.ndarray]:
        if frames.joined is None:
            chained = np.array([style.chained for style in self.styles])[frames.role[index]]
            return bands(places[chained], 10 * self.scene.radius)
        other = frames.joined[index]
        pairs = np.stack([places, places[other]], axis=1)[other >= 0]
        return list(pairs[np.hypot(*(pairs[:, 0] - pairs[:, 1]).T) < self.scene.longest_link])

    def _letter(self, role: int, carried: int):
        text = self.styles[role].letter or (str(carried) if carried and not self.scene.load else "")
        return glyph(text, self.scene.radius * 0.8)

    def _light(self, lit: np.ndarray) -> None:
        shown = np.zeros((len(self._booth_colours), 1), int)
        shown[: len(lit), 0] = lit[: len(shown)]
        fills = np.where(shown == 2, _rgba(NAMED["red"]), self._booth_colours)
        self.booths.set(facecolors=np.where(shown > 0, fills, _rgba(PAPER)))
        self.booth_letters.set(facecolors=np.where(shown > 0, _rgba(PAPER), self._booth_colours))

    def _draw_arena(self) -> None:
        points = np.concatenate([polygon.points for polygon in self.scene.polygons])
        low, high = points.min(axis=0) - MARGIN, points.max(axis=0) + MARGIN
        half = (high - low).max() / 2
        middle = (low + high) / 2
        self.axes.set(
            xlim=(middle[0] - half, middle[0] + half),
            ylim=(middle[1] - half, middle[1] + half),
            aspect="equal",
        )
        for polygon in self.scene.polygons:
            if polygon.colour.startswith(FLOOR_SHADE):
                # Paled, so that robots and their letters stay readable on it.
                shade = str(0.55 + 0.45 * float(polygon.colour.removeprefix(FLOOR_SHADE)))
                self.axes.fill(*polygon.points.T, facecolor=shade, linewidth=0)
            if polygon.colour == "wall":
                outer = area(polygon.points) > 0.5 * half * half  # the arena itself, not a box in it
                self.axes.fill(
                    *polygon.points.T,
                    facecolor=FLOOR if outer else NAMED["wall"],
                    edgecolor=NAMED["wall"],
                    linewidth=2.5 if outer else 0.5,
                    joinstyle="round",
                )
        length = 0.5 if half > 0.6 else 0.1
        start = middle - half + 0.05 * half
        self.axes.plot([start[0], start[0] + length], [start[1]] * 2, color=INK, linewidth=2)
        self.axes.text(start[0] + length / 2, start[1] + 0.02 * half, f"{length} m", ha="center", size=10, color=INK)

    def _make_moving(self) -> None:
        devices = self.scene.devices
        self._booth_colours = np.array([_rgba(colour(device.colour)) for device in devices]).reshape(-1, 4)
        in_metres = AffineDeltaTransform(self.axes.transData)  # type: ignore[arg-type]
        outlines = [hull(device.points) for device in devices]
        self.booths = PolyCollection(outlines, edgecolors=self._booth_colours, linewidths=2.5, zorder=2)
        # A booth with an opening is a bent wall: solid in its colour, its inside lit or dark.
        bent = [area(device.points) < 0.9 * area(outline) for device, outline in zip(devices, outlines)]
        walls = [device.points for device, is_bent in zip(devices, bent) if is_bent]
        self.axes.add_collection(
            PolyCollection(walls, facecolors=self._booth_colours[np.array(bent, bool)], zorder=2.5),
            autolim=False,
        )
        self.booth_letters = PathCollection(
            [glyph(device.colour[:1].upper() * (device.colour != OBJECT), self.scene.radius) for device in devices],
            offsets=[(o.min(axis=0) + o.max(axis=0)) / 2 for o in outlines] or np.zeros((0, 2)),
            offset_transform=self.axes.transData,
            transform=in_metres,
            linewidths=0,
            zorder=3,
        )
        self.chain = LineCollection([], colors="#c9a400", linewidths=7, alpha=0.35, capstyle="round", zorder=3)
        self.bodies = EllipseCollection(
            [2 * self.scene.radius],
            [2 * self.scene.radius],
            [0],
            units="xy",
            offsets=np.zeros((0, 2)),
            offset_transform=self.axes.transData,
            edgecolors=INK,
            linewidths=0.9,
            zorder=4,
        )
        self.headings = LineCollection([], colors=INK, linewidths=2.4, capstyle="round", zorder=5)
        self.letters = PathCollection(
            [],
            offsets=np.zeros((0, 2)),
            offset_transform=self.axes.transData,
            transform=in_metres,
            linewidths=0,
            zorder=6,
        )
        self.loads = PathCollection(
            [Path(BOX * self.scene.radius)],
            offsets=np.zeros((0, 2)),
            offset_transform=self.axes.transData,
            facecolors=NAMED[OBJECT],
            edgecolors=INK,
            linewidths=0.8,
            zorder=7,
        )
        artists = (self.booths, self.booth_letters, self.chain, self.bodies, self.headings, self.letters, self.loads)
        for artist in artists:
            self.axes.add_collection(artist, autolim=False)
        self.loads.set_transform(in_metres)
        self.letters.set_transform(in_metres)
        self.booth_letters.set_transform(in_metres)

    def _draw_side(self, title: str) -> None:
        self.side.set(xlim=(0, 1.6), ylim=(0, 6.4), aspect="equal")
        self.side.text(0.05, 5.92, title, size=10.5, color=PALE_INK, va="bottom", linespacing=1.4)
        self.time = self.side.text(0.05, 5.55, "", size=24, color=INK, va="center", weight="bold")
        self.side.text(0.05, 5.18, "minutes : seconds", size=9, color=PALE_INK, va="center")
        self.counts: list[Text] = []
        for row, (name, style) in enumerate(zip(self.scene.roles, self.styles)):
            self._legend_row(4.6 - 0.42 * row, name, style)
        below = 4.6 - 0.42 * len(self.styles)
        number = f"brown box: {self.scene.load}" if self.scene.load else f"number: {self.scene.number}"
        self.side.text(
            0.05,
            below - 0.05,
            f"{number}\n\nfilled: lit or reached\nhollow: dark or not",
            size=9,
            color=PALE_INK,
            va="top",
            linespacing=1.5,
        )

    def _legend_row(self, height: float, name: str, style) -> None:
        marker = {"marker": "o", "markersize": 17, "markerfacecolor": style.fill, "markeredgecolor": INK}
        self.side.plot([0.2], [height], linestyle="", **marker)
        self.side.text(
            0.2,
            height - 0.01,
            style.letter or "1",
            size=10,
            color=style.ink,
            weight="bold",
            ha="center",
            va="center",
        )
        self.side.text(0.42, height, name, size=11, color=INK, va="center")
        self.counts.append(self.side.text(1.45, height, "", size=11, color=INK, va="center", ha="right"))


def _rgba(name: str) -> tuple[float, float, float, float]:
    return to_rgba(name)
