"""One level of a search: the states of a frontier expanded. Nothing here needs Spark."""

from . import blocks
from .facts import Facts
from .successors import Inconclusive

# States given to the filter at a time: the more, the more duplicates it removes.
BATCH = 100_000

PROPERTIES = {
    1: "no unhandled error",
    2: "assertions",
    3: "vehicles for all picks",
    4: "vehicles for all tasks",
    5: "no halt",
    6: "no leftover tuples",
}
DEADLOCK = 7
INVARIANTS = 8


def broken(number, depth, conditions):
    """(property, depth) where some state of a batch, `depth` transitions deep, or one that follows breaks it."""
    if number < DEADLOCK:
        return PROPERTIES[number], depth + 1
    return ("no deadlock" if number == DEADLOCK else "invariant " + conditions[number - INVARIANTS]), depth


def batches(columns):
    """The columns of some states at a time: lengths, kinds, texts."""
    offsets = columns.offsets()
    for start in range(0, columns.count, BATCH):
        end = min(columns.count, start + BATCH)
        lengths = columns.lengths[start:end]
        first, last = int(offsets[start]), int(offsets[end - 1] + lengths[-1])
        yield start, (lengths.tobytes(), columns.kinds[start:end].tobytes(), columns.texts[first:last].tobytes())


def expand(successors, block, depth, conditions, partitions=1):
    """The successors of the states of `block`, which are `depth` transitions deep: for each partition blocks, each
    without duplicates; and facts."""
    facts, led_to = Facts(), [[] for _ in range(partitions)]
    for _, columns in batches(blocks.Columns.of(block)):
        try:
            answer = successors.ask(*columns, partitions=partitions)
        except Inconclusive as why:
            facts.stopped = str(why)
            break
        facts.transitions += answer.transitions
        for number, digest in answer.broken:
            name, at = broken(number, depth, conditions)
            facts.broken(name, at, digest)
        facts.places.update(answer.places)
        facts.rounds = facts.rounds or answer.rounds
        facts.reaches(answer.unreached)
        facts.trouble = facts.trouble or answer.trouble
        for partition, found in enumerate(answer.blocks):
            if blocks.count(found):
                led_to[partition].append(found)
    return led_to, facts


def edges(successors, block):
    """(digest, digests of its successors) for the states of a block."""
    columns, found = blocks.Columns.of(block), []
    for start, asked in batches(columns):
        answer = successors.ask(*asked, targets=True)
        after = blocks.Columns.of(answer.blocks[0])
        names = [after.digest(i) for i in range(after.count)]
        at = 0
        counts, targets = answer.targets
        for i, n in enumerate(counts):
            found.append((columns.digest(start + i), tuple({names[target] for target in targets[at:at + n]})))
            at += n
    return found
