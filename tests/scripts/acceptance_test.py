#!/usr/bin/env python3
"""Holds every reader of files to rules that need no knowledge of the file, over any folder of files of other makers.

usage: acceptance_test.py BIN [FOLDER]
Scenes, terrain, archives, configurations, recordings and data-set specifications are found by their names; each other
file is given to the readers of single files. Nothing is written into FOLDER. The rules are the functions that begin
with `rule`. Without FOLDER: ../shared/data/acceptance with what its make.py writes, where the right values are known,
too (exit 77: not there). Prints the faults, and how much was read; ends with 1 if there is a fault.
"""
import dataclasses
import json
import math
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

SKIPPED = 77
TOP = pathlib.Path(__file__).resolve().parents[2]
LIMIT_S = 120  # a watchdog, not a bound of the time that a reader may take
MOST_CELLS = 64  # of a folder that is converted
LARGEST = 256 << 20  # [bytes] larger files of no known kind are not tried, but counted
POSITION = (45.5, 5.5)  # of scenes, on the built-in hills
RAW = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e]")
INNARDS = re.compile(
    r"Traceback|terminate called|what\(\)|Assertion|std::|runtime error:|Sanitizer|json\.exception|YARS_REQUIRE")
SCENES = {".flt"}
CONFIGURATIONS = {".guf"}
SPECIFICATIONS = {".yaml", ".yml"}
RECORDINGS = {".yars"}
TERRAIN = re.compile(r"\.(dt[0-2]|hgt|tiff?|jp2|img|ded|vrt)$|\.(hgt\.)?(zip|gz)$", re.IGNORECASE)

Done = dataclasses.make_dataclass("Done", ["words", "code", "out", "err"])


