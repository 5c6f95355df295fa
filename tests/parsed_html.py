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
