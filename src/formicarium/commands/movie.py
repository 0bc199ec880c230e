"""``formicarium movie RUN``: a stored run as a movie, a picture or one file of HTML."""

from pathlib import Path

from formicarium.commands.whole import Whole


def movie(
    run: str,
    /,
    *,
    out: str | None = None,
    seed: Whole | None = None,
    every: float | None = None,
    at: float | None = None,
) -> int:
    """Make a movie, a snapshot or a page of its own from a stored run.

    The suffix of --out says what: .mp4, .gif or .webm for a movie, 30 pictures
    a second; .png or .svg for one picture; .html for one file with the whole
    replay that opens anywhere, without network.

    Examples:

        formicarium movie formicarium-results/mark-i3-1a2b3c4d --seed 7
        formicarium movie seed-7.recording --out replay.html
        formicarium movie seed-7.recording --out figure.svg --at 300

    Parameters
    ----------
    run
        A recording, or a folder of results.
    out
        File to write; movie-seed-N.mp4 (.gif without the extra "movie") if not given.
    seed
        Seed of the run, if the folder holds several.
    every
        Simulated seconds between two pictures; as recorded if not given.
    at
        Simulated seconds at which a snapshot is taken; the last frame if not given.
    """
    from formicarium.commands.filming import make_movie

    print(make_movie(run, seed, None if out is None else Path(out), every, at))
    return 0
