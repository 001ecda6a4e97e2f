# SPDX-License-Identifier: Apache-2.0
"""Reads what the command writes: float channels, whole lines, ZIP (16 lines a block)."""
import struct
import zlib

import numpy as np


def _text(data, at):
    end = data.index(0, at)
    return data[at:end].decode(), end + 1


def _header(data):
    attributes, at = {}, 8  # magic number and version
    while data[at]:
        name, at = _text(data, at)
        _, at = _text(data, at)  # its type
        (size,) = struct.unpack_from("<i", data, at)
        attributes[name] = data[at + 4 : at + 4 + size]
        at += 4 + size
    return attributes, at + 1


def _unpacked(block, size):
    if len(block) == size:
        return block  # as it is, where packing would not have made it smaller
    steps = np.frombuffer(zlib.decompress(block), np.uint8).astype(np.int64)
    steps[1:] -= 128
    halves = np.cumsum(steps).astype(np.uint8)
    bytes_ = np.empty(size, np.uint8)
    bytes_[0::2], bytes_[1::2] = halves[: (size + 1) // 2], halves[(size + 1) // 2 :]
    return bytes_.tobytes()


def read(path):
    """Dict of channel to (height, width) float32."""
    data = path.read_bytes()
    attributes, at = _header(data)
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    names, place = [], 0
    while attributes["channels"][place]:
        name, place = _text(attributes["channels"], place)
        names.append(name)
        place += 16
    channels = {name: np.empty((height, width), np.float32) for name in names}
    for (offset,) in struct.iter_unpack("<Q", data[at : at + 8 * ((height + 15) // 16)]):
        line, packed = struct.unpack_from("<2i", data, offset)
        lines = min(16, height - (line - top))
        block = _unpacked(data[offset + 8 : offset + 8 + packed], lines * len(names) * width * 4)
        values = np.frombuffer(block, "<f4").reshape(lines, len(names), width)
        for i, name in enumerate(names):
            channels[name][line - top : line - top + lines] = values[:, i]
    return channels
