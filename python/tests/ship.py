#!/usr/bin/env python3
"""The adapter of a ship that outlives it: its plan is in a file, which stands for the ship's own memory."""

import asyncio
import json
import os
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))

import dolphin


class Ship(dolphin.Vehicle):
    type = "USV"
    seconds = {"short": 0.3, "long": 600}

    def __init__(self, name, path):
        super().__init__(name, latitude=41.185, longitude=-8.706)
        self.path = path

    def board(self):
        """The state on board: the request, when its plan is over, and whether it was stopped."""
        if not os.path.exists(self.path):
            return {"request": None, "until": 0, "stopped": False}
        with open(self.path, encoding="utf-8") as file:
            return json.load(file)

    def write(self, state):
        with open(self.path + ".new", "w", encoding="utf-8") as file:
            json.dump(state, file)
        os.replace(self.path + ".new", self.path)

    async def problems(self, plan):
        return [] if plan.name in self.seconds else [f"undefined plan '{plan.name}'"]

    async def start(self, plan):
        self.write({"request": plan.request, "until": time.time() + self.seconds[plan.name], "stopped": False})

    async def finish(self, plan):
        while True:
            state = self.board()
            if state["request"] != plan.request:
                raise dolphin.Failed("another plan is on board")
            if state["stopped"]:
                raise dolphin.Failed("was stopped")
            if state["until"] <= time.time():
                return
            await asyncio.sleep(0.05)

    async def stop(self, plan):
        state = self.board()
        if state["request"] == plan.request:
            self.write({**state, "stopped": True})

    async def resume(self, plan):
        state = self.board()
        if state["request"] != plan.request:
            raise dolphin.Absent()
        if state["stopped"]:
            raise dolphin.Stopped()
        if state["until"] <= time.time():
            raise dolphin.Done()


dolphin.serve(Ship("ship-1", sys.argv[1]), name="ships", patience=5)
