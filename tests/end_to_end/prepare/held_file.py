# SPDX-License-Identifier: GPL-3.0-or-later
"""held_file.py FILE WIDTH HEIGHT: writes FILE, a black PNG, and lets nobody open it (for 45 s at most, as Linux
does) until its own input ends: who reads the file waits."""
import fcntl
import signal
import sys

import cv2
import numpy

path, width, height = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
cv2.imwrite(path, numpy.zeros((height, width), numpy.uint8))
signal.signal(signal.SIGIO, lambda *_: None)  # somebody waits
with open(path, "r+b") as file:
    fcntl.fcntl(file, fcntl.F_SETLEASE, fcntl.F_WRLCK)
    print("held", flush=True)
    sys.stdin.read()
    fcntl.fcntl(file, fcntl.F_SETLEASE, fcntl.F_UNLCK)
