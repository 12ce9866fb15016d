"""people.yaml: each fault with its place and remedy; a text of any kind leads to no other exception."""

import re
import unittest

from dolphin_people import configuration
from dolphin_people.configuration import Answer, problem_of

from configurations import faults_of, mutated
from tests.support import TEXT, beside


def faults(text, path="p.yaml"):
    """The faults of a text, without its path."""
    return faults_of(configuration.of_text, text, path)


FAULTS = [
    ("port: 8470", "port: 0", ["1:16: 'port' is a number from 1 to 65535; this is 0"]),
    ("port: 8470", "port: 80.5", ["1:16: 'port' is a whole number; this is 80.5"]),
    ("name: ship.local", "name: 'http://ship'", [
        "1:28: 'name' is a name or an address, such as ship.local or 192.168.1.7"]),
    ("name: ship.local", "certificate: c.pem", ["1:35: 'certificate' needs the member 'key'"]),
    ("name: ship.local", "certificate: none.pem, key: none.pem", [
        "1:35: none.pem, none.pem: No such file or directory"]),
    ("skills: [crane, boat]", "skill: crane", [
        "3:9: unknown member 'skill' of the person 'ana'; did you mean 'skills'?"]),
    ("skills: [crane, boat]", "skills: crane", [
        "3:17: 'skills' is a list, such as [a, b]; this is the text 'crane'"]),
    (", position: {latitude: 41.185, longitude: -8.706}", "", [
        "3:8: the person 'ana' needs the member 'position', or 'locate: true'"]),
    ("latitude: 41.185", "latitude: 411.85", ["3:53: 'latitude' is a number from -90 to 90; this is 411.85"]),
    ("  carla:", "  \"c\\narla\":", ["4:3: a name has 1 to 64 characters, and no control characters"]),
    ("Launch ${boat}.", "Launch ${bota}.", [
        "6:28: the instruction's name 'launch_${boat}' has no parameter 'bota': call it 'launch_${boat}_${bota}'"]),
    ("launch_${boat}", "launch_${boat}${boat}", ["6:3: the name 'launch_${boat}${boat}' has a parameter twice"]),
    ("within: 900", "within: 0", ["6:55: 'within' is a number from 1 to 604800; this is 0"]),
    ("answer: number", "answer: numbr", [
        "7:47: an answer of the kind 'numbr' does not exist; did you mean 'number'?",
        "7:60: 'unit' needs 'answer: number'",
        "7:69: 'from' needs 'answer: number'", "7:76: 'to' needs 'answer: number'"]),
    ("answer: number, ", "", [
        "7:45: 'unit' needs 'answer: number'", "7:54: 'from' needs 'answer: number'",
        "7:61: 'to' needs 'answer: number'",
        "7:72: 'input' needs 'answer'"]),
    ("to: 50", "to: -1", ["7:77: 'to' is less than 'from', 0"]),
    (", input: seen", "", ["9:9: 'answer' needs the member 'input', under which the program gets it"]),
    ("choices: [red, green]", "choices: [red, red]", ["8:58: 'choices' lists at least two texts"]),
    ("choices: [red, green], ", "", ["8:41: 'choices' lists at least two texts"]),
    ("acknowledge: false", "acknowledge: no way", ["12:47: 'acknowledge' is true or false; this is the text 'no way'"]),
    ("accept: 60", "acept: 60", ["13:1: unknown member 'acept' of the configuration; did you mean 'accept'?"]),
    ("declined: 5", "declined: -5", ["14:11: 'declined' is a number from 0 to 604800; this is -5"]),
    (TEXT, "others: true\n", ["1:1: the configuration needs the member 'people'"]),
    (TEXT, "people: {}\n", ["1:9: there are no people"]),
    (TEXT, "people: [ana]\n", ["1:9: 'people' is a list of names, each with its members; this is a list"]),
]


