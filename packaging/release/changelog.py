"""Sections of CHANGELOG.md, and the notes of a release made from one."""
import re

HEADING = re.compile(r"^## \[(?P<version>[^\]]+)\] - (?P<date>.+)$", re.M)


def section(text, version):
    """(date, text) of the section of a version; None: there is none."""
    headings = list(HEADING.finditer(text))
    for heading, following in zip(headings, [*headings[1:], None]):
        if heading["version"] == version:
            return heading["date"].strip(), text[heading.end():following.start() if following else len(text)].strip()
    return None


def is_date(text):
    return re.fullmatch(r"\d{4}-\d{2}-\d{2}", text) is not None


def notes(version, date, changes, commit, files):
    """The notes as Markdown. `files`: (name, what it is for) of the release."""
    lines = [f"# YARS {version}", "", f"{date}, commit {commit}.", "", "| file | for |", "| --- | --- |"]
    lines += [f"| `{name}` | {purpose} |" for name, purpose in files]
    lines += ["", "`sha256sum -c SHA256SUMS` checks the files. Install the packages of your suite, for example:", "",
              *(f"    sudo apt install ./{name}" for name, _ in files if name.startswith("yars_")), "", changes]
    return "\n".join(lines) + "\n"
