"""The server and its replies, over loopback: tokens, limits, photos, strangers; drawn bytes lead to no fault."""

import asyncio
import json
import os
import random
import shutil
import tempfile
import unittest
from unittest import mock

from dolphin_people import configuration, http, site
from dolphin_people.person import Person

from eventually import eventually
from seeds import seeds
from tests.support import TEXT, FakeAnswers, FakePlan, settled

JPEG = b"\xff\xd8\xff\xe0" + b"x" * 100


class Case(unittest.IsolatedAsyncioTestCase):
    async def asyncSetUp(self):
        self.folder = tempfile.mkdtemp(prefix="dolphin-test-")
        self.addCleanup(shutil.rmtree, self.folder)
        found = configuration.of_text(TEXT, "people.yaml")
        self.answers = FakeAnswers()
        self.ana, self.carla = (Person(entry, found, self.answers) for entry in found.people)
        self.faults, self.is_restarted = [], False
        self.photos = os.path.join(self.folder, "photos")
        replies = site.Site({"a" * 32: self.ana, "c" * 32: self.carla}, self.photos, lambda: self.is_restarted)

        async def reply(request):
            try:
                return await replies.reply(request)
            except (http.TooLarge, http._Over):
                raise
            except Exception as error:
                self.faults.append(error)
                raise

        self.server = http.Server(reply)
        self.port = await self.server.open("127.0.0.1", 0)
        self.work = []

    async def asyncTearDown(self):
        self.server.close()
        for task in self.work:
            task.cancel()
        self.assertEqual(self.faults, [])

    async def raw(self, data, ends=False):
        """All that the server sends after these bytes."""
        reader, writer = await asyncio.open_connection("127.0.0.1", self.port)
        try:
            writer.write(data)
            if ends:
                writer.write_eof()
            return await asyncio.wait_for(reader.read(), 20)
        except ConnectionError:
            return b""
        finally:
            writer.close()

    async def request(self, method, path, members=None, token="a" * 32, body=None, type_="application/json"):
        """The status and the object of a reply."""
        body = body if body is not None else b"" if members is None else json.dumps(members).encode()
        head = f"{method} {path} HTTP/1.1\r\nHost: x\r\nConnection: close\r\nAuthorization: Bearer {token}\r\n"
        head += f"Content-Type: {type_}\r\nContent-Length: {len(body)}\r\n\r\n"
        reply = await self.raw(head.encode() + body)
        head, _, text = reply.partition(b"\r\n\r\n")
        return int(head.split()[1]), json.loads(text) if b"json" in head else text

    async def give(self, plan, person=None):
        """An instruction to a person."""
        plan = FakePlan(plan, request=f"r-{plan}")
        self.work.append(asyncio.ensure_future((person or self.ana).start(plan)))
        await settled()


class Replies(Case):
    async def test_the_page_and_its_policy(self):
        for path, type_ in (("/", b"text/html"), ("/page.js", b"text/javascript"), ("/page.css", b"text/css")):
            reply = await self.raw(f"GET {path} HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n".encode())
            self.assertIn(type_, reply)
            self.assertIn(b"Content-Security-Policy: default-src 'none'", reply)
        page = await self.raw(b"GET / HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n")
        self.assertNotIn(b"<style", page)
        self.assertNotIn(b"onclick", page)

    async def test_without_a_token_nothing_is_had(self):
        for token in ("", "b" * 32, "a" * 31, "é" * 32):
            for method, path in (("GET", "/state"), ("POST", "/act"), ("POST", "/photo"), ("GET", "/../people.yaml")):
                self.assertEqual((await self.request(method, path, token=token))[0], 401)
        self.assertFalse(self.ana.known["link"])
        # Nor is the body of such a request read.
        head = b"POST /photo HTTP/1.1\r\nHost: x\r\nContent-Length: 1000000000\r\n\r\n"
        self.assertIn(b"401", await self.raw(head))

    async def test_an_instruction_is_done(self):
        self.assertEqual((await self.request("GET", "/state"))[1]["instruction"], None)
        self.assertTrue(self.ana.known["link"])
        await self.give("depth")
        code, state = await self.request("GET", "/state")
        self.assertEqual((code, state["instruction"]["text"]), (200, "Measure the depth."))
        self.assertEqual((await self.request("GET", "/state", token="c" * 32))[1]["instruction"], None)
        act = {"request": "r-depth", "act": "accept"}
        self.assertEqual(await self.request("POST", "/act", act), (200, {"ok": True}))
        self.assertEqual(await self.request("POST", "/act", act), (200, {"ok": True}))
        self.assertEqual((await self.request("POST", "/act", act, token="c" * 32))[0], 409)
        done = {**act, "act": "done"}
        refusal = (400, {"error": "give a number from 0 to 50"})
        self.assertEqual(await self.request("POST", "/act", {**done, "value": 99}), refusal)
        self.assertEqual(await self.request("POST", "/act", {**done, "value": 9}), (200, {"ok": True}))

    async def test_an_adapter_that_was_started_again_does_not_yet_refuse(self):
        act = {"request": "r-of-before", "act": "done"}
        self.assertEqual((await self.request("POST", "/act", act))[0], 409)
        self.is_restarted = True
        self.assertEqual((await self.request("POST", "/act", act))[0], 503)

    async def test_breaks_and_positions(self):
        self.assertEqual((await self.request("POST", "/duty", {"duty": False}))[0], 200)
        self.assertEqual(self.ana.unready, "has a break")
        place = {"latitude": 41.2, "longitude": -8.7}
        self.assertEqual((await self.request("POST", "/position", place))[0], 400)
        self.assertEqual((await self.request("POST", "/position", place, token="c" * 32))[0], 200)
        self.assertEqual(self.carla.known["latitude"], 41.2)

    async def test_bodies_that_are_not_right(self):
        await self.give("depth")
        for path in ("/act", "/duty", "/position"):
            for body in (b"", b"{", b"[]", b"3", b"\xff", b"{\"value\": NaN}", b"[" * 5000, b"{}"):
                code, reply = await self.request("POST", path, body=body)
                self.assertEqual(code, 400, (path, body[:10]))
                self.assertTrue(reply["error"])
            self.assertEqual((await self.request("POST", path, body=b" " * 20_000))[0], 413)
        self.assertEqual((await self.request("GET", "/state"))[1]["instruction"]["state"], "offered")

    async def test_photos(self):
        self.assertEqual((await self.request("POST", "/photo", body=JPEG, type_="image/jpeg"))[0], 409)
        await self.give("picture")
        for type_, body in (
                ("image/jpeg", b"<svg>"), ("image/svg+xml", b"<svg>"), ("text/html", JPEG), ("image/png", JPEG)):
            self.assertEqual((await self.request("POST", "/photo", body=body, type_=type_))[0], 400)
        code, reply = await self.request("POST", "/photo", body=JPEG, type_="image/jpeg")
        self.assertEqual((code, os.listdir(self.photos)), (200, [reply["photo"]]))
        done = {"request": "r-picture", "act": "done"}
        self.assertEqual((await self.request("POST", "/act", {**done, "value": "other.jpg"}))[0], 400)
        self.assertEqual((await self.request("POST", "/act", {**done, "value": reply["photo"]}))[0], 200)

    async def test_a_disk_that_is_full(self):
        await self.give("picture")
        with mock.patch("dolphin_people.site.os.fsync", side_effect=OSError(28, "No space left on device")):
            code, reply = await self.request("POST", "/photo", body=JPEG, type_="image/jpeg")
        self.assertEqual((code, reply["error"]), (400, "the photo cannot be kept: No space left on device"))
        self.assertEqual(os.listdir(self.photos), [])


