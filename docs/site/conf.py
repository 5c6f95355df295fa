"""Configures Sphinx for the site: `build.py` puts a copy of this file beside the staged pages."""

import re
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

from docutils import nodes
from pygments.lexer import Lexer
from pygments.lexers import get_lexer_by_name, get_lexer_for_filename
from pygments.token import Keyword, Operator, Text, _TokenType
from pygments.util import ClassNotFound
from sphinx.application import Sphinx

project = "rosbeat"
author = "the rosbeat authors"
html_title = "rosbeat: learn how robots talk"
language = "en"
extensions = ["myst_nb"]
# The pages were executed when they were built, and compared with what they show.
nb_execution_mode = "off"
# A site without requests to elsewhere: no widget manager, no require.js.
nb_ipywidgets_js: dict[str, dict[str, str]] = {}
nb_merge_streams = True
myst_heading_anchors = 4
myst_enable_extensions = ["colon_fence"]
exclude_patterns = ["_build"]
# Learners' terminals and ROS's messages have no grammar that Pygments knows.
highlight_language = "none"

# The book theme: made for pages that are read in order, and legible at 375 pixels. It and the theme
# below it bring their fonts and scripts along.
html_theme = "sphinx_book_theme"
html_theme_options = {
    "show_navbar_depth": 1,
    "home_page_in_toc": True,
    # It lies over the text on a phone.
    "back_to_top_button": False,
    "navbar_persistent": [],
    "use_download_button": False,
    "use_fullscreen_button": False,
    "use_repository_button": False,
    "pygments_light_style": "a11y-high-contrast-light",
    "pygments_dark_style": "a11y-high-contrast-dark",
}
html_context = {"default_mode": "auto"}
html_favicon = "_static/favicon.svg"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_js_files = ["site.js"]
html_copy_source = False
html_show_sourcelink = False


#: Words of code up to this length stay in one piece: no line ends after a hyphen in them.
_SHORT = 24


class PageLexer(Lexer):
    """Color a cell as the language in it: a file of %%save, the commands of %%terminal, Python."""

    name = "a cell of a page"
    aliases = ("rosbeat-page",)

    def __init__(self, **options: Any) -> None:  # noqa: ANN401 - Pygments' own
        super().__init__(**options)
        self.options = options

    def get_tokens_unprocessed(self, text: str) -> Iterator[tuple[int, _TokenType, str]]:
        """Generate the tokens of a cell: first its magic, then the rest in its language."""
        magic = re.match(r"%%(save|terminal) +(\S+)(.*\n?)", text)
        if not magic:
            yield from self._lexer("ipython3").get_tokens_unprocessed(text)
            return
        yield 0, Operator, "%%"
        yield magic.start(1), Keyword, magic[1]
        yield magic.end(1), Text, text[magic.end(1) : magic.end()]
        lexer = self._lexer("bash" if magic[1] == "terminal" else "text")
        if magic[1] == "save":
            with suppress(ClassNotFound):  # a file of a kind that has no colors
                lexer = get_lexer_for_filename(magic[2], **self.options)
        for index, token, value in lexer.get_tokens_unprocessed(text[magic.end() :]):
            yield magic.end() + index, token, value

    def _lexer(self, name: str) -> Lexer:
        return get_lexer_by_name(name, **self.options)


def explain_terms(app: Sphinx, tree: nodes.document, name: str) -> None:
    """Put the meaning of a term on each link to the glossary, for who points at it."""
    for link in tree.findall(nodes.reference):
        _, found, anchor = link.get("refuri", "").partition("docs/glossary.html#")
        if not found and name == "docs/glossary":
            continue
        if found and anchor in (meanings := _meanings(Path(app.srcdir) / "docs" / "glossary.md")):
            link["reftitle"] = meanings[anchor]


def keep_words_whole(app: Sphinx, tree: nodes.document, name: str) -> None:
    """Mark code of short words, so that a narrow window breaks it between them."""
    for code in tree.findall(nodes.literal):
        if max(map(len, code.astext().split()), default=0) <= _SHORT:
            code["classes"].append("short")


def _meanings(glossary: Path) -> dict[str, str]:
    """Return the text of each term by its anchor, without links and without its page."""
    found = {}
    for part in glossary.read_text(encoding="utf-8").split("\n## ")[1:]:
        term, _, text = part.partition("\n")
        plain = re.sub(r"\[([^\]]+)\]\([^)]*\)", r"\1", " ".join(text.split())).replace("`", "")
        anchor = re.sub(r"[^\w -]", "", term.lower()).replace(" ", "-")
        found[anchor] = re.sub(r"(See also [^.]+\. )?Page \d\d:.*$", "", plain).replace("*", "")
    return found


def setup(app: Sphinx) -> None:
    """Register what this site adds to Sphinx."""
    app.add_lexer("rosbeat-page", PageLexer)
    app.connect("doctree-resolved", explain_terms)
    app.connect("doctree-resolved", keep_words_whole)
