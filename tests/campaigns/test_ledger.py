"""The ledger: rows come in and stay, whoever writes, whatever is merged, whatever breaks."""

import errno
import json
import os
import runpy
from functools import partial
from pathlib import Path

import pytest

from counted_campaign import MANIFEST, campaign, jobs, keys_in_parts, table
from formicarium.campaigns import parts, writer
from formicarium.campaigns.coordinator import run_campaign
from formicarium.campaigns.errors import Futile
from formicarium.campaigns.files import StoreError
from formicarium.campaigns.here import Here
from formicarium.campaigns.ledger import Ledger
from formicarium.campaigns.result import Finished, Result
from formicarium.campaigns.workers import Processes
from formicarium.campaigns.writer import Writer

RUNS = 12


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    return campaign(tmp_path_factory.mktemp("undisturbed"), Here(), jobs(RUNS))[1]


def test_every_run_is_there_once_in_the_order_of_the_design(tmp_path, undisturbed):
    report, found = campaign(tmp_path, Here(), jobs(RUNS))
    assert report.standing.done == report.standing.produced == RUNS
    assert keys_in_parts(tmp_path) == (RUNS, RUNS)
    assert found["cell"].to_pylist() == [0] * 6 + [1] * 6
    assert found["power"].to_pylist() == [1] * 6 + [2] * 6
    assert found["seed"].to_pylist() == [*range(1, 7)] * 2
    assert found["value"].to_pylist() == [1, 2, 3, 4, 5, 6, 1, 4, 9, 16, 25, 36]
    assert found["half"].to_pylist()[:6] == [0.5, 1.0, 1.5, 2.0, None, 3.0]
    assert found.equals(undisturbed)


def test_what_is_there_is_loaded(tmp_path, undisturbed):
    campaign(tmp_path, Here(), jobs(8))
    report, found = campaign(tmp_path, Here(), jobs(RUNS))
    assert (report.loaded, report.standing.produced) == (8, 4)
    assert found.equals(undisturbed)


def test_rows_of_other_sources_are_other_runs(tmp_path):
    campaign(tmp_path, Here(), jobs(10))
    report, _ = campaign(tmp_path, Here(), jobs(10, sources="edited"))
    assert report.standing.produced == 10
    assert keys_in_parts(tmp_path) == (20, 20)


def test_a_failing_run_is_recorded_the_others_go_on_and_it_is_run_again_on_request(tmp_path):
    found = jobs(10, trouble="raise")
    report, _ = campaign(tmp_path, Here(), found)
    assert (report.standing.done, report.standing.failed) == (8, 2)
    record = Ledger(tmp_path).failure((found[0].configuration.identity, 3))
    assert "ArithmeticError: 3 cannot be raised" in record["failure"]
    assert "in squares" in record["failure"]
    assert record["factors"] == {"power": 1}
    assert campaign(tmp_path, Here(), jobs(10))[0].standing.produced == 0
    with Writer(Ledger(tmp_path), MANIFEST, found) as open_writer:
        assert open_writer.forget_failures(key for job in found for key in job.keys) == 2
        report = run_campaign(jobs(10), open_writer, Here())
    assert (report.standing.done, report.standing.failed, report.standing.produced) == (10, 0, 2)
    assert not list((tmp_path / "failures").iterdir())


def test_kept_tables_belong_to_done(tmp_path):
    campaign(tmp_path, Here(), jobs(10))
    for path in tmp_path.glob("numbers/*/seed-2.parquet"):
        path.unlink()
    assert campaign(tmp_path, Here(), jobs(10))[0].standing.produced == 0
    assert campaign(tmp_path, Here(), jobs(10), keep=["numbers"])[0].standing.produced == 2
    assert keys_in_parts(tmp_path) == (10, 10)


def test_a_run_that_does_not_repeat_is_a_failure_and_the_first_row_stays(tmp_path):
    found = jobs(10)
    _, before = campaign(tmp_path, Here(), found)
    identity = found[0].configuration.identity
    with Writer(Ledger(tmp_path), MANIFEST, found) as open_writer:
        other = Finished(4, Result({"value": 77}, {}), "", 0.1, 0, identity=identity)
        (kept,), _, _ = open_writer.exchange([other], [], 0)
    assert kept.result is None
    assert "does not repeat" in kept.failure
    assert table(tmp_path, found).equals(before)


def test_a_column_of_a_reserved_name_is_a_failure(tmp_path):
    found = jobs(10)
    with Writer(Ledger(tmp_path), MANIFEST, found) as open_writer:
        run = Finished(4, Result({"seed": 77}, {}), "", 0.1, 0, identity=found[0].configuration.identity)
        (kept,), _, _ = open_writer.exchange([run], [], 0)
    assert "column 'seed'" in kept.failure


def one_part_a_run(folder, found):
    with Writer(Ledger(folder), MANIFEST, found) as open_writer:
        for job in found:
            for identity, seed in job.keys:
                run = Finished(seed, job.function(seed, None), "", 0.1, 0, identity=identity)
                open_writer.exchange([run], [], 0)


