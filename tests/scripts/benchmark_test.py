"""Facts about lab/benchmark, with a program that only prints what `yars` would: arguments, JSON, pairs, bad input.
No time is asserted."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

BENCHMARK = pathlib.Path(__file__).resolve().parents[2] / "lab" / "benchmark"
# A scan takes 2 ms, with a configuration 5 ms; times the factor of the build.
YARS = """#!{python}
import json, pathlib, sys
words = sys.argv[1:]
with open("{log}", "a") as log:
    print("{name}", *words, file=log)
if "generate" in words:
    out = pathlib.Path(words[words.index("--out") + 1])
    out.mkdir(exist_ok=True) if "terrain" in words else out.touch()
elif "patch" in words:
    print("blind", file=sys.stderr)
    print(json.dumps({{"kernel_ms": 4.0, "cpu_ms": 3.0, "stages_ms": {{"map": 1.0}}, "size": 480}}))
else:
    threads = int(words[words.index("--threads") + 1]) if "--threads" in words else 1
    ms = {factor} * (5.0 if "--config" in words else 2.0)
    ms /= threads
    found = {{"kernel_ms": ms, "cpu_ms": ms, "sweep_ms": ms, "first_ms": 9.0, "sweeps": 182, "samples": 480,
              "hash": "{hash}", "mean_ms": ms}}
    {change}
    print(json.dumps(found))
"""


class Benchmark(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.log = self.folder / "log"
        self.bin = self.build("one")

    def build(self, name, factor=1.0, hash_="abc", change="pass"):
        (self.folder / name).mkdir()
        program = self.folder / name / "yars"
        program.write_text(YARS.format(python=sys.executable, log=self.log, name=name, factor=factor, hash=hash_,
                                       change=change))
        program.chmod(0o755)
        return program.parent

    def run_it(self, *words, code=0):
        done = subprocess.run([sys.executable, str(BENCHMARK), "--bin", str(self.bin),
                               "--data", str(self.folder / "world"), *map(str, words)],
                              capture_output=True, text=True, timeout=300, check=False, stdin=subprocess.DEVNULL)
        self.assertEqual(done.returncode, code, done)
        return done

    def rows(self, *words):
        out = self.folder / "out.json"
        self.run_it("--quick", "--out", out, *words)
        return {row["name"]: row for row in json.loads(out.read_text())["rows"]}

    def refusal(self, *words, code=1, parts=()):
        done = self.run_it(*words, code=code)
        self.assertEqual(done.stderr.count("\n"), 1, done)
        for part in ("benchmark: ", "expected ", "found", *parts):
            self.assertIn(part, done.stderr)

    def test_a_cliff_is_a_ratio_to_a_plain_scan_of_the_same_run(self):
        row = self.rows("--only", "showers")["showers"]
        self.assertEqual((row["ms"], row["ratio"], row["of"], row["clock"]), (5.0, 2.5, "standard-40", "cpu_ms"))
        self.assertEqual(row["samples_per_second"], 182 * 480 / 5e-3)

    def test_all_rows_have_a_figure_and_plain_scans_their_posts(self):
        rows = self.rows()
        self.assertEqual(len(rows), 20 + 8 + 6 + 1 + 6)
        for row in rows.values():
            self.assertTrue({"ms", "of_one"} & row.keys(), row)
        # 40 NM on the bearings 10 to 110 degrees cross up to 800 rows and 1,000 columns, 1,000 together in the mean.
        self.assertAlmostEqual(rows["scan-40"]["posts_per_second"] * 2e-3 / 182, 1100, delta=150)
        self.assertEqual(rows["threads-40-busy"]["of_one"], 2.0)
        self.assertGreater(rows["loading"]["peak_mb"], 1)
        self.assertEqual(rows["map-480"]["stages_ms"], {"map": 1.0})

    def test_the_world_is_made_once_and_an_interrupted_part_again(self):
        (self.folder / "world").mkdir()
        (self.folder / "world" / "part.culture").mkdir()  # of an interrupted run
        self.run_it("--only", "scan-10", "--quick")
        made = self.log.read_text().count("generate")
        self.assertEqual((made, sorted(path.name for path in (self.folder / "world").glob("part.*"))), (4, []))
        self.run_it("--only", "scan-10", "--quick")
        self.assertEqual(self.log.read_text().count("generate"), made)

    def test_two_builds_alternate_and_hashes_are_compared(self):
        other = self.build("two", factor=2.0, hash_="abd")
        row = self.rows("--only", "scan-10", "--against", other)["scan-10"]
        self.assertEqual(row["against"]["ratio_to"], 0.5)
        self.assertFalse(row["against"]["same_hash"])
        # The first warms up.
        runs = [line.split()[0] for line in self.log.read_text().splitlines() if "--repeat" in line][1:]
        self.assertEqual(runs, ["one", "two", "two", "one", "one", "two"])

    def test_a_build_without_processor_time_is_compared_by_wall_time(self):
        old = self.build("old", change='del found["cpu_ms"]')
        row = self.rows("--only", "scan-10", "--against", old)["scan-10"]
        self.assertEqual((row["clock"], row["against"]["clock"]), ("kernel_ms", "kernel_ms"))

    def test_files_are_compared(self):
        one, two = self.folder / "a.json", self.folder / "b.json"
        self.run_it("--quick", "--only", "showers", "--out", one)
        self.bin = self.build("slow", factor=2.0)
        self.run_it("--quick", "--only", "showers", "--out", two)
        text = self.run_it("--compare", one, two).stdout
        self.assertRegex(text, r"showers +5\.000 +10\.000 +2\.000\n")
        self.assertRegex(text, r"  ratio +2\.500 +2\.500 +1\.000\n")

    def test_bad_input_is_one_line(self):
        other = self.folder / "other.json"
        other.write_text('{"format": 0}')
        self.refusal("--compare", other, self.folder / "absent.json", parts=["other.json", "format 1"])
        self.refusal("--compare", self.folder / "absent.json", other, parts=["absent.json", "No such file"])
        empty = self.folder / "empty.json"
        empty.write_text('{"format": 1, "rows": []}')
        self.refusal("--compare", empty, empty, parts=["rows"])
        self.refusal("--only", "shower-of", code=2, parts=["--only", "showers", "'shower-of'"])
        self.refusal("--rounds", "0", code=2, parts=["--rounds"])
        self.refusal("--against", self.folder, parts=[str(self.folder), "yars"])
        self.refusal("--only", "stages", parts=["YARS_BENCHMARKS"])
        self.bin = self.build("broken", change='sys.exit("no such cell")')
        self.refusal("--only", "scan-10", "--quick", parts=["no such cell"])

    def test_it_works_where_nobody_looks(self):
        done = self.run_it("--quick", "--only", "scan-10")
        self.assertEqual(done.stderr, "")  # progress is for terminals
        help_ = subprocess.run([sys.executable, str(BENCHMARK), "--help"], capture_output=True, text=True, check=True)
        self.assertIn("--against", help_.stdout)


if __name__ == "__main__":
    os.environ.pop("YARS_USER_CONFIG", None)
    unittest.main()
