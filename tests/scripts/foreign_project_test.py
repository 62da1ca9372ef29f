#!/usr/bin/env python3
"""A project of somebody else builds against an installed YARS, by pkg-config, and against the Debian packages, by
find_package(yars) and `import yars`, and its programs run. With YARS_TEST_FULL each is built by each way. The packages
are unpacked where no compiler looks.

usage: foreign_project_test.py CMAKE BUILD CC CXX FLAGS     FLAGS: of the compilers, such as those of the sanitizers
"""
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time

CMAKE, BUILD, CC, CXX = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3], sys.argv[4]
FLAGS = shlex.split(sys.argv[5])
ALL = "YARS_TEST_FULL" in os.environ  # each kind of installation by each way; without, each of them once
SOURCE = pathlib.Path(__file__).resolve().parents[2]
SESSION = f"foreign-{os.getpid()}"
# Components: all but the programs, which are large with the sanitizers, and the compiled part of the Python module.
PARTS = ("headers", "Unspecified", "client", "display", "radar", "development", "python")
ENVIRONMENT = dict(os.environ, ASAN_OPTIONS="detect_leaks=0")  # a search crashes beside Mesa's threads
# The strictest reader of the headers. The client's comes first, as it says.
STRICT = """#include <yars/yars.h>
#include <yars/yars_client.h>
#include <yars/yars_display.h>
int main(void) {
  yars_session s;
  yars_client* client;
  const yars_viewport viewport = {0, 0, 480, 480};
  return yars_attach(&s, "no-such-session", "strict") == 0 || yars_display_draw(NULL, viewport) != -1 ||
         yars_client_attach("no-such-session", "strict", &client) == 0;
}
"""
WANTS = """cmake_minimum_required(VERSION 3.16)
project(cockpit LANGUAGES NONE)
find_package(yars %s)
"""
ATTACH = (SOURCE / "docs/attach.md").read_text()
faults = []


def run(*command, folder=None, **environment):
    return subprocess.run([str(word) for word in command], cwd=folder, env={**ENVIRONMENT, **environment},
                          capture_output=True, text=True, errors="surrogateescape",  # pkg-config escapes each byte
                          timeout=240, check=False)


def must(*command, folder=None, **environment):
    done = run(*command, folder=folder, **environment)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


def expect(what, good, found=""):
    if not good:
        faults.append(f"{what}: {found}")


def installed(folder, parts):
    """The prefix of an installation that was moved afterwards."""
    for part in parts:
        must(CMAKE, "--install", BUILD, "--component", part, "--prefix", folder / "first")
    return shutil.move(folder / "first", folder / "moved")


def unpacked(folder):
    """The prefix within the Debian packages, without their programs."""
    cpack = pathlib.Path(CMAKE).parent / "cpack"
    must(cpack, "-G", "DEB", "-B", folder, "-D", f"CPACK_COMPONENTS_ALL={';'.join(PARTS)}",
         "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=none", folder=BUILD)
    packages = sorted(folder.glob("*.deb"))
    expect("the packages",
           [path.name.partition("_")[0] for path in packages] == ["libyars-dev", "python3-yars", "yars"], packages)
    for package in packages:
        must("dpkg-deb", "-x", package, folder / "root")
    development, python = (must("dpkg-deb", "-f", package) for package in packages[:2])
    expect("python3-yars depends on the library of its own version",
           re.search(r"^Depends: .*yars \(= [\d.]+-1(~\w+)?\)", python, re.M), python)
    expect("libyars-dev depends on the libraries of its own version",
           re.search(r"^Depends: yars \(= [\d.]+-1(~\w+)?\)$", development, re.M), development)
    package = packages[2]
    fields = must("dpkg-deb", "-f", package)
    files = must("dpkg-deb", "-c", package)
    expect("the package yars has nothing of the others",
           not re.search(r"dist-packages|plot-trade|/include/|/cmake/yars/|\.pc$|\.a$|\.so ->", files, re.M), files)
    expect("the package depends on what the library is linked with", "libepoxy0" in fields and "libspdlog" in fields,
           fields)
    control = must("dpkg-deb", "-I", package)
    expect("the package has ldconfig run", "triggers" in control and "shlibs" in control, control)
    return folder / "root/usr"


