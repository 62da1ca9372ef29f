"""The build backend of pip for the package yars (PEP 517, PEP 660): hooks that make a wheel, a wheel of links for
`pip install -e`, and a source archive. Python's standard library and CMake alone; no network.

    pip install .                                    builds the compiled part, or takes it from build/release
    pip install . --config-settings build-folder=D   takes it from the build folder D; also YARS_BUILD_FOLDER=D
"""
import io
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tarfile
import tempfile

import cmake_build
from wheel_file import EARLIEST, WheelFile

try:
    import tomllib
except ImportError:
    sys.exit(f"yars: expected Python 3.11 or later, found {sys.version.split()[0]}; "
             "use /usr/bin/python3 of Debian 12 or later")

SOURCE = cmake_build.SOURCE
SUFFIXES = (".py", ".pyi", "py.typed", ".yaml", ".json")


def version():
    """Version of the programs, from CMakeLists.txt."""
    return re.search(r"^project\(yars VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text(encoding="utf-8"),
                     re.M)[1]


def date():
    """Seconds of POSIX for all entries of an archive: SOURCE_DATE_EPOCH, else the commit's."""
    if "SOURCE_DATE_EPOCH" in os.environ:
        return int(os.environ["SOURCE_DATE_EPOCH"])
    commit = (subprocess.run(["git", "-C", SOURCE, "log", "-1", "--format=%ct"], capture_output=True, text=True,
                             check=False) if (SOURCE / ".git").exists() else None)
    return int(commit.stdout) if commit and commit.returncode == 0 and commit.stdout else EARLIEST


def tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def metadata(numpy=""):
    """The file METADATA. `numpy`: the version that the compiled part is built with;
    a later major version has another ABI."""
    settings = tomllib.loads((SOURCE / "pyproject.toml").read_text(encoding="utf-8"))
    project, extras = settings["project"], settings["tool"]["yars"]["extras"]
    major = numpy.partition(".")[0]
    fitting = f"numpy<{int(major) + 1}" if major.isdigit() else "numpy"
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {version()}",
             f"Summary: {project['description']}", f"Author: {project['authors'][0]['name']}",
             f"License: {project['license']['text']}", "License-File: LICENSE",
             *(f"Classifier: {text}" for text in project["classifiers"]),
             f"Requires-Python: {project['requires-python']}"]
    for extra, names in extras.items():
        lines.append(f"Provides-Extra: {extra}")
        lines += [f'Requires-Dist: {fitting if name == "numpy" else name}; extra == "{extra}"' for name in names]
    return "\n".join(lines) + "\n"


def information():
    """Files of the folder dist-info that describe the package."""
    return {"METADATA": metadata(cmake_build.numpy_version(cmake_build.interpreter())),
            "LICENSE": (SOURCE / "LICENSE").read_text(encoding="utf-8"), "top_level.txt": "yars\n"}


def new_wheel():
    """A wheel with the files that both kinds have."""
    wheel = WheelFile("yars", version(), tag())
    for name, text in information().items():
        wheel.add(f"{wheel.information}/{name}", text)
    script = (SOURCE / "scripts/plot_trade").read_text(encoding="utf-8")
    # The first line that pip replaces by the path of the environment's Python.
    wheel.add(f"{wheel.scripts}/yars-plot-trade", "#!python\n" + script.partition("\n")[2], executable=True)
    return wheel


def get_requires_for_build_wheel(config_settings=None):
    return []


get_requires_for_build_editable = get_requires_for_build_sdist = get_requires_for_build_wheel


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    folder = pathlib.Path(metadata_directory, f"yars-{version()}.dist-info")
    folder.mkdir(parents=True)
    for name, text in information().items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder.name


prepare_metadata_for_build_editable = prepare_metadata_for_build_wheel


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    built = cmake_build.build(config_settings)
    wheel = new_wheel()
    wheel.add_folder(SOURCE / "python/yars", "yars", SUFFIXES)
    # The compiled part finds the configurations that came with it below its own folder.
    wheel.add_folder(SOURCE / "config", "yars/share/yars/config", (".guf",))
    with tempfile.TemporaryDirectory() as stage:
        for library in cmake_build.compiled_parts(built, stage, f"libyars-client.so.{version().rpartition('.')[0]}"):
            wheel.add(f"yars/{library.name}", library.read_bytes(), executable=True)
    return wheel.write(wheel_directory, date())


def build_editable(wheel_directory, config_settings=None, metadata_directory=None):
    """A wheel with a path: the build folder has links to the sources, and the compiled part."""
    built = cmake_build.build(config_settings)
    wheel = new_wheel()
    wheel.add("yars.pth", f"{built / 'python'}\n")
    return wheel.write(wheel_directory, date())


def build_sdist(sdist_directory, config_settings=None):
    listed = subprocess.run(["git", "-C", SOURCE, "ls-files", "-z"], capture_output=True, text=True, check=False)
    if listed.returncode != 0:
        sys.exit(f"yars: expected a git checkout for a source archive, found none at {SOURCE}; take that of a release")
    name = f"yars-{version()}"
    with tarfile.open(pathlib.Path(sdist_directory, f"{name}.tar.gz"), "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for file in sorted(filter(None, listed.stdout.split("\0"))):
            archive.add(SOURCE / file, f"{name}/{file}", recursive=False)
        text = metadata().encode()
        entry = tarfile.TarInfo(f"{name}/PKG-INFO")
        entry.size, entry.mtime = len(text), date()
        archive.addfile(entry, io.BytesIO(text))
    return f"{name}.tar.gz"
