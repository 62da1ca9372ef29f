#!/usr/bin/env python3
"""What docs/attach.md shows compiles: programs and parts of programs in C with warnings as errors, those in Python.
A part is one that a function which has a session could hold. As C99 and as C++; also the parts with the libraries.
usage: attach_doc_test.py CC CXX"""
import pathlib
import re
import subprocess
import sys
import tempfile
import textwrap

PART = """#include "databuffer/client/yars.h"
#include <stdlib.h>

int main(void) {
  yars_session s;
  if (yars_attach(&s, "default", "mine") != 0) return 1;
%s  return 0;
}
"""

NAMES = """#include "databuffer/client/yars.h"
int main(int argc, char** argv) {
  yars_session s;
  const int attached = argc == 2 && yars_attach(&s, argv[1], "mine") == 0;
  puts(attached ? "attached" : s.error);
  return 0;
}
"""

PART_OF_A_LIBRARY = """%s
void part(void);
void part(void) {
%s}
"""

top = pathlib.Path(__file__).resolve().parents[2]
text = (top / "docs" / "attach.md").read_text()
blocks = ["\n".join(line[4:] for line in block.splitlines()) + "\n"
          for block in re.findall(r"(?:^(?:    .*|)\n)+", text, re.M) if block.strip()]
in_c = [block if "int main(void)" in block else PART % textwrap.indent(block, "  ")
        for block in blocks if re.search(r"\byars_(?!display|client)\w+\(", block)]
# The parts with the headers of the libraries: what they include stands before them.
of_libraries = [PART_OF_A_LIBRARY % ("\n".join(re.findall(r"^#.*", block, re.M)),
                                     re.sub(r"^#.*\n", "", block, flags=re.M))
                for block in blocks if re.search(r"yars_(display|client)_attach\(", block)]
in_python = [block for block in blocks if re.search(r"\bsession\.\w+\(", block)]
if len(in_c) < 5 or len(in_python) < 4 or len(of_libraries) != 2:
    sys.exit(f"docs/attach.md: expected 5 parts in C, 4 in Python and 2 of libraries, found {len(in_c)}, "
             f"{len(in_python)} and {len(of_libraries)}")
for block in in_python:
    compile(block, "docs/attach.md", "exec")
failed = 0
with tempfile.TemporaryDirectory() as folder:
    for block in in_c:
        # The C++ of the document's readers need not be ours: {0} leaves members out there.
        for compiler, name, more in ((sys.argv[1], "mine.c", []),
                                     (sys.argv[2], "mine.cpp", ["-Wno-missing-field-initializers"])):
            source = pathlib.Path(folder, name)
            source.write_text(block)
            command = [compiler, "-Wall", "-Wextra", "-Werror", *more, f"-I{top}", str(source), "-o",
                       str(source.with_suffix(""))]
            failed |= subprocess.run(command).returncode
    pathlib.Path(folder, "yars").symlink_to(top / "display" / "library")  # as it is installed
    for block in of_libraries:
        for compiler, name, more in ((sys.argv[1], "part.c", []),
                                     (sys.argv[2], "part.cpp", ["-Wno-missing-field-initializers"])):
            source = pathlib.Path(folder, name)
            source.write_text(block)
            failed |= subprocess.run([compiler, "-Wall", "-Wextra", "-Werror", *more, f"-I{folder}", f"-I{top}",
                                      "-c", str(source), "-o", str(source.with_suffix(".o"))]).returncode
    # The name of a session is a part of a path.
    source = pathlib.Path(folder, "name.c")
    source.write_text(NAMES)
    subprocess.run([sys.argv[1], f"-I{top}", str(source), "-o", str(source.with_suffix(""))], check=True)
    for name in ("../../x", "", "a/b", "a\x1b[2J", "x" * 41):
        said = subprocess.run([source.with_suffix(""), name], capture_output=True, text=True).stdout
        if "1 to 40 letters" not in said or "\x1b" in said:
            print(f"yars_attach to {name!r}: expected that the name is refused, found {said!r}")
            failed = 1
sys.exit(failed)
