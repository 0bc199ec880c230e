"""``--set``: every field by its dotted or bare name, values parsed and validated, mistakes named."""

import pytest

import random_walk
from formicarium.commands.errors import UserError
from formicarium.commands.fields import fields, with_settings

PARAMETERS = random_walk.configure()


@pytest.mark.parametrize(
    ("setting", "path", "value"),
    [
        ("booth.dwell_time=4", ("booth", "dwell_time"), 4.0),
        ("dwell_time=4.5", ("booth", "dwell_time"), 4.5),
        ("swarm.speed= 0.02", ("swarm", "speed"), 0.02),
        ("repeats=false", ("trial", "repeats"), False),
        ("lamps=1,2", ("booth", "lamps"), (1, 2)),
        ("lamps=[3]", ("booth", "lamps"), (3,)),
    ],
)
def test_a_setting_changes_one_field(setting, path, value):
    found = with_settings(PARAMETERS, [setting])
    assert getattr(getattr(found, path[0]), path[1]) == value
    changed = {
        field.path
        for field in fields(type(found))
        if getattr(getattr(found, field.path.split(".")[0]), field.name)
        != getattr(getattr(PARAMETERS, field.path.split(".")[0]), field.name)
    }
    assert changed == {".".join(path)}


@pytest.mark.parametrize(
    ("setting", "words"),
    [
        ("dwel_time=4", ["dwel_time", "Did you mean", "dwell_time", "formicarium describe"]),
        ("zzz=4", ["zzz", "no parameter", "formicarium describe"]),
        ("speed=1", ["ambiguous", "swarm.speed", "booth.speed"]),
        ("booth=1", ["no parameter"]),
        ("dwell_time", ["expected name=value"]),
        ("dwell_time=soon", ["booth.dwell_time=soon", "valid number", "allowed: 0 to 60 s"]),
        ("dwell_time=", ["booth.dwell_time=", "valid number"]),
        ("dwell_time=61", ["booth.dwell_time=61", "less than or equal to 60", "allowed: 0 to 60 s"]),
        ("dwell_time=nan", ["booth.dwell_time=nan"]),
        ("robots=2.5", ["swarm.robots=2.5", "valid integer", "allowed: 1 to 200"]),
        ("duration=0", ["trial.duration=0", "allowed: above 0 s"]),
    ],
)
def test_a_wrong_setting_is_named_with_the_way_out(setting, words):
    with pytest.raises(UserError) as caught:
        with_settings(PARAMETERS, [setting])
    for word in words:
        assert word in str(caught.value)
