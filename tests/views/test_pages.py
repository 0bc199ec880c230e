"""A report as Markdown and as one HTML file."""

from formicarium.studies.document import Grid, Heading, Picture, Text
from formicarium.views.pages import write_html, write_markdown


def test_a_report_is_written_twice(tmp_path):
    (tmp_path / "one.png").write_bytes(b"picture")
    grid = Grid(("", "verdict"), [["R1 | a < b", "worse"]])
    blocks = [Heading("Title", 1), Text("5 < 6."), grid, Picture(tmp_path / "one.png", "Fig. 1")]
    text = write_markdown(blocks, tmp_path / "report.md").read_text()
    assert text == (
        "# Title\n\n5 < 6.\n\n|  | verdict |\n| --- | --- |\n| R1 / a < b | worse |\n\n![Fig. 1](one.png)\n"
    )
    page = write_html(blocks, tmp_path / "report.html").read_text()
    assert "<title>Title</title>" in page
    assert "<p>5 &lt; 6.</p>" in page
    assert '<td class="worse">worse</td>' in page
    assert "data:image/png;base64,cGljdHVyZQ==" in page
    assert "http" not in page  # self-contained
