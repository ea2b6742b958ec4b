// SPDX-License-Identifier: GPL-3.0-or-later
// ACIS bodies in drawings: as text in the entity itself, since 2013 as bytes in section ACDSDATA.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/dxf/dxf_block.h"
#include "renderer/dxf/dxf_record.h"

namespace insitu {

bool IsDxfBody(std::string_view kind);  // 3DSOLID, BODY, REGION, SURFACE, ...

// Its look is not set.
DxfBody DxfBodyOf(const DxfRecord& entity);

std::string DxfHandle(std::string_view handle);  // as it is compared

// Adds what a record of section ACDSDATA holds of an entity's body. Throws InputError: bytes that
// are not hexadecimal.
void ReadDxfBodyData(const DxfRecord& record, std::map<std::string, std::string>* body_of_handle);

struct FacetedBody {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3i> triangles;
  std::vector<ModelSphere> spheres;  // without a surface; only those that stay spheres
  SkippedEntities skipped;           // faces, by the entity's handle
};

struct BodyOptions {
  double tolerance = 0.002;    // of chords, in world coordinates, > 0
  double most_vertices = 2e7;  // what comes after about so many is left out
};

// `sab`: where the body has no text. In world coordinates.
FacetedBody Facet(const DxfBody& body, const std::string& sab,
                  const Eigen::Affine3d& world_from_block, const BodyOptions& options);

}  // namespace insitu
