"""Values of a YAML file with their lines: collects faults as FILE:LINE, so that one reading reports all of them."""
import difflib
import math
import re

import yaml

from . import SpecError
from .distributions import Choice, Fixed, LogUniform, Normal, Uniform
from .keys import INFINITY, KEYS, children, number_text, value_text

MOST_FAULTS = 20
LONGEST_SHOWN = 500  # [characters] of a part of a message
DISTRIBUTIONS = ("uniform", "log_uniform", "normal", "choice", "weighted")
MISSING = object()


def shown(text):
    """A part of a message, which may have texts of the file: cut where it is long, and without control characters."""
    cut = text[:LONGEST_SHOWN] + "..." if len(text) > LONGEST_SHOWN else text
    return "".join(letter if letter.isprintable() else letter.encode("unicode_escape", "backslashreplace").decode()
                   for letter in cut)


def found(node):
    """Short description of a node, for the part `found` of messages."""
    if isinstance(node, yaml.ScalarNode):
        return f'"{node.value}"' if node.tag.endswith("str") else (node.value or "nothing")
    return "a list" if isinstance(node, yaml.SequenceNode) else "a section"


def similar(name, names):
    near = difflib.get_close_matches(name, names, 1, 0.6)
    return f'did you mean "{near[0]}"?' if near else f"use one of {', '.join(names)}"


