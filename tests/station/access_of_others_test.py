#!/usr/bin/env python3
"""A station and who connects to it: tokens, rights, TLS, limits, its end, a radar-model that is away.
usage: access_of_others_test.py BIN (folder of the programs)"""
import base64
import http.client
import http.cookiejar
import json
import os
import pathlib
import re
import resource
import shutil
import socket
import ssl
import stat
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.request

BIN = pathlib.Path(sys.argv.pop(1)).resolve()


class Station:
    """A running yars-station. `addresses`: as it printed them. Without tokens unless options name some.
    It ends without a fault."""

    def __init__(self, folder, *options):
        options = (*options, *([] if "--tokens" in options or "--with-tokens" in options else ["--without-tokens"]))
        options = [option for option in options if option != "--with-tokens"]
        self.session = f"access{os.getpid()}"
        self.process = subprocess.Popen([BIN / "yars-station", "--session", self.session, "--port", "0",
                                         "--log-level", "warning", *options],
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=folder)
        self.addresses = [self.process.stdout.readline().strip() for _ in range(2)]
        self.port = int(re.search(r":(\d+)/", self.addresses[0]).group(1)) if all(self.addresses) else 0

    def __enter__(self):
        return self

    def __exit__(self, problem=None, *_):
        self.process.terminate()
        said = self.process.communicate()[1]
        if problem is None:
            assert self.process.returncode == 0, (self.process.returncode, said)


def refusal(*options):
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([BIN / "yars-station", "--session", f"refused{os.getpid()}", "--port", "0", *options],
                              capture_output=True, text=True, check=False, timeout=60, cwd=folder)
    return done.returncode, done.stderr


class SocketOfPage:
    """A WebSocket with the given headers."""

    def __init__(self, port, path="/socket?page=instructor", cookie="", context=None, host="127.0.0.1"):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=20)
        if context:
            self.socket = context.wrap_socket(self.socket, server_hostname="localhost")
        scheme = "https" if context else "http"
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall((f"GET {path} HTTP/1.1\r\nHost: {host}:{port}\r\nUpgrade: websocket\r\n"
                             "Connection: Upgrade\r\n"
                             f"Origin: {scheme}://{host}:{port}\r\nSec-WebSocket-Key: {key}\r\n"
                             "Sec-WebSocket-Version: 13\r\n"
                             + (f"Cookie: {cookie}\r\n" if cookie else "") + "\r\n").encode())
        self.data = b""
        while b"\r\n\r\n" not in self.data:
            part = self.socket.recv(65536)
            if not part:
                break
            self.data += part
        head, _, self.data = self.data.partition(b"\r\n\r\n")
        self.status = int(head.split()[1])

    def send(self, message):
        data = json.dumps(message).encode()
        size = bytes([0x80 | len(data)]) if len(data) < 126 else bytes([0x80 | 126]) + len(data).to_bytes(2, "big")
        self.socket.sendall(b"\x81" + size + b"\0\0\0\0" + data)

    def texts(self):
        """Text messages, until the connection closes."""
        kind, content = 0, b""  # a message may come in parts
        while True:
            while len(self.data) < 2 or len(self.data) < self.end()[1]:
                part = self.socket.recv(65536)
                if not part:
                    return
                self.data += part
            begin, end = self.end()
            opcode, last = self.data[0] & 15, self.data[0] & 128
            kind, content = opcode or kind, (b"" if opcode else content) + self.data[begin:end]
            self.data = self.data[end:]
            if kind == 8:
                return
            if kind == 1 and last:
                yield json.loads(content)

    def end(self):
        """Begin and end of the content of the first message, as far as its size is known."""
        size, begin = self.data[1] & 127, 2
        if size >= 126:
            wide = 2 if size == 126 else 8
            size, begin = int.from_bytes(self.data[2:2 + wide].ljust(wide, b"\0"), "big"), 2 + wide
        return begin, begin + size

    def answer(self, identity):
        for text in self.texts():
            if text.get("answer") == identity:
                return text["problem"]
        return "closed"

    def close(self):
        self.socket.close()


