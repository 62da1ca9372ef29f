"""Starts the roles of a set, starts again what dies, and ends all of them together.

A death is a signal, a code other than 0, and a code 0 that nobody asked for. A role that dies is started again, at
most LIMIT times within WINDOW_S, after a pause that grows. When a needed role dies once more the set ends with code 1;
others are tried again each SLOW_PAUSE_S. A role without a heartbeat for HANGS_AFTER_S is killed; not in lockstep, and
not one that a debugger or a user has stopped. The set also ends with code 1 when a role dies before it ever took part
(its own error is on the terminal), when a hand-over fails, and in lockstep with any death. It ends with code 0 by a
signal, after its seconds, or when its window is closed. The next set starts when one has come to its end: by its
seconds, by a role that ends it, or in lockstep.
"""
import contextlib
import glob
import os
import signal
import stat
import subprocess
import termios
import time

from starting import session
from starting.command import NAME, catch_signals, private_folder, put, shown

LIMIT, WINDOW_S = 5, 60.0  # restarts of a role within this time
FIRST_PAUSE_S = 0.2  # before a restart; twice as long for each further death within the window
SLOW_PAUSE_S = 30.0  # before each restart of a role that has died more than LIMIT times, if the radar goes on without
POWER_ON_WITHIN_S, GATEWAY_WITHIN_S = 60.0, 5.0
HANGS_AFTER_S, HANGS_AT_FIRST_S = 10.0, 60.0  # before its first heartbeat a display makes its shaders
END_WITHIN_S = 5.0  # a role that has not ended by then is killed
# Between looks at the programs, and while a hand-over is under way; at who takes part, while somebody is awaited;
# at the gateway, likewise; at the heartbeats; and between two tries to switch the radar on.
LOOK_S, HAND_OVER_LOOK_S, JOIN_LOOK_S, GATEWAY_LOOK_S, HANG_LOOK_S, POWER_ON_AGAIN_S = 0.1, 0.002, 0.25, 0.1, 2.0, 1.0
LOG_BYTES = 1 << 20


def how_it_ended(code):
    names = {-number: number.name for number in signal.Signals}
    return f"ended with code {code}" if code >= 0 else f"was killed by {names.get(code, f'signal {-code}')}"


def usable(folder):
    """The folder of the logs; empty if it cannot be written, with one warning for the whole set."""
    try:
        if folder and not os.access(private_folder(folder), os.W_OK | os.X_OK):
            raise PermissionError("no leave to write there")
    except OSError as problem:
        put(2, f"{NAME}: --log-dir: expected a folder to write to, found {shown(folder)}: {shown(str(problem))}; "
               "no logs are kept")
        return ""
    if folder:
        put(1, f"Logs are in {shown(folder)}/")
    return folder


