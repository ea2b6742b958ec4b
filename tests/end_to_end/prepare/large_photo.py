#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""large_photo.py WIDTH HEIGHT FILE: a photograph of this size with detail everywhere, in the format of its ending."""
import sys

import cv2
import numpy

width, height = int(sys.argv[1]), int(sys.argv[2])
random = numpy.random.default_rng(1)
image = numpy.zeros((height, width, 3), numpy.float32)
for step, weight in ((512, 60), (32, 40), (4, 16)):
    noise = random.normal(0, weight, (height // step + 2, width // step + 2, 3)).astype(numpy.float32)
    image += cv2.resize(noise, (width, height), interpolation=cv2.INTER_LINEAR)
cv2.imwrite(sys.argv[3], numpy.clip(128 + image, 0, 255).astype(numpy.uint8), [cv2.IMWRITE_JPEG_QUALITY, 90])