def library_of(prefix, name="display"):
    return next(prefix.glob(f"lib/**/libyars-{name}.so"))


def check_radar(how, program, **environment):
    """The example gives the hashes of the commands."""
    done = run(program, **environment)
    expect(f"{how}: first_picture runs", done.returncode == 0, done)
    for command in (["scan", "--range-nm", "20"], ["patch", "--window-nm", "1.3"]):
        wanted = json.loads(must(BUILD / "bin/yars", *command, "--json"))["hash"]
        expect(f"{how}: first_picture has the hash of yars {command[0]}", f"hash {wanted}\n" in done.stdout,
               done.stdout)
    absent = run(program, "/nowhere", **environment)
    expect(f"{how}: first_picture says what is wrong",
           absent.returncode == 1 and "/nowhere: expected a directory" in absent.stderr, absent)


def check_picture(how, path):
    """The host's scene, 1280 x 800 pixels: something bright is in the viewport of the display."""
    head = b"P6\n1280 800\n255\n"
    scene = path.read_bytes() if path.is_file() else b""
    if len(scene) != len(head) + 3 * 1280 * 800 or not scene.startswith(head):
        faults.append(f"{how}: expected a scene in {path.name}, found {len(scene)} bytes")
        return
    rows = [scene[len(head) + 3 * (1280 * y + 620):][:1800] for y in range(100, 700)]
    bright = sum(value > 60 for row in rows for value in row[1::3])
    expect(f"{how}: a picture of the display", bright > 1000, f"{bright} bright pixels")


def check_programs(how, folder, prefix, **environment):
    """The embedding program makes the session; meanwhile the client in C and the one in Python take part in it."""
    alone = run(folder / "fly", SESSION, folder=folder)
    expect(f"{how}: the client in C without a session", alone.returncode == 1 and "no such session" in alone.stderr,
           alone)
    # The library finds a configuration that came with YARS from where it lies itself.
    host = subprocess.Popen([folder / "host_display", SESSION, folder / "scene.ppm", "3", "apg68.guf"], text=True,
                            stderr=subprocess.PIPE, env={**ENVIRONMENT, **environment})
    client = alone
    while client.returncode != 0 and host.poll() is None:
        time.sleep(0.05)
        client = run(folder / "fly", SESSION, folder=folder)  # ends at once: no set runs
    expect(f"{how}: the client in C takes part", client.returncode == 0, client)
    modules = prefix / "lib/python3/dist-packages"
    for program in (f"from yars.session import Session; print(Session('{SESSION}', 'foreign').set_runs())",
                    f"import yars; print(yars.Session('{SESSION}', 'foreign').set_runs())"):
        python = run(sys.executable, "-B", "-c", program, folder=folder, PYTHONPATH=modules)
        expect(f"{how}: the client in Python takes part", python.stdout == "False\n", python)
    example = run(sys.executable, "-B", prefix / "share/doc/yars/examples/fly.py", SESSION, folder=folder,
                  PYTHONPATH=modules)
    expect(f"{how}: the example in Python takes part", example.returncode == 0, example)
    errors = host.communicate(timeout=240)[1]
    expect(f"{how}: the embedding program", host.returncode == 0, errors)
    check_picture(how, folder / "scene.ppm")


def shown(words):
    """The first block of docs/attach.md that has these words."""
    blocks = re.findall(r"(?:^(?:    .*|)\n)+", ATTACH, re.M)
    return "\n".join(line[4:] for line in next(block for block in blocks if words in block).splitlines()) + "\n"


