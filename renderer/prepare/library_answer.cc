// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/prepare/library_answer.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/files/sentence.h"
#include "radiometry/library/material_library.h"
#include "radiometry/light/material.h"
#include "renderer/building/building_materials.h"

namespace insitu {
namespace {

// nullopt: no surface on a photograph can be of it, as of a lamp or a bare metal, or it is at
// fault, which insitu materials tells.
std::optional<Json::Value> EntryJson(const LibraryEntry& entry) {
  if (entry.content.At("kind").Text() != "material") return std::nullopt;
  Json::Value json;
  try {
    const NaturalMaterial natural = ReadNaturalMaterial(entry.content);
    const SurfaceMaterial surface =
        ReadBuildingMaterial(entry.name, entry.content, entry.content.path().parent_path()).surface;
    json["mirrors"] = natural.specular.has_value();
    json["rgb"] = ToJson(Eigen::VectorXd(surface.diffuse_rgb));
    json["has_table"] = !surface.reflectance.empty();
  } catch (const InputError&) {
    return std::nullopt;
  }
  json["name"] = entry.name;
  json["group"] = entry.group;
  for (const char* key : {"title", "title_de"}) {
    const auto title = entry.content.Find(key);
    if (title) json[key] = title->Text();
  }
  return json;
}

}  // namespace

Json::Value LibraryAnswer(const SitePaths& site) {
  Json::Value answer;
  answer["materials"] = Json::Value(Json::arrayValue);
  try {
    const MaterialLibrary library(LibraryFolders(site));
    std::vector<const LibraryEntry*> entries;
    for (const auto& [name, entry] : library.entries()) entries.push_back(&entry);
    std::ranges::stable_sort(entries, {}, [](const LibraryEntry* entry) { return entry->group; });
    for (const LibraryEntry* entry : entries) {
      if (const auto json = EntryJson(*entry)) answer["materials"].append(*json);
    }
  } catch (const InputError& error) {
    SentenceOf(error).SayIn(&answer, "error");
  }
  return answer;
}

}  // namespace insitu
