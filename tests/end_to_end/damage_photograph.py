#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""damage_photograph.py KIND SOURCE TARGET: a photograph as it may come, and may not be read.

KIND: profile (no profile at all where one should be), half_profile (one of two pieces), link (a
profile between devices), huge (a header that claims 60000 x 60000 px), bomb (a PNG's profile that
unpacks to 200 MB). SOURCE and TARGET are JPEG, or PNG for huge and bomb.
"""
import os
import struct
import sys
import zlib


def segment(content, piece=1, pieces=1):
    """APP2 of a JPEG with a piece of a profile [ICC.1:2010, B.4]."""
    data = b'ICC_PROFILE\0' + bytes([piece, pieces]) + content
    return b'\xff\xe2' + struct.pack('>H', len(data) + 2) + data


def header(kind):
    """A profile of nothing but its header, of a class."""
    return (struct.pack('>I4sI', 132, b'lcms', 0x04000000) + kind + b'RGB XYZ ' + bytes(12) +
            b'acsp' + bytes(28) + struct.pack('>3I', 0xf6d6, 0x10000, 0xd32d) + bytes(48) + bytes(4))


def chunk(name, data):
    return struct.pack('>I', len(data)) + name + data + struct.pack('>I', zlib.crc32(name + data))


def damaged_jpeg(kind, jpeg):
    if kind == 'huge':
        frame = next(at for marker in (b'\xff\xc0', b'\xff\xc2') if (at := jpeg.find(marker)) > 0)
        return jpeg[:frame + 5] + struct.pack('>2H', 60000, 60000) + jpeg[frame + 9:]
    added = {'profile': segment(b'none' * 100), 'half_profile': segment(header(b'mntr'), 1, 2),
             'link': segment(header(b'link'))}[kind]
    return jpeg[:2] + added + jpeg[2:]


def damaged_png(kind, png):
    if kind == 'huge':
        return png[:8] + chunk(b'IHDR', struct.pack('>2I', 60000, 60000) + png[24:29]) + png[33:]
    assert kind == 'bomb'
    return png[:33] + chunk(b'iCCP', b'profile\0\0' + zlib.compress(bytes(200 << 20), 9)) + png[33:]


def main():
    kind, source, target = sys.argv[1:]
    with open(source, 'rb') as file:
        content = file.read()
    damage = damaged_png if os.path.splitext(target)[1] == '.png' else damaged_jpeg
    with open(target, 'wb') as file:
        file.write(damage(kind, content))


main()
