"""In which encoding bytes are text."""

from __future__ import annotations

import codecs
import re
from typing import BinaryIO

from forgetting.record.formats.recognise import looks_wide

CHUNK = 1 << 20
MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
CYRILLIC = re.compile(rb"[\xc0-\xff\xa8\xb8]{3,}")
DEGREES = ((b"\xb0", "cp1252"), (b"\xf8", "cp850"), (b"\xa1", "mac_roman"))
"""How the degree sign of °C and °F is written in the code pages of Windows, DOS and old Macs."""


def encoding(stream: BinaryIO) -> str:
    """Name the encoding; the stream is left at its begin.

    UTF-8, -16 and -32 are recognised for certain. Everything else is a guess: the code page of
    Western Europe, or that of Cyrillic where letters beyond ASCII come in words of their own.
    """
    stream.seek(0)
    head = stream.read(4096)
    stream.seek(0)
    for mark, name in MARKS:
        if head.startswith(mark):
            return name
    if b"\x00" in head and looks_wide(head):
        return "utf-16-le" if head[::2].count(0) < head[1::2].count(0) else "utf-16-be"
    odd = undecodable(stream)
    stream.seek(0)
    return "utf-8" if odd is None else code_page(odd)


def undecodable(stream: BinaryIO) -> bytes | None:
    """The first stretch of bytes that is no UTF-8, or None."""
    decoder = codecs.getincrementaldecoder("utf-8")()
    while chunk := stream.read(CHUNK):
        try:
            decoder.decode(chunk)
        except UnicodeDecodeError:
            return chunk
    try:
        decoder.decode(b"", final=True)
    except UnicodeDecodeError as error:
        return bytes(error.object)
    return None


def code_page(text: bytes) -> str:
    """Guess a code page of single bytes."""
    for sign, name in DEGREES:
        if sign + b"C" in text or sign + b"F" in text:
            return name
    high = sum(byte > 127 for byte in text)
    words = sum(len(word) for word in CYRILLIC.findall(text))
    if high and words > 0.8 * high:
        return "cp1251"
    try:
        text.decode("cp1252")
    except UnicodeDecodeError:
        return "latin-1"
    return "cp1252"
