"""Seeds of drawn tests: `unittests`, beside this, has this folder on the path."""

import os
import random
from typing import List


def seeds(count: int) -> List[int]:
    """Fixed seeds, and from DOLPHIN_SEED as many new ones."""
    fixed = list(range(count))
    if os.environ.get("DOLPHIN_SEED"):
        new = random.Random(int(os.environ["DOLPHIN_SEED"]))
        fixed += [new.randrange(1 << 30) for _ in range(count)]
    return fixed
