"""YARS, an air-to-ground radar simulation, for Python 3.9+: real beam maps, patch maps, sessions and pictures.

    Terrain, Scene, Radar, Recording, trade    the kernels, compiled; results are NumPy arrays
    yars.session                               client of a running session; calls libyars-client
    yars.plot                                  pictures by matplotlib
    yars.dataset                               training data by the million

Each name is loaded at its first use: `import yars` needs neither NumPy nor the compiled part. What a name needs and
does not find raises MissingPart, an Error and an ImportError, which says what to install. The names of yars.session,
such as yars.Session, stand here, too. Usage: python.md among the documents of YARS.
"""
import importlib
import importlib.machinery
import importlib.util
import pathlib
import platform

__version__ = "0.5.0"

# Module of the package -> its names that are names of the package. Typed in __init__.pyi.
_NAMES = {
    "results": ("Terrain", "Scene", "Radar", "Scan", "Patch", "Recording", "trade", "PATCH_ORDER", "MOVER"),
    "session": ("Session", "YarsError", "UnknownField", "Record", "patch_map", "Event", "Power", "Mode", "Master",
                "ScanWidth", "CursorFunction", "Navigator", "PointKind", "Recall", "SteeringLine", "SteeringCommand",
                "RadarFlags", "SweepFlags", "ModelFlags", "OwnshipFlags", "NavFlags"),
}
_MODULES = ("session", "plot", "dataset")
_MODULE_OF = {name: module for module, names in _NAMES.items() for name in names}
# Module of others -> its Debian package.
_PACKAGES = {"numpy": "python3-numpy", "xarray": "python3-xarray", "matplotlib": "python3-matplotlib",
             "zarr": "python3-zarr", "numcodecs": "python3-numcodecs", "yaml": "python3-yaml",
             "rasterio": "python3-rasterio", "dask": "python3-dask", "distributed": "python3-distributed"}


class Error(RuntimeError):
    """A file, session or package that is missing or cannot be used.
    The message says what was expected, found, and what to do."""


class MissingPart(Error, ImportError):
    """A package, or the compiled part of this one, that a name needs and that is not installed."""


def _require(name, purpose):
    """The module `name` of others. `purpose`: what needs it, for the message of MissingPart."""
    try:
        return importlib.import_module(name)
    except ImportError as problem:
        package = _PACKAGES.get(name.partition(".")[0])
        remedy = f"install the Debian package {package}" if package else "install it"
        found = ("none" if isinstance(problem, ModuleNotFoundError) and problem.name == name
                 else f"one that fails: {problem}")
        raise MissingPart(f"{purpose}: expected the Python module {name}, found {found}; {remedy}") from problem


def _compiled(name):
    """The module yars._core, which has `name`."""
    purpose = f"yars.{name}"
    _require("numpy", purpose)
    try:
        return importlib.import_module("._core", __name__)
    except ImportError as problem:
        raise MissingPart(f"{purpose}: {_fault_of_core(problem)}") from problem


def _fault_of_core(problem):
    """Message about yars._core, which did not load because of `problem`, with what to do."""
    folders = [pathlib.Path(folder) for folder in __path__]
    built = sorted(path.name for folder in folders for path in folder.glob("_core.*.so"))
    fitting = importlib.machinery.EXTENSION_SUFFIXES
    if not built:
        return (f"expected _core{fitting[0]} in {folders[0]}, found none; install the Debian package python3-yars; of "
                "a checkout build the target yars_python and put the folder python of its build into PYTHONPATH")
    if not any(name == "_core" + suffix for name in built for suffix in fitting):
        return (f"expected _core{fitting[0]}, found {', '.join(built)} in {folders[0]}: "
                f"it is for another Python than this one ({platform.python_version()}); use /usr/bin/python3, "
                "or build the target yars_python for this one")
    return f"expected {built[0]} in {folders[0]} to load, found: {problem}; install or build it again"


def _available():
    """Names of this package whose modules are installed. Does not load them."""
    def found(module):
        try:
            return importlib.util.find_spec(module, __name__) is not None
        except ImportError:
            return False

    needs = {"results": ("numpy", "._core", ".results"), "session": (".session",),
             "plot": ("numpy", "matplotlib", ".plot"), "dataset": ("numpy", "._core", ".dataset")}
    there = {module for module, others in needs.items() if all(map(found, others))}
    return ["Error", "MissingPart", *(name for name in _MODULES if name in there),
            *(name for name, module in _MODULE_OF.items() if module in there)]


def __getattr__(name):
    if name in _MODULES:
        return importlib.import_module("." + name, __name__)
    if name == "__all__":
        return _available()
    if name not in _MODULE_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    if _MODULE_OF[name] == "results":
        _compiled(name)
    module = importlib.import_module("." + _MODULE_OF[name], __name__)
    globals()[name] = value = getattr(module, name)
    return value


def __dir__():
    return sorted({*globals(), *_available()})
