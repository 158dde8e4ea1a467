"""What a case file says, whatever its comments, its layout and the order of its keys.

Two texts have the same digest if they have the same keys with the same values. A value is its text: `1e-3 m` and `1 mm` differ, as do
`1` and `1.0`, and a word and the same word in quotes, so nothing is lost. The items of a list have an order. No defaults are filled in:
those are the program's, which has a digest of its own. An alias counts as what it repeats.

A text counts byte by byte if Python's YAML and the programs' may take it otherwise (tabs), if the programs refuse
it (tags, a key twice), and if Python has no yaml.
"""
import functools
import hashlib
import json

try:
    import yaml
except ImportError:
    yaml = None

OTHERWISE = "\t\r\x85\u2028\u2029\ufeff"  # letters that versions of YAML, or the programs, take otherwise


class Otherwise(Exception):
    """The text counts byte by byte."""


@functools.lru_cache(maxsize=256)
def read(data):
    """(digest, texts of all values) of the bytes of a case file; no texts where it counts byte by byte."""
    try:
        if yaml is None:
            raise Otherwise
        texts = set()
        return "values " + digest_of_text(data.decode("utf-8"), texts), frozenset(texts)
    except (Otherwise, UnicodeDecodeError, RecursionError):
        return "bytes " + hashlib.sha256(data).hexdigest(), frozenset()


def digest_of_text(text, texts):
    if any(letter in text for letter in OTHERWISE):
        raise Otherwise
    try:
        events = [one for one in yaml.parse(text, Loader=yaml.SafeLoader)
                  if not isinstance(one, (yaml.StreamStartEvent, yaml.StreamEndEvent, yaml.DocumentEndEvent))]
    except yaml.YAMLError as error:
        raise Otherwise from error
    starts = [one for one in events if isinstance(one, yaml.DocumentStartEvent)]
    if len(starts) != 1 or starts[0].version or starts[0].tags:
        raise Otherwise
    return digest_of_node(iter(events[1:]), {}, texts)


def digest_of_node(events, anchors, texts):
    """Digest of the node that comes next. A digest for each node, so that aliases of aliases cost nothing."""
    return digest_of_event(next(events), events, anchors, texts)


def digest_of_event(event, events, anchors, texts):
    if isinstance(event, yaml.AliasEvent):
        if event.anchor not in anchors:  # one that stands within itself
            raise Otherwise
        return anchors[event.anchor]
    if event.tag is not None:
        raise Otherwise
    if isinstance(event, yaml.ScalarEvent):
        texts.add(event.value)
        made = digest_of_scalar(event)
    elif isinstance(event, yaml.SequenceStartEvent):
        made = digest_of(["list", list(items_of(events, anchors, texts))])
    else:
        made = digest_of(["map", map_of(events, anchors, texts)])
    if event.anchor is not None:
        anchors[event.anchor] = made
    return made


def digest_of_scalar(event):
    """One over several lines counts as it is written: there is more than one way to fold it."""
    start, end = event.start_mark, event.end_mark
    if event.style in ("|", ">") or start.line != end.line:
        return digest_of(["written", start.buffer[start.pointer:end.pointer]])
    return digest_of(["plain" if event.implicit[0] else "quoted", event.value])


def items_of(events, anchors, texts):
    while not isinstance(event := next(events), yaml.SequenceEndEvent):
        yield digest_of_event(event, events, anchors, texts)


def map_of(events, anchors, texts):
    """{key: digest of its value}; keys are single words, each once, and `<<` is none: the programs refuse others."""
    found = {}
    while not isinstance(event := next(events), yaml.MappingEndEvent):
        if not isinstance(event, yaml.ScalarEvent) or event.tag or event.anchor or event.value in found or event.value == "<<":
            raise Otherwise
        found[event.value] = digest_of_node(events, anchors, texts)
    return found


def digest_of(node):
    return hashlib.sha256(json.dumps(node, sort_keys=True).encode()).hexdigest()
