"""MAVLink's mission protocol over bad links, in virtual time."""

import unittest

from dolphin_mavlink.transfer import Download, RoundTrip, Upload, numbered
from dolphin_mavlink.wire import mavlink
from seeds import seeds
from tests.support import Case, one, stored, way

BAD = {"loss": 0.3, "doubled": 0.1, "reordered": 0.2}


class Lossy(Case):
    def test_missions_of_20_items_with_a_third_lost(self):
        """50 missions: each is flown once, and done."""
        for seed in seeds(50):
            px4 = seed % 2 == 1
            with self.subTest(seed=seed):
                vehicle, wires = one(px4=px4, items=way(20), seed=seed, loss=0.3)
                wires.run(20, lambda: "link" in wires.vehicle_said("mav-1"))
                wires.start("r", "mav-1", stored())
                end = wires.run_to_end("r")
                self.assertIsNotNone(end)
                self.assertEqual(end["kind"], "done", end)
                self.assertEqual(len(vehicle.began), 1)
                self.assertEqual(len(vehicle.reached), 20)

    def test_one_after_another_on_a_bad_link(self):
        """Which also doubles and reorders. No word on the mission before ends the one that runs; a late copy of an
        order may, or keep it from its beginning, and the reason names it."""
        why = "by its pilot, or by a late copy of an order|did not go into mode"
        ended = []
        for seed in seeds(10):
            vehicle, wires = one(px4=seed % 2 == 1, items=way(4), seed=seed, **BAD)
            wires.run(20, lambda: "link" in wires.vehicle_said("mav-1"))
            for n in range(4):
                wires.start(f"r{n}", "mav-1", stored())
                end = wires.run_to_end(f"r{n}")
                ended.append(end["kind"])
                if end["kind"] != "done":
                    self.assertRegex(end["why"], why, seed)
                    break
                self.assertEqual((len(vehicle.began), len(vehicle.reached)), (n + 1, 4 * n + 4), seed)
        self.assertGreaterEqual(ended.count("done"), 0.9 * len(ended))


class Slow(Case):
    def fly(self, seed, px4, delay, loss):
        vehicle, wires = one(px4=px4, items=way(8), seed=seed, delay=delay, loss=loss)
        wires.run(60, lambda: "link" in wires.vehicle_said("mav-1"))
        wires.start("r", "mav-1", stored())
        end = wires.run_to_end("r", 1500)
        self.assertIsNotNone(end, wires.reports[-3:])
        self.assertEqual(end["kind"], "done", end)
        self.assertEqual((len(vehicle.began), len(vehicle.reached)), (1, 8))
        return wires

    def test_links_of_0_1_to_3_s_each_way(self):
        """With and without losses. PX4 gives an upload up after 5 s without an item, so round trips of 6 s are too much
        for it, and of 4 s if items are lost."""
        for seed in seeds(1):
            for delay in (0.1, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0):
                for loss in (0.0, 0.05, 0.1):
                    for px4 in (False, True):
                        if px4 and delay > (2.0 if loss == 0 else 1.5):
                            continue
                        with self.subTest(seed=seed, delay=delay, loss=loss, px4=px4):
                            self.fly(seed, px4, delay, loss)

    def test_a_slow_link_is_not_flooded(self):
        """Without losses, at most five datagrams an item."""
        for delay in (0.5, 1.0, 2.0):
            with self.subTest(delay=delay):
                wires = self.fly(1, False, delay, 0.0)
                items = [m for m in wires.sent_messages if m.get_type() == "MISSION_ITEM_INT"]
                self.assertLessEqual(len(items), 5 * 9)


class RoundTrips(Case):
    def measure(self, px4):
        delay = 0.05
        vehicle, wires = one(px4=px4, items=way(100), delay=delay)
        asked = wires.now
        wires.start("r", "mav-1", stored())
        self.assertTrue(wires.run(120, lambda: vehicle.state == mavlink.MISSION_STATE_NOT_STARTED, step=0.005))
        uploaded = wires.now
        self.assertTrue(wires.run(120, lambda: wires.said("note") and vehicle.began, step=0.005))
        return (uploaded - asked) / (2 * delay) / 100, (wires.now - asked) / (2 * delay) / 100

    def test_an_upload_of_100_items_takes_1_5_round_trips_an_item_at_most(self):
        upload, everything = self.measure(px4=False)
        self.assertLessEqual(upload, 1.1)
        self.assertLessEqual(everything, 1.5, "with the download, the arming and the start")

    def test_px4_is_asked_for_one_item_at_a_time(self):
        upload, everything = self.measure(px4=True)
        self.assertLessEqual(upload, 1.1)
        self.assertLessEqual(everything, 2.3)


