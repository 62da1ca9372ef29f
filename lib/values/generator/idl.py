"""Parser of the records' IDL (interface definition language): the part of IDL 4.2 that records.idl uses.

In: modules, const, enum, bitmask and struct of the building blocks Core Data Types and Extended Data Types,
annotations, #include "file" from the same folder. Out: a list of schema.Chapter. Other text raises schema.IdlError with
file and line.
Source: OMG IDL 4.2 (formal/18-01-05), 7.4.1, 7.4.13, 7.4.15, 8.
"""
import math
import re

from . import schema
from .schema import IdlError

TOKEN = re.compile(r"""(?P<blank>[ \t\r]+)|(?P<line>\n)|(?P<comment>//[^\n]*)|(?P<include>\#include[ ]+"[^"\n]+")
    |(?P<number>(?:\d+\.\d*(?:[eE][-+]?\d+)?|\d+[eE][-+]?\d+|0[xX][0-9a-fA-F]+|\d+))|(?P<string>"(?:[^"\\\n]|\\.)*")
    |(?P<name>(?:::)?[A-Za-z]\w*(?:::[A-Za-z]\w*)*)|(?P<mark>[@(){}\[\]<>;:,=+\-*/])""", re.X)
ARITHMETIC = {"+": lambda a, b: a + b, "-": lambda a, b: a - b, "*": lambda a, b: a * b}
ANNOTATIONS = {"final", "nested", "bit_bound", "position", "unit", "range", "min", "max", "default", "nan",
               "counted_by", "cut",
               "by_hand", "request", "option", "otherwise", "optional", "shown", "different_picture",
               "parameters", "like", "cost", "wrong_shadow", "segment", "writer", "reserve", "status"}
TYPES = {**schema.INTEGERS, **schema.REALS}


class Token:
    def __init__(self, kind, text, line):
        self.kind, self.text, self.line = kind, text, line


class Scanner:
    """One file scanned: a list of tokens; comments by line number, alone on a line (above) or after code (behind)."""

    def __init__(self, name, text):
        self.name, self.tokens, self.above, self.behind = name, [], {}, {}
        line, at = 1, 0
        while at < len(text):
            found = TOKEN.match(text, at)
            if not found:
                raise IdlError(f"{name}:{line}", "IDL", repr(text[at]), "lib/values/fields.md has what is understood")
            kind, at = found.lastgroup, found.end()
            if kind == "comment":
                alone = not self.tokens or self.tokens[-1].line != line
                (self.above if alone else self.behind)[line] = found.group()[2:].strip()
            elif kind not in ("blank", "line"):
                self.tokens.append(Token(kind, found.group(), line))
            line += kind == "line"
        self.tokens.append(Token("end", "the end of the file", line))


