#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""upright_photos.py FOLDER: upright.jpg, of 480 x 720 pixels, and turned.jpg, whose EXIF says that its 720 x 480 are to
be turned; each is grey, red in its file's lower left corner."""
import sys

from PIL import Image

for name, size in {"upright": (480, 720), "turned": (720, 480)}.items():
    image = Image.new("RGB", size, (128, 128, 128))
    image.paste((250, 10, 10), (0, size[1] - 60, 60, size[1]))
    exif = Image.Exif()
    if name == "turned":
        exif[0x0112] = 6
    image.save(f"{sys.argv[1]}/{name}.jpg", quality=95, subsampling=0, exif=exif)