def get(port, path, cookie="", host="127.0.0.1", context=None):
    """(status, headers, content)"""
    connection = (http.client.HTTPSConnection("127.0.0.1", port, context=context, timeout=20) if context
                  else http.client.HTTPConnection("127.0.0.1", port, timeout=20))
    headers = {"Host": f"{host}:{port}"}
    if cookie:
        headers["Cookie"] = cookie
    connection.request("GET", path, headers=headers)
    response = connection.getresponse()
    content = response.read()
    connection.close()
    return response.status, dict(response.getheaders()), content


def status_of(port, path, cookie=""):
    """Status with which a WebSocket is answered."""
    page = SocketOfPage(port, path, cookie)
    page.close()
    return page.status


class Browser:
    """Opens printed addresses of a station and keeps its cookies."""

    def __init__(self, port):
        self.port = port
        self.jar = http.cookiejar.CookieJar()
        self.opener = urllib.request.build_opener(urllib.request.ProxyHandler({}),
                                                  urllib.request.HTTPCookieProcessor(self.jar))

    def open(self, address):
        """Status of the page that the address leads to."""
        path = re.fullmatch(r"https?://[^/]+(/.*)", address).group(1)
        with self.opener.open(f"http://127.0.0.1:{self.port}{path}", timeout=20) as response:
            return response.status

    def may_freeze(self):
        page = SocketOfPage(self.port, cookie="; ".join(f"{cookie.name}={cookie.value}" for cookie in self.jar))
        page.send({"do": "freeze", "id": 5})
        problem = page.answer(5)
        page.close()
        return problem is None


class Options(unittest.TestCase):
    def test_beyond_loopback_needs_tokens_and_a_certificate(self):
        code, text = refusal("--listen", "0.0.0.0", "--without-tokens")
        self.assertEqual(code, 2, text)
        self.assertIn("expected tokens, because others can reach the station", text)
        code, text = refusal("--listen", "0.0.0.0", "--tokens", "tokens")
        self.assertEqual(code, 2, text)
        self.assertIn("--without-tls", text)

    def test_what_cannot_be_used_is_named(self):
        for options, words in [(("--certificate", "x.pem"), "--key"),
                               (("--certificate", "x.pem", "--key", "y.pem"),
                                "x.pem: expected a file that can be read"),
                               (("--listen", "nowhere", "--tokens", "t", "--without-tls"), "an address in numbers"),
                               (("--pages", "/nowhere"), "display.html"), (("--terrain", "/nowhere"), "/nowhere"),
                               (("--source", "route:/nowhere"), "/nowhere")]:
            code, text = refusal(*options)
            self.assertNotEqual(code, 0, options)
            self.assertIn(words, text)

    def test_names_are_names_of_computers(self):
        for names in ("a b", "radar.example,", "http://radar", "radar:80", "*"):
            code, text = refusal("--names", names)
            self.assertEqual(code, 2, text)
            self.assertIn("expected names of a computer", text)

    def test_secrets_that_others_can_read_are_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            tokens, key = pathlib.Path(folder, "tokens"), pathlib.Path(folder, "key.pem")
            tokens.write_text("instructor 0123456789abcdef\nviewer fedcba9876543210\n")
            key.write_text("a key")
            for file, mode, options in ((tokens, 0o640, ("--tokens", tokens)),
                                        (key, 0o604, ("--certificate", key, "--key", key))):
                file.chmod(mode)
                code, text = refusal(*map(str, options))
                self.assertEqual(code, 1, text)
                self.assertIn(f"expected a file that other users cannot read, found mode {mode:04o}; chmod 600 {file}",
                              text)

    def test_a_file_without_tokens_is_refused(self):
        with tempfile.NamedTemporaryFile("w") as file:
            file.write("viewer short\n")
            file.flush()
            code, text = refusal("--tokens", file.name)
        self.assertEqual(code, 1, text)
        self.assertIn("instructor TOKEN", text)


