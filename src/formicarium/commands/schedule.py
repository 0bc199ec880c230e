"""``formicarium schedule FILE``: when a connected swarm does which task, from where, and how good that is."""

from typing import Annotated, Literal

from cyclopts import Parameter

from formicarium.commands.whole import Whole

Switch = Annotated[bool, Parameter(negative="")]


def schedule(
    file: str,
    /,
    *,
    objective: Literal["time", "travel"] = "travel",
    reach: Literal["printed", "inscribed", "euclid"] = "inscribed",
    time_limit: float = 60.0,
    robots: Whole | None = None,
    first_hop_free: Switch = False,
    out: str | None = None,
) -> int:
    """Schedule tasks for a swarm that must stay connected, and prove how good the schedule is.

    The file lists teams and tasks (TOML or JSON), or tasks alone, one a line (CSV):

        name,x,y,robots,duration        [[teams]]             [[tasks]]
        well,2.5,7.0,3,1                robots = 12           name = "well"
        gate,9.0,1.5,2,4                abilities = ["dig"]   x = 2.5

    More fields of a task: needs (capabilities), after (tasks that come first; in a CSV
    parted by semicolons). Of the file: region, start, spacing (one hop, m), paths
    (disjoint ways to each task). The guide: docs/guides/scheduling.md. Needs the extra "scheduling".

    Leaves schedule.json, map.png and gantt.png. Ctrl-C ends the search with the best
    schedule so far. Exit code 0 if a schedule was found, 130 after Ctrl-C.

    Examples:

        formicarium schedule tasks.toml
        formicarium schedule tasks.csv --robots 20 --objective time
        formicarium schedule tasks.json --reach euclid --time-limit 300 --out plan

    Parameters
    ----------
    file
        The instance: .toml, .json or .csv.
    objective
        time: the least completion time. travel: the least movement and the shortest arms
        among the schedules of least completion time.
    reach
        How far an arm reaches: inscribed (an octagon inside the radio's circle: never too
        far), euclid (the circle itself), printed (the paper's octagon: up to 8 % too far).
    time_limit
        Seconds of search; after that the best schedule so far and its gap.
    robots
        Size of the swarm, if the file lists no teams: all can do everything.
    first_hop_free
        Do not count the way from the start to the first deployment point, as in the paper.
    out
        Folder of the results; formicarium-results/schedule-NAME-OBJECTIVE-REACH if not given.
    """
    import math

    from formicarium.commands.errors import UserError
    from formicarium.commands.extras import require

    if not (math.isfinite(time_limit) and time_limit > 0):
        raise UserError(f"--time-limit {time_limit:g}: must be a time in seconds above 0")
    require("scheduling", "formicarium schedule")
    from formicarium.commands.planning import Wish, plan

    return plan(Wish(file, objective, reach, time_limit, robots, not first_hop_free, out))
