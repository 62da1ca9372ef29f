"""Table of the roles that a set can have."""
import dataclasses
import subprocess


@dataclasses.dataclass(frozen=True)
class Kind:
    """Properties of a role that are the same in every set."""
    program: str
    options: str = ""        # its options, by their names in sets.py; options of all roles come first
    of_set: bool = False     # --roles may name it
    once: int = 0            # one at most in a session on a computer: its byte in the set's lock; 0: any number
    needed: bool = False     # without it there is no radar
    awaits: str = "claimed"  # line of a hand-over after which the role starts


ROLES = {  # in the order of a lockstep plan
    "flight-model": Kind("flight-model", "lockstep source", of_set=True, awaits="ready"),
    "input-monitor": Kind("input-monitor", "lockstep input", of_set=True, awaits="ready"),
    "state-machine": Kind("state-machine", "lockstep standby", of_set=True, once=1, needed=True),
    "radar-model": Kind("radar-model", "lockstep standby terrain fidelity", of_set=True, once=2, needed=True),
    "radar-display": Kind("radar-display", "lockstep size publish headless frames every keep-frames", of_set=True),
    "recorder": Kind("yars", "terrain flown from until sweeps patches overwrite keep-recording lockstep"),
    "gateway": Kind("gateway", "network terrain", once=3),
    "station": Kind("yars-station", "lockstep"),
    "hand-over": Kind("yars", "seek hand-over await terrain"),  # starts first and is no member of the set
}
OF_SET = [name for name, kind in ROLES.items() if kind.of_set]


@dataclasses.dataclass
class Role:
    name: str
    command: list
    process: subprocess.Popen = None
    here: bool = False          # the process takes part in the session
    ever_here: bool = False     # it or one before it did
    deaths: list = dataclasses.field(default_factory=list)  # times, within the window
    first_beat_ns: int = None   # heartbeat when the process was first seen to take part
    start_at: float = 0.0       # when the next start is due, while there is no process
    wanted: bool = True

    @property
    def kind(self):
        return ROLES.get(self.name, Kind(""))


@dataclasses.dataclass
class Set:
    bin: str                # folder of the programs
    session: str
    roles: list             # of Role, in the order of their start
    log_dir: str = ""
    seconds: float = None   # from power-on to its end; None: none
    lockstep: bool = False  # any death ends it with code 1
    network: bool = False   # with a gateway: parts of it may be on other computers
    inject: tuple = ()      # events that switch the radar on
    recording: str = ""     # set aside (FILE.1, FILE.2 ...) before the recorder is started again
    may_end: tuple = ()     # roles that may end with code 0; radar-display ends the set
    ends_with: tuple = ()   # roles that end the set with code 0
