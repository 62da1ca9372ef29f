"""Several computers on one machine, for tests of what joins computers. Needs root; the standard library only.

    with lab.Lab(["a", "b", "c", "d"], wire="build/release/bin/wire") as four:
        four.set_line(loss=1, delay=20, jitter=5)
        model = four.start("c", "radar-model", ["--session", "s"])
        print(four.run("d", "yars", ["--session", "s", "status"]))
        four.kill_host("c")

Each host has namespaces of its own for network, processes, mounts, host name and clocks: an eth0 at the wire
(wire.cpp), lo, an empty /dev/shm, a home, and a monotonic clock that stands elsewhere. Nothing of it has a name
outside, so labs do not meet, and it ends with the process that made it, however that ends. See README.md.
"""
import atexit
import contextlib
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time

TOP = pathlib.Path(__file__).resolve().parents[3]
WIRE = os.environ.get("YARS_LAB_WIRE", str(TOP / "build/release/bin/wire"))
OFFSETS_S = (0, 1_000, 50_000, 100_000)  # of the monotonic clocks of the first hosts
SHARED_MEMORY = "256m"                   # /dev/shm of a host
WITHIN_S = 10.0                          # what the lab itself does takes less
SPACES = ("--net", "--mount", "--pid", "--uts", "--time")
# Process 1 of a host: it ends, and all others with it, when the lab closes its input. Orphans leave no zombies.
FIRST = """set -e
mount -t tmpfs -o size={size},mode=1777 tmpfs /dev/shm
echo {name} >/proc/sys/kernel/hostname
for family in all default; do
  [ ! -e /proc/sys/net/ipv6/conf/$family ] || echo 1 >/proc/sys/net/ipv6/conf/$family/disable_ipv6
done
ip link set lo up
echo ready
exec env --ignore-signal=CHLD cat >/dev/null
"""


class LabError(RuntimeError):
    """What the lab expected of the machine or of a program, and what it found."""


def can_run(wire=WIRE):
    """Empty where a lab can be made, else why not."""
    if os.geteuid() != 0:
        return "expected root, found another user"
    if not os.path.exists("/dev/net/tun"):
        return "expected /dev/net/tun, found none"
    for tool in ("unshare", "nsenter", "ip", "mount"):
        if shutil.which(tool) is None:
            return f"expected the command {tool}, found none"
    if not os.access(wire, os.X_OK):
        return f"expected the program wire, found none at {wire}"
    made = subprocess.run(["unshare", "--net", "--mount", "--pid", "--uts", "--fork", "--mount-proc", "--time",
                           "--monotonic", "1", "ip", "tuntap", "add", "dev", "eth0", "mode", "tap"],
                          capture_output=True, text=True)
    return "" if made.returncode == 0 else f"expected namespaces and a TAP device, found {made.stderr.strip()}"


def child_of(pid):
    """The only child of a process; None while there is none."""
    with contextlib.suppress(OSError):
        children = pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
        return int(children[0]) if children else None
    return None


def wait_until(condition, what, within_s=WITHIN_S, every_s=0.05):
    """The first value of condition() that is true; an error when none was. `every_s`: longest pause between two calls,
    longer for a condition that starts a program."""
    deadline, pause_s = time.monotonic() + within_s, 0.002
    while not (value := condition()):
        if time.monotonic() > deadline:
            raise LabError(f"expected {what} within {within_s:g} s, found none")
        time.sleep(pause_s)
        pause_s = min(1.3 * pause_s, every_s)
    return value


class Process:
    """A program on a host, as nsenter sees it: nsenter passes on how it ended."""

    def __init__(self, host, name, entered, log):
        self.host, self.name, self.entered, self.log = host, name, entered, log

    @property
    def pid(self):
        """As the lab numbers processes, not the host."""
        return wait_until(lambda: child_of(self.entered.pid) or self.entered.poll() is not None and -1,
                          f"a process of {self.name}")

    def signal(self, number):
        with contextlib.suppress(ProcessLookupError):
            if (pid := self.pid) > 0:
                os.kill(pid, number)

    def terminate(self):
        self.signal(signal.SIGTERM)

    def kill(self):
        self.signal(signal.SIGKILL)

    def poll(self):
        """Code it ended with, minus the number of a signal; None while it runs."""
        if not self.host.is_stopped and self.entered.poll() is None:
            self.entered.send_signal(signal.SIGCONT)  # nsenter stops with its program, and may notice it late
        return self.entered.poll()

    def wait(self, within_s=WITHIN_S):
        deadline = time.monotonic() + within_s
        while (code := self.poll()) is None:
            if time.monotonic() > deadline:
                raise LabError(f"{self.name} on {self.host.name}: expected its end within {within_s:g} s; it said: "
                               f"{self.text()[-2000:]}")
            time.sleep(0.005)
        return code

    def text(self):
        """What it has written so far, both streams."""
        return self.log.read_text(errors="replace")

    def wait_for(self, part, within_s=WITHIN_S):
        """Until it has written a text."""
        try:
            wait_until(lambda: part in self.text(), part, within_s)
        except LabError as problem:
            raise LabError(f"{self.name} on {self.host.name}: {problem}; it said: {self.text()[-2000:]}") from None


