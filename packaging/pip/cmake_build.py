"""The compiled part of the package yars, built by CMake for the Python that pip runs in.

The build folder is, in this order: the one that the setting `build-folder` or YARS_BUILD_FOLDER names, which is built
but not configured; build/release, if it is configured for this Python; build/pip-cpXYZ, configured by the preset
release. What is missing ends the program with one message: what was expected, what was found, what to do."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig

SOURCE = pathlib.Path(__file__).resolve().parents[2]
LEAST_CMAKE = (3, 25)
REMEDY = f"run {SOURCE / 'scripts/setup'} --python, which installs Debian's packages"
SUFFIX = sysconfig.get_config_var("EXT_SUFFIX")


def give_up(message):
    sys.exit(f"yars: {message}")


def environment():
    """The caller's environment without the variables of pip and Python, which would hide installed packages."""
    return {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "PIP_"))}


def run(*command, **options):
    return subprocess.run([str(word) for word in command], env=environment(), text=True, check=False, **options)


def tool(name):
    found = shutil.which(name)
    return found or give_up(f"expected the program {name}, found none; {REMEDY}")


def check_cmake():
    printed = run(tool("cmake"), "--version", capture_output=True).stdout
    match = re.search(r"(\d+)\.(\d+)", printed)
    if not match or tuple(map(int, match.groups())) < LEAST_CMAKE:
        give_up(f"expected cmake {LEAST_CMAKE[0]}.{LEAST_CMAKE[1]} or later, "
                f"found {printed.partition(chr(10))[0]!r}; {REMEDY}")
    tool("ninja")


def numpy_version(python):
    """Version of the NumPy of a Python; empty: it has none."""
    return run(python, "-c", "import numpy; print(numpy.__version__)", capture_output=True).stdout.strip()


def interpreter():
    """The Python to build for: that behind a virtual environment, which outlives it, else the environment's,
    with NumPy."""
    base = getattr(sys, "_base_executable", None) or sys.executable
    for python in (os.path.realpath(base), sys.executable):
        if numpy_version(python):
            return python
    give_up(f"expected NumPy of {base} or of {sys.executable}, found none; {REMEDY}. An environment sees them when it "
            "is made by python3 -m venv --system-site-packages of Debian's /usr/bin/python3")


def cached(folder):
    """Entries of a build folder's CMakeCache.txt; empty: it is not configured."""
    try:
        text = (folder / "CMakeCache.txt").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return {}
    return dict(re.findall(r"^([^#/\n][^:\n]*):[A-Z]+=(.*)$", text, re.M))


def fits(folder, python):
    """Whether a build folder is a release build of these sources, with the compiled part for this Python."""
    cache = cached(folder)
    return (pathlib.Path(cache.get("CMAKE_HOME_DIRECTORY", "/")) == SOURCE and
            cache.get("CMAKE_BUILD_TYPE") == "Release"
            and cache.get("YARS_PYTHON", "OFF") != "OFF"
            and os.path.realpath(cache.get("YARS_PYTHON_EXECUTABLE", "")) == os.path.realpath(python))


def configure(folder, python):
    done = run("cmake", "--preset", "release", "-B", folder, "-DYARS_TESTS=OFF", "-DYARS_PYTHON=ON",
               f"-DYARS_PYTHON_EXECUTABLE={python}", cwd=SOURCE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        print(done.stdout)
        missing = re.search(r"YARS_PYTHON=ON: ([^;]*);", re.sub(r"\s+", " ", done.stdout))
        give_up(f"{missing[1] if missing else f'cmake could not configure {folder}; its messages stand above'}; "
                f"{REMEDY}")


def build_folder(settings):
    """The build folder for the compiled part, configured."""
    named = (settings or {}).get("build-folder") or os.environ.get("YARS_BUILD_FOLDER")
    if named:
        folder = pathlib.Path(named).resolve()
        if not cached(folder):
            give_up(f"build-folder: expected a build folder of cmake, found none at {folder}; "
                    "configure it: cmake --preset release")
        return folder
    python = interpreter()
    release = SOURCE / "build/release"
    if fits(release, python):
        return release
    folder = SOURCE / f"build/pip-cp{sys.version_info.major}{sys.version_info.minor}"
    configure(folder, python)
    return folder


def build(settings):
    """Builds the compiled part; returns the build folder, which has the whole package in python/yars."""
    check_cmake()
    folder = build_folder(settings)
    jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL") or len(os.sched_getaffinity(0))
    if run("cmake", "--build", folder, "--target", "yars_python", "--parallel", jobs).returncode != 0:
        give_up(f"cmake could not build the target yars_python in {folder}; its messages stand above")
    if not (folder / f"python/yars/_core{SUFFIX}").is_file():
        give_up(f"expected python/yars/_core{SUFFIX} in {folder}, found none; configure it for this Python: "
                f"cmake {folder} -DYARS_PYTHON=ON -DYARS_PYTHON_EXECUTABLE={os.path.realpath(sys.executable)}")
    return folder


def compiled_parts(folder, stage, library):
    """The compiled part and the library of this name as CMake installs them, without symbols,
    below the folder `stage`."""
    found = []
    for component, name in (("python_core", f"_core{SUFFIX}"), ("client", library)):
        done = run("cmake", "--install", folder, "--component", component, "--strip", "--prefix", stage,
                   capture_output=True)
        there = list(pathlib.Path(stage).rglob(name))
        if done.returncode != 0 or len(there) != 1:
            give_up(f"cmake --install {folder}: expected one {name}, found {len(there)}: {done.stderr.strip()}")
        found += there
    return found
