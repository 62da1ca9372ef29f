"""The command line: one table of options, their checks, and which of them go together."""
import argparse
import functools
import os
import re

import nearest_word
from starting.command import HERE, NAME, SHARE, end, put, quoted, refuse, shown
from starting.roles import OF_SET

FIDELITIES = ("1996", "draft", "standard", "fine", "reference")


def matching(pattern, expected, name, text):
    return text if re.fullmatch(pattern, text, re.ASCII) else refuse(f"{name}: expected {expected}, found {quoted(text)}")


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


def any_text(_, text):
    return text


ONE_ROLE = f"({'|'.join(OF_SET)})"
number = functools.partial(matching, r"\d+([.]\d+)?", "a number of 0 or more, without a unit")
port = functools.partial(matching, r"[0-5]?\d{1,4}|6([0-4]\d{3}|5([0-4]\d\d|5([0-2]\d|3[0-5])))", "a port, 0 to 65535")
roles = functools.partial(matching, f"{ONE_ROLE}(,{ONE_ROLE})*", f"some of {', '.join(OF_SET)}, with commas between them")
session = functools.partial(matching, "[0-9A-Za-z_][0-9A-Za-z_-]{0,39}", "1 to 40 letters, digits, - or _, and no - at the front")
tour = functools.partial(matching, "pilot", "pilot or nothing")

OPTIONS = (  # name, value, its check, what it does in lines of --help; an option --web-OPTION is --OPTION of yars-station
    ("--tour", "[pilot]", tour, "a guided tour over the generated coast, with captions; ends by itself. With pilot it waits\n"
     "at each step until you have done it (docs/tour.md)"),
    ("--terrain", "DIR", path, "DTED, HGT, DED, packs, rasters (else a generated coast)"),
    ("--config", "FILE", path, "GUF configuration (else config/apg70.guf, over the generated coast config/default.guf)"),
    ("--fidelity", f"{{{','.join(FIDELITIES)}}}", fidelity,
     "preset of the radar model: speed against accuracy (else the configuration's)"),
    ("--session", "SESSION", session, "session to make (else $YARS_SESSION; default default)"),
    ("--source", "SOURCE", source, "the flight model's source (else a route along the terrain's coast)"),
    ("--headless", "SECONDS", number,
     "no window: run so long, write frames, end (else a window; without a screen 30, with --web no end)"),
    ("--frames", "DIR", file, "where frames go (default frames)"),
    ("--every", "SECONDS", number, "sim time between frames (default 1)"),
    ("--no-frames", "", None, "without a window: no frames in files"),
    ("--size", "PIXELS", number,
     "edge of the picture (else the configuration's; a window opens at two thirds of the screen's height)"),
    ("--publish", "", None, "the display publishes its frames in the segment, too"),
    ("--web", "", None, "the display in a browser, too: prints its addresses (docs/station.md); implies --publish.\n"
     "Each --web-OPTION below is --OPTION of yars-station, and implies --web"),
    ("--web-port", "PORT", port, "port of --web; 0 takes any free one (default 8096)"),
    ("--web-listen", "ADDRESS", any_text, "address to listen at; 0.0.0.0: all (default 127.0.0.1)"),
    ("--web-names", "NAMES", any_text,
     "names of this computer in the addresses of the pages, with commas between (else none)"),
    ("--web-tokens", "FILE", file,
     "tokens of instructors and viewers; made if it is not there (else ~/.local/state/yars/web-tokens)"),
    ("--web-without-tokens", "", None, "every user of this computer may look, fly and end roles; at loopback only"),
    ("--web-behind-proxy", "", None, "believe X-Forwarded-Host, -Proto and -For; only where a proxy sets them"),
    ("--web-certificate", "FILE", file, "TLS certificate in PEM (else no TLS)"),
    ("--web-key", "FILE", file, "private key of the certificate, in PEM (else no TLS)"),
    ("--web-without-tls", "", None, "listen beyond this computer without a certificate"),
    ("--lockstep", "", None, "all roles step together on sim time, as fast as they can (needs --headless)"),
    ("--script", "FILE", path, "events for the input monitor (else none)"),
    ("--input", "SOURCE", any_text,
     "the input monitor's source, as evdev:PATH or auto; may be repeated (else the terminal)"),
    ("--no-flight", "", None, "attach your own flight model"),
    ("--no-input", "", None, "attach your own input"),
    ("--roles", "LIST", roles, f"roles of this computer (else {','.join(OF_SET)})"),
    ("--network", "FILE", file, "joins other computers: GUF form Network; the gateway starts first, see docs/network.md "
     "(else that of the configuration, if it has one)"),
    ("--record", "FILE", file, "record ticks and events; refused when FILE is there already (else none)"),
    ("--pictures", "", None, "of --record: the sweeps with their video and the patch maps, too (up to 0.8 MB a second)"),
    ("--overwrite", "", None, "of --record: write over FILE"),
    ("--fly-out", "FILE", file, "goes on from a recording, at the second of --at; with --record BRANCH the new recording\n"
     "begins with that of FILE; programs that are built are used as they are (docs/recordings.md; else none)"),
    ("--at", "SECONDS", number, "of --fly-out: sim time within the recording (else none)"),
    ("--keep-recording", "MB", number,
     "the recording takes at most so much of the disk: the newest, in FILE.before and FILE (else no limit)"),
    ("--keep-frames", "NUMBER", number, "only the newest frames stay in the folder (else all)"),
    ("--log-dir", "DIR", path, 'where logs are kept, rotated; "" for none (else ~/.local/state/yars/SESSION)'),
    ("--realtime", "", None, "locked memory and real-time priority; says what the system refuses (docs/operation.md)"),
    ("--cpus", "LIST", any_text, "CPUs to run on, as in 2,3 (else all)"),
    ("--bin", "DIR", path, "programs that are built already: no set-up, no build (else $YARS_BIN_DIR, else they are built)"),
)
OF_DISPLAY = ("--frames", "--every", "--size", "--keep-frames", "--publish")


