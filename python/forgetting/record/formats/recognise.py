"""Which format some bytes are, by the marks with which each format begins."""

from __future__ import annotations

from typing import BinaryIO

MARKS: tuple[tuple[bytes, str], ...] = (
    (b"PAR1", "parquet"),
    (b"ARROW1", "arrow"),
    (b"FEA1", "arrow"),
    (b"\xff\xff\xff\xff", "arrow stream"),
    (b"PK\x03\x04", "zip"),
    (b"PK\x05\x06", "zip"),
    (b"\x1f\x8b", "gzip"),
    (b"\xfd7zXZ\x00", "xz"),
    (b"\x28\xb5\x2f\xfd", "zstd"),
    (b"BZh", "bzip2"),
    (b"\xd0\xcf\x11\xe0", "excel"),
    (b"MATLAB 7.3", "matlab"),
    (b"MATLAB 5.0", "matlab"),
    (b"\x89HDF", "hdf5"),
    (b"TDSm", "tdms"),
    (b"MDF  ", "mdf"),
    (b"UnFinMF ", "mdf"),
    (b"ULog\x01\x12\x35", "ulog"),
    (b"%PDF", "pdf"),
)
"""First bytes of a format and its name here; all that begins with none of them is text."""

UNICODE = (b"\xff\xfe", b"\xfe\xff", b"\xef\xbb\xbf")
CONTROLS = frozenset(range(32)) - frozenset(b"\t\n\v\f\r\x1a\x1b")


def recognise(stream: BinaryIO) -> str:
    """Name the format: one of `MARKS`, "json", "text", "binary" or "empty".

    The stream is left where it was.
    """
    start = stream.tell()
    head = stream.read(4096)
    stream.seek(start)
    if not head:
        return "empty"
    for mark, name in MARKS:
        if head.startswith(mark):
            return name
    if b"\x00" in head and not head.startswith(UNICODE) and not looks_wide(head):
        return "binary"
    if not head.startswith(UNICODE) and sum(byte in CONTROLS for byte in head) > len(head) // 20:
        return "binary" if not looks_wide(head) else "text"
    first = head.removeprefix(UNICODE[2]).lstrip()
    if first[:9].lower().startswith((b"<!doctype", b"<html", b"<?xml", b"<svg")):
        return "markup"
    return "json" if first.startswith((b'{"', b"{ ", b"[{", b"{\n", b"[\n")) else "text"


def looks_wide(head: bytes) -> bool:
    """Whether these bytes look like UTF-16 without a mark: every second byte is mostly zero."""
    even, odd = head[::2], head[1::2]
    zeros = sorted((even.count(0) / max(len(even), 1), odd.count(0) / max(len(odd), 1)))
    return zeros[0] < 0.05 and zeros[1] > 0.8
