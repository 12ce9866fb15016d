#!/usr/bin/env python3
"""Checks JSON against the schemas of the corpus: as much of JSON Schema as they use.

Usage: schema.py SCHEMA FILES...      each file is one value
       schema.py SCHEMA --lines       each line of standard input is one
"""

import json
import os
import re
import sys

KNOWN = {"$schema", "$defs", "$ref", "title", "type", "properties", "required", "additionalProperties", "items",
         "oneOf", "not", "enum", "const", "pattern", "minimum", "maximum", "minItems", "maxItems",
         "minProperties", "minLength", "maxLength", "multipleOf", "exclusiveMinimum",
         "dependentRequired", "allOf", "description"}
TYPES = {"object": dict, "array": list, "string": str, "boolean": bool, "null": type(None)}
DOCUMENTS = {}


def document(path):
    if path not in DOCUMENTS:
        with open(path, encoding="utf-8") as file:
            DOCUMENTS[path] = json.load(file)
    return DOCUMENTS[path]


def resolve(reference, path):
    """The schema that a reference means, and the file that it stands in."""
    name, pointer = reference.split("#")
    path = os.path.join(os.path.dirname(path), name) if name else path
    schema = document(path)
    for part in filter(None, pointer.split("/")):
        schema = schema[part]
    return schema, path


def has_type(value, name):
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if name == "number":
        return is_number
    if name == "integer":
        return is_number and value == int(value)
    return isinstance(value, TYPES[name])


def wrong(value, schema, path, at="$"):
    """The faults of a value, as a list of sentences."""
    unknown = set(schema) - KNOWN
    assert not unknown, unknown
    found = []
    if "$ref" in schema:
        found += wrong(value, *resolve(schema["$ref"], path), at)
    types = schema.get("type", [])
    types = [types] if isinstance(types, str) else types
    if types and not any(has_type(value, name) for name in types):
        return found + [f"{at}: {json.dumps(value)[:60]} is not of type {types}"]
    if "const" in schema and value != schema["const"]:
        found.append(f"{at}: {json.dumps(value)[:60]} is not {json.dumps(schema['const'])}")
    if "enum" in schema and value not in schema["enum"]:
        found.append(f"{at}: {json.dumps(value)[:60]} is none of {schema['enum']}")
    if "not" in schema and not wrong(value, schema["not"], path, at):
        found.append(f"{at}: this is what it should not be")
    if "oneOf" in schema:
        each = [wrong(value, one, path, at) for one in schema["oneOf"]]
        fits = sum(not one for one in each)
        if fits == 0:
            found += min(each, key=len)
        elif fits > 1:
            found.append(f"{at}: {fits} of the possibilities fit")
    for one in schema.get("allOf", []):
        found += wrong(value, one, path, at)
    if isinstance(value, dict):
        found += [f"{at}: {name} is missing" for name in schema.get("required", []) if name not in value]
        for name, others in schema.get("dependentRequired", {}).items():
            found += [f"{at}: {name} without {other}" for other in others if name in value and other not in value]
        properties, others = schema.get("properties", {}), schema.get("additionalProperties", True)
        for name, x in value.items():
            if name in properties:
                found += wrong(x, properties[name], path, f"{at}.{name}")
            elif others is False:
                found.append(f"{at}: {name} is not known")
            elif isinstance(others, dict):
                found += wrong(x, others, path, f"{at}.{name}")
        if len(value) < schema.get("minProperties", 0):
            found.append(f"{at}: there are too few members")
    elif isinstance(value, list):
        if len(value) < schema.get("minItems", 0):
            found.append(f"{at}: there are too few items")
        if len(value) > schema.get("maxItems", len(value)):
            found.append(f"{at}: there are too many items")
        for i, x in enumerate(value):
            found += wrong(x, schema.get("items", {}), path, f"{at}[{i}]")
    elif isinstance(value, str):
        if "pattern" in schema and not re.search(schema["pattern"], value):
            found.append(f"{at}: {value!r} is not like {schema['pattern']}")
        if len(value) < schema.get("minLength", 0):
            found.append(f"{at}: this is empty")
        if len(value) > schema.get("maxLength", len(value)):
            found.append(f"{at}: this is too long")
    elif has_type(value, "number"):
        if not schema.get("minimum", value) <= value <= schema.get("maximum", value):
            found.append(f"{at}: {value} is out of range")
        if value <= schema.get("exclusiveMinimum", float("-inf")):
            found.append(f"{at}: {value} is too small")
        if "multipleOf" in schema and value % schema["multipleOf"] != 0:
            found.append(f"{at}: {value} is not a multiple of {schema['multipleOf']}")
    return found


def values(arguments):
    if arguments == ["--lines"]:
        for number, line in enumerate(sys.stdin, 1):
            yield f"line {number}", json.loads(line)
    else:
        for path in arguments:
            with open(path, encoding="utf-8") as file:
                yield path, json.load(file)


def main(path, arguments):
    count = bad = 0
    for name, value in values(arguments):
        count += 1
        found = wrong(value, document(path), path)
        if found:
            bad += 1
            print(f"{name}: {found[0]}")
    print(f"{count} checked, {bad} wrong")
    return 0 if bad == 0 and count > 0 else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