class Host:
    """Namespaces, held by their first process."""

    def __init__(self, name, port, address, folder):
        self.name, self.port, self.address, self.folder = name, port, address, folder
        self.offset_s = 0
        self.holder = None   # unshare
        self.first = None    # process 1 of the host
        self.is_stopped = False
        self.processes = []
        (folder / "home").mkdir(parents=True)
        (folder / "run").mkdir(mode=0o700)

    def switch_on(self, offset_s):
        self.offset_s = offset_s
        first = FIRST.format(size=SHARED_MEMORY, name=self.name)
        self.holder = subprocess.Popen(
            ["unshare", *SPACES, "--fork", "--kill-child", "--mount-proc", "--monotonic", str(offset_s), "--boottime",
             str(offset_s), "sh", "-c", first], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            text=True, start_new_session=True)
        said = self.holder.stdout.readline()
        if said != "ready\n":
            raise LabError(f"host {self.name}: expected namespaces, found {said.strip() or 'nothing'}")
        self.first = child_of(self.holder.pid)
        self.is_stopped = False

    def switch_off(self):
        """All its processes end at once; shared memory, mounts and network go with them."""
        if self.holder is None:
            return
        with contextlib.suppress(ProcessLookupError):
            os.kill(self.first, signal.SIGKILL)
        self.holder.kill()
        self.holder.wait()
        self.holder.stdin.close()
        self.holder.stdout.close()
        self.holder = None
        self.is_stopped = False
        for process in self.processes:
            process.wait()
        self.processes = []

    def inside(self, *words, spaces=SPACES):
        """The command that runs words on this host."""
        if self.holder is None:
            raise LabError(f"host {self.name}: expected it to be on, found it off")
        return ["nsenter", "--target", str(self.first), *spaces, "--", *words]

    def environment(self, more):
        home = self.folder / "home"
        kept = {name: os.environ[name] for name in ("PATH", "LANG", "LC_ALL", "ASAN_OPTIONS") if name in os.environ}
        return {**kept, "HOME": str(home), "XDG_CACHE_HOME": str(home / ".cache"),
                "XDG_STATE_HOME": str(home / ".local/state"), "XDG_CONFIG_HOME": str(home / ".config"),
                "XDG_RUNTIME_DIR": str(self.folder / "run"), "YARS_USER_CONFIG": "", **(more or {})}


