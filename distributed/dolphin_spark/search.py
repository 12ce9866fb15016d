"""The search on Spark: a level at a time. The new states of a level, with their predecessors, and the parts named in
them, are written to the folder of the search before the next level begins. So a search continues after the driver was
killed, a lost worker costs only its current work, and runs are read from these files. The digests of visited states
stay on their partitions, by hash."""

import json
import struct

from pyspark import StorageLevel
from pyspark.accumulators import AccumulatorParam

from . import blocks, worker
from .facts import Facts
from .successors import Inconclusive

# Its own partitions determine the place of a state: no shuffle follows.
KEPT = StorageLevel.MEMORY_AND_DISK


class Store:
    """The folder of a search, on any file system known to Hadoop."""

    def __init__(self, spark, folder):
        self.spark, self.folder = spark, folder.rstrip("/")
        self.fs = spark._jvm.org.apache.hadoop.fs
        self.system = self.path("").getFileSystem(spark._jsc.hadoopConfiguration())

    def name(self, what):
        return "%s/%s" % (self.folder, what)

    def path(self, what):
        return self.fs.Path(self.name(what))

    def write(self, what, data):
        """Whole, or not at all."""
        part = self.path(what + ".part")
        stream = self.system.create(part, True)
        stream.write(bytearray(data))
        stream.close()
        self.system.delete(self.path(what), True)
        self.system.rename(part, self.path(what))

    def read(self, what):
        (_, data), = self.spark.binaryFiles(self.name(what), 1).collect()
        return data

    def write_all(self, what, items):
        self.write(what, b"".join(struct.pack("<Q", len(item)) + item for item in items))

    def read_all(self, what):
        data, at, items = self.read(what), 0, []
        while at < len(data):
            size, = struct.unpack_from("<Q", data, at)
            items.append(data[at + 8:at + 8 + size])
            at += 8 + size
        return items


class Told(AccumulatorParam):
    """The reports of tasks, by kind and place. A task that is repeated, because its result was lost, reports the same
    again."""

    def zero(self, value):
        return {}

    def addInPlace(self, one, other):
        one.update(other)
        return one


