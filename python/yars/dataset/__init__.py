"""Data sets of radar chips: made by `python3 -m yars.dataset SPEC --out DIR`, read by `Dataset(DIR)`.

Inputs: a specification (YAML), terrain, scenes. Outputs: arrays with labels, oriented boxes, a manifest.
docs/datasets.md."""
__all__ = ["Dataset", "DatasetError", "SpecError", "main", "read_spec"]


class DatasetError(RuntimeError):
    """Fault of the world or of a specification, with a message for the user. The command ends with exit code 1."""


class SpecError(DatasetError):
    """Faults of a specification, one a line: FILE:LINE: expected ..., found ...; ..."""


def __getattr__(name):  # what needs numpy or yaml is loaded at first use
    if name == "Dataset":
        from .reader import Dataset
        return Dataset
    if name == "read_spec":
        from .spec import read_spec
        return read_spec
    if name == "main":
        from .run import main
        return main
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__():
    return sorted({*globals(), *__all__})
