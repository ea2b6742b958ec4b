# SPDX-License-Identifier: GPL-3.0-or-later
"""cad_figures.py SHARED PROGRAM FOLDER: converts every file of SHARED/data/cad and the gallery's
building, and prints a line "ok: ..." or "FAIL: ..." for each figure of their SOURCE.txt."""
import collections
import json
import pathlib
import subprocess
import sys

import numpy as np

shared, program, folder = (pathlib.Path(argument) for argument in sys.argv[1:])
cad = shared / 'data/cad'


def check(good, text):
    print(f'{"ok" if good else "FAIL"}: {text}')


class Converted:
    """A model converted alone, in a site of its own."""

    def __init__(self, path):
        site = folder / path.name
        site.mkdir(exist_ok=True)
        report = site / 'report.json'
        run = subprocess.run([program, site, '--model', path, '--report', report],
                             capture_output=True, text=True, timeout=100)
        self.status, self.message = run.returncode, run.stderr.strip()
        self.report = json.loads(report.read_text()) if report.exists() else None
        if self.status == 0:
            self.description = json.loads((site / 'work/building.json').read_text())
            mesh = self.description['mesh']
            data = (site / 'work/building.bin').read_bytes()
            n, m = mesh['vertices'], mesh['triangles']
            self.vertices = np.frombuffer(data, '<f8', 3 * n).reshape(n, 3)
            self.triangles = np.frombuffer(data, '<i4', 3 * m, 24 * n).reshape(m, 3)
            self.materials = np.frombuffer(data, '<i4', m, 24 * n + 12 * m)

    def box(self, key=''):
        source = self.report['files'][0] if key else self.report
        return np.array([source['bbox_min' + key], source['bbox_max' + key]])

    def areas(self):
        a, b, c = (self.vertices[self.triangles[:, i]] for i in range(3))
        return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def records(path):
    """The records of an ASCII DXF in sections ENTITIES and BLOCKS, each a list of (code, value)."""
    lines = [line.strip() for line in path.read_bytes().decode('latin1').split('\n')]
    found, section, kept = [], None, None
    for code, value in zip(lines[::2], lines[1::2]):
        if code == '0':
            kept = [] if section in ('ENTITIES', 'BLOCKS') else None
            if kept is not None:
                found.append(kept)
            section = None if value == 'SECTION' else section
        elif code == '2' and section is None:
            section = value
        if kept is not None:
            kept.append((code, value))
    return found


def counted(path):
    """Entities by kind as they stand in the file, blocks included."""
    parts = {'VERTEX', 'SEQEND', 'ATTRIB', 'BLOCK', 'ENDBLK', 'ENDSEC', 'SECTION', 'EOF'}
    return dict(collections.Counter(r[0][1] for r in records(path) if r[0][1] not in parts))


def face_box(path):
    """The box of all 3DFACE of a drawing, in its units."""
    values = [dict(r) for r in records(path) if r[0][1] == '3DFACE']
    corners = np.array([[[float(v[f'{axis}{corner}']) for axis in (1, 2, 3)] for corner in range(4)]
                        for v in values]).reshape(-1, 3)
    return corners.min(axis=0), corners.max(axis=0)


def entities(name, converted, **counts):
    found = {kind: converted.report['entities'].get(kind.lstrip('_'), 0) for kind in counts}
    check(found == counts, f'{name}: {found}')


def box(name, converted, low, high, tolerance):
    found = converted.box('_in_units')
    check(np.abs(found - [low, high]).max() <= tolerance, f'{name}: box {found.tolist()}')


def all_files():
    """Every drawing in text holds what a plain count of its records finds."""
    for path in sorted(p for p in cad.glob('*/*') if p.suffix.lower() == '.dxf'):
        if path.read_bytes().startswith(b'AutoCAD Binary') or path.name == 'recover01.dxf':
            continue
        one, expected = Converted(path), counted(path)
        keys = {'triangles', 'bbox_min', 'bbox_max', 'layers', 'entities', 'skipped'}
        check(one.report and keys <= one.report.keys() and one.report['entities'] == expected,
              f'{path.name}: {sum(expected.values())} entities of {len(expected)} kinds')
        told = one.status == 0 or 'has no surface to show' in one.message
        check(told, f'{path.name}: ' + (one.message or f'{one.report["triangles"]} triangles'))


