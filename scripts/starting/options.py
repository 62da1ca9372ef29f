"""The command line: one table of options, the checks of their values, and which of them go together."""
import argparse
import functools
import os
import re

from starting import nearest_word
from starting.command import HERE, NAME, SHARE, end, put, quoted, refuse, shown
from starting.roles import OF_SET

FIDELITIES = ("1996", "draft", "standard", "fine", "reference")  # generated
OPTIONS = (  # name, value, what it does in lines of --help; --web-OPTION is --OPTION of yars-station
    ("--tour", "[pilot]", "a guided tour over the generated coast, with captions; ends by itself. With pilot it waits\n"
     "at each step until you have done it (docs/tour.md)"),
    ("--terrain", "DIR", "DTED, HGT, DED, packs, rasters (else a generated coast)"),
    ("--config", "FILE", "GUF configuration (else config/apg70.guf, over the generated coast config/default.guf)"),
    ("--fidelity", f"{{{','.join(FIDELITIES)}}}",
     "preset of the radar model: speed against accuracy (else the configuration's)"),
    ("--session", "SESSION", "session to make (else $YARS_SESSION; default default)"),
    ("--source", "SOURCE", "the flight model's source (else a route along the terrain's coast)"),
    ("--headless", "SECONDS",
     "no window: run so long, write frames, end (else a window; without a screen 30, with --web no end)"),
    ("--frames", "DIR", "where frames go (default frames)"),
    ("--every", "SECONDS", "sim time between frames (default 1)"),
    ("--no-frames", "", "without a window: no frames in files"),
    ("--size", "PIXELS",
     "edge of the picture (else the configuration's; a window opens at two thirds of the screen's height)"),
    ("--publish", "", "the display publishes its frames in the segment, too"),
    ("--web", "", "the display in a browser, too: prints its addresses (docs/station.md); implies --publish.\n"
     "Each --web-OPTION below is --OPTION of yars-station, and implies --web"),
    ("--web-port", "PORT", "port of --web; 0 takes any free one (default 8096)"),
    ("--web-listen", "ADDRESS", "address to listen at; 0.0.0.0: all (default 127.0.0.1)"),
    ("--web-names", "NAMES", "names of this computer in the addresses of the pages, with commas between (else none)"),
    ("--web-tokens", "FILE",
     "tokens of instructors and viewers; made if it is not there (else ~/.local/state/yars/web-tokens)"),
    ("--web-without-tokens", "", "every user of this computer may look, fly and end roles; at loopback only"),
    ("--web-behind-proxy", "", "believe X-Forwarded-Host, -Proto and -For; only where a proxy sets them"),
    ("--web-certificate", "FILE", "TLS certificate in PEM (else no TLS)"),
    ("--web-key", "FILE", "private key of the certificate, in PEM (else no TLS)"),
    ("--web-without-tls", "", "listen beyond this computer without a certificate"),
    ("--lockstep", "", "all roles step together on sim time, as fast as they can (needs --headless)"),
    ("--script", "FILE", "events for the input monitor (else none)"),
    ("--input", "SOURCE", "the input monitor's source, as evdev:PATH or auto; may be repeated (else the terminal)"),
    ("--no-flight", "", "attach your own flight model"),
    ("--no-input", "", "attach your own input"),
    ("--roles", "LIST", f"roles of this computer (else {','.join(OF_SET)})"),
    ("--network", "FILE", "joins other computers: GUF form Network; the gateway starts first, see docs/network.md "
     "(else that of the configuration, if it has one)"),
    ("--record", "FILE", "record ticks and events; refused when FILE is there already (else none)"),
    ("--pictures", "", "of --record: the sweeps with their video and the patch maps, too (up to 0.8 MB a second)"),
    ("--overwrite", "", "of --record: write over FILE"),
    ("--fly-out", "FILE", "goes on from a recording, at the second of --at; with --record BRANCH the new recording\n"
     "begins with that of FILE; programs that are built are used as they are (docs/recordings.md; else none)"),
    ("--at", "SECONDS", "of --fly-out: sim time within the recording (else none)"),
    ("--keep-recording", "MB",
     "the recording takes at most so much of the disk: the newest, in FILE.before and FILE (else no limit)"),
    ("--keep-frames", "NUMBER", "only the newest frames stay in the folder (else all)"),
    ("--log-dir", "DIR", 'where logs are kept, rotated; "" for none (else ~/.local/state/yars/SESSION)'),
    ("--realtime", "", "locked memory and real-time priority; says what the system refuses (docs/operation.md)"),
    ("--cpus", "LIST", "CPUs to run on, as in 2,3 (else all)"),
    ("--bin", "DIR", "programs that are built already: no set-up, no build (else $YARS_BIN_DIR, else they are built)"),
)
OF_DISPLAY = ("--frames", "--every", "--size", "--keep-frames", "--publish")


