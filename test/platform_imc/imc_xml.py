"""Writes the messages of facts.jsonl as an IMC.xml, with a type of systems and a message that Dolphin does not know.
Usage:

  imc_xml.py FACTS [OLD=>NEW ...] > IMC.xml    each OLD is replaced by NEW in what is written
"""
import json
import sys
from xml.sax.saxutils import quoteattr

TYPES = ["CCU", "HUMANSENSOR", "UUV", "USV", "UAV", "UGV", "STATICSENSOR", "MOBILESENSOR", "WSN", "ROV"]


def tag(name, attributes, inside=()):
    words = "".join(f" {key}={quoteattr(str(value))}" for key, value in attributes.items() if value is not None)
    return [f"<{name}{words}>", *("  " + line for part in inside for line in part), f"</{name}>"]


def field(f):
    values = [tag("value", {"id": number, "abbrev": name}) for number, name in f.get("values") or []]
    keys = {"abbrev": f["name"], "type": f["type"], "unit": f.get("unit"), "message-type": f.get("message-type")}
    return tag("field", keys, values)


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        lines = [json.loads(line) for line in file]
    messages = [line for line in lines if "id" in line]
    groups = {name: members for line in lines for name, members in line.get("groups", {}).items()}
    messages.append({"id": 256, "abbrev": "AngularVelocity",
                     "fields": [{"name": name, "type": "fp64_t"} for name in ("time", "x", "y", "z")]})
    types = tag("def", {"abbrev": "SystemType"},
                [tag("value", {"id": number, "abbrev": name}) for number, name in enumerate(TYPES)])
    members = [tag("message-group", {"abbrev": name}, [tag("message-type", {"abbrev": member}) for member in group])
               for name, group in groups.items()]
    page = tag("messages", {"name": "IMC", "version": "5.4.31"},
               [tag("enumerations", {}, [types]), tag("message-groups", {}, members)]
               + [tag("message", {"id": m["id"], "abbrev": m["abbrev"]}, map(field, m["fields"])) for m in messages])
    text = "\n".join(page)
    for change in sys.argv[2:]:
        old, new = change.split("=>")
        assert old in text, old
        text = text.replace(old, new, 1)
    print(text)


if __name__ == "__main__":
    main()
