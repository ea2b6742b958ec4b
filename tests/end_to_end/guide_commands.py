#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""guide_commands.py PAGE...: runs the commands of pages, lines "$ insitu ..." in their blocks, in this folder, and
compares what each prints with what follows it there: numbers may differ, words may not; "..." stands for any lines."""
import re
import shlex
import subprocess
import sys


def blocks(page):
    """(command, expected lines) of a page."""
    with open(page, encoding="utf-8") as file:
        for block in re.findall(r"^```\n(.*?)^```", file.read(), re.M | re.S):
            for text in re.split(r"^\$ ", block, flags=re.M)[1:]:
                command, *expected = text.splitlines()
                yield command, expected


def masked(line):
    return re.sub(r"\d+(\.\d+)?", "#", line)


def is_as_told(printed, expected):
    if expected[-1:] == ["..."]:
        expected = expected[:-1]
        printed = printed[:len(expected)]
    return list(map(masked, printed)) == list(map(masked, expected))


status = count = 0
for page in sys.argv[1:]:
    for command, expected in blocks(page):
        count += 1
        done = subprocess.run(shlex.split(command), text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if done.returncode == 0 and is_as_told(done.stdout.splitlines(), expected):
            print(f"ok: {command}")
        else:
            status = 1
            print(f"FAIL: {command}, status {done.returncode}:", done.stdout.replace("\n", " | "))
if count == 0:
    sys.exit("no commands")
sys.exit(status)
