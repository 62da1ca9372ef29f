"""Blocks made by the workers of Dask distributed (https://distributed.dask.org): one task a block.

Each Dask worker keeps one host process with as many forked workers as it has threads. Specification and folder have the same
paths on all computers. A task whose worker dies runs again elsewhere: blocks are idempotent."""
import collections
import concurrent.futures
import json
import threading
import uuid

from . import DatasetError
from .run import HostProcess, check_answer

MOST_TRIES = 30       # of a block, when workers die or host processes do
WORKERS_WITHIN_S = 60
TASKS_PER_THREAD = 4  # that wait at the scheduler

_lock = threading.Lock()
_host = None
_ended = set()  # runs whose tasks may still arrive at this worker


class SharedHost:
    """The host process of this Dask worker, used by all its threads."""

    def __init__(self, key, workers):
        plan, folder, maker, mark = self.key = key
        self._process = HostProcess(plan, folder, workers, maker, mark, with_parent=False)
        self._waiting, self._guard, self.dead = {}, threading.Lock(), False
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def make(self, block):
        """Answer of the host for a block. Raises RuntimeError if the host dies."""
        answer = concurrent.futures.Future()
        with self._guard:
            if self.dead:
                raise RuntimeError("the host process has ended")
            self._waiting.setdefault(block, []).append(answer)
        self._process.give([block])
        return answer.result()

    def _read(self):
        end, failure = False, None
        while not end:
            try:
                lines, end = self._process.lines.read()
            except OSError:
                lines, end = [], True
            for answer in map(json.loads, lines):
                with self._guard:
                    waiting = self._waiting.pop(answer.get("block", answer.get("lost")), [])
                    if "error" in answer:  # of any block: the run ends
                        failure = answer
                        waiting = [future for futures in self._waiting.values() for future in futures]
                        self._waiting.clear()
                for future in waiting:
                    future.set_result(answer)
        with self._guard:
            self.dead = True
            for futures in self._waiting.values():
                for future in futures:
                    if failure:
                        future.set_result(failure)
                    else:
                        future.set_exception(RuntimeError("the host process has ended"))

    def close(self):
        self._process.close()


def make_block(run, plan, folder, maker, mark, block):
    """Task: makes a block on this Dask worker. Returns the answer of its host; an error is an answer, too. `run`: name of the run."""
    global _host  # pylint: disable=global-statement
    from distributed import get_worker
    key = plan, folder, maker, mark
    with _lock:
        if run in _ended:  # a new host would outlive the run
            raise RuntimeError("the run has ended")
        if _host is None or _host.dead or _host.key != key:
            if _host is not None:
                _host.close()
            worker = get_worker()
            _host = SharedHost(key, getattr(worker, "state", worker).nthreads)
        host = _host
    return host.make(block)


def close_host(run):
    """Ends the host process of this Dask worker. Tasks of the run that come later make no other one."""
    global _host  # pylint: disable=global-statement
    with _lock:
        _ended.add(run)
        if _host is not None:
            _host.close()
            _host = None


def run_dask(options, mark, blocks, progress):
    """Makes blocks on a Dask cluster. Raises DatasetError."""
    try:
        import distributed
    except ImportError:
        raise DatasetError("expected the Python package distributed for --dask, found none; install python3-distributed") from None
    try:
        client = distributed.Client(options.dask, timeout=30)
    except (OSError, ValueError, TimeoutError) as error:
        raise DatasetError(f"--dask: expected a scheduler at {options.dask}, found none: {error}; start dask-scheduler, or check the "
                           "address") from None
    try:
        client.wait_for_workers(1, timeout=WORKERS_WITHIN_S)
    except (TimeoutError, distributed.TimeoutError):
        client.close()
        raise DatasetError(f"--dask: expected workers at {options.dask}, found none in {WORKERS_WITHIN_S} s; start dask-worker") from None
    run = uuid.uuid4().hex
    try:
        _submit_all(client, (run, options.plan, options.out, options.maker, mark), blocks, progress)
    finally:
        try:
            client.run(close_host, run, on_error="ignore")
        finally:
            client.close()


def _submit_all(client, arguments, blocks, progress):
    """`arguments`: of make_block() without the block."""
    import distributed
    todo, tries = collections.deque(blocks), collections.Counter()
    flying = {}

    def submit(block):
        tries[block] += 1
        future = client.submit(make_block, *arguments, block, pure=False, key=f"yars-{arguments[0][:8]}-{block}-{tries[block]}")
        flying[future.key] = block
        return future
    threads = sum(client.nthreads().values())
    done = distributed.as_completed([submit(todo.popleft()) for _ in range(min(len(todo), max(16, TASKS_PER_THREAD * threads)))])
    for future in done:
        block = flying.pop(future.key)
        error = future.exception()
        if error is None:
            answer = future.result()
            check_answer(answer)
            progress.add(answer["items"], answer["redraws"])
        elif isinstance(error, ModuleNotFoundError):
            raise DatasetError(f"--dask: expected the package yars on the workers, found: {error}; install python3-yars there, or set "
                               "PYTHONPATH for dask-worker")
        elif tries[block] >= MOST_TRIES:
            raise DatasetError(f"block {block}: expected its files, found {tries[block]} failures; the last: {error or type(error).__name__}; "
                               "see the log of dask-worker")
        else:
            done.add(submit(block))
            continue
        if todo:
            done.add(submit(todo.popleft()))
