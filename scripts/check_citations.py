#!/usr/bin/env python3
"""Checks citations and links: whatever a source, test, script or document cites is in this repository.

usage: check_citations.py [--root DIR]
Prints one line per finding, `file:line: rule: what was found, what is allowed`. The exit code is 1 if there is any.
The rules:
  citation  a cited document and a cited anchor exist; outside of Markdown a citation of docs/spec names an anchor
  rule      a file that names a rule by number cites the pilot's manual, which has that rule
  outside   nothing outside of the repository is cited, such as an unnamed specification or a neighbouring folder
  link      the target of a link in Markdown exists: a file or folder, and the anchor or heading in it
  decision  the numbers of docs/decisions have no gap and no duplicate; a cited decision exists
  anchor    an anchor occurs once in its file
Anchors in docs/spec are explicit, so that headings can be reworded. In other documents headings are anchors as well.
"""
import difflib
import posixpath
import re
import sys

sys.dont_write_bytecode = True
from check_layers import run, tracked_files  # noqa: E402
from doxygen_source import slug  # noqa: E402

SPECIFICATION = "docs/spec/"
INTERFACE = "docs/pilots_manual.md"
ANCHOR = re.compile(r'<a id="([^"]*)"></a>')
HEADING = re.compile(r"^#+ +(.*?) *$", re.M)
# A further anchor in a list of anchors. It may stand on the next line of a comment.
NEXT = r"(?:[,;]|\s+(?:and|or|to)\b)(?:\s|//|[#;*](?=\s))+#[\w-]+"
CITATION = re.compile(r"(?<![\w./-])(docs/(?:[\w-]+/)*[\w-]+\.md)((?:#[\w-]+(?:" + NEXT + ")*)?)")
LINK = re.compile(r"\]\(([^()\s]*)\)")
CODE = re.compile(r"^```.*?^```$|`[^`\n]*`", re.M | re.S)
BLOCK = re.compile(r"^```.*?^```$", re.M | re.S)
RULE = re.compile(r"\b[Rr]ules? (\d+(?:, \d+)*(?:,? (?:and|to|or) \d+)?)")
DECISION = re.compile(r"\b[Dd]ecisions? (\d+(?:, \d+)*(?:,? (?:and|to|or) \d+)?)(?!\d|[.,]\d)")
# A page of the specification, or of the texts that it was written from, without the path of its folder.
BARE_PAGE = re.compile(r"(?<![\w/.\[-])(?:pvi|seed-map|seed_map|physics|formats|pilots_interface)\.md\b")
UNNAMED = re.compile(r"(?<![\w./-])" + "sp" "ec" + r"(?![\w/-])")  # split, so that this file passes its own rule
NEIGHBOUR = re.compile(r"\.\./(?:seed|shared(?!/data\b))[\w./-]*")  # ../shared/data, for tests, is allowed


def line_of(text, position):
    return text.count("\n", 0, position) + 1


def blanked(pattern, text):
    """The text with blanks in place of all matches of the pattern. Line numbers do not change."""
    return pattern.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)


class Documents:
    """The Markdown files of a tree, and the possible targets of links (anchors) in each."""

    def __init__(self, root, names):
        self.texts = {name: (root / name).read_text(encoding="utf-8") for name in names if name.endswith(".md")}
        self.anchors = {name: anchors_of(name, text) for name, text in self.texts.items()}

    def why_missing(self, name, anchor):
        """Reason why a citation is wrong, as text. None if file and anchor exist."""
        if name not in self.texts:
            return f"{name} is not a file of the repository"
        if not anchor or anchor in self.anchors[name]:
            return None
        near = difflib.get_close_matches(anchor, self.anchors[name], 1)
        return f"{name} has no anchor '{anchor}'" + (f"; the nearest is '{near[0]}'" if near else "")


def anchors_of(name, text):
    anchors = set(ANCHOR.findall(text))
    if name.startswith(SPECIFICATION):
        return anchors
    seen = {}
    for heading in HEADING.findall(blanked(BLOCK, text)):
        plain = slug(re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading))
        seen[plain] = seen.get(plain, -1) + 1
        anchors.add(plain if seen[plain] == 0 else f"{plain}-{seen[plain]}")
    return anchors