def test_parts_are_merged_and_nothing_changes(tmp_path, undisturbed, monkeypatch):
    monkeypatch.setattr(writer, "SMALL_PARTS", 6)
    one_part_a_run(tmp_path, jobs(RUNS))
    assert len(list((tmp_path / "parts").iterdir())) < 7
    assert keys_in_parts(tmp_path) == (RUNS, RUNS)
    assert table(tmp_path, jobs(RUNS)).equals(undisturbed)


@pytest.mark.parametrize("survivors", [0, 1, 3, 5])
def test_a_merge_killed_at_any_file_repeats_no_row(tmp_path, undisturbed, monkeypatch, survivors):
    """Killed after the merged part is there and some of the old ones are gone."""
    monkeypatch.setattr(writer, "SMALL_PARTS", 6)
    copies = {}
    unlink = type(tmp_path).unlink

    def keep_some(path, missing_ok=False):
        if path.suffix == ".parquet" and path.exists() and len(copies) < survivors:
            copies[path.name] = path.read_bytes()
        unlink(path, missing_ok=missing_ok)

    monkeypatch.setattr(type(tmp_path), "unlink", keep_some)
    one_part_a_run(tmp_path, jobs(6))
    monkeypatch.undo()
    for name, content in copies.items():
        (tmp_path / "parts" / name).write_bytes(content)
    rows, different = keys_in_parts(tmp_path)
    assert rows == different + survivors
    assert len(table(tmp_path, jobs(6))) == 6
    report, found = campaign(tmp_path, Here(), jobs(RUNS))
    assert report.loaded == 6
    assert keys_in_parts(tmp_path) == (RUNS, RUNS)
    assert found.equals(undisturbed)


def test_a_reader_does_not_mind_parts_that_are_merged_under_its_eyes(tmp_path, undisturbed, monkeypatch):
    monkeypatch.setattr(writer, "SMALL_PARTS", 10**6)
    one_part_a_run(tmp_path, jobs(RUNS))
    listing = Ledger._listing
    merged = []

    def then_merge(self):
        found = listing(self)
        if not merged:
            merged.append(True)
            with Writer(Ledger(tmp_path), MANIFEST, jobs(RUNS)) as other, other.transaction():
                other.merge(list(other.ledger.known))
        return found

    monkeypatch.setattr(Ledger, "_listing", then_merge)
    assert table(tmp_path, jobs(RUNS)).equals(undisturbed)


