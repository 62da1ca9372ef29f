"""Arguments of the compiled part, and its errors.

What this module refuses is a TypeError for a wrong kind of value, and a ValueError for a wrong value. Each message
names the function and the argument, and says what was expected and found.
"""
import difflib
import math
import numbers
import os

from . import Error

_LONGEST = 60  # characters of a value in a message


def shown(value):
    """A value for a message: its kind, and the value where it is short."""
    kind = type(value).__name__
    if value is None:
        return "None"
    if getattr(value, "ndim", 0) and hasattr(value, "shape"):
        return f"{kind} of shape {tuple(value.shape)}"
    try:
        text = ascii(value) if isinstance(value, str) else repr(value)
    except Exception:  # pylint: disable=broad-except
        # A value's own repr may fail, as that of a number of too many digits.
        return kind
    return f"{kind} {text}" if len(text) <= _LONGEST else f"{kind} {text[:_LONGEST]}..."


def kind_error(where, expected, value):
    return TypeError(f"{where}: expected {expected}, found {shown(value)}")


def instance(where, value, kind, optional=False):
    """The value, an instance of the class `kind` of this package; None only if optional."""
    if isinstance(value, kind) or (optional and value is None):
        return value
    raise kind_error(where, f"a yars.{kind.__name__}" + (" or None" if optional else ""), value)


def text(where, value, expected="a text"):
    """A str that can be written as UTF-8."""
    if not isinstance(value, str):
        raise kind_error(where, expected, value)
    try:
        value.encode()
    except UnicodeEncodeError:
        raise ValueError(f"{where}: expected {expected}, "
                         f"found {shown(value)} with parts of characters (surrogates)") from None
    if "\0" in value:
        raise ValueError(f"{where}: expected {expected}, found {shown(value)} with a zero character")
    return value


def path(where, value, expected="a path (str, bytes or os.PathLike)"):
    """The bytes of a path as given."""
    try:
        found = os.fsencode(value)
    except TypeError:
        raise kind_error(where, expected, value) from None
    except UnicodeEncodeError:
        raise ValueError(f"{where}: expected a path of this system, found {shown(value)}") from None
    if not found or b"\0" in found:
        raise ValueError(f"{where}: expected {expected}, found {'an empty one' if not found else shown(value)}")
    return found


def absolute(found):
    """The absolute path of a path in bytes. Links before `..` keep their meaning."""
    whole_path = found if os.path.isabs(found) else os.path.join(os.getcwdb(), found)
    return whole_path if b".." in whole_path.split(b"/") else os.path.normpath(whole_path)


def several(value):
    """A list of the entries of a list, tuple or array of one axis; None: it is one value."""
    if isinstance(value, (list, tuple)) or (getattr(value, "ndim", 0) == 1 and hasattr(value, "tolist")):
        return list(value)
    return None


def plain(value):
    """A number or truth value of NumPy, also as an array without axes, as Python's."""
    return value.item() if getattr(value, "ndim", None) == 0 and hasattr(value, "item") else value


def truth(where, value):
    value = plain(value)
    if not isinstance(value, bool):
        raise kind_error(where, "True or False", value)
    return value


def whole(where, value, low, high, optional=False):
    """A whole number from low to high."""
    value = plain(value)
    if optional and value is None:
        return None
    limits = f"a whole number from {low} to {high}" + (" or None" if optional else "")
    if isinstance(value, bool) or not isinstance(value, numbers.Integral):
        raise (ValueError(f"{where}: expected {limits}, found {shown(value)}")
               if isinstance(value, numbers.Real) and not isinstance(value, bool) else kind_error(where, limits, value))
    if not low <= value <= high:
        raise ValueError(f"{where}: expected {limits}, found {shown(int(value))}")
    return int(value)


class Request:
    """Keyword arguments of a function that are the fields of a request (requests.idl).

    kind: the compiled class. rows: its fields, as the compiled part lists them. others: arguments that are no fields.
    """

    def __init__(self, function, kind, rows, others=()):
        self.function, self.kind, self.others = function, kind, others
        self.rows = {row[0]: row[1:] for row in rows}

    def of(self, given):
        """The request with the arguments given."""
        fields = {}
        for name, value in given.items():
            if name not in self.rows:
                self._refuse(name)
            kind, optional, low, high = self.rows[name]
            value = plain(value)
            if value is not None or not (optional or kind == "truth value"):
                fields[name] = self._checked(f"{self.function}: {name}", kind, value, low, high)
        return self.kind(fields)

    def _refuse(self, name):
        known = [*self.rows, *self.others]
        near = difflib.get_close_matches(name, known, 1) or [word for word in known if word.startswith(name)]
        raise ValueError(f"{self.function}: expected arguments of {', '.join(known)}, found {ascii(name)[:_LONGEST]}"
                         + (f"; did you mean {near[0]}?" if near else f"; see help({self.function})"))

    @staticmethod
    def _checked(where, kind, value, low, high):
        if kind == "truth value":
            return truth(where, value)
        if kind == "whole number":
            return whole(where, value, *((int(low), int(high)) if math.isfinite(high) else (0, 2 ** 64 - 1)))
        if kind == "number":
            return number(where, value)
        if kind == "text":
            return text(where, value)
        if kind == "texts":
            given = [value] if isinstance(value, str) else several(value)
            if given is None:
                raise kind_error(where, "a text, or a list of texts", value)
            return [text(where, one) for one in given]
        if not isinstance(value, str):
            raise kind_error(where, f"one of {', '.join(kind)}", value)
        if value not in kind:
            raise ValueError(f"{where}: expected one of {', '.join(kind)}, found {shown(value)}")
        return kind.index(value)


def number(where, value):
    """A finite number as float."""
    if isinstance(value, bool) or not (isinstance(value, numbers.Real) or type(value).__name__ == "Decimal"):
        raise kind_error(where, "a number", value)
    try:
        value = float(value)
    except OverflowError:
        raise ValueError(f"{where}: expected a number, found {shown(value)}, which is too large") from None
    if not math.isfinite(value):
        raise ValueError(f"{where}: expected a finite number, found {value}")
    return value


class Said:
    """with Said("yars.Radar.scan"): messages of the compiled part begin with the function's name."""

    def __init__(self, function):
        self.function = function

    def __enter__(self):
        return self

    def __exit__(self, kind, problem, _):
        if kind in (ValueError, Error):
            said = kind(f"{self.function}: {problem}")
            vars(said).update(vars(problem))
            raise said from None


class Held:
    """Base of the classes that hold an object of the compiled part as `_core`. What makes it are the arguments of
    _make(), which must have no relative paths: a pickle has them, and the attributes of a subclass."""

    def _made(self, *arguments):
        self._core = self._make(*arguments)
        self._arguments = arguments

    def _make(self, *arguments):
        raise NotImplementedError

    def __getattr__(self, name):
        kind = type(self)
        if name in ("_core", "_arguments"):
            base = next(one.__name__ for one in kind.__mro__
                        if one.__module__ == __package__ or one.__module__.startswith("yars."))
            raise TypeError(f"yars.{base}: expected an object whose __init__ has run, "
                            f"found one of {kind.__name__} without; call super().__init__() first")
        raise AttributeError(f"{kind.__name__!r} object has no attribute {name!r}")

    def __getstate__(self):
        others = {name: value for name, value in vars(self).items() if name not in ("_core", "_arguments")}
        return self._arguments, others

    def __setstate__(self, state):
        arguments, others = state
        vars(self).update(others)
        self._made(*arguments)

    def __reduce__(self):
        return type(self).__new__, (type(self),), self.__getstate__()
