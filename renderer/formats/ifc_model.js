// SPDX-License-Identifier: GPL-3.0-or-later
// Reads an IFC file with web-ifc: node ifc_model.js WEB_IFC_FOLDER MODEL.ifc OUT
// Writes OUT.json (names, counts, warnings) and OUT.bin (vertices as float64 in metres, z up;
// triangles as uint32: three vertices and a surface; whole spheres in OUT.json). Vertices are placed in double precision.
const fs = require('fs');
const path = require('path');
const [folder, file, out] = process.argv.slice(2);
const {IfcAPI, ...ifc} = require(path.join(folder, 'web-ifc-api-node.js'));

const typeCode = (name) => ifc[name.toUpperCase()];
const valueOf = (attribute) => (attribute && attribute.value !== undefined ? attribute.value : attribute);

class Reader extends Mending {
  constructor(api, model) {
    super();
    Object.assign(this, {api, model, vertices: [], triangles: [], spheres: [], surfaces: [], indexOf: new Map(), scale: 1});
    this.entities = {};
    this.skipped = [];
    this.warnings = [];
    this.shown = new Set();
    this.filled = [];  // elements of which triangles were missing
    this.dropped = [];  // ranges of triangles
    this.isSolid = new Map();  // element -> by the type of its shapes
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

  readMeshes() {
    this.api.StreamAllMeshes(this.model, (mesh) => {
      const before = this.triangles.length + this.spheres.length;
      const kind = this.addMesh(mesh);
      if (this.triangles.length + this.spheres.length > before) this.entities[kind] = (this.entities[kind] || 0) + 1;
    });
  }
  addMesh(mesh) {
    const kind = this.kindOf(mesh.expressID);
    const name = valueOf(this.line(mesh.expressID).Name);
    for (let i = 0; i < mesh.geometries.size(); ++i) {
      this.addGeometry(mesh.expressID, name ? kind + '_' + name : kind, mesh.geometries.get(i));
    }
    return kind;
  }
  // Cuts through round things fail at some numbers of sides and not at others: solids that come out open are read with
  // fewer sides.
  readOpenAgain(bytes) {
    const open = [...this.partsOf].filter(([element, part]) => part.spheres.length === 0 && part.ranges.length > 0 &&
      this.isSolidElement(element) && this.volume(element) === null);
    if (open.length === 0) return;
    this.model = this.api.OpenModel(bytes, {CIRCLE_SEGMENTS: FEW_SEGMENTS});
    this.mendLines(Buffer.from(bytes.buffer));
    for (const [element] of open) this.partsOf.delete(element);
    this.api.StreamMeshes(this.model, open.map(([element]) => element), (mesh) => { this.addMesh(mesh); });
    for (const [element, part] of open) {
      if (!this.partsOf.has(element)) {
        this.partsOf.set(element, part);
        continue;
      }
      this.filled = this.filled.filter((one) => !part.ranges.includes(one.range));
      this.dropped.push(...part.ranges);
    }
  }
  // Without those that were read again.
  keptTriangles() {
    const kept = [];
    let at = 0;
    for (const [from, to] of this.dropped.sort((a, b) => a[0] - b[0])) {
      for (; at < from; ++at) kept.push(this.triangles[at]);
      at = to;
    }
    return this.dropped.length === 0 ? this.triangles : kept.concat(this.triangles.slice(at));
  }
  addGeometry(element, layer, placed) {
    const geometry = this.api.GetGeometry(this.model, placed.geometryExpressID);
    const data = this.api.GetVertexArray(geometry.GetVertexData(), geometry.GetVertexDataSize());
    const indices = this.api.GetIndexArray(geometry.GetIndexData(), geometry.GetIndexDataSize());
    const material = this.styleOf.get(placed.geometryExpressID) || this.materialOf.get(element) || '';
    const {x, y, z, w} = placed.color;
    // web-ifc gives white to what has no colour.
    const isStyled = this.styleOf.has(placed.geometryExpressID) || x * y * z * w < 1;
    const block = this.placeOf(element, placed.geometryExpressID);
    const surface = this.surface({layer, block, material, srgb: isStyled ? [x, y, z] : null, opacity: w});
    const first = this.vertices.length / 3;
    const start = this.triangles.length;
    const m = placed.flatTransformation.map((entry, i) => (i % 4 === 3 ? entry : entry * this.scale));
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
    const range = [start, this.triangles.length];
    this.partsOf.get(element).ranges.push(range);
    const added = this.isSolidElement(element) ? this.fillTriangles(range, surface) : 0;
    if (added > 0) this.filled.push({range, size: added, text: layer + ' (' + added + ')'});
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

  // What gives surfaces a look that is not shown, and what is no surface.
  countLooks() {
    const map = 'where an image lies on faces: not read';
    const lamp = 'list lamps in lights.json';
    for (const [type, reason] of [['IfcIndexedColourMap', 'colours by face are not read'], ['IfcTextureMap', map],
      ['IfcIndexedTriangleTextureMap', map], ['IfcIndexedPolygonalTextureMap', map], ['IfcTextureCoordinateGenerator', map],
      ['IfcLightSourcePositional', lamp], ['IfcLightSourceSpot', lamp], ['IfcLightSourceGoniometric', lamp]]) {
      const count = this.ids(type).length;
      if (count > 0) this.skipped.push([type, reason, count]);
    }
    for (const [what, count] of this.texturesByName()) this.skipped.push([...JSON.parse(what), count]);
  }

  isSolidShape(id, depth = 0) {
    const shape = this.line(id);
    if (/^(SweptSolid|AdvancedSweptSolid|Brep|AdvancedBrep|CSG|Clipping|SolidModel)$/.test(String(valueOf(shape.RepresentationType)))) return true;
    return valueOf(shape.RepresentationType) === 'MappedRepresentation' && depth < 4 && (shape.Items || []).some((item) => {
      const source = this.line(item.value).MappingSource;
      const mapped = source && this.line(source.value).MappedRepresentation;
      return mapped && this.isSolidShape(mapped.value, depth + 1);
    });
  }
  isSolidElement(element) {
    if (!this.isSolid.has(element)) this.isSolid.set(element, this.shapesOf(element).some((id) => this.isSolidShape(id)));
    return this.isSolid.get(element);
  }
  // Elements whose shapes are solids by their type and whose faces leave edges open.
  nameOpenSolids() {
    if (this.filled.length > 0) {
      this.warnings.push(this.filled.length + ' elements that are solids in the file lacked triangles, which are filled in: ' +
        this.listed(this.filled));
    }
    const open = [];
    let solids = 0;
    for (const [element, part] of this.partsOf) {
      if (!this.isSolidElement(element)) continue;
      ++solids;
      if (this.volume(element) === null) open.push({size: this.areaOf(part), text: part.layer});
    }
    if (open.length > 0) {
      this.warnings.push(open.length + ' of ' + solids + ' elements that are solids in the file have open edges: ' + this.listed(open));
    }
  }
  volume(element) {
    const part = this.partsOf.get(element);
    if (part.volume === undefined) part.volume = this.volumeOf(part);
    return part.volume;
  }
  listed(items) {
    return items.sort((a, b) => b.size - a.size).slice(0, 8).map((item) => item.text).join('; ') +
      (items.length > 8 ? '; and ' + (items.length - 8) + ' more' : '');
  }

  // Net volumes and areas that the file states, held against those of the faces.
  compareQuantities() {
    this.compare('volume', 'm3', 0.02, 1e-4, this.stated('VolumeValue', 'VOLUMEUNIT', 3, /^(net ?)?volumen?$/i),
      (element) => this.volume(element));
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
    const of = ' of ' + stated.size + ' elements that state their ' + what;
    if (off.length > 0) this.warnings.push(off.length + of + ' have another: ' + this.listed(off));
    if (open.length > 0 && what === 'volume') this.warnings.push(open.length + of + ' are open: ' + this.listed(open));
  }
  // Element -> quantity [m2, m3], of those shown.
  stated(value, unitType, power, name, kind = /^/) {
    const stated = new Map();
    const unit = this.unitOf(unitType, power);
    for (const measure of this.statedMeasures()) {
      if (measure.value !== value || !name.test(measure.name)) continue;
      for (const element of measure.elements) {
        if (this.shown.has(element) && kind.test(this.kindOf(element))) stated.set(element, measure.size * unit);
      }
    }
    return stated;
  }
  // Areas and volumes of quantities, and of properties in sets of dimensions, as Revit writes them.
  statedMeasures() {
    if (this.measures) return this.measures;
    this.measures = [];
    for (const relation of this.lines('IfcRelDefinesByProperties')) {
      const set = relation.RelatingPropertyDefinition && this.line(relation.RelatingPropertyDefinition.value);
      const isOfSizes = set && /quantit|dimension|abmess|mass|meng/i.test(String(valueOf(set.Name)));
      const elements = (relation.RelatedObjects || []).map((object) => object.value);
      for (const reference of (set && (set.Quantities || (isOfSizes && set.HasProperties))) || []) {
        const line = this.line(reference.value);
        for (const value of ['AreaValue', 'VolumeValue']) {
          const size = Number(valueOf(this.measureIn(line, value)));
          if (size > 0) this.measures.push({name: String(valueOf(line.Name)), value, size, elements});
        }
      }
    }
    return this.measures;
  }
  measureIn(line, value) {
    const {NominalValue} = line;
    return NominalValue && NominalValue.name === 'IFC' + value.replace('Value', 'Measure').toUpperCase() ? NominalValue : line[value];
  }
}

// What web-ifc says while it reads: kind of message -> entities.
const said = new Map();
function hear(...words) {
  for (const line of words.join(' ').split('\n')) {
    const found = /^\[WEB-IFC\]\[(error|warning|critical)\]\[?(.*)$/.exec(line.trim());
    if (!found) continue;
    const entity = /(\d+)\D*$/.exec(found[2]);
    const kind = found[2].replace(/^\[?\w+\(\)\]\s*/, '').replace(/\d+/g, '').trim();
    if (!said.has(kind)) said.set(kind, []);
    said.get(kind).push(entity ? '#' + entity[1] : '');
  }
}
function whatWasSaid() {
  return [...said].slice(0, 20).map(([kind, entities]) => {
    const named = [...new Set(entities.filter(Boolean))];
    return 'web-ifc says' + (entities.length > 1 ? ' ' + entities.length + ' times' : '') + ': ' + kind.slice(0, 120) +
      (named.length > 0 ? ' (' + named.slice(0, 8).join(', ') + (named.length > 8 ? ', ...' : '') + ')' : '');
  });
}

async function main() {
  console.log = console.warn = hear;
  const api = new IfcAPI();
  api.SetWasmPath(folder + path.sep, true);
  await api.Init();
  api.SetLogLevel(3);
  const bytes = asWebIfcReads(fs.readFileSync(file));
  const model = api.OpenModel(bytes, {CIRCLE_SEGMENTS});
  if (model < 0) throw new Error('web-ifc knows no schema of it');
  const reader = new Reader(api, model);
  reader.readStyles();
  reader.readPlaces();
  reader.mendLines(Buffer.from(bytes.buffer));
  reader.readMeshes();
  reader.readOpenAgain(bytes);
  reader.countLost();
  reader.countLooks();
  reader.nameOpenSolids();
  reader.compareQuantities();
  reader.readMapConversion();
  const has_unit = reader.hasLengthUnit();
  fs.writeFileSync(out + '.bin', Buffer.from(new Float64Array(reader.vertices).buffer));
  const triangles = reader.keptTriangles();
  fs.appendFileSync(out + '.bin', Buffer.from(new Uint32Array(triangles).buffer));
  const {surfaces, spheres, entities, skipped, map} = reader;
  const warnings = [...reader.warnings, ...whatWasSaid()];
  const counts = {vertices: reader.vertices.length / 3, triangles: triangles.length / 4};
  fs.writeFileSync(out + '.json', JSON.stringify(
    {schema: api.GetModelSchema(model), has_unit, ...counts, surfaces, spheres, entities, skipped, warnings, map}));
}

main().catch((error) => {
  console.error(String(error && error.message || error));
  process.exit(1);
});