@pytest.mark.parametrize("damage", ["cut", "empty", "flipped", "other", "text"])
def test_a_damaged_part_is_named_set_aside_and_run_again(tmp_path, undisturbed, damage):
    campaign(tmp_path, Here(), jobs(RUNS))
    path = sorted((tmp_path / "parts").iterdir())[-1]
    content = bytearray(path.read_bytes())
    content[len(content) // 3] ^= 0x10
    other = parts.joined([]).select(["seed"])
    if damage == "other":
        parts.write_part(other, path)
    else:
        whole = path.read_bytes()
        path.write_bytes({"cut": whole[: len(whole) // 2], "empty": b"", "flipped": content, "text": b"hello"}[damage])
    ledger = Ledger(tmp_path)
    ledger.refresh()
    assert list(ledger.damaged) == [path.name]
    report, found = campaign(tmp_path, Here(), jobs(RUNS))
    assert report.standing.produced > 0
    assert path.name in report.notes[0] and "run again" in report.notes[0]
    assert [file.name.endswith(path.name) for file in (tmp_path / "damaged").iterdir()] == [True]
    assert keys_in_parts(tmp_path) == (RUNS, RUNS)
    assert found.equals(undisturbed)


@pytest.mark.parametrize("name", ["failures", "configurations"])
def test_damaged_records_beside_the_rows_lose_no_row(tmp_path, name):
    found = jobs(10, trouble="raise")
    campaign(tmp_path, Here(), found)
    for path in (tmp_path / name).iterdir():
        path.write_text("{")
    report, _ = campaign(tmp_path, Here(), found)
    assert report.standing.done == 8
    assert (
        "damaged" in Ledger(tmp_path).failure(next(iter(Ledger(tmp_path).failures())))["failure"] or name != "failures"
    )


def full_disk(*_, **__):
    raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


@pytest.mark.parametrize("call", ["os.fsync", "os.replace", "pyarrow.parquet.write_table", "pathlib.Path.write_text"])
@pytest.mark.parametrize("good_calls", [0, 1, 5])
def test_a_full_disk_is_named_and_costs_only_what_was_not_written(tmp_path, undisturbed, monkeypatch, call, good_calls):
    monkeypatch.setattr("formicarium.campaigns.coordinator.PERIOD", 1e-6)
    module, _, name = call.rpartition(".")
    owner = {"os": os, "pyarrow.parquet": parts.pq, "pathlib.Path": type(tmp_path)}[module]
    original, calls = getattr(owner, name), []

    def failing(*arguments, **options):
        calls.append(1)
        return original(*arguments, **options) if len(calls) <= good_calls else full_disk()

    with monkeypatch.context() as patch:
        patch.setattr(owner, name, failing)
        with pytest.raises(StoreError, match=r"cannot write .*No space left"):
            campaign(tmp_path, Here(), jobs(RUNS))
    ledger = Ledger(tmp_path)
    ledger.refresh()
    assert not ledger.damaged
    assert not list(tmp_path.rglob(".partial-*"))
    report, found = campaign(tmp_path, Here(), jobs(RUNS))
    assert report.loaded == len(ledger.done)
    assert keys_in_parts(tmp_path) == (RUNS, RUNS)
    assert found.equals(undisturbed)


def test_a_folder_inside_a_file_is_refused_with_the_way_out(tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(StoreError, match=r"cannot read .*file.*Choose a folder"):
        Ledger(tmp_path / "file" / "store").refresh()


def test_a_folder_of_another_campaign_is_refused_and_kept(tmp_path):
    campaign(tmp_path, Here(), jobs(10))
    before = (tmp_path / "campaign.json").read_bytes()
    with pytest.raises(StoreError, match="belongs to another campaign: name is 'counted', not 'other'"):
        Writer(Ledger(tmp_path), {**MANIFEST, "name": "other"}, jobs(10))
    assert (tmp_path / "campaign.json").read_bytes() == before
    assert not list((tmp_path / "writers").iterdir())


def test_a_newer_format_is_refused_with_the_way_out(tmp_path):
    campaign(tmp_path, Here(), jobs(10))
    path = tmp_path / "campaign.json"
    path.write_text(json.dumps({**json.loads(path.read_text()), "format": 99}))
    with pytest.raises(StoreError, match=r"campaign\.json has format 99, this version knows 1: update the package"):
        Ledger(tmp_path)


def test_the_folder_of_a_run_is_refused(tmp_path):
    (tmp_path / "configuration.json").write_text("{}")
    with pytest.raises(StoreError, match="one configuration"):
        Ledger(tmp_path)


def test_a_place_that_cannot_be_written_is_named(tmp_path):
    (tmp_path / "file").write_text("mine")
    with pytest.raises(StoreError, match=r"cannot (write|read) .*file"):
        Writer(Ledger(tmp_path / "file" / "below"), MANIFEST, jobs(10))


def jobs_giving(give, runs=4):
    """Return jobs whose runs give what ``give(seed)`` says."""
    return [job._replace(function=partial(given, give)) for job in jobs(runs)]


def given(give, seed, watch):
    return give(seed)


def a_list(seed):
    return Result({"value": [1, 2]} if seed == 2 else {"value": 1}, {})


def nothing(seed):
    return None if seed == 2 else Result({"value": 1}, {})


def mixed(seed):
    return Result({"value": "many" if seed == 2 else seed, "large": 2**70, "truth": seed == 1 or 0.5}, {})


def futile(seed):
    if seed == 2:
        raise Futile("nothing will ever come of it")
    return Result({"value": seed}, {})


@pytest.mark.parametrize(("give", "words"), [(a_list, "'value' of the row is a list"), (nothing, "not NoneType")])
def test_what_no_table_can_hold_is_a_failure_and_the_others_go_on(tmp_path, give, words):
    report, _ = campaign(tmp_path, Here(), jobs_giving(give))
    assert (report.standing.done, report.standing.failed) == (2, 2)
    assert words in report.failures[0].failure


@pytest.mark.parametrize("period", [1e-6, 0.5])
def test_a_column_of_numbers_and_texts_becomes_text(tmp_path, monkeypatch, period):
    monkeypatch.setattr("formicarium.campaigns.coordinator.PERIOD", period)
    _, found = campaign(tmp_path, Here(), jobs_giving(mixed))
    assert found["value"].to_pylist() == ["1", "many", "1", "many"]
    assert found["large"].to_pylist() == [str(2**70)] * 4
    assert campaign(tmp_path, Here(), jobs_giving(mixed))[0].loaded == 4


@pytest.mark.parametrize("crew", [Here, partial(Processes, 2)])
def test_what_is_futile_stops_the_campaign_and_keeps_what_has_ended(tmp_path, crew):
    with pytest.raises(Futile, match="nothing will ever"):
        campaign(tmp_path, crew(), jobs_giving(futile))
    ledger = Ledger(tmp_path)
    ledger.refresh()
    assert not ledger.failures()
    if crew is Here:
        assert {seed for _, seed in ledger.done} == {1}
    assert campaign(tmp_path, Here(), jobs(4))[0].standing.done == 4


@pytest.mark.long
def test_a_hundred_thousand_rows_open_filter_and_collect_in_3_seconds_and_500_megabytes():
    benchmark = Path(__file__).parents[2] / "benchmarks" / "campaign_store.py"
    found = runpy.run_path(str(benchmark))["measure"](100_000)
    assert found["whole_s"] < 3.0, found
    assert found["peak_mb"] < 500, found
