#!/usr/bin/env python3
"""Headers and documents of YARS as Doxygen reads them: usage: doxygen_source.py FOLDER (scripts/docs runs it).

In headers plain comments become documentation: the first is about the file, one above or behind a declaration about that.
In Markdown `<!-- diagram: FILE.dot -->` becomes the diagram, and links to headings find them.
"""
import pathlib
import re
import shutil
import sys

PLACES = [pathlib.Path(place) for place in ("README.md", "HACKING.md", "docs", "lib", "shm", "config", "databuffer", "model",
                                            "statemachine", "inputmonitor", "display", "tools")]


def escaped(text):
    """Comment text of which Doxygen takes nothing for a command, a tag or emphasis."""
    kept = re.split(r"(`[^`]*`)", text)
    kept[::2] = [re.sub(r"[\\@<>#$%&*]", r"\\\g<0>", part) for part in kept[::2]]
    return "".join(kept)


def header(lines):
    inside_first = True
    for line in lines:
        whole = re.match(r"(\s*)// ?(.*)", line)
        if inside_first and line.startswith("//"):
            yield ("/// \\file\n" if whole and lines[0] is line else "") + "/// " + escaped(whole[2]) + "\n"
            continue
        if inside_first:
            inside_first = False
            yield "\n"
        behind = re.match(r"(.*[;,{}] +)// (.*)", line)
        if whole and not whole[2].startswith(("NOLINT", "clang-format")):
            yield f"{whole[1]}/// {escaped(whole[2])}\n"
        elif behind and not behind[2].startswith("NOLINT") and '"' not in behind[2]:
            yield f"{behind[1]}///< {escaped(behind[2])}\n"
        else:
            yield line


def slug(heading):
    """The anchor that a heading has where Markdown is shown elsewhere."""
    return re.sub(r"[^\w-]", "", heading.lower().replace(" ", "-"))


def document(path):
    """Markdown with diagrams, and with labels where headings are linked to."""
    def label(match):
        return f"{match[0]} {{#{path.stem}_{slug(match[1])}}}"

    def code(match):
        return "<code>" + match[1].replace("\\", "\\\\") + "</code>" if "\\" in match[1] else match[0]

    text = path.read_text(encoding="utf-8")
    for picture in re.findall(r"!\[[^\]]*\]\(([^)]+)\)", text):
        if not (path.parent / picture).is_file():
            sys.exit(f"{path}: expected the picture {picture}, found none; check the path")
    blocks = re.split(r"(^```.*?^```$)", text, flags=re.M | re.S)
    for i in range(0, len(blocks), 2):
        block = re.sub(r"<!-- diagram: (\S+) -->", r"\\dotfile \1", blocks[i])
        block = re.sub(r"^##+ (.*)$", label, block, flags=re.M)
        block = re.sub(r"`([^`\n]*)`", code, block)
        blocks[i] = re.sub(r"\]\((?:(\w+)\.md)?#([\w-]+)\)", lambda m: f"](#{m[1] or path.stem}_{m[2]})", block)
    return "".join(blocks)


def main():
    target = pathlib.Path(sys.argv[1])
    shutil.rmtree(target, ignore_errors=True)
    for place in PLACES:
        for path in sorted(place.rglob("*")) if place.is_dir() else [place]:
            if path.suffix not in (".hpp", ".h", ".md", ".dot", ".png"):
                continue
            copy = target / path
            copy.parent.mkdir(parents=True, exist_ok=True)
            if path.suffix == ".md":
                copy.write_text(document(path), encoding="utf-8")
            elif path.suffix == ".hpp":
                lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
                copy.write_text("".join(header(lines)), encoding="utf-8")
            else:
                shutil.copy(path, copy)


if __name__ == "__main__":
    main()
