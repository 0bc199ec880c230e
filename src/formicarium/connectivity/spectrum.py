"""What a node of Wave reads out of its own signal: the second peak of its spectrum (ST-11)."""

import numpy as np

MOST_AT_ONCE = 2_000_000  # samples whose spectra are taken together


def read_out(signals: np.ndarray, ends: np.ndarray, window: int, interpolated: bool) -> np.ndarray:
    """Return angular frequencies, radians per iteration, 0 where a spectrum has fewer than two peaks.

    Each column is read by itself: a node knows its own samples only.

    Args:
        signals: (N, K) samples of K nodes.
        ends: (S,) how many samples there are at each read-out, ascending; the last ``window`` of them count.
        window: samples.
        interpolated: taper the samples and look for the peak between bins.

    Returns:
        (S, K).
    """
    found = np.zeros((len(ends), signals.shape[1]))
    short = np.flatnonzero(ends < window)
    for k in short:
        found[k] = frequency(signals[: ends[k]].T, interpolated)
    full = np.flatnonzero(ends >= window)
    if not len(full):
        return found
    windows = np.lib.stride_tricks.sliding_window_view(signals, window, axis=0)
    step = max(1, MOST_AT_ONCE // (window * signals.shape[1]))
    for first in range(0, len(full), step):
        some = full[first : first + step]
        found[some] = frequency(windows[ends[some] - window], interpolated)
    return found


def frequency(samples: np.ndarray, interpolated: bool) -> np.ndarray:
    """Return the angular frequency of the second peak, ascending, of each spectrum.

    Args:
        samples: (..., n).
        interpolated: as in ``read_out``.
    """
    n = samples.shape[-1]
    taper = 0.5 - 0.5 * np.cos(2.0 * np.pi * np.arange(n) / n) if interpolated else 1.0
    magnitudes = np.abs(np.fft.rfft(samples * taper)[..., : n // 2])
    place = second_peak(magnitudes)
    offset = np.where(place > 0, _offset(magnitudes, place), 0.0) if interpolated else 0.0
    return 2.0 * np.pi * (place + offset) / n


def second_peak(magnitudes: np.ndarray) -> np.ndarray:
    """Return the place of the second strict local maximum, 0 if there are fewer; ends count by their one neighbour."""
    if magnitudes.shape[-1] < 2:
        return np.zeros(magnitudes.shape[:-1], int)
    rising = magnitudes[..., 1:] > magnitudes[..., :-1]
    falling = magnitudes[..., 1:] < magnitudes[..., :-1]
    edge = np.ones((*magnitudes.shape[:-1], 1), bool)
    peaks = np.concatenate([edge, rising], axis=-1) & np.concatenate([falling, edge], axis=-1)
    second = peaks & (np.cumsum(peaks, axis=-1) == 2)
    return second.argmax(axis=-1)


def _offset(magnitudes: np.ndarray, place: np.ndarray) -> np.ndarray:
    """Return how far a peak is from its bin, -0.5..0.5, after a Hann taper (Grandke, IEEE Trans. IM 32, 1983).

    With a the ratio of the larger neighbour to the peak: (2 a - 1) / (a + 1) towards that neighbour.
    """
    last = magnitudes.shape[-1] - 1
    before, here, after = (
        np.take_along_axis(magnitudes, np.clip(place + k, 0, last)[..., None], axis=-1)[..., 0] for k in (-1, 0, 1)
    )
    ratio = np.maximum(before, after) / np.where(here > 0.0, here, 1.0)
    return np.clip(np.sign(after - before) * (2.0 * ratio - 1.0) / (ratio + 1.0), -0.5, 0.5)