class Supervisor:
    def __init__(self, of):
        self.of = of
        self.hand_over = next((role for role in of.roles if role.name == "hand-over"), None)
        self.hand_over_said = b""
        self.roles = [role for role in of.roles if role is not self.hand_over]
        self.status, self.ending = 0, False
        self.came_to_its_end = False  # by itself: not by a closed window or a failure
        self.was_stopped = False      # by a signal
        self.due = {}                 # time of the next look, by what is looked at
        self.layout = {}              # of the session's table of processes
        self.powered_segment = None   # inode of the segment in which the radar was seen on
        self.powered_events = 0       # applied by then: a state-machine with fewer has been restarted
        self.power_sent = None        # time at which the events were sent, and how many had been applied by then
        self.power_looked = False     # the state-machine that runs was seen to be on, or to be the pilot's
        self.power_told = False
        self.gateway_awaited = of.network
        self.notes = []               # for the flight recorder, until somebody takes them
        self.began, self.began_ns, self.deadline = time.monotonic(), time.time_ns(), None
        self.log_dir = usable(of.log_dir)
        self.terminal = None
        with contextlib.suppress(termios.error):
            self.terminal = termios.tcgetattr(0)

    def is_due(self, what, pause_s):
        """True at most once in `pause_s` for each `what`."""
        now = time.monotonic()
        if now < self.due.get(what, 0.0):
            return False
        self.due[what] = now + pause_s
        return True

    # ---- What it says ----

    def say(self, text):
        put(2, f"{NAME}: {shown(text)}")
        path = f"{self.log_dir}/supervise.log"
        with contextlib.suppress(OSError):
            if not self.log_dir:
                return
            if os.path.exists(path) and os.path.getsize(path) > LOG_BYTES:
                os.replace(path, path + ".1")
            # No link is followed, no pipe waited for; a second name would make it a file of somewhere else.
            file = os.open(path, os.O_APPEND | os.O_CREAT | session.FOR_BOTH, 0o600)
            status = os.fstat(file)
            if stat.S_ISREG(status.st_mode) and status.st_uid == os.geteuid() and status.st_nlink == 1:
                put(file, f"{time.strftime('%Y-%m-%d %H:%M:%S')} {text}")
            os.close(file)

    def fail(self, text):
        self.say(text)
        self.status, self.ending = 1, True

    def its_log(self, role):
        return f"; its log is {self.log_dir}/{role.name}.log" if self.log_dir else ""

    def its_frames(self):
        """Number of pictures of this set in the folder of radar-display's option --frames; empty without one."""
        words = next((role.command for role in self.roles if "--frames" in role.command), ["--frames", ""])
        folder = words[words.index("--frames") + 1]
        number = 0
        for picture in glob.glob(f"{glob.escape(folder)}/frame_*.png") if folder else ():
            with contextlib.suppress(OSError):  # the oldest go with --keep-frames
                number += os.stat(picture).st_mtime_ns >= self.began_ns
        return f"; {number} pictures of this run are in {folder}" if folder else ""

    # ---- Starting, collecting and ending roles ----

    def start(self, role, **more):
        logs = ["--log-dir", self.log_dir] if self.log_dir and role is not self.hand_over else []
        try:
            role.process = subprocess.Popen(role.command + logs, **more)
        except OSError as problem:
            self.fail(f"{role.name}: expected a program that can be started, found {problem}")
        role.here, role.first_beat_ns = False, None

    def step_hand_over(self):
        """Starts the hand-over of a recording, reads its lines, and collects it."""
        if self.hand_over.process is None:
            self.start(self.hand_over, stdout=subprocess.PIPE)
            if self.ending:
                return
            os.set_blocking(self.hand_over.process.stdout.fileno(), False)
        code = self.hand_over.process.poll()
        with contextlib.suppress(BlockingIOError):
            self.hand_over_said += os.read(self.hand_over.process.stdout.fileno(), 4096)
        if code is None:
            return
        self.hand_over = None
        if code != 0:
            self.fail(f"the hand-over of the recording {how_it_ended(code)}; the set ends")
            return
        self.say(f"goes on from the recording {time.monotonic() - self.began:.2f} s after the start")
        # The radar has the power state of the recording. From then on the pilot decides.
        self.powered_segment, self.powered_events = self.segment() or 0, session.watch(self.of).get("events_applied", 0)

    def may_start(self, role):
        if self.hand_over and role.kind.awaits.encode() not in self.hand_over_said.split():
            return False
        waits = role.name != "gateway" and self.await_gateway()
        return not waits and role.wanted and time.monotonic() >= role.start_at

    def collect(self, role):
        code = role.process.poll()
        if code is None:
            return
        role.process, role.here = None, False
        how, ends_it = how_it_ended(code), role.name in self.of.ends_with
        if code == 0 and (self.of.lockstep or ends_it or role.name in self.of.may_end):
            role.wanted = False
            self.came_to_its_end = ends_it or self.of.lockstep and role.name == "radar-display"
            # A script that is read to its end, a lockstep run that is done: the others go on.
            self.ending = self.ending or self.came_to_its_end or role.name == "radar-display"
        elif self.of.lockstep or not role.ever_here:
            if not self.of.lockstep:
                how = "refused its arguments" if code == 2 else f"{how} before it took part"
            self.fail(f"{role.name} {how}{self.its_log(role)}")
        else:
            self.plan_restart(role, how)

    def plan_restart(self, role, how):
        now, within = time.monotonic(), f"within {WINDOW_S:.0f} s"
        role.deaths = [death for death in role.deaths if now - death < WINDOW_S] + [now]
        count = len(role.deaths)
        # A window is what the user looks at; frames in a folder are not.
        is_needed = role.kind.needed or role.name == "radar-display" and role.name in self.of.may_end
        if count > LIMIT:
            role.start_at = now + SLOW_PAUSE_S
            then = "the set ends" if is_needed else f"it is tried again every {SLOW_PAUSE_S:.0f} s"
            say = self.fail if is_needed else self.say
            say(f"{role.name} {how}, the {count}th time {within}; {then}{self.its_log(role)}")
        else:
            role.start_at = now + FIRST_PAUSE_S * 2 ** (count - 1)
            self.say(f"{role.name} {how}; starting it again ({count} of {LIMIT} {within})")
        if count > LIMIT and is_needed:
            session.run_yars(self.of, "note", f"{role.name} died {count} times {within}; the set ends")
            return
        self.notes.append(("--restarted", role.name, f"{how} ({count} of {LIMIT} {within})"))
        self.hand_in_notes()
        if role.name == "recorder" and self.of.recording:
            self.keep(self.of.recording)
        # A terminal's source that was killed leaves the terminal as it had set it.
        if role.name == "input-monitor":
            self.restore_terminal()

    def hand_in_notes(self):
        """Writes the notes into the flight recorder. Without a running role there is none, and the notes wait."""
        while self.notes and session.run_yars(self.of, "note", *self.notes[0]) is not None:
            self.notes.pop(0)

    def keep(self, file):
        """Keeps the file of a dead recorder under another name: it can be replayed, and the next one writes over it."""
        number = 1
        while os.path.lexists(f"{file}.{number}"):
            number += 1
        with contextlib.suppress(OSError):
            os.link(file, f"{file}.{number}")  # unlike a rename it writes over nothing
            os.unlink(file)
            self.say(f"what was recorded so far is {file}.{number}")

    def restore_terminal(self):
        # From the background a change of the terminal would stop this process.
        before = signal.signal(signal.SIGTTOU, signal.SIG_IGN)
        with contextlib.suppress(termios.error):
            if self.terminal:
                termios.tcsetattr(0, termios.TCSANOW, self.terminal)
        signal.signal(signal.SIGTTOU, before)

    def end_all(self):
        """Ends the hand-over, the roles, then the gateway, which reports to other computers how the roles ended."""
        gateways = [role for role in self.roles if role.name == "gateway"]
        others = [role for role in self.roles if role not in gateways]
        for group in ([self.hand_over] if self.hand_over else [], others, gateways):
            running, deadline = [role for role in group if role.process], time.monotonic() + END_WITHIN_S
            for role in running:
                role.process.terminate()
            for role in running:
                try:
                    code = role.process.wait(max(0.0, deadline - time.monotonic()))
                except subprocess.TimeoutExpired:
                    role.process.kill()
                    code = role.process.wait()
                if code != 0 and role is not self.hand_over:
                    self.say(f"{role.name} {how_it_ended(code)} when the set ended")
                    self.status = 1
        self.restore_terminal()

    # ---- Who takes part, who hangs, and the power ----

    def look_who_is_here(self):
        """Finds roles that have joined the session. Looks only while one is missing, so a running set costs nothing."""
        if all(role.here or not role.process for role in self.roles) or not self.is_due("who is here", JOIN_LOOK_S):
            return
        present = {entry["pid"] for entry in session.watch(self.of).get("processes", {}).values()}
        for role in self.roles:
            if role.process and role.process.pid in present:
                role.here = role.ever_here = True
        self.hand_in_notes()

    def end_what_hangs(self):
        beats = session.heartbeats(self.of, self.layout) if self.is_due("heartbeats", HANG_LOOK_S) else {}
        for role in self.roles:
            beat_ns = beats.get(role.process.pid) if role.process and role.here else None
            if beat_ns is None:
                continue
            role.first_beat_ns = role.first_beat_ns or beat_ns
            silent_s = time.monotonic() - beat_ns * 1e-9
            limit_s = HANGS_AFTER_S if beat_ns != role.first_beat_ns else HANGS_AT_FIRST_S
            if silent_s > limit_s and not session.is_stopped(role.process.pid):
                self.say(f"{role.name} has sent no heartbeat for {silent_s:.0f} s; it is killed{self.its_log(role)}")
                role.process.kill()

    def await_gateway(self):
        """True while the other roles wait for the gateway to join the network. After that they do without it."""
        if self.gateway_awaited and self.is_due("gateway", GATEWAY_LOOK_S):
            if time.monotonic() - self.began > GATEWAY_WITHIN_S:
                self.gateway_awaited = False
                self.say(f"gateway: expected it to join the network within {GATEWAY_WITHIN_S:.0f} s, found it has not; "
                         "the roles of this computer start without it")
            else:  # a degraded set has code 3
                network = session.read_json(self.of, "status", "--json", codes=(0, 3)).get("network")
                self.gateway_awaited = not (network and network.get("joined"))
        return self.gateway_awaited

    def segment(self):
        """Inode of the session's segment; None if its name was removed, which does not affect the running set."""
        with contextlib.suppress(OSError):
            return os.stat(session.path_of("yars", self.of.session)).st_ino
        return None

    def switch_on(self):
        """Sends the power-on events until the radar is on; from then on the pilot decides. Sends them again to a new
        segment, or to a new state-machine: one that has applied fewer events than were sent."""
        machine = next((role for role in self.roles if role.name == "state-machine"), None)
        first = self.powered_segment is None
        is_late = first and time.monotonic() - self.began > POWER_ON_WITHIN_S
        if machine is None or not machine.here:
            self.power_looked = False  # who comes next is looked at
            if is_late:
                self.fail("power-on: expected state-machine to take part within a minute, found none")
            return
        if self.power_looked or not self.is_due("power", POWER_ON_AGAIN_S):
            return
        segment, seen = self.segment(), session.watch(self.of)
        if not seen:
            return
        applied, standby = seen.get("events_applied", 0), seen.get("processes", {}).get("state-machine standby", {})
        # When one that stands by takes over it goes on with the power that the radar has.
        stands_by = self.of.network and standby.get("pid") == machine.process.pid
        # A segment without its name is the same as before.
        is_fresh = first or (segment is not None and segment != self.powered_segment) or applied < self.powered_events
        sent_at, before = self.power_sent or (0.0, 0)
        # Once the events are applied, another power than OPR is the pilot's.
        is_taken = self.power_sent and applied >= before + len(self.of.inject)
        if stands_by or not is_fresh or seen.get("power") == "OPR" or is_taken:
            self.power_looked, self.power_told, self.power_sent = True, False, None
            self.powered_segment = segment if segment is not None else self.powered_segment or 0
            self.powered_events = applied
            return
        self.due["power"] = 0.0  # events are applied within some ticks, as a rule
        if self.power_sent and applied >= before and time.monotonic() - sent_at < POWER_ON_AGAIN_S:
            return
        if not first and not self.power_told:
            self.say("the set goes on in a fresh session: power-on is sent again")
        self.power_told = True
        if session.run_yars(self.of, "inject", *self.of.inject) is not None:
            self.power_sent = time.monotonic(), applied
            return
        self.power_sent, self.due["power"] = None, time.monotonic() + POWER_ON_AGAIN_S
        if is_late:
            self.fail("power-on was not taken")

    # ---- The whole set ----

    def step(self):
        if self.hand_over:
            self.step_hand_over()
        for role in self.roles:
            if self.ending:
                return
            if role.process:
                self.collect(role)
            elif self.may_start(role):
                self.start(role)
        if self.ending or self.of.lockstep or self.hand_over:
            return
        self.look_who_is_here()
        self.end_what_hangs()
        if self.of.inject:
            self.switch_on()
        # The time runs from power-on.
        is_on = self.powered_segment is not None or not self.of.inject
        if self.deadline is None and self.of.seconds is not None and is_on:
            self.deadline = time.monotonic() + self.of.seconds
        if self.deadline is not None and time.monotonic() >= self.deadline:
            self.came_to_its_end = self.ending = True

    def run(self):
        def stop(*_):
            self.was_stopped = self.ending = True
        catch_signals(stop)
        # A lockstep run is over when its roles are; a gateway ends when it is told to.
        counted = [role for role in self.roles if not (self.of.lockstep and role.name == "gateway")] or self.roles
        try:
            while not self.ending and any(role.process or role.wanted for role in counted):
                self.step()
                time.sleep(HAND_OVER_LOOK_S if self.hand_over else LOOK_S)
        finally:
            self.end_all()
        if self.status == 0:
            self.say(f"the set has ended after {time.monotonic() - self.began:.0f} s{self.its_frames()}")
        return self.status


def run_sets(sets):
    """The sets one after the other, all in one session."""
    name = sets[0].session
    path = session.path_of("yars-set", name)
    try:
        names = {role.name for of in sets for role in of.roles}
        lock = session.take_set_lock(path, names, any(of.lockstep for of in sets))
    except OSError as problem:
        put(2, f"{NAME}: {path}: expected a file of this user that can be locked, found: {problem.strerror}")
        return 1
    try:
        if lock is None or session.is_there_already(sets[0]):
            put(2, f"{NAME}: session '{name}' is there already (`yars --session {name} status` names who takes part); "
                   f"end it (Ctrl-C in its terminal, or SIGTERM to its {NAME}) or choose --session NAME")
            return 1
        for of in sets:
            supervisor = Supervisor(of)
            status = supervisor.run()
            if status != 0 or supervisor.was_stopped or not supervisor.came_to_its_end:
                break
        return status
    finally:
        if lock is not None:
            session.remove_leftover(name)
            session.give_set_lock_back(path, lock)
