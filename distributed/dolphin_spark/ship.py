"""Spark, with the files for the machines: the command, the program and its fleet, and this package."""

import os
import sys
import zipfile


def package(scratch):
    """This package, as a file in the folder `scratch` that Python imports from."""
    here = os.path.dirname(os.path.abspath(__file__))
    path = os.path.join(scratch, "dolphin_spark.zip")
    with zipfile.ZipFile(path, "w") as archive:
        for name in sorted(os.listdir(here)):
            if name.endswith(".py"):
                archive.write(os.path.join(here, name), "dolphin_spark/" + name)
    return path


def context(name, master, files, scratch):
    from pyspark import SparkConf, SparkContext
    os.environ.setdefault("PYSPARK_PYTHON", sys.executable)
    conf = SparkConf().setMaster(master).setAppName(name)
    conf.setIfMissing("spark.ui.enabled", "false")
    conf.setIfMissing("spark.ui.showConsoleProgress", "false")
    conf.setIfMissing("spark.driver.bindAddress", "127.0.0.1" if master.startswith("local") else "0.0.0.0")
    # Java moves blocks of bytes: compiling it well costs more than it gains, and its usual collector scatters them.
    for where in ("driver", "executor"):
        conf.setIfMissing("spark.%s.defaultJavaOptions" % where, "-XX:TieredStopAtLevel=1 -XX:+UseParallelGC")
    spark = SparkContext(conf=conf)
    spark.setLogLevel("ERROR")
    spark.addPyFile(package(scratch))
    for path in files:
        spark.addFile(os.path.abspath(path))
    return spark
