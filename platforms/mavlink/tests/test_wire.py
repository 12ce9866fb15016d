"""Frames of MAVLink 1 and 2, signatures, streams in pieces, and mutated datagrams: 50,000, or DOLPHIN_DATAGRAMS."""

import copy
import os
import random
import unittest

from dolphin_mavlink.wire import SIGNATURE, Wire, mavlink, version_of
from tests.support import Case, one, stored, way

BEAT = mavlink.MAVLink_heartbeat_message(2, 3, 129, 3, 4, 3)


class Frames(unittest.TestCase):
    def test_both_versions_come_back(self):
        for version in (1, 2):
            (message,), rest = Wire(255, 190).decode(Wire(7, 1).encode(BEAT, version))
            self.assertEqual((message.get_type(), message.get_srcSystem(), rest), ("HEARTBEAT", 7, b""))
            self.assertEqual(version_of(message), version)

    def test_a_stream_in_pieces(self):
        wire, data = Wire(7, 1), b"\x00\xfd" + b"".join(Wire(7, 1).encode(BEAT) for _ in range(5))
        for size in (1, 2, 3, 7, 20, 64):
            reader, rest, got = Wire(255, 190), b"", 0
            for at in range(0, len(data), size):
                messages, rest = reader.decode(rest + data[at : at + size])
                got += len(messages)
            # A stray byte that looks like a frame's first may hold back the last frames until more comes.
            messages, _ = reader.decode(rest + wire.encode(BEAT) * 15)
            self.assertEqual(got + len(messages), 20)

    def test_a_datagram_holds_nothing_back(self):
        messages = Wire(255, 190).decode_datagram(b"\xfd\xff" + Wire(7, 1).encode(BEAT) + b"\xfe\x09")
        self.assertEqual(len(messages), 1)

    def test_signatures(self):
        signer, other, plain = Wire(7, 1, "key"), Wire(7, 1, "another key"), Wire(7, 1)
        for wire in (signer, other):
            wire.set_date(1.8e9)
        reader = Wire(255, 190, "key")
        reader.set_date(1.8e9)
        first = signer.encode(BEAT)
        self.assertEqual(len(first), len(plain.encode(BEAT)) + SIGNATURE)
        self.assertEqual(len(reader.decode_datagram(first)), 1)
        for data in (first, other.encode(BEAT), plain.encode(BEAT), plain.encode(BEAT, 1)):
            self.assertEqual(reader.decode_datagram(data), [], "a copy, another key, no signature")
        self.assertEqual(len(reader.decode_datagram(signer.encode(BEAT))), 1)

    def test_a_forged_signature_does_not_shut_out_the_true_ones(self):
        signer, forger, reader = Wire(7, 1, "key"), Wire(7, 1, "guess"), Wire(255, 190, "key")
        signer.set_date(1.8e9)
        forger.set_date(1.9e9)
        reader.set_date(1.8e9)
        self.assertEqual(reader.decode_datagram(forger.encode(BEAT)), [])
        self.assertEqual(len(reader.decode_datagram(signer.encode(BEAT))), 1)


class Old(Case):
    def test_a_vehicle_that_speaks_version_1_is_answered_in_it(self):
        vehicle, wires = one()
        encode = wires._wires[1].encode
        wires._wires[1].encode = lambda message: encode(message, 1)
        versions = set()
        transmit = wires._transmit

        def watched(data, deliver):
            versions.add(data[0])
            transmit(data, deliver)

        wires.run(2)
        wires._transmit = watched
        wires.start("r", "mav-1", stored())
        self.ends(wires, "r", "done")
        self.assertIn(mavlink.PROTOCOL_MARKER_V1, versions)
        self.assertEqual(vehicle.reached, [1, 2, 3, 4, 5])


class Hostile(Case):
    def test_mutated_datagrams(self):
        """A vehicle flies our mission and is silent. The noise, of which a quarter has right checksums, from foreign
        systems or foreign addresses, causes no exception and no event about our task."""
        vehicle, wires = one(items=way(40))
        recorded = []
        encode = wires._wires[1].encode
        wires._wires[1].encode = lambda message: recorded.append(message) or encode(message)
        wires.start("r", "mav-1", stored())
        self.assertTrue(wires.run(20, lambda: wires.said("taken")))
        recorded.clear()
        wires.run(3)
        count = int(os.environ.get("DOLPHIN_DATAGRAMS", "50000"))
        wild = random.Random(int(os.environ.get("DOLPHIN_SEED", "1")))
        before = len(wires.said("taken")), wires.end_of("r")
        reader, events = Wire(255, 190), ("taken", "done", "failed", "stopped", "unknown", "note")
        strangers = [Wire(2, 1), Wire(1, 1)]
        said = len([r for r in wires.reports if r["kind"] in events])
        for n in range(count):
            message = wild.choice(recorded)
            if n % 4 == 0:
                message = copy.copy(message)
                for field in message.get_fieldnames():
                    if isinstance(getattr(message, field), int) and wild.random() < 0.3:
                        setattr(message, field, wild.choice([0, 1, 3, 5, 40, 41, 127]))
                stranger = wild.randrange(2)
                data, address = strangers[stranger].encode(message), (
                    ("link", 1) if stranger == 0 else ("link", "other")
                )
            else:
                data, address = bytearray(encode(message)), ("link", 1)
                for _ in range(wild.randrange(1, 4)):
                    at = wild.randrange(len(data))
                    change = wild.randrange(3)
                    if change == 0:
                        data[at] ^= 1 << wild.randrange(8)
                    elif change == 1:
                        data[at:at] = wild.randbytes(wild.randrange(1, 9))
                    else:
                        del data[at:]
                    data = data or bytearray(b"\xfd")
            for heard in reader.decode_datagram(bytes(data)):
                wires.station.hear(wires.now, address, heard)
            if n % 100 == 0:
                wires._act()
                wires.reports = [r for r in wires.reports if r["kind"] in events]
        wires._act()
        self.assertEqual(len([r for r in wires.reports if r["kind"] in events]), said, wires.reports[-3:])
        self.assertEqual((len(wires.said("taken")), wires.end_of("r")), before)
        self.ends(wires, "r", "done")


if __name__ == "__main__":
    unittest.main()
