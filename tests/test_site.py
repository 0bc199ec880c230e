"""The site is built from the documents without a warning, and everything in it can be reached."""

import shutil
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pytest

import formicarium
from formicarium import contracts

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"


def build(source, place):
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-b", "html"]
    return subprocess.run(
        [*command, "-d", place / "read", source, place / "site"], capture_output=True, text=True, check=False
    )


class Page(HTMLParser):
    """What a page links to and shows, and where one can jump to in it."""

    def __init__(self, path):
        super().__init__()
        self.links, self.pictures, self.places = [], [], set()
        self.path = path
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        found = dict(attrs)
        self.links += [found["href"]] if tag == "a" and "href" in found else []
        self.pictures += [found["src"]] if tag == "img" else []
        self.places |= {found["id"]} if "id" in found else set()

    def files(self, links):
        """Return the files that links lead to, without those that lead out of the site or into the page itself."""
        parts = [urlsplit(link) for link in links]
        return [(self.path.parent / unquote(part.path)).resolve() for part in parts if part.path and not part.scheme]


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    place = tmp_path_factory.mktemp("built")
    done = build(DOCS, place)
    assert done.returncode == 0, done.stderr
    return (place / "site").resolve()


@pytest.fixture(scope="module")
def reached(site):
    """Every page that clicking from the first one leads to, by its path in the site without the ending."""
    pages, waiting = {}, [site / "index.html"]
    while waiting:
        path = waiting.pop()
        name = path.relative_to(site).with_suffix("").as_posix()
        if name not in pages:
            pages[name] = Page(path)
            waiting += [file for file in pages[name].files(pages[name].links) if file.suffix == ".html"]
    return pages


@pytest.mark.parametrize("page", sorted(DOCS.glob("**/*.md")), ids=lambda page: str(page.relative_to(DOCS)))
def test_every_document_can_be_reached_from_the_first_page(page, reached):
    assert page.relative_to(DOCS).with_suffix("").as_posix() in reached


def test_every_picture_and_every_file_of_a_link_is_there(reached):
    wanted = {file for page in reached.values() for file in page.files(page.links + page.pictures)}
    assert not {str(file) for file in wanted if not file.is_file()}
    assert sum(len(page.pictures) for page in reached.values()) > 20


@pytest.mark.parametrize("room", [formicarium, contracts], ids=lambda room: room.__name__)
def test_every_public_name_is_in_the_reference(room, reached):
    places = reached["reference/index"].places | reached["reference/contracts"].places
    assert not {f"{room.__name__}.{name}" for name in room.__all__} - places - {"formicarium.contracts.CONTRACTS"}


@pytest.mark.parametrize(
    "text",
    [
        "[a page](nowhere.md)",
        "[a heading](index.md#nowhere)",
        "[a file](../nowhere.py)",
        "![a picture](nowhere.png)",
        "```{include} ../README.md\n```",  # its link leads nowhere
    ],
)
def test_a_link_that_leads_nowhere_is_told(text, tmp_path):
    source = tmp_path / "docs"
    source.mkdir()
    shutil.copy(DOCS / "conf.py", source)
    (source / "index.md").write_text(f"# First\n\n{text}\n", encoding="utf-8")
    (tmp_path / "README.md").write_text("[a page](docs/nowhere.md)\n", encoding="utf-8")
    done = build(source, tmp_path)
    assert done.returncode != 0 and "nowhere" in done.stderr
