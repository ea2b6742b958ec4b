// SPDX-License-Identifier: GPL-3.0-or-later
// Reads an IFC file with web-ifc: node ifc_model.js WEB_IFC_FOLDER MODEL.ifc OUT
// Writes OUT.json (names, counts, warnings) and OUT.bin (vertices as float64 in metres, z up;
// triangles as uint32: three vertices and a surface; whole spheres in OUT.json). Vertices are placed in double precision.
'use strict';
const fs = require('fs');
const path = require('path');
const [folder, file, out] = process.argv.slice(2);
const {IfcAPI, ...ifc} = require(path.join(folder, 'web-ifc-api-node.js'));

const typeCode = (name) => ifc[name.toUpperCase()];
const valueOf = (attribute) => (attribute && attribute.value !== undefined ? attribute.value : attribute);

class Reader {
  constructor(api, model) {
    Object.assign(this, {api, model, vertices: [], triangles: [], spheres: [], surfaces: [], indexOf: new Map()});
    this.entities = {};
    this.skipped = [];
    this.warnings = [];
    this.shown = new Set();
    this.partsOf = new Map();  // element -> [from, to) in triangles, spheres
  }

  ids(type) {
    const list = typeCode(type) === undefined ? null : this.api.GetLineIDsWithType(this.model, typeCode(type));
    return list ? Array.from({length: list.size()}, (_, i) => list.get(i)) : [];
  }
  // A line that cannot be read costs only itself.
  line(id) {
    try {
      return this.api.GetLine(this.model, id) || {};
    } catch (error) {
      return {};
    }
  }
  lines(type) {
    return this.ids(type).map((id) => this.line(id));
  }
  kindOf(id) {
    const name = this.line(id).constructor.name;
    return name.startsWith('Ifc') ? name.replace(/^(Ifc[A-Za-z]*)\d*$/, '$1') : 'IfcProduct';
  }

  readStyles() {
    this.styleOf = new Map();
    for (const item of this.lines('IfcStyledItem')) {
      const name = (item.Styles || []).map((style) => this.styleName(style)).find(Boolean);
      if (item.Item && name) this.styleOf.set(item.Item.value, name);
    }
    this.materialOf = new Map();
    for (const relation of this.lines('IfcRelAssociatesMaterial')) {
      const name = relation.RelatingMaterial && valueOf(this.line(relation.RelatingMaterial.value).Name);
      for (const object of name ? relation.RelatedObjects || [] : []) this.materialOf.set(object.value, name);
    }
  }
  styleName(reference) {
    const style = reference && reference.value ? this.line(reference.value) : {};
    return style.Styles && !style.Name ? style.Styles.map((s) => this.styleName(s)).find(Boolean) : valueOf(style.Name);
  }

