"""The site is built from the same Markdown that is read on GitHub: ``python -m sphinx -W -b html docs build/site``."""

import os
import re
from pathlib import Path

from pygments.lexers.special import TextLexer

from formicarium import __version__

DOCS = Path(__file__).parent
ROOT_PAGES = {"README.md": "start.md", "CHANGELOG.md": "changelog.md", "CONTRIBUTING.md": "contributing.md"}
LINK = re.compile(r"(?<=\]\()(?!\w+:|[#/])[^)\s]+")

project = "formicarium"
author = "The formicarium developers"
version = release = __version__
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
html_theme = "furo"
html_title = "formicarium"
html_copy_source = False
myst_heading_anchors = 3
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
highlight_language = "text"  # of blocks that name no language: most are commands
napoleon_custom_sections = ["Returns"]  # a sentence: what stands before a colon in it is no type


def place_in_the_site(link, folder):
    """Return a link of a file in ``folder`` as a path from docs/; files of the root have pages of other names."""
    target = (folder / link.partition("#")[0]).resolve()
    from_root = target.relative_to(DOCS.parent).as_posix()
    if from_root in ROOT_PAGES:
        return "/" + ROOT_PAGES[from_root]
    return "/" + os.path.relpath(target, DOCS).replace(os.sep, "/")


def keep_links_whole(_app, path, _page, content):
    """Let the links of an included file lead where they lead in that file."""
    folder = (DOCS / path).parent
    content[0] = LINK.sub(lambda link: place_in_the_site(link[0], folder), content[0])


def drop_words_of_python(_app, _kind, _name, _found, _options, lines):
    """Leave out what Python itself says of the fields of a NamedTuple."""
    if lines and lines[0].startswith("Alias for field number"):
        lines.clear()


def setup(app):
    """Ask Sphinx to hand over what is read before it is written, and to print tables of numbers as they are."""
    app.connect("autodoc-process-docstring", drop_words_of_python)
    app.add_lexer("csv", TextLexer)
    app.connect("include-read", keep_links_whole)
