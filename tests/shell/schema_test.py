# SPDX-License-Identifier: LGPL-3.0-or-later
"""`rubato schema` and the program's own check: the schema takes whatever the program takes, and no fault passes
both."""

import copy
import json
import random

import corpus
import jsonschema
import pytest

SCHEMA = json.loads(corpus.outcome("schema")[1])
VALIDATOR = jsonschema.Draft7Validator(SCHEMA)
FILES = corpus.of_files()
DOCUMENTS = corpus.of_documents()
TESTS = corpus.of_tests()


def objections(deck, validator=VALIDATOR):
    return ["/".join(map(str, error.absolute_path)) + ": " + error.message for error in validator.iter_errors(deck)]


def test_the_schema_is_one_of_draft_7():
    jsonschema.Draft7Validator.check_schema(SCHEMA)


def test_there_are_decks_to_look_at():
    assert len(FILES) >= 25 and len(DOCUMENTS) >= 10 and len(TESTS) >= 10


@pytest.mark.parametrize("name", FILES)
def test_decks_of_files_are_taken_by_both(name):
    assert objections(corpus.load(FILES[name])) == []
    assert corpus.refusal(FILES[name]) == ""


@pytest.mark.parametrize("name", DOCUMENTS)
def test_decks_and_parts_of_the_pages_validate(name):
    part = corpus.load(DOCUMENTS[name]) or {}  # a comment by itself is shown, too
    if corpus.is_whole(part):
        assert objections(part) == []
        assert corpus.refusal(DOCUMENTS[name]) == ""
        return
    if not set(part) <= set(SCHEMA["properties"]):  # a key of a contact zone by itself
        part = {"contact": {"zone": part}}
    whole = {key: value for key, value in SCHEMA.items() if key not in ("if", "then")}
    assert objections(part, jsonschema.Draft7Validator(whole)) == []


@pytest.mark.parametrize("name", TESTS)
def test_decks_of_the_tests_that_the_program_takes_validate(name):
    if corpus.refusal(TESTS[name]) == "":
        assert objections(corpus.load(TESTS[name])) == []


def test_echoes_validate(tmp_path):
    deck = next(name for name in FILES if name.endswith("shrink_fit.yaml"))
    folder = str(tmp_path / "out")
    code, _, errors = corpus.outcome("run", str(corpus.SOURCES / deck), "-q", "-o", folder)
    assert code == 0, errors
    for run in sorted((tmp_path / "out").glob("*/run.json")):
        assert objections(json.loads(run.read_text())["study"]) == []


# ---- every key and word of the schema means something to the program ------------------------------------------


def keys_of(schema, path=()):
    """Paths of keys, names that users choose left out, and the words each may have."""
    for choice in schema.get("anyOf", [schema]):
        here = SHARED.get(choice.get("title"), path)
        for word in choice.get("enum", []):
            if word is not None:
                yield here, word
        for key, value in choice.get("properties", {}).items():
            yield here + (key,), None
            yield from keys_of(value, here + (key,))
        for inner in ("items", "additionalProperties"):
            if isinstance(choice.get(inner), dict):
                yield from keys_of(choice[inner], here)


def keys_in(value, path=(), names=False):
    """The same of a deck. `names`: the keys of the value are names."""
    if isinstance(value, list):
        for item in value:
            yield from keys_in(item, path)
    elif isinstance(value, dict):
        if "along" in value and ("at" in value or "csv" in value):
            path = SHARED["a table along an axis"]
        elif "field" in value and "name" in value:
            path = SHARED[FIELD_OF_FILE]
        for key, inner in value.items():
            here = path if names else path + (key,)
            yield here, None
            below = SHARED["a factor"] if here == ("functions", "product") else here
            yield from keys_in(inner, below, not names and here in NAMED)
    elif value is not None:
        yield path, value


def named_in(schema, path=()):
    """Paths of the maps whose keys are names."""
    for choice in schema.get("anyOf", [schema]):
        if "propertyNames" in choice:
            yield path
        for key, value in choice.get("properties", {}).items():
            yield from named_in(value, path + (key,))


NAMED = set(named_in({**SCHEMA, "properties": {k: v for k, v in SCHEMA["properties"].items() if k != "runs"}}))

# What may stand in many places is looked for once, by the title of its map.
FIELD_OF_FILE = "a field at the nodes of a file, on the same mesh"
SHARED = {"a table along an axis": ("table",), FIELD_OF_FILE: ("field of a file",), "a factor": ("functions",)}


def test_every_key_and_word_of_the_schema_stands_in_a_deck_that_the_program_takes():
    declared = set(keys_of({**SCHEMA, "properties": {k: v for k, v in SCHEMA["properties"].items() if k != "runs"}}))
    used = set()
    for text in [*FILES.values(), *TESTS.values()]:
        if corpus.refusal(text) == "":
            deck = corpus.load(text)
            for part in [deck, *(deck.get("runs") or {}).values()]:
                used |= {entry for entry in keys_in(part or {}) if not isinstance(entry[1], (float, bool))}
    assert sorted(declared - used, key=str) == []


# edges and corners of a body are named by the sides that meet
PLACES = {"left", "right", "bottom", "top", "back", "front"}


def test_every_key_of_the_schema_is_described_and_stands_in_the_guide():
    guide = (corpus.SOURCES / "docs/guide/deck.md").read_text(encoding="utf-8")

    def properties(schema):
        for choice in schema.get("anyOf", [schema]):
            for key, value in choice.get("properties", {}).items():
                yield key, value
                yield from properties(value)
            for inner in ("items", "additionalProperties"):
                if isinstance(choice.get(inner), dict):
                    yield from properties(choice[inner])

    for key, value in properties(SCHEMA):
        assert value.get("description"), key
        assert key in guide or key.partition("_")[0] in PLACES, key