class Acceptance:
    """The readers of one build, and the faults that they show."""

    def __init__(self, bin_folder, scratch):
        self.bin = bin_folder
        self.scratch = pathlib.Path(scratch)
        self.faults = []
        self.counts = {}
        self.environment = {name: value for name, value in os.environ.items() if not name.startswith("YARS_")}
        self.environment.update(YARS_USER_CONFIG="", LC_ALL="C.UTF-8", PYTHONDONTWRITEBYTECODE="1")

    def fault(self, words, text):
        self.faults.append(f"{' '.join(map(repr, map(str, words)))}: {text}")

    def count(self, kind):
        self.counts[kind] = self.counts.get(kind, 0) + 1

    def run(self, *words, names=()):
        """Runs `yars` and holds it to the rules of every command. `names`: a failure's message has one of them."""
        try:
            done = subprocess.run([str(self.bin / "yars"), *map(str, words)], capture_output=True, timeout=LIMIT_S,
                                  stdin=subprocess.DEVNULL, env=self.environment, cwd=self.scratch)
        except subprocess.TimeoutExpired:
            self.fault(words, f"expected an end within {LIMIT_S} s, found none")
            return Done(words, None, "", "")
        found = Done(words, done.returncode, *(part.decode("utf-8", "replace") for part in (done.stdout, done.stderr)))
        self.rule_ends(found)
        self.rule_one_message(found, names)
        return found

    def rule_ends(self, done):
        if done.code not in (0, 1, 2):
            self.fault(done.words, f"expected exit code 0, 1 or 2, found {done.code}: {done.err[-300:]!r}")
        for text in (done.out, done.err):
            if raw := RAW.search(text):
                self.fault(done.words, "expected printable text, "
                                       f"found {raw[0]!r} in {text[max(0, raw.start() - 80):raw.end() + 20]!r}")
            if inside := INNARDS.search(text):
                self.fault(done.words, "expected a message for users, "
                                       f"found {text[max(0, inside.start() - 80):inside.end() + 200]!r}")

    def rule_one_message(self, done, names):
        """A failure says once, in its last line, what was expected and found; the message names the file."""
        lines = done.err.splitlines()
        if len(lines) != len(set(lines)):
            self.fault(done.words, f"expected each line once, found {done.err[-600:]!r}")
        if done.code in (None, 0):
            return
        if not lines or not re.search(r"expected .*found ", lines[-1]):
            self.fault(done.words, f"expected what was expected and found, found {done.err[-600:]!r}")
        if names and not any(printable(name) in done.err + done.out for name in names):
            self.fault(done.words, f"expected a message that names {names[-1]!r}, found {done.err[-600:]!r}")

    def facts(self, *words, names=()):
        """The JSON object of a command, and its run; the text form ends with the same code,
        and says what is left out."""
        found, done = self.run_json(*words, names=names)
        text = self.run(*words, names=names)
        if done.code != text.code:
            self.fault(words, f"expected one exit code, found {done.code} with --json and {text.code} without: "
                              f"{text.err[-300:]!r}")
        self.rule_says_what_is_left_out(done, text, found)
        return found, done

    def rule_says_what_is_left_out(self, done, text, found):
        parts = found.get("files", []) if isinstance(found, dict) else []
        for one in [found, *(part for part in parts if isinstance(part, dict))]:
            for sentence in [*one.get("left_out", []), *one.get("problems", [])]:
                if done.code == 0:
                    self.fault(done.words, f"expected an exit code other than 0, for {sentence!r}")
                if printable(sentence) not in text.out + text.err:
                    self.fault(text.words, f"expected {sentence!r} in the text, too")

    # Scenes

    def scene(self, path):
        self.count("scenes")
        found, info = self.facts("scene", "info", "--scene", path, names=[path.name])
        shown = found["files"][0] if found.get("files") else None
        at = f"{path}@{POSITION[0]},{POSITION[1]},0"
        self.rule_all_read_a_scene(path, at, info, shown)
        return shown

    def rule_all_read_a_scene(self, path, at, info, shown):
        """What `scene info` reads, a map reads, too, with as many triangles and the same parts left out;
        so does a scan."""
        reach_nm = reach_of(shown) / 1852 if shown else 0.0
        if reach_nm > 8.0:
            return self.count("scenes too large for a map")
        window_nm = max(0.7, 2.2 * reach_nm + 0.2)
        ahead_deg = max(4.0, window_nm) / 60 * 1.5
        pose = ["--lat", POSITION[0] - ahead_deg, "--lon", POSITION[1], "--heading", 90, "--alt-ft", 20000]
        patch, mapped = self.facts(*self.scene_words(path, at), "--force", *pose, "--target-lat", POSITION[0],
                                   "--target-lon", POSITION[1],
                                   "--window-nm", f"{window_nm:.3f}", "--size", 16, "--fidelity", "draft",
                                   names=[path.name])
        scan, scanned = self.facts("scan", "--scene", at, *pose, "--range-nm", math.ceil(ahead_deg * 60 + reach_nm + 1),
                                   "--samples", 16, "--fidelity", "draft", names=[path.name])
        if not info.code == mapped.code == scanned.code:
            self.fault([path], f"expected one exit code, found scene info {info.code}, patch {mapped.code}, "
                               f"scan {scanned.code}")
        if not shown:
            return
        left_out = sorted(f"{path}: {sentence}" for sentence in shown["left_out"])
        for name, facts in (("patch", patch), ("scan", scan)):
            if facts and sorted(facts["left_out"]) != left_out:
                self.fault([path],
                           f"expected what scene info leaves out, {left_out}, found {facts['left_out']} in {name}")
        if patch:
            self.rule_equal_triangles(path, shown["shown"]["triangles"], patch["triangles"])

    def scene_words(self, path, at):
        """A map with the scene, by a configuration if its path can stand there.
        Without ground, no triangle is cut to follow it."""
        if not quotable(path):
            return ["patch", "--scene", at]
        configuration = self.scratch / "scene.guf"
        configuration.write_text(
            f'( Apg70 )\n( Scenes `( ( Scene "{path}" {POSITION[0]} {POSITION[1]} 0 :elevation seaLevel ) ) )\n')
        return ["patch", "--config", configuration]

    def rule_equal_triangles(self, path, known, found):
        if known != found and (quotable(path) or found < known):
            self.fault([path], f"expected the {known} triangles of scene info, found {found} in patch")

    def rule_the_model_says_it_at_start(self, scenes):
        """radar-model logs what is left out of the scenes of its configuration before a map or a scan has read them."""
        usable = {path: shown for path, shown in scenes.items() if shown and quotable(path)}
        if not usable or not (self.bin / "radar-model").exists():
            return
        forms = "\n".join(f'( Scene "{path}" {-60 - i / 100} 170 0 )' for i, path in enumerate(usable))
        configuration = self.scratch / "scenes.guf"
        configuration.write_text(f"( Apg70 )\n( Scenes `( {forms} ) )\n")
        expected = {f"{path}: {sentence}" for path, shown in usable.items() for sentence in shown["left_out"]}
        log = self.scratch / "model.log"
        words = ["radar-model", "--session", f"acceptance-{os.getpid()}", "--config", configuration]
        with open(log, "wb") as written:
            model = subprocess.Popen([self.bin / "radar-model", *map(str, words[1:])], stdout=written, stderr=written,
                                     stdin=subprocess.DEVNULL, env=self.environment, cwd=self.scratch)
            try:
                deadline = time.monotonic() + LIMIT_S
                while time.monotonic() < deadline and model.poll() is None:
                    text = log.read_text(errors="replace")
                    if all(printable(sentence) in text for sentence in expected) and "runs in session" in text:
                        break
                    time.sleep(0.05)
            finally:
                model.send_signal(signal.SIGTERM)
                code = model.wait(LIMIT_S)
        text = log.read_text(errors="replace")
        self.rule_ends(Done(words, code, text, ""))
        for sentence in expected:
            if printable(sentence) not in text:
                self.fault(words, f"expected {sentence!r} in the log, found {text[-400:]!r}")
        self.count("models started")

    # Terrain

    def terrain(self, folder):
        """All commands over a folder. Returns the files that its cells are read from."""
        self.count("terrain folders")
        names = [folder.name, str(folder)]
        info, listed = self.facts("terrain", "info", "--terrain", folder, names=names)
        out = self.scratch / "converted"
        shutil.rmtree(out, ignore_errors=True)
        self.run("terrain", "image", "--terrain", folder, "--out", self.scratch / "map.png", "--width", 64, names=names)
        if not info.get("cells"):
            done = self.run("terrain", "profile", "--terrain", folder, "--from", 45, 5, "--to", 45, 5.001, names=names)
            if listed.code == 1 and done.code == 0:
                self.fault([folder], "expected a failure of profile, as of info")
            return set()
        self.rule_all_see_the_same_cells(folder, names, info, listed)
        used = {file for cell in info["cells"] for file in (cell["file"], *cell["others"])}
        if len(info["cells"]) > MOST_CELLS:
            self.count("terrain folders too large to convert")
            return used
        converted, done = self.run_json("terrain", "convert", "--in", folder, "--out", out, "--to", "dted",
                                        "--level", 0, names=names)
        if converted.get("cells") != len(info["cells"]) and done.code == 0:
            self.fault([folder], f"expected {len(info['cells'])} cells, found {converted} from convert with code 0")
        if (done.code == 0) != (listed.code == 0) and not has_empty_cell(info):
            self.fault([folder], f"expected the exit code of info, {listed.code}, found {done.code} from convert: "
                                 f"{done.err[-300:]!r}")
        return used

    def run_json(self, *words, names=()):
        done = self.run(*words, "--json", names=names)
        try:
            found = json.loads(done.out) if done.out else {}
        except json.JSONDecodeError as error:
            self.fault(words, f"expected JSON, found {error}")
            return {}, done
        if done.code == 0 and (found.get("problems") or found.get("left_out")):
            self.fault(done.words,
                       f"expected an exit code other than 0, for {found.get('problems')} {found.get('left_out')}")
        return found, done

    def rule_all_see_the_same_cells(self, folder, names, info, listed):
        """A profile finds each cell of info with heights between its lowest and highest; problems are those of info."""
        known = {bare(sentence) for sentence in info["problems"]}
        unused = set()
        for cell in info["cells"][:4]:
            south, west = cell["south_deg"], cell["west_deg"]
            across = ["--from", south + 0.5, west + 0.1, "--to", south + 0.5, west + 0.9, "--step", 5000]
            profile, done = self.run_json("terrain", "profile", "--terrain", folder, *across, names=names)
            if "none at" in done.err:
                self.fault(done.words, f"expected the cell that info lists, found {done.err[-300:]!r}")
            heights = [sample["elevation_m"] for sample in profile.get("samples", [])
                       if sample["elevation_m"] is not None]
            low, high = (cell["lowest_m"], cell["highest_m"]) if cell["lowest_m"] is not None else (0, 0)
            if any(not low - 1 <= height <= high + 1 for height in heights):
                self.fault(done.words,
                           f"expected heights from {low} to {high} m, found {min(heights)} to {max(heights)} m")
            if not heights and cell["voids"] == 0 and done.code != 2:
                self.fault(done.words, "expected heights in a cell without voids, found none")
            if cell["lowest_m"] is None and heights:
                self.fault(done.words, "expected no heights in a cell that is void, found some")
            scan, _ = self.run_json("scan", "--terrain", folder, "--lat", south + 0.5, "--lon", west + 0.5, "--alt-ft",
                                    40000, "--range-nm", 5, "--samples", 16, "--fidelity", "draft", names=names)
            for name, sentences in (("profile", profile.get("problems", [])), ("scan", scan.get("left_out", []))):
                for sentence in sentences:
                    unused.add(bare(sentence))
                    if bare(sentence) not in known:
                        self.fault([folder],
                                   f"expected the problems of info, {sorted(known)}, found {sentence!r} in {name}")
            if profile.get("problems") and listed.code == 0:
                self.fault([folder], f"expected exit code 1 of info, for {profile['problems']}")
        if listed.code != 0 and not info["problems"]:
            self.fault([folder], f"expected a problem for exit code {listed.code}")

    def raster(self, path):
        """A file that its folder does not read: it is refused, or converted to cells."""
        self.count("elevation files")
        out = self.scratch / "one"
        shutil.rmtree(out, ignore_errors=True)
        converted, done = self.run_json("terrain", "convert", "--in", path, "--out", out, "--level", 0,
                                        names=[path.name])
        if done.code == 0 and not converted.get("cells"):
            self.fault(done.words, f"expected cells, found {converted}")

    # Configurations, recordings and the rest

    def configuration(self, path):
        """A file that check takes is printed, and what is printed is taken and printed the same."""
        self.count("configurations")
        checked = self.run("config", "check", path, "--json", names=[path.name])
        printed = self.run("config", "print", path, names=[path.name])
        if printed.code == 0 and checked.code == 0:
            again = self.scratch / "again.guf"
            again.write_text(printed.out)
            twice = self.run("config", "print", again)
            if twice.out != printed.out:
                self.fault(twice.words,
                           f"expected the same configuration again, found another, or {twice.err[-300:]!r}")
        elif printed.code == 0 or checked.code == 0:
            if "Network" not in checked.err + printed.err:
                self.fault([path],
                           f"expected one answer of config check and print, found {checked.code} and {printed.code}")

    def recording(self, path):
        self.count("recordings")
        self.run("recordings", path, names=[path.name])
        self.run("replay", "--print", path, names=[path.name])
        self.run("replay", "--events", path, names=[path.name])

    def specification(self, path):
        self.count("data-set specifications")
        self.run("dataset", path, "--check", names=[path.name])

    def stranger(self, path):
        """A file of another kind: each reader of single files refuses it."""
        self.count("other files")
        for words in (["scene", "info", "--scene", path], ["config", "check", path], ["replay", "--print", path],
                      ["terrain", "convert", "--in", path, "--out", self.scratch / "other"]):
            self.run(*words, names=[path.name])

    def folder(self, top):
        """All files below a folder; links to folders are not followed."""
        grounds, rasters, scenes = {}, [], {}
        for where, folders, files in os.walk(top):
            folders.sort()
            for name in sorted(files):
                path = pathlib.Path(where, name)
                ending = path.suffix.lower()
                if ending in SCENES:
                    scenes[path] = self.scene(path)
                elif ending in CONFIGURATIONS:
                    self.configuration(path)
                elif ending in SPECIFICATIONS:
                    self.specification(path)
                elif ending in RECORDINGS:
                    self.recording(path)
                elif TERRAIN.search(name):
                    rasters.append(path)
                    ground = path.parent
                    grounds[ground.parent if re.fullmatch(r"[ew]\d{3}", ground.name.lower()) and ground != top
                            else ground] = True
                elif not path.is_file() or path.stat().st_size > LARGEST:
                    self.count("files not tried")
                elif not re.search(r"\.(py|md|txt|xml|csv|pdf|shp|shx|dbf)$", name.lower()):
                    self.stranger(path)
                else:
                    self.count("files not tried")
        used = set().union(*(self.terrain(ground) for ground in grounds))
        for path in rasters:
            if str(path) not in used:
                self.raster(path)
        self.rule_the_model_says_it_at_start(scenes)
        return scenes