class Tokens(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.file = pathlib.Path(cls.folder.name) / "tokens"
        cls.station = Station(cls.folder.name, "--listen", "0.0.0.0", "--tokens", str(cls.file), "--without-tls",
                              "--names", "radar.example")
        cls.port = cls.station.port
        cls.tokens = [re.search(r"token=(\w+)", address).group(1) for address in cls.station.addresses]
        cls.cookies = [f"yars_station_{cls.port}_{right}={token}"
                       for right, token in zip(("viewer", "instructor"), cls.tokens)]

    @classmethod
    def tearDownClass(cls):
        cls.station.__exit__()
        cls.folder.cleanup()

    def test_the_file_of_tokens_is_its_owners_alone_and_stays(self):
        self.assertEqual(stat.S_IMODE(self.file.stat().st_mode), 0o600)
        with Station(self.folder.name, "--listen", "0.0.0.0", "--tokens", str(self.file), "--without-tls") as again:
            self.assertEqual([re.search(r"token=(\w+)", address).group(1) for address in again.addresses], self.tokens)

    def test_printed_addresses_have_the_first_name_of_this_computer(self):
        self.assertTrue(self.station.addresses[0].startswith(f"http://radar.example:{self.port}/display.html?"),
                        self.station.addresses)
        self.assertTrue(self.station.addresses[1].startswith(f"http://radar.example:{self.port}/instructor.html?"),
                        self.station.addresses)

    def test_without_a_token_there_is_nothing_of_the_session(self):
        for path in ("/display.html", "/instructor.html", "/theatre.json", "/map/0/0/0.png", "/patch/x/1.png",
                     "/nothing"):
            self.assertEqual(get(self.port, path)[0], 401, path)
            self.assertEqual(get(self.port, path, cookie=f"yars_station_{self.port}_instructor=wrong")[0], 401, path)
        self.assertEqual(status_of(self.port, "/socket"), 401)
        self.assertEqual(get(self.port, "/display.html?token=wrong")[0], 401)

    def test_an_address_with_a_token_gives_a_cookie_and_leaves_the_token_out(self):
        status, headers, _ = get(self.port, f"/instructor.html?token={self.tokens[1]}")
        self.assertEqual(status, 303)
        self.assertEqual(headers["Location"], "instructor.html")
        self.assertIn("HttpOnly", headers["Set-Cookie"])
        cookie = headers["Set-Cookie"].split(";")[0]
        self.assertEqual(get(self.port, "/instructor.html", cookie)[0], 200)
        self.assertEqual(get(self.port, "/theatre.json", cookie)[0], 200)
        self.assertEqual(get(self.port, "/map/0/0/0.png", cookie)[0], 200)

    def test_a_browser_of_an_instructor_stays_one_at_the_address_of_viewers(self):
        for addresses in (self.station.addresses, self.station.addresses[::-1]):
            browser = Browser(self.port)
            self.assertEqual([browser.open(address) for address in addresses], [200, 200])
            self.assertTrue(browser.may_freeze(), addresses)

    def test_the_address_of_viewers_gives_a_viewers_rights(self):
        browser = Browser(self.port)
        self.assertEqual(browser.open(self.station.addresses[0]), 200)
        self.assertEqual(browser.open(self.station.addresses[1].partition("?")[0]), 200)
        self.assertFalse(browser.may_freeze())

    def test_a_page_is_told_what_it_may_do(self):
        for cookie, right in zip(self.cookies, ("viewer", "instructor")):
            for kind in ("display", "instructor"):
                page = SocketOfPage(self.port, f"/socket?page={kind}", cookie)
                self.assertEqual(next(page.texts()), {"right": right})
                page.close()

    def test_a_viewer_looks_and_changes_nothing(self):
        page = SocketOfPage(self.port, cookie=self.cookies[0])
        self.assertEqual(page.status, 101)
        page.send({"do": "freeze", "id": 5})
        self.assertIn("token of an instructor", page.answer(5))
        page.send({"event": "pb 13"})
        self.assertIn("token of an instructor", page.answer(0))
        page.send({"do": "rate", "id": 6, "rate": 2})
        self.assertIn("token of an instructor", page.answer(6))
        page.close()

    def test_an_instructor_changes_the_clock(self):
        page = SocketOfPage(self.port, cookie=self.cookies[1])
        page.send({"do": "freeze", "id": 5})
        self.assertIsNone(page.answer(5))
        page.send({"do": "run", "id": 6})
        self.assertIsNone(page.answer(6))
        page.send({"do": "kill", "id": 7, "role": "init"})
        self.assertIn("a role of the set", page.answer(7))
        page.send({"do": "sea", "id": 8, "state": 3})
        self.assertIn("radar-model", page.answer(8))
        page.close()

    def test_hosts_are_addresses_in_numbers_and_the_names_that_were_given(self):
        for host, status in (("10.1.2.3", 200), ("radar.example", 200), ("evil.example", 400)):
            self.assertEqual(get(self.port, "/display.html", self.cookies[0], host=host)[0], status, host)

    def test_refusals_say_what_to_do(self):
        self.assertIn("--names NAME", get(self.port, "/display.html", host="evil.example")[2].decode())
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=20)
        connection.request("GET", "/display.html", headers={"Origin": "http://evil.example", "Cookie": self.cookies[1]})
        answer = connection.getresponse()
        self.assertEqual(answer.status, 403)
        self.assertIn("X-Forwarded-Host with --behind-proxy", answer.read().decode())
        connection.close()

    def test_only_sessions_of_the_station_are_shown(self):
        self.assertEqual(status_of(self.port, "/socket?session=other", self.cookies[1]), 404)
        self.assertEqual(status_of(self.port, "/other", self.cookies[1]), 404)
        self.assertFalse(any(path.name.endswith(".other") for path in pathlib.Path("/dev/shm").iterdir()),
                         "no session comes into being")