def by_cmake(folder, prefix, kind):
    """The examples with the CMakeLists.txt beside them, as they are installed; what docs/attach.md shows."""
    built = folder / "by_cmake"
    flags = " ".join(FLAGS)
    options = [f"-DCMAKE_PREFIX_PATH={prefix}", f"-DCMAKE_C_COMPILER={CC}", f"-DCMAKE_CXX_COMPILER={CXX}",
               f"-DCMAKE_C_FLAGS={flags}", f"-DCMAKE_CXX_FLAGS={flags}"]
    must(CMAKE, "-S", prefix / "share/doc/yars/examples", "-B", built, *options)
    must(CMAKE, "--build", built)
    documented = folder / "documented"
    documented.mkdir()
    (documented / "CMakeLists.txt").write_text(shown("cmake_minimum_required("))
    (documented / "mine.c").write_text(shown("int main(void)").replace('"databuffer/client/yars.h"', "<yars/yars.h>"))
    must(CMAKE, "-S", documented, "-B", documented / "build", *options)
    must(CMAKE, "--build", documented / "build")
    check_programs(f"{kind}, find_package", built, prefix)
    check_radar(f"{kind}, find_package", built / "first_picture")


def by_pkg_config(folder, prefix, kind):
    built = folder / "by_pkg_config"
    built.mkdir()
    library = library_of(prefix).parent

    def of(*words):
        return shlex.split(must("pkg-config", *words, PKG_CONFIG_PATH=library / "pkgconfig"))

    expect(f"{kind}: version by pkg-config", of("--modversion", "yars-client") == of("--modversion", "yars-display"))
    examples, client, display = prefix / "share/doc/yars/examples", of("--cflags", "yars-client"), of(
        "--cflags", "--libs", "yars-display", "epoxy")
    client_library = of("--libs", "yars-client")
    must(CC, *FLAGS, examples / "fly.c", *client, "-lm", "-o", built / "fly")
    must(CXX, *FLAGS, "-std=c++17", examples / "host_display.cpp", *display, "-o", built / "host_display")
    check_programs(f"{kind}, pkg-config", built, prefix, LD_LIBRARY_PATH=library)
    cflags = of("--cflags", "yars-radar")
    expect(f"{kind}: one set of flags for both libraries", cflags == of("--static", "--cflags", "yars-radar"), cflags)
    must(CXX, *FLAGS, "-std=c++20", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-c", examples / "first_picture.cpp",
         *cflags, "-o", built / "first_picture.o")
    must(CXX, *FLAGS, built / "first_picture.o", *of("--libs", "yars-radar"), "-o", built / "first_picture")
    check_radar(f"{kind}, pkg-config", built / "first_picture", LD_LIBRARY_PATH=library)
    static = ["-l:libyars-radar.a" if word == "-lyars-radar" else word
              for word in of("--static", "--libs", "yars-radar")]
    must(CXX, *FLAGS, built / "first_picture.o", *static, "-o", built / "static_picture")
    check_radar(f"{kind}, static", built / "static_picture")
    for compiler, name, more in ((CC, "strict.c", ["-std=c99", "-pedantic"]),
                                 (CXX, "strict.cpp", ["-std=c++11", "-Wno-missing-field-initializers"])):
        (built / name).write_text(STRICT)
        must(compiler, *FLAGS, *more, "-Wall", "-Wextra", "-Werror", built / name, *display, *client_library,
             "-o", built / "strict")
        strict = run(built / "strict", LD_LIBRARY_PATH=library)
        expect(f"{kind}: {name}", strict.returncode == 0, strict)


def check_symbols(prefix):
    """The libraries show what their headers declare and nothing else, which could clash with the host's."""
    for name in ("client", "display"):
        shown = {line.split()[-1] for line in must("nm", "-D", "--defined-only", library_of(prefix, name)).splitlines()}
        header = (prefix / f"include/yars/yars_{name}.h").read_text()
        declared = set(re.findall(rf"^YARS_{name.upper()}_API.*?(yars_{name}_\w+)\(", header, re.M))
        expect(f"functions of libyars-{name}", len(declared) > 10 and shown == declared, sorted(shown ^ declared)[:20])
    needed = re.findall(r"Shared library: \[(.*?)[.-]", must("readelf", "-d", library_of(prefix, "client")))
    expect("libyars-client needs the C++ library alone",
           {"libc", "libstdc++"} <= set(needed) <= {"libc", "libstdc++", "libgcc_s", "libm", "ld"}, needed)
    shown = {line.split(" ", 2)[-1]
             for line in must("nm", "-DC", "--defined-only", library_of(prefix, "radar")).splitlines()}
    of_classes = {name for name in shown
                  if re.match(r"(typeinfo.* for )?yars::(Error|Patch|Radar|Recording|Scan|Scene|Terrain)\b", name)}
    expect("names of libyars-radar", len(shown) > 40 and shown == of_classes, sorted(shown - of_classes)[:20])


