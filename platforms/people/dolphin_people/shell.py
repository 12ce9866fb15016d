"""The process: options, the server, the adapter, and its end."""

from __future__ import annotations

import argparse
import asyncio
import json
import os
import socket
import sys
from typing import Dict, List, Optional, Sequence

import dolphin
from dolphin.document import Faulty

from . import configuration, version
from .answers import Answers
from .configuration import Configuration, Listen
from .http import Server
from .person import Person
from .site import Site, secret_of, token_of

DESCRIPTION = """People as vehicles of a mission, each with a page on a phone:
dolphin exec mission.dol --journal mission.run \\
  --platform 'dolphin-people --config people.yaml --run mission.run'
docs/people.md describes the configuration."""
WRONG = 2


class People(dolphin.Adapter):
    """The people of a configuration."""

    def __init__(self, found: Configuration, secret: bytes, journal: Optional[str]) -> None:
        super().__init__("people", version=version, announce=5.0, patience=found.accept + 15)
        self._configuration, self._secret, self._journal = found, secret, journal
        self._server: Optional[Server] = None

    async def open(self) -> None:
        """Adds the people, and listens, unless plans are only to be checked. People are made here because, before
        Python 3.10, locks of asyncio belong to the event loop in which they are made."""
        found, listen = self._configuration, self._configuration.listen
        answers = Answers(self._journal)
        tokens: Dict[str, Person] = {}
        for entry in found.people:
            person = tokens[token_of(self._secret, entry.name)] = Person(entry, found, answers, self.program)
            self.add(person)
        if self.purpose != "check":
            self._server = Server(Site(tokens, found.photos, lambda: self.resumes).reply)
            try:
                await self._server.open(listen.address, listen.port, listen.tls())
            except OSError as error:
                why = os.strerror(error.errno) if error.errno and error.errno > 0 else str(error)
                raise dolphin.Failed(f"cannot listen at {listen.address}:{listen.port}: {why}") from error

    async def run(self) -> None:
        try:
            await asyncio.Event().wait()
        finally:
            if self._server is not None:
                self._server.close()


def base_of(listen: Listen) -> str:
    """The beginning of links."""
    scheme = "http" if listen.pair is None else "https"
    host = listen.name or (own_address() if listen.address in ("0.0.0.0", "::") else listen.address)
    return f"{scheme}://{f'[{host}]' if ':' in host else host}:{listen.port}"


def own_address() -> str:
    """The address of this machine in its network; nothing is sent to find it."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(("192.0.2.1", 9))
            return str(probe.getsockname()[0])
        except OSError:
            return "127.0.0.1"


def print_links(found: Configuration, secret: bytes) -> None:
    """Prints the link of each person, on a terminal also as a QR code."""
    for entry in found.people:
        link = f"{base_of(found.listen)}/#{token_of(secret, entry.name)}"
        print(f"{entry.name}: {link}")
        if sys.stdout.isatty():
            import segno

            segno.make(link, micro=False).terminal(compact=True, border=2)
            print()


def main(arguments: Optional[Sequence[str]] = None) -> int:
    parser = argparse.ArgumentParser(
        prog="dolphin-people", description=DESCRIPTION, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--config", metavar="FILE", help="the people and their instructions, in YAML")
    parser.add_argument(
        "--run", metavar="JOURNAL",
        help="the journal of the run, as dolphin exec --journal has it: answers are posted to this run")
    parser.add_argument("--links", action="store_true", help="print the link of each person, and end")
    parser.add_argument(
        "--check", action="store_true", help="only check the configuration, print all its faults, and end")
    parser.add_argument("--terminal", metavar="LINK", help="take part at this terminal, by the link of a person")
    parser.add_argument("--cafile", metavar="FILE", help="with --terminal: the certificates to trust")
    parser.add_argument("--version", action="version", version=f"dolphin-people {version}")
    options = parser.parse_args(arguments)
    if options.terminal is not None:
        from .terminal import take_part

        return take_part(options.terminal, options.cafile)
    if options.config is None:
        parser.error("--config FILE is needed")
    is_adapter = not (options.check or options.links)
    try:
        found = configuration.read(options.config)
        secret = b"" if options.check else secret_of(options.config + ".secret")
    except (Faulty, OSError, ValueError) as error:
        lines: List[str] = getattr(error, "lines", [str(error)])
        print("\n".join(lines), file=sys.stderr)
        if is_adapter:
            print(json.dumps({"kind": "error", "why": getattr(error, "why", str(error))}))
        return WRONG
    if options.check:
        count = len(found.people)
        print(f"{options.config}: {count} {'person' if count == 1 else 'people'}: "
              f"{', '.join(entry.name for entry in found.people)}")
    elif options.links:
        print_links(found, secret)
    else:
        journal = None if options.run is None else os.path.abspath(options.run)
        if journal is None and any(rule.answer for rule in found.rules):
            print("dolphin-people: without --run, instructions that take an answer are refused", file=sys.stderr)
        People(found, secret, journal).serve()
    return 0
