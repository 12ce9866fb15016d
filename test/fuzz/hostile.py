"""Hostile texts and numbers, and where they are put: at the places of valid documents at which texts and numbers stand,
each written as its format writes it, so that readers get as far as to use them. All chance comes from `random`."""

import json
import re
import urllib.parse

CHARACTERS = [
    *map(chr, [*range(0x20), 0x7F, *range(0x80, 0xA0), 0xAD, 0x61C, *range(0x200B, 0x2010), *range(0x2028, 0x202F),
               *range(0x2060, 0x206A), 0xFEFF, 0xFFFE, 0xFFFF, 0x10FFFF])]
SEQUENCES = ["\x1b[2J", "\x1b]0;title\x07", "\x1b]8;;http://x\x1b\\", "\x1bP+q\x1b\\", "\x9b31m", "\x9d0;t\x9c", "\r\n", "\b\b\b",
             "\u202egnp.exe", "\u2066\u2069", "\ufeff", "\x00"]
INVALID = [b"\xff", b"\xfe", b"\x80", b"\xbf", b"\xc3", b"\xc0\x80", b"\xc1\xbf", b"\xe0\x80\x80", b"\xe0\x9f\xbf",
           b"\xed\xa0\x80", b"\xed\xbf\xbf", b"\xf0\x80\x80\x80", b"\xf4\x90\x80\x80", b"\xf5\x80\x80\x80",
           b"\xf8\x88\x80\x80\x80", b"\xe2\x82", b"\xf0\x9f\x9a"]
PLAIN = ["a", "lauv-1", "é", "北", "\U0001f681", "e\u0301", " ", "'", '"', "\\", "$", "${", "}", "<", "&", "%n", ",", ";", "=",
         "/", "--", "]]>", "*/", "x" * 300]
NUMBERS = ["1e999", "-1e999", "NaN", "nan", "-nan", "inf", "-inf", "Infinity", "-Infinity", "-0", "-0.0", "1e308", "-1e308",
           "5e-324", "1e-999", "9" * 400, "-" + "9" * 400, "0." + "1" * 400, "2147483648", "9007199254740993",
           "4611686018427387903", "4611686018427387904", "-4611686018427387905", "9223372036854775807",
           "9223372036854775808", "18446744073709551616", "0x29", "1_0", "1e", "01", "+1", ".5", "1.", "1,5", "٣", ""]


def text(random, is_valid=False):
    """A text as bytes: invalid UTF-8 may be part of it, unless it has to be valid."""
    parts = []
    for _ in range(random.choice([1, 1, 2, 4])):
        kinds = [lambda: random.choice(CHARACTERS).encode(), lambda: random.choice(SEQUENCES).encode(),
                 lambda: random.choice(PLAIN).encode(), lambda: random.choice(PLAIN).encode()]
        if not is_valid:
            kinds.append(lambda: random.choice(INVALID))
        parts.append(random.choice(kinds)())
    return b"".join(parts)


def number(random):
    return random.choice(NUMBERS).encode()


def json_string(random):
    """A string of JSON: with escapes, of lone surrogates among others, or with its bytes as they are."""
    kind = random.randrange(4)
    if kind == 0:
        return b'"' + text(random).replace(b"\\", b"\\\\").replace(b'"', b'\\"') + b'"'
    if kind == 1:
        lone = random.choice(["\ud800", "\udfff", "\udc00\ud800", "\ud83d"])
        return json.dumps(lone + text(random, is_valid=True).decode()).encode()
    return json.dumps(text(random, is_valid=True).decode(), ensure_ascii=kind == 2).encode()


STRING = re.compile(rb'"(?:[^"\\]|\\.)*"')
JSON_NUMBER = re.compile(rb"(?<![\w.\"-])-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?(?![\w.\"])")
QUOTED = re.compile(rb"'[^'\n]*'|\"[^\"\n]*\"")
CONTENT = re.compile(rb'(?<=>)[^<>\s][^<>]*(?=<)|(?<==")[^"]*(?=")')


def filled(random, document, pattern, draw):
    """`document` with one to three of the places that `pattern` finds filled by `draw`."""
    for _ in range(random.choice([1, 1, 2, 3])):
        places = list(pattern.finditer(document))
        if not places:
            break
        place = random.choice(places)
        document = document[:place.start()] + draw(place.group()) + document[place.end():]
    return document


def in_json(random, document):
    """JSON, or lines of it, with hostile strings or numbers; now and then with a mark of byte order before it."""
    if random.random() < 0.7:
        document = filled(random, document, STRING, lambda _: json_string(random))
    else:
        document = filled(random, document, JSON_NUMBER, lambda _: number(random))
    return random.choice([b""] * 19 + [b"\xef\xbb\xbf"]) + document


def program_string(random):
    """A string of a program or a fleet; its control characters as escapes or as they are."""
    quote = random.choice(["'", '"'])
    if random.random() < 0.3:
        inside = text(random).replace(b"\n", b" ").replace(quote.encode(), b"")
        return quote.encode() + inside.replace(b"\\", b"\\\\") + quote.encode()
    escaped = "".join(
        "\\" + c if c in "\\'\"$" else f"\\u{ord(c):04x}" if c < " " or "\x7f" <= c < "\xa0" else c
        for c in text(random, is_valid=True).decode())
    return (quote + escaped + quote).encode()


def in_program(random, document):
    """A program or a fleet with hostile strings or numbers."""
    if random.random() < 0.8:
        return filled(random, document, QUOTED, lambda _: program_string(random))
    return filled(random, document, JSON_NUMBER, lambda _: number(random))


ENCODINGS = ["UTF-8", "utf-16", "UTF-16LE", "ISO-8859-1", "ISO-8859-15", "windows-1252", "US-ASCII", "Shift_JIS", "UTF-7",
             "none"]


def in_xml(random, document):
    """XML with hostile contents and attributes; half of it declares an encoding, which need not be its own."""
    def written(_):
        if random.random() < 0.3:
            return number(random)
        raw = text(random)
        kind = random.randrange(3)
        if kind == 0:
            return raw
        if kind == 1:
            return b"".join(b"&#%d;" % ord(c) for c in raw.decode(errors="replace"))
        return raw.replace(b"&", b"&amp;").replace(b"<", b"&lt;").replace(b'"', b"&quot;")
    document = filled(random, document, CONTENT, written)
    if random.random() < 0.5:
        declared, own = random.choice(ENCODINGS), random.choice(ENCODINGS)
        body = re.sub(rb"^<\?xml.*?\?>", b"", document).decode(errors="replace")
        try:
            document = (f'<?xml version="1.0" encoding="{declared}"?>' + body).encode(own, errors="ignore")
        except LookupError:
            document = (f'<?xml version="1.0" encoding="{declared}"?>' + body).encode()
    return document


COLUMN = re.compile(rb"[^\t\n]+")


def in_columns(random, document):
    """Lines of columns, as those of `.waypoints`, with hostile columns."""
    return filled(random, document, COLUMN,
                  lambda _: number(random) if random.random() < 0.7 else text(random).replace(b"\n", b""))


def file_name(random, ending):
    """The name of a file that has a hostile text in it."""
    return text(random).translate(None, b"/\x00")[:100] + b"x" + ending


def in_query(random):
    """A hostile value in the query of a request: mostly in percent-encoding."""
    if random.random() < 0.7:
        return urllib.parse.quote_from_bytes(text(random))
    return text(random, is_valid=True).decode()