def check_refusals(folder):
    """Where only the headers are installed, and another version."""
    prefix = installed(folder, PARTS[:1])
    major, minor = re.search(r"VERSION (\d+)\.(\d+)",
                             (SOURCE / "CMakeLists.txt").read_text().partition("project(")[2]).groups()
    for number, (wanted, good) in enumerate(((f"{major}.{minor} REQUIRED COMPONENTS client", True), ("REQUIRED", True),
                                             (f"{major}.{minor} REQUIRED COMPONENTS display", False),
                                             ("0.1 REQUIRED", False),
                                             ("1.0 REQUIRED", False))):
        project = folder / f"wants_{number}"
        project.mkdir()
        (project / "CMakeLists.txt").write_text(WANTS % wanted)
        done = run(CMAKE, "-S", project, "-B", project / "build", f"-DCMAKE_PREFIX_PATH={prefix}")
        expect(f"find_package(yars {wanted})", (done.returncode == 0) == good, done.stderr)


def check_python(prefix):
    """`import yars` after `apt install python3-yars`: Debian's Python looks where the package puts it."""
    looks = run("/usr/bin/python3", "-c", "import sys; print(*sys.path, sep='\\n')").stdout.splitlines()
    at = [path for path in looks if (prefix.parent / path.lstrip("/") / "yars/session.py").is_file()]
    trade, value = prefix / "trade.json", {"mean": 1.0, "worst": 2.0}
    trade.write_text(json.dumps(
        {"axes": {"time": {"column": "ms", "title": "time"}, "errors": [{"column": "m", "title": "error"}] * 2},
         "points": [{"point": "one", "family": "preset", "ms": value, "m": value}]}))
    drawn = run("/usr/bin/python3", "-B", prefix / "bin/yars-plot-trade", trade, prefix / "trade.png")
    expect("yars-plot-trade finds yars.plot beside it",
           (prefix / "trade.png").is_file() or "install the Debian package" in drawn.stderr, drawn)
    by_itself = run("/usr/bin/python3", "-B", "-I",
                    "-c", "import sys; sys.path.insert(0, sys.argv[1]); from yars.session import Session; "
                    "print('numpy' in sys.modules)", prefix / "lib/python3/dist-packages")
    expect("the session client needs no NumPy", by_itself.stdout == "False\n", by_itself)
    expect("yars/session.py where Debian's python3 looks", at == ["/usr/lib/python3/dist-packages"], looks)


expect("README has the example of the library",
       "```cpp\n" + (SOURCE / "examples/first_picture.cpp").read_text() + "```" in (SOURCE / "README.md").read_text())
with tempfile.TemporaryDirectory(dir=BUILD) as top:
    top = pathlib.Path(top)
    for kind in ("tree", "deb", "headers"):
        (top / kind).mkdir()
    check_refusals(top / "headers")
    tree = installed(top / "tree", PARTS)
    check_symbols(tree)
    by_pkg_config(top / "tree", tree, "tree")
    if ALL or not shutil.which("dpkg-shlibdeps"):
        by_cmake(top / "tree", tree, "tree")
    if shutil.which("dpkg-shlibdeps"):
        deb = unpacked(top / "deb")
        by_cmake(top / "deb", deb, "deb")
        if ALL:
            by_pkg_config(top / "deb", deb, "deb")
        check_python(deb)
    else:
        print("left out: the Debian package, which needs dpkg-dev")
print("\n".join(faults) or "a foreign project builds and runs")
sys.exit(1 if faults else 0)
