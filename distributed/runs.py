"""Makes many simulated runs of a program on Apache Spark, and summarises them, as dolphin exec --runs does on one
machine. docs/scale.md describes its use."""

import argparse
import subprocess
import sys
import tempfile

from dolphin_spark import files, runs


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", metavar="PROG")
    parser.add_argument("--runs", type=int, required=True, metavar="N", help="how many")
    parser.add_argument("--seed", type=int, default=0, metavar="N", help="of the first run (0)")
    parser.add_argument("--fleet", help="by default the file beside PROG")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE")
    parser.add_argument("--answer", action="append", default=[], metavar="TEXT")
    parser.add_argument("--json", action="store_true", help="print the answer as one JSON object")
    parser.add_argument("--draw", metavar="FILE", help="draw when runs are over, *.svg or *.html")
    parser.add_argument("--dolphin", default="dolphin", help="the command, which is sent to the machines")
    parser.add_argument("--master", default="local[2]", help="of Spark: spark://HOST:7077, yarn, k8s://... (local[2])")
    parser.add_argument("--part", type=int, default=1000, metavar="N",
                        help="runs that a machine makes at a time (1000)")
    a = parser.parse_args()
    if a.runs < 1 or a.part < 1:
        parser.error("--runs and --part are greater than 0")
    return a


def main():
    a = arguments()
    dolphin = files.command(a.dolphin)
    fleet = a.fleet or files.beside(a.program)
    options = ["--set=" + text for text in a.set] + ["--answer=" + text for text in a.answer]
    command = [dolphin, "exec", a.program] + (["--fleet", fleet] if fleet else []) + options
    # One run here: faults of the program, the fleet or the options are reported before Spark begins.
    if subprocess.run(command + ["--runs=1", "--each"], stdout=subprocess.DEVNULL).returncode != 0:
        sys.exit(2)
    told = (["--json"] if a.json else []) + (["--draw", a.draw] if a.draw else [])
    count = subprocess.Popen(command + told + ["--runs-from", "-"], stdin=subprocess.PIPE)
    try:
        make(a, dolphin, fleet, options, count.stdin)
        count.stdin.close()
        status = count.wait()
    except BrokenPipeError:  # it has printed the reason
        status = count.wait()
    except KeyboardInterrupt:
        status = 130
    finally:
        count.kill()
        count.wait()
    sys.exit(status)


def make(a, dolphin, fleet, options, out):
    """Writes the lines of all runs, in the order of their seeds."""
    with tempfile.TemporaryDirectory(prefix="dolphin-") as scratch:
        from dolphin_spark import ship
        spark = ship.context("dolphin exec", a.master, [dolphin, a.program] + ([fleet] if fleet else []), scratch)
        maker = runs.maker(files.job(dolphin, a.program, fleet, options))
        parts = runs.parts(a.seed, a.runs, a.part)
        # In waves, as all lines together may be more than this machine holds.
        wave = 16 * spark.defaultParallelism
        for at in range(0, len(parts), wave):
            some = parts[at:at + wave]
            for lines in spark.parallelize(some, len(some)).map(maker).collect():
                out.write(lines)
            print("%d of %d runs" % (min(a.runs, (at + wave) * a.part), a.runs), file=sys.stderr)


if __name__ == "__main__":
    main()
