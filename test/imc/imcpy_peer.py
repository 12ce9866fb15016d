"""Packets of imcpy, for the tests of our codec. Usage:

  imcpy_peer.py read FACTS < HEX          each line a packet in hexadecimal
  imcpy_peer.py make FACTS SEED COUNT     COUNT packets of each message in facts.jsonl, with any values

Prints a line of JSON for each packet: its content, field by field, and its bytes as imcpy writes them. """
import json
import math
import random
import sys

import imcpy


def definitions(path):
    with open(path, encoding="utf-8") as file:
        lines = [json.loads(line) for line in file]
    groups = {name: members for line in lines for name, members in line.get("groups", {}).items()}
    return {line["abbrev"]: line for line in lines if "id" in line}, groups


def attribute(field):
    """imcpy spells all names in lower case."""
    return field["name"].lower()


# Showing.

def number(x):
    if math.isfinite(x):
        return x
    return "NaN" if math.isnan(x) else "Infinity" if x > 0 else "-Infinity"


def shown(value, field, messages):
    kind = field["type"]
    if kind == "message":
        return None if value is None else message(value, messages)
    if kind == "message-list":
        return [message(m, messages) for m in value]
    if kind == "plaintext":
        return value
    if kind == "rawdata":
        return value.hex()
    return number(value) if kind.startswith("fp") else int(value)


def message(m, messages):
    name = m.msg_name
    fields = {"abbrev": name}
    for field in messages[name]["fields"]:
        try:
            fields[field["name"]] = shown(getattr(m, attribute(field)), field, messages)
        except TypeError as error:
            # imcpy 1.1.2 has no Boolean, the type of three fields of Sample.
            fields[field["name"]] = {"unreadable": str(error).split("\n")[0]}
    return fields


def tell(packet, messages):
    header = {key: getattr(packet, key) for key in ("timestamp", "src", "src_ent", "dst", "dst_ent")}
    print(json.dumps({"header": header, "message": message(packet, messages),
                      "hex": imcpy.Packet.serialize(packet).hex()}))


# Making.

WIDTHS = {"uint8_t": (0, 8), "uint16_t": (0, 16), "uint32_t": (0, 32), "int8_t": (1, 7), "int16_t": (1, 15),
          "int32_t": (1, 31)}


def integer(chance, kind):
    signed, bits = WIDTHS[kind]
    low, high = -(2 ** bits) if signed else 0, 2 ** bits - 1
    return chance.choice([low, high, chance.randint(low, high), chance.randint(0, 10)])


def real(chance):
    return chance.choice([0.0, -0.0, math.inf, -math.inf, chance.uniform(-1, 1), chance.uniform(-1e9, 1e9)])


def text(chance):
    return "".join(chance.choice("abc XYZ=;0123\t\"\\") for _ in range(chance.randint(0, 12)))


def fill(m, name, chance, depth, messages, groups):
    for field in messages[name]["fields"]:
        kind, key = field["type"], attribute(field)
        if kind in ("message", "message-list"):
            restriction = field.get("message-type")
            of_type = groups.get(restriction, [restriction]) if restriction else sorted(messages)
            count = 0 if depth == 0 else chance.randint(0, 1 if kind == "message" else 3)
            for _ in range(count):
                inner = chance.choice(of_type)
                part = fill(getattr(imcpy, inner)(), inner, chance, depth - 1, messages, groups)
                if kind == "message":
                    setattr(m, key, part)
                else:
                    getattr(m, key).append(part)
            continue
        if kind == "plaintext":
            value = text(chance)
        elif kind == "rawdata":
            value = chance.randbytes(chance.randint(0, 12))
        elif kind.startswith("fp"):
            value = real(chance)
        elif field.get("unit") == "Enumerated":
            try:
                enumeration = type(getattr(m, key))
            except TypeError:
                continue
            value = enumeration(chance.choice(field["values"])[0])
        else:
            value = integer(chance, kind)
        setattr(m, key, value)
    return m


def make(messages, groups, seed, count):
    for name in messages:
        for i in range(count):
            chance = random.Random(f"{seed} {name} {i}")
            m = fill(getattr(imcpy, name)(), name, chance, 3, messages, groups)
            m.timestamp, m.src, m.src_ent, m.dst, m.dst_ent = 1700000000.25, 0x1A, 3, 0x4001, 255
            yield m


def main():
    messages, groups = definitions(sys.argv[2])
    if sys.argv[1] == "read":
        packets = (imcpy.Packet.deserialize(bytes.fromhex(line)) for line in sys.stdin)
    else:
        packets = make(messages, groups, sys.argv[3], int(sys.argv[4]))
    for packet in packets:
        tell(packet, messages)


if __name__ == "__main__":
    main()
