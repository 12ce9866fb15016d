"""Suppliers of decorated functions: request by request, and to a run."""

import contextlib
import io
import unittest

import dolphin
from dolphin.values import from_json, to_json
from tests.support import InFolder


class Queue:
    """An object that programs get, with a method whose name Python keeps for itself."""

    length = 2

    def __init__(self, tasks):
        self.tasks = tasks
        self._secret = 1

    async def await_(self):
        if not self.tasks:
            raise dolphin.SupplierError("the queue is closed")
        return dolphin.Task(self.tasks.pop(0))


def supplier(tasks):
    made = dolphin.Supplier()
    queue = Queue(tasks)
    made.offer("queue", queue)

    @made.method
    def active():
        return len(tasks) > 0

    @made.value(name="queue")
    def the_queue():
        return queue

    @made.method
    def area(centre, radius):
        return dolphin.Circle(centre, radius)

    @made.method
    def length_of(queue):
        return len(queue.tasks)

    return made


class Requests(unittest.TestCase):
    def reply(self, made, **request):
        import asyncio

        with contextlib.redirect_stderr(io.StringIO()):
            reply = asyncio.run(made._reply({"id": 7, **request}))
        self.assertEqual(reply.pop("id"), 7)
        return reply

    def test_replies(self):
        made = supplier(["survey"])
        for request, reply in [
            ({"call": "getSupplier", "arguments": []}, {"value": {"object": "supplier"}}),
            ({"object": "supplier", "call": "active", "arguments": []}, {"value": True}),
            ({"object": "supplier", "get": "queue"}, {"value": {"object": "queue"}}),
            ({"object": "supplier", "call": "length_of", "arguments": [{"object": "queue"}]}, {"value": 1}),
            ({"object": "queue", "get": "length"}, {"value": 2}),
            ({"object": "queue", "call": "await", "arguments": []}, {"value": {"task": "survey"}}),
            ({"object": "queue", "call": "await", "arguments": []}, {"error": "the queue is closed"}),
            ({"object": "queue", "get": "_secret"}, {"error": "queue has no member '_secret'"}),
            ({"object": "boat", "get": "length"}, {"error": "there is no object 'boat'"}),
            ({"object": "supplier", "call": "dance", "arguments": []}, {"error": "supplier has no method 'dance'"}),
            ({"object": "supplier", "call": "area", "arguments": [{"latitude": 41, "longitude": -8}, 200]},
             {"value": {"centre": {"latitude": 41, "longitude": -8, "height": 0.0}, "radius": 200}}),
        ]:
            self.assertEqual(self.reply(made, **request), reply, request)

    def test_any_exception_is_an_error_of_the_call(self):
        wrong = self.reply(supplier([]), object="supplier", call="area", arguments=[1])
        self.assertIn("TypeError", wrong["error"])
        unknown = dolphin.Supplier()
        unknown.method(name="f")(lambda: object())
        reply = self.reply(unknown, object="supplier", call="f")
        self.assertEqual(reply, {"error": "TypeError: a object is not a value of programs"})

    def test_values_there_and_back(self):
        corner = dolphin.Position(41.0, -8.0, 3.0)
        for value in [None, True, 3, 1.5, "text", [1, [2]], {"a": 1}, {"latitude": 1, "longitude": 2}, {"task": "x"},
                      corner, dolphin.Circle(corner, 20), dolphin.Area(((corner, corner),)), dolphin.Task("survey"),
                      dolphin.Vehicles(("x8-02",)), dolphin.Reference("queue")]:
            self.assertEqual(from_json(to_json(value)), value)


class InARun(InFolder):
    def test_a_program_takes_what_a_supplier_hands_out(self):
        self.write("m.dol", """
            supplier = getSupplier()
            v = pick { type 'UUV' }
            while (supplier.active()) { execute v: supplier.queue.await() }
            c = supplier.area(location(41.185, -8.706), 200)
            message supplier.length_of(supplier.queue)
        """)
        journal = dolphin.execute("m.dol", supplier=supplier(["survey", "look"]))
        self.assertEqual([task.plan for task in journal.tasks()], ["survey", "look"])
        self.assertEqual(journal.messages(), ["0"])

    def test_an_error_of_the_supplier_is_one_of_the_program(self):
        self.write("m.dol", "x = getSupplier().dance()")
        with self.assertRaises(dolphin.RunFailed) as caught:
            dolphin.execute("m.dol", supplier=supplier([]))
        self.assertIn("supplier has no method 'dance'", str(caught.exception))


if __name__ == "__main__":
    unittest.main()
