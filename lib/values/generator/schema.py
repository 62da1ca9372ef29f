"""Data model of the IDL: constants, enumerations, bit masks, records with their fields, offsets and sizes.

idl.py builds the model from the IDL files; cpp.py, clients.py and tables.py write it out. Offsets and sizes are in
bytes.
A contradiction in the model raises IdlError: one line with the expected value, the found value and the remedy.
"""
import dataclasses
import math
import re

# IDL type -> bytes, minimum, maximum. Numbers are little-endian, at offsets that are multiples of their size.
INTEGERS = {f"{sign}int{bits}": (bits // 8, -(1 << bits - 1) if not sign else 0, (1 << bits - (not sign)) - 1)
            for sign in ("", "u") for bits in (8, 16, 32, 64)}
REALS = {"double": 8, "float": 4}
# Of requests alone: a record has bits of flags, and texts of a length.
BOOLEAN, TEXT, TEXTS = "boolean", "string", "sequence<string>"

# Last word of a field's name -> unit of the field.
SUFFIXES = {"deg": "deg", "m": "m", "m2": "m2", "mps": "m/s", "dps": "deg/s", "nm": "NM", "s": "s", "ns": "ns",
            "tick": "tick", "ft": "ft", "kt": "kt", "mmh": "mm/h", "w": "W"}


class IdlError(Exception):
    """Fault in the IDL as one line, "file:line: expected, found, what to do"."""

    def __init__(self, where, expected, found, remedy=""):
        super().__init__(f"{where}: expected {expected}, found {found}" + (f"; {remedy}" if remedy else ""))


@dataclasses.dataclass(eq=False)
class Declaration:
    name: str
    doc: list  # lines
    where: str  # file:line
    module: tuple = ()
    heading: list = dataclasses.field(default_factory=list, kw_only=True)  # lines of the heading above this declaration

    @property
    def scoped(self):
        """Name in C++ code inside namespace yars::databuffer."""
        return "::".join((*self.module[1:], self.name))


@dataclasses.dataclass(eq=False)
class Constant(Declaration):
    type: str = ""
    expression: str = ""  # the value as C++ text
    value: object = None


@dataclasses.dataclass(eq=False)
class Enumeration(Declaration):
    bits: int = 32
    # (name without the type's prefix, doc lines), numbered from 0
    values: list = dataclasses.field(default_factory=list)
    notes: dict = dataclasses.field(default_factory=dict)  # name of a value -> its annotations


@dataclasses.dataclass(eq=False)
class Bitmask(Declaration):
    bits: int = 32
    flags: list = dataclasses.field(default_factory=list)  # (name, position, doc lines)


@dataclasses.dataclass(eq=False)
class Limit:
    """Limit of a range: its value, and the same value as a C++ expression."""
    value: object
    expression: str


# (unit that people use, unit of a record) -> the first in the second.
FACTORS = {("NM", "m"): Limit(1852.0, "1852.0"), ("ft", "m"): Limit(0.3048, "0.3048"),
           ("kt", "m/s"): Limit(1852.0 / 3600.0, "1852.0 / 3600.0")}


def beyond(value, step):
    """Limit at the next whole number beyond a value, in the direction of `step`; 0 stays."""
    number = 0.0 if value == 0 else float((math.floor(value) if step > 0 else math.ceil(value)) + step)
    return Limit(number, f"{number:.1f}")


@dataclasses.dataclass(eq=False)
class Shown:
    """A value as people give it: unit, that unit in the field's, limits and default in that unit (None: no default)."""
    unit: str
    factor: Limit
    low: float
    high: float
    initial: object

    def text(self):
        """"0.1 to 100 NM, 5 if not given"."""
        initial = "" if self.initial is None else f", {shown(self.initial)} if not given"
        return f"{shown(self.low)} to {shown(self.high)} {self.unit}".rstrip() + initial


@dataclasses.dataclass(eq=False)
class Field(Declaration):
    # str: name of a number type; int: maximum length of a string; else Enumeration, Bitmask or Record
    type: object = None
    dimensions: list = dataclasses.field(default_factory=list)  # (entries, C++ expression)
    unit: str = ""
    minimum: Limit = None
    maximum: Limit = None
    default: Limit = None
    nan: str = None  # meaning of NaN; None: NaN is not valid
    counted_by: str = None  # name of the field with the number of entries in use; None: all are in use
    cut: bool = False  # True: a ring copies only the entries in use
    by_hand: bool = False  # True: hand-written code checks the range, the generated code does not
    option: str = ""  # of requests: name of the option of the command line
    optional: bool = False  # of requests: the field may be left out
    otherwise: str = ""  # of requests: what holds then
    shown: Shown = None  # None: people do not give the value
    in_status: bool = False  # True: `yars status` shows it
    offset: int = 0

    @property
    def stem(self):
        """Name without its unit."""
        return (self.name.rpartition("_")[0] if SUFFIXES.get(self.name.rpartition("_")[2], None) == self.unit else
                self.name)

    @property
    def shown_name(self):
        """Name with the unit that people use."""
        suffix = next((word for word, unit in SUFFIXES.items() if self.shown and unit == self.shown.unit), "")
        return f"{self.stem}_{suffix}" if suffix else self.name

    @property
    def reserved(self):
        return self.name.startswith("reserved")

    @property
    def entries(self):
        entries = 1
        for count, _ in self.dimensions:
            entries *= count
        return entries

    @property
    def element_size(self):
        if isinstance(self.type, int):
            return self.type + 1
        if isinstance(self.type, (Enumeration, Bitmask)):
            return self.type.bits // 8
        if isinstance(self.type, Record):
            return self.type.size
        return REALS.get(self.type) or INTEGERS[self.type][0]

    @property
    def size(self):
        return self.entries * self.element_size

    @property
    def alignment(self):
        if isinstance(self.type, int):
            return 1
        return self.type.alignment if isinstance(self.type, Record) else self.element_size

    @property
    def number(self):
        """IDL type of the number in memory, unsigned integer for enumerations and bit masks; None: text or record."""
        if isinstance(self.type, (Enumeration, Bitmask)):
            return f"uint{self.type.bits}"
        return self.type if isinstance(self.type, str) else None

    def sentence(self):
        """Description of the field, with the meaning of NaN and the number of entries in use."""
        kind = self.type.scoped if isinstance(self.type, (Enumeration, Bitmask)) else ""
        text = " ".join(filter(None, [kind, *self.doc]))
        missing = f"NaN = {self.nan}" if self.nan is not None else ""
        people = (self.shown.text() if self.shown and (self.shown.unit != self.unit or self.shown.initial is not None)
                  else "")
        return "; ".join(filter(None, [text, people, missing,
                                       f"the first `{self.counted_by}` are in use" if self.counted_by else ""]))


@dataclasses.dataclass(eq=False)
class Record(Declaration):
    fields: list = dataclasses.field(default_factory=list)
    nested: bool = False  # occurs only inside other records
    request: bool = False  # what a program asks of the library, without a layout
    by_hand: bool = False  # True: hand-written code validates it, with the generated checks of its fields
    size: int = 0
    alignment: int = 1

    def is_validated_by_hand(self):
        return self.by_hand or any(field.by_hand or isinstance(field.type, Record) and field.type.is_validated_by_hand()
                                   for field in self.fields)


@dataclasses.dataclass(eq=False)
class Container(Declaration):
    kind: str = ""  # latest, ring, or a type of session_parts.hpp
    record: Record = None  # of latest and ring
    depth: str = ""  # of a ring
    size: str = ""  # number of such containers; empty: one
    writer: str = ""
    status: str = ""  # name in the status of a session; empty: not shown
    reserve: bool = False  # the reserve begins here


@dataclasses.dataclass(eq=False)
class Segment(Declaration):
    containers: list = dataclasses.field(default_factory=list)


@dataclasses.dataclass(eq=False)
class Chapter:
    name: str  # name of the file without .idl
    doc: list
    declarations: list


def shown(value):
    """Shortest text of a number: 90, -0.5, 1e10."""
    if isinstance(value, float) and abs(value) >= 1e6 and abs(value) == float(f"{abs(value):.0e}"):
        return f"{value:.0e}".replace("e+0", "e").replace("e+", "e")
    if isinstance(value, float):
        return f"{value:.15g}"
    return str(value)


def range_text(field):
    """Range of a field as text, "[0, 360]"; empty: no range."""
    if field.minimum and field.maximum:
        return f"[{shown(field.minimum.value)}, {shown(field.maximum.value)}]"
    if field.maximum:
        return (f"at most {shown(field.maximum.value)}" if field.number in REALS else
                f"[0, {shown(field.maximum.value)}]")
    return f"at least {shown(field.minimum.value)}" if field.minimum else ""


def about(field):
    """Unit, range and description in one line."""
    return " ".join(filter(None, [f"[{field.unit}]" if field.unit else "", range_text(field), field.sentence()]))


def limits(field):
    """(minimum, maximum) of a field; None: no limit."""
    if isinstance(field.type, Enumeration):
        return 0, len(field.type.values) - 1
    return field.minimum and field.minimum.value, field.maximum and field.maximum.value


def lay_out(record):
    """Sets the offsets that every C compiler uses. Padding is an error, because records are compared as bytes."""
    at = 0
    for field in record.fields:
        if at % field.alignment:
            raise IdlError(field.where, f"{record.name}.{field.name} at a multiple of {field.alignment} bytes",
                           f"offset {at}", f"put {field.alignment - at % field.alignment} reserved bytes before it")
        field.offset = at
        at += field.size
        record.alignment = max(record.alignment, field.alignment)
    if at % record.alignment:
        raise IdlError(record.where, f"a size of {record.name} that is a multiple of {record.alignment} bytes",
                       f"{at} bytes", f"put {record.alignment - at % record.alignment} reserved bytes at its end")
    record.size = at


def check_unit(field):
    unit = SUFFIXES.get(field.name.rsplit("_", 1)[-1], "")
    if unit and field.unit != unit and field.number:
        raise IdlError(field.where, f'@unit("{unit}") of {field.name}, whose name has this unit as suffix',
                       f'@unit("{field.unit}")' if field.unit else "none", "mend the name or the unit")


def check_limits(field):
    limits = [limit for limit in (field.minimum, field.maximum) if limit]
    if limits and (field.number is None or not isinstance(field.type, str)):
        raise IdlError(field.where, f"a number type for {field.name}, which has a range", "a type without order",
                       "take the range away")
    if field.nan is not None and field.type not in REALS:
        raise IdlError(field.where, f"double or float for @nan of {field.name}", str(field.number), "take @nan away")
    if field.minimum and field.maximum and not field.minimum.value <= field.maximum.value:
        raise IdlError(field.where, f"a range of {field.name} that begins below its end", range_text(field),
                       "mend @range")
    for limit in limits + ([field.default] if field.default else []):
        if field.type in INTEGERS:
            _, least, greatest = INTEGERS[field.type]
            if not isinstance(limit.value, int) or not least <= limit.value <= greatest:
                raise IdlError(field.where, f"a whole number of {field.type}, {least} to {greatest}, at {field.name}",
                               shown(limit.value), "mend the limit or the type")
    if field.default and field.type in {**REALS, **INTEGERS}:
        low, high = field.minimum, field.maximum
        if low and field.default.value < low.value or high and field.default.value > high.value:
            raise IdlError(field.where, f"a default of {field.name} in {range_text(field)}", shown(field.default.value),
                           "mend the default or the range")


def check_count(record, field):
    if len(field.dimensions) > 1:
        raise IdlError(field.where, f"one dimension at {field.name}", f"{len(field.dimensions)}", "use one array")
    if field.cut and (field is not record.fields[-1] or field.counted_by is None or field.element_size != 1):
        raise IdlError(field.where, "@cut on the last field, an array of bytes with @counted_by",
                       f"@cut on {field.name}")
    if field.counted_by is None:
        return
    counter = next((other for other in record.fields if other.name == field.counted_by), None)
    if counter is None or counter.type not in INTEGERS or counter.minimum is None or counter.maximum is None:
        raise IdlError(field.where, f"a whole number with @range named {field.counted_by} in {record.name}",
                       "none" if counter is None else "another field", "name the field that counts the entries")
    if not field.dimensions or (counter.minimum.value, counter.maximum.value) != (0, field.entries):
        raise IdlError(counter.where, f"@range(min=0, max={field.entries}), the entries of {field.name}",
                       range_text(counter), "mend the range or the array")


def check_record(record):
    names = {}
    for field in record.fields:
        if field.name.lower() in names:
            raise IdlError(field.where, f"one {field.name} in {record.name}", "two",
                           "IDL does not distinguish them by case; rename one")
        names[field.name.lower()] = field
        check_unit(field)
        check_limits(field)
    if record.request:
        return check_request(record)
    for field in record.fields:
        if field.type in (BOOLEAN, TEXT, TEXTS):
            raise IdlError(field.where, f"a number, a text or a record for {field.name}", field.type,
                           "use a bit mask, or string<N>")
        check_count(record, field)
    return lay_out(record)


def check_request(request):
    options = [field.option for field in request.fields]
    for field in request.fields:
        if options.count(field.option) > 1:
            raise IdlError(field.where, f"one option {field.option} in {request.name}", "two",
                           "give one another @option")
        if field.dimensions or isinstance(field.type, (int, Record, Bitmask)):
            raise IdlError(field.where, f"a number, boolean or enumeration for {field.name}, or texts", "another type")
        if field.optional != bool(field.otherwise):
            raise IdlError(field.where, f"@optional with @otherwise at {field.name}", "one of them",
                           "say what holds without the field")
        if field.type in INTEGERS and not field.optional and not field.default:
            raise IdlError(field.where, f"@default or @optional at {field.name}", "none")


def records_of(chapters):
    return [one for chapter in chapters for one in chapter.declarations if isinstance(one, Record)]


def is_valid_name(name):
    return re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", name) is not None


def type_text(field):
    """Type of a field as the documents write it: double, uint8, char[16], char[21][8], Mark[10]."""
    dimensions = "".join(f"[{count}]" for count, _ in field.dimensions)
    if isinstance(field.type, int):
        return f"char{dimensions}[{field.type + 1}]"
    return (field.type.name if isinstance(field.type, Record) else field.number) + dimensions
