"""Layout of code with comments: right of the code ("behind") in one column, or above it if a line would be too long."""
import textwrap

WIDTH = 120  # columns


class Style:
    """Comment syntax of a language: behind code, and on several lines above it."""

    def __init__(self, gap, open_, close, first, further):
        self.gap, self.open, self.close, self.first, self.further = gap, open_, close, first, further

    def behind(self, text):
        return self.open + text.replace("*/", "* /") + self.close

    def above(self, text, indent=""):
        room = WIDTH - len(indent) - max(len(self.first), len(self.further)) - len(self.close)
        lines = textwrap.wrap(text.replace("*/", "* /"), room, break_on_hyphens=False)
        return "\n".join(indent + (self.further if number else self.first) + line
                         for number, line in enumerate(lines)) + self.close + "\n"


CPP = Style("  ", "// ", "", "// ", "// ")
C = Style(" ", "/* ", " */", "/* ", " * ")


def aligned(items, style, indent=""):
    """`items`: (heading, code, comment). Comments of neighbouring lines begin in one column as long as they fit."""
    text, run = "", []
    for heading, code, comment in items:
        alone = comment and not fits([(code, comment)], style, indent)
        if heading or alone or not fits([*run, (code, comment)], style, indent):
            text, run = text + lines(run, style, indent), []
        if heading:
            text += style.above(heading, indent)
        if alone:
            text += style.above(comment, indent) + f"{indent}{code}\n"
        else:
            run.append((code, comment))
    return text + lines(run, style, indent)


def column_of(run):
    return max((len(code) for code, comment in run if comment), default=0)


def fits(run, style, indent):
    longest = max((len(style.behind(comment)) for _, comment in run if comment), default=0)
    return len(indent) + column_of(run) + len(style.gap) + longest <= WIDTH


def lines(run, style, indent):
    column = column_of(run)
    return "".join(f"{indent}{code.ljust(column) + style.gap + style.behind(comment) if comment else code}\n"
                   for code, comment in run)
