"""Files become instances, and a wrong one gets a message that names the task and the reason."""

import json
import re

import pytest

from formicarium.scheduling.generator import CLASSES, draw_instance
from formicarium.scheduling.instance import InstanceError
from formicarium.scheduling.problem import problem_of
from formicarium.scheduling.reach import Reach
from formicarium.scheduling.reading import as_content, instance_of, read_instance

GOOD = {
    "teams": [{"robots": 5}, {"robots": 2, "abilities": ["dig"]}],
    "tasks": [{"name": "a", "x": 1, "y": 2}, {"name": "b", "x": 3, "y": 4, "needs": ["dig"], "after": ["a"]}],
}


def refused(changes):
    content = json.loads(json.dumps(GOOD))
    for path, value in changes.items():
        *way, last = path.split(".")
        place = content
        for step in way:
            place = place[int(step)] if isinstance(place, list) else place[step]
        place[last] = value
    with pytest.raises(InstanceError) as error:
        instance_of(content, "file.toml")
    assert str(error.value).startswith("file.toml: ")
    return str(error.value)


def test_content_written_is_content_read():
    instance = draw_instance(3, 0.1, 900)
    assert instance_of(json.loads(json.dumps(as_content(instance)))) == instance


@pytest.mark.parametrize(
    "changes, said",
    [
        ({"tasks.1.needs": ["fly"]}, "task 'b': nobody can do it: no robot has 'fly'"),
        ({"tasks.1.robots": 3}, "task 'b': needs 3 robots with 'dig', there are 2"),
        ({"tasks.0.robots": 7}, "task 'a': needs 7 robots, but only 6 of 7 can leave"),
        ({"tasks.0.x": float("nan")}, "task 'a': place (nan, 2.0) is no place"),
        ({"tasks.0.duration": float("inf")}, "task 'a': duration = inf"),
        ({"tasks.0.name": "b"}, "task 'b' is there twice"),
        ({"tasks.0.after": ["b"]}, "priorities go in a circle: 'a' before 'b' before 'a'"),
        ({"tasks.0.after": ["c"]}, "there is no such task"),
        ({"tasks.0.x": "here"}, "task 'a': x = 'here'"),
        ({"tasks.0.colour": "red"}, "task 'a': colour: there is no such field"),
        ({"tasks": []}, "there is no task"),
        ({"teams": []}, "says nothing of the robots"),
        ({"spacing": 0}, "spacing = 0.0"),
        ({"paths": 0}, "paths = 0"),
        ({"tasks.0.x": True}, "task 'a': x = True"),
        ({"teams.0.robots": "5"}, "teams[0].robots = '5'"),
        ({"tasks.0.duration": 1e300}, "task 'a': duration = 1e+300: must be from 1e-06 to 1e+09"),
        ({"tasks.0.name": "a\0b"}, "characters that cannot be printed"),
        ({"tasks.0.x": 1e300}, "at most 10000 hops"),
        ({"teams.0.robots": 10**20}, "at most 1000000 can be scheduled"),
        ({"paths": 10**20}, "paths = 100000000000000000000"),
        ({"region": [0, 0, 2, 9]}, "task 'b': place (3, 4) is outside the region"),
    ],
)
def test_a_wrong_instance_is_refused_with_the_task_and_the_reason(changes, said):
    assert said in refused(changes)


@pytest.mark.parametrize("name", ["empty.toml", "empty.json", "empty.csv"])
def test_an_empty_file_is_called_empty(tmp_path, name):
    (tmp_path / name).write_text("")
    with pytest.raises(InstanceError, match=r"is empty: list the tasks"):
        read_instance(tmp_path / name)


