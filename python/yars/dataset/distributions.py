"""Uniform draws by counters, and the distributions of a specification. Each turns one uniform draw of [0, 1) into a
value by its inverse distribution function, for whole arrays. `low` and `high` are the ends of what it can give."""
import hashlib
import math
import statistics

import numpy as np

# Philox4x32-10, the counter-based generator of Salmon et al., "Parallel Random Numbers: As Easy as 1, 2, 3" (2011),
# over whole arrays of counters. A draw is a function of (seed, name of the field, item, attempt, number of the draw)
# and of nothing else: fields do not disturb each other, and neither order nor block size changes a value.
# The test compares Random123's known answers.
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


# Wichura, Algorithm AS 241 (PPND16), Applied Statistics 37 (1988) 477-484:
# numerators and denominators, highest power first.
_MIDDLE = np.array(([2509.0809287301226727, 33430.575583588128105, 67265.770927008700853, 45921.953931549871457,
            13731.693765509461125, 1971.5909503065514427, 133.14166789178437745, 3.387132872796366608],
           [5226.495278852854561, 28729.085735721942674, 39307.89580009271061, 21213.794301586595867,
            5394.1960214247511077, 687.1870074920579083, 42.313330701600911252, 1.0]))
_NEAR = np.array(([7.7454501427834140764e-4, 0.0227238449892691845833, 0.24178072517745061177, 1.27045825245236838258,
          3.64784832476320460504, 5.7694972214606914055, 4.6303378461565452959, 1.42343711074968357734],
         [1.05075007164441684324e-9, 5.475938084995344946e-4, 0.0151986665636164571966, 0.14810397642748007459,
          0.68976733498510000455, 1.6763848301838038494, 2.05319162663775882187, 1.0]))
_FAR = np.array(
    ([2.01033439929228813265e-7, 2.71155556874348757815e-5, 0.0012426609473880784386, 0.026532189526576123093,
      0.29656057182850489123, 1.7848265399172913358, 5.4637849111641143699, 6.6579046435011037772],
     [2.04426310338993978564e-15, 1.4215117583164458887e-7, 1.8463183175100546818e-5, 7.868691311456132591e-4,
      0.0148753612908506148525, 0.13692988092273580531, 0.59983220655588793769, 1.0]))


def _ratio(polynomials, x):
    """Both polynomials at once by Horner's rule; their quotient."""
    value = np.multiply.outer(polynomials[:, 0], np.zeros_like(x)) + polynomials[:, 0].reshape((2,) + (1,) * x.ndim)
    for power in range(1, polynomials.shape[1]):
        value = value * x + polynomials[:, power].reshape((2,) + (1,) * x.ndim)
    return value[0] / value[1]


def normal_quantile(p):
    """Inverse of the standard normal distribution function, to about 1e-15; p in (0, 1)."""
    p = np.asarray(p, float)
    q = p - 0.5
    r = 0.180625 - q * q
    middle = q * _ratio(_MIDDLE, r)
    tail = np.sqrt(-np.log(np.clip(np.minimum(p, 1.0 - p), 1e-300, 0.5)))
    near, far = _ratio(_NEAR, tail - 1.6), _ratio(_FAR, tail - 5.0)
    return np.where(np.abs(q) <= 0.425, middle, np.copysign(np.where(tail <= 5.0, near, far), q))


class Fixed:
    kind = "value"

    def __init__(self, value):
        self.value = value

    def ends(self):
        return [self.value]

    def sample(self, u):
        return np.full(np.shape(u), self.value)

    def plain(self):
        return self.value


class Uniform:
    """Equal density in one interval, or in several. A `whole` one gives each integer of its intervals equally often."""
    kind = "uniform"

    def __init__(self, intervals, whole=False):
        self.intervals, self.whole = [tuple(interval) for interval in intervals], whole
        widths = np.array([b - a + bool(whole) for a, b in self.intervals], float)
        if widths.sum() == 0.0:
            widths += 1.0
        self._starts, self._ends = np.array(self.intervals, float).T
        self._widths, self._edges = widths, np.concatenate([[0.0], np.cumsum(widths)])
        self._degenerate = all(a == b for a, b in self.intervals) and not whole

    def ends(self):
        return [self.intervals[0][0], self.intervals[-1][1]]

    def sample(self, u):
        place = np.asarray(u) * self._edges[-1]
        at = np.minimum(np.searchsorted(self._edges, place, "right") - 1, len(self.intervals) - 1)
        if self._degenerate:
            return self._starts[at]
        value = np.minimum(self._starts[at] + (place - self._edges[at]), self._ends[at] + bool(self.whole))
        return np.minimum(np.floor(value), self._ends[at]).astype(np.int64) if self.whole else value

    def plain(self):
        return {"uniform": [list(interval) for interval in self.intervals]}


class LogUniform:
    kind = "log_uniform"

    def __init__(self, low, high):
        self.low, self.high = low, high

    def ends(self):
        return [self.low, self.high]

    def sample(self, u):
        return np.clip(self.low * np.exp(np.asarray(u) * math.log(self.high / self.low)), self.low, self.high)

    def plain(self):
        return {"log_uniform": [self.low, self.high]}


class Normal:
    """Normal, cut off below `low` and above `high`."""
    kind = "normal"

    def __init__(self, mean, deviation, low, high):
        self.mean, self.deviation, self.low, self.high = mean, deviation, low, high
        law = statistics.NormalDist(mean, deviation)
        self._from = law.cdf(low) if math.isfinite(low) else 0.0
        self._to = law.cdf(high) if math.isfinite(high) else 1.0

    @property
    def mass(self):
        """Fraction of the whole curve that lies between the cuts."""
        return self._to - self._from

    def ends(self):
        low, high = self.mean - 9.0 * self.deviation, self.mean + 9.0 * self.deviation
        return [max(self.low, low), min(self.high, high)]

    def sample(self, u):
        p = np.clip(self._from + np.asarray(u) * (self._to - self._from), 1e-17, 1.0 - 2.0**-53)
        return np.clip(self.mean + self.deviation * normal_quantile(p), self.low, self.high)

    def plain(self):
        ends = [end if math.isfinite(end) else None for end in (self.low, self.high)]
        return {"normal": [self.mean, self.deviation], "cut": ends}


class Choice:
    """One of the given values, each with its weight."""

    def __init__(self, values, weights=None):
        self.values = list(values)
        self.weights = [1.0] * len(self.values) if weights is None else [float(weight) for weight in weights]
        self.kind = "choice" if weights is None else "weighted"
        self._edges = np.cumsum(self.weights) / sum(self.weights)
        self._array = np.array(self.values)

    def ends(self):
        return self.values

    def sample(self, u):
        return self._array[self.index(u)]

    def index(self, u):
        return np.minimum(np.searchsorted(self._edges, np.asarray(u), "right"), len(self.values) - 1)

    def plain(self):
        return {"weighted": [[value, weight] for value, weight in zip(self.values, self.weights)]}
