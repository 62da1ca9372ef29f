"""Starts the whole set, looks after it, and ends all it started. scripts/start runs it; installed, yars-start."""
import os
import pathlib
import sys

sys.path[0] = str(pathlib.Path(__file__).resolve().parents[1])
from starting import build, options, sets, supervisor, world  # noqa: E402
from starting.command import HOME, INSTALLED, catch_signals, end, shown  # noqa: E402


def main(arguments):
    catch_signals()
    chosen = options.parse(arguments)
    try:
        if not INSTALLED:
            os.chdir(HOME)
        chosen.bin = build.folder_of_programs(chosen.bin, chosen.fly_out, chosen.network)
        world.choose_world(chosen)
        planned = sets.sets_of(chosen)
    except OSError as problem:
        end(1, shown(str(problem)))
    return supervisor.run_sets(planned)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
