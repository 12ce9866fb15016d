"""One level of a search: the states of a frontier expanded, and what is new among what they lead to. States travel as
records in blocks of bytes. Nothing here needs Spark."""

import struct

from .facts import Facts
from .successors import BATCH, END, PROPERTIES, Inconclusive, digest

HEAD = struct.Struct("<16s16sBI")


def record(known, parent, kind, state):
    return HEAD.pack(known, parent, kind, len(state)) + state


def records(block):
    """(digest, parent's digest, kind, state) of each record."""
    at, end, size, unpack = 0, len(block), HEAD.size, HEAD.unpack_from
    while at < end:
        known, parent, kind, length = unpack(block, at)
        at += size
        yield known, parent, kind, block[at:at + length]
        at += length


def number_of(known):
    """By which states are spread: evenly, as these are digests."""
    return int.from_bytes(known[:8], "little")


def partition_of(known, count):
    return number_of(known) % count


def batches(states, size=BATCH):
    batch = []
    for item in states:
        batch.append(item)
        if len(batch) == size:
            yield batch
            batch = []
    if batch:
        yield batch


def expand(successors, blocks, depth, conditions, edges=None):
    """What follows the states of `blocks`, which are `depth` transitions deep: records by digest, each state once, and
    facts. `edges`, where given, gets the digests of what follows each state."""
    facts, found = Facts(), {}
    states = ((known, state) for block in blocks for known, _, kind, state in records(block) if not kind & END)
    if conditions:
        states = ((known, state) for block in blocks for known, _, _, state in records(block))
    for batch in batches(states):
        try:
            answer = successors.ask([state for _, state in batch])
        except Inconclusive as why:
            facts.stopped = str(why)
            break
        digests = [digest(state) for _, state in answer.successors]
        reached = 0
        for (known, _), (deadlock, transitions, invariants, targets) in zip(batch, answer.expansions):
            facts.transitions += transitions
            if deadlock:
                facts.broken("no deadlock", depth, known)
            for condition, is_broken in zip(conditions, invariants):
                if is_broken:
                    facts.broken("invariant " + condition, depth, known)
            if edges is not None:
                edges[known] = [digests[i] for i in targets]
            # Successors are numbered in the order in which they are reached.
            for i in range(reached, max(targets, default=-1) + 1):
                kind, state = answer.successors[i]
                key = digests[i]
                if kind & ~END:
                    facts.broken(PROPERTIES[kind & ~END], depth + 1, key)
                if key not in found:
                    found[key] = record(key, known, kind, state)
                reached = i + 1
        facts.places.update(answer.places)
        facts.rounds = facts.rounds or answer.rounds
        facts.reaches(answer.unreached)
        facts.trouble = facts.trouble or answer.trouble
    return found, facts


def by_partition(found, count):
    """The records of `found` as a block for each partition that gets any."""
    parts = {}
    for known, text in found.items():
        parts.setdefault(partition_of(known, count), []).append(text)
    return [(partition, b"".join(texts)) for partition, texts in parts.items()]


def merge(seen, blocks):
    """The records of `blocks` whose states are not among `seen`, a set of digests that they are added to: each once,
    with the least of its parents, so that it is the same whatever comes first."""
    new = {}
    for block in blocks:
        for known, parent, kind, state in records(block):
            if known in seen:
                continue
            other = new.get(known)
            if other is None or parent < other[0]:
                new[known] = (parent, kind, state)
    seen.update(new)
    return b"".join(record(known, parent, kind, state) for known, (parent, kind, state) in new.items()), len(new)
