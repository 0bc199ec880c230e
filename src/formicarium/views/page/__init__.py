"""The page: HTML, CSS and JavaScript modules as they are, served one by one or put together in a single file."""

from html import escape
from importlib import resources

KINDS = {"css": "text/css", "js": "text/javascript"}
FILES = ("style.css", "main.js", "arena.js", "film.js", "live.js", "panels.js")


def text_of(name: str) -> str:
    """Return a file of the page."""
    return resources.files("formicarium.views.page").joinpath(name).read_text(encoding="utf-8")


def page_files(title: str) -> dict[str, tuple[str, str]]:
    """Return everything that is served: path -> (content, media type)."""
    found = {f"/page/{name}": (text_of(name), KINDS[name.rpartition(".")[2]]) for name in FILES}
    return {"/": (text_of("index.html").replace("{{title}}", escape(title)), "text/html"), **found}
