"""The command `yars dataset`: reads its arguments, finds what is to be made, has workers make it, shows progress.

    python3 -m yars.dataset SPEC --out DIR [--workers N] [--shard i/N] [--dask ADDRESS] [--verify]
Exit codes: 0 done; 1 an error; 2 wrong arguments; 130, 143 ended by Ctrl-C or SIGTERM.
The same command goes on where a run ended."""
import argparse
import collections
import itertools
import json
import os
import re
import select
import signal
import sys
import time
import warnings

from . import DatasetError, context, files, keys
from .host import HostProcess, check_answer, show_warnings_once
from .store import absent_blocks

MOST_BATCH = 8      # blocks that a worker gets at once
MOST_RESTARTS = 5   # of the host process without a block in between
LINE_EVERY_S, DRAW_EVERY_S = 10.0, 0.5
MOST_ERROR_LINES = 20


class Interrupted(BaseException):  # no handler of errors may take it
    """Ctrl-C or SIGTERM. `number`: the signal."""

    def __init__(self, number):
        super().__init__(number)
        self.number = number


def raise_interrupted(number, _):
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    raise Interrupted(number)


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


def batches(blocks, count, workers):
    """`count` successive blocks as batches, which get smaller towards the end so that all workers end together."""
    blocks = iter(blocks)
    while count > 0:
        size = max(1, min(MOST_BATCH, count // (4 * workers)))
        yield list(itertools.islice(blocks, size))
        count -= size


def run_local(options, mark, blocks, count, progress):
    """Makes `count` blocks with the workers of one host process."""
    workers = max(1, min(options.workers, count))
    todo, again, flying, restarts = batches(blocks, count, workers), collections.deque(), set(), 0
    host = HostProcess(options.plan, options.out, workers, options.maker, mark)
    try:
        while True:
            while len(flying) < 2 * MOST_BATCH * workers:
                batch = again.popleft() if again else next(todo, None)
                if batch is None:
                    break
                flying.update(batch)
                host.give(batch)
            if not flying:
                return
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
            if end and flying:
                code, restarts = host.close(), restarts + 1
                if restarts > MOST_RESTARTS:
                    raise DatasetError(f"expected a host process that runs, found it dead {restarts} times: "
                                       f"{files.end_of(code)}")
                again.extendleft([block] for block in sorted(flying, reverse=True))
                flying.clear()
                host = HostProcess(options.plan, options.out, workers, options.maker, mark)
    finally:
        host.close()


def load_once(options, mark):
    """Has a host process read terrain and scenes and write what it writes then:
    objects.json and the metadata of the arrays."""
    host = HostProcess(options.plan, options.out, 0, options.maker, mark)
    try:
        end, ready = False, False
        while not end and not ready:
            lines, end = host.lines.read()
            for answer in map(json.loads, lines):
                check_answer(answer)
                ready = ready or "ready" in answer
    finally:
        code = host.close()
    if not ready:
        raise DatasetError(f"expected a host process that runs, found it dead: {files.end_of(code)}")


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
    result = argparse.ArgumentParser(prog="yars dataset",
                                     description="make radar chips with labels by a specification file")
    result.add_argument("plan", metavar="SPEC", nargs="?", help="specification, a YAML file (docs/datasets.md)")
    result.add_argument("--out", metavar="DIR", help="folder of the data set; an interrupted one is completed")
    result.add_argument("--workers", metavar="N", type=count_of, default=len(os.sched_getaffinity(0)),
                        help="number of processes (default: one for each core of this process)")
    result.add_argument("--shard", metavar="i/N", type=shard_of, default=(0, 1),
                        help="make only blocks i, i + N, ... with i from 0")
    result.add_argument("--dask", metavar="ADDRESS", help="scheduler of Dask distributed, such as tcp://host:8786; "
                                                          "its workers make the blocks")
    result.add_argument("--verify", action="store_true", help="read all files that are there and compare their hashes")
    result.add_argument("--merge", action="store_true", help="only join the parts of all shards")
    result.add_argument("--check", action="store_true",
                        help="only check SPEC: makes and reads terrain and scenes in a temporary folder, "
                             "and draws the first items")
    result.add_argument("--keys", action="store_true", help="print all keys of a specification as tables")
    return result


def main(arguments=None, maker=context.MAKER):
    """The command. Returns its exit code."""
    options = parser().parse_args(arguments)
    if options.keys:
        print(keys.markdown())
        return 0
    if not options.plan or not (options.out or options.check):
        parser().error("expected SPEC" + (", found none; give a specification file" if not options.plan
                                          else " and --out DIR, found no --out"))
    options.maker = maker
    options.plan = os.path.abspath(options.plan) if options.dask else options.plan
    options.out = os.path.abspath(options.out) if options.out and options.dask else options.out
    with warnings.catch_warnings():
        show_warnings_once()
        return guarded(options)


def guarded(options):
    """run() with one message for each fault, and Ctrl-C. Returns the exit code."""
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
    plan, _, store = context.open_store(options.plan, options.out or os.curdir)
    if "object" not in plan.arrays:
        warnings.warn(f"{plan.where('chip.arrays')}: without object there are no boxes; "
                      "add object to chip.arrays for them")
    if options.check:
        context.try_out(options.plan, options.maker)
        print(f"{options.plan}: good; {plan.count:,} items in {plan.blocks:,} block{'s' * (plan.blocks > 1)}")
        return 0
    if options.merge and not os.path.isdir(options.out):
        raise DatasetError(f"{options.out}: expected the folder of a data set for --merge, found none; check the path, "
                           "or run the shards first")
    client = None
    if options.dask:
        from . import dask_engine
        client = dask_engine.connect(options.dask)
    try:
        store.begin()
        return make_all(options, plan, store, client)
    finally:
        if client:
            dask_engine.disconnect(client)


def make_all(options, plan, store, client):
    """Makes what is not there. Returns the exit code. `client`: of the Dask cluster, or None."""
    files.remove_leftovers(options.out)
    shard, shards = options.shard
    mine = 0 if options.merge else len(range(shard, plan.blocks, shards))
    damaged = []

    def note_damage(block, reason):
        damaged.append(block)
        if len(damaged) <= MOST_ERROR_LINES:
            warnings.warn(f"block {block} is made again: {reason}")
    whole, number = store.whole_blocks(shard, shards, options.verify, note_damage) if mine else (b"", 0)
    count = mine - number
    fault = store.unfit("objects", options.verify)
    if not options.merge or fault:
        context.make_inputs(plan, store, read=bool(count or fault or options.verify))
    progress = Progress(*items_of(store, shard, shards, mine, whole, number))
    try:
        if count and client:
            from .dask_engine import run_dask
            run_dask(client, options, store.mark, absent_blocks(whole, shard, shards, plan.blocks), progress)
        elif count:
            run_local(options, store.mark, absent_blocks(whole, shard, shards, plan.blocks), count, progress)
        elif fault:
            warnings.warn(f"{options.out}: objects.json and the arrays' metadata are made again: {fault}")
            load_once(options, store.mark)
    finally:
        progress.end()
        if count:
            files.remove_leftovers(options.out)  # of workers that were killed
    return report(options, store, progress, bool(count))


def items_of(store, shard, shards, mine, whole, number):
    """(items that are there, all items) of a shard with `mine` blocks, `number` of them whole, by the bits `whole`."""
    last, block = store.plan.blocks - 1, store.plan.block
    short = block - (store.items(last)[1] - store.items(last)[0])  # items that the last block has less
    total = mine * block - (short if mine and last % shards == shard else 0)
    return number * block - (short if number and int(whole[last // 8]) >> last % 8 & 1 else 0), total


def report(options, store, progress, made):
    """Joins the parts, and says what was done."""
    seconds = time.monotonic() - progress.begin
    whole = join(options, store, made)
    text = f"{progress.made:,} items made, {progress.there:,} were there; {seconds:.1f} s"
    if progress.made:
        text += f", {progress.made / seconds:,.0f} items/s, {progress.redraws:,} redraws"
    print(f"{options.out}: {text}; " + ("all items are there" if whole else "blocks of other shards are to come"))
    return 0 if whole or not options.merge else 1


def join(options, store, made):
    """Joins the parts if all are there. Returns True if they are."""
    if not store.complete():
        if options.merge:
            print(f"yars dataset: {options.out}: expected the parts of all blocks, found some absent; "
                  "run the other shards first", file=sys.stderr)
        return False
    broken = store.merge(made or options.merge, options.verify)
    if broken:
        raise DatasetError(f"{options.out}: expected whole parts, found damaged ones, the first of block {broken[0]}; "
                           "run the command again without --merge and --shard")
    return True
