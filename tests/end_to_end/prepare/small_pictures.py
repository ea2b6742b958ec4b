#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""small_pictures.py FOLDER PNG...: pictures of the page as PNG of a palette, under 120 kB, into FOLDER. The
photographs' noise is smoothed; letters and lines, whose contrast is high, are not. Needs python3-pil."""
import os
import sys

import cv2
from PIL import Image

MOST = 120000  # bytes
for name in sys.argv[2:]:
    smooth = cv2.bilateralFilter(cv2.imread(name), 5, 24, 4)
    image = Image.fromarray(cv2.cvtColor(smooth, cv2.COLOR_BGR2RGB))
    small = os.path.join(sys.argv[1], os.path.basename(name))
    for colours in (200, 160, 128, 96, 64):
        image.quantize(colours, method=Image.Quantize.MAXCOVERAGE, kmeans=3,
                       dither=Image.Dither.NONE).save(small, optimize=True)
        if os.path.getsize(small) < MOST:
            break
    print(f"{small}: {colours} colours, {os.path.getsize(small)} bytes")
