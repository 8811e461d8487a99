"""The part of a page that a script writes, between two lines that mark it."""


class NoMarks(ValueError):
    """A page lacks the lines."""


class Section:
    """begin, end: the two lines, as they stand in the page."""

    def __init__(self, begin, end):
        self.begin, self.end = begin, end

    def around(self, page):
        """What stands before and after it; NoMarks if the page does not have both lines, in their order."""
        before, begin, rest = page.read_text(encoding="utf-8").partition(self.begin)
        _, end, after = rest.partition(self.end)
        if not begin or not end:
            raise NoMarks(f"{page.name} has no lines '{self.begin}' and '{self.end}'")
        return before, after

    def write(self, page, text):
        before, after = self.around(page)
        page.write_text(f"{before}{self.begin}\n\n{text}\n{self.end}{after}", encoding="utf-8")
