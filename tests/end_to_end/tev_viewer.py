#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""tev_viewer.py PORT_FILE RESULT: listens as tev does, one render long, and writes what it holds then.

PORT_FILE receives the port of 127.0.0.1, RESULT the image's name, the number of updates, and the
average of each channel.
"""
import json
import os
import socket
import struct
import sys

import numpy

CREATE_IMAGE, UPDATE_IMAGE_V3 = 4, 6


def received(connection, count):
    data = bytearray()
    while len(data) < count:
        part = connection.recv(count - len(data))
        if not part:
            return None
        data += part
    return bytes(data)


def text_at(packet, at):
    end = packet.index(b"\0", at)
    return packet[at:end].decode(), end + 1


def take(packet, viewed):
    kind = packet[0]
    name, at = text_at(packet, 2)
    if kind == CREATE_IMAGE:
        width, height, _ = struct.unpack_from("<iii", packet, at)
        viewed.update(name=name, picture=numpy.zeros((height, width, 3), numpy.float32), updates=0)
        return
    assert kind == UPDATE_IMAGE_V3 and name == viewed["name"], (kind, name)
    channels, = struct.unpack_from("<i", packet, at)
    at += 4
    for _ in range(channels):
        _, at = text_at(packet, at)
    x, y, width, height = struct.unpack_from("<iiii", packet, at)
    at += 16 + 16 * channels
    pixels = numpy.frombuffer(packet, "<f4", offset=at).reshape(height, width, channels)
    viewed["picture"][y:y + height, x:x + width] = pixels
    viewed["updates"] += 1


def main(port_file, result):
    listener = socket.create_server(("127.0.0.1", 0))
    with open(port_file + ".new", "w", encoding="utf-8") as file:
        file.write(str(listener.getsockname()[1]))
    os.replace(port_file + ".new", port_file)
    connection, _ = listener.accept()
    viewed = {}
    while (length := received(connection, 4)) is not None:
        take(received(connection, struct.unpack("<I", length)[0] - 4), viewed)
    average = viewed.pop("picture").mean(axis=(0, 1), dtype=numpy.float64).tolist()
    with open(result, "w", encoding="utf-8") as file:
        json.dump({**viewed, "average": average}, file)


main(*sys.argv[1:])
