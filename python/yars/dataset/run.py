"""The command `yars dataset`: reads its arguments, finds what is to be made, has workers make it, shows progress.

    python3 -m yars.dataset SPEC --out DIR [--workers N] [--shard i/N] [--dask ADDRESS] [--verify]
Exit codes: 0 done; 1 an error; 2 wrong arguments; 130, 143 ended by Ctrl-C or SIGTERM. The same command goes on where a run ended."""
import argparse
import collections
import json
import os
import re
import select
import signal
import subprocess
import sys
import time

from . import DatasetError, context, files, keys
from .host import Lines, write_all

MOST_BATCH = 8      # blocks that a worker gets at once
MOST_RESTARTS = 5   # of the host process without a block in between
LINE_EVERY_S, DRAW_EVERY_S = 10.0, 0.5
MOST_ERROR_LINES = 20


class Interrupted(Exception):
    """Ctrl-C or SIGTERM. `number`: the signal."""

    def __init__(self, number):
        super().__init__(number)
        self.number = number


def raise_interrupted(number, _):
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    raise Interrupted(number)


class HostProcess:
    """A host process and its pipes. `with_parent`: it dies with the thread that starts it."""

    def __init__(self, plan, folder, workers, maker, mark, with_parent=True):
        package = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
        paths = os.pathsep.join([package] + [path for path in sys.path if path and path != package])
        self.process = subprocess.Popen(
            [sys.executable, "-m", "yars.dataset.host", str(plan), str(folder), str(workers), maker, mark,
             str(os.getpid() if with_parent else 0)],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0, start_new_session=True, env={**os.environ, "PYTHONPATH": paths})
        self.lines = Lines(self.process.stdout.fileno())

    def give(self, blocks):
        try:
            write_all(self.process.stdin.fileno(), json.dumps({"blocks": blocks}) + "\n")
        except BrokenPipeError:
            pass  # it died: seen at its other pipe

    def close(self):
        """Ends the host and its workers at once."""
        if self.process.poll() is None:
            self.process.kill()  # workers die with it: PR_SET_PDEATHSIG
        code = self.process.wait()
        self.process.stdin.close()
        self.process.stdout.close()
        return code


class Progress:
    """Rate and time left on standard error: one line that is drawn again on a terminal, else a line every 10 s."""

    def __init__(self, there, total, stream=None):
        self.there, self.total, self.made, self.redraws = there, total, 0, 0
        self._stream = stream or sys.stderr
        self._terminal = self._stream.isatty()
        self.begin = self._shown = time.monotonic()
        self._recent = collections.deque([(self.begin, 0)], 64)

    def add(self, items, redraws):
        self.made, self.redraws = self.made + items, self.redraws + redraws
        self.show()

    def show(self):
        now = time.monotonic()
        if now - self._shown < (DRAW_EVERY_S if self._terminal else LINE_EVERY_S):
            return
        self._shown = now
        self._recent.append((now, self.made))
        first, made = self._recent[0]
        rate = (self.made - made) / (now - first)
        left = self.total - self.there - self.made
        wait = f", {duration(left / rate)} left" if rate > 0 else ""
        text = f"yars dataset: {self.there + self.made:,} of {self.total:,} items, {rate:,.0f} items/s{wait}"
        self._stream.write(f"\r{text}\033[K" if self._terminal else text + "\n")
        self._stream.flush()

    def end(self):
        if self._terminal:
            self._stream.write("\r\033[K")
            self._stream.flush()


def duration(seconds):
    seconds = int(seconds + 0.5)
    if seconds < 120:
        return f"{seconds} s"
    return f"{seconds // 60} min" if seconds < 7200 else f"{seconds // 3600} h {seconds % 3600 // 60} min"