def check_citations(name, text, documents):
    for match in CITATION.finditer(text):
        line, page = line_of(text, match.start()), match.group(1)
        cited = re.findall(r"#([\w-]+)", match.group(2))
        if page.startswith(SPECIFICATION) and not cited and not name.endswith(".md") and page in documents.texts:
            yield line, "citation", f"{page} is cited without an anchor; name one, as in {page}#{{anchor}}"
        for anchor in cited or [None]:
            problem = documents.why_missing(page, anchor)
            if problem:
                yield line, "citation", problem


def check_rules(name, text, documents):
    if name == INTERFACE:
        return
    for match in RULE.finditer(text):
        line = line_of(text, match.start())
        for number in re.findall(r"\d+", match.group(1)):
            if f"rule-{number}" not in documents.anchors.get(INTERFACE, ()):
                yield line, "rule", f"rule {number} is none of {INTERFACE}"
        if not re.search(r"pilots_manual\.md", text):
            yield line, "rule", f"'{match.group()}' of what? the file cites {INTERFACE} nowhere"


def check_outside(name, text):
    folder = posixpath.dirname(name)
    for match in BARE_PAGE.finditer(text):
        if name.endswith(".md") and folder + "/" == SPECIFICATION:
            continue  # a neighbour in the same folder
        yield line_of(text, match.start()), "outside", f"'{match.group()}': cite {SPECIFICATION}... and an anchor"
    for match in UNNAMED.finditer(text):
        yield (line_of(text, match.start()), "outside",
               f"'{match.group()}' names no page: cite {SPECIFICATION}... and an anchor")
    for match in NEIGHBOUR.finditer(text):
        yield line_of(text, match.start()), "outside", f"'{match.group()}' lies outside of the repository"


def check_links(root, name, text, documents):
    prose = blanked(CODE, text)
    for match in LINK.finditer(prose):
        target = match.group(1)
        if re.match(r"[a-z][a-z0-9+.-]*:", target):
            continue  # another site
        path, _, anchor = target.partition("#")
        linked = posixpath.normpath(posixpath.join(posixpath.dirname(name), path)) if path else name
        line = line_of(prose, match.start())
        if linked in documents.texts:
            problem = documents.why_missing(linked, anchor)
            if problem:
                yield line, "link", problem
        elif linked.startswith("..") or not (root / linked).exists():
            yield line, "link", f"'{target}' leads to {linked}, which is not there"


def check_anchors(text):
    seen = set()
    for match in ANCHOR.finditer(text):
        if match.group(1) in seen:
            yield line_of(text, match.start()), "anchor", f"'{match.group(1)}' stands here a second time"
        seen.add(match.group(1))


def decision_numbers(names):
    """{number of a decision: list of its files in docs/decisions}"""
    numbers = {}
    for name in names:
        match = re.fullmatch(r"docs/decisions/(\d{4})-[\w-]+\.md", name)
        if match:
            numbers.setdefault(int(match.group(1)), []).append(name)
    return numbers


def check_decision_files(numbers, documents):
    for number in range(1, max(numbers, default=0) + 1):
        if number not in numbers:
            yield "docs/decisions", 1, "decision", f"number {number:04} is missing; write it or renumber the later ones"
    for number, files in sorted(numbers.items()):
        for file in files[1:]:
            yield file, 1, "decision", f"number {number:04} is also that of {files[0]}"
        for file in files:
            if not documents.texts[file].startswith(f"# {number}. "):
                yield file, 1, "decision", f"expected the title '# {number}. ...', found " + repr(
                    documents.texts[file].split("\n", 1)[0])


def check_decision_names(text, numbers):
    for match in DECISION.finditer(text):
        for number in re.findall(r"\d+", match.group(1)):
            if int(number) not in numbers:
                yield line_of(text, match.start()), "decision", f"decision {number} is not in docs/decisions"


def findings_of(root):
    names = tracked_files(root)
    documents = Documents(root, names)
    numbers = decision_numbers(names)
    yield from check_decision_files(numbers, documents)
    for name in names:
        try:
            text = (root / name).read_text(encoding="utf-8")
        except UnicodeDecodeError:
            continue  # no text, such as a picture
        checks = [check_rules(name, text, documents), check_decision_names(text, numbers)]
        if name.endswith(".md"):
            checks += [check_links(root, name, text, documents), check_anchors(text)]
            text = blanked(LINK, text)
        checks += [check_citations(name, text, documents), check_outside(name, text)]
        for check in checks:
            yield from ((name, *finding) for finding in check)


if __name__ == "__main__":
    sys.exit(run("check_citations", "Checks citations, links and decisions of the YARS tree.", findings_of,
                 "every citation leads somewhere"))