class Limits(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.station = Station(self.folder.name)
        self.port = self.station.port

    def tearDown(self):
        self.station.__exit__()
        self.folder.cleanup()

    def test_a_page_that_sends_too_much_is_closed_and_others_go_on(self):
        good, bad = SocketOfPage(self.port), SocketOfPage(self.port)
        try:
            for number in range(300):
                bad.send({"do": "run", "id": number})
        except OSError:
            pass  # closed while it sends
        answers = [text for text in self.until_closed(bad) if "answer" in text]
        self.assertLessEqual(len(answers), 200)
        good.send({"do": "run", "id": 9})
        self.assertIsNone(good.answer(9))
        good.close()
        bad.close()

    @staticmethod
    def until_closed(page):
        try:
            yield from page.texts()
        except ConnectionError:
            return

    def test_a_message_that_is_none_or_too_long_closes(self):
        for message in ({"x": 1}, {"event": "pb 99"}, {"note": "x" * 2000}):
            page = SocketOfPage(self.port)
            page.send(message)
            list(self.until_closed(page))  # ends when it is closed
            page.close()

    def test_a_command_that_is_none_is_answered(self):
        page = SocketOfPage(self.port)
        page.send({"do": "dance", "id": 3})
        self.assertIn("one of run", page.answer(3))
        page.close()

    def test_connections_that_wait_keep_nobody_out(self):
        waiting = [socket.create_connection(("127.0.0.1", self.port), timeout=20) for _ in range(200)]
        page = SocketOfPage(self.port)
        self.assertEqual((get(self.port, "/display.html")[0], page.status), (200, 101))
        page.send({"do": "run", "id": 9})
        self.assertIsNone(page.answer(9))
        for one in (page, *waiting):
            one.close()

    def test_what_is_no_request_is_answered(self):
        for request, status in ((b"no request\r\n\r\n", 400), (b"GET / HTTP/9.9\r\n\r\n", 400),
                                (b"\x16\x03\x01\r\n\r\n", 400),
                                (b"GET / HTTP/1.1\r\nX: " + b"x" * 20_000 + b"\r\n\r\n", 431),
                                (b"POST / HTTP/1.1\r\nContent-Length: 5\r\n\r\n12345", 413)):
            with socket.create_connection(("127.0.0.1", self.port), timeout=20) as asking:
                asking.sendall(request)
                self.assertEqual(asking.recv(100).split()[1:2], [str(status).encode()], request[:30])


class Places(unittest.TestCase):
    """Of pages: 48 for viewers, 32 of one address, 16 for instructors."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.station = Station(self.folder.name, "--with-tokens", "--behind-proxy")
        self.cookies = [f"yars_station_{self.station.port}_{right}={re.search(r'token=(.*)', address).group(1)}"
                        for right, address in zip(("viewer", "instructor"), self.station.addresses)]
        self.addCleanup(self.folder.cleanup)
        self.addCleanup(self.station.__exit__)

    def viewers(self, count, address):
        pages = [SocketOfPage(self.station.port, cookie=self.cookies[0] + f"\r\nX-Forwarded-For: {address}")
                 for _ in range(count)]
        for page in pages:
            self.addCleanup(page.close)
        return [page.status for page in pages]

    def test_viewers_keep_no_instructor_out(self):
        self.assertEqual(self.viewers(34, "10.0.0.1"), [101] * 32 + [503] * 2)
        self.assertEqual(self.viewers(18, "10.0.0.2"), [101] * 16 + [503] * 2)
        for _ in range(16):
            page = SocketOfPage(self.station.port, cookie=self.cookies[1])
            self.addCleanup(page.close)
            self.assertEqual(page.status, 101)
        self.assertEqual(status_of(self.station.port, "/socket?page=instructor", self.cookies[1]), 503)

    def test_a_place_is_free_when_its_page_has_gone(self):
        pages = [SocketOfPage(self.station.port, cookie=self.cookies[1]) for _ in range(16)]
        for page in pages:
            page.close()
        deadline = time.monotonic() + 20
        while status_of(self.station.port, "/socket?page=instructor", self.cookies[1]) != 101:
            self.assertLess(time.monotonic(), deadline, "expected room for a page after the others have gone")

    def test_a_proxy_says_where_its_visitors_are(self):
        with socket.create_connection(("127.0.0.1", self.station.port), timeout=20) as asking:
            asking.sendall((f"GET /display.html?token={self.cookies[0].partition('=')[2]} HTTP/1.1\r\nHost: inner:1\r\n"
                            "Connection: close\r\n"
                            "X-Forwarded-Host: localhost:9443\r\nX-Forwarded-Proto: https\r\n\r\n").encode())
            answer = asking.makefile("rb").read().decode()
        self.assertIn(" 303 ", answer.splitlines()[0])
        self.assertIn("; Secure", answer)


class End(unittest.TestCase):
    def test_a_station_ends_in_order_while_browsers_are_connected(self):
        with tempfile.TemporaryDirectory() as folder, Station(folder) as station:  # its end is looked at
            pages = [SocketOfPage(station.port, f"/socket?page={kind}")
                     for kind in ("display", "instructor", "display")]
            visit = socket.create_connection(("127.0.0.1", station.port), timeout=20)
            self.assertEqual([page.status for page in pages], [101] * 3)
            pages[1].send({"do": "freeze", "id": 1})
            self.assertIsNone(pages[1].answer(1))
        for connection in (*pages, visit):
            connection.close()


class World(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.station = Station(self.folder.name)
        self.addCleanup(self.station.__exit__)
        self.page = SocketOfPage(self.station.port)
        self.addCleanup(self.page.close)
        self.number = 0

    def radar_model(self):
        self.log = pathlib.Path(self.folder.name, "radar-model.log")
        with self.log.open("a") as log:
            model = subprocess.Popen([BIN / "radar-model", "--session", self.station.session], cwd=self.folder.name,
                                     stderr=log)
        self.addCleanup(model.wait)
        self.addCleanup(model.terminate)
        return model

    def ask(self, command):
        """Why it was not done; None if it was."""
        self.number += 1
        self.page.send({**command, "id": self.number})
        return self.page.answer(self.number)

    def await_done(self, command):
        """Asks until radar-model is there."""
        deadline = time.monotonic() + 60
        while (problem := self.ask(command)) is not None:
            self.assertIn("radar-model", problem)
            self.assertLess(time.monotonic(), deadline, problem)
            time.sleep(0.05)

    def test_radar_model_says_a_change_of_fidelity_once(self):
        model = self.radar_model()
        self.await_done({"do": "run"})
        for command in ({"do": "fidelity", "preset": "draft"}, {"do": "sea", "state": 2}, {"do": "sea", "state": 4},
                        {"do": "fidelity", "preset": "1996"}):
            self.await_done(command)
            # Until radar-model has latched it.
            next(text for text in self.page.texts() if text.get("instructor", {}).get("world", {}).get("tick"))
        model.terminate()
        model.wait()
        self.assertEqual(re.findall(r"info: fidelity (.*)", self.log.read_text()), ["draft", "1996"])

    def test_a_reset_that_could_not_be_undone_without_radar_model_is_undone_later(self):
        model = self.radar_model()
        self.await_done({"do": "run"})
        self.await_done({"do": "add", "list": "rain", "lat": 37, "lon": -122})
        self.await_done({"do": "reset world"})
        model.kill()
        model.wait()
        self.assertIn("a radar-model that runs", self.ask({"do": "undo reset"}))
        self.radar_model()
        self.await_done({"do": "undo reset"})
        state = next(text["instructor"] for text in self.page.texts() if text.get("instructor", {}).get("world"))
        self.assertEqual(len(state["world"]["rain"]), 1)
        self.assertIn("found none", self.ask({"do": "undo reset"}))


class Recorder(unittest.TestCase):
    """The recorder that a page starts."""

    def listed(self, page, what):
        """The sets beside this one, when they are as asked for."""
        deadline = time.monotonic() + 30
        for text in page.texts():
            if "sets" in text and what(text["sets"]):
                return text["sets"]
            self.assertLess(time.monotonic(), deadline, text)
        return self.fail("the page was closed")

    def test_one_that_fails_stays_in_the_list_with_its_reason(self):
        with tempfile.TemporaryDirectory() as folder:
            recordings = pathlib.Path(folder, "recordings")
            recordings.mkdir()
            with Station(folder) as station:
                # A recorder writes over no file: its names of the next minutes are taken.
                for second in range(300):
                    name = time.strftime("%Y%m%d-%H%M%S", time.gmtime(time.time() + second))
                    (recordings / f"{station.session}-{name}.yars").touch()
                page = SocketOfPage(station.port)
                for number in (1, 2):  # of two that fail the last one is listed
                    page.send({"do": "record", "id": number})
                    self.assertIsNone(page.answer(number))
                    failed = self.listed(page, lambda sets: sets and sets[0]["ended"])
                    self.assertEqual([one["kind"] for one in failed], ["recorder"])
                    self.assertIn("expected a new file to record into", failed[0]["ended"])
                page.send({"do": "end", "id": 3, "session": station.session})
                self.assertEqual(self.listed(page, lambda sets: not sets), [])
                page.close()

    def test_beside_one_that_runs_none_is_started(self):
        with tempfile.TemporaryDirectory() as folder, Station(folder) as station:
            page = SocketOfPage(station.port)
            other = subprocess.Popen([BIN / "yars", "--session", station.session, "record", "other.yars"], cwd=folder,
                                     stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            self.addCleanup(other.wait)
            self.addCleanup(other.terminate)
            next(text for text in page.texts() if ((text.get("instructor") or {}).get("status") or {}).get("recorder"))
            page.send({"do": "record", "id": 1})
            self.assertIn("expected none that runs", page.answer(1) or "")
            page.close()


class Scarcity(unittest.TestCase):
    """What there is too much of, and what there is none of."""

    def test_of_a_long_list_the_newest_recordings_are_named(self):
        with tempfile.TemporaryDirectory() as folder:
            recordings = pathlib.Path(folder, "recordings")
            recordings.mkdir()
            for number in range(13_000):
                (recordings / f"a recording with quite a long name, number {number:05}.yars").touch()
            with Station(folder, "--recordings", str(recordings)) as station:
                pages = [SocketOfPage(station.port) for _ in range(3)]
                for page in pages:
                    page.send({"do": "recordings", "id": 7})
                for page in pages:
                    answer = next(text for text in page.texts() if text.get("answer") == 7)
                    self.assertEqual((answer["problem"], answer["left_out"]), (None, 12_000))
                    page.close()
                self.assertEqual(get(station.port, "/display.html")[0], 200)

    def test_without_descriptors_connections_wait(self):
        with tempfile.TemporaryDirectory() as folder, Station(folder) as station:
            self.assertEqual(get(station.port, "/display.html")[0], 200)
            # Some are free for what the station opens in the meantime.
            used = len(os.listdir(f"/proc/{station.process.pid}/fd"))
            limits = resource.prlimit(station.process.pid, resource.RLIMIT_NOFILE)
            resource.prlimit(station.process.pid, resource.RLIMIT_NOFILE, (used + 4, limits[1]))
            waiting = [socket.create_connection(("127.0.0.1", station.port), timeout=20) for _ in range(16)]
            time.sleep(1.0)
            self.assertLessEqual(len(os.listdir(f"/proc/{station.process.pid}/fd")), used + 4)
            for one in waiting:
                one.close()
            resource.prlimit(station.process.pid, resource.RLIMIT_NOFILE, limits)
            self.assertEqual(get(station.port, "/display.html")[0], 200)
            station.process.terminate()
            said = station.process.communicate()[1]
        lines = [line for line in said.splitlines() if "could not be taken" in line]
        self.assertGreater(len(lines), 0, said)
        # One each 0.1 s at most, where a loop without a pause has thousands;
        # repeated lines are counted in the last one.
        self.assertLess(len(lines) + sum(int(count) for count in re.findall(r"and (\d+) more suppressed", said)), 200,
                        said)


@unittest.skipUnless(shutil.which("openssl"), "expected openssl, found none")
class Tls(unittest.TestCase):
    def test_pages_come_over_tls_with_the_given_certificate(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-keyout", "key.pem",
                            "-out", "certificate.pem", "-days", "2",
                            "-subj", "/CN=localhost", "-addext", "subjectAltName=DNS:localhost,IP:127.0.0.1"],
                           cwd=folder, check=True, capture_output=True)
            with Station(folder, "--certificate", "certificate.pem", "--key", "key.pem") as station:
                self.assertTrue(station.addresses[0].startswith("https://"))
                context = ssl.create_default_context(cafile=f"{folder}/certificate.pem")
                self.assertEqual(get(station.port, "/display.html", context=context)[0], 200)
                page = SocketOfPage(station.port, context=context)
                self.assertEqual(page.status, 101)
                page.send({"do": "run", "id": 2})
                self.assertIsNone(page.answer(2))
                page.close()
                with self.assertRaises((http.client.HTTPException, OSError)):
                    get(station.port, "/display.html")
            (pathlib.Path(folder) / "key.pem").write_text("no key")
            code, text = refusal("--certificate", f"{folder}/certificate.pem", "--key", f"{folder}/key.pem")
            self.assertEqual(code, 1, text)
            self.assertIn("private key", text)


if __name__ == "__main__":
    unittest.main()
