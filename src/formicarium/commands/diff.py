"""``formicarium diff RUN_A RUN_B``: where two runs part."""

from formicarium.commands.whole import Whole


def diff(run_a: str, run_b: str, /, *, seed_a: Whole | None = None, seed_b: Whole | None = None) -> int:
    """Name the first cycle, robot and field in which two runs differ.

    Both are simulated again, cycle by cycle where they part; if that is not
    possible their recorded frames are compared. Exit code 0 if they are the
    same, 1 if not.

    Examples:

        formicarium diff seed-7.recording seed-7-2.recording
        formicarium diff formicarium-results/a formicarium-results/b --seed-a 1 --seed-b 2

    Parameters
    ----------
    run_a
        A recording, or a folder of results.
    run_b
        Another one.
    seed_a
        Seed of the first run, if its folder holds several.
    seed_b
        Seed of the second run, if its folder holds several.
    """
    from formicarium.commands.comparing import compare

    return compare(run_a, seed_a, run_b, seed_b)
