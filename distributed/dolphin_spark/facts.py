"""The results of a search, combined from those of its parts. Nothing here needs Spark."""

import json


class Facts:
    """`stopped` is why the search goes no further, or "". `first` has, by property, the least (depth, digest) of a
    state that violates it: one that this many transitions reach. `parts` are the parts named by states."""

    def __init__(self):
        self.transitions = 0
        self.first = {}
        self.places = set()
        self.rounds = False
        self.unreached = None
        self.trouble = ""
        self.stopped = ""
        self.parts = set()

    def broken(self, name, depth, digest):
        known = self.first.get(name)
        if known is None or (depth, digest) < known:
            self.first[name] = (depth, digest)

    def reaches(self, unreached):
        lines = set(unreached)
        self.unreached = lines if self.unreached is None else self.unreached & lines

    def add(self, other):
        self.transitions += other.transitions
        for name, (depth, digest) in other.first.items():
            self.broken(name, depth, digest)
        self.places |= other.places
        self.rounds = self.rounds or other.rounds
        if other.unreached is not None:
            self.unreached = other.unreached if self.unreached is None else self.unreached & other.unreached
        self.trouble = self.trouble or other.trouble
        self.stopped = self.stopped or other.stopped
        self.parts |= other.parts

    def to_json(self):
        return json.dumps({
            "transitions": self.transitions,
            "first": {name: [depth, digest.hex()] for name, (depth, digest) in sorted(self.first.items())},
            "places": sorted([a.hex(), b.hex()] for a, b in self.places),
            "rounds": self.rounds,
            "unreached": None if self.unreached is None else sorted(self.unreached),
            "trouble": self.trouble,
        })

    @staticmethod
    def of_json(text):
        members = json.loads(text)
        facts = Facts()
        facts.transitions = members["transitions"]
        facts.first = {name: (depth, bytes.fromhex(d)) for name, (depth, d) in members["first"].items()}
        facts.places = {(bytes.fromhex(a), bytes.fromhex(b)) for a, b in members["places"]}
        facts.rounds = members["rounds"]
        facts.unreached = None if members["unreached"] is None else set(members["unreached"])
        facts.trouble = members["trouble"]
        return facts


def prune(following):
    """The rest of a graph's nodes after nodes without successors are removed repeatedly: empty if and only if the graph
    has no cycle. `following` has the successors of each node."""
    count = {node: len(nodes) for node, nodes in following.items()}
    before = {}
    for node, nodes in following.items():
        for other in nodes:
            before.setdefault(other, []).append(node)
            count.setdefault(other, 0)
    ends = [node for node, n in count.items() if n == 0]
    while ends:
        node = ends.pop()
        del count[node]
        for other in before.get(node, ()):
            count[other] -= 1
            if count[other] == 0:
                ends.append(other)
    return set(count)


def places_may_cycle(places):
    following = {}
    for place, after in places:
        following.setdefault(place, set()).add(after)
    return bool(prune({place: list(after) for place, after in following.items()}))
