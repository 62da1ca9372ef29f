#!/usr/bin/env python3
"""A project that takes this tree in by add_subdirectory has the targets of find_package(yars), and compiles with them.

usage: host_project_test.py CMAKE SOURCE CXX
"""
import pathlib
import subprocess
import sys
import tempfile

CMAKE, SOURCE, CXX = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
PROJECT = f"""cmake_minimum_required(VERSION 3.25)
project(cockpit LANGUAGES C CXX)
add_subdirectory({SOURCE} yars EXCLUDE_FROM_ALL)
add_executable(cockpit {SOURCE}/examples/host_display.cpp)
target_link_libraries(cockpit PRIVATE yars::display epoxy)
add_executable(mine mine.c)
target_link_libraries(mine PRIVATE yars::client)
"""


CLIENT = """#include <yars/yars.h>
int main(void) {
  yars_session s;
  return yars_attach(&s, "default", "mine");
}
"""


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=250, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


with tempfile.TemporaryDirectory() as folder:
    folder = pathlib.Path(folder)
    (folder / "CMakeLists.txt").write_text(PROJECT)
    (folder / "mine.c").write_text(CLIENT)
    run(CMAKE, "-G", "Ninja", "-S", folder, "-B", folder / "build", f"-DCMAKE_CXX_COMPILER={CXX}")
    targets = run("ninja", "-C", folder / "build", "-t", "targets", "all")
    objects = [line.split(":")[0] for line in targets.splitlines() if "host_display.cpp.o:" in line or
               "mine.c.o:" in line]
    run("ninja", "-C", folder / "build", *objects)
    # Tests, installation and package of this tree are no business of a host's.
    if "test_endtoend" in targets or "compressed_documents" in targets:
        sys.exit("expected a host to get no tests and no installation of ours, found them")
print("a host's project compiles against the display and the client")