def path(_, text):
    return os.path.join(HERE, text) if text else ""


def file(name, text):
    return path(name, text) if text else refuse(f"{name}: expected a path, found an empty text")


def source(_, text):
    kind, colon, rest = text.partition(":")
    return f"{kind}:{path(_, rest)}" if colon and kind in ("route", "csv") else text


def fidelity(name, text):
    found = f"'{shown(text)}'" if text else "an empty text"
    return text if text in FIDELITIES else refuse(f"{name}: expected one of {', '.join(FIDELITIES)}, found {found}",
                                                  nearest_word.did_you_mean(text, FIDELITIES))


def matching(pattern, expected, name, text):
    return text if re.fullmatch(pattern, text) else refuse(f"{name}: expected {expected}, found {quoted(text)}")


ROLE = f"({'|'.join(OF_SET)})"
PORT = "[0-5]?[0-9]{1,4}|6([0-4][0-9]{3}|5([0-4][0-9]{2}|5([0-2][0-9]|3[0-5])))"
number = functools.partial(matching, "[0-9]+([.][0-9]+)?", "a number of 0 or more, without a unit")
session = functools.partial(matching, "[0-9A-Za-z_][0-9A-Za-z_-]{0,39}",
                            "1 to 40 letters, digits, - or _, and no - at the front")
CHECKS = {  # by option, else by the name of its value; other values are checked by who gets them
    "DIR": path, "FILE": file, "SECONDS": number, "PIXELS": number, "MB": number, "NUMBER": number, "SESSION": session,
    "PORT": functools.partial(matching, PORT, "a port, 0 to 65535"),
    "[pilot]": functools.partial(matching, "pilot", "pilot or nothing"),
    "--frames": file, "--config": path, "--script": path, "--source": source, "--fidelity": fidelity,
    "--roles": functools.partial(matching, f"{ROLE}(,{ROLE})*", f"some of {', '.join(OF_SET)}, with commas between "
                                 "them"),
}


def help_text():
    margin = 30
    text = f"The radar, ready to fly: starts the whole set, ends all it started\nUsage: {NAME} [OPTIONS]\n\nOptions:"
    for name, value, does in (("-h,--help", "", "print this help"), *OPTIONS):
        head, below = f"  {name} {value}".rstrip(), "\n" + " " * margin
        text += "\n" + (f"{head:<{margin}}" if len(head) < margin else head + below) + does.replace("\n", below)
    return f"""{text}
A program that dies is started again, at most 5 times within 60 s; not in lockstep. The user's file of defaults,
~/.config/yars/yars.conf, may set session, config, terrain, log-dir, log-level and size (man yars)."""


def parse(arguments):
    parser = argparse.ArgumentParser(allow_abbrev=False, add_help=False)
    parser.print_help = lambda: put(1, help_text())
    parser.error = lambda message: refuse(
        message.removeprefix("argument ").replace("expected one argument", "expected a value, found nothing")
        .replace("ignored explicit argument", "expected no value, found"))
    parser.add_argument("-h", "--help", action="help")
    for name, value, _ in OPTIONS:
        more = {"action": "append"} if name == "--input" else {"nargs": "?", "const": True} if value[:1] == "[" else {}
        check = functools.partial(CHECKS.get(name) or CHECKS.get(value) or (lambda _, text: text), name)
        parser.add_argument(name, **({"type": check, **more} if value else {"action": "store_true"}))
    options, words = parser.parse_known_args(arguments)
    if words[:1] == ["help"]:
        parser.print_help()
        parser.exit()
    if words:
        names = ["--help", *(name for name, *_ in OPTIONS)]
        meant = nearest_word.did_you_mean(words[0].partition("=")[0], names)
        refuse(f"expected an option, found {quoted(words[0])}", meant)
    options.of_station = {name.replace("web_", "--").replace("_", "-"): value for name, value in vars(options).items()
                          if name.startswith("web_") and value not in (None, False)}
    options.of_display = next((word for word in reversed(arguments) if word.partition("=")[0] in OF_DISPLAY), "")
    options.session = options.session or os.environ.get("YARS_SESSION")
    if options.session:
        session("--session", options.session)
    options.bin = options.bin or os.environ.get("YARS_BIN_DIR")
    options.web = options.web or bool(options.of_station)
    options.input, options.roles = options.input or [], options.roles or ",".join(OF_SET)
    options.left_out = ["flight-model"] * options.no_flight + ["input-monitor"] * options.no_input
    options.running = [role for role in options.roles.split(",") if role not in options.left_out]
    check_together(options)
    choose_display(options)
    if options.record and not options.overwrite and os.path.exists(options.record):
        end(2, f"--record: expected a new file, found {quoted(options.record)}; choose another, or add --overwrite")
    if options.lockstep and not options.headless:
        end(2, "--lockstep: expected --headless SECONDS with it, found none")
    return options


