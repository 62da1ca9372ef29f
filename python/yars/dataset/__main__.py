"""`python3 -m yars.dataset`: see run.py."""
import sys

try:
    from .run import main
except ModuleNotFoundError as problem:
    package = {"yaml": "python3-yaml", "numpy": "python3-numpy"}.get(problem.name)
    if package is None:
        raise
    sys.exit(f"yars dataset: expected the Python module {problem.name}, found none; "
             f"install the Debian package {package}")
if __name__ == "__main__":
    sys.exit(main())
