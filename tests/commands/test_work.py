"""A run as campaigns know it: what travels to a worker arrives unchanged, and edited sources are noticed."""

import math
import pickle
from functools import partial

import pytest

import random_walk
from formicarium.commands.work import ChangedSources, as_json, configuration_of, function_of

NAME = "random_walk:RANDOM_WALK"
PARAMETERS = random_walk.configure(robots=3)
SOURCES = configuration_of(random_walk.RANDOM_WALK, PARAMETERS).sources


def test_the_function_of_a_set_travels_to_other_processes():
    function = pickle.loads(pickle.dumps(function_of(NAME, PARAMETERS, {2: 5.0}, SOURCES)))
    assert function(1, None).row["robots"] == 3
    assert "frames" not in function(1, None).tables
    assert function(2, None).tables["frames"]["cycle"].to_pylist()[:2] == [0, 50]


def test_a_run_of_edited_sources_is_refused():
    with pytest.raises(ChangedSources, match="edited"):
        function_of(NAME, PARAMETERS, {}, "0123456789abcdef")(1, None)


def test_parameters_read_back_as_they_were_infinities_included():
    endless = random_walk.Parameters(trial=random_walk.Trials(duration=math.inf))
    assert random_walk.Parameters.model_validate_json(as_json(endless)) == endless


def test_a_system_of_a_reader_has_its_own_sources_in_its_identity():
    own = configuration_of(random_walk.RANDOM_WALK, PARAMETERS)
    inside = configuration_of(random_walk.RANDOM_WALK._replace(run=configuration_of), PARAMETERS)
    assert own.sources != inside.sources
    part = configuration_of(random_walk.RANDOM_WALK._replace(run=partial(random_walk.run, watch=None)), PARAMETERS)
    assert own.sources == part.sources