def check_together(given):
    """Refuses options that contradict each other, and files that cannot be read."""
    def readable(file):
        return not file or os.access(file, os.R_OK)

    has_display, config, recording = "radar-display" in given.running, given.config, given.fly_out
    given.publish = given.publish or given.web and has_display
    own_world = given.terrain or config or given.source or given.script or given.record
    # A configuration is a path, or the name of one that came with YARS.
    shipped = SHARE / "config" / os.path.basename(config or "")
    if not readable(config) and os.path.dirname(config) == HERE and readable(shipped):
        given.config = config = str(shipped)
    for is_wrong, option, expected, found in (
            (given.tour and (given.network or given.roles != ",".join(OF_SET)),
             "--tour", "neither --roles nor --network with it", "one"),
            (given.of_display and not has_display,
             given.of_display, "radar-display among --roles", quoted(given.roles)),
            (given.fidelity and "radar-model" not in given.running,
             "--fidelity", "radar-model among --roles", quoted(given.roles)),
            (given.web and given.lockstep, "--web", "no --lockstep with it, because pages follow the clock", "one"),
            (given.no_frames and has_display and not given.publish,
             "--no-frames", "--web or --publish with it, or --roles without radar-display", "none"),
            (not readable(given.network), "--network", "a file that can be read", quoted(given.network)),
            (given.tour and (own_world or given.left_out), "--tour",
             "none of --terrain, --config, --source, --script, --record, --no-flight and --no-input with it", "one"),
            (recording and not given.at, "--fly-out", "--at SECONDS with it", "none"),
            (os.path.isdir(recording or ""), "--fly-out", "a recording",
             f"the folder {quoted(recording)}; name a file in it"),
            (not readable(recording), "--fly-out", "a recording that can be read", quoted(recording)),
            (recording and (given.tour or given.network or given.lockstep),
             "--fly-out", "none of --tour, --network and --lockstep with it", "one"),
            (given.at and not recording, "--at", "--fly-out FILE with it", "none"),
            (not readable(config), "--config", "a file that can be read", quoted(config))):
        if is_wrong:
            refuse(f"{option}: expected {expected}, found {found}")


def choose_display(options):
    """Chooses between a window and frames in a folder for a limited time. Says so if no screen is found."""
    frames_given, options.frames = options.frames, options.frames or os.path.join(HERE, "frames")
    options.every, options.endless = options.every or "1", False
    screen, says = os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"), "No display found: running headless"
    if "radar-display" not in options.running:
        put(1, "No radar-display among the roles: no window and no frames; they run "
               + (f"for {options.headless} s" if options.headless else "until they are interrupted"))
    elif screen or options.headless:
        return
    elif options.tour:
        options.headless = "3600"  # at most
        put(1, f"{says} until the tour ends, frames go to {quoted(options.frames)}/ (--frames DIR to choose)")
    elif options.web:
        options.headless, options.endless, options.no_frames = "0", True, options.no_frames or not frames_given
        put(1, f"{says} until Ctrl-C, in browsers at the addresses below (--headless SECONDS, --frames DIR for "
               "pictures in files)")
    else:
        options.headless = "30"
        put(1, f"{says} for 30 s, frames go to {quoted(options.frames)}/ (--headless SECONDS --frames DIR to choose)")
