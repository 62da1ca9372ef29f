"""Makes the sets of a command line, one or the two of a tour, with the command of each role."""
import glob
import os

from starting.command import (HERE, HOME, INSTALLED, NAME, SHARE, end, private_folder, put, put_as_own, quoted, refuse,
                              run, user_folder)
from starting.roles import OF_SET, ROLES, Role, Set

TICKS_A_SECOND = 200
START = ("gateway", "hand-over", "state-machine", "radar-model", "flight-model", "recorder", "input-monitor",
         "radar-display")  # in this order
NAMES = {"input": "source", "flown": "source", "keep-frames": "keep", "keep-recording": "keep"}  # of options of roles
TOURS = (("", "", "radar.tour"), (f"{SHARE}/config/default_apg68.guf", "/apg68", "second_radar.tour"))


def join_network(options):
    """Sets --network if the configuration has a form Network, because the gateway reads the form there."""
    if options.config and not (options.network or options.tour or options.fly_out):
        printed = run(f"{options.bin}/yars", "config", "print", options.config, capture_output=True).stdout
        if any(line.startswith("( Network") for line in printed.splitlines()):
            options.network = options.config
            put(1, "The configuration has a form Network: joining other computers, as with --network")
    if options.network and not os.access(f"{options.bin}/gateway", os.X_OK):
        end(1, "--network, or the form Network of the configuration: expected the program gateway beside yars, found "
               "none; this YARS was built without Cyclone DDS (docs/network.md); in a checkout, --network FILE builds "
               "it")


def choose_folders(options):
    """Chooses the user's folders for logs and for the station's tokens. Without a home folder there are none."""
    state = user_folder("XDG_STATE_HOME", ".local/state")
    if options.log_dir is None:
        options.log_dir = f"{state}/yars/{options.session}" if state else ""
    # A station that is started again is to have the same tokens. Without a folder it makes new ones.
    if options.web and state and not {"--tokens", "--without-tokens"} & options.of_station.keys():
        try:
            options.of_station["--tokens"] = private_folder(f"{state}/yars") + "/web-tokens"
        except OSError as problem:
            put(2, f"{NAME}: {problem}")


def inputs_of(options, tour_file):
    """Sources of the input monitor, which does not run without one."""
    keyboard = ["terminal"] if not options.lockstep and not options.headless and os.isatty(0) else []
    if tour_file:
        return (options.input or keyboard) + [f"tour:{tour_file}{',pilot' if options.tour == 'pilot' else ''}"]
    if options.script:
        return options.input + [f"script:{options.script}"]
    return options.input or ([f"script:{SHARE}/config/scripts/power_on.script"] if options.lockstep else keyboard)


def folder_for(options, frames):
    """Folder of the display's frames; None if it writes none."""
    if not options.headless or options.no_frames or "radar-display" not in options.running:
        return None
    earlier = len(glob.glob(f"{glob.escape(private_folder(frames))}/frame_*.png"))
    put(1, f"Frames go to {quoted(frames)}/" + (f"; {earlier} pictures of earlier runs are there, this run writes over "
                                                 "those of the same number" if earlier else ""))
    return frames


def set_of(options, config, frames, tour_file):
    seconds = float(options.headless) if options.headless else None
    if tour_file and seconds is not None:  # as long as the tour: the time of its last line
        ends = [line.split()[0] for line in tour_file.read_text().splitlines() if line.split()[1:] == ["end"]]
        seconds = min(seconds, 1 + float(ends[0]))
    running, network, fly_out, record = options.running, options.network, options.fly_out, options.record
    # Roles of this computer step together; with a network those of all, so that all name the same.
    steps = [name for name in OF_SET if name in running or network and name not in options.left_out]
    plan = f"{','.join(steps + ['recorder'] * bool(record))}@{int((seconds or 0) * TICKS_A_SECOND)}"
    inputs, frames = inputs_of(options, tour_file) if "input-monitor" in running else [], folder_for(options, frames)
    awaited = ",".join(name for name in ("state-machine", "radar-model", "flight-model") if name in running)
    values = {name.replace("_", "-"): value for name, value in vars(options).items()} | {  # of options of the roles
        "config": config, "lockstep": options.lockstep and plan, "standby": bool(network or fly_out), "input": inputs,
        "headless": bool(options.headless), "frames": frames, "every": frames and options.every, "from": fly_out,
        "keep-frames": frames and options.keep_frames, "sweeps": options.pictures, "patches": options.pictures,
        "flown": options.source if "flight-model" in running else None, "until": options.at, "seek": options.at,
        "hand-over": True, "await": [awaited]}

    def given(names):
        for name in names.split():
            value = values[name]
            for one in value if isinstance(value, list) else [value] * bool(value):
                yield from [f"--{NAMES.get(name, name)}"] + ([] if one is True else [one])

    def command(name, *verb):
        kind, common = ROLES[name], () if verb else given("log-level realtime cpus")
        return [f"{options.bin}/{kind.program}", *given("session config"), *common, *verb, *given(kind.options)]

    verbs = {"hand-over": ("replay", fly_out), "recorder": ("record", record)}
    wanted = {"gateway": network, "hand-over": fly_out, "recorder": record, "input-monitor": inputs}
    roles = [Role(name, command(name, *verbs.get(name, ()))) for name in START if wanted.get(name, name in running)]
    if options.web:
        words = [name if value is True else f"{name}={value}" for name, value in options.of_station.items()]
        if not INSTALLED:  # programs of another folder (--bin) have neither pages nor a start beside them
            words += [f"--pages={HOME}/station/web/dist", f"--start-script={HOME}/scripts/start"]
        roles.append(Role("station", [*command("station"), *words, "--terrain", options.terrain or "", "--source",
                                      options.source or "", "--recordings", f"{HERE}/recordings"]))
    if not roles:
        refuse("--roles: expected --input SOURCE or a terminal for input-monitor alone, found none")
    # A window may be closed, a script comes to its end, Esc leaves the terminal's keys; nothing else ends by itself.
    may_end = ["radar-display"] * (not options.headless and "radar-display" in running)
    may_end += ["input-monitor"] * any(one == "terminal" or one.startswith("script:") for one in inputs)
    # A script, and a tour, decides for itself when power comes on.
    switches_on = "state-machine" in running and not (options.lockstep or options.script or tour_file)
    return Set(options.bin, options.session, roles, options.log_dir, lockstep=options.lockstep, network=bool(network),
               seconds=None if options.lockstep or options.endless else seconds, recording=record, may_end=may_end,
               inject=("power opr", "elevation -3") if switches_on else (),
               ends_with=["input-monitor"] if tour_file and not options.lockstep else [])


def sets_of(options):
    join_network(options)
    choose_folders(options)
    # A fault of a configuration is said here, once; each role would say it again.
    if options.config and not options.fly_out:
        done = run(f"{options.bin}/yars", "config", "check", options.config, capture_output=True)
        if done.returncode != 0:
            put_as_own(done.stderr)
            end(1, "nothing was started")
    if not options.tour:
        return [set_of(options, options.config, options.frames, None)]
    return [set_of(options, config or options.config, options.frames + folder, SHARE / "config/tours" / file)
            for config, folder, file in TOURS]
