#!/usr/bin/env python3
"""A station behind a mapped port, a tunnel of ssh, and nginx at /radar/.
usage: proxy_test.py BIN (folder of the programs)

The tests of ssh and nginx are skipped where these programs are not installed.
Both run for this test alone, with their own files.
"""
import contextlib
import getpass
import http.client
import pathlib
import re
import shutil
import socket
import ssl
import subprocess
import tempfile
import threading
import time
import unittest

from access_of_others_test import SocketOfPage, Station, get

SSHD, NGINX = (shutil.which(name, path="/usr/sbin:/usr/bin:/usr/local/sbin") or shutil.which(name)
               for name in ("sshd", "nginx"))
WATCHDOG_S = 60
NGINX_CONFIGURATION = """
daemon off; pid {folder}/nginx.pid; error_log {folder}/error.log; worker_processes 1;
events {{ worker_connections 64; }}
http {{
  access_log off; client_body_temp_path {folder}/b; proxy_temp_path {folder}/p;
  fastcgi_temp_path {folder}/f; uwsgi_temp_path {folder}/u; scgi_temp_path {folder}/s;
  server {{
    listen 127.0.0.1:{port} ssl; ssl_certificate {folder}/certificate.pem; ssl_certificate_key {folder}/key.pem;
    location /radar/ {{
      proxy_pass http://127.0.0.1:{station}/;
      proxy_http_version 1.1; proxy_set_header Upgrade $http_upgrade; proxy_set_header Connection "upgrade";
      {headers}
    }}
  }}
}}
"""
BY_HOST = "proxy_set_header Host $http_host;"
BY_FORWARDED = ("proxy_set_header X-Forwarded-Host $http_host; proxy_set_header X-Forwarded-Proto $scheme; "
                "proxy_set_header X-Forwarded-For $proxy_add_x_forwarded_for;")


def free_port():
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        return taken.getsockname()[1]


def await_port(port, process):
    deadline = time.monotonic() + WATCHDOG_S
    while True:
        with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", port), timeout=5):
            return
        assert process.poll() is None and time.monotonic() < deadline, f"nothing listens at {port}"
        time.sleep(0.05)


class MappedPort:
    """Hands connections on, as a tunnel or the mapped port of a container does:
    the browser's port is another than the station's."""

    def __init__(self, port):
        self.target = port
        self.server = socket.create_server(("127.0.0.1", 0))
        self.port = self.server.getsockname()[1]
        threading.Thread(target=self.accept, daemon=True).start()

    def accept(self):
        with contextlib.suppress(OSError):
            while True:
                here = self.server.accept()[0]
                there = socket.create_connection(("127.0.0.1", self.target))
                for source, sink in ((here, there), (there, here)):
                    threading.Thread(target=self.copy, args=(source, sink), daemon=True).start()

    @staticmethod
    def copy(source, sink):
        with contextlib.suppress(OSError):
            while data := source.recv(65536):
                sink.sendall(data)
            sink.shutdown(socket.SHUT_WR)


