#!/usr/bin/env python3
"""Makes the C++ of lcm-gen safe against messages from the wire.

usage: harden.py TYPE.lcm GENERATED.hpp HARDENED.hpp

What lcm-gen 1.3 writes trusts every count and length in a message. This script reads the type's definition and adds to
the generated header, member by member, the checks of wire_checks.hpp:

- decode refuses a negative count, a count that the bytes left cannot hold, a string without its end, and a message
  with bytes left over; a count of 0 empties the array also in an object used before;
- encode refuses a count that is not its array's size, and a string with a NUL inside (it would be cut off);
- getEncodedSize goes by what the arrays hold, so it never reads past their end;
- numbers start at 0.

A header that does not look as expected is an error: no output is written, so that no build goes on unhardened.
"""

import re
import sys
from pathlib import Path

NUMBER_BYTES = {"byte": 1, "boolean": 1, "int8_t": 1, "int16_t": 2, "int32_t": 4, "int64_t": 8,
                "float": 4, "double": 8}


class Unexpected(Exception):
    """The definition or the generated header is not of the form that this script knows."""


class Member:
    def __init__(self, name, type_name, dims):
        self.name = name
        self.type = type_name
        self.dims = dims  # outermost first: a number, or the name of the member that counts

    @property
    def is_number(self):
        return self.type in NUMBER_BYTES

    @property
    def is_string(self):
        return self.type == "string"

    @property
    def is_vector(self):
        return bool(self.counts())

    def counts(self):
        """The dimensions that a message states, as C++."""
        return [f"this->{dim}" for dim in self.dims if not dim.isdigit()]

    def sizes(self):
        """Every dimension, as C++."""
        return [dim if dim.isdigit() else f"this->{dim}" for dim in self.dims]

    def element_bytes(self):
        """C++ expression of the fewest bytes that one element takes on the wire."""
        if self.is_number:
            return str(NUMBER_BYTES[self.type])
        if self.is_string:
            return "5"  # length and terminator
        return self.type.replace(".", "::") + "::least_wire_size()"

    def least_bytes(self):
        """C++ expression of the fewest bytes for one step of the stated counts: the element times the fixed dimensions."""
        return " * ".join([self.element_bytes()] + [dim for dim in self.dims if dim.isdigit()])


def parse_definition(text):
    """(package.struct, members) of a .lcm file with one struct."""
    text = re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.S)
    match = re.fullmatch(r"\s*package\s+(\w+)\s*;\s*struct\s+(\w+)\s*\{([^{}]*)\}\s*", text, flags=re.S)
    if not match:
        raise Unexpected("not one package with one struct")
    package, struct, body = match.groups()
    *statements, rest = [" ".join(statement.split()) for statement in body.split(";")]
    if rest:
        raise Unexpected(f"no semicolon after '{rest}'")
    members = []
    for statement in statements:
        if statement.startswith("const "):
            continue
        declaration = re.fullmatch(r"([\w.]+) (.+)", statement)
        if not declaration:
            raise Unexpected(f"cannot read '{statement}'")
        for declarator in declaration[2].split(","):
            array = re.fullmatch(r"(\w+)((?: ?\[ ?\w+ ?\])*)", declarator.strip())
            if not array:
                raise Unexpected(f"cannot read '{statement}'")
            members.append(Member(array[1], qualified(declaration[1], package), re.findall(r"\w+", array[2])))
    return f"{package}.{struct}", members


def check_bounded(own_type, members):
    """Refuses what no check of a message could bound."""
    if any(member.type == own_type for member in members):
        raise Unexpected("a type that holds itself can be nested to any depth")
    if not members or any(dim == "0" for member in members for dim in member.dims):
        raise Unexpected("elements of no bytes can be claimed in any number")


def qualified(name, package):
    if name in NUMBER_BYTES or name == "string" or "." in name:
        return name
    return f"{package}.{name}"


def substitute(pattern, replacement, text, expected, what):
    """Replaces every match; their number must be as expected."""
    text, found = re.subn(pattern, replacement, text, flags=re.M | re.S)
    if found != expected:
        raise Unexpected(f"{what}: {found} places instead of {expected}")
    return text


def patch_function(header, signature, patch):
    """Hands the body of one generated function to `patch` and puts back what it returns."""
    head, opening, rest = header.partition(signature + "\n{\n")
    body, closing, tail = rest.partition("\n}\n")
    if not opening or not closing or opening in tail:
        raise Unexpected(f"no single definition of '{signature}'")
    return head + opening + patch(body) + closing + tail


def patch_members(body, members, patch):
    """Applies `patch` to the paragraph of each member; lcm-gen separates them by empty lines, in order."""
    head, *paragraphs = body.split("\n\n")
    tail = paragraphs.pop() if paragraphs else ""
    if head != "    int pos = 0, tlen;" or tail != "    return pos;" or len(paragraphs) != len(members):
        raise Unexpected(f"{len(paragraphs)} paragraphs for {len(members)} members")
    for member, paragraph in zip(members, paragraphs):
        if not re.search(rf"\bthis->{member.name}\b", paragraph):
            raise Unexpected(f"member '{member.name}' is not where it should be")
    return "\n\n".join([head, *map(patch, members, paragraphs), tail])


