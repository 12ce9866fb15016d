"""The search on Spark: a level at a time. What is new of a level is in the folder of the search, with what it was
reached from, before the next one begins: so a search goes on where it was when the driver was killed, and runs
are read from these files. What is seen stays where it is, by hash; it is checkpointed with each level, so that a
lost worker costs what it was doing."""

import json

from pyspark import StorageLevel

from . import worker
from .facts import Facts
from .levels import number_of, record, records
from .successors import Inconclusive


class Store:
    """The folder of a search, on whatever file system Hadoop knows."""

    def __init__(self, spark, folder):
        self.spark, self.folder = spark, folder.rstrip("/")
        self.fs = spark._jvm.org.apache.hadoop.fs
        self.system = self.path("").getFileSystem(spark._jsc.hadoopConfiguration())

    def name(self, what):
        return "%s/%s" % (self.folder, what)

    def path(self, what):
        return self.fs.Path(self.name(what))

    def exists(self, what):
        return self.system.exists(self.path(what))

    def delete(self, what):
        self.system.delete(self.path(what), True)

    def write(self, what, text):
        """Whole, or not at all."""
        part = self.path(what + ".part")
        stream = self.system.create(part, True)
        stream.write(bytearray(text.encode()))
        stream.close()
        self.delete(what)
        self.system.rename(part, self.path(what))

    def read(self, what):
        return "\n".join(self.spark.textFile(self.name(what), 1).collect())

    def save(self, rdd, what):
        self.delete(what)
        rdd.saveAsPickleFile(self.name(what))

    def load(self, what):
        return self.spark.pickleFile(self.name(what))


class Search:
    """`job` says what is searched; it goes to the machines."""

    def __init__(self, spark, job, store, tell):
        self.spark, self.job, self.store, self.tell = spark, job, store, tell
        self.facts, self.states, self.depth = Facts(), 0, 0
        self.frontier, self.seen = 0, None
        spark.setCheckpointDir(store.name("checkpoints"))

    @staticmethod
    def level(depth):
        return "level-%05d" % depth

    # Beginning, and going on

    def begin(self, local):
        """Takes over what was searched locally."""
        for depth, block in enumerate(local.levels):
            if depth < len(local.levels) - 1:
                self.store.save(self.spark.parallelize([block], 1), self.level(depth))
        self.depth = len(local.levels) - 1
        self.facts, self.states, self.frontier = local.facts, local.states, local.frontier
        parts = self.split(local.levels[-1])
        self.store.save(self.spark.parallelize(parts, max(1, len(parts))), self.level(self.depth))
        self.commit()
        self.take_up()

    def split(self, block):
        """Of about as many states as one task should have at least."""
        each = max(1, min(5000, self.frontier // self.job["partitions"]))
        parts, part = [], []
        for item in records(block):
            part.append(record(*item))
            if len(part) == each:
                parts.append(b"".join(part))
                part = []
        return parts + ([b"".join(part)] if part else [])

    def resume(self):
        """Goes on after the last level that was finished."""
        state = json.loads(self.store.read("search.json"))
        if state["greeting"] != self.job["greeting"].decode():
            raise SystemExit("%s is the search of something else: %s" % (self.store.folder, state["greeting"].strip()))
        self.depth, self.states, self.frontier = state["depth"], state["states"], state["frontier"]
        self.job["partitions"] = state["partitions"]
        self.facts = Facts.of_json(json.dumps(state["facts"]))
        self.take_up()

    def take_up(self):
        job = self.job
        blocks = self.spark.union([self.store.load(self.level(depth)) for depth in range(self.depth + 1)])
        seen = blocks.mapPartitions(lambda blocks: worker.known(job, blocks))
        self.seen = seen.partitionBy(job["partitions"], int).persist(StorageLevel.MEMORY_AND_DISK)

    def commit(self):
        self.store.write("search.json", json.dumps({
            "greeting": self.job["greeting"].decode(), "partitions": self.job["partitions"], "depth": self.depth,
            "states": self.states, "frontier": self.frontier, "facts": json.loads(self.facts.to_json())}))

    # Levels

    def step(self):
        partitions = self.job["partitions"]
        frontier = self.store.load(self.level(self.depth))
        led_to = frontier.mapPartitionsWithIndex(worker.expander(self.job, self.depth)).partitionBy(partitions, int)
        merged = self.seen.union(led_to).mapPartitionsWithIndex(worker.merger(), preservesPartitioning=True)
        merged.persist(StorageLevel.MEMORY_AND_DISK)
        self.store.save(merged.filter(lambda x: x[1][0] == "new").map(lambda x: x[1][1]), self.level(self.depth + 1))
        seen = merged.filter(lambda x: x[1][0] == "seen")
        seen.partitioner = self.seen.partitioner
        seen.checkpoint()
        told = seen.map(lambda x: x[1][1][1:]).collect()
        self.seen.unpersist()
        merged.unpersist()
        self.seen = seen
        for count, facts in told:
            for part in facts:
                self.facts.add(part)
        if self.facts.stopped:
            raise Inconclusive(self.facts.stopped)
        self.frontier = sum(count for count, _ in told)
        if self.frontier:
            self.depth += 1
            self.states += self.frontier
        else:
            self.store.delete(self.level(self.depth + 1))
        self.commit()
        self.tell(self)

    def run(self):
        while self.frontier:
            self.step()

    # Afterwards

    def find(self, known, depth):
        """The record of a state that is `depth` deep."""
        def look(blocks):
            return [r for block in blocks for r in records(block) if r[0] == known]
        return self.store.load(self.level(depth)).mapPartitions(look).first()

    def may_cycle(self):
        """Whether the state graph has a cycle, by taking away what leads nowhere, again and again."""
        job = self.job
        blocks = self.spark.union([self.store.load(self.level(depth)) for depth in range(self.depth + 1)])
        edges = blocks.mapPartitions(worker.edges_of(job))
        left = edges.partitionBy(job["partitions"], number_of).persist(StorageLevel.MEMORY_AND_DISK)
        count = left.filter(lambda x: x[1]).count()
        while count:
            edges = left
            alive = edges.filter(lambda x: x[1]).map(lambda x: (x[0], None))
            wanted = edges.flatMap(lambda x: [(target, x[0]) for target in x[1]])
            kept = wanted.partitionBy(job["partitions"], number_of).join(alive)
            kept = kept.map(lambda x: (x[1][0], x[0]))
            left = kept.groupByKey(job["partitions"], number_of).mapValues(tuple)
            left = left.persist(StorageLevel.MEMORY_AND_DISK)
            left.checkpoint()
            fewer = left.count()
            edges.unpersist()
            if fewer == count:
                return True
            count = fewer
        return False
