"""A file of blocks, each with a rolling hash of all before it: what was written is known to be whole.

    magic
    block*      kind (1 byte)  length (4 bytes, little-endian)  hash of both (4 bytes)  content  rolling hash (8 bytes)

The rolling hash of a block is the hash of the one before, of its kind, length and content. A file that ends
within a block was cut off (its writer was killed, or still writes); every block before the cut is good.
"""

import hashlib
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO, NamedTuple

from formicarium.campaigns.files import StoreError, unwritable

MAGIC = b"formicarium recording 1\n"
HEAD = struct.Struct("<cI")
HEAD_HASH = 4  # bytes
HASH = 8  # bytes
HEADER, FRAMES, EVENTS, DEED, BACK, END = (b"H", b"F", b"E", b"I", b"R", b"Z")  # kinds of blocks


class Block(NamedTuple):
    """One block."""

    kind: bytes
    content: bytes


class Damaged(StoreError):
    """A file of blocks is not what was written."""


def _rolled(before: bytes, content: bytes, size: int = HASH) -> bytes:
    return hashlib.blake2b(before + content, digest_size=size).digest()


class BlockWriter:
    """Appends blocks to a new file; each is on its way to the disk when ``write`` returns."""

    def __init__(self, path: Path):
        """Make the file.

        Raises:
            StoreError: if it cannot be written.
        """
        self.path = path
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            self._file: BinaryIO = path.open("xb", buffering=0)
            self._file.write(MAGIC)
        except OSError as error:
            raise unwritable(path, error) from error
        self._hash = hashlib.blake2b(MAGIC, digest_size=HASH).digest()

    def write(self, kind: bytes, content: bytes) -> None:
        """Append a block.

        Raises:
            StoreError: if the disk is full.
        """
        head = HEAD.pack(kind, len(content))
        head += _rolled(self._hash, head, HEAD_HASH)
        self._hash = _rolled(self._hash, head + content)
        try:
            self._file.write(head + content + self._hash)
        except OSError as error:
            raise unwritable(self.path, error) from error

    def close(self) -> None:
        """Close the file."""
        self._file.close()


def read_blocks(path: Path) -> Iterator[Block]:
    """Yield the blocks of a file.

    Raises:
        Damaged: if it is no such file, or a block is not what was written.
        StoreError: if it cannot be read.
    """
    try:
        with path.open("rb") as file:
            yield from _blocks(path, file)
    except OSError as error:
        raise StoreError(f"cannot read {path}: {error.strerror or error}") from error


def _blocks(path: Path, file: BinaryIO) -> Iterator[Block]:
    if file.read(len(MAGIC)) != MAGIC:
        raise Damaged(f"{path} is no recording, or its first bytes are damaged")
    before, number = hashlib.blake2b(MAGIC, digest_size=HASH).digest(), 0
    while len(head := file.read(HEAD.size + HEAD_HASH)) == HEAD.size + HEAD_HASH:
        at = file.tell() - len(head)
        if _rolled(before, head[: HEAD.size], HEAD_HASH) != head[HEAD.size :]:
            raise _damage(path, number, at)
        kind, length = HEAD.unpack(head[: HEAD.size])
        content, kept = file.read(length), file.read(HASH)
        if len(content) < length or len(kept) < HASH:
            return  # cut off
        before = _rolled(before, head + content)
        if kept != before:
            raise _damage(path, number, at)
        yield Block(kind, content)
        number += 1


def _damage(path: Path, number: int, at: int) -> Damaged:
    return Damaged(
        f"{path} is damaged: block {number} (at byte {at}) is not what was written. "
        "What comes before it is whole; take another copy of the file."
    )
