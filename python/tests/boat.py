#!/usr/bin/env python3
"""The adapter that the kit judges: a boat whose state dies with its adapter, and which prints now and then."""

import asyncio
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))

import dolphin


class Boat(dolphin.Vehicle):
    type = "USV"
    seconds = {"short": 0.3, "long": 600}

    async def problems(self, plan):
        return [] if plan.name in self.seconds else [f"undefined plan '{plan.name}'"]

    async def start(self, plan):
        print("a line for developers")

    async def finish(self, plan):
        await asyncio.sleep(self.seconds[plan.name])

    async def stop(self, plan):
        pass


boats = [Boat(f"boat-{n}", latitude=41.185, longitude=-8.706) for n in range(1, int(sys.argv[1]) + 1)]
dolphin.serve(*boats, name="boats", patience=5)