class Parser:
    def __init__(self, folder, names=None, chapters=None):
        self.folder = folder
        self.names = {} if names is None else names  # {full name as a tuple: declaration}
        self.chapters = [] if chapters is None else chapters
        self.module, self.at = (), 0

    def parse(self, file):
        self.scan = Scanner(file, (self.folder / file).read_text(encoding="utf-8"))
        self.at = 0
        self.chapter = schema.Chapter(file.removesuffix(".idl"), self.head(), [])
        while self.token.kind != "end":
            if self.token.kind == "include":
                self.include()
            else:
                self.module_of_declarations()
        self.chapters.append(self.chapter)
        return self.chapters

    def include(self):
        name = self.token.text.split('"')[1]
        if not (self.folder / name).is_file():
            raise IdlError(self.where, "the name of a file beside records.idl", f"'{name}'")
        self.at += 1
        Parser(self.folder, self.names, self.chapters).parse(name)

    # ---- tokens
    @property
    def token(self):
        return self.scan.tokens[self.at]

    @property
    def where(self):
        return f"{self.scan.name}:{self.token.line}"

    def next(self):
        token = self.token
        self.at += 1
        return token

    def is_next(self, text):
        if self.token.text != text or self.token.kind == "string":
            return False
        self.at += 1
        return True

    def expect(self, text):
        if not self.is_next(text):
            raise IdlError(self.where, f"'{text}'", f"'{self.token.text}'")

    def expect_name(self, what):
        if self.token.kind != "name" or not schema.is_valid_name(self.token.text):
            raise IdlError(self.where, f"the name of {what}", f"'{self.token.text}'")
        return self.next().text

    # ---- comments
    def head(self):
        """The comment at the beginning of the file."""
        lines = []
        while len(lines) + 1 in self.scan.above:
            lines.append(self.scan.above[len(lines) + 1])
        return lines

    def comment_above(self, line):
        lines = []
        while line - 1 in self.scan.above:
            line -= 1
            lines.insert(0, self.scan.above[line])
        return lines

    def doc(self, first, last):
        """Comment of the declaration in the lines `first` to `last`: the comment behind the declaration, else above it.

        Headings above the declaration (lines that begin with --) are left out.
        """
        above = [line for line in self.comment_above(first) if not line.startswith("--")]
        behind = self.scan.behind.get(last)
        if above and behind:
            raise IdlError(f"{self.scan.name}:{last}", "one comment at a declaration", "one above it and one behind it")
        return [behind] if behind else above

    def heading(self, first):
        return [line[2:].strip() for line in self.comment_above(first) if line.startswith("--")]

    # ---- declarations
    def declare(self, declaration):
        full = (*self.module, declaration.name)
        clash = next((other for other in self.names
                      if [part.lower() for part in other] == [part.lower() for part in full]), None)
        if clash:
            raise IdlError(declaration.where, f"a new name in module {'::'.join(self.module)}",
                           f"'{declaration.name}' beside '{clash[-1]}'",
                           "IDL does not distinguish names by case; rename one")
        self.names[full] = declaration
        self.chapter.declarations.append(declaration)

    def find(self, name, what, kinds):
        parts = tuple(name.removeprefix("::").split("::"))
        scopes = [()] if name.startswith("::") else [self.module[:depth] for depth in range(len(self.module), -1, -1)]
        found = next((self.names[(*scope, *parts)] for scope in scopes if (*scope, *parts) in self.names), None)
        if not isinstance(found, kinds):
            raise IdlError(self.where, what, f"'{name}'", "declare it above, or mend the name")
        return found

    def module_of_declarations(self):
        self.expect("module")
        self.module += (self.expect_name("a module"),)
        self.expect("{")
        while not self.is_next("}"):
            self.declaration()
        self.expect(";")
        self.module = self.module[:-1]

    def declaration(self):
        first = self.token.line
        if self.token.text == "module":
            return self.module_of_declarations()
        if self.token.text == "@" and self.scan.tokens[self.at + 1].text == "annotation":
            return self.annotation_declaration()
        notes = self.annotations()
        kinds = {"const": self.constant, "enum": self.enumeration, "bitmask": self.bitmask,
                 "struct": self.segment if "segment" in notes else self.record}
        if self.token.text not in kinds:
            raise IdlError(self.where, "module, const, enum, bitmask or struct", f"'{self.token.text}'")
        return kinds[self.next().text](notes, first)

    def annotation_declaration(self):
        """Skips the declaration of an annotation, which is for other compilers. ANNOTATIONS has the known names."""
        self.at += 2
        if self.token.text not in ANNOTATIONS:
            raise IdlError(self.where, f"one of {', '.join(sorted(ANNOTATIONS))}", f"'{self.token.text}'",
                           "teach generator/idl.py what it means")
        while not self.is_next("}"):
            self.next()
        self.expect(";")

    def constant(self, _, first):
        kind, where = self.next().text, self.where
        name = self.expect_name("a constant")
        if kind not in TYPES:
            raise IdlError(where, f"one of {', '.join(TYPES)}", f"'{kind}'")
        self.expect("=")
        value = self.expression()
        last = self.token.line
        self.expect(";")
        if kind in schema.REALS:
            value.value = float(value.value)
        elif not isinstance(value.value, int):
            raise IdlError(where, f"a whole number for {name}", schema.shown(value.value))
        self.declare(schema.Constant(name, self.doc(first, last), where, self.module, kind, value.expression,
                                     value.value, heading=self.heading(first)))

    def enumeration(self, notes, first):
        where, name = self.where, self.expect_name("an enumeration")
        doc, values, marks = self.comment_above(first), [], {}
        self.expect("{")
        while True:
            at, marked, word = self.token.line, self.annotations(), self.expect_name("a value")
            if not word.startswith(name + "_"):
                raise IdlError(f"{self.scan.name}:{at}", f"a value named {name}_...", f"'{word}'",
                               "IDL's values share one scope")
            last = self.scan.tokens[self.at - 1].line
            self.is_next(",")
            values.append((word.removeprefix(name + "_"), self.doc(at, last)))
            marks[values[-1][0]] = marked
            if self.is_next("}"):
                break
        self.expect(";")
        self.declare(schema.Enumeration(name, doc, where, self.module, self.bits(notes, where), values, marks))

    def bitmask(self, notes, first):
        where, name = self.where, self.expect_name("a bit mask")
        doc, flags = self.comment_above(first), []
        self.expect("{")
        while True:
            at, position = self.token.line, self.annotations().get("position")
            word = self.expect_name("a bit")
            if position is None or not 0 <= position[""].value < self.bits(notes, where):
                raise IdlError(f"{self.scan.name}:{at}", f"@position(0 to {self.bits(notes, where) - 1}) at {word}",
                               "none" if position is None else str(position[""].value))
            if position[""].value in [other for _, other, _ in flags]:
                raise IdlError(f"{self.scan.name}:{at}", "one bit at a position", f"two at {position[''].value}",
                               "move one")
            self.is_next(",")
            flags.append((word, position[""].value, self.doc(at, at)))
            if self.is_next("}"):
                break
        self.expect(";")
        self.declare(schema.Bitmask(name, doc, where, self.module, self.bits(notes, where), flags))

    def bits(self, notes, where):
        bits = notes["bit_bound"][""].value if "bit_bound" in notes else None
        if bits not in (8, 16, 32, 64):
            raise IdlError(where, "@bit_bound(8), (16), (32) or (64)", "none" if bits is None else f"({bits})")
        return bits

    def record(self, notes, first):
        where, name = self.where, self.expect_name("a record")
        if ("final" in notes) == ("request" in notes):
            raise IdlError(where, f"@final or @request at {name}", "both" if "final" in notes else "none",
                           "a record has a fixed layout, a request has none")
        record = schema.Record(name, self.comment_above(first), where, self.module, nested="nested" in notes,
                               request="request" in notes, by_hand="by_hand" in notes)
        if self.is_next(":"):
            record.fields += self.find(self.expect_name("a request"), "the name of a request", schema.Record).fields
        self.expect("{")
        while not self.is_next("}"):
            record.fields += self.fields()
        self.expect(";")
        schema.check_record(record)
        self.declare(record)

    def segment(self, _, first):
        where, name = self.where, self.expect_name("a segment")
        doc, containers = self.comment_above(first), []
        self.expect("{")
        while not self.is_next("}"):
            containers.append(self.container())
        self.expect(";")
        self.declare(schema.Segment(name, doc, where, self.module, containers))

    def container(self):
        """Parses `latest<RECORD> NAME;`, `ring<RECORD, DEPTH> NAME;` or `TYPE NAME;`, each with [SIZE] or without."""
        first, notes, kind, record, depth, size = self.token.line, self.annotations(), self.next().text, None, "", ""
        if self.is_next("<"):
            record = self.find(self.expect_name("a record"), "the name of a record", schema.Record)
            depth = self.next().text if self.is_next(",") else ""
            self.expect(">")
        where, name = self.where, self.expect_name("a container")
        if self.is_next("["):
            size = self.next().text
            self.expect("]")
        last = self.token.line
        self.expect(";")
        if "writer" not in notes or (kind in ("latest", "ring")) != bool(record) or (kind == "ring") != bool(depth):
            raise IdlError(where, f"@writer, and latest<RECORD>, ring<RECORD, DEPTH> or a type, at {name}", kind)
        return schema.Container(name, self.doc(first, last), where, self.module, kind, record, depth, size,
                                notes["writer"][""], notes.get("status", {"": ""})[""], "reserve" in notes)

    def fields(self):
        """Parses a declaration of one or several fields."""
        first, notes = self.token.line, self.annotations()
        kind, fields = self.type(), []
        while True:
            where, name, dimensions = self.where, self.expect_name("a field"), []
            while self.is_next("["):
                length = self.expression()
                dimensions.append((length.value, length.expression))
                self.expect("]")
            fields.append(schema.Field(name, [], where, self.module, kind, dimensions))
            if not self.is_next(","):
                break
        last = self.token.line
        self.expect(";")
        for field in fields:
            field.doc = self.doc(first, last)
            self.annotate(field, notes)
        fields[0].heading = self.heading(first)
        return fields

    def type(self):
        if self.token.kind != "name":
            raise IdlError(self.where, "a type", f"'{self.token.text}'")
        name = self.next().text
        if name in TYPES or name == schema.BOOLEAN:
            return name
        if name == "sequence":
            for part in ("<", "string", ">"):
                self.expect(part)
            return schema.TEXTS
        if name == "string":
            if not self.is_next("<"):
                return schema.TEXT
            bound = self.expression()
            self.expect(">")
            return bound.value
        what = f"string<N>, one of {', '.join(TYPES)}, or the name of an enumeration, bit mask or record"
        return self.find(name, what, (schema.Enumeration, schema.Bitmask, schema.Record))

    # ---- annotations
    def annotations(self):
        """{name of the annotation: {name of the parameter: Limit or text}}; "" is the key of an unnamed parameter."""
        notes = {}
        while self.is_next("@"):
            if self.token.text not in ANNOTATIONS:
                raise IdlError(self.where, f"one of @{', @'.join(sorted(ANNOTATIONS))}", f"@{self.token.text}")
            name, values = self.next().text, {}
            if self.is_next("("):
                while not self.is_next(")"):
                    key = ""
                    if self.scan.tokens[self.at + 1].text == "=":
                        key = self.next().text
                        self.at += 1
                    values[key] = self.text() if self.token.kind == "string" else self.expression()
                    self.is_next(",")
            notes[name] = values
        return notes

    def text(self):
        """Adjacent texts are one."""
        text = ""
        while self.token.kind == "string":
            text += self.next().text[1:-1]
        return text

    def annotate(self, field, notes):
        def parameter(name, key=""):
            if key not in notes[name]:
                raise IdlError(field.where, f"@{name} with {key or 'a value'}", ", ".join(notes[name]) or "none")
            return notes[name][key]
        if "unit" in notes:
            field.unit = parameter("unit")
        if "range" in notes:
            field.minimum, field.maximum = parameter("range", "min"), parameter("range", "max")
        field.minimum = parameter("min") if "min" in notes else field.minimum
        field.maximum = parameter("max") if "max" in notes else field.maximum
        field.default = parameter("default") if "default" in notes else None
        field.nan = parameter("nan") if "nan" in notes else None
        field.counted_by = parameter("counted_by") if "counted_by" in notes else None
        field.cut, field.by_hand, field.in_status = "cut" in notes, "by_hand" in notes, "status" in notes
        field.otherwise = parameter("otherwise") if "otherwise" in notes else ""
        field.optional = "optional" in notes
        if "shown" in notes:
            self.show(field, notes["shown"])
        field.option = parameter("option") if "option" in notes else field.shown_name.replace("_", "-")

    def show(self, field, note):
        """Sets `shown` of a field, and its range by it, or `shown` by its range."""
        unit, initial = note.get("unit", field.unit), note["initial"].value if "initial" in note else None
        factor = schema.Limit(1.0, "1.0") if unit == field.unit else schema.FACTORS.get((unit, field.unit))
        if factor is None:
            raise IdlError(field.where, f"a unit of @shown that becomes [{field.unit}]", f"[{unit}]",
                           "add it to FACTORS of schema.py")
        if field.minimum and field.maximum:
            low, high = math.ceil(field.minimum.value / factor.value), math.floor(field.maximum.value / factor.value)
        elif "min" in note and "max" in note:
            low, high = note["min"].value, note["max"].value
            field.minimum, field.maximum = note["min"], note["max"]
            if unit != field.unit:
                field.minimum = schema.beyond(low * factor.value, -1)
                field.maximum = schema.beyond(high * factor.value, 1)
        else:
            raise IdlError(field.where, f"@shown with min and max, or @range, at {field.name}",
                           ", ".join(note) or "none")
        if initial is not None and not low <= initial <= high:
            raise IdlError(field.where, f"an initial {field.name} in [{low}, {high}] {unit}", schema.shown(initial))
        field.shown = schema.Shown(unit, factor, float(low), float(high), initial)

    # ---- expressions: sums and products of numbers and constants
    def expression(self):
        return self.chain(("+", "-"), lambda: self.chain(("*",), self.factor))

    def chain(self, marks, part):
        left = part()
        while self.token.text in marks:
            mark = self.next().text
            right = part()
            left = schema.Limit(ARITHMETIC[mark](left.value, right.value),
                                f"{left.expression} {mark} {right.expression}")
        return left

    def factor(self):
        if self.is_next("-"):
            inner = self.factor()
            return schema.Limit(-inner.value, "-" + inner.expression)
        if self.is_next("TRUE"):
            return schema.Limit(True, "true")
        if self.token.kind == "number":
            text = self.next().text
            whole = re.fullmatch(r"\d+|0[xX].*", text)
            return schema.Limit(int(text, 0) if whole else float(text), text)
        if self.token.kind == "name":
            constant = self.find(self.token.text, "a number or the name of a constant", schema.Constant)
            self.next()
            return schema.Limit(constant.value, constant.scoped)
        raise IdlError(self.where, "a number or the name of a constant", f"'{self.token.text}'")


def read(folder, file="records.idl"):
    """The chapters of records.idl in order. `folder` is a pathlib.Path."""
    return Parser(folder).parse(file)
