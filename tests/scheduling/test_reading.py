"""Files become instances, and a wrong one gets a message that names the task and the reason."""

import json

import pytest

from formicarium.scheduling.generator import CLASSES, draw_instance
from formicarium.scheduling.instance import InstanceError
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
    for name, text in (("a.toml", "tasks = ["), ("a.json", "[1]"), ("a.csv", "name,x\na,1,2\n"), ("a.txt", "")):
        (tmp_path / name).write_text(text)
        with pytest.raises(InstanceError, match=name):
            read_instance(tmp_path / name, 5)
    with pytest.raises(InstanceError, match="cannot be read"):
        read_instance(tmp_path / "none.toml")


def test_drawn_instances_are_what_section_iv_b_says():
    for number, kind in CLASSES.items():
        instance = draw_instance(number, 0.1, 901)
        assert instance.robots == kind.robots and len(instance.tasks) == kind.tasks
        assert instance.region[2] ** 2 * 0.1 == pytest.approx(kind.robots * 3.141592653589793)  # (15)
        assert all(1 <= task.robots <= kind.most_robots for task in instance.tasks)
        assert all(task.duration in range(1, kind.longest + 1) for task in instance.tasks)
    assert draw_instance(1, 0.1, 901) == draw_instance(1, 0.1, 901) != draw_instance(1, 0.1, 902)
