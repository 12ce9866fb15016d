"""What runs on the machines of a cluster: one filter for each process of Python, which lives from task to task."""

import atexit

from . import files
from .levels import by_partition, expand, merge, records
from .successors import Successors

_filters = {}


def filter_of(job):
    known = _filters.get(job["greeting"])
    if known is None or known.process.poll() is not None:
        known = Successors(files.command_line(job, "successors"), len(job["conditions"]), job["greeting"])
        _filters[job["greeting"]] = known
        atexit.register(known.process.kill)
    return known


def expander(job, depth):
    """A function for the partitions of a frontier: blocks for the partitions, and facts for that of the same number."""

    def go(index, blocks):
        found, facts = expand(filter_of(job), blocks, depth, job["conditions"])
        for partition, block in by_partition(found, job["partitions"]):
            yield partition, ("block", block)
        yield index % job["partitions"], ("facts", facts)

    return go


def merger():
    """A function for a partition of what is seen, and of what the frontier leads to."""

    def go(index, items):
        seen, blocks, facts = set(), [], []
        for _, (kind, value) in items:
            if kind == "seen":
                text = value[0]
                seen.update(text[i:i + 16] for i in range(0, len(text), 16))
            elif kind == "block":
                blocks.append(value)
            else:
                facts.append(value)
        block, count = merge(seen, blocks)
        yield index, ("seen", (b"".join(seen), count, facts))
        if count:
            yield index, ("new", block)

    return go


def known(job, blocks):
    """The digests of the states of `blocks`, by partition."""
    found = {digest: digest for block in blocks for digest, _, _, _ in records(block)}
    return [(partition, ("seen", (text, 0, []))) for partition, text in by_partition(found, job["partitions"])]


def edges_of(job):
    """(digest, digests of what follows it) for the states of a frontier."""

    def go(blocks):
        edges = {}
        expand(filter_of(job), blocks, 0, [], edges)
        return [(known, tuple(set(targets))) for known, targets in edges.items()]

    return go
