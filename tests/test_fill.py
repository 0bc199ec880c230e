"""A page of results is filled with what the study's command has written."""

import importlib.util
from pathlib import Path

import pytest

from formicarium.commands.foraging import report

FILL = Path(__file__).parent.parent / "docs" / "fill.py"
spec = importlib.util.spec_from_file_location("fill", FILL)
fill = importlib.util.module_from_spec(spec)
spec.loader.exec_module(fill)

PAGE = "# Page\n<!-- block: one -->\nold\n<!-- end of block -->\nwords\n<!-- block: two -->\n<!-- end of block -->\n"


def test_blocks_are_replaced_by_name_and_words_between_them_stay():
    report = "<!-- block: two -->\n2\n<!-- end of block -->\nno\n<!-- block: one -->\n1\n3\n<!-- end of block -->\n"
    assert fill.filled(PAGE, report) == (
        "# Page\n<!-- block: one -->\n1\n3\n<!-- end of block -->\nwords\n"
        "<!-- block: two -->\n2\n<!-- end of block -->\n"
    )


def test_a_report_that_lacks_a_block_changes_nothing():
    with pytest.raises(KeyError, match="two"):
        fill.filled(PAGE, "<!-- block: one -->\n1\n<!-- end of block -->\n")


def test_every_block_of_the_page_of_task_partitioning_is_one_that_the_command_writes():
    page = (FILL.parent / "results" / "partitioning.md").read_text(encoding="utf-8")
    assert fill.BLOCK.search(page)
    assert fill.filled(page, report({})).count("end of block") == page.count("end of block")
