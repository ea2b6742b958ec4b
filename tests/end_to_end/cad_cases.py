# SPDX-License-Identifier: GPL-3.0-or-later
"""cad_cases.py SHARED PROGRAM FOLDER: converts every case of SHARED/data/cases/cad as a user would,
its files in SITE/building, and prints a line "ok: ..." or "FAIL: ..." for each expected value."""
import json
import pathlib
import shutil
import subprocess
import sys
import time

shared, program, folder = (pathlib.Path(argument) for argument in sys.argv[1:])
cases = shared / 'data/cases/cad'


class Converted:
    """One case, converted in a site of its own."""

    def __init__(self, name, only=None):
        self.name = name if only is None else f'{name}/{only}'
        site = folder / self.name.replace('/', '_')
        building = site / 'building'
        building.mkdir(parents=True)
        source = cases / name
        for path in [source / only] if only else source.iterdir():
            if path.is_dir():
                shutil.copytree(path, building / path.name)
            elif path.name != 'README':
                shutil.copy(path, building)
        report = site / 'report.json'
        start = time.monotonic()
        run = subprocess.run([program, site, '--report', report], capture_output=True, text=True,
                             timeout=300, errors='replace')
        self.seconds = time.monotonic() - start
        self.status, self.message = run.returncode, run.stdout + run.stderr
        self.report = json.loads(report.read_text()) if report.exists() else {}
        description = site / 'work/building.json'
        self.description = json.loads(description.read_text()) if description.exists() else {}

    def check(self, good, text):
        print(f'{"ok" if good else "FAIL"}: {self.name}: {text}')

    def area(self, area, volume=None, tolerance=0.005):
        found = self.report.get('area_m2'), self.report.get('volume_m3')
        good = self.status == 0 and abs(found[0] - area) <= tolerance * area
        if volume is not None:
            good = good and found[1] is not None and abs(found[1] - volume) <= tolerance * volume
        self.check(good, f'{found[0]} m2, {found[1]} m3, expected {area}, {volume}' +
                   ('' if self.status == 0 else '; ' + self.message[:200]))
        return self

    def size(self, *size):
        low, high = self.report.get('bbox_min'), self.report.get('bbox_max')
        found = [b - a for a, b in zip(low, high)] if low else []
        good = bool(found) and max(abs(a - b) for a, b in zip(found, size)) < 1e-3
        self.check(good, f'{[round(v, 4) for v in found]} m, expected {size}')
        return self

    def low(self, *corner):
        found = self.report.get('bbox_min') or []
        good = bool(found) and max(abs(a - b) for a, b in zip(found, corner)) < 1e-3
        self.check(good, f'begins at {found}, expected {corner}')
        return self

    def says(self, *words):
        for word in words:
            self.check(word in self.message, f'says "{word}"' if word in self.message else
                       f'does not say "{word}": {self.message[-500:]}')
        return self

    def never_says(self, word):
        self.check(word not in self.message, f'never says "{word}"')
        return self

    def refused(self, *words):
        self.check(self.status == 2, f'status {self.status}, expected 2')
        return self.says(*words)

    def material(self, name, **values):
        found = [m for m in self.description.get('materials', []) if m.get('name') == name]
        self.check(bool(found), f'material {name}' if found else
                   f'no material {name} in {[m["name"] for m in self.description.get("materials", [])]}')
        for key, value in values.items():
            got = found[0].get(key) if found else None
            same = got == value or isinstance(value, list) and isinstance(got, list) and max(
                abs(a - b) for a, b in zip(got, value)) < 0.01
            self.check(same, f'{name}: {key} {got}, expected {value}')
        return self


def ifc():
    Converted('01-ifc-feet').area(216, 180).size(10, 6, 3)
    Converted('02-ifc-halfspace-cut-open/f07_halfspace_roof').area(200.30, 150)
    halfspace, boolean = '02-ifc-halfspace-cut-open', '03-ifc-boolean-and-niche'
    Converted(halfspace, 'revit2011_wall2.ifc').area(280.93, 13.731)
    Converted(halfspace, '686--wall--missing-subtraction--augmented.ifc').area(34.50)
    Converted(boolean + '/f09_bool_extruded').area(228, 176)
    Converted(boolean + '/f11_niche').area(222, 178)
    Converted(boolean, '336--beam--segfault--1--augmented.ifc').area(0.119)
    Converted(boolean, '331--slab--segfault--augmented.ifc').area(50.5)
    read = Converted('04-ifc-ownerhistory-nosite/f04_ownerhistory_missing')
    read.check(read.status == 0, f'status {read.status}')
    # As OpenCASCADE has it: web-ifc alone lacks a triangle of 0.323 m2.
    Converted('04-ifc-ownerhistory-nosite', '516--wall--missing-subtractions--augmented.ifc').area(
        562.690421, 82.966146, 1e-6)
    named = Converted('05-ifc-names-georeference/f03_umlaut_x2')
    named.check('IfcWall_Außenwand über' in named.report.get('layers', {}),
                f'layers {list(named.report.get("layers", {}))}')