def batches(blocks, workers):
    """Successive blocks as batches, which get smaller towards the end so that all workers end together."""
    at = 0
    while at < len(blocks):
        size = max(1, min(MOST_BATCH, (len(blocks) - at) // (4 * workers)))
        yield blocks[at:at + size]
        at += size


def run_local(options, mark, blocks, progress):
    """Makes blocks with the workers of one host process."""
    workers = max(1, min(options.workers, len(blocks)))
    todo, flying, restarts = collections.deque(batches(blocks, workers)), set(), 0
    host = HostProcess(options.plan, options.out, workers, options.maker, mark)
    try:
        while todo or flying:
            while todo and len(flying) < 2 * MOST_BATCH * workers:
                batch = todo.popleft()
                flying.update(batch)
                host.give(batch)
            ready, _, _ = select.select([host.lines.file], [], [], DRAW_EVERY_S)
            progress.show()
            if not ready:
                continue
            lines, end = host.lines.read()
            for line in lines:
                answer = json.loads(line)
                check_answer(answer)
                if "block" in answer:
                    flying.discard(answer["block"])
                    restarts = 0
                    progress.add(answer["items"], answer["redraws"])
            if end and (todo or flying):
                code, restarts = host.close(), restarts + 1
                if restarts > MOST_RESTARTS:
                    raise DatasetError(f"expected a host process that runs, found it dead {restarts} times (exit code {code}); is memory short? "
                                       "Try fewer --workers")
                todo.extendleft([block] for block in sorted(flying, reverse=True))
                flying.clear()
                host = HostProcess(options.plan, options.out, workers, options.maker, mark)
    finally:
        host.close()


def check_answer(answer):
    """Raises DatasetError for an answer of a host that reports one."""
    if "error" in answer:
        raise DatasetError(answer["error"])
    if "lost" in answer:
        raise DatasetError(f"block {answer['lost']}: expected its files, found its worker ended by {answer['reason']} each time; is memory "
                           "short? Try fewer --workers, or a smaller output.block")


def shard_of(text):
    match = re.fullmatch(r"(\d+)/(\d+)", text)
    if not match or not int(match.group(1)) < int(match.group(2)):
        raise argparse.ArgumentTypeError(f"expected i/N with i from 0 to N - 1, found {text}")
    return int(match.group(1)), int(match.group(2))


def count_of(text):
    if not re.fullmatch(r"\d+", text) or not 1 <= int(text) <= 4096:
        raise argparse.ArgumentTypeError(f"expected a number of workers from 1 to 4096, found {text}")
    return int(text)


def parser():
    result = argparse.ArgumentParser(prog="yars dataset", description="make radar chips with labels by a specification file")
    result.add_argument("plan", metavar="SPEC", nargs="?", help="specification, a YAML file (docs/datasets.md)")
    result.add_argument("--out", metavar="DIR", help="folder of the data set; an interrupted one is completed")
    result.add_argument("--workers", metavar="N", type=count_of, default=len(os.sched_getaffinity(0)),
                        help="number of processes (default: one for each core of this process)")
    result.add_argument("--shard", metavar="i/N", type=shard_of, default=(0, 1), help="make only blocks i, i + N, ... with i from 0")
    result.add_argument("--dask", metavar="ADDRESS", help="scheduler of Dask distributed, such as tcp://host:8786; its workers make the blocks")
    result.add_argument("--verify", action="store_true", help="read all files that are there and compare their hashes")
    result.add_argument("--merge", action="store_true", help="only join the parts of all shards")
    result.add_argument("--check", action="store_true", help="only check SPEC")
    result.add_argument("--keys", action="store_true", help="print all keys of a specification as tables")
    return result


def main(arguments=None, maker=context.MAKER):
    """The command. Returns its exit code."""
    options = parser().parse_args(arguments)
    if options.keys:
        print(keys.markdown())
        return 0
    if not options.plan or not (options.out or options.check):
        parser().error("expected SPEC" + (", found none; give a specification file" if not options.plan else " and --out DIR, found no --out"))
    options.maker = maker
    options.plan = os.path.abspath(options.plan) if options.dask else options.plan
    options.out = os.path.abspath(options.out) if options.out and options.dask else options.out
    handlers = {number: signal.signal(number, raise_interrupted) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        return run(options)
    except Interrupted as stop:
        print("yars dataset: interrupted; run the same command again to go on", file=sys.stderr)
        return 128 + stop.number
    except DatasetError as error:
        for line in str(error).splitlines()[:MOST_ERROR_LINES]:
            print(f"yars dataset: {line}", file=sys.stderr)
        return 1
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)


def run(options):
    if options.check:
        plan = context.open_store(options.plan, options.out or os.curdir)[0]
        print(f"{options.plan}: good; {plan.count:,} items in {plan.blocks:,} blocks")
        return 0
    plan, store = context.prepare(options.plan, options.out)
    shard, shards = options.shard
    blocks = [] if options.merge else list(range(shard, plan.blocks, shards))
    faults = {block: store.fault(block, options.verify) for block in blocks}
    todo = [block for block in blocks if faults[block]]
    for block in [block for block in todo if faults[block] != "absent"][:MOST_ERROR_LINES]:
        print(f"yars dataset: block {block} is made again: {faults[block]}", file=sys.stderr)
    total = sum(last - first for first, last in map(store.items, blocks))
    there = total - sum(last - first for first, last in map(store.items, todo))
    progress = Progress(there, total)
    try:
        if todo and options.dask:
            from .dask_engine import run_dask
            run_dask(options, store.mark, todo, progress)
        elif todo:
            run_local(options, store.mark, todo, progress)
    finally:
        progress.end()
    seconds = time.monotonic() - progress.begin
    whole = join(options, store, bool(todo))
    text = f"{progress.made:,} items made, {there:,} were there; {seconds:.1f} s"
    if progress.made:
        text += f", {progress.made / seconds:,.0f} items/s, {progress.redraws:,} redraws"
    print(f"{options.out}: {text}; " + ("all items are there" if whole else "blocks of other shards are to come"))
    return 0 if whole or not options.merge else 1


def join(options, store, made):
    """Joins the parts if all are there. Returns True if they are."""
    if made:
        files.remove_leftovers(options.out)  # of workers that were killed
    if not store.complete():
        if options.merge:
            print(f"yars dataset: {options.out}: expected the parts of all blocks, found some absent; run the other shards first", file=sys.stderr)
        return False
    broken = store.merge(made or options.verify or options.merge)
    if broken:
        raise DatasetError(f"{options.out}: expected whole parts, found {len(broken)} damaged, the first of block {broken[0]}; run the "
                           "command again without --merge and --shard")
    return True
