"""Waits with an end."""

import asyncio
import unittest

from dolphin.waiting import within


async def after(seconds, result):
    await asyncio.sleep(seconds)
    return result


class Waiting(unittest.IsolatedAsyncioTestCase):
    async def test_the_result_in_time(self):
        self.assertEqual(await within(after(0, "done"), 10), "done")
        self.assertEqual(await within(after(0, "done"), None), "done")

    async def test_too_late(self):
        work = asyncio.ensure_future(after(60, "done"))
        self.assertIsNone(await within(work, 0.01))
        await asyncio.wait({work}, timeout=10)
        self.assertTrue(work.cancelled())

    async def test_an_error_of_the_work(self):
        async def fails():
            raise KeyError("x")

        with self.assertRaises(KeyError):
            await within(fails(), 10)

    async def test_a_cancellation_as_the_work_ends_is_not_lost(self):
        work = asyncio.get_running_loop().create_future()
        waits = asyncio.ensure_future(within(work, 10))
        await asyncio.sleep(0.01)
        work.set_result("done")
        waits.cancel()
        with self.assertRaises(asyncio.CancelledError):
            await waits


if __name__ == "__main__":
    unittest.main()