  readMeshes() {
    this.api.StreamAllMeshes(this.model, (mesh) => {
      const kind = this.kindOf(mesh.expressID);
      const name = valueOf(this.line(mesh.expressID).Name);
      const before = this.triangles.length + this.spheres.length;
      for (let i = 0; i < mesh.geometries.size(); ++i) {
        this.addGeometry(mesh.expressID, name ? kind + '_' + name : kind, mesh.geometries.get(i));
      }
      if (this.triangles.length + this.spheres.length > before) this.entities[kind] = (this.entities[kind] || 0) + 1;
    });
  }
  addGeometry(element, layer, placed) {
    const geometry = this.api.GetGeometry(this.model, placed.geometryExpressID);
    const data = this.api.GetVertexArray(geometry.GetVertexData(), geometry.GetVertexDataSize());
    const indices = this.api.GetIndexArray(geometry.GetIndexData(), geometry.GetIndexDataSize());
    const material = this.styleOf.get(placed.geometryExpressID) || this.materialOf.get(element) || '';
    const {x, y, z, w} = placed.color;
    // web-ifc gives white to what has no colour.
    const isStyled = this.styleOf.has(placed.geometryExpressID) || x * y * z * w < 1;
    const surface = this.surface({layer, material, srgb: isStyled ? [x, y, z] : null, opacity: w});
    const first = this.vertices.length / 3;
    const start = this.triangles.length;
    const m = placed.flatTransformation;
    if (!this.partsOf.has(element)) this.partsOf.set(element, {layer, ranges: [], spheres: []});
    const sphere = this.sphereOf(placed.geometryExpressID, data, m);
    if (sphere) {
      this.spheres.push([...sphere, surface]);
      this.partsOf.get(element).spheres.push(sphere[3]);
      this.shown.add(element);
      geometry.delete();
      return;
    }
    for (let i = 0; i < data.length; i += 6) {
      const at = (row) => m[row] * data[i] + m[row + 4] * data[i + 1] + m[row + 8] * data[i + 2] + m[row + 12];
      this.vertices.push(at(0), -at(2), at(1));  // web-ifc turns models y up
    }
    for (let i = 0; i < indices.length; i += 3) {
      this.triangles.push(first + indices[i], first + indices[i + 1], first + indices[i + 2], surface);
    }
    if (indices.length > 0) this.shown.add(element);
    this.partsOf.get(element).ranges.push([start, this.triangles.length]);
    geometry.delete();
  }
  // x, y, z, radius of a whole one: all its corners are as far from the middle of its box, and no
  // opening has cut any off. null: another kind, cut, or stretched.
  sphereOf(item, data, m) {
    if (this.api.GetLineType(this.model, item) !== typeCode('IfcSphere') || data.length === 0) return null;
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < data.length; i += 6) {
      for (let c = 0; c < 3; ++c) {
        low[c] = Math.min(low[c], data[i + c]);
        high[c] = Math.max(high[c], data[i + c]);
      }
    }
    const radius = (high[0] - low[0]) / 2;
    const middle = low.map((value, c) => (value + high[c]) / 2);
    const isOff = (value, expected) => Math.abs(value - expected) > 1e-5 * expected;
    if (high.some((value, c) => isOff((value - low[c]) / 2, radius))) return null;
    for (let i = 0; i < data.length; i += 6) {
      if (isOff(Math.hypot(...middle.map((value, c) => data[i + c] - value)), radius)) return null;
    }
    const scales = [0, 4, 8].map((c) => Math.hypot(m[c], m[c + 1], m[c + 2]));
    if (scales.some((scale) => isOff(scale, scales[0]))) return null;
    const at = (row) => m[row] * middle[0] + m[row + 4] * middle[1] + m[row + 8] * middle[2] + m[row + 12];
    return [at(0), -at(2), at(1), radius * scales[0]];
  }
  surface(names) {
    const key = JSON.stringify(names);
    if (!this.indexOf.has(key)) {
      this.indexOf.set(key, this.surfaces.length);
      this.surfaces.push(names);
    }
    return this.indexOf.get(key);
  }

  // Products that state a shape but have none in the result.
  countLost() {
    const lost = new Map();
    for (const {typeID} of this.api.GetAllTypesOfModel(this.model)) {
      const list = this.api.GetLineIDsWithType(this.model, typeID);
      if (list.size() === 0) continue;
      const first = this.line(list.get(0));
      if (!('Representation' in first) || !('ObjectPlacement' in first)) continue;
      for (let i = 0; i < list.size(); ++i) {
        const id = list.get(i);
        if (this.shown.has(id) || !this.line(id).Representation) continue;
        const kind = this.kindOf(id);
        lost.set(kind, (lost.get(kind) || 0) + 1);
      }
    }
    for (const [kind, count] of lost) {
      const isVoid = /^Ifc(Opening|Space|Voiding|Projection)/.test(kind);
      if (!isVoid) this.entities[kind] = (this.entities[kind] || 0) + count;
      this.skipped.push([kind, isVoid ? 'a void by its kind, no surface' : 'has no surface that web-ifc reads', count]);
    }
  }

  // Net volumes and areas that the file states, held against those of the faces.
  compareQuantities() {
    this.compare('volume', 'm3', 0.02, 1e-4, this.stated('VolumeValue', 'VOLUMEUNIT', 3, /^(net ?)?volume$/i),
      (element) => this.volumeOf(this.partsOf.get(element)));
    this.compare('surface area', 'm2', 0.02, 1e-3,
      this.stated('AreaValue', 'AREAUNIT', 2, /^(net|total) ?surface ?area$/i),
      (element) => this.areaOf(this.partsOf.get(element)));
    this.compare('side area', 'm2', 0.02, 1e-3,
      this.stated('AreaValue', 'AREAUNIT', 2, /^net ?(side ?)?area$/i, /^Ifc(Wall|Slab|Plate|Roof|Covering)/),
      (element) => this.sideAreaOf(this.partsOf.get(element)));
  }
  // `find`: null where it cannot be said.
  compare(what, unit, share, least, stated, find) {
    const off = [];
    const open = [];
    for (const [element, expected] of stated) {
      const found = find(element);
      const {layer} = this.partsOf.get(element);
      if (found === null) {
        open.push({size: expected, text: layer});
      } else if (Math.abs(found - expected) > Math.max(share * expected, least)) {
        const text = layer + ' ' + found.toFixed(3) + ' ' + unit + ', stated ' + expected.toFixed(3);
        off.push({size: Math.abs(found - expected), text});
      }
    }
    const listed = (items) => items.sort((a, b) => b.size - a.size).slice(0, 8).map((item) => item.text).join('; ') +
      (items.length > 8 ? '; and ' + (items.length - 8) + ' more' : '');
    const of = ' of ' + stated.size + ' elements that state their ' + what;
    if (off.length > 0) this.warnings.push(off.length + of + ' have another: ' + listed(off));
    if (open.length > 0 && what === 'volume') this.warnings.push(open.length + of + ' are open: ' + listed(open));
  }
  // Element -> quantity [m2, m3], of those shown.
  stated(value, unitType, power, name, kind = /^/) {
    const stated = new Map();
    const unit = this.unitOf(unitType, power);
    for (const relation of this.lines('IfcRelDefinesByProperties')) {
      const set = relation.RelatingPropertyDefinition && this.line(relation.RelatingPropertyDefinition.value);
      for (const reference of (set && set.Quantities) || []) {
        const quantity = this.line(reference.value);
        const size = Number(valueOf(quantity[value]));
        if (!name.test(String(valueOf(quantity.Name))) || !(size > 0)) continue;
        for (const object of relation.RelatedObjects || []) {
          if (this.shown.has(object.value) && kind.test(this.kindOf(object.value))) stated.set(object.value, size * unit);
        }
      }
    }
    return stated;
  }
  unitOf(type, power) {
    const prefixes = {CENTI: 1e-2, DECI: 1e-1, MILLI: 1e-3, KILO: 1e3};
    for (const unit of this.lines('IfcSIUnit')) {
      if (valueOf(unit.UnitType) === type) return (prefixes[valueOf(unit.Prefix)] || 1) ** power;
    }
    for (const unit of this.lines('IfcConversionBasedUnit')) {
      const factor = unit.ConversionFactor && this.line(unit.ConversionFactor.value);
      if (valueOf(unit.UnitType) === type) return Number(valueOf(factor.ValueComponent)) || 1;
    }
    return 1;
  }
  // visit(x, y, z) with half the cross product of each triangle's sides.
  forAreas(ranges, visit) {
    const {vertices: v, triangles: t} = this;
    for (const [from, to] of ranges) {
      for (let i = from; i < to; i += 4) {
        const side = (corner) => [0, 1, 2].map((c) => v[3 * t[i + corner] + c] - v[3 * t[i] + c]);
        const [p, q] = [side(1), side(2)];
        visit((p[1] * q[2] - p[2] * q[1]) / 2, (p[2] * q[0] - p[0] * q[2]) / 2, (p[0] * q[1] - p[1] * q[0]) / 2);
      }
    }
  }
  areaOf({ranges, spheres}) {
    let area = spheres.reduce((sum, radius) => sum + 4 * Math.PI * radius * radius, 0);
    this.forAreas(ranges, (x, y, z) => { area += Math.hypot(x, y, z); });
    return area;
  }
  // Of the larger side of what is flat and of one piece; null: it is not.
  sideAreaOf({ranges, spheres}) {
    if (spheres.length > 0 || ranges.length !== 1) return null;
    const areas = new Map();
    let whole = 0;
    this.forAreas(ranges, (x, y, z) => {
      const size = Math.hypot(x, y, z);
      whole += size;
      const key = [x, y, z].map((value) => Math.round(value / (size || 1) * 200) + 0).join();
      areas.set(key, (areas.get(key) || 0) + size);
    });
    const largest = Math.max(0, ...areas.values());
    return largest > 0.3 * whole ? largest : null;
  }
  // By Gauss's theorem about a vertex of each part; null: an edge without a partner of the other direction.
  volumeOf({ranges, spheres}) {
    let volume = 0;
    const balls = spheres.reduce((sum, radius) => sum + 4 / 3 * Math.PI * radius ** 3, 0);
    const {vertices: v, triangles: t} = this;
    for (const [from, to] of ranges) {
      const edges = new Map();
      const key = (i) => [0, 1, 2].map((c) => Math.round(v[3 * i + c] * 1e5)).join();
      const o = 3 * t[from];
      const at = (i) => [0, 1, 2].map((c) => v[3 * i + c] - v[o + c]);
      for (let i = from; i < to; i += 4) {
        const [a, b, c] = [at(t[i]), at(t[i + 1]), at(t[i + 2])];
        volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
          a[2] * (b[0] * c[1] - b[1] * c[0])) / 6;
        for (const [from3, to3] of [[0, 1], [1, 2], [2, 0]]) {
          const [p, q] = [key(t[i + from3]), key(t[i + to3])];
          if (p === q) continue;
          const [name, step] = p < q ? [p + '|' + q, 1] : [q + '|' + p, -1];
          edges.set(name, (edges.get(name) || 0) + step);
        }
      }
      for (const count of edges.values()) if (count !== 0) return null;
    }
    return Math.abs(volume) + balls;
  }

  // Where the file says the model stands: told, not applied, since placement.json decides.
  readMapConversion() {
    const values = [...this.lines('IfcMapConversion'), ...this.mapProperties()];
    for (const map of values) {
      const number = (name) => Number(valueOf(map[name]) || 0);
      const turn = Math.atan2(number('XAxisOrdinate'), Number(valueOf(map.XAxisAbscissa) ?? 1)) * 180 / Math.PI;
      const shift = ['Eastings', 'Northings', 'OrthogonalHeight'].map(number).join(', ');
      const system = this.lines('IfcProjectedCRS').map((crs) => valueOf(crs.Name)).find(Boolean);
      this.warnings.push('holds map coordinates' + (system ? ' (' + system + ')' : '') +
        ' that are not applied: to use them write {"rotation_deg": ' + Number(turn.toFixed(9)) + ', "shift": [' +
        shift + ']} into placement.json');
    }
  }
  mapProperties() {
    return this.lines('IfcPropertySet')
      .filter((set) => /^e?pset_mapconversion$/i.test(String(valueOf(set.Name))))
      .map((set) => Object.fromEntries((set.HasProperties || []).map((reference) => {
        const property = this.line(reference.value);
        return [valueOf(property.Name), valueOf(property.NominalValue)];
      })));
  }
}

async function main() {
  const api = new IfcAPI();
  api.SetWasmPath(folder + path.sep, true);
  await api.Init();
  api.SetLogLevel(6);
  const model = api.OpenModel(new Uint8Array(fs.readFileSync(file)));
  if (model < 0) throw new Error('web-ifc knows no schema of it');
  const reader = new Reader(api, model);
  reader.readStyles();
  reader.readMeshes();
  reader.countLost();
  reader.compareQuantities();
  reader.readMapConversion();
  fs.writeFileSync(out + '.bin', Buffer.from(new Float64Array(reader.vertices).buffer));
  fs.appendFileSync(out + '.bin', Buffer.from(new Uint32Array(reader.triangles).buffer));
  const {surfaces, spheres, entities, skipped, warnings} = reader;
  const counts = {vertices: reader.vertices.length / 3, triangles: reader.triangles.length / 4};
  fs.writeFileSync(out + '.json', JSON.stringify(
    {schema: api.GetModelSchema(model), ...counts, surfaces, spheres, entities, skipped, warnings}));
}

main().catch((error) => {
  console.error(String(error && error.message || error));
  process.exit(1);
});
