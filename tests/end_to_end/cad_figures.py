# SPDX-License-Identifier: GPL-3.0-or-later
"""cad_figures.py SHARED PROGRAM FOLDER: converts every file of SHARED/data/cad and the gallery's
building, and prints a line "ok: ..." or "FAIL: ..." for each figure of their SOURCE.txt."""
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
            mesh = json.loads((site / 'work/building.json').read_text())['mesh']
            data = (site / 'work/building.bin').read_bytes()
            n, m = mesh['vertices'], mesh['triangles']
            self.vertices = np.frombuffer(data, '<f8', 3 * n).reshape(n, 3)
            self.triangles = np.frombuffer(data, '<i4', 3 * m, 24 * n).reshape(m, 3)

    def box(self, key=''):
        source = self.report['files'][0] if key else self.report
        return np.array([source['bbox_min' + key], source['bbox_max' + key]])

    def corners(self):
        """Centres of gravity of all triangles, in order."""
        centres = self.vertices[self.triangles].mean(axis=1)
        return centres[np.lexsort(np.round(centres, 3).T)]


def entities(name, converted, **counts):
    found = {kind: converted.report['entities'].get(kind.lstrip('_'), 0) for kind in counts}
    check(found == counts, f'{name}: {found}')


def box(name, converted, low, high, tolerance):
    found = converted.box('_in_units')
    check(np.abs(found - [low, high]).max() <= tolerance, f'{name}: box {found.tolist()}')


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
    check(egg.report['solids']['open_edges'] == 0, 'PinkEgg is closed')


def ezdxf():
    entities('POLI-ALL210_12', Converted(cad / 'ezdxf/POLI-ALL210_12.DXF'), POLYLINE=30)
    for name in ('r12', 'r13', 'r14'):
        lines = Converted(cad / f'ezdxf/bin_dxf_{name}.dxf')
        entities(f'bin_dxf_{name}', lines, LINE=3)
        check(lines.status == 2 and '3 LINE' in lines.message, f'bin_dxf_{name}: {lines.message}')
    damaged = Converted(cad / 'ezdxf/recover01.dxf')
    check(damaged.status == 2 and 'recover01.dxf:29472: ' in damaged.message, damaged.message)
    for name in ('sphere', 'torus_r2000', 'torus_r2010', '3dsolids'):
        skipped = Converted(cad / f'ezdxf/{name}.dxf').report['skipped']
        acis = [entry for entry in skipped if entry['kind'] == '3DSOLID']
        check(len(acis) == 1 and 'ACIS' in acis[0]['reason'], f'{name}: {acis}')


def office():
    one = Converted(cad / 'doe_medium_office/RefBldgMediumOffice_from_epJSON.dxf')
    entities('DOE office', one, _3DFACE=140)
    box('DOE office', one, (0, 0, 0), (49.911, 33.2738, 11.8872), 0.006)
    found = [entry for entry in one.report['warnings'] if 'drawn on' in entry]
    check(bool(found), f'DOE office: {found}')


def house():
    one = Converted(cad / 'fzk_haus_ifc/AC14-FZK-Haus.ifc')
    layers = one.report['layers']
    for kind, count in (('IfcWindow_', 11), ('IfcDoor_', 5)):
        found = [name for name in layers if name.startswith(kind) and layers[name] > 0]
        check(len(found) == count, f'FZK-Haus: {len(found)} {kind.strip("_")}')
    data = json.loads((folder / 'AC14-FZK-Haus.ifc/work/building.json').read_text())
    check('Glas' in [m['name'] for m in data['materials']], 'FZK-Haus: its glass is there')
    # The walls of the ground floor: 12 m x 10 m.
    low = one.vertices[(one.vertices[:, 2] > 0.5) & (one.vertices[:, 2] < 2.0)]
    size = low.max(axis=0) - low.min(axis=0)
    check(np.abs(size[:2] - [12, 10]).max() < 0.35, f'FZK-Haus: walls {size[:2].round(3).tolist()} m')


def gallery():
    dxf, obj = (Converted(shared / f'data/gallery/building/building.{kind}')
                for kind in ('dxf', 'obj'))
    same = len(dxf.triangles) == len(obj.triangles)
    check(same, f'gallery: {len(dxf.triangles)} triangles as DXF, {len(obj.triangles)} as OBJ')
    off = max(distances(dxf.vertices, obj.vertices), distances(obj.vertices, dxf.vertices))
    check(off <= 2e-5, f'gallery: vertices of DXF and OBJ are {off:.1e} m apart')


def distances(these, those):
    """The largest distance from one of these points to the nearest of those."""
    worst = 0
    for start in range(0, len(these), 500):
        part = these[start:start + 500, None] - those[None]
        worst = max(worst, np.sqrt((part ** 2).sum(axis=2).min(axis=1)).max())
    return worst


for part in (acadsharp, assimp, ezdxf, office, house, gallery):
    part()