class Strangers(Case):
    async def test_drawn_bytes(self):
        pieces = [b"GET / HTTP/1.1\r\n", b"POST /act HTTP/1.1\r\n", b"Host: x\r\n", b"\r\n", b"Content-Length: 5\r\n",
                  b"\0", b"Transfer-Encoding: chunked\r\n", b"5\r\nhello\r\n0\r\n\r\n", b"Content-Length: -1\r\n",
                  b"{}", b"\xff" * 9, b"Expect: 100-continue\r\n", b"Authorization: Bearer " + b"a" * 32 + b"\r\n",
                  b"GET //x:y@[/?after=%zz HTTP/1.1\r\n",
                  b"GET /state?after=" + b"%C3" * 50 + b" HTTP/1.0\r\n"]
        for seed in seeds(60):
            draw = random.Random(seed)
            with self.subTest(seed=seed):
                data = b"".join(draw.choice(pieces) for _ in range(draw.randint(1, 8)))
                await self.raw(data, ends=True)
        self.assertEqual((await self.request("GET", "/state"))[0], 200)
        await eventually(lambda: not self.server._open)

    async def test_a_head_that_is_too_long(self):
        self.assertIn(b" 431 ", await self.raw(b"GET / HTTP/1.1\r\nX: " + b"x" * 100_000 + b"\r\n\r\n"))

    async def test_slow_strangers_are_cut_off(self):
        with mock.patch("dolphin_people.http.HEAD", 0.1), mock.patch("dolphin_people.http.BODY", 0.1):
            self.assertEqual(await self.raw(b"GET / HTT"), b"")
            head = b"POST /act HTTP/1.1\r\nHost: x\r\nAuthorization: Bearer " + b"a" * 32
            self.assertEqual(await self.raw(head + b"\r\nContent-Length: 9\r\n\r\n{"), b"")

    async def test_one_address_has_a_share_of_the_connections(self):
        with mock.patch("dolphin_people.http.OF_ONE_ADDRESS", 5):
            open_ = [await asyncio.open_connection("127.0.0.1", self.port) for _ in range(5)]
            await eventually(lambda: sum(self.server._open.values()) == 5)
            self.assertEqual(await self.raw(b"GET / HTTP/1.1\r\nHost: x\r\n\r\n"), b"")
            for _, writer in open_:
                writer.close()
            await eventually(lambda: not self.server._open)
            self.assertEqual((await self.request("GET", "/state"))[0], 200)

    async def test_secrets_are_for_their_owner_alone(self):
        path = os.path.join(self.folder, "people.yaml.secret")
        secret = site.secret_of(path)
        self.assertEqual(os.stat(path).st_mode & 0o777, 0o600)
        self.assertEqual(site.secret_of(path), secret)
        self.assertNotEqual(site.token_of(secret, "ana"), site.token_of(secret, "anb"))
        with open(path, "w", encoding="ascii") as file:
            file.write("short\n")
        with self.assertRaises(ValueError):
            site.secret_of(path)


if __name__ == "__main__":
    unittest.main()
