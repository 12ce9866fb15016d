"""Mutated copies of texts, of JSON and of archives. All chance comes from the `random.Random` that is passed in."""

import copy
import io
import json
import re
import zipfile

NUMBERS = ["0", "-0", "-1", "1", "0.5", "90.0000001", "-181", "361", "1e308", "-1e308", "1e999", "-1e999", "5e-324",
           "1e-400", "2147483648", "4294967296", "9007199254740993", "4611686018427387904", "9223372036854775808",
           "18446744073709551616", "-9223372036854775809", "9" * 400, "0x29", "1_0", "0o17", "1e", "nan", "NaN", "inf",
           "Infinity", "-Infinity", "1,5", "٣"]
HOSTILE = [b"\x00", b"\x1b[2J", b"\x1b]0;x\x07", b"\x08", b"\r", b"\x7f", b"\xc2\x9b", b"\xff", b"\xc3", b"\xed\xa0\x80",
           b"\xf4\x90\x80\x80", b"\xc0\x80", b"\xef\xbb\xbf", "\u2028".encode(), "\u202e".encode(), b"&#0;", b"&#27;",
           b"&#xD800;", b"\\u0000", b"\\u001b", b"\\ud800", b"\\x1b", b"\"", b"'", b"${", b"}", b"/*", b"<![CDATA[",
           b"<!--", b"%n", b"\xf0\x9f\x9a\x81"]
OPENING = [b"(", b"[", b"{", b"-", b"!", b"<a>", b'{"a":', b"[[", b"action {", b"if (true) { ", b"x.", b"1 + "]
VALUES = [None, True, False, 0, -1, 1e308, 5e-324, float("nan"), float("inf"), -float("inf"), 2 ** 53 + 1, 2 ** 63,
          10 ** 40, 91, -181, "", "\x1b[2J", "\x00", "\ud800", "x" * 5000, "é", [], {}, [[]], {"": None}]
NUMBER = re.compile(rb"\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")
WORD = re.compile(rb"[A-Za-z_]\w*|'[^'\n]*'|\"[^\"\n]*\"")


def piece(random, text, longest=200):
    """The beginning and the end of a part of `text`."""
    begin = random.randrange(len(text) + 1)
    return begin, min(len(text), begin + random.randrange(longest))


def replaced(random, pattern, text, by):
    found = list(pattern.finditer(text))
    if not found:
        return text
    match = random.choice(found)
    return text[:match.start()] + by(match.group()) + text[match.end():]


def once(random, text, others):
    begin, end = piece(random, text)
    lines = text.splitlines(keepends=True)
    match random.randrange(11):
        case 0:
            return text[:begin] + text[end:]
        case 1:
            return text[:end] + text[begin:end] * random.choice([1, 1, 2, 50]) + text[end:]
        case 2:
            other = random.choice(others)
            first, last = piece(random, other, 2000)
            return text[:begin] + other[first:last] + text[end:]
        case 3 | 4:
            return replaced(random, NUMBER, text, lambda _: random.choice(NUMBERS).encode())
        case 5:
            words = WORD.findall(random.choice(others)) or [b"x"]
            return replaced(random, WORD, text, lambda _: random.choice(words))
        case 6:
            return text[:begin] + random.choice(HOSTILE) + text[begin:]
        case 7:
            return replaced(random, WORD, text, lambda word: word[:-1] + random.choice(HOSTILE) + word[-1:])
        case 8:
            return text[:begin] + random.choice(OPENING) * random.choice([2, 50, 20_000]) + text[begin:]
        case 9 if len(lines) > 1:
            i, j = random.randrange(len(lines)), random.randrange(len(lines))
            lines[i], lines[j] = lines[j], random.choice([lines[i], b""])
            return b"".join(lines)
        case _:
            return bytes(random.randrange(256) if begin <= i < begin + 4 else b for i, b in enumerate(text))


def text(random, original, others):
    """`original` after one to some mutations; parts of `others` may be spliced in."""
    for _ in range(random.choice([1, 1, 1, 2, 3, 8])):
        original = once(random, original, others)
    return original


def nodes(value):
    """Each container of `value` with each of its keys."""
    if isinstance(value, (dict, list)):
        for key in (list(value) if isinstance(value, dict) else range(len(value))):
            yield value, key
            yield from nodes(value[key])


def structure(random, original):
    """The text of `original`, a JSON value, with some of its parts replaced, removed, moved or nested deeply."""
    value = [json.loads(json.dumps(original))]
    for _ in range(random.choice([1, 1, 1, 2, 4])):
        container, key = random.choice(list(nodes(value)))
        other, other_key = random.choice(list(nodes(value)))
        match random.randrange(6):
            case 0 | 1 | 2:
                container[key] = copy.deepcopy(random.choice(VALUES))
            case 3 if container is not value:
                del container[key]
            case 4:
                container[key] = json.loads(json.dumps(other[other_key]))
            case _:
                for _ in range(random.choice([1, 100])):
                    container[key] = [container[key]]
    return json.dumps(value[0]).encode()


def json_text(random, original, others):
    """JSON, or lines of it, mutated as JSON or as text."""
    if random.random() < 0.4:
        return text(random, original, others)
    try:
        return structure(random, json.loads(original))
    except ValueError:
        lines = original.splitlines()
        i = random.randrange(len(lines))
        lines[i] = structure(random, json.loads(lines[i]))
        return b"\n".join(lines) + b"\n"


def archive(random, files, others):
    """A ZIP archive of `files`, (name, text) each, with one of them mutated, or mutated itself."""
    files = list(files)
    whole = random.random() < 0.3
    if not whole:
        i = random.randrange(len(files))
        files[i] = (files[i][0], text(random, files[i][1], others))
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as packed:
        for name, content in files:
            packed.writestr(zipfile.ZipInfo(name), content)
    return text(random, buffer.getvalue(), others) if whole else buffer.getvalue()
