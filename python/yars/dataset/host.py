"""The host process of a computer: reads terrain and scenes once, forks workers that share them, hands out blocks.

It is started as `python3 -m yars.dataset.host SPEC DIR WORKERS MAKER MARK WITH_PARENT` and speaks JSON lines. Input:
{"blocks": [b, ...]}, a batch for one worker. Output: {"ready": n}; {"block": b, "items": n, "redraws": r}; {"error":
text}; {"lost": b, "reason": text}. At the end of its input it ends, and its workers with it.
WITH_PARENT 1: it ends, too, when the thread that started it ends."""
import collections
import ctypes
import gc
import json
import os
import re
import select
import signal
import subprocess
import sys
import traceback
import warnings

from . import DatasetError, files
from .limits import without_name

MOST_DEATHS = 5  # of workers with the same block
END_S = 10.0     # that a host may take to end


def die_with_parent(parent):
    """Has the kernel kill this process when its parent dies."""
    ctypes.CDLL(None, use_errno=True).prctl(1, signal.SIGKILL, 0, 0, 0)  # PR_SET_PDEATHSIG
    if os.getppid() != parent:
        os._exit(1)


def show_warnings_once():
    """Has a warning printed on standard error the first time; texts that differ by numbers alone count as one."""
    seen = set()

    def show(message, category, *_, **__):
        if issubclass(category, (DeprecationWarning, PendingDeprecationWarning, FutureWarning, ResourceWarning)):
            return  # for programmers
        message = without_name(message)
        kind = re.sub(r"[-+0-9.]+", "", message)
        if kind not in seen:
            seen.add(kind)
            print(f"yars dataset: warning: {message}", file=sys.stderr)
    warnings.simplefilter("always")  # the other filters would remember every text
    warnings.showwarning = show


class Lines:
    """Lines of a pipe, without blocking."""

    def __init__(self, file):
        self.file, self._rest = file, b""

    def read(self):
        """(whole lines, True at the end of the pipe)."""
        data = os.read(self.file, 1 << 16)
        *lines, self._rest = (self._rest + data).split(b"\n")
        return lines, not data


def fault_text():
    """The present exception, as an error that a user may report."""
    kind, value, _ = sys.exc_info()
    places = traceback.format_exc(limit=-3).strip()
    return f"expected no fault of this program, found {kind.__name__}: {value}; report it with these lines:\n{places}"


def write_all(file, text):
    data = memoryview(text.encode())
    while len(data):
        data = data[os.write(file, data):]


def work(maker, commands, results):
    """Loop of a worker: batches of blocks in, one line a block out."""
    source = Lines(commands)
    while True:
        lines, end = source.read()
        for line in lines:
            try:
                blocks = json.loads(line)
                samples = maker.draw(blocks)
                for block in blocks:
                    items, redraws = maker.make(block, samples[block])
                    write_all(results, json.dumps({"block": block, "items": items, "redraws": redraws}) + "\n")
            except DatasetError as error:
                write_all(results, json.dumps({"error": str(error)}) + "\n")
            except MemoryError:
                write_all(results, json.dumps({"error": "expected memory for a block, found none left; "
                                                        "use fewer workers or a smaller output.block"}) + "\n")
            except Exception:  # pylint: disable=broad-except
                write_all(results, json.dumps({"error": fault_text()}) + "\n")
        if end:
            return


class Worker:
    def __init__(self, maker, others):
        command_read, self.commands = os.pipe()
        result_read, results = os.pipe()
        parent = os.getpid()
        self.pid = os.fork()
        if self.pid == 0:
            code = 1
            try:
                die_with_parent(parent)
                signal.signal(signal.SIGTERM, signal.SIG_DFL)
                warnings.simplefilter("ignore")  # the host has shown those of items from the whole set
                for file in [0, self.commands, result_read] + [file for worker in others
                                                               for file in (worker.commands, worker.results.file)]:
                    os.close(file)
                os.dup2(2, 1)  # what a library prints must not get into the host's answers
                work(maker, command_read, results)
                code = 0
            finally:
                os._exit(code)
        os.close(command_read)
        os.close(results)
        self.results = Lines(result_read)
        self.batch = []  # blocks that it has not finished

    def give(self, blocks):
        self.batch = list(blocks)
        try:
            write_all(self.commands, json.dumps(self.batch) + "\n")
        except BrokenPipeError:
            pass  # it died: seen at its other pipe

    def end(self):
        """Waits for a dead worker. Returns what ended it, in words."""
        os.close(self.commands)
        os.close(self.results.file)
        _, status = os.waitpid(self.pid, 0)
        return files.end_of(os.waitstatus_to_exitcode(status))


