// SPDX-License-Identifier: GPL-3.0-or-later
// The material files of OBJ (MTL).
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderer/mesh/model.h"

namespace insitu {

struct ObjMaterial {
  std::optional<Eigen::Vector3d> rgb;
  double opacity = 1;
  std::string texture, texture_place;
  std::vector<SurfaceMap> maps = {};
};

// By name. "d" goes before "Tr": programs write both alike, and d is the defined one. A colour or
// opacity that is no number is counted as skipped. norm is a normal map, map_Pr and map_Pm are
// roughness and metal; of bump and map_Bump heights it is not said how high they are, so that they
// are counted as skipped. Throws InputError: unreadable.
std::map<std::string, ObjMaterial> ReadObjMaterials(const std::filesystem::path& path,
                                                    SkippedEntities* skipped);

}  // namespace insitu