class Lab:
    """hosts: names. network: the first three numbers of their addresses. offsets_s: of their monotonic clocks. The
    hosts, clocks and seeds of two labs do not depend on each other. keep: the folder with logs and homes stays when the
    lab ends."""

    def __init__(self, hosts=("a", "b", "c", "d"), wire=WIRE, network="192.168.10", offsets_s=OFFSETS_S, seed=1,
                 keep=False):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="yars_lab_"))
        self.keep, self.network = keep, network
        self.wire = None
        self.hosts = {}
        atexit.register(self.close)
        try:
            self.wire = subprocess.Popen([wire, str(len(hosts)), str(seed)], stdin=subprocess.PIPE,
                                         stdout=subprocess.PIPE, text=True, bufsize=1, start_new_session=True)
            for port, name in enumerate(hosts, 1):
                self.hosts[name] = Host(name, port, f"{network}.{port}", self.folder / name)
                self._switch_on(self.hosts[name],
                                offsets_s[port - 1] if port <= len(offsets_s) else offsets_s[-1] * port)
        except BaseException:
            self.close()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Ends and removes everything; may be called twice."""
        atexit.unregister(self.close)
        for host in self.hosts.values():
            host.switch_off()
        if self.wire is not None:
            self.wire.kill()
            self.wire.wait()
            self.wire.stdin.close()
            self.wire.stdout.close()
            self.wire = None
        if not self.keep:
            shutil.rmtree(self.folder, ignore_errors=True)

    # ---- Programs ----

    def start(self, host, program, args=(), env=None, folder=None):
        """A program in the background; its two streams go to a file. folder: where it works, else the host's home."""
        at = self.hosts[host]
        name = os.path.basename(program)
        log = at.folder / f"{name}.{len(list(at.folder.glob(f'{name}.*.log'))) + 1}.log"
        command = at.inside("env", "--chdir", str(folder or at.folder / "home"), program, *map(str, args))
        with log.open("wb") as out:
            entered = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.STDOUT,
                                       env=at.environment(env), start_new_session=True)
        process = Process(at, name, entered, log)
        at.processes = [one for one in at.processes if one.entered.poll() is None] + [process]
        return process

    def run(self, host, program, args=(), env=None, folder=None, within_s=60.0, code=0):
        """Output of a program that ends. code: what it has to end with; None for any."""
        process = self.start(host, program, args, env, folder)
        found = process.wait(within_s)
        if code is not None and found != code:
            raise LabError(f"{program} on {host}: expected code {code}, found {found}; it said: "
                           f"{process.text()[-2000:]}")
        return process.text()

    def pids(self, host):
        """Of all programs of a host, as the lab numbers them."""
        at, found = self.hosts[host], []
        space = os.readlink(f"/proc/{at.first}/ns/pid")
        for entry in os.listdir("/proc"):
            with contextlib.suppress(OSError):
                if entry.isdigit() and int(entry) != at.first and os.readlink(f"/proc/{entry}/ns/pid") == space:
                    found.append(int(entry))
        return found

    # ---- Faults ----

    def kill_host(self, host):
        """SIGKILL to all its programs; it stays on."""
        self._signal_all(host, "KILL")
        self.hosts[host].is_stopped = False
        for process in self.hosts[host].processes:
            process.wait()
        wait_until(lambda: not self.pids(host), f"the end of all programs on {host}")

    def stop_host(self, host):
        self.hosts[host].is_stopped = True
        self._signal_all(host, "STOP")

    def continue_host(self, host):
        self._signal_all(host, "CONT")
        self.hosts[host].is_stopped = False

    def restart(self, host, offset_s=None):
        """Off and on again: no programs, an empty /dev/shm, and the monotonic clock elsewhere if an offset is given."""
        at = self.hosts[host]
        at.switch_off()
        self._switch_on(at, at.offset_s if offset_s is None else offset_s)

    def cut(self, host):
        self._order(f"cut {self.hosts[host].port}")

    def mute(self, host):
        """Programs of the host find those of others, and exchange no samples."""
        self._order(f"mute {self.hosts[host].port}")

    def heal(self, host):
        self._order(f"heal {self.hosts[host].port}")

    def set_line(self, loss=0.0, delay=0.0, jitter=0.0, duplicate=0.0, reorder=0.0, bandwidth=0.0):
        """Shares in percent, times in milliseconds, one way; bandwidth in kbit/s of each host's reception, 0 for no
        limit."""
        for order in (f"loss {loss}", f"delay {delay} {jitter}", f"duplicate {duplicate}", f"reorder {reorder}",
                      f"bandwidth {bandwidth}"):
            self._order(order)

    def statistics(self):
        """Frames since the begin: in, out, lost, duplicated, reordered, cut, overrun."""
        words = self._order("statistics").split()
        return dict(zip(words[::2], map(int, words[1::2])))

    def address(self, host):
        return self.hosts[host].address

    # ---- Within ----

    def _order(self, command):
        self.wire.stdin.write(command + "\n")
        answer = self.wire.stdout.readline().strip()
        if not answer.startswith("ok"):
            raise LabError(f"wire: {command}: {answer or 'it has ended'}")
        return answer[3:]

    def _switch_on(self, host, offset_s):
        host.switch_on(offset_s)
        self._order(f"plug {host.port} /proc/{host.first}/ns/net")
        orders = (f"link set eth0 address 02:00:00:00:00:{host.port:02x}\naddress add {host.address}/24 dev eth0\n"
                  "link set eth0 up\n")
        done = subprocess.run(host.inside("ip", "-batch", "-", spaces=["--net"]), input=orders, capture_output=True,
                              text=True)
        if done.returncode != 0:
            raise LabError(f"host {host.name}: expected an address, found {done.stderr.strip()}")

    def _signal_all(self, host, name):
        # From inside, kill -1 reaches every process but the first and the sender, at one moment.
        command = self.hosts[host].inside("sh", "-c", f"kill -{name} -1 2>/dev/null || :", spaces=["--pid"])
        subprocess.run(command, check=True, timeout=WITHIN_S, start_new_session=True)
