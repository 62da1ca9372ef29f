"""Chooses terrain, flight and configuration of a set: the user's, a recording's, or the default coast's."""
import os
import pathlib
import shutil
import subprocess

from starting.build import one_at_a_time
from starting.command import INSTALLED, SHARE, end, put, put_as_own, quoted, refuse, run, user_folder
from starting.options import session

SCENES = SHARE / "config/coast.scenes"
GENERATOR_SOURCES = ("worldgen", "lib/random", "model/terrain/formats", "tools/terrain/generate_command.cpp",
                     "tools/scene/scene_command.cpp", "config/coast.scenes")
SUM_OF_SOURCES = (r"""find "$@" \( -name '*.[ch]pp' -o -name '*.scenes' \) -print0 | LC_ALL=C sort -z | xargs -0 cat """
                  "| sha256sum")
# Prints the checksum of each file of the coast. Its file `complete` has the generator's checksum, then these.
SUMS = "find . -type f ! -name complete -print0 | LC_ALL=C sort -z | xargs -0r sha256sum"


def take(options, lines, names):
    """Sets options from lines NAME = VALUE, unless the command line has set them. Returns all values of the lines."""
    said = dict(line.split(" = ", 1) for line in lines.splitlines() if " = " in line)
    for name in names:
        setattr(options, name, getattr(options, name) or said.get(name))
    return said


def use_user_defaults(options):
    """Takes options from the user's file of defaults. The programs of the set then do not read that file."""
    done = run(f"{options.bin}/yars", "config", "user", stdout=subprocess.PIPE)
    if done.returncode != 0:
        raise SystemExit(1)
    said = take(options, done.stdout, ("session", "size", *(() if options.tour else ("config", "terrain"))))
    options.log_dir = said.get("log-dir") if options.log_dir is None else options.log_dir
    options.log_level = said.get("log-level")
    options.session = session("--session", options.session or "default")
    os.environ["YARS_USER_CONFIG"] = ""


def use_recording(options):
    """Takes configuration, terrain and source of the flight from the recording of --fly-out."""
    source = options.source
    done = run(f"{options.bin}/yars", "recordings", options.fly_out, "--at", options.at, "--lines",
               stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        put_as_own(done.stdout)
        raise SystemExit(done.returncode)
    for line in done.stdout.splitlines():
        if line.startswith("yars"):
            put_as_own(line)
    said = take(options, done.stdout, ("config", "terrain", "source"))
    if options.terrain and not os.path.isdir(options.terrain):
        found = f"found no folder {quoted(options.terrain)}"
        refuse(f"--fly-out: expected the recording's terrain, or --terrain DIR, {found}")
    if said.get("reason") and not source and "flight-model" in options.running:
        put(1, f"The aircraft flies on straight and level: {said['reason']}; --source SOURCE chooses another flight")


def shell(script, *words, folder=None):
    return run("bash", "-o", "pipefail", "-c", script, "bash", *words, capture_output=True, cwd=folder)


def generator_of(options):
    """Checksum of the coast's generator, with the list of scenes: of the program yars, in a checkout of its sources."""
    if INSTALLED:
        return shell('cat "$@" | sha256sum', f"{options.bin}/yars", SCENES).stdout
    done = shell(SUM_OF_SOURCES, *GENERATOR_SOURCES)
    return done.stdout if done.returncode == 0 else end(
        1, f"expected the sources of the default terrain in {' '.join(GENERATOR_SOURCES)}")


def make_coast(folder, generator, yars, lock):
    """Makes the coast under a temporary name, then renames it. Removes unfinished folders: the caller has the lock."""
    def make(*words, **more):
        done = run(yars, *words, stdout=subprocess.PIPE, pass_fds=[lock], **more)
        if done.returncode != 0:
            put(2, done.stdout.rstrip("\n"))
            end(1, "terrain generation failed")
        return done.stdout.rstrip("\n")

    for left in folder.parent.glob(f"{folder.name}.making.*"):
        shutil.rmtree(left)
    making = folder.with_name(f"{folder.name}.making.{os.getpid()}")
    try:
        put(1, make("terrain", "generate", "--out", making, "--airfields", "soil").replace(str(making), str(folder)))
        (making / "scenes").mkdir(parents=True, exist_ok=True)
        for line in SCENES.read_text().splitlines():
            if not line or line.startswith("#"):
                continue
            file, kind, triangles, origin = line.split()
            make("scene", "generate", "--kind", kind, "--triangles", triangles, "--origin", origin, "--out",
                 making / "scenes" / file, stderr=subprocess.STDOUT)
        (making / "complete").write_text(generator + shell(SUMS, folder=making).stdout)
        shutil.rmtree(folder, ignore_errors=True)
        making.rename(folder)
    finally:
        shutil.rmtree(making, ignore_errors=True)


def use_coast(options):
    """Uses the default coast. Makes it if its generator has changed, or a file is missing or damaged."""
    folder = pathlib.Path("build/terrain/default")
    if INSTALLED:
        cache = user_folder("XDG_CACHE_HOME", ".cache")
        if not cache:
            end(1, "expected HOME or XDG_CACHE_HOME for the terrain it makes, found neither; give --terrain DIR")
        folder = pathlib.Path(cache, "yars/terrain")
    generator = generator_of(options)
    folder.parent.mkdir(parents=True, exist_ok=True)
    with one_at_a_time("terrain", f"{folder}.lock") as lock:
        complete = folder / "complete"
        said = complete.read_text(errors="replace") if complete.is_file() else ""
        if not said.startswith(generator) or said != generator + shell(SUMS, folder=folder).stdout:
            make_coast(folder, generator, f"{options.bin}/yars", lock)
    options.terrain = str(folder)
    options.source = options.source or f"route:{SHARE}/config/routes/default.route"
    options.config = options.config or f"{SHARE}/config/default.guf"


def choose_world(options):
    use_user_defaults(options)
    if options.fly_out:
        use_recording(options)
        return
    if not options.terrain:
        use_coast(options)
    options.source = options.source or f"route:{SHARE}/config/routes/california.route"
    options.config = options.config or f"{SHARE}/config/apg70.guf"
