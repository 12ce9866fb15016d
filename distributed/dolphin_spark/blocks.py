"""States in columns, as `dolphin successors` writes them, handled many at a time. A block is bytes; a run is the
digests of some states, in order, without their texts. Nothing here needs Spark."""

import numpy

from .successors import LONG

END = 128
WORD = numpy.dtype("<u8")
LENGTH = numpy.dtype("<u4")
NOTHING = LONG.pack(0)  # the block of no state


class Columns:
    """A block, its columns side by side. A digest is known by its first and its last 8 bytes."""

    __slots__ = ("count", "firsts", "seconds", "parents", "lengths", "kinds", "texts")

    def __init__(self, firsts, seconds, parents, lengths, kinds, texts):
        self.count = len(firsts)
        self.firsts, self.seconds, self.parents = firsts, seconds, parents
        self.lengths, self.kinds, self.texts = lengths, kinds, texts

    @staticmethod
    def of(block):
        n = count(block)

        def column(at, kind):
            return numpy.frombuffer(block, kind, n, at)

        return Columns(column(8, WORD), column(8 + 8 * n, WORD), column(8 + 16 * n, WORD), column(8 + 24 * n, LENGTH),
                       column(8 + 28 * n, numpy.uint8), numpy.frombuffer(block, numpy.uint8, offset=8 + 29 * n))

    @staticmethod
    def of_all(blocks):
        """One after the other."""
        columns = [Columns.of(block) for block in blocks]
        if len(columns) == 1:
            return columns[0]
        return Columns(*(numpy.concatenate([getattr(c, name) for c in columns]) for name in Columns.__slots__[1:]))

    def block(self):
        return b"".join([LONG.pack(self.count)] + [memoryview(numpy.ascontiguousarray(getattr(self, name))).cast("B")
                                                   for name in self.__slots__[1:] if self.count])

    def offsets(self):
        """The start of each text."""
        ends = numpy.cumsum(self.lengths, dtype=numpy.int64)
        return ends - self.lengths

    def taken(self, rows):
        """The states of these rows."""
        lengths = self.lengths[rows]
        return Columns(self.firsts[rows], self.seconds[rows], self.parents[rows], lengths, self.kinds[rows],
                       gathered(self.texts, self.offsets()[rows], lengths))

    def text(self, row):
        at = int(self.offsets()[row])
        return self.texts[at:at + int(self.lengths[row])].tobytes()

    def digest(self, row):
        return self.firsts[row].tobytes() + self.seconds[row].tobytes()

    def find(self, known):
        """The row of the state whose digest begins with `known`, of 8 or 16 bytes, or None."""
        rows = numpy.flatnonzero(self.firsts == numpy.frombuffer(known, WORD, 1))
        if len(known) > 8:
            rows = rows[self.seconds[rows] == numpy.frombuffer(known, WORD, 1, 8)]
        return int(rows[0]) if len(rows) else None


def count(block):
    return LONG.unpack_from(block)[0]


def gathered(texts, offsets, lengths):
    """The texts of these lengths that begin there, one after the other: those of one length at a time."""
    into = numpy.cumsum(lengths, dtype=numpy.int64)
    result = numpy.empty(int(into[-1]) if len(into) else 0, numpy.uint8)
    into = into - lengths
    order = numpy.argsort(lengths, kind="stable")
    ends = numpy.append(numpy.flatnonzero(numpy.diff(lengths[order])) + 1, len(order))
    start = 0
    for end in ends if len(order) else ():
        rows, length = order[start:end], int(lengths[order[start]])
        if length:
            windows(result, length)[into[rows]] = windows(texts, length)[offsets[rows]]
        start = end
    return result


def windows(array, length):
    """Row i is the `length` bytes from place i on."""
    shape = (len(array) - length + 1, length)
    return numpy.lib.stride_tricks.as_strided(array, shape, (1, 1))


def partition_of(columns, partitions):
    """The partition of each state, as given by the filter."""
    return (columns.seconds >> numpy.uint64(32)) % numpy.uint64(partitions)


def by_partition(columns, partitions):
    """The states of each partition that has any."""
    of = partition_of(columns, partitions)
    return [(int(p), columns.taken(numpy.flatnonzero(of == p))) for p in numpy.unique(of)]


def distinct(firsts, seconds):
    """An order of digests, and the places where groups of equal ones begin."""
    order = numpy.argsort(firsts)

    def compared():
        f, s = firsts[order], seconds[order]
        return f[1:] == f[:-1], s[1:] == s[:-1]

    alike, equal = compared()
    if numpy.any(alike & ~equal):  # two states whose digests begin alike
        order = numpy.lexsort((seconds, firsts))
        alike, equal = compared()
    begins = numpy.ones(len(order), bool)
    begins[1:] = ~(alike & equal)
    return order, numpy.flatnonzero(begins)


def run_of(firsts, seconds):
    """Digests as a run, each once."""
    order, starts = distinct(firsts, seconds)
    rows = order[starts]
    return firsts[rows].tobytes() + seconds[rows].tobytes()


def halves(run):
    n = len(run) // 16
    return numpy.frombuffer(run, WORD, n), numpy.frombuffer(run, WORD, n, 8 * n)


def joined(runs):
    """One run of all of them."""
    if len(runs) == 1:
        return runs[0]
    parts = [halves(run) for run in runs]
    firsts, seconds = (numpy.concatenate([part[i] for part in parts]) for i in (0, 1))
    return run_of(firsts, seconds)


def are_in(run, firsts, seconds):
    """Whether each of these digests is in `run`."""
    its_firsts, its_seconds = halves(run)
    if not len(its_firsts):
        return numpy.zeros(len(firsts), bool)
    places = numpy.searchsorted(its_firsts, firsts)
    places[places == len(its_firsts)] = 0
    alike = its_firsts[places] == firsts
    known = alike & (its_seconds[places] == seconds)
    for i in numpy.flatnonzero(alike & ~known):  # seldom: others whose digests begin alike
        place = places[i]
        while place < len(its_firsts) and its_firsts[place] == firsts[i]:
            known[i] |= its_seconds[place] == seconds[i]
            place += 1
    return known


def merge(runs, blocks):
    """The states of `blocks` that are in none of the `runs`, as a block: each once, by digest, with the least of its
    parents, so that it is the same whatever comes first."""
    found = Columns.of_all(blocks) if blocks else Columns.of(NOTHING)
    if not found.count:
        return NOTHING
    order, starts = distinct(found.firsts, found.seconds)
    parents = numpy.minimum.reduceat(found.parents[order], starts)
    rows = order[starts]
    firsts, seconds = found.firsts[rows], found.seconds[rows]
    is_new = numpy.ones(len(rows), bool)
    for run in runs:
        is_new &= ~are_in(run, firsts, seconds)
    new = found.taken(rows[is_new])
    new.parents = parents[is_new]
    return new.block()


def digests(block):
    """The run of the states of a block that is in order."""
    n = count(block)
    return block[8:8 + 16 * n]