def help_text():
    heads = [("-h,--help", "print this help"), *((f"{name} {value}".strip(), does) for name, value, _, does in OPTIONS)]
    lines = []
    for head, does in heads:
        lines += [f"  {head}"] if len(head) > 28 else []
        lines += [f"  {'' if at or len(head) > 28 else head:<28}{line}" for at, line in enumerate(does.split("\n"))]
    return "\n".join([
        "The radar, ready to fly: starts the whole set, ends all it started", f"Usage: {NAME} [OPTIONS]", "", "Options:",
        *lines,
        "A program that dies is started again, at most 5 times within 60 s; not in lockstep. The user's file of defaults,",
        "~/.config/yars/yars.conf, may set session, config, terrain, log-dir, log-level and size (man yars)."])


def parse(arguments):
    parser = argparse.ArgumentParser(allow_abbrev=False, add_help=False)
    parser.print_help = lambda: put(1, help_text())
    parser.error = lambda message: refuse(
        message.removeprefix("argument ").replace("expected one argument", "expected a value, found nothing")
        .replace("ignored explicit argument", "expected no value, found"))
    parser.add_argument("-h", "--help", action="help")
    for name, value, check, _ in OPTIONS:
        more = {"type": functools.partial(check, name)} if check else {"action": "store_true"}
        more |= {"nargs": "?", "const": True} if value.startswith("[") else {"action": "append"} if name == "--input" else {}
        parser.add_argument(name, **more)
    options, words = parser.parse_known_args(arguments)
    if words[:1] == ["help"]:
        parser.print_help()
        parser.exit()
    if words:
        refuse(f"expected an option, found {quoted(words[0])}",
               nearest_word.did_you_mean(words[0].partition("=")[0], [name for name, *_ in OPTIONS]))
    given = {name: value for name, *_ in OPTIONS if (value := getattr(options, name[2:].replace("-", "_"))) not in (None, False)}
    options.of_station = {"--" + name[6:]: value for name, value in given.items() if name.startswith("--web-")}
    options.of_display = next((word for word in reversed(arguments) if word.partition("=")[0] in OF_DISPLAY), "")
    options.session = options.session or os.environ.get("YARS_SESSION") and session("--session", os.environ["YARS_SESSION"])
    options.bin = options.bin or os.environ.get("YARS_BIN_DIR")
    options.web = options.web or bool(options.of_station)
    options.input = options.input or []
    options.roles = options.roles or ",".join(OF_SET)
    options.left_out = ["flight-model"] * options.no_flight + ["input-monitor"] * options.no_input
    options.running = [role for role in options.roles.split(",") if role not in options.left_out]
    options.endless = False
    check_together(options)
    choose_display(options)
    if options.record and not options.overwrite and os.path.exists(options.record):
        end(2, f"--record: expected a new file, found {quoted(options.record)}; choose another, or add --overwrite")
    if options.lockstep and not options.headless:
        end(2, "--lockstep: expected --headless SECONDS with it, found none")
    return options


