#!/usr/bin/env python3
"""Prepares sources and documents of YARS for Doxygen.

usage: doxygen_source.py FOLDER         copies the tree to FOLDER; scripts/docs calls it
       doxygen_source.py --filter FILE  prints one file; Doxygen calls it as a filter
In the Markdown of the copy, Doxygen's command for a diagram replaces `<!-- diagram: FILE.dot -->`. Links to headings
and to anchors (`<a id="NAME"></a>`) use Doxygen's labels.
The filter turns plain comments into documentation. The first comment of a header or source describes the file. In a
header, a comment above a declaration, or after it on its line, describes that declaration. After the first blank line
the filter keeps all line numbers, so that links to lines of the unfiltered sources are right.
"""
import pathlib
import posixpath
import re
import shutil
import sys

ROOTS = [pathlib.Path(root) for root in (
    "README.md", "HACKING.md", "CHANGELOG.md", "CONTRIBUTING.md", "ROADMAP.md", "SECURITY.md", "docs", "lib", "shm",
    "config", "databuffer", "model", "worldgen", "statemachine", "inputmonitor", "display", "gateway", "tools",
    "python", "examples", "tests/README.md", "tests/gateway/lab/README.md")]
SOURCES = (".hpp", ".h", ".cpp", ".c")
ANCHOR = r'<a id="([^"]*)"></a>'


def escaped(text):
    """Comment text with escapes, so that Doxygen finds no command, tag or emphasis in it.
    Code in `...` is unchanged."""
    kept = re.split(r"(`[^`]*`)", text)
    kept[::2] = [re.sub(r"[\\@<>#$%&*]", r"\\\g<0>", part) for part in kept[::2]]
    return "".join(kept)


def file_comment(lines):
    """(the comment at the beginning of a file as its documentation, the number of lines of that comment)"""
    count = next((i for i, line in enumerate(lines) if not line.startswith("//")), len(lines))
    if count == 0:
        return [], 0
    return ["/// \\file\n"] + ["/// " + escaped(re.sub("^// ?", "", line)) for line in lines[:count]], count


def without_first_blank(lines):
    """The lines without the first blank one, because file_comment() adds one line."""
    blank = next((i for i, line in enumerate(lines) if not line.strip()), len(lines))
    return lines[:blank] + lines[blank + 1:]


def declaration(line):
    whole = re.match(r"(\s*)// ?(.*)", line)
    behind = re.match(r"(.*[;,{}] +)// (.*)", line)
    if whole and not whole[2].startswith(("NOLINT", "clang-format")):
        return f"{whole[1]}/// {escaped(whole[2])}\n"
    if behind and not re.match(r"(NOLINT|namespace )", behind[2]) and '"' not in behind[2]:
        return f"{behind[1]}///< {escaped(behind[2])}\n"
    return line


def filtered(path):
    lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
    if path.suffix not in (".hpp", ".cpp"):
        return "".join(lines)
    first, count = file_comment(lines)
    rest = without_first_blank(lines[count:]) if first else lines
    return "".join(first + ([declaration(line) for line in rest] if path.suffix == ".hpp" else rest))


def slug(heading):
    """The anchor of a heading by the usual rule of Markdown viewers: lower case, hyphens for blanks, no punctuation."""
    return re.sub(r"[^\w-]", "", heading.lower().replace(" ", "-"))


def label(path, anchor):
    """Doxygen's label of an anchor. It contains the path, because labels must be unique over all documents."""
    return "_".join((*path.with_suffix("").parts, anchor))


def document(path):
    """Text of a Markdown file with Doxygen's commands for diagrams, labels and links."""
    def heading(match):
        anchor = slug(match[1])
        if anchor in anchors:  # its own
            return match[0]
        earlier = headings.count(anchor)  # of the same words: Markdown viewers number them
        headings.append(anchor)
        anchor = f"{anchor}-{earlier}" if earlier else anchor
        return f"{match[0]} {{#{label(path, anchor)}}}"

    def target_of(link):
        return pathlib.Path(posixpath.normpath(path.parent / link))

    def anchor_link(match):
        return f"](#{label(target_of(match[1]) if match[1] else path, match[2])})"

    def page_link(match):
        # The path from the top of the tree. Doxygen would look for a relative path in its working folder first.
        return f"]({target_of(match[1])})"

    def code(match):
        # Doxygen ends a span at an apostrophe, and takes a backslash in it for a command.
        return f"<code>{escaped(match[1])}</code>" if re.search(r"[\\']", match[1]) else match[0]

    text = path.read_text(encoding="utf-8")
    anchors, headings = set(re.findall(ANCHOR, text)), []
    for picture in re.findall(r"!\[[^\]]*\]\(([^)]+)\)", text):
        if not (path.parent / picture).is_file():
            sys.exit(f"{path}: expected the picture {picture}, found none; check the path")
    blocks = re.split(r"(^```.*?^```$)", text, flags=re.M | re.S)
    for i in range(0, len(blocks), 2):
        block = re.sub(r"<!-- diagram: (\S+) -->", r"\\dotfile \1", blocks[i])
        block = re.sub(r"^##+ (.*)$", heading, block, flags=re.M)
        parts = re.split(r"(`[^`\n]*`)", block)
        parts[::2] = [re.sub(ANCHOR, lambda match: f"\\anchor {label(path, match[1])} ", part) for part in parts[::2]]
        block = re.sub(r"`([^`\n]*)`", code, "".join(parts))
        block = re.sub(r"\]\(([\w./-]+\.md)\)", page_link, block)
        blocks[i] = re.sub(r"\]\(([\w./-]+\.md)?#([\w-]+)\)", anchor_link, block)
    return "".join(blocks)


def main():
    if sys.argv[1] == "--filter":
        return sys.stdout.write(filtered(pathlib.Path(sys.argv[2])))
    target = pathlib.Path(sys.argv[1])
    shutil.rmtree(target, ignore_errors=True)
    for root in ROOTS:
        for path in sorted(root.rglob("*")) if root.is_dir() else [root]:
            if path.suffix not in (*SOURCES, ".md", ".dot", ".png", ".webp"):
                continue
            copy = target / path
            copy.parent.mkdir(parents=True, exist_ok=True)
            if path.suffix == ".md":
                copy.write_text(document(path), encoding="utf-8")
            else:
                shutil.copy(path, copy)


if __name__ == "__main__":
    main()
