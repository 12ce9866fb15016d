"""The search on one machine, in one process: what is narrow is searched here. Nothing here needs Spark."""

from .facts import Facts
from .levels import expand, merge, record, records
from .successors import Inconclusive, digest


class Local:
    """The levels so far: `levels[d]` has the records of the states that are `d` transitions deep."""

    def __init__(self, successors, conditions):
        self.successors, self.conditions = successors, conditions
        _, initial = successors.ask([b""]).successors[0]
        first = digest(initial)
        self.levels = [record(first, b"\0" * 16, 0, initial)]
        self.seen = {first}
        self.edges = {}
        self.facts = Facts()
        self.states = 1
        self.frontier = 1

    def run(self, width):
        """Goes on until nothing is left, or a level has `width` states."""
        while 0 < self.frontier < width:
            depth = len(self.levels) - 1
            found, facts = expand(self.successors, [self.levels[-1]], depth, self.conditions, self.edges)
            self.facts.add(facts)
            if facts.stopped:
                raise Inconclusive(facts.stopped)
            block, self.frontier = merge(self.seen, [b"".join(found.values())])
            self.states += self.frontier
            if self.frontier:
                self.levels.append(block)

    def find(self, known, depth):
        """The record of a state that is `depth` deep."""
        return next(r for r in records(self.levels[depth]) if r[0] == known)