class Reader:
    """Reads scalars, lists and distributions from nodes. After a fault a method returns None and reading goes on."""

    def __init__(self, path, text):
        self.path, self.faults = str(path), []
        try:
            self.root = yaml.compose(text, Loader=yaml.SafeLoader)
        except yaml.MarkedYAMLError as error:
            mark = error.problem_mark or error.context_mark
            line = mark.line + 1 if mark else 1
            raise SpecError(f"{self.path}:{line}: expected YAML, found a fault: "
                            f"{error.problem or error.context}") from None
        except yaml.YAMLError as error:
            raise SpecError(f"{self.path}: expected YAML, found a fault: {' '.join(str(error).split())}") from None
        except RecursionError:
            raise SpecError(f"{self.path}: expected YAML, found too many levels") from None
        except ValueError as error:  # of PyYAML: an escape beyond the last character
            raise SpecError(f"{self.path}: expected YAML, found a fault: {error}") from None

    def where(self, node):
        return f"{self.path}:{node.start_mark.line + 1}"

    def fault(self, node, expected, what=None, action=""):
        text = f"{self.where(node)}: expected {shown(expected)}, found {shown(found(node) if what is None else what)}"
        self.faults.append(text + (f"; {shown(action)}" if action else ""))

    def finish(self):
        if self.faults:
            more = len(self.faults) - MOST_FAULTS
            lines = self.faults[:MOST_FAULTS] + ([f"{self.path}: {more} more faults"] if more > 0 else [])
            raise SpecError("\n".join(lines))

    def mapping(self, node, expected):
        """{name: (node of the name, node of the value)}; {} after a fault."""
        if not isinstance(node, yaml.MappingNode):
            self.fault(node, expected)
            return {}
        result = {}
        for name, value in node.value:
            if not isinstance(name, yaml.ScalarNode):
                self.fault(name, "a name", action="write name: value")
            elif name.value in result:
                self.fault(name, f"{name.value} once", "it twice", "remove one")
            else:
                result[name.value] = name, value
        return result

    def section(self, node, path):
        """{name: node} of a section; names that KEYS does not have are faults."""
        names = children(path)
        where = path or "the file"
        result = {}
        for name, (key, value) in self.mapping(node, f"{where} as a section (key: value)").items():
            if name in names:
                result[name] = value
            else:
                self.fault(key, f"a key of {where}", f'"{name}"', similar(name, names))
        for name in names:
            row = KEYS[f"{path}.{name}" if path else name]
            if row.default == "required" and name not in result:
                self.fault(node, f"the key {name} in {where}", "none", f"add {name}: {value_text(row)}")
        return result

    def items(self, node, expected):
        if isinstance(node, yaml.SequenceNode):
            return node.value
        self.fault(node, expected)
        return []

    def number(self, node, expected="a number", whole=False, least=-INFINITY, most=INFINITY):
        """int or float in [least, most]; None after a fault."""
        value = None
        if isinstance(node, yaml.ScalarNode) and node.style is None:
            try:
                value = float(node.value)
                if whole and value.is_integer():  # 1000, 1e3
                    value = int(node.value, 10) if re.fullmatch(r"[-+]?\d+", node.value) else int(value)
                elif whole:
                    value = None
            except ValueError:
                value = None
        if value is None or not math.isfinite(value):
            self.fault(node, expected)
            return None
        if not least <= value <= most:
            self.fault(node, expected,
                       action=(f"give one {'above' if value < least else 'below'} that end"
                               if math.isinf(least + most) else
                               f"the {'least' if value < least else 'greatest'} is "
                               f"{number_text(least if value < least else most)}"))
            return None
        return value

    def key_number(self, node, key):
        return self.number(node, f"{value_text(key)} for {key.path}", key.kind == "whole", key.least, key.most)

    def text(self, node, key):
        if not isinstance(node, yaml.ScalarNode) or not node.value:
            self.fault(node, f"{value_text(key)} for {key.path}")
            return None
        if key.values and node.value not in key.values:
            self.fault(node, f"{value_text(key)} for {key.path}", action=similar(node.value, key.values))
            return None
        return node.value

    def names(self, node, key):
        """List of texts; one text is a list of one."""
        nodes = [node] if isinstance(node, yaml.ScalarNode) else self.items(node, f"{value_text(key)} for {key.path}")
        result = []
        for item in nodes:
            name = self.text(item, key)
            if name in result:
                self.fault(item, f"each name of {key.path} once", f'"{name}" twice', "remove one")
            result.append(name)
        return result

    def yes_no(self, node, key):
        if isinstance(node, yaml.ScalarNode) and node.tag.endswith("bool"):
            return node.value.lower() in ("true", "yes", "on")
        self.fault(node, f"true or false for {key.path}")
        return None

    def numbers(self, node, counts, expected):
        nodes = self.items(node, expected)
        values = [self.number(item, expected) for item in nodes]
        if nodes and len(values) not in counts:
            self.fault(node, expected, f"{len(values)} numbers")
            return None
        return None if None in values or not values else values

    def drawn(self, node, key, scalar=None):
        """A distribution: a plain value, or a section with one of DISTRIBUTIONS. `scalar` reads one value."""
        scalar = scalar or self.key_number
        expected = (f"{value_text(key)} for {key.path}, or one of " +
                    ", ".join(f"{{{name}: ...}}" for name in DISTRIBUTIONS))
        if isinstance(node, yaml.ScalarNode):
            value = scalar(node, key)
            return None if value is None else Fixed(value)
        if not isinstance(node, yaml.MappingNode) or not node.value:
            self.fault(node, expected)
            return None
        entries = self.mapping(node, expected)
        for name, (at, _) in entries.items():
            if name not in DISTRIBUTIONS and not (name == "cut" and "normal" in entries):
                self.fault(at, f"a distribution for {key.path}", f'"{name}"', similar(name, DISTRIBUTIONS))
                return None
        kinds = [name for name in entries if name != "cut"]
        if len(kinds) != 1:
            self.fault(node, f"one distribution for {key.path}", f"{len(kinds)}", "keep one")
            return None
        return getattr(self, "_" + kinds[0])(entries, key, scalar)

    def _pair(self, node, key, name):
        nodes = self.items(node, f"{{{name}: [LOW, HIGH]}} for {key.path}")
        if len(nodes) != 2:
            if nodes or isinstance(node, yaml.SequenceNode):
                self.fault(node, f"two numbers in {{{name}: ...}} for {key.path}", f"{len(nodes)}")
            return None
        pair = [self.key_number(item, key) for item in nodes]
        if None in pair:
            return None
        if pair[0] > pair[1]:
            self.fault(node, f"LOW before HIGH for {key.path}", f"{pair[0]:g}, {pair[1]:g}", "exchange them")
            return None
        return pair

    def _uniform(self, entries, key, _):
        node = entries["uniform"][1]
        several = isinstance(node, yaml.SequenceNode) and node.value and isinstance(node.value[0], yaml.SequenceNode)
        pairs = [self._pair(item, key, "uniform") for item in (node.value if several else [node])]
        if None in pairs:
            return None
        for before, after in zip(pairs, pairs[1:]):
            if after[0] < before[1]:
                self.fault(node, f"intervals in ascending order for {key.path}", f"{after[0]:g} after {before[1]:g}")
                return None
        return Uniform(pairs, key.kind == "whole")

    def _log_uniform(self, entries, key, _):
        node = entries["log_uniform"][1]
        pair = self._pair(node, key, "log_uniform")
        if pair is None or not self._continuous(node, key, "log_uniform"):
            return None
        if pair[0] <= 0:
            self.fault(node, f"a LOW above 0 in {{log_uniform: ...}} for {key.path}", f"{pair[0]:g}", "use uniform")
            return None
        return LogUniform(*pair)

    def _continuous(self, node, key, name):
        if key.kind != "whole":
            return True
        self.fault(node, f"uniform, choice or weighted for the whole number {key.path}", name)
        return False

    def _normal(self, entries, key, _):
        node = entries["normal"][1]
        pair = self.numbers(node, (2,), f"{{normal: [MEAN, DEVIATION]}} for {key.path}")
        if pair is None or not self._continuous(node, key, "normal"):
            return None
        if pair[1] <= 0:
            self.fault(node, f"a deviation above 0 for {key.path}", f"{pair[1]:g}", "give a plain value for none")
            return None
        cut = self._pair(entries["cut"][1], key, "cut") if "cut" in entries else [key.least, key.most]
        if cut is None:
            return None
        law = Normal(*pair, *cut)
        if law.mass < 1e-6:
            self.fault(node, f"a normal distribution for {key.path} with values in [{cut[0]:g}, {cut[1]:g}]",
                       "next to none there")
            return None
        return law

    def _choice(self, entries, key, scalar):
        nodes = self.items(entries["choice"][1], f"{{choice: [VALUE, ...]}} for {key.path}")
        values = [scalar(item, key) for item in nodes]
        if isinstance(entries["choice"][1], yaml.SequenceNode) and not nodes:
            self.fault(entries["choice"][1], f"values in {{choice: ...}} for {key.path}", "none")
        return Choice(values) if values and None not in values else None

    def _weighted(self, entries, key, scalar):
        node = entries["weighted"][1]
        expected = f"{{weighted: [[VALUE, WEIGHT], ...]}} for {key.path}"
        values, weights = [], []
        for item in self.items(node, expected):
            pair = self.items(item, expected)
            if len(pair) != 2:
                self.fault(item, expected)
                return None
            values.append(scalar(pair[0], key))
            weights.append(self.number(pair[1], f"a weight in [0, 1e9] for {key.path}", least=0, most=1e9))
        if None in values or None in weights or not values:
            return None
        if sum(weights) <= 0:
            self.fault(node, f"a weight above 0 for {key.path}", "none")
            return None
        return Choice(values, weights)