def printable(text):
    """The form in which programs print a text from outside: control characters are escaped."""
    return RAW.sub(lambda found: "".join(f"\\x{byte:02x}" for byte in found[0].encode()),
                   str(text).encode("utf-8", "replace").decode())


def bare(sentence):
    """A sentence about an elevation file without what becomes of its cell."""
    return re.sub(r"; the cell (counts as void|has no materials).*$", "", sentence)


def has_empty_cell(info):
    return any(cell["lowest_m"] is None for cell in info["cells"])


def quotable(path):
    return re.fullmatch(r"[A-Za-z0-9_./<>+-]+", str(path)) is not None


def reach_of(shown):
    """[m] from the origin of a scene to its farthest corner."""
    extent = shown.get("extent_m")
    if not extent:
        return 0.0
    return math.hypot(max(abs(extent["west"]), abs(extent["east"])), max(abs(extent["south"]), abs(extent["north"])))


# Right values for ../shared/data/acceptance: triangles and polygons are those of the makers of the files, heights those
# of the formulas in make.py.
SHOWN = {"header328.flt": ("triangles", 10), "r1660.flt": ("triangles", 10), "zeros_to_2048.flt": ("triangles", 10),
         "cdb_harbor_club_header328.flt": ("triangles", 556), "cdb_trailing_byte.flt": ("polygons", 224),
         "nested/master/master.flt": ("polygons", 3), "node.flt": ("polygons", 5), "lodtown.flt": ("objects", 6),
         "dof.flt": ("polygons", 5)}


