"""A page of results is filled with what the study's command has written."""

import importlib.util
from pathlib import Path

from formicarium.commands.foraging import report

FILL = Path(__file__).parent.parent / "docs" / "fill.py"
spec = importlib.util.spec_from_file_location("fill", FILL)
fill = importlib.util.module_from_spec(spec)
spec.loader.exec_module(fill)

PAGE = "# Page\n<!-- block: one -->\nold\n<!-- end of block -->\nwords\n<!-- block: two -->\n<!-- end of block -->\n"


def test_blocks_are_replaced_by_name_and_words_between_them_stay():
    reports = [
        "<!-- block: two -->\n2\n<!-- end of block -->\nno\n",
        "<!-- block: one -->\n1\n3\n<!-- end of block -->\n",
    ]
    assert fill.filled(PAGE, reports) == (
        "# Page\n<!-- block: one -->\n1\n3\n<!-- end of block -->\nwords\n"
        "<!-- block: two -->\n2\n<!-- end of block -->\n",
        [],
    )


def test_what_no_report_has_stays_and_is_named():
    text, kept = fill.filled(PAGE, ["<!-- block: two -->\n2\n<!-- end of block -->\n"])
    assert kept == ["one"] and "old" in text


def test_every_block_of_the_page_of_task_partitioning_is_one_that_the_command_writes():
    """But those of the options, which the command writes into files of their own."""
    page = (FILL.parent / "results" / "partitioning.md").read_text(encoding="utf-8")
    assert fill.BLOCK.search(page)
    assert set(fill.filled(page, [report({})])[1]) == {"options", "hierarchy"}
