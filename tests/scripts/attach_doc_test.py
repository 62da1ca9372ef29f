#!/usr/bin/env python3
"""What docs/attach.md shows compiles: the flight model in C with warnings as errors, the one in Python. usage: attach_doc_test.py CC"""
import pathlib
import re
import subprocess
import sys
import tempfile

top = pathlib.Path(__file__).resolve().parents[2]
text = (top / "docs" / "attach.md").read_text()
blocks = ["\n".join(line[4:] for line in block.splitlines()) + "\n"
          for block in re.findall(r"(?:^(?:    .*|)\n)+", text, re.M) if block.strip()]
in_c = [block for block in blocks if "int main(void)" in block]
in_python = [block for block in blocks if "from yars import Session" in block]
if len(in_c) != 1 or len(in_python) != 1:
    sys.exit(f"docs/attach.md: expected one program in C and one in Python, found {len(in_c)} and {len(in_python)}")
compile(in_python[0], "docs/attach.md", "exec")
with tempfile.TemporaryDirectory() as folder:
    source = pathlib.Path(folder, "mine.c")
    source.write_text(in_c[0])
    sys.exit(subprocess.run([sys.argv[1], "-Wall", "-Wextra", "-Werror", f"-I{top}", str(source), "-o",
                             str(source.with_suffix(""))]).returncode)
