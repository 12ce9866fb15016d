"""The files of a job: their paths here, and on the machines that receive them."""

import os
import shutil
import stat
import sys


def command(name):
    """The path of the command `name`; ends the script if there is none."""
    return os.path.abspath(shutil.which(name) or sys.exit("there is no %s: --dolphin says where it is" % name))


def beside(program):
    """The fleet beside `program`, or None."""
    fleet = os.path.splitext(program)[0] + ".fleet"
    return fleet if os.path.exists(fleet) else None


def job(dolphin, program, fleet, options):
    """The settings with which machines run `dolphin COMMAND program` with these options."""
    return {"dolphin": os.path.basename(dolphin), "program": os.path.basename(program),
            "fleet": os.path.basename(fleet) if fleet else None, "options": options}


def command_line(job, name):
    """The command `name` of Dolphin on a machine, with the files where Spark has put them."""
    from pyspark import SparkFiles
    dolphin = SparkFiles.get(job["dolphin"])
    os.chmod(dolphin, os.stat(dolphin).st_mode | stat.S_IXUSR)
    fleet = ["--fleet", SparkFiles.get(job["fleet"])] if job["fleet"] else []
    return [dolphin, name, SparkFiles.get(job["program"])] + fleet + job["options"]
