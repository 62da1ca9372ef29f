"""Philox4x32-10, the counter-based generator of Salmon et al., "Parallel Random Numbers: As Easy as 1, 2, 3" (2011),
over whole arrays of counters.

A draw is a function of (seed, name of the field, item, attempt, number of the draw) and of nothing else: fields do not
disturb each other, and neither order nor block size changes a value. The test compares Random123's known answers."""
import hashlib

import numpy as np

_MULTIPLY = (np.uint64(0xD2511F53), np.uint64(0xCD9E8D57))
_WEYL = (0x9E3779B9, 0xBB67AE85)
_LOW, _SHIFT = np.uint64(0xFFFFFFFF), np.uint64(32)
_ROUNDS = 10


def philox4x32(counter, key):
    """Four words of 32 bits, in uint64 arrays. `counter`: four, `key`: two uint64 arrays of words that broadcast."""
    c0, c1, c2, c3 = counter
    k0, k1 = key
    for step in range(_ROUNDS):
        a, b = c0 * _MULTIPLY[0], c2 * _MULTIPLY[1]
        r0 = (k0 + np.uint64(step * _WEYL[0] & 0xFFFFFFFF)) & _LOW
        r1 = (k1 + np.uint64(step * _WEYL[1] & 0xFFFFFFFF)) & _LOW
        c0, c1, c2, c3 = (b >> _SHIFT) ^ c1 ^ r0, b & _LOW, (a >> _SHIFT) ^ c3 ^ r1, a & _LOW
    return c0, c1, c2, c3


def field_key(seed, name):
    """Key of a field's stream: a hash of seed and name, two words of 32 bits."""
    digest = hashlib.blake2b(f"{seed}/{name}".encode(), digest_size=8).digest()
    return int.from_bytes(digest[:4], "little"), int.from_bytes(digest[4:], "little")


class Streams:
    """Uniform draws of named fields. `uniform` returns values in [0, 1) with 53 random bits."""

    def __init__(self, seed, names):
        self.names = tuple(names)
        self.row = {name: at for at, name in enumerate(self.names)}
        keys = np.array([field_key(seed, name) for name in self.names], np.uint64).reshape(-1, 2)
        self._keys = keys[:, 0, None], keys[:, 1, None]

    def uniform(self, items, attempt=0, draw=0):
        """Array (fields, items). `items`: int array, below 2^64. `draw`: scalar or array like `items`."""
        items = np.asarray(items, np.uint64)
        shape = np.broadcast(items, np.asarray(draw)).shape
        words = (np.broadcast_to(items & _LOW, shape), items >> _SHIFT, np.uint64(attempt), np.asarray(draw, np.uint64))
        high, low, _, _ = philox4x32(words, self._keys)
        return ((high >> np.uint64(5)) * 67108864.0 + (low >> np.uint64(6))) / 9007199254740992.0