# ---- decks with one fault ---------------------------------------------------------------------------------------


def places(value, schema, path=()):
    """(path, schema of the value) of everything in a deck; schemas with a choice give those that fit."""
    yield path, schema
    for choice in schema.get("anyOf", [schema]):
        if isinstance(value, dict) and choice.get("type") == "object":
            for key, inner in value.items():
                known = choice.get("properties", {}).get(key, choice.get("additionalProperties"))
                if isinstance(known, dict):
                    yield from places(inner, known, path + (key,))
        if isinstance(value, list) and choice.get("type") == "array":
            for number, inner in enumerate(value):
                yield from places(inner, choice["items"], path + (number,))


def at(deck, path):
    for step in path:
        deck = deck[step]
    return deck


def put(deck, path, value):
    at(deck, path[:-1])[path[-1]] = value


def misspelt(word, random):
    letter = random.randrange(len(word))
    return word[:letter] + random.choice("qjxw") + word[letter:]


def misspell_key(deck, found, random):
    path, schema = random.choice([(p, s) for p, s in found if p and isinstance(p[-1], str) and "description" in s])
    holder = at(deck, path[:-1])
    renamed = {misspelt(key, random) if key == path[-1] else key: value for key, value in holder.items()}
    holder.clear()
    holder.update(renamed)
    return path


def change_kind(deck, found, random):
    """No value may be a list of lists, or a map with such a key."""
    path, _ = random.choice([(p, s) for p, s in found if p])
    value = at(deck, path)
    put(deck, path, {"nothing": 1} if isinstance(value, list) else random.choice([[[value]], {"nothing": 1}]))
    return path


def misspell_word(deck, found, random):
    def has_words(schema, value):
        return any(value in choice.get("enum", []) for choice in schema.get("anyOf", [schema]) if isinstance(value, str))

    path, _ = random.choice([(p, s) for p, s in found if p and has_words(s, at(deck, p))])
    put(deck, path, misspelt(at(deck, path), random))
    return path


def leave_out(deck, _, random):
    part = random.choice(["mesh", "physics", "materials", "time"])
    for holder in [deck, *(deck.get("runs") or {}).values()]:
        if holder:
            holder.pop(part, None)
    return (part,)


def leave_the_bounds(deck, found, random):
    def bounds(schema):
        return [
            beyond
            for choice in schema.get("anyOf", [schema])
            for beyond in [
                *([choice["minimum"] - 1] if "minimum" in choice else []),
                *([choice["maximum"] + 1] if "maximum" in choice else []),
                *([choice["exclusiveMinimum"]] if "exclusiveMinimum" in choice else []),
                *([choice["exclusiveMaximum"]] if "exclusiveMaximum" in choice else []),
            ]
        ]

    path, schema = random.choice([(p, s) for p, s in found if p and bounds(s) and isinstance(at(deck, p), (int, float))])
    put(deck, path, random.choice(bounds(schema)))
    return path


FAULTS = [misspell_key, change_kind, misspell_word, leave_out, leave_the_bounds]


def faulty_decks(count):
    """Decks of the files, each with one fault; the same ones at each call."""
    choice = random.Random(17)
    names = sorted(FILES)
    for number in range(count):
        fault = FAULTS[number % len(FAULTS)]
        deck = corpus.load(FILES[names[choice.randrange(len(names))]])
        deck = json.loads(json.dumps(deck))  # anchors stand for copies
        found = list(places(deck, SCHEMA))
        path = fault(deck, found, choice)
        yield f"{number} {fault.__name__} {'.'.join(map(str, path))}", deck


def test_each_of_200_decks_with_one_fault_is_refused_by_the_schema_or_by_the_program():
    passed_both, counts = [], {"schema": 0, "program": 0}
    for name, deck in faulty_decks(200):
        by_schema = objections(deck) != []
        by_program = corpus.refusal(json.dumps(deck)) != ""
        counts["schema"] += by_schema
        counts["program"] += by_program
        assert by_program or not by_schema, f"{name}: the schema refuses what the program takes"
        if not by_schema and not by_program:
            passed_both.append(name)
    print(counts)
    assert passed_both == []


# ---- decks that are changed in any way --------------------------------------------------------------------------


def changed(deck, pool, choice):
    """One or two values taken away, put elsewhere, or replaced by another value of any deck."""
    deck = copy.deepcopy(deck)
    for _ in range(choice.randrange(1, 3)):
        found = [path for path, _ in places(deck, SCHEMA) if path]
        path = choice.choice(found)
        holder, key = at(deck, path[:-1]), path[-1]
        what = choice.randrange(5)
        if what == 0:
            del holder[key]
        elif what == 1:
            holder[key] = None
        elif what == 2:
            holder[key] = choice.choice(pool)[1]
        elif what == 3:  # a value of the same key elsewhere
            holder[key] = choice.choice([value for other, value in pool if other == key] or [holder[key]])
        else:
            holder[key] = choice.choice(["true", True, "1", 1, 0, -1, 0.5, "", "auto", "all", "x", [], {}, [1, 2], "1+1"])
    return deck


def test_whatever_deck_the_program_takes_the_schema_takes():
    choice = random.Random(4)
    decks = [json.loads(json.dumps(corpus.load(FILES[name]))) for name in sorted(FILES)]
    pool = [(path[-1], at(deck, path)) for deck in decks for path, _ in places(deck, SCHEMA) if path]
    taken = 0
    for _ in range(800):
        deck = changed(choice.choice(decks), pool, choice)
        if corpus.refusal(json.dumps(deck)) == "":
            taken += 1
            assert objections(deck) == [], json.dumps(deck)
    print(f"{taken} of 800 are taken by the program")
    assert taken > 100
