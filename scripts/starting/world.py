"""Where the set flies: defaults of the user's file, of a recording, and of the coast that is made once."""
import contextlib
import hashlib
import os
import pathlib
import shutil
import subprocess

from starting.build import one_at_a_time
from starting.command import HOME, INSTALLED, NAME, SHARE, as_own, end, put, quoted, refuse, run
from starting.options import session

SCENES = SHARE / "config/coast.scenes"
GENERATOR_SOURCES = ("worldgen", "lib/random", "model/terrain/formats", "tools/terrain/generate_command.cpp",
                     "tools/scene/scene_command.cpp", "config/coast.scenes")


def facts_of(text):
    """The lines NAME = VALUE."""
    return dict(line.split(" = ", 1) for line in text.splitlines() if " = " in line)


def use_user_defaults(options):
    """What the user's file gives, unless the command line does. The programs do not read it again."""
    done = run(f"{options.bin}/yars", "config", "user", stdout=subprocess.PIPE)
    if done.returncode != 0:
        raise SystemExit(1)
    found = facts_of(done.stdout)
    for name in ("session", "size") if options.tour else ("session", "size", "config", "terrain"):  # a tour has its own
        setattr(options, name, getattr(options, name) or found.get(name))
    options.log_dir = found.get("log-dir") if options.log_dir is None else options.log_dir
    options.log_level = found.get("log-level")
    options.session = session("--session", options.session or "default")
    os.environ["YARS_USER_CONFIG"] = ""


def use_recording(options):
    """What the recording of --fly-out says, unless the command line does: configuration, terrain and flight."""
    done = run(f"{options.bin}/yars", "recordings", options.fly_out, "--at", options.at, "--lines", stdout=subprocess.PIPE,
               stderr=subprocess.STDOUT)
    if done.returncode != 0:
        end(done.returncode, as_own(done.stdout))
    for line in done.stdout.splitlines():
        if line.startswith("yars"):
            put(2, f"{NAME}: {as_own(line)}")
    found = facts_of(done.stdout)
    options.config = options.config or found.get("config")
    options.terrain = options.terrain or found.get("terrain")
    if options.terrain and not os.path.isdir(options.terrain):
        refuse(f"--fly-out: expected the recording's terrain, or --terrain DIR, found no folder {quoted(options.terrain)}")
    if not options.source:
        options.source = found.get("source")
        if found.get("reason") and "flight-model" in options.running:
            put(1, f"The aircraft flies on straight and level: {found['reason']}; --source SOURCE chooses another flight")


def digest(paths):
    sum_of_all = hashlib.sha256()
    for path in paths:
        sum_of_all.update(path.read_bytes())
    return sum_of_all.hexdigest()


def generator_of(options):
    """What makes the coast, as a sum: the program, of a checkout its sources; and the list of scenes."""
    if INSTALLED:
        return digest([pathlib.Path(options.bin, "yars"), SCENES])
    found = []
    for source in GENERATOR_SOURCES:
        top = HOME / source
        if not top.exists():
            end(1, f"expected the sources of the default terrain in {' '.join(GENERATOR_SOURCES)}")
        found += [path for path in ([top] if top.is_file() else top.rglob("*")) if path.suffix in (".cpp", ".hpp", ".scenes")]
    return digest(sorted(found, key=os.fsencode))


def contents(folder, generator):
    """What the coast has to be: its generator, and every file with its sum. `complete` in it says the same."""
    files = sorted((path for path in folder.rglob("*") if path.is_file() and path.name != "complete"), key=os.fsencode)
    return f"{generator}  -\n" + "".join(f"{digest([path])}  ./{path.relative_to(folder)}\n" for path in files)


def is_whole(folder, generator):
    with contextlib.suppress(OSError, UnicodeDecodeError):
        complete = (folder / "complete").read_text()
        return complete.startswith(generator) and complete == contents(folder, generator)
    return False


def make_coast(folder, generator, yars, lock):
    """Made beside its place and renamed when it is whole. Under the lock, so what others left half made may go."""
    for left in folder.parent.glob(f"{folder.name}.making.*"):
        shutil.rmtree(left)
    making = folder.with_name(f"{folder.name}.making.{os.getpid()}")
    try:
        done = run(yars, "terrain", "generate", "--out", making, "--airfields", "soil", stdout=subprocess.PIPE, pass_fds=[lock])
        if done.returncode != 0:
            end(1, "terrain generation failed")
        put(1, done.stdout.rstrip("\n").replace(str(making), str(folder)))
        (making / "scenes").mkdir(parents=True, exist_ok=True)
        for line in SCENES.read_text().splitlines():
            if not line or line.startswith("#"):
                continue
            file, kind, triangles, origin = line.split()
            done = run(yars, "scene", "generate", "--kind", kind, "--triangles", triangles, "--origin", origin, "--out",
                       making / "scenes" / file, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, pass_fds=[lock])
            if done.returncode != 0:
                put(2, done.stdout.rstrip("\n"))
                end(1, "terrain generation failed")
        (making / "complete").write_text(contents(making, generator))
        shutil.rmtree(folder, ignore_errors=True)
        making.rename(folder)
    finally:
        shutil.rmtree(making, ignore_errors=True)


def use_coast(options):
    """The default terrain is made once, and again when its generator has changed or something is missing or damaged."""
    folder = pathlib.Path("build/terrain/default")
    if INSTALLED:
        cache = os.environ.get("XDG_CACHE_HOME") or os.environ.get("HOME") and os.environ["HOME"] + "/.cache"
        if not cache:
            end(1, "expected HOME or XDG_CACHE_HOME for the terrain it makes, found neither; give --terrain DIR")
        folder = pathlib.Path(cache, "yars/terrain")
    generator = generator_of(options)
    folder.parent.mkdir(parents=True, exist_ok=True)
    with one_at_a_time("terrain", f"{folder}.lock") as lock:
        if not is_whole(folder, generator):
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
