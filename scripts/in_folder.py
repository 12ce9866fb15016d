"""Tests of processes, in a folder of their own: `unittests`, beside this, has this folder on the path."""

import os
import shutil
import subprocess
import tempfile
import unittest
from typing import Any


class InFolder(unittest.TestCase):
    """A test with a folder, `self.folder`, which is removed with the processes that it started."""

    def setUp(self) -> None:
        self.folder = tempfile.mkdtemp(prefix="dolphin-test-")
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, name: str) -> str:
        return os.path.join(self.folder, name)

    def write(self, name: str, text: str) -> str:
        """Writes a file of the folder; its path."""
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def text(self, name: str) -> str:
        """The text of a file of the folder, empty if the file does not exist."""
        try:
            with open(self.path(name), encoding="utf-8") as file:
                return file.read()
        except FileNotFoundError:
            return ""

    def start(self, name: str, *command: str, adds: bool = False, **more: Any) -> "subprocess.Popen[bytes]":
        """A process whose output is in the file `name`, or is added to it. It is ended with the test."""
        with open(self.path(name), "ab" if adds else "wb") as output:
            process = subprocess.Popen(
                command, stdout=output, stderr=output, **{"stdin": subprocess.DEVNULL, **more})

        def end() -> None:
            if process.poll() is None:
                process.kill()
            process.wait()

        self.addCleanup(end)
        return process
