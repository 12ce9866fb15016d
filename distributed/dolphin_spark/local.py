"""The search on one machine, in one process, for narrow levels. Nothing here needs Spark."""

from . import blocks
from .facts import Facts, prune
from .levels import edges, expand
from .successors import Inconclusive


class Local:
    """The levels so far: `levels[d]` is the block of the states that are `d` transitions deep."""

    def __init__(self, successors, conditions):
        self.successors, self.conditions = successors, conditions
        self.levels = [successors.initial()]
        self.seen = Runs()
        self.seen.add(blocks.digests(self.levels[0]))
        self.facts = Facts()
        self.states = 1
        self.frontier = 1

    @property
    def depth(self):
        return len(self.levels) - 1

    @property
    def parts(self):
        return self.successors.told

    def step(self):
        """The next level; False if it has no state."""
        (led_to,), facts = expand(self.successors, self.levels[-1], self.depth, self.conditions)
        self.facts.add(facts)
        if facts.stopped:
            raise Inconclusive(facts.stopped)
        block = blocks.merge(self.seen.runs, led_to)
        self.frontier = blocks.count(block)
        self.states += self.frontier
        if self.frontier:
            self.levels.append(block)
            self.seen.add(blocks.digests(block))
        return self.frontier > 0

    def run(self, width):
        """Goes on until nothing is left, or a level has `width` states."""
        while self.frontier < width and self.step():
            pass

    def find(self, known, depth):
        """The state, `depth` deep, whose digest begins with `known`, and its parent."""
        columns = blocks.Columns.of(self.levels[depth])
        row = columns.find(known)
        return columns.text(row), columns.parents[row].tobytes()

    def may_cycle(self):
        """Whether the state graph has a cycle."""
        return bool(prune(dict(edge for block in self.levels for edge in edges(self.successors, block))))


class Runs:
    """The digests of visited states: few runs, since runs of similar size are merged."""

    def __init__(self):
        self.runs = []

    def add(self, run):
        self.runs.append(run)
        while len(self.runs) > 1 and len(self.runs[-2]) < 2 * len(self.runs[-1]):
            self.runs[-2:] = [blocks.joined(self.runs[-2:])]
