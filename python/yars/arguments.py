"""Arguments of the compiled part, and its messages in Python's words.

What this module refuses is a TypeError for a wrong kind of value, and a ValueError for a wrong value. Each message
names the function and the argument, and says what was expected and found.
"""
import difflib
import math
import numbers
import os
import re
import warnings

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


def _value(where, value):
    """The text of an option's value. Python's own number texts are the shortest that give the same number again."""
    value = plain(value)
    expected = "a number or a text"
    if isinstance(value, str):
        if not text(where, value, expected).strip():
            raise ValueError(f"{where}: expected {expected}, found an empty text; leave it out for the default")
        return value
    if isinstance(value, bool) or value is None:
        raise kind_error(where, expected, value)
    if isinstance(value, numbers.Integral):
        return _digits(where, int(value))
    if isinstance(value, numbers.Real) or type(value).__name__ == "Decimal":
        try:
            return repr(float(value))
        except OverflowError:
            raise ValueError(f"{where}: expected {expected}, found {shown(value)}, which is too large") from None
    raise kind_error(where, expected, value)


def _digits(where, value):
    if abs(value) >= 10 ** 30:
        raise ValueError(f"{where}: expected a number, found a whole number of more than 30 digits")
    return str(value)


class Request:
    """Keyword arguments of a function that are the fields of a request (requests.idl).
    An older keyword gives a warning.

    kind: the compiled class. rows: its fields, as the compiled part lists them.
    """

    def __init__(self, function, kind, rows):
        self.function, self.kind = function, kind
        self.rows = {row[0]: row[2:] for row in rows}
        self.older = {row[1]: row[0] for row in rows if row[1] != row[0]}

    def of(self, given):
        """The request with the arguments given."""
        fields = {}
        for key, value in given.items():
            name = key if key in self.rows else self._renamed(key)
            if name in fields:
                raise TypeError(f"{self.function}: expected {name} once, found it twice: {key} is an older word for it")
            kind, optional, low, high = self.rows[name]
            value = plain(value)
            if value is not None or not (optional or kind == "truth value"):
                fields[name] = self._checked(f"{self.function}: {key}", kind, value, low, high)
        return self.kind(fields)

    def _renamed(self, key):
        name = self.older.get(key)
        if name is None:
            near = difflib.get_close_matches(key, [*self.rows, *self.older], 1)
            raise ValueError(f"{self.function}: expected arguments of {', '.join(self.rows)}, "
                             f"found {ascii(key)[:_LONGEST]}"
                             + (f"; did you mean {near[0]}?" if near else f"; see help({self.function})"))
        warnings.warn(f"{self.function}: {key} is an older word for {name}, and goes with the next version",
                      DeprecationWarning, stacklevel=4)
        return name

    @staticmethod
    def _checked(where, kind, value, low, high):
        if kind == "truth value":
            return truth(where, value)
        if kind == "whole number":
            return whole(where, value, *((int(low), int(high)) if math.isfinite(high) else (0, 2 ** 64 - 1)))
        if kind == "number":
            return number(where, value)
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


class Options:
    """Keyword arguments of a function that are the options of a command.

    flags: names that are True or False. lists: that take several values. optional: for which None is the default.
    paths: files to write. commas: lists that become one text. Others take one value.
    """

    def __init__(self, function, names, *, flags=(), lists=(), optional=(), paths=(), commas=()):
        self.function, self.names = function, tuple(names)
        self.flags, self.lists, self.optional, self.paths, self.commas = flags, lists, optional, paths, commas

    def words(self, given):
        """Words of the command's line: lat=37.5 is --lat=37.5, alt_ft is --alt-ft, a list repeats its option."""
        words = []
        for name, value in given.items():
            where = f"{self.function}: {name}"
            if name not in self.names:
                near = difflib.get_close_matches(name, self.names, 1)
                raise ValueError(f"{self.function}: expected arguments of {', '.join(self.names)}, "
                                 f"found {ascii(name)[:_LONGEST]}"
                                 + (f"; did you mean {near[0]}?" if near else f"; see help({self.function})"))
            option = "--" + name.replace("_", "-")
            if value is None and (name in self.optional or name in self.flags):
                continue
            if name in self.flags:
                words += [option] if truth(where, value) else []
            elif name in self.paths:
                words.append(os.fsencode(option + "=") + path(where, value))
            else:
                words += [f"{option}={one}" for one in self._values(where, name, value)]
        return words

    def _values(self, where, name, value):
        entries = several(value)
        if name == "seed" and not isinstance(value, str):
            return [str(whole(where, value, 0, 2 ** 64 - 1))]
        if entries is None:
            return [_value(where, value)]
        if name in self.commas:
            return [",".join(_value(where, entry) for entry in entries)]
        if name not in self.lists:
            raise kind_error(where, "one number or text", value)
        return [_value(f"{where}[{at}]", entry) for at, entry in enumerate(entries)]


# Words of the commands' messages -> Python's. Texts in quotes are values, and stay.
_WORDS = ((r"--terrain\b", "terrain"), (r"--fidelity (\w+)", r'a Radar("\1")'), (r"--scene-without\b", "without"),
          (r"--origin@", "origin "), (r"\b([Ss]ee) (yars\.[A-Za-z.]+) --help", r"\1 help(\2)"),
          (r"`yars (terrain|scene) generate(?: --out \w+)?`", lambda found: f"yars.{found[1].capitalize()}.generate()"),
          (r"\bgive --force\b", "give force=True"), (r"\bgive --([a-z-]+) (-?[0-9.]+)", r"give --\1=\2"),
          (r"--([a-z][a-z0-9-]*)", lambda found: found[1].replace("-", "_")))


def in_python(message):
    """A message of the commands in Python's words; long numbers are cut."""
    message = re.sub(r"\d{40,}", lambda found: f"{found[0][:12]}... ({len(found[0])} digits)", message)
    parts = re.split(r"('[^']*')", message)
    for at in range(0, len(parts), 2):
        for pattern, word in _WORDS:
            parts[at] = re.sub(pattern, word, parts[at])
    return "".join(parts)


class Said:
    """with Said("yars.Radar.scan"): errors of the compiled part have Python's words and the function's name. `out`: the
    argument that is the option --out."""

    def __init__(self, function, out="out"):
        self.function, self.out = function, out

    def __enter__(self):
        return self

    def __exit__(self, kind, problem, _):
        if kind is not ValueError and kind is not Error:
            return
        if hasattr(problem, "expected"):  # an error of the library, which names arguments as Python does
            message = str(problem)
            said = kind(message if message.startswith("yars.") else f"{self.function}: {message}")
            vars(said).update(vars(problem))
            raise said from None
        message = re.sub(r"^(yars\.[\w.]+: )?--out:", lambda found: (found[1] or "") + self.out + ":", str(problem))
        message = in_python(message)
        raise kind(message if message.startswith("yars.") else f"{self.function}: {message}") from None


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
