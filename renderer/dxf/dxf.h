// SPDX-License-Identifier: GPL-3.0-or-later
// Reading DXF drawings: faces, meshes, extruded lines and blocks become triangles by layer.
#pragma once

#include <filesystem>

#include "renderer/mesh/model.h"

namespace insitu {

struct DxfOptions {
  double chord_tolerance = 0.002;    // [m], > 0: of arcs, circles and bodies
  double most_pieces = 20e6;         // copies of blocks come to no more vertices and entities
  std::filesystem::path stands_for;  // the drawing of which this is a copy; empty: itself

  void Check() const;  // throws CheckError that names the field that is wrong
};

// DXF, ASCII or binary, R9 to 2018: 3DFACE; SOLID and TRACE (with thickness); MESH (smoothed);
// POLYLINE as polyface, as polygon mesh and, with thickness or width, as a line; LWPOLYLINE, LINE,
// CIRCLE and ARC with thickness or width; 3DSOLID, BODY, REGION and surfaces as FacetedAcis has
// their faces, those that are left out by the entity's handle; INSERT (nested, scaled, mirrored,
// rotated, in rows and columns, extruded); external drawings (XREF) where they are there as DXF.
// Layer 0, BYLAYER and BYBLOCK take after the INSERT. What CAD programs do not show or print is
// left out and counted: layers frozen, off or not to be plotted (DEFPOINTS never is), invisible
// entities, paper space. Throws InputError at the line (of a binary file, the byte): cut in half
// (no EOF), a group code that is no number, a face that names a vertex out of range, an unknown
// block, blocks that insert themselves, coordinates that are not finite, an unknown unit.
Model ReadDxf(const std::filesystem::path& path, const DxfOptions& options = {});

}  // namespace insitu
