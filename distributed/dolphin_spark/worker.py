"""The code on the machines of a cluster: one filter for each process of Python, which lives from task to task."""

import atexit

from . import blocks, files, levels
from .facts import Facts
from .successors import Successors

_filters = {}


def filter_of(job, parts):
    """The filter of `job`, which knows all that `parts`, some broadcasts of parts, have. Only the latest lives."""
    known = _filters.get(job["greeting"])
    if known is None or known.process.poll() is not None:
        while _filters:
            _filters.popitem()[1].process.kill()
        known = Successors(files.command_line(job, "successors"), job["greeting"], job["shown"])
        _filters[job["greeting"]] = known
        atexit.register(known.process.kill)
    for broadcast in parts[known.given:]:
        known.give(broadcast.value)
    return known


def expander(job, depth, parts, told):
    """A function for the partitions of a frontier: blocks for the partitions, and facts into `told`, by place. The
    facts have all parts that states in the blocks may name and that are not among `parts`, including those that this
    process has sent before: they may be lost with the answer of a task."""

    def go(index, items):
        known, together = filter_of(job, parts), Facts()
        for _, (_, block) in items:
            led_to, facts = levels.expand(known, block, depth, job["conditions"], job["partitions"])
            together.add(facts)
            for partition, found in enumerate(led_to):
                for block in found:
                    yield partition, ("block", block)
        together.parts = set(known.told)
        told.add({("facts", index): together})

    return go


def merger(told):
    """A function for a partition of visited states, and of successors of the frontier: it yields the new ones, and
    writes their number into `told`, by partition."""

    def go(index, items):
        runs, found = [], []
        for _, (kind, value) in items:
            (runs if kind == "run" else found).append(value)
        block = blocks.merge(runs, found)
        told.add({("count", index): blocks.count(block)})
        if blocks.count(block):
            yield index, ("new", block)

    return go


def run_of(item):
    """The digests of the states of a block."""
    partition, (_, block) = item
    return partition, ("run", blocks.digests(block))


def runs_of(index, items):
    """The digests in a partition, from states or digests, as one run."""
    runs = [value if kind == "run" else blocks.digests(value) for _, (kind, value) in items]
    return [(index, ("run", blocks.joined(runs)))] if runs else []


def edges_of(job, parts):
    """(digest, digests of its successors) for the states of a level."""

    def go(items):
        known = filter_of(job, parts)
        for _, (_, block) in items:
            yield from levels.edges(known, block)

    return go


def number_of(digest):
    """By which states are spread: evenly, as these are digests."""
    return int.from_bytes(digest[:8], "little")
