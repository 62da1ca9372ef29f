#!/usr/bin/env python3
"""Facts about calls of the compiled part of the package yars:
threads, fork(), signals, memory, objects without __init__.

usage: calls_test.py BUILD     BUILD: a build folder with bin/yars and python/yars.
    Skipped (code 77) where it has no compiled part.
"""
import copy
import os
import pathlib
import pickle
import subprocess
import threading
import unittest

from core_helpers import PATCH, SCAN, Folder, np, order_of, orders_of, program, yars


class Threads(Folder):
    def test_others_run_while_a_picture_is_computed(self):
        radar, terrain = yars.Radar("reference", samples=200), yars.Terrain()
        count, done = 0, threading.Event()

        def compute():
            radar.scan(terrain, **SCAN)
            done.set()

        thread = threading.Thread(target=compute)
        thread.start()
        while not done.is_set():
            count += 1
            os.sched_yield()
        thread.join()
        # With the lock held, this loop counts at most to its first switch and after the scan.
        self.assertGreater(count, 50)

    def test_two_threads_on_one_terrain(self):
        terrain = yars.Terrain()
        radar = yars.Radar("draft", map_size=64)
        hashes = []

        def compute():
            for _ in range(5):
                hashes.append((radar.scan(terrain, **SCAN).hash, radar.patch(terrain, **PATCH).hash))

        threads = [threading.Thread(target=compute) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual((len(hashes), len(set(hashes))), (15, 1))

    def test_a_kept_scan_keeps_no_threads(self):
        before = len(os.listdir("/proc/self/task"))
        kept = [yars.Radar("draft").scan(yars.Terrain(), **SCAN, threads=4) for _ in range(3)]
        self.assertEqual(len(os.listdir("/proc/self/task")), before)
        self.assertEqual(len({scan.hash for scan in kept}), 1)

    def test_a_child_of_fork_computes(self):
        said = program("import os, numpy as np, yars\n"
                       "radar, terrain = yars.Radar('draft', map_size=32), yars.Terrain()\n"
                       "orders = np.zeros(2, yars.PATCH_ORDER)\n"
                       f"for name, value in {order_of(PATCH)!r}.items(): orders[name] = value\n"
                       "first = radar.patches(terrain, orders, threads=3)['hash']\n"
                       "read, write = os.pipe()\n"
                       "child = os.fork()\n"
                       "if child == 0:\n"
                       "    os.write(write, radar.patches(terrain, orders, threads=3)['hash'].tobytes())\n"
                       "    raise SystemExit\n"
                       "_, status = os.waitpid(child, 0)\nprint(status, os.read(read, 16) == first.tobytes())")
        self.assertEqual(said, ("0 True\n", "", 0))

    def test_fork_while_another_thread_is_in_a_call(self):
        folder = yars.Terrain.generate(self.folder / "land", south=37, west=-123, cells_lat=1, cells_lon=1, level=0,
                                       edge="cut")
        said = program(f"""
import os, signal, threading, time, numpy, yars
terrain, stop = yars.Terrain({folder!r}), []
wanted = float(terrain.elevation(37.5, -122.5))
def call():
    while not stop:
        terrain.elevation(37.1 + 0.8 * numpy.random.rand(300000), -122.5)
        yars.Radar("draft").scan(terrain, latitude_deg=37.5, longitude_deg=-122.5).shadow
thread = threading.Thread(target=call)
thread.start()
codes = []
for turn in range(8):
    time.sleep(0.013 * (turn % 5))
    child = os.fork()
    if child == 0:
        signal.alarm(20)
        scan = yars.Radar("draft").scan(terrain, latitude_deg=37.5, longitude_deg=-122.5)
        same = terrain.elevation(37.5, -122.5) == wanted and scan.shadow.any() in (True, False)
        os._exit(0 if same else 3)
    codes.append(os.waitpid(child, 0)[1])
stop.append(1)
thread.join()
print(codes)
""", timeout=280)
        self.assertEqual(said, (f"{[0] * 8}\n", "", 0))


class End(Folder):
    def test_python_ends_while_daemon_threads_compute(self):
        for preset in ("draft", "reference") * (4 if "YARS_TEST_FULL" in os.environ else 2):
            said = program("import threading, time, yars\n"
                           f"radar, terrain = yars.Radar({preset!r}, samples=200), yars.Terrain()\n"
                           "begun = threading.Semaphore(0)\n"
                           f"def compute():\n    begun.release()\n    while True: radar.scan(terrain, **{SCAN!r})\n"
                           "for _ in range(3): threading.Thread(target=compute, daemon=True).start()\n"
                           "for _ in range(3): begun.acquire()\ntime.sleep(0.1)\nprint('ends')")
            self.assertEqual(said, ("ends\n", "", 0))

    def test_what_atexit_calls_can_compute(self):
        said = program("import atexit\natexit.register(lambda: print(radar.scan(terrain, **scan).hash > 0))\n"
                       f"import yars\nradar, terrain, scan = yars.Radar('draft'), yars.Terrain(), {SCAN!r}")
        self.assertEqual(said[1:], ("", 0))
        self.assertIn("True", said[0])


class Locales(Folder):
    """A locale with a decimal comma, made here: a bare system has none."""

    def test_numbers_have_points(self):
        ascii_codes = "\n".join(f"<U{code:04X}> /x{code:02x} C{code}" for code in range(128))
        (self.folder / "ascii").write_text("<code_set_name> ANSI_X3.4-1968\n<comment_char> %\n<escape_char> /\n"
                                           f"CHARMAP\n{ascii_codes}\nEND CHARMAP\n")
        (self.folder / "source").write_text('LC_NUMERIC\ndecimal_point ","\nthousands_sep ""\ngrouping -1\n'
                                            'END LC_NUMERIC\n')
        subprocess.run(["localedef", "-c", "-f", self.folder / "ascii", "-i", self.folder / "source",
                        self.folder / "comma"],
                       capture_output=True, check=False)  # it warns of categories that are not there, with code 1
        before = "import locale; locale.setlocale(locale.LC_NUMERIC, 'comma'); assert locale.str(0.5) == '0,5'\n"
        text = (f"import yars\nterrain = yars.Terrain()\nradar = yars.Radar('draft', core_share=0.25)\n"
                f"print(radar.scan(terrain, **{SCAN!r}).hash, radar.patch(terrain, **{PATCH!r}).hash)\n"
                f"try: radar.scan(terrain, **{dict(SCAN, range_nm=3.5)!r})\nexcept ValueError as fault: print(fault)")
        os.environ["LOCPATH"] = str(self.folder)
        self.addCleanup(os.environ.pop, "LOCPATH")
        self.assertEqual(program(before + text), program(text))


class Signals(Folder):
    """Ctrl-C while a call computes."""

    CALLS = {
        "scan": "yars.Radar('reference', samples=2048).scan(terrain, altitude_ft=30000, range_nm=100)",
        "shadow": "scan.shadow",
        "patch": "yars.Radar('reference', map_size=512).patch(terrain, looks=16, force=True)",
        "patches": "yars.Radar('draft', map_size=64).patches(terrain, numpy.repeat(order, 10 ** 6), arrays=())",
        "trade": "yars.trade(terrain, repeat=500)",
        "trade maps": "yars.trade(terrain, maps=True, repeat=500)",
        "elevation": "terrain.elevation(numpy.full(2 * 10 ** 7, 37.5), -122.5)",
        "generate": "yars.Terrain.generate(folder + '/land', level=2, cells_lat=2, cells_lon=2)",
    }

    def test_ends_every_call(self):
        for name, call in self.CALLS.items():
            with self.subTest(name):
                said = program(f"""
import os, signal, threading, time, numpy, yars
folder, terrain = {str(self.folder)!r}, yars.Terrain()
order = numpy.zeros(1, yars.PATCH_ORDER)
for field, value in {order_of(PATCH)!r}.items(): order[field] = value
if {name!r} == 'shadow':
    scan = yars.Radar('reference', samples=2048).scan(terrain, altitude_ft=30000, range_nm=100, width_deg=40)
try:
    threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT)).start()
    {call}
    print('whole')
except KeyboardInterrupt:
    print('stopped')
print(terrain.elevation(37.5, -122.5) == yars.Terrain().elevation(37.5, -122.5), len(os.listdir('/proc/self/task')))
""", timeout=120)
                self.assertEqual(said[1:], ("", 0))
                self.assertIn(said[0], ("stopped\nTrue 1\n",) + (("whole\nTrue 1\n",) if name == "shadow" else ()))

    def test_a_handler_may_call_and_return(self):
        said = program("""
import os, signal, threading, yars
terrain, heights = yars.Terrain(), []
signal.signal(signal.SIGINT, lambda *_: heights.append(float(terrain.elevation(37.5, -122.5))))
threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
first = yars.Radar('reference', samples=200).scan(terrain, altitude_ft=30000, range_nm=100, seed=1).hash
second = yars.Radar('reference', samples=200).scan(terrain, altitude_ft=30000, range_nm=100, seed=1).hash
print(len(heights) <= 1, first == second)
""")
        self.assertEqual(said, ("True True\n", "", 0))


class Whole(Folder):
    """No object is without what it holds."""

    def test_objects_without_init(self):
        for kind in (yars.Terrain, yars.Scene, yars.Recording, yars.Radar, yars.Scan, yars.Patch):
            one = kind.__new__(kind)
            arguments = {"elevation": (1, 2), "records": ("ModelTick",), "scan": (yars.Terrain(),),
                         "patch": (yars.Terrain(),), "patches": (yars.Terrain(), np.zeros(0, yars.PATCH_ORDER))}
            with self.assertRaisesRegex(TypeError, f"yars.{kind.__name__}: expected"):
                repr(one)
            for name in dir(kind):
                if name.startswith("_") or name in ("generate", "units", "axes"):
                    continue
                with self.assertRaisesRegex(TypeError, f"yars.{kind.__name__}: expected", msg=name):
                    member = getattr(one, name)
                    member(*arguments.get(name, ()))
            with self.assertRaises(TypeError):
                pickle.dumps(one)
        for call in (lambda: yars.Radar().scan(yars.Terrain.__new__(yars.Terrain)),
                     lambda: yars.Radar().scan(yars.Terrain(), yars.Scene.__new__(yars.Scene)),
                     lambda: yars.trade(yars.Terrain.__new__(yars.Terrain)),
                     lambda: yars.Scene("a.flt", yars.Terrain.__new__(yars.Terrain))):
            self.refused(TypeError, "whose __init__ has run", call)

    def test_classes_of_the_compiled_part(self):
        for name in ("Terrain", "Scene", "Recording", "Radar", "ScanResult", "PatchResult"):
            kind = getattr(yars._core, name)
            for call in (kind, lambda: kind.__new__(kind), lambda: object.__new__(kind), type("Sub", (kind,), {})):
                with self.assertRaises(TypeError):
                    call()

    def test_a_subclass_whose_init_fails_or_has_more(self):
        class Failing(yars.Terrain):
            def __init__(self):
                try:
                    super().__init__("/absent")
                except yars.Error:
                    repr(self)

        self.refused(TypeError, "yars.Terrain: expected an object whose __init__ has run, found one of Failing",
                     Failing)
        named = Named("hills")
        again = pickle.loads(pickle.dumps(named))
        self.assertEqual((type(again), again.name, again.directory), (Named, "hills", ""))
        self.assertEqual(copy.deepcopy(named).name, "hills")

    def test_arrays_of_results_cannot_be_written(self):
        scan = yars.Radar("draft").scan(yars.Terrain(), **SCAN)
        patch = yars.Radar("draft", map_size=32).patch(yars.Terrain(), **PATCH)
        for result in (scan, patch):
            for name in (*yars.results.ARRAYS, *(name for name in result.axes if name != "sample")):
                array = getattr(result, name)
                with self.assertRaises(ValueError, msg=name):
                    array[...] = 1
                with self.assertRaises(ValueError, msg=name):
                    array.flags.writeable = True
                array.copy()[...] = 1


class Named(yars.Terrain):
    def __init__(self, name):
        super().__init__()
        self.name = name


class Memory(unittest.TestCase):
    def test_hundreds_of_calls(self):
        def resident_kb():
            return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * 4

        terrain, radar = yars.Terrain(), yars.Radar("draft", map_size=32, samples=30)
        orders = orders_of(PATCH)
        small = {**SCAN, "width_deg": 5}

        def calls(count):
            for _ in range(count):
                radar.scan(terrain, **small).latitude
                radar.patches(terrain, orders)
                terrain.elevation([37.0, 37.5], -122.5)
                try:
                    radar.scan(terrain, latitude_deg=91)
                except ValueError:
                    pass

        calls(100)
        before = resident_kb()
        calls(300)
        self.assertLess(resident_kb() - before, 360)


if __name__ == "__main__":
    unittest.main()
