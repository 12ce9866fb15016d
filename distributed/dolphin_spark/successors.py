"""A client of `dolphin successors`; docs/successors.md describes the protocol. Nothing here needs Spark."""

import hashlib
import struct
import subprocess

NUMBER = struct.Struct("<I")
LONG = struct.Struct("<Q")


class Inconclusive(Exception):
    """The successors of some state cannot be listed."""


def digest(state):
    """The 16 bytes by which a state is known."""
    return hashlib.md5(state).digest()


def text(data):
    return NUMBER.pack(len(data)) + data


def batch(lengths, kinds, texts, parts=(), partitions=1, targets=False):
    """A batch, as the filter reads it: the columns of some states, and parts that they name."""
    head = [struct.pack("<IB", partitions, targets), NUMBER.pack(len(parts))]
    head += [text(part) for part in parts]
    return b"".join(head) + NUMBER.pack(len(lengths) // 4) + lengths + kinds + texts


def run(states, parts):
    """A batch of the states of a run, for `--run`."""
    lengths = b"".join(NUMBER.pack(len(state)) for state in states)
    return batch(lengths, bytes(len(states)), b"".join(states), parts)


class Answer:
    """The successors of one batch of states. `broken` has (number, digest); `blocks` a block of states for each
    partition; `targets`, if requested, the number of transitions of each state, and their targets."""

    __slots__ = ("transitions", "rounds", "broken", "places", "unreached", "trouble", "blocks", "targets")


class Successors:
    """The process that computes successors: `dolphin successors` with a program, and options. `greeting`, if given, is
    the greeting that it must send; `shown` is the path of the program as others see it. `told` has the parts that it
    has sent and was not given since: others may not know them."""

    def __init__(self, command, greeting=None, shown=None):
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=1 << 20)
        self.greeting = self.process.stdout.readline()
        if not self.greeting:
            raise RuntimeError("dolphin successors does not start: see what it printed")
        if greeting is not None and greeting != self.greeting:
            self.close()
            raise RuntimeError("another program, fleet or version of Dolphin is here: %r" % self.greeting)
        self.process.stdin.write(self.greeting)
        self.told, self.waiting, self.given = set(), [], 0
        self.path, self.shown = command[2], shown or command[2]

    def close(self):
        self.process.stdin.close()
        self.process.stdout.close()
        self.process.wait()

    def give(self, parts):
        """Others know `parts` now, and so does this process from the next batch on."""
        self.waiting.extend(parts)
        self.told.difference_update(parts)
        self.given += 1

    def _bytes(self, n):
        found = self.process.stdout.read(n)
        if len(found) != n:
            raise RuntimeError("dolphin successors ended with status %s" % self.process.wait())
        return found

    def _number(self):
        return NUMBER.unpack(self._bytes(4))[0]

    def _long(self):
        return LONG.unpack(self._bytes(8))[0]

    def _text(self):
        return self._bytes(self._number())

    def _seen(self, place):
        """A place of the program, the same in all processes."""
        return self.shown + place[len(self.path):] if place.startswith(self.path + ":") else place

    def ask(self, lengths=b"", kinds=b"", texts=b"", partitions=1, targets=False):
        """The successors of the states of these columns."""
        count = len(lengths) // 4
        self.process.stdin.write(batch(lengths, kinds, texts, self.waiting, partitions, targets))
        self.process.stdin.flush()
        self.waiting = []
        if self._bytes(1) != b"\0":
            raise Inconclusive(self._text().decode())
        answer = Answer()
        answer.transitions = self._long()
        answer.rounds = self._bytes(1) != b"\0"
        answer.broken = [(self._number(), self._bytes(16)) for _ in range(self._number())]
        places = self._bytes(32 * self._number())
        answer.places = [(places[i:i + 16], places[i + 16:i + 32]) for i in range(0, len(places), 32)]
        answer.unreached = [self._seen(line) for line in self._text().decode().splitlines()]
        answer.trouble = self._text().decode()
        self.told.update(self._text() for _ in range(self._number()))
        answer.blocks = [self._bytes(self._long()) for _ in range(partitions)]
        answer.targets = None
        if targets:
            counts = struct.unpack("<%dI" % count, self._bytes(4 * count))
            answer.targets = counts, struct.unpack("<%dI" % sum(counts), self._bytes(4 * sum(counts)))
        return answer

    def initial(self):
        """The block of the initial state."""
        return self.ask(bytes(4), bytes(1)).blocks[0]
