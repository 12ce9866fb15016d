"""The lines of JSON that docs/platform.md shows must fit the schemas. Prints those that do not, and how many do."""
import json
import re
import sys

import schema

PAGE, SCHEMAS = sys.argv[1:]
ORDER, REPORT, PLAN = (f"{SCHEMAS}/{name}.schema.json" for name in ("platform-order", "platform-report", "plan"))
NAMES = {"R": "k3q9x2f1-4", "TEXT": "undefined plan"}


def blocks(text):
    """The values in the page's blocks of JSON, of which one may take several lines, and in its tables."""
    decoder = json.JSONDecoder()
    for block in re.findall(r"```json\n(.*?)```", text, re.S):
        while block.strip():
            value, end = decoder.raw_decode(block.strip())
            yield value
            block = block.strip()[end:]
    for line in re.findall(r'`(\{"kind".*?\})`', text):
        for name, word in NAMES.items():
            line = re.sub(rf"\b{name}\b", json.dumps(word), line)
        yield json.loads(line.replace("PLAN", '{"name": "survey1"}'))


good = 0
with open(PAGE, encoding="utf-8") as page:
    for value in blocks(page.read()):
        paths = (ORDER, REPORT) if "kind" in value else (PLAN,)
        wrong = [schema.wrong(value, schema.document(path), path) for path in paths]
        if all(wrong):
            print(json.dumps(value), wrong)
        else:
            good += 1
print(good, "fit")
