"""Recordings of sessions as arrays."""
import os

from . import _core
from .arguments import Held, Said, absolute, path, text, whole


def _ticks(first, last):
    return (whole(f"yars.Recording: {name}", tick, -2 ** 63, 2 ** 63 - 1, optional=True)
            for name, tick in (("first_tick", first), ("last_tick", last)))


class Recording(Held):
    """A file of `yars record`, as arrays.

    Recording(file): path as str, bytes or os.PathLike. A file that was cut short is read to its last whole block; of a
    damaged file what is whole is given. Both are warnings. The file's index is read at once, records when asked for.
    Ticks are 5 ms of simulated time; they go back where a session was reset, so a range of ticks may have records of
    several runs (field `epoch`). Arrays cannot be written. A Recording can be pickled; another process opens the file
    again. Errors: yars.Error for a file that is missing or no recording.
    """

    def __init__(self, file):
        self._made(absolute(path("yars.Recording: file", file)))

    def _make(self, *arguments):
        with Said("yars.Recording"):
            return _core.open_recording(arguments[0])

    @property
    def file(self):
        """Absolute path of the file."""
        return os.fsdecode(self._arguments[0])

    @property
    def header(self):
        """Paths of the recorded model: configuration (empty: built-in), terrain (empty: that of the configuration)."""
        return self._core.header

    @property
    def kinds(self):
        """Names of the kinds of records in the file."""
        return self._core.kinds

    @property
    def first_tick(self):
        """Lowest tick in the file; None: no records."""
        return self._core.first_tick

    @property
    def last_tick(self):
        """Highest tick in the file; None: no records."""
        return self._core.last_tick

    @property
    def cut_short(self):
        """True: the recorder did not close the file."""
        return self._core.cut_short

    def records(self, kind, first_tick=None, last_tick=None):
        """Records of one kind: a structured array, shape (records,), in the order of recording.

        kind: such as "ModelTick", "RadarState"; one that the file lacks gives an empty array. first_tick, last_tick:
        limits, both included; None: none. Records without a tick have that of the record before. Fields are those of
        records.idl, with their offsets; a nested record is a nested structured type, text is bytes. Units: units(kind).
        Errors: ValueError for an unknown kind, with the list of kinds.
        """
        kind, ticks = text("yars.Recording.records: kind", kind, "the name of a kind"), _ticks(first_tick, last_tick)
        with Said("yars.Recording.records"):
            return self._core.records(kind, *ticks)

    @staticmethod
    def units(kind):
        """Unit of each field of a kind by its name, "" for none;
        of nested records by names such as "ownship.latitude_deg"."""
        kind = text("yars.Recording.units: kind", kind, "the name of a kind")
        with Said("yars.Recording.units"):
            return _core.units_of(kind)

    def sweeps(self, first_tick=None, last_tick=None):
        """Sweeps of a recording with --sweeps: headers (sweeps,) as records("Sweep"), video uint8 (sweeps, samples).

        A sweep with fewer samples than others (header: samples) is filled up with 0.
        """
        ticks = _ticks(first_tick, last_tick)
        with Said("yars.Recording.sweeps"):
            return self._core.sweeps(*ticks)

    def maps(self, first_tick=None, last_tick=None):
        """Patch maps of a recording with --patches: headers (maps,) as records("PatchMap"), list of pictures.

        A picture is uint8 (size, size), row 0 the far edge.
        first_tick, last_tick: of the tick at which a map was complete.
        """
        ticks = _ticks(first_tick, last_tick)
        with Said("yars.Recording.maps"):
            return self._core.maps(*ticks)

    def __repr__(self):
        return f"<yars.Recording {ascii(self.file)}, ticks {self.first_tick} to {self.last_tick}>"
