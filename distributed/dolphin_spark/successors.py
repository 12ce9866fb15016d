"""A client of `dolphin successors`, whose protocol docs/successors.md has. Nothing here needs Spark."""

import hashlib
import struct
import subprocess

PROPERTIES = {
    1: "no unhandled error",
    2: "assertions",
    3: "vehicles for all tasks",
    4: "no halt",
    5: "no leftover tuples",
}
END = 128
BATCH = 2000


class Inconclusive(Exception):
    """Nobody can list what follows some state."""


def digest(state):
    """The 16 bytes by which a state is known."""
    return hashlib.blake2b(state, digest_size=16).digest()


def pack(states):
    """A batch, as the filter reads it."""
    parts = [struct.pack("<I", len(states))]
    for state in states:
        parts.append(struct.pack("<I", len(state)))
        parts.append(state)
    return b"".join(parts)


class Answer:
    """What follows the states of one batch."""

    __slots__ = ("successors", "expansions", "places", "rounds", "unreached", "trouble")


class Successors:
    """The process that tells what follows states. `greeting`, where given, is what it must say."""

    def __init__(self, command, invariants=0, greeting=None):
        self.invariants = invariants
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=1 << 20)
        self.greeting = self.process.stdout.readline()
        if not self.greeting:
            raise RuntimeError("dolphin successors does not start: see what it printed")
        if greeting is not None and greeting != self.greeting:
            self.close()
            raise RuntimeError("another program, fleet or version of Dolphin is here: %r" % self.greeting)
        self.process.stdin.write(self.greeting)

    def close(self):
        self.process.stdin.close()
        self.process.stdout.close()
        self.process.wait()

    def _bytes(self, n):
        found = self.process.stdout.read(n)
        if len(found) != n:
            raise RuntimeError("dolphin successors ended with status %s" % self.process.wait())
        return found

    def _number(self):
        return int.from_bytes(self._bytes(4), "little")

    def _text(self):
        return self._bytes(self._number())

    def ask(self, states):
        """What follows `states`: (kind, state) for each successor, and (deadlock, transitions, broken invariants,
        places among the successors) for each of `states`."""
        self.process.stdin.write(pack(states))
        self.process.stdin.flush()
        if self._bytes(1) != b"\0":
            raise Inconclusive(self._text().decode())
        answer = Answer()
        read = self.process.stdout.read
        answer.successors = []
        for _ in range(self._number()):
            head = read(5)
            length = int.from_bytes(head[1:], "little")
            answer.successors.append((head[0], read(length)))
        answer.expansions = []
        size = 9 + self.invariants
        for _ in range(self._number()):
            head = read(size)
            count = int.from_bytes(head[-4:], "little")
            targets = struct.unpack("<%dI" % count, read(4 * count))
            answer.expansions.append((head[0], int.from_bytes(head[1:5], "little"), head[5:-4], targets))
        places = self._bytes(32 * self._number())
        answer.places = [(places[i:i + 16], places[i + 16:i + 32]) for i in range(0, len(places), 32)]
        answer.rounds = self._bytes(1) != b"\0"
        answer.unreached = self._text().decode()
        answer.trouble = self._text().decode()
        return answer
