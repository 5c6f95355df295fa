"""A page of HTML, taken apart."""

from html.parser import HTMLParser

#: Every element that a report is made of.
ELEMENTS = {
    *("html", "head", "meta", "title", "style", "body", "header", "main", "footer", "section"),
    *("h1", "h2", "h3", "p", "pre", "code", "bdi", "div", "span", "strong", "article", "a"),
    *("svg", "rect", "text", "table", "caption", "thead", "tbody", "tr", "th", "td", "dl", "dt"),
    *("dd", "details", "summary", "abbr", "figure", "figcaption", "g", "path", "line", "mark"),
}


class Parsed(HTMLParser):
    """The elements of a page, with their attributes, and its text."""

    def __init__(self, page):
        super().__init__()
        self.elements, self.text, self._in_style = [], "", False
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))
        self._in_style = tag == "style"
        if tag in ("text", "p", "td", "th", "dt", "dd", "h1", "h2", "h3", "caption", "summary"):
            self.text += " "

    def handle_endtag(self, tag):
        self._in_style = False

    def handle_data(self, data):
        if not self._in_style:
            self.text += data


class Shown(HTMLParser):
    """An output as a person reads it: paragraphs, items, tables and links by their words."""

    def __init__(self, html):
        super().__init__()
        self.paragraphs, self.items, self.tables, self.links = [], [], {}, {}
        self._rows, self._words, self._href, self._link = [], "", "", ""
        self.feed(html)

    def handle_starttag(self, tag, attrs):
        if tag in ("p", "li", "caption", "th", "td"):
            self._words = ""
        elif tag == "tr":
            self._rows.append([])
        elif tag == "a":
            self._href, self._link = dict(attrs)["href"], ""

    def handle_endtag(self, tag):
        if tag == "p":
            self.paragraphs.append(self._words)
        elif tag == "li":
            self.items.append(self._words)
        elif tag == "caption":
            self._rows = self.tables[self._words] = []
        elif tag in ("th", "td"):
            self._rows[-1].append(self._words)
        elif tag == "a":
            self.links[self._link] = self._href
            self._href = ""

    def handle_data(self, data):
        self._words += data
        if self._href:
            self._link += data


def require_harmless(page, more=frozenset()):
    """Require that nothing of a page acts, or hides what it is, whatever a learner has written."""
    page.encode("utf-8")
    elements = Parsed(page).elements
    assert {tag for tag, _ in elements} <= ELEMENTS | more
    assert not any(name.startswith("on") for _, attrs in elements for name in attrs)
    assert not set("\0\x1b\u202e") & set(page)