class Search:
    """`job` is the subject of the search; it is sent to the machines. `successors` is a filter here. A level is pairs
    of a partition and ("new", block)."""

    def __init__(self, spark, job, store, tell, successors):
        self.spark, self.job, self.store, self.tell, self.successors = spark, job, store, tell, successors
        self.facts, self.states, self.depth, self.frontier = Facts(), 0, 0, 0
        self.narrow = []  # the blocks of the levels that were searched locally, but for the last
        self.files = []  # of the levels after these
        self.level = None  # the last
        self.seen = []  # (runs, number of states)
        self.stale = []  # what is needed no more once the next level is there
        self.parts = set()
        self.told = []  # the files of parts
        self.broadcasts = []
        spark.setCheckpointDir(store.name("levels"))

    # Beginning, and going on

    def begin(self, local):
        """Takes over the levels searched locally."""
        self.narrow = local.levels[:-1]
        self.depth, self.facts, self.states, self.frontier = local.depth, local.facts, local.states, local.frontier
        self.store.write_all("narrow", self.narrow)
        self.add_parts(self.successors.told)
        self.add_seen(self.spread(self.narrow), self.states - self.frontier)
        self.add_level(self.spread(local.levels[-1:]))
        self.add_seen(self.level, self.frontier)
        self.commit()

    def spread(self, some):
        """The states of these blocks where they belong."""
        split = [(p, ("new", part.block())) for block in some
                 for p, part in blocks.by_partition(blocks.Columns.of(block), self.job["partitions"])]
        return self.placed(self.spark.parallelize(split, max(1, min(len(split), self.job["partitions"]))))

    def placed(self, rdd):
        placed = rdd.partitionBy(self.job["partitions"], int)
        # It reads the same. Where serializers differ, a union sends all of it through Python once more.
        placed._jrdd_deserializer = self.spark.serializer
        return placed

    def resume(self):
        """Goes on after the last level that was finished."""
        state = json.loads(self.store.read("search.json"))
        if state["greeting"] != self.job["greeting"].decode():
            raise SystemExit("%s is the search of something else: %s" % (self.store.folder, state["greeting"].strip()))
        self.depth, self.states, self.frontier = state["depth"], state["states"], state["frontier"]
        self.job["partitions"] = state["partitions"]
        self.facts = Facts.of_json(json.dumps(state["facts"]))
        self.files, told = state["levels"], state["parts"]
        self.narrow = self.store.read_all("narrow")
        for what in told:
            self.share(self.store.read_all(what))
        self.told = told
        self.level = self.load(self.files[-1])
        digests = [self.load(path).map(worker.run_of) for path in self.files]
        self.add_seen(self.spark.union([self.spread(self.narrow), self.placed(self.spark.union(digests))]), self.states)

    def load(self, path):
        return self.spark._checkpointFile(self.store.name(path), self.spark.serializer)

    def add_level(self, level):
        """`level` is in the folder from now on."""
        level.persist(KEPT)
        level.checkpoint()
        level._jrdd.count()  # without Python
        if self.level is not None:
            self.level.unpersist()
        for rdd in self.stale:
            rdd.unpersist()
        self.stale = []
        self.level = level
        self.files.append("/".join(["levels"] + level.getCheckpointFile().split("/")[-2:]))

    def add_seen(self, states, count):
        """`states`, or digests, are seen. Runs of like size are joined, so that there are few."""
        together = [states]
        while self.seen and self.seen[-1][1] < 2 * count:
            runs, n = self.seen.pop()
            together.append(runs)
            self.stale.append(runs)
            count += n
        runs = self.spark.union(together).mapPartitionsWithIndex(worker.runs_of, preservesPartitioning=True)
        self.seen.append((runs.persist(KEPT), count))

    def add_parts(self, parts):
        """Parts that states of the last level name are known to all before it is finished."""
        new = sorted(set(parts) - self.parts)
        if new:
            self.told.append("parts-%05d" % self.depth)
            self.store.write_all(self.told[-1], new)
            self.share(new)
            self.successors.ask()  # it finds parts of the same name

    def share(self, parts):
        self.parts.update(parts)
        self.broadcasts.append(self.spark.broadcast(parts))
        self.successors.give(parts)

    def commit(self):
        self.store.write("search.json", json.dumps({
            "greeting": self.job["greeting"].decode(), "partitions": self.job["partitions"], "depth": self.depth,
            "states": self.states, "frontier": self.frontier, "levels": self.files, "parts": self.told,
            "facts": json.loads(self.facts.to_json())}).encode())

    # Levels

    def step(self):
        told = self.spark.accumulator({}, Told())
        go = worker.expander(self.job, self.depth, self.broadcasts, told)
        led_to = self.placed(self.level.mapPartitionsWithIndex(go))
        together = self.spark.union([runs for runs, _ in self.seen] + [led_to])
        assert together.getNumPartitions() == self.job["partitions"]
        self.add_level(together.mapPartitionsWithIndex(worker.merger(told), preservesPartitioning=True))
        self.frontier = 0
        for (what, _), value in told.value.items():
            if what == "facts":
                self.facts.add(value)
            else:
                self.frontier += value
        if self.facts.stopped:
            raise Inconclusive(self.facts.stopped)
        if self.frontier:
            self.depth += 1
            self.states += self.frontier
            self.add_parts(self.facts.parts)
            self.add_seen(self.level, self.frontier)
        else:
            self.files.pop()
        self.facts.parts = set()
        self.commit()
        self.tell(self)

    def run(self):
        while self.frontier:
            self.step()

    # Afterwards

    def find(self, known, depth):
        """The state, `depth` deep, whose digest begins with `known`, and its parent."""
        def look(items):
            for _, (_, block) in items:
                columns = blocks.Columns.of(block)
                row = columns.find(known)
                if row is not None:
                    yield columns.text(row), columns.parents[row].tobytes()
        if depth < len(self.narrow):
            return next(look([(0, ("new", self.narrow[depth]))]))
        return self.load(self.files[depth - len(self.narrow)]).mapPartitions(look).first()

    def may_cycle(self):
        """Whether the state graph has a cycle, by repeatedly removing states without successors."""
        partitions = self.job["partitions"]
        narrow = self.spark.parallelize([(0, ("new", block)) for block in self.narrow])
        levels = self.spark.union([narrow] + [self.load(path) for path in self.files])
        edges = levels.mapPartitions(worker.edges_of(self.job, self.broadcasts))
        left = edges.partitionBy(partitions, worker.number_of).persist(KEPT)
        count = left.filter(lambda x: x[1]).count()
        while count:
            edges = left
            alive = edges.filter(lambda x: x[1]).map(lambda x: (x[0], None))
            wanted = edges.flatMap(lambda x: [(target, x[0]) for target in x[1]])
            kept = wanted.partitionBy(partitions, worker.number_of).join(alive)
            kept = kept.map(lambda x: (x[1][0], x[0]))
            left = kept.groupByKey(partitions, worker.number_of).mapValues(tuple)
            left = left.persist(KEPT)
            left.checkpoint()
            fewer = left.count()
            edges.unpersist()
            if fewer == count:
                return True
            count = fewer
        return False