class Uploads(unittest.TestCase):
    def setUp(self):
        self.upload = Upload((1, 1), numbered(way(3), None), RoundTrip())
        self.upload.begin(0.0)

    def ask(self, now, seq):
        return [m.seq for m in self.upload.hear(now, mavlink.MAVLink_mission_request_int_message(255, 190, seq))]

    def acknowledge(self, result):
        self.upload.hear(9.0, mavlink.MAVLink_mission_ack_message(255, 190, result))
        return self.upload.result

    def test_each_item_is_sent_when_it_is_asked_for(self):
        self.assertEqual([self.ask(1.0, 0), self.ask(2.0, 1), self.ask(3.0, 2)], [[0], [1], [2]])
        self.assertEqual(self.acknowledge(mavlink.MAV_MISSION_ACCEPTED), "accepted")

    def test_a_request_and_its_copy_are_one(self):
        self.assertEqual([self.ask(1.0, 0), self.ask(1.01, 0), self.ask(2.0, 0)], [[0], [], [0]])

    def test_a_request_for_an_item_that_is_none(self):
        self.assertEqual(self.ask(1.0, 3), [])

    def test_what_is_not_answered_is_repeated(self):
        self.ask(0.1, 0)
        self.assertEqual([m.seq for m in self.upload.tick(2.0)], [0])
        self.assertEqual(self.upload.tick(2.01), [])

    def test_an_acceptance_before_the_last_item_is_another_one(self):
        self.ask(1.0, 0)
        self.assertIsNone(self.acknowledge(mavlink.MAV_MISSION_ACCEPTED))

    def test_an_invalid_sequence_answers_an_item_that_came_twice(self):
        self.ask(1.0, 0)
        self.assertIsNone(self.acknowledge(mavlink.MAV_MISSION_INVALID_SEQUENCE))

    def test_an_error_after_the_last_item_leaves_it_open(self):
        for seq in range(3):
            self.ask(1.0 + seq, seq)
        self.assertEqual(self.acknowledge(mavlink.MAV_MISSION_ERROR), "unclear")

    def test_an_item_is_not_repeated_before_1_5_s(self):
        """MAVSDK's vehicle asks again only after it has heard nothing for a while."""
        self.ask(0.05, 0)
        at = [now / 100 for now in range(5, 1000) if self.upload.tick(now / 100)]
        self.assertGreaterEqual(at[0] - 0.05, 1.5)
        self.assertTrue(all(b - a >= 1.49 for a, b in zip(at, at[1:])), at)
        self.assertGreater(len(at), 2)

    def test_answers_to_an_earlier_transfer(self):
        for result in (mavlink.MAV_MISSION_OPERATION_CANCELLED, mavlink.MAV_MISSION_ERROR, 0):
            self.assertIsNone(self.acknowledge(result))
        self.assertEqual(self.ask(9.1, 2), [])
        self.assertEqual([self.ask(9.2, 0), self.ask(9.3, 1), self.ask(9.4, 0), self.ask(9.5, 2)], [[0], [1], [], [2]])
        self.assertEqual(self.acknowledge(mavlink.MAV_MISSION_ACCEPTED), "accepted")

    def test_errors_that_go_on(self):
        results = [self.acknowledge(mavlink.MAV_MISSION_ERROR) for _ in range(5)]
        self.assertEqual(results, [None, None, None, None, "again"])

    def test_a_transfer_that_the_vehicle_gave_up(self):
        self.ask(1.0, 0)
        self.assertEqual(self.acknowledge(mavlink.MAV_MISSION_OPERATION_CANCELLED), "again")

    def test_acknowledgements_of_fences_are_others(self):
        for seq in range(3):
            self.ask(1.0 + seq, seq)
        fence = mavlink.MAVLink_mission_ack_message(255, 190, 0, mavlink.MAV_MISSION_TYPE_FENCE)
        self.upload.hear(9.0, fence)
        self.assertIsNone(self.upload.result)


class Downloads(unittest.TestCase):
    def test_errors_that_answer_copies_of_the_upload(self):
        """They are not a refusal; an error that answers each repeated question is."""
        download = Download((1, 1), RoundTrip())
        download.begin(0.0)
        denied = mavlink.MAVLink_mission_ack_message(255, 190, mavlink.MAV_MISSION_DENIED)
        for _ in range(20):
            download.hear(0.1, denied)
        self.assertIsNone(download.refused)
        for now in range(1, 1000):
            if download.tick(now / 10):
                download.hear(now / 10, denied)
        self.assertEqual(download.refused, "it was denied")

    def test_a_lost_question_is_repeated_before_the_vehicle_gives_up(self):
        """MAVSDK's vehicle gives a download up after 2.5 s without a question, so two questions in a row may be lost
        on a link with round trips of up to a second."""
        for tenths in range(1, 11):
            with self.subTest(tenths=tenths):
                trip = RoundTrip()
                download = Download((1, 1), trip)
                download.begin(0.0)
                for _ in range(3):
                    trip.measured(tenths / 10)
                now = tenths / 10
                download.hear(now, mavlink.MAVLink_mission_count_message(255, 190, 5))
                asked = [n / 10 for n in range(1, 60) if download.tick(now + n / 10)]
                self.assertLessEqual(asked[1], 2.5)


if __name__ == "__main__":
    unittest.main()
