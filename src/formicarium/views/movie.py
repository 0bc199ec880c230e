"""A trial as a movie: MP4 or WebM if imageio-ffmpeg is installed (the extra ``movie``), otherwise an animated GIF."""

from collections.abc import Callable, Iterator
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg

from formicarium.campaigns.files import replacing
from formicarium.trial.record import Frames, Scene
from formicarium.views.overhead import Overhead

FRAMES_PER_SECOND = 30
GIF_FRAMES_PER_SECOND = 10
GIF_FRAMES = 400  # the writer of Pillow keeps all of them in memory until the end
CODECS = {
    ".mp4": ("libx264", ("-crf", "21", "-preset", "veryfast", "-movflags", "+faststart")),
    ".webm": ("libvpx-vp9", ("-crf", "34", "-b:v", "0", "-deadline", "realtime", "-cpu-used", "6")),
}

Progress = Callable[[int, int], None]


def suffix() -> str:
    """Return the suffix of movies in this installation: ".mp4" or ".gif"."""
    return ".mp4" if find_spec("imageio_ffmpeg") else ".gif"


def draw_movie(
    scene: Scene, frames: Frames, path: Path, title: str = "", progress: Progress | None = None, kind: str | None = None
) -> Path:
    """Write all frames, 30 a second, to ``path``; return that path, with the suffix it was given.

    Frames are drawn and written one by one, so a long trial needs no more memory than a short one. A GIF
    gets at most 400 frames, at half the size.

    Args:
        scene: what does not move.
        frames: what does.
        path: the suffix is replaced.
        title: shown above the time.
        progress: told frames drawn and frames in all.
        kind: ".mp4", ".webm" or ".gif"; that of this installation if not given.

    Raises:
        StoreError: if the file cannot be written.
    """
    path = path.with_suffix(kind or suffix())
    write = _write_gif if path.suffix == ".gif" else _write_video
    with replacing(path) as temporary:
        write(scene, frames, temporary, title, progress or (lambda done, total: None))
    return path


def images(picture: Overhead, frames: Frames, chosen: np.ndarray, progress: Progress) -> Iterator[np.ndarray]:
    """Yield (height, width, 4) pictures of the chosen frames; each is overwritten by the next.

    Only what moves is drawn anew, over a copy of what does not.
    """
    canvas = picture.figure.canvas
    assert isinstance(canvas, FigureCanvasAgg)
    for artist in picture.moving:
        artist.set_animated(True)
    canvas.draw()
    background = canvas.copy_from_bbox(picture.figure.bbox)
    for done, index in enumerate(chosen, start=1):
        canvas.restore_region(background)
        picture.show(frames, int(index))
        for artist in picture.moving:
            picture.figure.draw_artist(artist)
        yield np.asarray(canvas.buffer_rgba())
        progress(done, len(chosen))


def _write_video(scene: Scene, frames: Frames, path: Path, title: str, progress: Progress) -> None:
    from imageio_ffmpeg import write_frames

    picture = Overhead(scene, title)
    size = tuple(int(side) for side in picture.figure.bbox.size)
    codec, options = CODECS[path.suffix]
    writer = write_frames(
        str(path),
        size,
        pix_fmt_in="rgba",
        fps=FRAMES_PER_SECOND,
        codec=codec,
        quality=None,
        macro_block_size=2,
        output_params=list(options),
        ffmpeg_log_level="error",
    )
    writer.send(None)
    try:
        for image in images(picture, frames, np.arange(len(frames.cycle)), progress):
            writer.send(np.ascontiguousarray(image))
    finally:
        writer.close()


def _write_gif(scene: Scene, frames: Frames, path: Path, title: str, progress: Progress) -> None:
    from PIL import Image

    picture = Overhead(scene, title)
    picture.figure.set_dpi(picture.figure.dpi / 2)
    count = len(frames.cycle)
    chosen = np.unique(np.linspace(0, count - 1, min(count, GIF_FRAMES)).astype(int))
    pictures = (
        Image.fromarray(image).convert("RGB").quantize(64, dither=Image.Dither.NONE)
        for image in images(picture, frames, chosen, progress)
    )
    first = next(pictures)
    first.save(
        path,
        format="GIF",
        save_all=True,
        append_images=pictures,
        loop=0,
        duration=1000 // GIF_FRAMES_PER_SECOND,
    )