class Host:
    def __init__(self, maker, count):
        self._maker, self._waiting, self._deaths = maker, collections.deque(), collections.Counter()
        gc.collect()
        gc.freeze()  # the collector would write to, and so copy, pages that workers share
        self._workers = []
        for _ in range(count):
            self._workers.append(Worker(maker, self._workers))

    def run(self, output):
        source = Lines(0)
        write_all(output,
                  json.dumps({"ready": len(self._workers), "pids": [worker.pid for worker in self._workers]}) + "\n")
        while True:
            ready, _, _ = select.select([0] + [worker.results.file for worker in self._workers], [], [])
            if 0 in ready:
                lines, end = source.read()
                if end:
                    return
                self._waiting.extend(json.loads(line)["blocks"] for line in lines)
            for worker in [worker for worker in self._workers if worker.results.file in ready]:
                self._listen(worker, output)
            for worker in self._workers:
                if not worker.batch and self._waiting:
                    worker.give(self._waiting.popleft())

    def _listen(self, worker, output):
        lines, end = worker.results.read()
        for line in lines:
            answer = json.loads(line)
            if "block" in answer:
                worker.batch.remove(answer["block"])
            else:
                worker.batch = []
            write_all(output, line.decode() + "\n")
        if not end:
            return
        self._workers.remove(worker)
        reason = worker.end()
        if worker.batch:
            self._deaths[worker.batch[0]] += 1
            if self._deaths[worker.batch[0]] >= MOST_DEATHS:
                write_all(output, json.dumps({"lost": worker.batch[0], "reason": reason}) + "\n")
                worker.batch = worker.batch[1:]
            self._waiting.extendleft([block] for block in reversed(worker.batch))
        self._workers.append(Worker(self._maker, self._workers))

    def kill(self):
        for worker in self._workers:
            os.kill(worker.pid, signal.SIGKILL)
        for worker in self._workers:
            worker.end()


class HostProcess:
    """A host process and its pipes. `with_parent`: it dies with the thread that starts it."""

    def __init__(self, plan, folder, workers, maker, mark, with_parent=True):
        package = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
        paths = os.pathsep.join([package] + [path for path in sys.path if path and path != package])
        self.process = subprocess.Popen(
            [sys.executable, "-m", "yars.dataset.host", str(plan), str(folder), str(workers), maker, mark,
             str(os.getpid() if with_parent else 0)],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0, start_new_session=True,
            env={**os.environ, "PYTHONPATH": paths})
        self.lines = Lines(self.process.stdout.fileno())

    def give(self, blocks):
        try:
            write_all(self.process.stdin.fileno(), json.dumps({"blocks": blocks}) + "\n")
        except BrokenPipeError:
            pass  # it died: seen at its other pipe

    def close(self):
        """Ends the host and its workers at once; returns when none of them runs."""
        self.process.terminate()  # it kills its workers and waits for them
        try:
            code = self.process.wait(END_S)
        except subprocess.TimeoutExpired:
            self.process.kill()  # workers die with it: PR_SET_PDEATHSIG
            code = self.process.wait()
        self.process.stdin.close()
        self.process.stdout.close()
        return code


def check_answer(answer):
    """Raises DatasetError for an answer of a host that reports one."""
    if "error" in answer:
        raise DatasetError(answer["error"])
    if "lost" in answer:
        raise DatasetError(f"block {answer['lost']}: expected its files, "
                           f"found its worker ended each time by {answer['reason']}")


def main(arguments):
    plan, folder, count, maker_name, mark, with_parent = arguments
    if int(with_parent):
        die_with_parent(int(with_parent))
    output = os.dup(1)
    os.dup2(2, 1)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the coordinator decides what Ctrl-C does
    show_warnings_once()
    from .context import load
    host = None
    try:
        maker = load(plan, folder, maker_name, mark)
        host = Host(maker, int(count))
        signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
        host.run(output)
    except DatasetError as error:
        write_all(output, json.dumps({"error": str(error)}) + "\n")
        return 1
    except BrokenPipeError:
        return 1  # nobody listens any more
    except Exception:  # pylint: disable=broad-except
        write_all(output, json.dumps({"error": fault_text()}) + "\n")
        return 1
    finally:
        if host:
            host.kill()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
