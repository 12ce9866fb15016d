"""What runs on the machines of a cluster: one filter for each process of Python, which lives from task to task."""

import atexit

from . import blocks, files, levels
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


def expander(job, depth, parts):
    """A function for the partitions of a frontier: blocks for the partitions, and facts for that of the same number.
    The facts have all parts that states in the blocks may name and that are not among `parts`, whichever of them this
    process has told before: what some task told may be lost with its answer."""

    def go(index, items):
        known = filter_of(job, parts)
        for _, (kind, block) in items:
            if kind == "new":
                led_to, facts = levels.expand(known, block, depth, job["conditions"], job["partitions"])
                facts.parts = set(known.told)
                for partition, found in enumerate(led_to):
                    for block in found:
                        yield partition, ("block", block)
                yield index % job["partitions"], ("facts", facts)

    return go


def merger():
    """A function for a partition of what is seen, and of what the frontier leads to."""

    def go(index, items):
        runs, found, facts = [], [], []
        for _, (kind, value) in items:
            {"run": runs, "block": found, "facts": facts}[kind].append(value)
        block = blocks.merge(runs, found)
        yield index, ("told", (blocks.count(block), facts))
        if blocks.count(block):
            yield index, ("new", block)

    return go


def runs_of(items):
    """The digests of what is new in a partition."""
    return [(partition, ("run", blocks.digests(block))) for partition, (kind, block) in items if kind == "new"]


def joined(index, items):
    runs = [run for _, (_, run) in items]
    return [(index, ("run", blocks.joined(runs)))] if runs else []


def edges_of(job, parts):
    """(digest, digests of what follows it) for the states of a level."""

    def go(items):
        known = filter_of(job, parts)
        for _, (kind, block) in items:
            if kind == "new":
                yield from levels.edges(known, block)

    return go


def number_of(digest):
    """By which states are spread: evenly, as these are digests."""
    return int.from_bytes(digest[:8], "little")