def gltf():
    kind = '06-gltf-extensions-ignored/'
    for name in ('b01_quantised_i16', 'b01b_quantised_norm', 'b22_gltfpack_cc'):
        Converted(kind + name).area(216, 180).size(10, 6, 3)
    Converted(kind + 'b02b_gpu_instancing_required').area(864, 720)
    Converted(kind + 'b03_unknown_required').refused('ACME_secret_geometry')
    Converted(kind + 'b06_cesium_rtc').area(216).says('CESIUM_RTC', '4300000.5')


def obj():
    kind = '08-obj-one-bad-line-refuses-all/'
    Converted(kind + 'a02_nan_normals').area(216, 180).says('vn')
    Converted(kind + 'a08_two_corner_face').area(216, 180).says('fewer than 3 corners')
    Converted(kind + 'a09_trailing_comment').area(216, 180)
    Converted(kind + 'a24_kd_one_value').area(216, 180).material('Brick', diffuse_rgb=[0.6] * 3)
    Converted('12-mtl-d-and-Tr/a04_d1_Tr1').area(216, 180).material('Brick', glass=None)


def text():
    kind = '09-bom-and-encodings/'
    Converted(kind + 'a01_bom_both').area(216, 180).never_says('mid grey')
    coded = Converted(kind + 'a06_latin1').area(216, 180)
    names = [m['name'] for m in coded.description.get('materials', [])]
    coded.check(any('grün' in name for name in names), f'materials {names}')
    Converted(kind + 'a13_cr_only').area(216, 180)
    Converted(kind + 'g18b_cr_only').area(216, 180)
    cube = Converted('09-bom-and-encodings', 'cube_UTF16LE.dae')
    cube.check(cube.report.get('triangles') == 12 or 'UTF-16' in cube.message,
               f'{cube.report.get("triangles")} triangles')


def beside():
    kind = '10-files-beside-the-model/'
    for name in ('a03_mtllib_abs', 'a03c_mtllib_two', 'a03d_mtllib_quoted'):
        Converted(kind + name).area(216, 180).never_says('is not there')
    for name in ('a17_tex_abs_win', 'a17b_tex_options_spaces', 'b17_tex_percent',
                 'c09_tex_fileurl'):
        one = Converted(kind + name).area(216, 180).never_says('is not there')
        textures = [m.get('texture') for m in one.description.get('materials', [])]
        one.check('brick wall.png' in textures, f'textures {textures}')
    Converted(kind + 'a17e_tex_missing').area(216, 180).says('is not there')
    Converted(kind + 'b05_uri_percent').area(216, 180)


def colours():
    kind = '11-vertex-colours-lost/'
    for name in ('a10_vertex_colors', 'b07_color0'):
        one = Converted(kind + name).area(216, 180)
        one.check('colour' in one.message and 'vert' in one.message, 'colours by vertex are told of')
    one = Converted(kind + 'e07_magics').area(216, 180)
    one.says('colours of facets')
    Converted('11-vertex-colours-lost', 'cube_with_vertexcolors.obj').says('colours by vertex')


def stl():
    for name in ('e01_upper', 'e02_trailing_bytes', 'e03_end_solid', 'e08b_nan_ind',
                 'e12_count_zero', 'e13_no_endsolid'):
        Converted('13-stl-refused-as-cut-short/' + name).area(216, 180)


def ply():
    for name in ('d01b_first_byte_nl', 'd04_face_first_bin', 'd12_ascii_oneline'):
        Converted('14-ply/' + name).area(216, 180)
    Converted('14-ply/d07_tristrips').area(60)


def precision():
    kind = '15-single-precision/'
    Converted(kind + 'b10_far_node').size(10, 6, 3).low(2600000.123, 1200000.456, 500)
    Converted(kind + 'c16b_far_node').size(10, 6, 3).low(2600000.123, 1200000.456, 500)
    Converted(kind + 'd05_double_far').size(10, 6, 3).never_says('single precision')


def units():
    Converted('16-unit-hint/a12_units_comment').size(10, 6, 3).says('File units')
    Converted('16-unit-hint/g15_unitless_mm').says('taken as metres', 'millimetres',
                                                   '1000').never_says('304.8')
    Converted('17-y-up').says('"up": "y"')


def dxf():
    block = Converted('18-dxf-dynamic-block')
    materials = block.report.get('materials', {})
    block.check(list(materials) == ['Fenster'], f'materials {materials}')
    kind = '19-dxf-refused-for-little/'
    for name in ('g07b_truecolor_uns', 'g09_code_5000'):
        Converted(kind + name).area(216, 180)
    Converted(kind + 'g14_noplot_layer').refused('not to be plotted')


def unread():
    for name, word in (('z02_zip', 'unpack'), ('z12_usdz', 'USD'), ('z12b_usda', 'USD'),
                       ('z15b_wrl', 'VRML'), ('z17_pdf', 'PDF'), ('z25_las', 'point cloud'),
                       ('z26_subfolder', 'h.obj')):
        Converted('20-files-not-named/' + name).refused(word)
    Converted('20-files-not-named', 'duck.zae').refused('unpack')
    Converted('21-dae-polygons-with-holes/c04_ph_only').area(28)


for part in (ifc, gltf, obj, text, beside, colours, stl, ply, precision, units, dxf, unread):
    part()
