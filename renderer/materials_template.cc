// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/materials_template.h"

#include <map>
#include <vector>

#include "calibration/files/json_file.h"
#include "renderer/formats/model_list.h"

namespace insitu {

namespace fs = std::filesystem;
using Eigen::Vector3d;

std::string MaterialsTemplate(const SitePaths& site, const ConvertOptions& options) {
  options.Check();
  const std::vector<fs::path> files =
      options.models.empty() ? ListModels(site).files : options.models;
  std::map<std::string, std::map<std::string, Json::Value>> sections;
  for (const fs::path& path : files) {
    for (const SurfaceNames& names : ReadModel(path, options.import).mesh.surfaces) {
      Json::Value entry;
      const Vector3d grey = Vector3d::Constant(0.5);
      entry["diffuse_rgb"] = ToJson(Eigen::VectorXd(names.rgb.value_or(grey)));
      entry["specular"] = "none";
      sections["layers"].try_emplace(names.layer, entry);
      if (!names.block.empty()) sections["blocks"].try_emplace(names.block, entry);
      if (!names.material.empty()) sections["materials"].try_emplace(names.material, entry);
    }
  }
  Json::Value root;
  for (const auto& [section, entries] : sections) {
    for (const auto& [name, entry] : entries) root[section][name] = entry;
  }
  return root.toStyledString();
}

}  // namespace insitu
