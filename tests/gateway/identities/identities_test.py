#!/usr/bin/env python3
"""scripts/network_identities: what it makes, what it refuses, and that DDS programs with these identities meet and
others do not.

usage: identities_test.py       ends with 77 and a word where openssl is missing; without idlc, gcc or Cyclone DDS its
                                last part is left out
The programs talk over loopback alone, in a domain of their own.
"""
import os
import pathlib
import shutil
import stat
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parents[3]
SCRIPT = TOP / "scripts/network_identities"
OF_HOST = ["certificate.pem", "governance.p7s", "identity_ca.pem", "key.pem", "permissions.p7s", "permissions_ca.pem"]
SECONDS = 20  # at most: a reader that has received something ends
REFUSED_SECONDS = 2
IDL = "module yars { @final struct Word { long number; }; };\n"
CONFIGURATION = """<CycloneDDS><Domain Id="{domain}">
 <General><Interfaces><NetworkInterface name="lo" multicast="false"/></Interfaces>
  <AllowMulticast>false</AllowMulticast></General>
 <Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>7</MaxAutoParticipantIndex>
  <Peers><Peer Address="127.0.0.1"/></Peers><SPDPInterval>200ms</SPDPInterval></Discovery>
 <SharedMemory><Enable>false</Enable></SharedMemory>
 {security}
</Domain></CycloneDDS>
"""
SECURITY = """<Security>
  <Authentication>
   <Library initFunction="init_authentication" finalizeFunction="finalize_authentication" path="dds_security_auth"/>
   <IdentityCA>file:{0}/identity_ca.pem</IdentityCA><IdentityCertificate>file:{0}/certificate.pem</IdentityCertificate>
   <PrivateKey>file:{0}/key.pem</PrivateKey></Authentication>
  <AccessControl>
   <Library initFunction="init_access_control" finalizeFunction="finalize_access_control" path="dds_security_ac"/>
   <PermissionsCA>file:{0}/permissions_ca.pem</PermissionsCA><Governance>file:{0}/governance.p7s</Governance>
   <Permissions>file:{0}/permissions.p7s</Permissions></AccessControl>
  <Cryptographic>
   <Library initFunction="init_crypto" finalizeFunction="finalize_crypto" path="dds_security_crypto"/></Cryptographic>
 </Security>"""


def run(*words):
    return subprocess.run([SCRIPT, *words], capture_output=True, text=True, timeout=60)


def make(*words):
    done = run(*words)
    assert done.returncode == 0 and done.stderr == "", done
    return done.stdout


def each_host_has_what_it_needs(folder):
    make(folder / "net", "a", "b", "--days", "30")
    assert sorted(path.name for path in (folder / "net").iterdir()) == ["a", "b", "ca"]
    for host in ("a", "b"):
        own = folder / "net" / host
        assert sorted(path.name for path in own.iterdir()) == OF_HOST
        assert stat.S_IMODE((own / "key.pem").stat().st_mode) == 0o600
        assert stat.S_IMODE(own.stat().st_mode) == 0o700
        for words in (["verify", "-CAfile", own / "identity_ca.pem", own / "certificate.pem"],
                      ["smime", "-verify", "-CAfile", own / "permissions_ca.pem", "-in", own / "governance.p7s"],
                      ["smime", "-verify", "-CAfile", own / "permissions_ca.pem", "-in", own / "permissions.p7s"]):
            done = subprocess.run(["openssl", *words], capture_output=True, text=True)
            assert done.returncode == 0, done
        assert (f"<subject_name>CN={host}</subject_name>" in done.stdout and
                "<topic>yars/*</topic>" in done.stdout), done.stdout
    keys = {path.read_bytes() for path in (folder / "net").rglob("*key*")}
    assert len(keys) == 4, "two hosts share a key"


def hosts_are_added_with_the_same_authority(folder):
    make(folder / "net", "a")
    before = {path: path.read_bytes() for path in (folder / "net").rglob("*.*")}
    make(folder / "net", "c", "--add", "--reads", "c")
    assert all(path.read_bytes() == text for path, text in before.items())
    assert (folder / "net/c/identity_ca.pem").read_bytes() == (folder / "net/a/identity_ca.pem").read_bytes()
    permissions = (folder / "net/c/permissions.p7s").read_text()
    assert ("<topic>yars/input_events</topic>" in permissions and
            permissions.count("<topic>yars/*</topic>") == 1), permissions