def fits(member):
    return f"floornav::wire::array_fits({{{', '.join(member.counts())}}}, {member.least_bytes()}, maxlen - pos)"


def harden_decode_of(member, paragraph):
    if member.is_string:
        paragraph = substitute(r"if\((\w+) > maxlen - pos\) return -1;",
                               r"if(!floornav::wire::is_string((const char*)buf + offset + pos, \1, maxlen - pos)) return -1;",
                               paragraph, 1, f"length of '{member.name}'")
    resizes = paragraph.count(".resize(")
    if resizes != (len(member.dims) if member.is_vector else 0):
        raise Unexpected(f"'{member.name}' is resized {resizes} times")
    if not member.is_vector:
        return paragraph
    if member.is_number:  # the resize comes out of the condition, so that a count of 0 resizes too
        paragraph = substitute(r"^( *)if\(([^\n]*)\) \{\n +(this->[^\n]*\.resize\([^\n]*\);)\n", r"\1\3\n\1if(\2) {\n",
                               paragraph, 1, f"resize of '{member.name}'")
    return f"    if(!{fits(member)}) return -1;\n{paragraph}"


def harden_encode_of(member, paragraph):
    if member.is_string:
        paragraph = substitute(r"^( *)(char\* \w+ = \(char\*\) (this->[^\n]*)\.c_str\(\);)",
                               r"\1if(\3.find('\\0') != std::string::npos) return -1;\n\1\2",
                               paragraph, 1, f"string '{member.name}'")
    if not member.is_vector:
        return paragraph
    sizes = ", ".join([f"this->{member.name}"] + member.sizes())
    return f"    if(!floornav::wire::has_sizes({sizes})) return -1;\n    if(!{fits(member)}) return -1;\n{paragraph}"


def encoded_size_body(members):
    arguments = ", ".join(f"this->{member.name}" for member in members)
    return f"    return floornav::wire::total_size({arguments});"


def least_wire_size(members):
    """Definition of a static member function; stated arrays may be empty and do not count."""
    terms = " + ".join(member.least_bytes() for member in members if not member.is_vector)
    return ("        /**\n         * The fewest bytes that this struct takes inside a message.\n         */\n"
            f"        static constexpr int least_wire_size() {{ return {terms}; }}\n\n")


def harden(definition, header):
    full_name, members = parse_definition(definition)
    check_bounded(full_name, members)
    struct = full_name.split(".")[1]
    vectors = [member for member in members if member.is_vector]
    plain_numbers = [member for member in members if member.is_number and not member.is_vector]

    header = substitute(r"^#include <lcm/lcm_coretypes\.h>\n", '\\g<0>#include "lcmtypes/wire_checks.hpp"\n', header, 1,
                        "include of lcm_coretypes.h")
    if len(re.findall(r"^        std::vector< ", header, flags=re.M)) != len(vectors):
        raise Unexpected("the header's vectors are not the definition's arrays")
    for member in plain_numbers:
        header = substitute(rf"^(        \w+ +{member.name}(?:\[\d+\])*);$", r"\1{};", header, 1,
                            f"member '{member.name}'")
    header = substitute(r"^        // LCM support functions\.", least_wire_size(members) + r"\g<0>", header, 1,
                        "support functions")

    header = substitute(r"^    int64_t msg_hash;$", "    int64_t msg_hash = 0;", header, 1, "fingerprint")
    header = patch_function(
        header, f"int {struct}::decode(const void *buf, int offset, int maxlen)",
        lambda body: substitute(r"^    return pos;\Z", "    if (pos != maxlen) return -1;\n    return pos;", body, 1,
                                "end of decode"))
    header = patch_function(header, f"int {struct}::_decodeNoHash(const void *buf, int offset, int maxlen)",
                            lambda body: patch_members(body, members, harden_decode_of))
    header = patch_function(header, f"int {struct}::_encodeNoHash(void *buf, int offset, int maxlen) const",
                            lambda body: patch_members(body, members, harden_encode_of))
    header = patch_function(header, f"int {struct}::_getEncodedSizeNoHash() const", lambda _: encoded_size_body(members))

    for what, found in (("decode", header.count("    if(!floornav::wire::array_fits(")),
                        ("encode", 2 * header.count("    if(!floornav::wire::has_sizes("))):
        if found != 2 * len(vectors):
            raise Unexpected(f"{what}: {found} checks for {len(vectors)} arrays")
    return header


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__.splitlines()[2])
    definition, generated, hardened = map(Path, sys.argv[1:])
    try:
        text = harden(definition.read_text(), generated.read_text())
    except Unexpected as error:
        sys.exit(f"{definition}: lcm-gen's C++ cannot be hardened: {error}")
    hardened.parent.mkdir(parents=True, exist_ok=True)
    hardened.write_text(text)


if __name__ == "__main__":
    main()
