#!/usr/bin/env python3
"""What gateway, `yars config check` and `yars status` say when a network is set up wrongly. Each fault has a line.

usage: setup_faults_test.py BIN     the parts over hosts are left out with a word where there is no lab; without openssl
                                    or the program gateway the test ends with 77
"""
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
import spread_set
from spread_set import FLIGHT, lab

IDENTITIES = lab.TOP / "scripts/network_identities"
WITHIN_S = 60.0
# Datagrams as of a faulty program: bytes of any kind, some behind the head of a DDS message.
GARBAGE = """
import random, socket, sys, time
out, seed, until = (socket.socket(socket.AF_INET, socket.SOCK_DGRAM), random.Random(1),
                    time.monotonic() + float(sys.argv[2]))
while time.monotonic() < until:
    for _ in range(50):
        text = seed.randbytes(seed.randint(0, 1400))
        out.sendto(b"RTPS\\x02\\x01\\x01\\x10" + text if seed.random() < 0.6 else text,
                   (sys.argv[1], seed.choice((7410, 7411))))
    time.sleep(0.01)
"""


def openssl(*words):
    subprocess.run(["openssl", *map(str, words)], check=True, capture_output=True, timeout=60)


def make_network(folder, *hosts):
    subprocess.run([IDENTITIES, folder, *hosts], check=True, stdout=subprocess.DEVNULL, timeout=60)


def said_at_start(programs, file, session):
    """Code and lines of a gateway that is expected to end at once."""
    done = subprocess.run([programs / "gateway", "--session", session, "--network", file], capture_output=True,
                          text=True, timeout=30)
    return done.returncode, done.stderr.splitlines()


def said_by_check(programs, file):
    done = subprocess.run([programs / "yars", "config", "check", file], capture_output=True, text=True, timeout=30)
    return done.returncode, (done.stdout + done.stderr).splitlines()


# ---- Files ----

def expired(folder):
    authority, scratch = folder.parent / "net/ca", folder.parent
    (scratch / "index").write_text("")
    (scratch / "serial").write_text("01\n")
    (scratch / "settings").write_text(f"[ca]\ndefault_ca=x\n[x]\ndatabase={scratch}/index\nserial={scratch}/serial\n"
                                      f"new_certs_dir={scratch}\npolicy=p\ndefault_md=sha256\n"
                                      "[p]\ncommonName=supplied\n")
    openssl("req", "-new", "-sha256", "-key", folder / "key.pem", "-subj", "/CN=a", "-out", scratch / "request")
    openssl("ca", "-batch", "-config", scratch / "settings", "-cert", authority / "identity_ca.pem", "-keyfile",
            authority / "identity_ca.key", "-in", scratch / "request", "-startdate", "20200101000000Z", "-enddate",
            "20210101000000Z", "-notext", "-out", folder / "certificate.pem")


def replaced_by(make):
    """A change of a host's folder: make(path) puts something else in the place of a file."""
    def change(folder, file):
        (folder / file).unlink()
        make(folder / file)
    return change


def faults_of_an_identity_are_named(programs, folder):
    make_network(folder / "net", "a", "b")
    make_network(folder / "other", "a")
    of_b = lambda file: lambda path: shutil.copyfile(folder / "net/b" / file, path / file)
    of_other = lambda file: lambda path: shutil.copyfile(folder / "other/a" / file, path / file)
    pipe, subfolder = replaced_by(os.mkfifo), replaced_by(os.mkdir)
    cases = [
        ("key", of_b("key.pem"), "expected the key of certificate.pem (CN=a) in ", "found another key"),
        ("name", of_b("certificate.pem"), "expected the certificate of host a, CN=a, in ",
         "found CN=b; give the form Network the `name`"),
        ("permissions", of_b("permissions.p7s"), "expected permissions of CN=a", "found those of CN=b"),
        ("authority", of_other("identity_ca.pem"), "expected a certificate that identity_ca.pem beside it has signed",
         "certificate.pem"),
        ("signer", of_other("governance.p7s"), "expected a document that permissions_ca.pem beside it has signed",
         "governance.p7s"),
        ("date", expired, "expected a certificate that is valid now",
         "found one until Jan  1 00:00:00 2021 GMT; check this computer's date"),
        ("pipe", lambda path: pipe(path, "certificate.pem"), "expected a regular file", "found a pipe"),
        ("place", lambda path: subfolder(path, "key.pem"), "expected a regular file", "found a folder"),
        ("device", lambda path: replaced_by(lambda at: at.symlink_to("/dev/zero"))(path, "governance.p7s"),
         "expected a regular file", "governance.p7s"),
        ("missing", lambda path: (path / "permissions_ca.pem").unlink(), "expected the file",
         "found none; scripts/network_identities"),
        ("empty", lambda path: (path / "permissions.p7s").write_text(""), "expected 1 to 1048576 bytes", "found none"),
        ("changed", lambda path: (path / "permissions.p7s").write_bytes(
            (path / "permissions.p7s").read_bytes().replace(b"yars/*", b"yars/?", 1)),
         "expected a document that permissions_ca.pem beside it has signed", "signature failure"),
        ("text", lambda path: (path / "key.pem").write_text("garbage\n"), "expected a private key without password",
         "key.pem"),
    ]
    for name, change, *parts in cases:
        shutil.copytree(folder / "net/a", folder / name)
        change(folder / name)
        (folder / f"{name}.guf").write_text(f'( Network :name "a" :security "{name}" )\n')
        for code, lines in (said_at_start(programs, folder / f"{name}.guf", "setup_faults"),
                            said_by_check(programs, folder / f"{name}.guf")):
            assert code == 1 and len(lines) == 1 and "Network: security: " in lines[0], (name, code, lines)
            assert all(part in lines[0] for part in parts), (name, lines)
    (folder / "none.guf").write_text('( Network :security "nowhere" )\n')
    code, lines = said_by_check(programs, folder / "none.guf")
    assert code == 1 and "expected a folder with the identity of this host, found none at" in lines[0], lines