def check_known_scenes(acceptance, top, scenes):
    for name, (field, value) in SHOWN.items():
        shown = scenes.get(top / name)
        found = shown and shown["shown"][field]
        if found != value or shown["left_out"]:
            acceptance.fault([name], f"expected {value} {field} and nothing left out, found {shown and shown['shown']}")
    # The degree of freedom moves the part by 50 m.
    if (shown := scenes.get(top / "dof.flt")) and round(shown["extent_m"]["west"]) != 45:
        acceptance.fault(["dof.flt"], f"expected a part from 45 m east, found {shown['extent_m']}")
    network = acceptance.run("config", "check", top / "network_in_config.guf")
    if network.code != 0:
        acceptance.fault(network.words, f"expected a configuration with a network, found {network.err!r}")


def elevation_m(acceptance, folder, latitude, longitude):
    words = ["terrain", "profile", "--terrain", folder, "--from", latitude, longitude, "--to", latitude, longitude]
    found, done = acceptance.run_json(*words)
    if done.code != 0:
        acceptance.fault(done.words, f"expected exit code 0, found {done.code}: {done.err!r}")
    return found["samples"][0]["elevation_m"] if found.get("samples") else None


def check_known_terrain(acceptance, out):
    cells = {"names": [(31, 35), (31, 36), (31, 37)], "hgt1801": [(52, 5)], "quads": [(45, 5)]}
    for name, expected in cells.items():
        info, _ = acceptance.run_json("terrain", "info", "--terrain", out / name)
        found = [(cell["south_deg"], cell["west_deg"]) for cell in info.get("cells", [])]
        if found != expected or info["problems"]:
            acceptance.fault([name], f"expected the cells {expected}, found {found}, {info.get('problems')}")
    info, _ = acceptance.run_json("terrain", "info", "--terrain", out / "quads")
    if info["total"]["voids"] != 0:
        acceptance.fault(["quads"], f"expected no void posts, found {info['total']}")
    info, done = acceptance.run_json("terrain", "info", "--terrain", out / "bathymetry")
    if done.code != 0 or not any("floor of the sea" in note for note in info.get("notes", [])):
        acceptance.fault(done.words, f"expected a note about the floor of the sea, found {info.get('notes')}")
    height = elevation_m(acceptance, out / "copernicus", 46.0, 5.5)
    if height is None or abs(height - 275.0) > 0.05:
        acceptance.fault(["copernicus"], f"expected 275.0 m at 46.0, 5.5, found {height}")
    elevation_m(acceptance, out / "nad83", 45.5, -121.5)


