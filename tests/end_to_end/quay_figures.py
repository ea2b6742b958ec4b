#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""quay_figures.py quay|quay_dusk SITE SHARED: the figures of a montage of QY_4102.

Prints one line a figure, "ok: ..." or "FAIL: ...", with its bound: at most 15 % above what was
measured. score.py of the shared tools compares the pictures; figures are shares of doing nothing,
of all changed pixels by the error, of all else by Delta E.
"""
import json
import subprocess
import sys

PHOTO = 'QY_4102'
GROUPS = {
    'opaque building': ['FLOOR', 'ROOF', 'CORE_BRICK', 'FRAME', 'BACKWALL', 'TABLE_WOOD',
                        'LAMP_BODY'],
    'clear glass': ['GLASS_CLEAR'],
    'solid glass': ['GLASS_BLOCK'],
    'metal': ['CANOPY_METAL'],
    'polished stone': ['STEPS_STONE'],
}
CLASSES = {'shadow': 'shadows', 'lamp': 'lamp-lit ground', 'reflection': 'reflections in water'}
BOUNDS = {
    'quay': {
        'all changed pixels': 0.155, 'opaque building': 0.100, 'clear glass': 0.152,
        'solid glass': 0.197, 'metal': 0.257, 'polished stone': 0.0487, 'shadows': 0.199,
        'reflections in water': 0.212},
    'quay_dusk': {
        'all changed pixels': 0.246, 'opaque building': 0.189, 'clear glass': 0.186,
        'solid glass': 0.191, 'metal': 0.126, 'polished stone': 0.103, 'shadows': 0.321,
        'lamp-lit ground': 0.207, 'reflections in water': 0.236},
}


def of_group(materials, names):
    """Delta E over that of doing nothing, all pixels of some materials together."""
    there = [materials[name] for name in names if name in materials]
    error = sum(m['pixels'] * m['de2000_mean'] for m in there)
    return error / sum(m['pixels'] * m['de2000_mean'] / m['de_over_nothing'] for m in there)


def figures(name, site, shared):
    data = f'{shared}/data/{name}'
    scores = json.loads(subprocess.check_output(
        ['/usr/bin/python3', f'{shared}/tools/score.py', '--json',
         '--montage', f'{site}/montages/{PHOTO}.exr',
         '--truth', f'{data}/truth/{PHOTO}/after_gi.exr',
         '--before', f'{data}/photos_linear/{PHOTO}.exr',
         '--mask', f'{data}/truth/{PHOTO}/mask_gi.png',
         '--materials', f'{data}/truth/{PHOTO}/materials.png']))
    yield 'all changed pixels', scores['changed']['error_over_nothing']
    for group, names in GROUPS.items():
        yield group, of_group(scores['materials'], names)
    for key, what in CLASSES.items():
        if key in scores:
            yield what, scores[key]['de_over_nothing']


def main():
    name, site, shared = sys.argv[1:]
    for what, value in figures(name, site, shared):
        bound = BOUNDS[name][what]
        result = 'ok' if value <= bound else 'FAIL'
        print(f'{result}: {what} {value:.4f} of doing nothing, at most {bound}')


if __name__ == '__main__':
    main()