def an_identity_of_another_host_than_this_is_warned_of(programs, folder):
    """Without `name` the gateway has the host's name. The file may be meant for another computer, so it is valid."""
    make_network(folder / "net", "not-this-host")
    (folder / "host.guf").write_text('( Network :security "net/not-this-host" )\n')
    code, lines = said_at_start(programs, folder / "host.guf", "setup_faults")
    assert code == 1 and "found CN=not-this-host" in lines[-1], lines
    code, lines = said_by_check(programs, folder / "host.guf")
    assert code == 0 and "the gateway would refuse this here: Network: security: " in lines[0], lines
    assert ("found CN=not-this-host; give the form Network the `name`" in lines[0] and
            "valid, 1 warning" in lines[1]), lines


def a_key_that_others_can_read_is_warned_of(programs, folder):
    make_network(folder / "net", "a")
    (folder / "a.guf").write_text('( Network :name "a" :security "net/a" )\n')
    code, lines = said_by_check(programs, folder / "a.guf")
    assert code == 0 and len(lines) == 1 and "valid, 0 warnings" in lines[0], lines
    (folder / "net/a/key.pem").chmod(0o644)
    code, lines = said_by_check(programs, folder / "a.guf")
    assert code == 0 and "found mode 0644; chmod 600 " in lines[0] and "net/a/key.pem" in lines[0], lines


def faults_of_the_form_are_named(programs, folder):
    file = folder / "form.guf"
    file.write_text('( Network :interfaces `( "nosuchif0" ) )\n')
    code, lines = said_at_start(programs, file, "setup_faults")
    assert code == 1 and len(lines) == 1, lines
    assert "Network: interfaces: expected names of interfaces of this computer, which are " in lines[0], lines
    assert "lo (127.0.0.1)" in lines[0] and 'found "nosuchif0"' in lines[0], lines
    code, lines = said_by_check(programs, file)
    assert code == 0 and "the gateway would refuse this here: " in lines[0] and "valid, 1 warning" in lines[1], lines
    file.write_text('( Network :peers `( "127.0.0.1" "no-such-host.invalid" ) )\n')
    code, lines = said_by_check(programs, file)
    assert code == 0 and 'found "no-such-host.invalid", which has none here; it is not asked' in lines[0], lines


def too_few_places_name_the_slot(programs, folder):
    file = folder / "form.guf"
    file.write_text("( Network :domain 229 :participants 1 )\n")
    first = subprocess.Popen([programs / "gateway", "--session", "setup_faults_1", "--network", file],
                             stderr=subprocess.PIPE, text=True)
    try:
        assert "joins session" in first.stderr.readline()
        code, lines = said_at_start(programs, file, "setup_faults_2")
        assert code == 1 and len(lines) == 1, lines
        assert "Network: participants: expected a free one of the 1 places for DDS programs" in lines[0], lines
        code, lines = said_at_start(programs, file, "setup_faults_1")
        assert code == 2 and f"found held by gateway, pid {first.pid}; end that process" in lines[-1], lines
    finally:
        first.terminate()
        first.wait(30)


# ---- Hosts ----

def a_host_alone_says_whom_it_asks(programs, _):
    with spread_set.SpreadSet(programs, {"a": (), "b": ()}) as spread:
        gateway = spread.start_gateway("a")
        gateway.wait_for("joined the session clock, alone: asked 192.168.10.2: none has answered yet", WITHIN_S)
        gateway.wait_for("no other host has been heard in 10 s, asked 192.168.10.2; the usual reasons", WITHIN_S)
        assert "UDP ports 7410 to 7417" in gateway.text(), gateway.text()
        other = spread.start_gateway("b")
        gateway.wait_for("hears host b", WITHIN_S)
        other.wait_for("joined the session clock", WITHIN_S)
        assert "alone" not in other.text(), other.text()