def make_terrain(top, scratch):
    """Runs a copy of make.py. Returns the folder that it writes, or None and the reason."""
    python = "/usr/bin/python3"
    if subprocess.run([python, "-c", "import numpy; from osgeo import gdal"], capture_output=True,
                      check=False).returncode:
        return None, "needs Debian's python3-numpy and python3-gdal for the terrain"
    copy = pathlib.Path(scratch, "made")
    copy.mkdir()
    shutil.copy(top / "make.py", copy)
    shutil.copytree(top / "tools", copy / "tools")
    made = subprocess.run([python, "make.py"], cwd=copy, capture_output=True, text=True, check=False, timeout=600)
    if made.returncode or not (copy / "out").is_dir():
        return None, f"make.py failed: {made.stderr[-300:]}"
    return copy / "out", ""


def main():
    folder = pathlib.Path(sys.argv[2]).resolve() if len(sys.argv) > 2 else None
    known = TOP.parent / "shared/data/acceptance"
    if folder is None and not known.is_dir():
        print("acceptance_test: needs ../shared/data/acceptance, which is absent here")
        return SKIPPED
    with tempfile.TemporaryDirectory() as scratch:
        work = pathlib.Path(scratch, "work")
        work.mkdir()
        acceptance = Acceptance(pathlib.Path(sys.argv[1]).resolve(), work)
        if folder is not None:
            acceptance.folder(folder)
        else:
            check_known_scenes(acceptance, known, acceptance.folder(known))
            out, reason = make_terrain(known, scratch)
            if out is None:
                print(f"acceptance_test: terrain left out: {reason}")
            else:
                acceptance.folder(out)
                check_known_terrain(acceptance, out)
    for fault in acceptance.faults:
        print(fault)
    print(f"{len(acceptance.faults)} faults; " +
          ", ".join(f"{number} {kind}" for kind, number in sorted(acceptance.counts.items())))
    return 1 if acceptance.faults else 0


if __name__ == "__main__":
    sys.exit(main())
