"""`forgetting.h` against the Rust source: every function, structure and code is declared as it is
compiled. What the source says is written as C here, and compared with the header as text.
"""

from __future__ import annotations

import re
from pathlib import Path

CRATE = Path(__file__).parents[2] / "crates" / "forgetting-c"
HEADER = (CRATE / "include" / "forgetting.h").read_text(encoding="utf-8")
SOURCE = {
    path.relative_to(CRATE / "src").as_posix(): path.read_text(encoding="utf-8")
    for path in (CRATE / "src").rglob("*.rs")
}

TYPES = {
    "i32": "int32_t",
    "u32": "uint32_t",
    "u64": "uint64_t",
    "u8": "uint8_t",
    "usize": "size_t",
    "f32": "float",
    "f64": "double",
    "c_char": "char",
    "Kind": "fg_kind",
    "Estimator": "fg_estimator",
    "Settings": "fg_settings",
    "Choice": "fg_choice",
    "Parameter": "fg_parameter",
    "Text": "fg_text",
    "Why": "fg_why",
    "Health": "fg_health_report",
    "Report<f32>": "fg_report_f32",
    "Report<f64>": "fg_report_f64",
}
"""What a type of the source is called in C."""

STRUCTURES = {
    ("code.rs", "Text", None): "fg_text",
    ("code.rs", "Why", None): "fg_why",
    ("settings.rs", "Parameter", None): "fg_parameter",
    ("settings.rs", "Choice", None): "fg_choice",
    ("settings.rs", "Settings", None): "fg_settings",
    ("report.rs", "Report<T>", "f32"): "fg_report_f32",
    ("report.rs", "Report<T>", "f64"): "fg_report_f64",
    ("report.rs", "Health", None): "fg_health_report",
}
"""Where a structure of C is in the source, and what its T is."""


def without_comments(text: str) -> str:
    """C or Rust without comments, on one line."""
    text = re.sub(r"/\*.*?\*/", " ", text, flags=re.DOTALL)
    return " ".join(re.sub(r"//[^\n]*|^\s*#[^\n]*", " ", text, flags=re.MULTILINE).split())


def declared(name: str, rust: str) -> str:
    """A variable of this type in C; bytes of any kind are `void *`, text is `char *`."""
    if array := re.fullmatch(r"\[(\w+); (\d+)\]", rust):
        return f"{TYPES[array[1]]} {name}[{array[2]}]"
    const = "const " if rust.startswith("*const") else ""
    target = re.sub(r"\*(const|mut) ", "", rust)
    stars = "*" * len(re.findall(r"\*(?:const|mut)", rust))
    word = TYPES[target]
    if stars and target == "u8":
        word = "char" if name == "text" else "void"
    return f"{const}{word} {stars}{name}"


def functions_of_source() -> set[str]:
    """Every exported function; those that a macro makes for both number types are written out."""
    text = SOURCE["api/mod.rs"] + SOURCE["api/typed.rs"] + SOURCE["kinds.rs"]
    body = text[text.index("macro_rules! typed") : text.index("\ntyped!(")]
    places = re.findall(r"\$(\w+):ident", body)
    calls = re.findall(r"^typed!\((.*?)\);", text, flags=re.MULTILINE | re.DOTALL)
    text = text.replace(body, "")
    for call in calls:
        real, _, *names = [part.strip() for part in call.split(",")]
        made = body.replace("$T", real)
        for place, name in zip(places, names, strict=True):
            made = made.replace(f"fn ${place}(", f"fn {name}(")
        text += made
    found = set()
    pattern = r'extern "C" fn (fg_\w+)\(([^)]*)\)\s*->\s*([^{]+)\{'
    for name, arguments, result in re.findall(pattern, without_comments(text)):
        pairs = [part.split(":", 1) for part in arguments.split(",") if part.strip()]
        words = [declared(argument.strip(), rust.strip()) for argument, rust in pairs]
        found.add(f"{declared(name, result.strip())}({', '.join(words) or 'void'})")
    return found


def test_every_function_is_declared_as_it_is_compiled() -> None:
    text = without_comments(HEADER)
    found = re.findall(r"((?:const )?\w+ \*?fg_\w+\([^)]*\));", text)
    assert len(found) == len(set(found)) > 15
    assert set(found) == functions_of_source()


def test_every_structure_has_the_fields_of_the_source() -> None:
    header = without_comments(HEADER)
    for (file, name, real), word in STRUCTURES.items():
        source = without_comments(SOURCE[file])
        body = re.search(rf"pub struct {re.escape(name)} \{{(.*?)\}}", source)
        assert body, name
        fields = [part.strip().removeprefix("pub ") for part in body[1].split(",")]
        pairs = [field.split(": ", 1) for field in fields if field]
        expected = [
            declared(field, real if real and rust == "T" else rust) for field, rust in pairs
        ]
        given = re.search(rf"typedef struct {word} \{{(.*?)\}} {word};", header)
        assert given, word
        assert [part.strip() for part in given[1].split(";") if part.strip()] == expected, word
    assert len(re.findall(r"typedef struct \w+ \{", header)) == len(STRUCTURES)


def test_every_code_has_its_number() -> None:
    source = dict(re.findall(r"(\w+) = (\d+)", without_comments(SOURCE["code.rs"])))
    header = dict(re.findall(r"FG_(\w+) = (\d+)", without_comments(HEADER)))
    assert header.pop("F32") == "4"
    assert header.pop("F64") == "8"
    names = {re.sub(r"(?<!^)(?=[A-Z])", "_", name).upper(): code for name, code in source.items()}
    expected = {"OK" if name == "OK" else f"ERROR_{name}": code for name, code in names.items()}
    assert header == expected


def test_every_kind_is_declared() -> None:
    lines = re.findall(r'^\s+\w+ "(\w+)" \[([\d ]+)\];', SOURCE["kinds.rs"], flags=re.MULTILINE)
    assert set(re.findall(r"FG_COMPACT_KINDS\((\w+)\);", HEADER)) == {rule for rule, _ in lines}
    sizes = {f"fg_##rule##_{real}_{n}" for real in ("f32", "f64") for n in range(1, 9)}
    assert all(numbers.split() == [str(n) for n in range(1, 9)] for _, numbers in lines)
    assert set(re.findall(r"fg_##rule##_f\d+_\d+", HEADER)) == sizes
    general = re.findall(r"^\s+(fg_general_\w+): \w+, \d+;", SOURCE["kinds.rs"], flags=re.MULTILINE)
    assert set(re.findall(r"fg_general_\w+", without_comments(HEADER))) == set(general)
