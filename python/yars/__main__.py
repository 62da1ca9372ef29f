"""`python -m yars [--json]` prints what is installed: version and folder, the compiled part, the library of sessions,
packages of others that are there or missing, programs that are found.
Exit code 0 whatever is missing; 2 for an option that is not known."""
import importlib.metadata
import importlib.util
import json
import platform
import subprocess
import sys

import yars
from yars import programs

USAGE = "usage: python -m yars [--json]"
# Module of others whose distribution has another name.
DISTRIBUTIONS = {"yaml": "PyYAML"}
# Module of others -> what of this package needs it.
PURPOSES = {"numpy": "Terrain, Scene, Radar, Recording, trade", "xarray": ".to_xarray()", "matplotlib": "yars.plot",
            "zarr": "yars.dataset", "numcodecs": "yars.dataset with zarr", "yaml": "yars.dataset",
            "rasterio": "yars.dataset: GeoTIFF chips", "dask": "yars.dataset on several computers",
            "distributed": "yars.dataset on several computers"}


def version_of(module):
    """Version of another project's module, which is not loaded; "unknown": it has none; None: not installed."""
    try:
        if importlib.util.find_spec(module) is None:
            return None
        return importlib.metadata.version(DISTRIBUTIONS.get(module, module))
    except importlib.metadata.PackageNotFoundError:
        return "unknown"
    except ImportError:
        return None


def compiled_part():
    """(file of yars._core or None, why it does not load or None)."""
    try:
        return yars._compiled("Radar").__file__, None
    except yars.Error as problem:
        return None, str(problem).partition(": ")[2]


def library_of_sessions():
    """(libyars-client, why it is not found or None)."""
    try:
        return yars.session._library()._name, None
    except yars.Error as problem:
        return None, str(problem).partition(": ")[2]


def version_of_program(path):
    """Output of a program's --version; "" if it fails."""
    try:
        done = subprocess.run([path, "--version"], capture_output=True, text=True, timeout=30, stdin=subprocess.DEVNULL,
                              check=False)
    except (OSError, subprocess.SubprocessError):
        return ""
    return done.stdout.strip() if done.returncode == 0 and len(done.stdout.split()) == 1 else ""


def program(name):
    path = programs.path_of(name)
    # yars-start is a script that starts what is named here.
    return {"name": name, "path": path, "version": version_of_program(path) if path and name != "yars-start" else ""}


def installed():
    """All facts about this installation, as --json prints them."""
    file, problem = compiled_part()
    library, fault = library_of_sessions()
    return {"version": yars.__version__, "folder": list(yars.__path__)[0],
            "python": {"version": platform.python_version(), "executable": sys.executable},
            "compiled": {"file": file, "problem": problem}, "session": {"file": library, "problem": fault},
            "packages": [{"name": name, "version": version_of(name), "debian": debian, "for": PURPOSES[name]}
                         for name, debian in yars._PACKAGES.items()],
            "programs": [program(name) for name in programs.NAMES]}


def lines(found):
    """The facts of installed() as lines of text."""
    yield f"yars {found['version']} in {found['folder']}"
    yield f"Python {found['python']['version']}, {found['python']['executable']}"
    for name, part in (("compiled part", found["compiled"]), ("library of sessions", found["session"])):
        yield f"{name}: {part['file'] or 'missing: ' + part['problem']}"
    yield "packages of others:"
    for package in found["packages"]:
        state = package["version"] or f"missing; Debian package {package['debian']}"
        yield f"  {package['name']:<12} {state:<40} {package['for']}"
    yield "programs:"
    for one in found["programs"]:
        differs = (f", expected {found['version']}: install both of one version"
                   if one["version"] not in ("", found["version"]) else "")
        yield (f"  {one['name']:<14} {(one['path'] or 'missing; Debian package yars')} {one['version']}".rstrip() +
               differs)


def main(arguments):
    if arguments in (["-h"], ["--help"]):
        print(__doc__.strip())
        return 0
    if arguments not in ([], ["--json"]):
        print(f"yars: expected --json or nothing, found {' '.join(map(ascii, arguments))}; {USAGE}", file=sys.stderr)
        return 2
    found = installed()
    print(json.dumps(found, indent=2) if arguments else "\n".join(lines(found)))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