def test_other_files_are_refused(tmp_path):
    (tmp_path / "wide.csv").write_text("name,x,y\nt,1,2\n", encoding="utf-16")
    with pytest.raises(InstanceError, match="save it as UTF-8"):
        read_instance(tmp_path / "wide.csv", 5)
    for name, text in (("a.toml", "tasks = ["), ("a.json", "[1]"), ("a.csv", "name,x\na,1,2\n"), ("a.txt", "")):
        (tmp_path / name).write_text(text)
        with pytest.raises(InstanceError, match=name):
            read_instance(tmp_path / name, 5)
    with pytest.raises(InstanceError, match="cannot be read"):
        read_instance(tmp_path / "none.toml")


def read(folder, name, text):
    (folder / name).write_bytes(text.encode())
    return read_instance(folder / name, 5)


def test_what_spreadsheets_write_is_read(tmp_path):
    """A byte order mark, names with spaces parted by semicolons, empty fields at the ends, empty lines."""
    lines = '\ufeffname,x,y,after,\r\nbig job,1,2,\r\nb,2,2\r\n,,,,\r\nlast,3,3,"big job; b",,\r\n'
    instance = read(tmp_path, "a.csv", lines)
    assert instance.priorities == (("big job", "last"), ("b", "last"))
    assert read(tmp_path, "a.toml", '\ufeff[[tasks]]\nname = "t"\nx = 1\ny = 1\n').tasks[0].name == "t"


@pytest.mark.parametrize(("name", "text", "said"), [
    ("a.json", '{"tasks": [{"name": "t", "x": 1, "y": 2}], "tasks": []}', "'tasks' is given twice"),
    ("a.csv", "name,x,y,x\nt,1,2,3\n", "the column 'x' is there twice"),
    ("a.csv", "name,x,y\nt,1,2\nu,1_0,2\n", "line 3: x = '1_0'"),
    ("a.csv", 'name,x,y\n"t\nt",1,2\n\nu,,2,3\n', "line 5 has more fields"),
    ("a.csv", "name;x;y\nt;1;2\n", "parted by ';': save it with commas"),
    ("a.csv", "name\tx\ty\nt\t1\t2\n", "parted by '\\t'"),
    ("a.csv", "name,x,y,,robots\nt,1,2,,3\n", "a column has no name"),
    ("a.csv", "name,x,y\nt,nan,2\n", "a.csv: task 't': place (nan, 2.0) is no place"),
    ("a.toml", '[[tasks]]\nname = "t"\nx = 1\ny = 1\nrobots = 0x' + 5000 * "f", "at most 1e+300"),
    ("a.json", '{"a[b": 1, "tasks": []}', "a[b: there is no such field"),
    ("a.json", '{"": 1, "tasks": []}', "'': there is no such field"),
    ("a.json", '{"tasks": "' + 500 * "x" + '"}', "xxx...xxx"),
    ("a.json", '{"a": ' + "[" * 100_000, "nested too deeply"),
])  # fmt: skip
def test_what_would_be_misread_is_refused(tmp_path, name, text, said):
    with pytest.raises(InstanceError, match=re.escape(said)):
        read(tmp_path, name, text)


def test_a_dozen_groups_of_teams_are_the_most():
    teams = [{"robots": 2, "abilities": [f"c{k}"]} for k in range(13)]
    tasks = [{"name": f"t{k}", "x": k, "y": 0, "needs": [f"c{k}"]} for k in range(13)]
    with pytest.raises(InstanceError, match="13 different groups of teams, at most 12"):
        problem_of(instance_of({"teams": teams, "tasks": tasks}), Reach.PRINTED)


def test_drawn_instances_are_what_section_iv_b_says():
    for number, kind in CLASSES.items():
        instance = draw_instance(number, 0.1, 901)
        assert instance.robots == kind.robots and len(instance.tasks) == kind.tasks
        assert instance.region[2] ** 2 * 0.1 == pytest.approx(kind.robots * 3.141592653589793)  # (15)
        assert all(1 <= task.robots <= kind.most_robots for task in instance.tasks)
        assert all(task.duration in range(1, kind.longest + 1) for task in instance.tasks)
    assert draw_instance(1, 0.1, 901) == draw_instance(1, 0.1, 901) != draw_instance(1, 0.1, 902)
