"""A set: produced once, loaded afterwards, the same for every number of workers, never torn."""

import pytest

import counting
from formicarium.campaigns import table
from formicarium.campaigns.configuration import Configuration
from formicarium.campaigns.files import StoreError
from formicarium.campaigns.runner import run_set
from formicarium.campaigns.store import Store

CONFIGURATION = Configuration("counting", {"group": {"value": 1}}, "sources", "0")
WANTED = {"numbers": {}}


def run(folder, seeds, function=None, **options):
    with Store(folder, CONFIGURATION) as store:
        report = run_set(function or counting.function(), seeds, store, wanted=lambda seed: WANTED, **options)
        return report, store.rows_of(seeds)


def result_files(folder):
    apart = {"timings.parquet", "provenance.json"}
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file() and path.name not in apart
    }


def test_result_files_are_the_same_bytes_for_every_number_of_workers(tmp_path):
    for workers in (1, 2, 3):
        report, rows = run(tmp_path / str(workers), range(7), workers=workers)
        assert report.produced == tuple(range(7))
        assert [row["square"] for row in rows] == [k * k for k in range(7)]
    assert result_files(tmp_path / "1") == result_files(tmp_path / "2") == result_files(tmp_path / "3")


def test_a_set_made_in_pieces_is_the_set_made_at_once(tmp_path):
    run(tmp_path / "whole", range(6), workers=1)
    for seeds in ([4, 2], [0], range(6)):
        run(tmp_path / "pieces", seeds, workers=1)
    assert result_files(tmp_path / "whole") == result_files(tmp_path / "pieces")


def test_what_is_there_is_loaded(tmp_path):
    told = []
    run(tmp_path, range(3), workers=1)
    report, rows = run(tmp_path, range(5), workers=1, progress=lambda done, total: told.append((done, total)))
    assert report.loaded == (0, 1, 2)
    assert report.produced == (3, 4)
    assert told == [(3, 5), (4, 5), (5, 5)]
    assert len(rows) == 5


def test_a_lost_table_is_produced_again(tmp_path):
    run(tmp_path, range(3), workers=1)
    before = result_files(tmp_path)
    (tmp_path / "numbers" / "seed-1.parquet").unlink()
    report, _ = run(tmp_path, range(3), workers=1)
    assert report.produced == (1,)
    assert result_files(tmp_path) == before


@pytest.mark.parametrize("workers", [1, 2])
def test_a_failing_run_is_reported_and_the_others_go_on(tmp_path, workers):
    report, rows = run(tmp_path, range(5), counting.function(failing=2), workers=workers)
    assert report.produced == (0, 1, 3, 4)
    assert "ArithmeticError: 2 cannot be squared" in report.failures[2]
    assert "in squares" in report.failures[2]
    assert (tmp_path / "failures" / "seed-2.txt").read_text().strip() == report.failures[2].strip()
    assert [row["seed"] for row in rows] == [0, 1, 3, 4]
    report, rows = run(tmp_path, range(5), workers=workers)
    assert report.produced == (2,)
    assert not (tmp_path / "failures" / "seed-2.txt").exists()


def test_a_worker_that_dies_costs_one_run(tmp_path):
    report, _rows = run(tmp_path, range(6), counting.function(dying=3), workers=2)
    assert report.produced == (0, 1, 2, 4, 5)
    assert "exit code -9" in report.failures[3]


def test_a_run_that_does_not_repeat_is_a_failure(tmp_path):
    run(tmp_path, range(2), workers=1)
    with Store(tmp_path, CONFIGURATION) as store:
        store.rows[1] = {**store.rows[1], "square": 77}
        store._write_rows("runs.parquet", store.rows)
    (tmp_path / "numbers" / "seed-1.parquet").unlink()
    report, rows = run(tmp_path, range(2), workers=1)
    assert "does not repeat" in report.failures[1]
    assert rows[1]["square"] == 77


def test_another_configuration_is_refused_and_nothing_is_touched(tmp_path):
    run(tmp_path, range(2), workers=1)
    before = result_files(tmp_path)
    other = CONFIGURATION._replace(parameters={"group": {"value": 2}})
    with pytest.raises(StoreError, match=r"another configuration: .*group\.value = 1, now 2.*Choose another folder"):
        Store(tmp_path, other)
    assert result_files(tmp_path) == before


@pytest.mark.parametrize("name", ["runs.parquet", "timings.parquet", "numbers/seed-1.parquet", "configuration.json"])
def test_a_damaged_file_is_named_and_nothing_is_touched(tmp_path, name):
    run(tmp_path, range(3), workers=1)
    path = tmp_path / name
    path.write_bytes(path.read_bytes()[:-9])
    before = result_files(tmp_path)
    with pytest.raises(StoreError, match=rf"{name.split('/')[-1]} is damaged"):
        run(tmp_path, range(3), workers=1)
    assert result_files(tmp_path) == before


def test_a_table_of_another_configuration_is_named(tmp_path):
    run(tmp_path / "one", range(2), workers=1)
    with Store(tmp_path / "two", CONFIGURATION._replace(sources="other")) as store:
        run_set(counting.function(), range(2), store, workers=1)
    (tmp_path / "two" / "runs.parquet").rename(tmp_path / "one" / "runs.parquet")
    with pytest.raises(StoreError, match=r"runs\.parquet was left by another configuration"):
        run(tmp_path / "one", range(2))


def test_one_writer_a_folder(tmp_path):
    with Store(tmp_path, CONFIGURATION), pytest.raises(StoreError, match="is in use"):
        Store(tmp_path, CONFIGURATION)
    Store(tmp_path, CONFIGURATION).__exit__()


def test_a_folder_that_is_a_file_is_refused(tmp_path):
    (tmp_path / "file").write_text("mine")
    for folder in (tmp_path / "file", tmp_path / "file" / "below"):
        with pytest.raises(StoreError, match=r"cannot write .*file.*Choose another folder"):
            Store(folder, CONFIGURATION)
    assert (tmp_path / "file").read_text() == "mine"


def test_files_carry_who_they_belong_to(tmp_path):
    run(tmp_path, range(2), workers=1)
    found = table.metadata_of(table.read(tmp_path / "numbers" / "seed-1.parquet").schema)
    assert found["identity"] == CONFIGURATION.identity
    assert found["seed"] == "1"


def test_ctrl_c_keeps_what_is_done(tmp_path):
    def interrupted(done, total):
        if done == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(tmp_path, range(5), workers=1, progress=interrupted)
    report, _rows = run(tmp_path, range(5), workers=1)
    assert report.loaded == (0, 1)
    assert report.produced == (2, 3, 4)