def acadsharp():
    for version in ('AC1009', 'AC1021', 'AC1032'):
        ascii_, binary = (Converted(cad / f'acadsharp/sample_{version}_{kind}.dxf')
                          for kind in ('ascii', 'binary'))
        for kind, one in (('ascii', ascii_), ('binary', binary)):
            if version == 'AC1009':
                entities(f'{version} {kind}', one, POLYLINE=312, LINE=1324, SOLID=345, INSERT=83,
                         _3DFACE=1)
            else:
                entities(f'{version} {kind}', one, LWPOLYLINE=23, LINE=98, MESH=2, _3DSOLID=2,
                         REGION=1, SPLINE=2, POLYLINE=2, INSERT=14)
        check(len(ascii_.triangles) == len(binary.triangles) and
              np.abs(ascii_.vertices - binary.vertices).max() < 1e-9 and
              (ascii_.triangles == binary.triangles).all(),
              f'{version}: ASCII and binary give the same {len(ascii_.triangles)} triangles')


def assimp():
    box('wuson', Converted(cad / 'assimp/wuson.dxf'), (-0.46, 0, -1.62), (0.46, 1.52, 1.62), 0.006)
    basin = Converted(cad / 'assimp/issue_2229.dxf')
    box('issue_2229', basin, (-600, -420, 0), (600, 0, 116), 1e-6)
    entities('issue_2229', basin, POLYLINE=4)
    egg = Converted(cad / 'assimp/PinkEggFromLW.dxf')
    entities('PinkEgg', egg, _3DFACE=288)
    box('PinkEgg', egg, *face_box(cad / 'assimp/PinkEggFromLW.dxf'), 1e-9)
    check(egg.report['solids']['open_edges'] == 0, 'PinkEgg is closed')


def ezdxf():
    entities('POLI-ALL210_12', Converted(cad / 'ezdxf/POLI-ALL210_12.DXF'), POLYLINE=30)
    for name in ('r12', 'r13', 'r14'):
        lines = Converted(cad / f'ezdxf/bin_dxf_{name}.dxf')
        entities(f'bin_dxf_{name}', lines, LINE=3)
        check(lines.status == 2 and '3 LINE' in lines.message, f'bin_dxf_{name}: {lines.message}')
    damaged = Converted(cad / 'ezdxf/recover01.dxf')
    check(damaged.status == 2 and 'recover01.dxf:29472: ' in damaged.message, damaged.message)
    acis()


# Closed forms: a ball of radius 5, a ring of radii 32 and 10; five solids of planes, cones and a torus.
def acis():
    ball = Converted(cad / 'ezdxf/sphere.dxf').report
    check(ball['spheres'] == 1 and abs(ball['area_m2'] - 100 * np.pi) < 1e-9 and
          abs(ball['volume_m3'] - 500 / 3 * np.pi) < 1e-9, f'sphere: {ball["area_m2"]} m2')
    for name in ('torus_r2000', 'torus_r2010'):
        ring = Converted(cad / f'ezdxf/{name}.dxf').report
        area, volume = 1280 * np.pi ** 2, 6400 * np.pi ** 2
        check(abs(ring['area_m2'] / area - 1) < 5e-4 and abs(ring['volume_m3'] / volume - 1) < 5e-4,
              f'{name}: {ring["area_m2"]} m2, {ring["volume_m3"]} m3')
    report = Converted(cad / 'ezdxf/3dsolids.dxf').report
    left_out = [entry['kind'] for entry in report['skipped'] if '3DSOLID' in entry['kind']]
    solids = report['solids']
    check(not left_out and solids['open_edges'] == solids['crowded_edges'] == 0 and
          solids['bodies'] == solids['closed_bodies'], f'3dsolids: {left_out}, {solids}')


