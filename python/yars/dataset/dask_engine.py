"""Blocks made by the workers of Dask distributed (https://distributed.dask.org): one task a block.

Each Dask worker keeps one host process with as many forked workers as it has threads. Specification and folder have the
same paths on all computers. A task whose worker dies runs again elsewhere: blocks are idempotent."""
import asyncio
import concurrent.futures
import itertools
import json
import logging
import queue
import threading
import time
import uuid

from . import DatasetError
from .host import HostProcess, check_answer

MOST_TRIES = 30       # of a block, when workers die or host processes do
WORKERS_WITHIN_S = 60
ANSWER_WITHIN_S = 30   # of a task that has ended
SCHEDULER_BACK_S = 5.0  # a scheduler that is gone for so long ends the run
TASKS_PER_THREAD = 4  # that wait at the scheduler

_LOST = (OSError, RuntimeError, TimeoutError, concurrent.futures.TimeoutError, concurrent.futures.CancelledError,
         asyncio.CancelledError)

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
    """Task: makes a block on this Dask worker. Returns the answer of its host; an error is an answer, too.
    `run`: name of the run."""
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


def connect(address):
    """Client of a scheduler that has workers. Raises DatasetError."""
    try:
        import distributed
    except ImportError:
        raise DatasetError("expected the Python package distributed for --dask, found none; "
                           "install python3-distributed") from None
    logging.disable(logging.CRITICAL)  # Dask's log of this process: what matters of it becomes an error here
    try:
        # waits as long as Dask's own settings say (distributed.comm.timeouts.connect)
        client = distributed.Client(address)
    except (OSError, ValueError, TimeoutError) as error:
        raise DatasetError(f"--dask: expected a scheduler at {address}, found none: {error}; start dask-scheduler, "
                           "or check the address") from None
    try:
        client.wait_for_workers(1, timeout=WORKERS_WITHIN_S)
    except (OSError, TimeoutError, distributed.TimeoutError):
        disconnect(client)
        raise DatasetError(f"--dask: expected workers at {address}, found none in {WORKERS_WITHIN_S} s; "
                           "start dask-worker") from None
    return client


def disconnect(client):
    """Closes a client; it waits for no scheduler that is gone."""
    try:
        client.close(timeout=2 if client.status == "running" else 0.1)
    except (OSError, RuntimeError, TimeoutError):
        pass


def run_dask(client, options, mark, blocks, progress):
    """Makes blocks on a Dask cluster. Raises DatasetError."""
    run = uuid.uuid4().hex
    try:
        _submit_all(client, (run, options.plan, options.out, options.maker, mark), blocks, progress, options.dask)
    except DatasetError:
        raise
    except _LOST:  # by a call that was on its way
        _check_scheduler(client, options.dask)
        raise _gone(options.dask) from None
    finally:
        try:
            if client.status == "running":
                client.run(close_host, run, on_error="ignore")
        except _LOST:
            pass  # the workers end with their scheduler, and their hosts with them


def _submit_all(client, arguments, blocks, progress, address):
    """`arguments`: of make_block() without the block."""
    blocks, tries = iter(blocks), {}
    flying, done = {}, queue.SimpleQueue()

    def submit(block):
        tries[block] = tries.get(block, 0) + 1
        future = client.submit(make_block, *arguments, block, pure=False,
                               key=f"yars-{arguments[0][:8]}-{block}-{tries[block]}")
        flying[future.key] = block, future
        future.add_done_callback(lambda ended: done.put(ended.key))
    most = max(16, TASKS_PER_THREAD * sum(client.nthreads().values()))
    for block in itertools.islice(blocks, most):
        submit(block)
    while flying:
        key = _next(client, done, address, progress)
        block, future = flying.pop(key)
        answer, error = _result(future)
        if answer:
            check_answer(answer)
            progress.add(answer["items"], answer["redraws"])
            del tries[block]
            for more in itertools.islice(blocks, 1):
                submit(more)
        elif isinstance(error, ModuleNotFoundError):
            raise DatasetError(f"--dask: expected the package yars on the workers, found: {error}; "
                               "install python3-yars there, or set PYTHONPATH for dask-worker")
        elif tries[block] >= MOST_TRIES:
            raise DatasetError(f"block {block}: expected its files, found {tries[block]} failures; "
                               f"the last: {error or type(error).__name__}; see the log of dask-worker")
        else:
            _check_scheduler(client, address)
            submit(block)


def _result(future):
    """(answer, None) of a task that ended, or (None, what went wrong)."""
    try:
        return future.result(timeout=ANSWER_WITHIN_S), None
    except Exception as error:  # pylint: disable=broad-except  of the task or of Dask
        return None, error
    except (concurrent.futures.CancelledError, asyncio.CancelledError) as error:
        return None, error


def _gone(address):
    return DatasetError(f"--dask: expected the scheduler at {address}, found it gone; start dask-scheduler and "
                        "dask-worker again, then run the same command again: what is written stays")


def _next(client, done, address, progress):
    """Key of the next task that ended. Raises DatasetError when the scheduler is gone."""
    while True:
        try:
            return done.get(timeout=0.5)
        except queue.Empty:
            progress.show()
            _check_scheduler(client, address)


def _check_scheduler(client, address):
    """Waits some seconds for a scheduler that does not answer. Raises DatasetError if it stays away."""
    end = time.monotonic() + SCHEDULER_BACK_S
    while client.status != "running":
        if client.status == "closed" or time.monotonic() > end:
            raise _gone(address)
        time.sleep(0.1)
