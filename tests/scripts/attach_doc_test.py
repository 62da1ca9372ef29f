#!/usr/bin/env python3
"""What docs/attach.md shows compiles: programs and parts of programs in C with warnings as errors, those in Python.
A part is one that a function which has a session could hold. usage: attach_doc_test.py CC"""
import pathlib
import re
import subprocess
import sys
import tempfile
import textwrap

PART = """#include "databuffer/yars.h"
#include <stdlib.h>

int main(void) {
  yars_session s;
  if (yars_attach(&s, "default", "mine") != 0) return 1;
%s  return 0;
}
"""

top = pathlib.Path(__file__).resolve().parents[2]
text = (top / "docs" / "attach.md").read_text()
blocks = ["\n".join(line[4:] for line in block.splitlines()) + "\n"
          for block in re.findall(r"(?:^(?:    .*|)\n)+", text, re.M) if block.strip()]
in_c = [block if "int main(void)" in block else PART % textwrap.indent(block, "  ")
        for block in blocks if re.search(r"\byars_\w+\(", block)]
in_python = [block for block in blocks if re.search(r"\bsession\.\w+\(", block)]
if len(in_c) < 5 or len(in_python) < 4:
    sys.exit(f"docs/attach.md: expected 5 parts in C and 4 in Python, found {len(in_c)} and {len(in_python)}")
for block in in_python:
    compile(block, "docs/attach.md", "exec")
failed = 0
with tempfile.TemporaryDirectory() as folder:
    for block in in_c:
        source = pathlib.Path(folder, "mine.c")
        source.write_text(block)
        command = [sys.argv[1], "-Wall", "-Wextra", "-Werror", f"-I{top}", str(source), "-o", str(source.with_suffix(""))]
        failed |= subprocess.run(command).returncode
sys.exit(failed)
