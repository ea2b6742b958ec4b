// SPDX-License-Identifier: GPL-3.0-or-later
// Areas and volumes of elements of an IFC file, from the triangles that ifc_model.js collects.
'use strict';

const MOST_CORNERS = 2 ** 26;  // of one part: pairs stay exact
const endsOf = (edge) => [Math.floor(edge / MOST_CORNERS), edge % MOST_CORNERS];

class Measures {
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
    let volume = spheres.reduce((sum, radius) => sum + 4 / 3 * Math.PI * radius ** 3, 0);
    for (const range of ranges) {
      const part = this.measured(range);
      if (part === null) return null;
      volume += part;
    }
    return volume;
  }
  // Volume of one part, known from then on.
  measured(range) {
    if (range.volume === undefined) {
      const {volume, open} = this.measurePart(...range);
      range.volume = open.size > 0 ? null : volume;
    }
    return range.volume;
  }
  // Triangles that a solid lacks, where three open edges go about one, are added at the end of all; how many.
  fillTriangles(range, surface) {
    const {volume, open, corners} = this.measurePart(...range);
    range.volume = open.size > 0 ? null : volume;
    const next = new Map();  // corner -> corner, the way that a missing face goes
    for (const [edge, passes] of open) {
      const [low, high] = endsOf(edge);
      const [from, to] = passes > 0 ? [high, low] : [low, high];
      next.set(from, next.has(from) || Math.abs(passes) > 1 ? undefined : to);
    }
    const before = this.triangles.length;
    for (const a of [...next.keys()]) {
      const b = next.get(a);
      const c = next.get(b);
      if (b === undefined || c === undefined || next.get(c) !== a) continue;
      if (this.hasFace(range, [a, b, c].map((corner) => corners[corner]))) continue;  // its back: a face alone
      this.triangles.push(corners[a], corners[b], corners[c], surface);
      for (const corner of [a, b, c]) next.delete(corner);
    }
    if (this.triangles.length > before) [range[1], range.volume] = [this.triangles.length, undefined];
    return (this.triangles.length - before) / 4;
  }
  hasFace([from, to], vertices) {
    const keyOf = (i) => [0, 1, 2].map((c) => Math.round(this.vertices[3 * i + c] * 1e5)).join();
    const keys = vertices.map(keyOf);
    for (let i = from; i < to; i += 4) {
      if ([0, 1, 2].every((corner) => keys.includes(keyOf(this.triangles[i + corner])))) return true;
    }
    return false;
  }
  // Volume, open edges, and which vertex each of their corners is.
  measurePart(from, to) {
    const {vertices: v, triangles: t} = this;
    const idOf = new Map();  // place to 0.01 mm -> number
    const corners = [];  // by number
    const numbers = new Map();  // vertex -> number
    const number = (i) => {
      let id = numbers.get(i);
      if (id !== undefined) return id;
      const key = Math.round(v[3 * i] * 1e5) + ',' + Math.round(v[3 * i + 1] * 1e5) + ',' + Math.round(v[3 * i + 2] * 1e5);
      id = idOf.get(key);
      if (id === undefined) {
        idOf.set(key, id = idOf.size);
        corners.push(i);
      }
      numbers.set(i, id);
      return id;
    };
    const edges = new Map();
    const step = (p, q) => this.addEdge(edges, p, q, 1);
    const o = 3 * t[from];
    const at = (i, c) => v[3 * i + c] - v[o + c];
    let volume = 0;
    for (let i = from; i < to; i += 4) {
      const [a, b, c] = [t[i], t[i + 1], t[i + 2]];
      volume += (at(a, 0) * (at(b, 1) * at(c, 2) - at(b, 2) * at(c, 1)) + at(a, 1) * (at(b, 2) * at(c, 0) - at(b, 0) * at(c, 2)) +
        at(a, 2) * (at(b, 0) * at(c, 1) - at(b, 1) * at(c, 0))) / 6;
      const [p, q, r] = [number(a), number(b), number(c)];
      step(p, q);
      step(q, r);
      step(r, p);
    }
    const placeOf = (corner) => v.slice(3 * corners[corner], 3 * corners[corner] + 3);
    return {volume: Math.abs(volume), open: this.cutAtCorners(edges, placeOf), corners};
  }
  addEdge(edges, p, q, passes) {
    if (p === q) return;
    const edge = Math.min(p, q) * MOST_CORNERS + Math.max(p, q);
    const count = (edges.get(edge) || 0) + (p < q ? passes : -passes);
    if (count === 0) edges.delete(edge); else edges.set(edge, count);
  }
  // web-ifc drops corners on straight lines: an open edge is cut where the corner of another lies on it, as in
  // element_measures.cc.
  cutAtCorners(edges, placeOf) {
    if (edges.size === 0 || edges.size > 2000) return edges;
    const corners = new Set([...edges.keys()].flatMap(endsOf));
    const places = new Map([...corners].map((corner) => [corner, placeOf(corner)]));
    const pieces = new Map();
    for (const [edge, passes] of edges) {
      const [p, q] = endsOf(edge);
      const way = places.get(q).map((value, c) => value - places.get(p)[c]);
      const square = way.reduce((sum, value) => sum + value * value, 0);
      const stops = [[0, p], [1, q]];
      for (const corner of corners) {
        const offset = places.get(corner).map((value, c) => value - places.get(p)[c]);
        const along = offset.reduce((sum, value, c) => sum + value * way[c], 0) / square;
        const off = Math.hypot(...offset.map((value, c) => value - along * way[c]));
        if (along > 0 && along < 1 && off <= 1e-5 && corner !== p && corner !== q) stops.push([along, corner]);
      }
      stops.sort((a, b) => a[0] - b[0]);
      for (let i = 1; i < stops.length; ++i) this.addEdge(pieces, stops[i - 1][1], stops[i][1], passes);
    }
    return pieces;
  }
}
