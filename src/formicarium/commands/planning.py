"""What ``formicarium schedule`` does: read, search with bound and gap on the screen, judge, show and write."""

from pathlib import Path
from typing import Literal, NamedTuple

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from formicarium.campaigns.files import make_folder, write_json
from formicarium.commands.folders import named_folder
from formicarium.commands.progress import bars
from formicarium.scheduling.checker import check
from formicarium.scheduling.clock import News
from formicarium.scheduling.deployment import find_place
from formicarium.scheduling.generator import draw_instance
from formicarium.scheduling.instance import Instance, InstanceError
from formicarium.scheduling.reach import Reach
from formicarium.scheduling.reading import as_content, read_instance
from formicarium.scheduling.schedule import Answer, as_plain, first_trip
from formicarium.scheduling.solver import solve

SAMPLE = (2, 0.05, 900, 8)  # arguments of draw_instance: small, and its search comes by most of what is compiled


class Wish(NamedTuple):
    """How a person wants it; see ``schedule`` for the meaning."""

    file: str
    objective: Literal["time", "travel"]
    reach: Literal["printed", "inscribed", "euclid"]
    time_limit: float
    robots: int | None
    charge_first: bool
    out: str | None


def plan(wish: Wish) -> int:
    """Schedule what a file asks for and return the exit code.

    Raises:
        InstanceError: if the file is no instance that can be scheduled.
        StoreError: if the results cannot be written.
    """
    from formicarium.views.schedules import draw_gantt, draw_map

    instance = read_instance(wish.file, wish.robots)
    folder = Path(wish.out) if wish.out else named_folder("schedule", instance.name, wish.objective, wish.reach)
    make_folder(folder)  # what cannot be written is told before the search
    try:
        answer = _search(instance, wish)
    except InstanceError as error:
        raise InstanceError(f"{wish.file}: {error}") from error
    assert answer.schedule is not None  # every valid instance has one: a slot a task
    verdict = check(instance, answer.schedule, wish.reach, answer.time_limit)
    if verdict.faults:
        raise AssertionError(f"the checker refuses the schedule: {'; '.join(verdict.faults)}")
    _show(instance, answer, wish)
    content = as_plain(instance, answer, Reach[wish.reach.upper()], wish.charge_first)
    write_json(folder / "schedule.json", content | {"asked": as_content(instance)})
    written = [folder / "schedule.json"]
    written += [draw_map(instance, answer, folder / "map.png"), draw_gantt(instance, answer, folder / "gantt.png")]
    for path in written:
        Console().print(f"results   {escape(str(path))}", highlight=False, soft_wrap=True)
    return 130 if answer.ended == "interrupted" else 0


def _search(instance: Instance, wish: Wish) -> Answer:
    trouble = Console(stderr=True)
    with bars(trouble) as shown:
        new = find_place.is_new()
        line = shown.add_task("compiling, once" if new else "first fit", total=None, words="")
        if new:  # else it would use up the time limit
            solve(draw_instance(*SAMPLE), wish.objective)

        def told(news: News) -> None:
            gap = f"{(news.value - news.bound) / news.value:.1%}" if news.value else "none"
            words = f"best {news.value:.6g}, bound {news.bound:.6g}, gap {gap}"
            shown.update(line, description=news.part, words=words)

        return solve(instance, wish.objective, wish.reach, wish.time_limit, charge_first=wish.charge_first, told=told)


def _show(instance: Instance, answer: Answer, wish: Wish) -> None:
    screen = Console()
    schedule = answer.schedule
    assert schedule is not None
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for title in ("slot", "from", "to", "x, m", "y, m", "robots", "tasks (relays)"):
        table.add_column(title, justify="left" if title.startswith("tasks") else "right")
    robots = {task.name: task.robots for task in instance.tasks}
    begin = 0.0
    for number, slot in enumerate(schedule.slots, 1):
        used = 1 + sum(arm.relays + robots[arm.task] for arm in slot.arms)
        tasks = ", ".join(f"{arm.task} ({arm.relays})" for arm in slot.arms)
        numbers = (f"{begin:g}", f"{begin + slot.duration:g}", f"{slot.x:.2f}", f"{slot.y:.2f}", str(used))
        table.add_row(str(number), *numbers, escape(tasks))
        begin += slot.duration
    screen.print(table)
    what = "completion time" if wish.objective == "time" else "dislocation"
    unit = "" if wish.objective == "time" else " m"
    known = {
        "proven": "proven best",
        "time limit": f"the time limit came: {answer.excess_in_words}",
        "gave up": f"{answer.excess_in_words}; it has tried what it knows, as far as the time allows",
        "interrupted": f"interrupted: {answer.excess_in_words}",
    }[answer.ended]
    screen.print(
        f"\n[bold]{what} {answer.value:.6g}{unit}[/bold], lower bound {answer.bound:.6g} ({answer.proof}): {known}; "
        f"{answer.seconds:.1f} s",
        highlight=False,
    )
    outward = f" after {first_trip(instance, schedule):.2f} m from the start" if wish.charge_first else ""
    screen.print(
        f"in all: time {schedule.time:g}, trip {schedule.trip:.2f} m{outward}, {schedule.relays} relays; "
        f"{instance.robots} robots, one of them the master",
        highlight=False,
    )
    if answer.time_limit is not None and answer.time_bound < answer.time_limit:
        screen.print(
            f"it may be that less time does: at least {answer.time_bound:g} is needed; more time for the search, or "
            "--objective time, would tell",
            highlight=False,
        )
