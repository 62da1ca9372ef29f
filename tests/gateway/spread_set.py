"""A set of roles over the hosts of a lab: gateways, roles, and an observer on each host.

    with SpreadSet(bin_folder, LAYOUT) as spread:
        spread.start()
        spread.observe("d", "state")

Used by faults.py, endurance.py and the tests network_*.py. Needs root; the standard library only.
"""
import json
import os
import pathlib
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "lab"))
import lab  # noqa: E402

SESSION = "spread"
JOINS_WITHIN_S = 60.0
ROUTE = pathlib.Path(__file__).resolve().parents[2] / "config/routes/california.route"
FLIGHT = ["--source", "fixed:37.5,-123.0,15000,90,480"]
# Role and arguments by host. Models and machines stand by for each other.
LAYOUT = {"a": [("flight-model", FLIGHT)],
          "b": [("state-machine", ["--standby"]), ("radar-model", ["--standby"])],
          "c": [("radar-model", ["--standby"]), ("state-machine", ["--standby"]), ("flight-model", FLIGHT)],
          "d": []}


class Observer:
    """The program `observer` on a host: one question, one answer."""

    def __init__(self, host, program, session):
        self.process = subprocess.Popen(host.inside(program, session), stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        text=True, bufsize=1, start_new_session=True)
        nothing = host.folder / "observer.log"
        nothing.touch()
        host.processes.append(lab.Process(host, "observer", self.process, nothing))  # ends and stops with the host

    def ask(self, question):
        """The answer as a dictionary; None when the observer has ended."""
        try:
            self.process.stdin.write(question + "\n")
            line = self.process.stdout.readline()
        except (BrokenPipeError, ValueError):
            return None
        return json.loads(line) if line else None

    def end(self):
        self.process.kill()
        self.process.wait()


class SpreadSet:
    """hosts: roles and arguments by host. options: slots of the form Network for every host; {host} is the host's
    name."""

    def __init__(self, programs, hosts=None, options="", seed=1, keep=False, session=SESSION):
        self.programs = pathlib.Path(programs).resolve()
        self.layout = hosts or LAYOUT
        self.options, self.session = options, session
        self.lab = lab.Lab(list(self.layout), wire=str(self.programs / "wire"), seed=seed, keep=keep)
        self.gateways, self.observers = {}, {}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for observer in self.observers.values():
            observer.end()
        self.lab.close()

    def network_file(self, host, name=None, options=None):
        peers = " ".join(f'"{self.lab.address(other)}"' for other in self.layout)
        path = self.lab.folder / f"{host}.guf"
        options = (self.options if options is None else options).replace("{host}", host)
        path.write_text(f'( Network :name "{name or host}" :interfaces `( "eth0" ) :peers `( {peers} ) {options} )\n')
        return path

    def start_gateway(self, host, more=(), name=None, options=None):
        """name, options: of this host alone."""
        self.gateways[host] = self.lab.start(host, str(self.programs / "gateway"),
                                             ["--session", self.session,
                                              "--network", self.network_file(host, name, options), *more])
        return self.gateways[host]

    def start_roles(self, host):
        for role, arguments in self.layout[host]:
            self.lab.start(host, str(self.programs / role), ["--session", self.session, *arguments])

    def start_observer(self, host):
        self.observers[host] = Observer(self.lab.hosts[host], str(self.programs / "observer"), self.session)

    def start_host(self, host):
        """Gateway, then roles once it has joined; as scripts/start does."""
        self.start_gateway(host).wait_for("joined", JOINS_WITHIN_S)
        self.start_roles(host)
        self.start_observer(host)

    def start_gateways(self, hosts=None):
        hosts = hosts or list(self.layout)
        for host in hosts:
            self.start_gateway(host)
        for host in hosts:
            self.gateways[host].wait_for("joined", JOINS_WITHIN_S)

    def start(self, hosts=None):
        hosts = hosts or list(self.layout)
        self.start_gateways(hosts)
        for host in hosts:
            self.start_roles(host)
            self.start_observer(host)

    def yars(self, host, *words, code=0, within_s=60.0):
        return self.lab.run(host, str(self.programs / "yars"), [*words, "--session", self.session], code=code,
                            within_s=within_s)

    def inject(self, host, event):
        """Until the event is applied. `yars inject` waits 2 s for it; on a busy machine, or before a state machine
        runs, that may be too short, and it is sent again."""
        deadline = time.monotonic() + JOINS_WITHIN_S
        while True:
            said = self.yars(host, "inject", event, code=None)
            if "1 done" in said or "1 without effect" in said:
                return
            assert "applied within 2 s" in said and time.monotonic() < deadline, (event, said, self.logs())

    def watch(self, host):
        """What `yars watch` shows; empty while there is no session."""
        text = self.yars(host, "watch", "--json", "--once", code=None)
        return json.loads(text) if text.startswith("{") else {}

    def replayed(self, host, recording):
        """What `yars replay` counts in a recording that a host made."""
        lines = self.lab.run(host, str(self.programs / "yars"), ["replay", "--events", "--json", recording],
                             within_s=1800).splitlines()
        return json.loads(lines[-1])

    def ask(self, host, question):
        return self.observers[host].ask(question)

    def states(self, hosts=None):
        return {host: self.ask(host, "state") for host in hosts or self.layout}

    def wait_for(self, condition, what, hosts=None, within_s=60.0):
        """Until condition({host: state}) is true."""
        deadline = time.monotonic() + within_s
        while True:
            states = self.states(hosts)
            if all(states.values()) and condition(states):
                return states
            if time.monotonic() > deadline:
                raise AssertionError(f"expected {what} within {within_s} s, found {json.dumps(states)}; "
                                     f"logs: {self.logs()}")
            time.sleep(0.02)

    def logs(self):
        return "\n".join(f"--- {host.name} {process.name}\n{process.text()[-1500:]}"
                         for host in self.lab.hosts.values() for process in host.processes)


def why_skipped(programs):
    """Why the tests over hosts cannot run here; empty where they can."""
    programs = pathlib.Path(programs)
    if reason := lab.can_run(str(programs / "wire")):
        return reason
    if not os.access(programs / "gateway", os.X_OK):
        return "expected the program gateway, found none; this build is without Cyclone DDS"
    return ""


def run_tests(tests, *arguments):
    """Each in turn, with the same arguments; says how long it took."""
    for test in tests:
        began = time.monotonic()
        test(*arguments)
        print(f"{test.__name__}: ok, {time.monotonic() - began:.1f} s", flush=True)


def runs(states):
    """True if every host shows one machine and one model of one epoch, with a fresh ownship."""
    values = list(states.values())
    return (sum(one["machine"] == "here" for one in values) == 1 and
            sum(one["model"] == "here" for one in values) == 1 and
            all(one["machine"] != "none" and one["model"] != "none" for one in values) and
            len({one["epoch"] for one in values}) == 1 and
            all(one.get("stale") is False and one.get("model_epoch") == one["epoch"] and abs(one["model_age_ms"]) < 500
                for one in values))
