#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""response_figures.py encode CURVE SOURCE TARGET: linear EXR as the JPEG of a camera of this curve.
response_figures.py compare LINEAR SITE: the sun over the sky that was measured, beside that which
linear photographs give, one line a channel: "ok: ..." or "FAIL: ...".

CURVE: filmic (toe and shoulder), channels (another one for each), kink (one about half the codes);
all of them none that insitu-light --fit-response has in its family.
"""
import json
import os
import sys

os.environ['OPENCV_IO_ENABLE_OPENEXR'] = '1'
import cv2
import numpy as np

BOUND = 0.05


def srgb(light):
    return np.where(light <= 0.0031308, 12.92 * light,
                    1.055 * np.power(np.maximum(light, 1e-9), 1 / 2.4) - 0.055)


def filmic(light):  # [Narkowicz 2015]
    def tone(x):
        return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)
    return srgb(tone(0.8 * light) / tone(0.8))


def channels(light):  # blue, green, red: a flatter one, one of more contrast, that of Rec. 709
    blue, green, red = (light[..., c] for c in range(3))
    code = srgb(green)
    return np.stack([srgb(blue) ** 0.9, code - 0.3 * np.sin(2 * np.pi * code) / (2 * np.pi),
                     np.where(red < 0.018, 4.5 * red, 1.099 * np.power(np.maximum(red, 1e-9), 0.45) - 0.099)], -1)


def kink(light):
    code = srgb(light)
    return code + 0.04 * np.exp(-((code - 0.5) / 0.08) ** 2) * (1 - code)


CURVES = {'filmic': filmic, 'channels': channels, 'kink': kink}


def encode(curve, source, target):
    light = np.clip(cv2.imread(source, cv2.IMREAD_UNCHANGED).astype(np.float64), 0, 1)
    codes = np.rint(255 * np.clip(CURVES[curve](light), 0, 1)).astype(np.uint8)
    if not cv2.imwrite(target, codes, [cv2.IMWRITE_JPEG_QUALITY, 95]):
        sys.exit(f'{target} cannot be written')


def sun_over_sky(site):
    with open(f'{site}/work/environment.json', encoding='utf-8') as file:
        light = json.load(file)['light']
    return np.divide(light['sun_irradiance_rgb'], light['open_sky_radiance_rgb'])


def compare(linear, site):
    for name, off in zip(('red', 'green', 'blue'), sun_over_sky(site) / sun_over_sky(linear) - 1):
        print(f"{'ok' if abs(off) <= BOUND else 'FAIL'}: sun over sky, {name}, off by {off:.4f}, at most {BOUND}")


def main():
    command, *arguments = sys.argv[1:]
    {'encode': encode, 'compare': compare}[command](*arguments)


if __name__ == '__main__':
    main()