class Configuration(unittest.TestCase):
    def test_each_fault_has_its_place_and_remedy(self):
        self.assertEqual(faults(TEXT), [])
        for old, new, wanted in FAULTS:
            self.assertIn(old, TEXT)
            self.assertEqual(faults(TEXT.replace(old, new, 1)), wanted, new)

    def test_the_example(self):
        found = configuration.read(beside("example/people.yaml"))
        self.assertEqual([entry.name for entry in found.people], ["ana", "bruno", "carla"])
        rule, text = found.rule("launch_noptilus-1")
        self.assertEqual((text, rule.within), ("Launch noptilus-1 with the crane.", 900))
        self.assertIsNone(found.rule("dance"))

    def test_without_instructions_names_are_shown_as_they_are(self):
        found = configuration.of_text("people: {ana: {locate: true}}\n", "p.yaml")
        self.assertEqual(found.rule("Ring the bell")[1], "Ring the bell")
        self.assertEqual((found.listen.address, found.listen.port), ("127.0.0.1", 8470))

    def test_texts_of_any_kind(self):
        """Mutated texts are configurations or faults."""
        pieces = ["{", "}", "[", "]", ": ", "- ", "\n", "  ", "&a ", "*a", "<<: ", "null", "1e999", "\\0", "\t", "${",
                  "${x}",
                  "2020-01-01", "no", "\u00e9", "?", "|", ".inf", "!!binary x", "certificate: x, key: x, ", "photos: 3"]
        for seed, text in mutated(TEXT, pieces):
            with self.subTest(seed=seed):
                faults(text)

    def test_values_that_answer(self):
        number = Answer("number", "k", least=0, most=50)
        for value in (0, 50, 35.5):
            self.assertIsNone(problem_of(number, value, ()))
        for value in (-1, 51, True, "3", None, float("nan"), float("inf"), [1], 10**400):
            self.assertEqual(problem_of(number, value, ()), "give a number from 0 to 50", value)
        self.assertIsNone(problem_of(Answer("text", "k"), "a ray", ()))
        for value in ("", "  ", 3, None, "x" * 2001):
            self.assertIsNotNone(problem_of(Answer("text", "k"), value, ()), value)
        choice = Answer("choice", "k", choices=("red", "green"))
        self.assertIsNone(problem_of(choice, "red", ()))
        self.assertEqual(problem_of(choice, ["red"], ()), "choose one of red, green")
        self.assertIsNone(problem_of(Answer("position", "k"), {"latitude": 41, "longitude": -8.7}, ()))
        for value in ({"latitude": 91, "longitude": 0}, {"latitude": 1}, "41 8", {"latitude": 1, "longitude": True},
                      {"latitude": 1, "longitude": 2, "task": "x"}):
            self.assertIsNotNone(problem_of(Answer("position", "k"), value, ()), value)
        self.assertIsNone(problem_of(Answer("photo", "k"), "a.jpg", ["a.jpg"]))
        self.assertIsNotNone(problem_of(Answer("photo", "k"), "../a.jpg", ["a.jpg"]))
        self.assertEqual(problem_of(None, 3, ()), "this instruction takes no answer")


class Documents(unittest.TestCase):
    def test_the_page_has_the_example_and_every_member(self):
        with open(beside("../../docs/people.md"), encoding="utf-8") as file:
            page = file.read()
        for name, language in (("people.yaml", "yaml"), ("launch.dol", "groovy")):
            with open(beside(f"example/{name}"), encoding="utf-8") as file:
                self.assertIn(f"```{language}\n{file.read()}```", page)
        rows = re.findall(r"^\| (`\w+`(?:, `\w+`)*) \|", page, re.MULTILINE)
        listed = [name for row in rows for name in re.findall(r"\w+", row)]
        members = [configuration.MEMBERS, configuration.LISTEN, configuration.PERSON, configuration.RULE]
        self.assertEqual(listed, [name for names in members for name in names])


if __name__ == "__main__":
    unittest.main()