class Proxies(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(folder.name)
        self.addCleanup(folder.cleanup)

    def station(self, *options):
        station = Station(str(self.folder), "--with-tokens", *options)
        self.addCleanup(station.__exit__)
        self.tokens = [re.search("token=(.*)", address).group(1) for address in station.addresses]
        return station

    def process(self, *command):
        process = subprocess.Popen([str(word) for word in command], stdin=subprocess.DEVNULL)
        self.addCleanup(process.wait)
        self.addCleanup(process.terminate)
        return process

    def works_at(self, port, station):
        """The printed address leads to a page, whose socket an instructor uses."""
        status, headers, _ = get(port, f"/instructor.html?token={self.tokens[1]}")
        self.assertEqual((status, headers["Location"]), (303, "instructor.html"))
        cookie = headers["Set-Cookie"].split(";")[0]
        self.assertEqual(get(port, "/instructor.html", cookie)[0], 200)
        page = SocketOfPage(port, cookie=cookie)
        self.assertEqual(page.status, 101)
        page.send({"do": "run", "id": 3})
        self.assertIsNone(page.answer(3))
        page.close()
        self.assertNotEqual(port, station.port)

    def test_a_mapped_port(self):
        station = self.station()
        mapped = MappedPort(station.port)
        self.works_at(mapped.port, station)
        mapped.server.close()

    @unittest.skipUnless(SSHD and shutil.which("ssh") and shutil.which("ssh-keygen"),
                         "expected ssh and sshd, found none")
    def test_a_tunnel_of_ssh(self):
        station, port, mapped = self.station(), free_port(), free_port()
        for name in ("host", "user"):
            subprocess.run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", self.folder / name], check=True)
        shutil.copy(self.folder / "user.pub", self.folder / "authorized")
        (self.folder / "sshd").write_text(f"Port {port}\nListenAddress 127.0.0.1\nHostKey {self.folder}/host\n"
                                          "PidFile none\nStrictModes no\nUsePAM no\n"
                                          f"AuthorizedKeysFile {self.folder}/authorized\nPermitRootLogin yes\n")
        await_port(port, self.process(SSHD, "-D", "-e", "-f", self.folder / "sshd"))
        tunnel = self.process("ssh", "-N", "-F", "none", "-p", port, "-i", self.folder / "user",
                              "-o", "StrictHostKeyChecking=no", "-o", "UserKnownHostsFile=/dev/null",
                              "-o", "ExitOnForwardFailure=yes", "-L", f"{mapped}:127.0.0.1:{station.port}",
                              f"{getpass.getuser()}@127.0.0.1")
        await_port(mapped, tunnel)
        self.works_at(mapped, station)

    def nginx(self, station, headers):
        port = free_port()
        subprocess.run(["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-keyout", "key.pem",
                        "-out", "certificate.pem", "-days", "2",
                        "-subj", "/CN=localhost", "-addext", "subjectAltName=DNS:localhost,IP:127.0.0.1"],
                       cwd=self.folder, check=True, capture_output=True)
        (self.folder / "nginx").write_text(
            NGINX_CONFIGURATION.format(folder=self.folder, port=port, station=station.port, headers=headers))
        await_port(port, self.process(NGINX, "-c", self.folder / "nginx", "-p", self.folder))
        return port

    @unittest.skipUnless(NGINX and shutil.which("openssl"), "expected nginx and openssl, found none")
    def test_nginx_at_a_path_of_its_own(self):
        for options, headers in (((), BY_HOST), (("--behind-proxy",), BY_FORWARDED)):
            with self.subTest(headers):
                station = self.station(*options)
                port = self.nginx(station, headers)
                context = ssl.create_default_context(cafile=f"{self.folder}/certificate.pem")
                status, given, _ = get(port, f"/radar/display.html?token={self.tokens[1]}", context=context,
                                       host="localhost")
                self.assertEqual((status, given["Location"]), (303, "display.html"))
                self.assertEqual("; Secure" in given["Set-Cookie"], headers == BY_FORWARDED)
                cookie = given["Set-Cookie"].split(";")[0]
                for file in ("display.html", "display.js", "station.css", "theatre.json"):
                    status, _, content = get(port, f"/radar/{file}", cookie, context=context, host="localhost")
                    self.assertEqual(status, 200, file)
                    self.assertNotRegex(content.decode(), r"""(src|href)=["']/|fetch\(["'`]/""", file)
                page = SocketOfPage(port, "/radar/socket?page=instructor", cookie, context, "localhost")
                self.assertEqual(page.status, 101)
                page.send({"do": "run", "id": 3})
                self.assertIsNone(page.answer(3))
                page.close()

    @unittest.skipUnless(NGINX and shutil.which("openssl"), "expected nginx and openssl, found none")
    def test_a_proxy_that_says_nothing_is_told_what_to_do(self):
        station = self.station()
        port = self.nginx(station, "")
        context = ssl.create_default_context(cafile=f"{self.folder}/certificate.pem")
        connection = http.client.HTTPSConnection("127.0.0.1", port, context=context, timeout=20)
        connection.request("GET", "/radar/socket",
                           headers={"Host": f"localhost:{port}", "Origin": f"https://localhost:{port}"})
        answer = connection.getresponse()
        self.assertEqual(answer.status, 403)
        self.assertIn("--behind-proxy", answer.read().decode())
        connection.close()


if __name__ == "__main__":
    unittest.main()