def security_on_one_side_is_named(programs, _):
    with spread_set.SpreadSet(programs, {"a": (), "b": ()}) as spread:
        make_network(spread.lab.folder / "net", "a")
        spread.start_gateway("a", options=':security "net/a"')
        spread.start_gateway("b")
        for host, other, reason in (("a", "b", "its form Network has no `security`, or an identity of another network"),
                                    ("b", "a", "its form Network has `security`, and that of this host has none")):
            line = f"the gateway of {other} ({spread.lab.address(other)}) is heard, but exchanges nothing: {reason}"
            spread.gateways[host].wait_for(line, WITHIN_S)
        time.sleep(2.0)
        for gateway in spread.gateways.values():  # once each time that it joins: on a busy machine it may join again
            text = gateway.text()
            assert 1 <= text.count("exchanges nothing") <= text.count("joins session"), text
        status = spread.yars("a", "status", code=None)
        note = next((line for line in status.splitlines() if "exchanges nothing" in line), "")
        assert " loss " in note and note.endswith("open UDP ports"), status
        assert "refusal 0" in status, status


def another_session_is_named(programs, _):
    with spread_set.SpreadSet(programs, {"a": (), "b": ()}) as spread:
        spread.start_gateway("a")
        spread.lab.start("b", str(programs / "gateway"), ["--session", "other", "--network", spread.network_file("b")])
        spread.gateways["a"].wait_for(f"is of session other, this one of session {spread.session}: "
                                      "nothing is exchanged", WITHIN_S)


def garbage_gives_few_lines(programs, _):
    """The gateway joins another afterwards, so the flood had an effect neither on it nor on its memory."""
    seconds = 6.0
    with spread_set.SpreadSet(programs, {"a": (), "b": ()}) as spread:
        gateway = spread.start_gateway("a")
        gateway.wait_for("joined", WITHIN_S)
        before = len(gateway.text().splitlines())
        spread.lab.run("b", sys.executable, ["-c", GARBAGE, spread.lab.address("a"), seconds])
        gateway.wait_for("more messages of Cyclone DDS left out", WITHIN_S)
        lines = len(gateway.text().splitlines()) - before
        assert lines < 10 + 3 * (seconds + 10), gateway.text()
        assert gateway.log.stat().st_size < 20_000, gateway.log.stat().st_size
        spread.start_gateway("b")
        gateway.wait_for("hears host b", WITHIN_S)


def status_shows_who_runs_where(programs, _):
    hosts = {"a": [("flight-model", FLIGHT)], "b": (), "c": [("radar-model", [])]}
    with spread_set.SpreadSet(programs, hosts) as spread:
        spread.start_gateways()
        spread.start_roles("a")
        spread.start_roles("c")
        shown = lambda host, name: next((line for line in spread.yars(host, "status", code=None).splitlines()
                                         if line.startswith(f"  {name} ")), "")
        lab.wait_until(lambda: "flight-model" in shown("b", "a"), "flight-model of a in `yars status` on b", WITHIN_S,
                       every_s=0.3)
        lab.wait_until(lambda: "radar-model" in shown("b", "c"), "radar-model of c in `yars status` on b", WITHIN_S,
                       every_s=0.3)
        spread.gateways["a"].signal(signal.SIGINT)
        spread.gateways["a"].wait(WITHIN_S)
        spread.gateways["b"].wait_for("info: host a has left", WITHIN_S)
        spread.lab.kill_host("c")
        spread.gateways["b"].wait_for("warning: host c is no longer heard", WITHIN_S)
        assert "host a is no longer heard" not in spread.gateways["b"].text(), spread.logs()
        lab.wait_until(lambda: "left" in shown("b", "a") and "silent" in shown("b", "c"), "hosts that are gone",
                       WITHIN_S, every_s=0.3)
        assert "model" not in shown("b", "a") and "model" not in shown("b", "c"), spread.yars("b", "status", code=None)


def main():
    programs = pathlib.Path(sys.argv[1]).resolve()
    if not os.access(programs / "gateway", os.X_OK) or shutil.which("openssl") is None:
        print("skipped: expected the program gateway and openssl, found not both")
        return 77
    tests = [faults_of_an_identity_are_named, an_identity_of_another_host_than_this_is_warned_of,
             a_key_that_others_can_read_is_warned_of, faults_of_the_form_are_named, too_few_places_name_the_slot]
    if reason := spread_set.why_skipped(programs):
        print(f"left out: {reason}")
    else:
        tests += [a_host_alone_says_whom_it_asks, security_on_one_side_is_named, another_session_is_named,
                  garbage_gives_few_lines, status_shows_who_runs_where]
    for test in tests:
        began = time.monotonic()
        with tempfile.TemporaryDirectory() as folder:
            test(programs, pathlib.Path(folder))
        print(f"{test.__name__}: ok, {time.monotonic() - began:.1f} s", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