def window_area():
    path = cad / 'doe_medium_office/RefBldgMediumOfficeNew2004_Chicago.epJSON'
    model = json.loads(path.read_text())
    area = 0
    for window in model['FenestrationSurface:Detailed'].values():
        corners = np.array([[window[f'vertex_{i}_{axis}_coordinate'] for axis in 'xyz']
                            for i in range(1, 5)])
        diagonals = corners[2] - corners[0], corners[3] - corners[1]
        area += np.linalg.norm(np.cross(*diagonals)) / 2
    return area


def office():
    one = Converted(cad / 'doe_medium_office/RefBldgMediumOffice_from_epJSON.dxf')
    entities('DOE office', one, _3DFACE=140)
    path = cad / 'doe_medium_office/RefBldgMediumOffice_from_epJSON.dxf'
    box('DOE office', one, *face_box(path), 1e-9)
    size = one.box()[1] - one.box()[0]
    check(np.abs(size - [49.91, 33.27, 11.89]).max() < 0.005, f'DOE office: {size.tolist()} m')
    # Walls, floors, ceilings and roofs, windows each have a colour of their own.
    colours = [tuple(m['diffuse_rgb']) for m in one.description['materials']]
    areas = collections.defaultdict(list)
    for material, area in zip(one.materials, one.areas()):
        areas[colours[material]].append(area)
    groups = sorted(areas.values(), key=len)
    counts = [len(group) for group in groups]
    check(counts == [24, 52, 60, 144], f'DOE office: triangles by colour {counts}')
    found, stated = sum(groups[0]), window_area()
    check(abs(found - stated) < 0.001 * stated,
          f'DOE office: {found:.2f} m2 of windows, {stated:.2f} in the epJSON')
    found = [entry for entry in one.report['warnings'] if 'drawn on' in entry]
    check(bool(found), f'DOE office: {found}')


def house():
    one = Converted(cad / 'fzk_haus_ifc/AC14-FZK-Haus.ifc')
    layers = one.report['layers']
    for kind, count in (('IfcWindow_', 11), ('IfcDoor_', 5)):
        found = [name for name in layers if name.startswith(kind) and layers[name] > 0]
        check(len(found) == count, f'FZK-Haus: {len(found)} {kind.strip("_")}')
    names = [m['name'] for m in one.description['materials']]
    check('Glas' in names, 'FZK-Haus: its glass is there')
    opened = [name for name, element in one.report['elements'].items()
              if element['volume_m3'] is None and not name.startswith('IfcFurnishingElement_')]
    check(not opened, f'FZK-Haus: but for furniture, which the file leaves open, open are {opened}')
    # The walls of the ground floor: 12 m x 10 m.
    low = one.vertices[(one.vertices[:, 2] > 0.5) & (one.vertices[:, 2] < 2.0)]
    size = low.max(axis=0) - low.min(axis=0)
    walls = np.abs(size[:2] - [12, 10]).max()
    check(walls < 0.01, f'FZK-Haus: walls {size[:2].round(3).tolist()} m')


def gallery():
    dxf, obj = (Converted(shared / f'data/gallery/building/building.{kind}')
                for kind in ('dxf', 'obj'))
    same = len(dxf.triangles) == len(obj.triangles)
    check(same, f'gallery: {len(dxf.triangles)} triangles as DXF, {len(obj.triangles)} as OBJ')
    off = max(distances(dxf.vertices, obj.vertices), distances(obj.vertices, dxf.vertices))
    check(off <= 2e-5, f'gallery: vertices of DXF and OBJ are {off:.1e} m apart')
    area = abs(dxf.areas().sum() / obj.areas().sum() - 1)
    check(area < 1e-5, f'gallery: areas of DXF and OBJ differ by {area:.1e}')


def distances(these, those):
    """The largest distance from one of these points to the nearest of those."""
    worst = 0
    for start in range(0, len(these), 500):
        part = these[start:start + 500, None] - those[None]
        worst = max(worst, np.sqrt((part ** 2).sum(axis=2).min(axis=1)).max())
    return worst


for part in (all_files, acadsharp, assimp, ezdxf, office, house, gallery):
    part()