def check_together(options):
    """Which options go together."""
    has_display, all_run = "radar-display" in options.running, len(set(options.running)) == len(OF_SET)
    if options.tour and (options.network or options.roles != ",".join(OF_SET)):
        refuse("--tour: expected neither --roles nor --network with it, found one")
    if options.of_display and not has_display:
        refuse(f"{options.of_display}: expected radar-display among --roles, found {quoted(options.roles)}")
    if options.fidelity and "radar-model" not in options.running:
        refuse(f"--fidelity: expected radar-model among --roles, found {quoted(options.roles)}")
    if options.web and options.lockstep:
        refuse("--web: expected no --lockstep with it, because pages follow the clock, found one")
    options.publish = options.publish or options.web and has_display
    if options.no_frames and has_display and not options.publish:
        refuse("--no-frames: expected --web or --publish with it, or --roles without radar-display, found none")
    if options.network and not os.access(options.network, os.R_OK):
        refuse(f"--network: expected a file that can be read, found {quoted(options.network)}")
    own_world = options.terrain or options.config or options.source or options.script or options.record
    if options.tour and (own_world or not all_run):
        refuse("--tour: expected none of --terrain, --config, --source, --script, --record, --no-flight and --no-input "
               "with it, found one")
    if options.fly_out:
        if not options.at:
            refuse("--fly-out: expected --at SECONDS with it, found none")
        if os.path.isdir(options.fly_out):
            refuse(f"--fly-out: expected a recording, found the folder {quoted(options.fly_out)}; name a file in it")
        if not os.access(options.fly_out, os.R_OK):
            refuse(f"--fly-out: expected a recording that can be read, found {quoted(options.fly_out)}")
        if options.tour or options.network or options.lockstep:
            refuse("--fly-out: expected none of --tour, --network and --lockstep with it, found one")
    elif options.at:
        refuse("--at: expected --fly-out FILE with it, found none")
    # A configuration is a path, or the name of one that came with YARS.
    if options.config and not os.access(options.config, os.R_OK):
        folder, name = os.path.split(options.config)
        shipped = SHARE / "config" / name
        if folder != HERE or not os.access(shipped, os.R_OK):
            refuse(f"--config: expected a file that can be read, found {quoted(options.config)}")
        options.config = str(shipped)


def choose_display(options):
    """A window, or frames in a folder for a time."""
    frames_given, options.frames = options.frames, options.frames or os.path.join(HERE, "frames")
    where, options.every = quoted(options.frames), options.every or "1"
    if "radar-display" not in options.running:
        lasting = f"for {options.headless} s" if options.headless else "until they are interrupted"
        put(1, f"No radar-display among the roles: no window and no frames; they run {lasting}")
    elif not options.headless and not os.environ.get("DISPLAY") and not os.environ.get("WAYLAND_DISPLAY"):
        says = "No display found: running headless"
        if options.tour:
            options.headless = "3600"  # at most
            put(1, f"{says} until the tour ends, frames go to {where}/ (--frames DIR to choose)")
        elif options.web:
            options.headless, options.endless = "0", True
            options.no_frames = options.no_frames or not frames_given
            put(1, f"{says} until Ctrl-C, in browsers at the addresses below (--headless SECONDS, --frames DIR for pictures "
                   "in files)")
        else:
            options.headless = "30"
            put(1, f"{says} for 30 s, frames go to {where}/ (--headless SECONDS --frames DIR to choose)")
