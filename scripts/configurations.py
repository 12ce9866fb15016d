"""Tests of configurations in YAML: `unittests`, beside this, has this folder on the path."""

import random
from typing import Any, Callable, Iterator, List, Sequence, Tuple

from dolphin.document import Faulty
from seeds import seeds


def faults_of(read: Callable[[str, str], Any], text: str, path: str) -> List[str]:
    """The faults of a text, without its path, that `read(text, path)` raises."""
    try:
        read(text, path)
    except Faulty as faulty:
        return [line[len(path) + 1:] for line in faulty.lines]
    return []


def mutated(text: str, pieces: Sequence[str]) -> Iterator[Tuple[int, str]]:
    """Mutations of a text, each with its seed: pieces are put in, or take the place of what there is."""
    for seed in seeds(150):
        draw = random.Random(seed)
        found = text
        for _ in range(draw.randint(1, 6)):
            at = draw.randrange(len(found) + 1)
            found = found[:at] + draw.choice(pieces) + found[at + draw.choice([0, 0, 1, 5, 40]):]
        yield seed, found