def nothing_is_written_over_and_faults_are_named(folder):
    net = folder / "net"
    (folder / "file").touch()
    make(net, "a")
    before = sorted(net.rglob("*"))
    for words, code, part in (([net, "a"], 1, "expected no a, ca in "), ([net, "b"], 1, "expected no ca in "),
                              ([net, "a", "--add"], 1, "expected no a in "),
                              ([folder / "other", "x", "--add"], 1, "expected identity_ca.key"),
                              ([net, "ca", "--add"], 1, "and not ca"),
                              ([net, "../x", "--add"], 1, "HOST: expected 1 to 31 letters"),
                              ([net, "x\x1b", "--add"], 1, "found 'x\\x1b'"),
                              ([net, "x", "x", "--add"], 1, "found one twice"),
                              ([net, "x", "--add", "--reads", "a"], 1, "--reads: expected one of x, found 'a'"),
                              ([folder / "file", "x"], 1, "expected a folder, found the file"),
                              ([net], 2, "expected DIR and one HOST"),
                              ([net, "x", "--days", "0"], 2, "from 1 to 36500, found '0'"),
                              ([net, "x", "--dais", "1"], 2, "--dais")):
        done = run(*words)
        lines = done.stderr.splitlines()
        assert done.returncode == code and len(lines) == 1 and part in lines[0] and done.stdout == "", (words, done)
        assert lines[0].startswith("scripts/network_identities: "), lines
    assert sorted(net.rglob("*")) == before and not (folder / "other").exists()
    assert run("--help").stdout.startswith("Makes the identities")


class Network:
    """Programs over loopback; identity: a folder of a host, or none."""

    def __init__(self, folder, program):
        self.folder, self.program, self.count = folder, program, 0
        self.domain = 30 + os.getpid() % 100

    def talk(self, identity, action, topic, partition="s", seconds=SECONDS):
        self.count += 1
        file = self.folder / f"{self.count}.xml"
        file.write_text(CONFIGURATION.format(domain=self.domain,
                                             security=SECURITY.format(identity) if identity else ""))
        environment = {**os.environ, "CYCLONEDDS_URI": f"file://{file}"}
        with (self.folder / f"{self.count}.log").open("w") as log:
            return subprocess.Popen([self.program, action, topic, partition, str(seconds)], stdout=subprocess.PIPE,
                                    stderr=log, text=True, env=environment)

    def received(self, writer, reader, topic="yars/radar_state", seconds=SECONDS):
        """What a reader with an identity got of a writer with one."""
        writing, reading = self.talk(writer, "write", topic), self.talk(reader, "read", topic, seconds=seconds)
        said = reading.communicate(timeout=seconds + 40)[0]
        writing.kill()
        writing.wait()
        assert said.startswith("received "), (said, self.folder)
        return int(said.split()[1])

    def refused(self, identity, action, topic):
        said = self.talk(identity, action, topic, seconds=0).communicate(timeout=60)[0]
        return said.startswith("refused: ")


def built(folder):
    """The program talker; a word where it cannot be built."""
    for tool in ("idlc", "gcc", "pkg-config"):
        if shutil.which(tool) is None:
            return None, f"expected {tool}, found none"
    flags = subprocess.run(["pkg-config", "--cflags", "--libs", "CycloneDDS"], capture_output=True, text=True)
    if flags.returncode != 0:
        return None, "expected the package cyclonedds-dev, found none"
    (folder / "word.idl").write_text(IDL)
    subprocess.run(["idlc", "word.idl"], cwd=folder, check=True, timeout=60)
    source = pathlib.Path(__file__).resolve().parent / "talker.c"
    subprocess.run(["gcc", "-std=gnu11", "-Wall", "-Wextra", "-Werror", "-I.", "word.c", source, "-o", "talker",
                    *flags.stdout.split()], cwd=folder, check=True, timeout=120)
    return folder / "talker", ""


def identities_meet_and_strangers_do_not(folder):
    program, why_not = built(folder)
    if program is None:
        print(f"left out: {why_not}")
        return
    make(folder / "net", "a", "b", "d", "--reads", "d")
    make(folder / "elsewhere", "a")
    make(folder / "net", "e", "--add")
    a, b, d, e = (folder / "net" / host for host in "abde")
    other = folder / "elsewhere" / "a"
    network = Network(folder, program)
    assert network.received(a, b) > 0
    assert network.received(a, e) > 0 and network.received(a, d) > 0
    assert network.received(d, a, "yars/input_events") > 0
    assert network.refused(d, "write", "yars/radar_state") and not network.refused(d, "write", "yars/hosts")
    assert network.refused(a, "write", "other/topic")
    for stranger in (None, other):
        assert network.received(a, stranger, seconds=REFUSED_SECONDS) == 0
        assert network.received(stranger, a, seconds=REFUSED_SECONDS) == 0
    # Strangers meet among themselves, so the line is not to blame.
    assert network.received(None, None) > 0


def main():
    if shutil.which("openssl") is None:
        print("skipped: expected openssl, found none")
        return 77
    for test in (each_host_has_what_it_needs, hosts_are_added_with_the_same_authority,
                 nothing_is_written_over_and_faults_are_named, identities_meet_and_strangers_do_not):
        with tempfile.TemporaryDirectory() as folder:
            test(pathlib.Path(folder))
        print(f"{test.__name__}: ok", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
