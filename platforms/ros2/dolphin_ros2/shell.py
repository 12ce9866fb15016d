"""The process: options, the adapter, and its end."""

from __future__ import annotations

import argparse
import asyncio
import json
import sys
from typing import Awaitable, List, Optional, Sequence

import dolphin
from dolphin.document import Faulty

from . import configuration_file, interfaces, version
from .configuration import Configuration
from .inputs import Inputs
from .outputs import Outputs
from .robot import Robot

DESCRIPTION = """Dolphin's adapter for ROS 2 robots:
dolphin exec mission.dol --platform 'dolphin-ros2 --config robots.yaml'.
docs/ros2.md describes the configuration. ROS_DOMAIN_ID, ROS_AUTOMATIC_DISCOVERY_RANGE, RMW_IMPLEMENTATION and ROS's
other variables have their usual meaning."""


class Robots(dolphin.Adapter):
    """The robots of a configuration."""

    def __init__(self, configured: Configuration, journal: Optional[str] = None) -> None:
        super().__init__("ros2", version=version, announce=5.0, patience=configured.answer + 10)
        self._configuration, self._journal = configured, journal
        self._links: "Optional[object]" = None
        self._work: List[Awaitable[None]] = []

    async def open(self) -> None:
        """Takes part in the network, unless plans are only to be checked."""
        links = None
        if self.purpose != "check":
            from . import ros

            links = self._links = ros.Links(self._configuration.domain)
        for entry in self._configuration.robots:
            self.add(Robot(entry, self._configuration, links))
        if links is not None:
            if self._journal is not None and self._configuration.inputs:
                self._work.append(Inputs(self._configuration.inputs, dolphin.attach(self._journal), links).run())
            if self._journal is not None and self._configuration.outputs:
                run = dolphin.attach(self._journal)
                self._work.append(Outputs(self._configuration.outputs, run, links, self.resumes).run())
            links.open()

    async def run(self) -> None:
        try:
            await asyncio.gather(asyncio.Event().wait(), *self._work)
        finally:
            if self._links is not None:
                self._links.close()  # type: ignore[attr-defined]


def checked(path: str) -> Configuration:
    """The configuration of a file, all types of which are there. Raises `Faulty`."""
    found = configuration_file.read(path)
    interfaces.check(found)
    return found


def main(arguments: Optional[Sequence[str]] = None) -> int:
    parser = argparse.ArgumentParser(
        prog="dolphin-ros2", description=DESCRIPTION, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--config", required=True, metavar="FILE", help="the robots, topics and plans, in YAML")
    parser.add_argument(
        "--run", metavar="JOURNAL",
        help="the journal of the run, as dolphin exec --journal has it: messages of the topics under 'inputs' are "
        "posted to this run, and its news is published on those under 'outputs'")
    parser.add_argument(
        "--check", action="store_true", help="only check the configuration, print all its faults, and end")
    parser.add_argument("--version", action="version", version=f"dolphin-ros2 {version}")
    options = parser.parse_args(arguments)
    try:
        found = checked(options.config)
    except Faulty as faulty:
        print("\n".join(faulty.lines), file=sys.stderr)
        if not options.check:
            print(json.dumps({"kind": "error", "why": faulty.why}))
        return 1
    if options.check:
        names = [robot.name for robot in found.robots]
        print(f"{options.config}: {len(names)} robot{'' if len(names) == 1 else 's'}: {', '.join(names)}")
    else:
        if (found.inputs or found.outputs) and options.run is None:
            print("dolphin-ros2: inputs and outputs are not used, as --run is not given", file=sys.stderr)
        Robots(found, options.run).serve()
    return 0
