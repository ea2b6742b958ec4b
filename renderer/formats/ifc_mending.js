// SPDX-License-Identifier: GPL-3.0-or-later
// What web-ifc reads otherwise than an IFC file means it, put so that it reads it right.

const CIRCLE_SEGMENTS = 48;  // within 2 mm at a radius of 1 m; web-ifc's own 12 are 4 % short of a cylinder
const FEW_SEGMENTS = 12;

// web-ifc passes over keywords in small letters, takes units with an offset, which of lengths is none, for metres, and
// knows IFC2X3 under this name alone.
function asWebIfcReads(bytes) {
  const schema = /FILE_SCHEMA\s*\(\s*\(\s*'(IFC2X3\w+)'/i.exec(bytes.subarray(0, 65536).toString('latin1'));
  if (schema) {
    const at = schema.index + schema[0].length - schema[1].length - 1;
    bytes.write("IFC2X3'".padEnd(schema[1].length + 1), at, 'latin1');
  }
  const offset = 'WITHOFFSET';
  for (let at = bytes.indexOf(offset); at >= 0; at = bytes.indexOf(offset, at)) bytes.fill(' ', at, at + offset.length);
  if (!['=Ifc', '= Ifc', '=ifc', '= ifc'].some((word) => bytes.includes(word))) return new Uint8Array(bytes);
  const [quote, slash, star, a, z] = Buffer.from("'/*az");
  let within = 0;  // a text or a comment
  for (let i = 0; i < bytes.length; ++i) {
    const byte = bytes[i];
    if (within === quote) {
      if (byte === quote) within = 0;
    } else if (within === star) {
      if (byte === slash && bytes[i - 1] === star) within = 0;
    } else if (byte === quote || (byte === star && bytes[i - 1] === slash)) {
      within = byte;
    } else if (byte >= a && byte <= z) {
      bytes[i] = byte - 32;
    }
  }
  return new Uint8Array(bytes);
}

// Ids of directions that are not of length 1, sought in the text: there may be a million that are.
function longDirections(bytes) {
  const word = 'IFCDIRECTION';
  const ids = [];
  for (let at = bytes.indexOf(word); at >= 0; at = bytes.indexOf(word, at + 1)) {
    const line = bytes.subarray(Math.max(0, at - 40), at + 120).toString('latin1');
    const found = /#(\d+)\s*=\s*IFCDIRECTION\s*\(\s*\(([^)]*)\)/.exec(line);
    if (found && Math.abs(Math.hypot(...found[2].split(',').map(Number)) - 1) > 1e-6) ids.push(Number(found[1]));
  }
  return ids;
}

class Mending extends Georeference {
  // What web-ifc takes otherwise than the file means it.
  mendLines(bytes) {
    this.scale = this.missedUnit();
    for (const id of longDirections(bytes)) this.mendDirection(id);
    for (const id of this.ids('IfcPolygonalFaceSet')) this.mendFaceSet(id);
  }
  // Directions have no length of their own.
  mendDirection(id) {
    const line = this.line(id);
    const parts = (line.DirectionRatios || []).map((ratio) => Number(valueOf(ratio)));
    const length = Math.hypot(...parts);
    if (!(length > 0) || Math.abs(length - 1) < 1e-6) return;
    parts.forEach((part, i) => {
      const ratio = line.DirectionRatios[i];
      if (ratio && ratio.value !== undefined) ratio.value = part / length; else line.DirectionRatios[i] = part / length;
    });
    this.api.WriteLine(this.model, line);
  }
  // Faces name points by way of PnIndex, which web-ifc passes over.
  mendFaceSet(id) {
    const set = this.line(id);
    const indices = (set.PnIndex || []).map((index) => Number(valueOf(index)));
    if (indices.length === 0) return;
    const mend = (list) => list.forEach((index, i) => {
      const point = indices[Number(valueOf(index)) - 1];
      if (index && index.value !== undefined) index.value = point; else list[i] = point;
    });
    for (const reference of set.Faces || []) {
      const face = this.line(reference.value);
      mend(face.CoordIndex || []);
      for (const hole of face.InnerCoordIndices || []) mend(hole);
      this.api.WriteLine(this.model, face);
    }
    set.PnIndex = null;
    this.api.WriteLine(this.model, set);
  }
}
