// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/formats/model_list.h"

#include <algorithm>
#include <map>
#include <set>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "renderer/dxf/dxf_drawing.h"
#include "renderer/formats/model_format.h"
#include "renderer/mesh/model.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

// Of files with one name the exacter format goes first.
int Rank(const fs::path& path) {
  const auto format = DetectModelFormat(path);
  if (!format) return -1;  // to be refused by name
  switch (*format) {
    case ModelFormat::kDxf:
      return 0;
    case ModelFormat::kIfc:
      return 1;
    case ModelFormat::kGltf:
      return 2;
    case ModelFormat::kCollada:
      return 3;
    case ModelFormat::kObj:
      return 4;
    case ModelFormat::kPly:
      return 5;
    case ModelFormat::kStl:
      return 6;
    case ModelFormat::kObjects:
      return 8;
  }
  return 7;
}

// The name of a model in a folder; empty: none.
std::string ModelIn(const fs::path& folder) {
  std::error_code none;
  std::string first;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    const std::string name = entry.path().filename().string();
    if (!IsNamedLikeAModel(entry.path()) || !entry.is_regular_file()) continue;
    if (first.empty() || name < first) first = name;
  }
  return first;
}

// Nothing of one that cannot be read: its reader refuses it.
std::vector<fs::path> ReferencesOf(const fs::path& path) {
  try {
    return ExternalDrawingsOf(path);
  } catch (const InputError&) {
    return {};
  }
}

// A drawing that another one refers to stands where that one puts it, once.
void DropExternalDrawings(ModelList* list) {
  std::vector<fs::path> drawings;
  for (const fs::path& path : list->files) {
    if (DetectModelFormat(path) == ModelFormat::kDxf) drawings.push_back(path);
  }
  if (drawings.size() < 2) return;
  std::set<fs::path> dropped;
  for (const fs::path& drawing : drawings) {
    if (dropped.contains(fs::absolute(drawing).lexically_normal())) continue;  // of two that do
    for (const fs::path& reference : ReferencesOf(drawing)) {
      const auto is_it = [&](const fs::path& path) {
        return path != drawing && fs::absolute(path).lexically_normal() == reference;
      };
      if (std::erase_if(list->files, is_it) == 0) continue;
      dropped.insert(reference);
      list->warnings.push_back(
          InputError(reference, "read where " + drawing.filename().string() +
                                    " refers to it (XREF), not as a model of its own")
              .what());
    }
  }
}

// Files that are read by other readers, or are for people.
bool IsOurs(const fs::path& path) {
  static const std::set<std::string> kNames = {"PLACEMENT.JSON", "MATERIALS.JSON", "LIGHTS.JSON"};
  const std::string name = NameKey(path.filename().string());
  return kNames.contains(name) || name.starts_with("README") || name.starts_with("LICEN") ||
         name.starts_with("SOURCE");
}

void AddTexts(const Json::Value& value, std::string* texts) {
  if (value.isString()) texts->append("\n" + value.asString() + "\n");
  if (!value.isArray() && !value.isObject()) return;
  for (const Json::Value& item : value) AddTexts(item, texts);
}

// Everything that the site's own files of the building say, each text on a line.
std::string TextsBeside(const SitePaths& site) {
  std::string texts;
  for (const char* name : {"materials.json", "lights.json"}) {
    const fs::path path = site.building() / name;
    if (fs::exists(path)) AddTexts(ReadJson(path), &texts);
  }
  return texts;
}

bool Holds(const fs::path& folder, const fs::path& file) {
  const auto [end, ignored] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return end == folder.end();
}

}  // namespace

ModelList ListModels(const SitePaths& site) {
  std::map<std::string, std::vector<fs::path>> files_of_name;
  std::error_code missing;
  ModelList list;
  for (const fs::directory_entry& entry : fs::directory_iterator(site.building(), missing)) {
    const fs::path& path = entry.path();
    if (entry.is_directory()) {
      const std::string model = ModelIn(path);
      if (!model.empty()) {
        list.warnings.push_back(
            InputError(path, "not read: the folder holds " + model + ": move it into building/")
                .what());
      } else {
        list.others.push_back(path);
      }
      continue;
    }
    if (!entry.is_regular_file() || path.filename().string().starts_with('.')) continue;
    const auto format = DetectModelFormat(path);
    if (format == ModelFormat::kObjects) {
      files_of_name[path.filename().string()].push_back(path);  // a model of its own
    } else if (format || IsNamedLikeAModel(path)) {
      files_of_name[path.stem().string()].push_back(path);
    } else if (const std::string advice = AdviceOnUnread(path); !advice.empty()) {
      list.warnings.push_back(InputError(path, "not read: it is " + advice).what());
    } else if (!IsOurs(path)) {
      list.others.push_back(path);
    }
  }
  for (auto& [name, files] : files_of_name) {
    std::ranges::sort(files, {}, [](const fs::path& path) { return std::pair(Rank(path), path); });
    list.files.push_back(files.front());
    for (size_t i = 1; i < files.size(); ++i) {
      list.warnings.push_back(InputError(files[i], "not read: taken as the same model as " +
                                                       files.front().filename().string())
                                  .what());
    }
  }
  DropExternalDrawings(&list);
  if (list.files.empty()) {
    std::string found;
    for (const std::string& warning : list.warnings) found += "\n  " + warning;
    throw InputError(
        site.building(),
        "no model, expected a DXF, IFC, OBJ, glTF, COLLADA, PLY or STL file, or objects.json" +
            found);
  }
  std::ranges::sort(list.files);
  return list;
}

std::string UnreadFiles(const SitePaths& site, const std::vector<fs::path>& others,
                        const std::vector<fs::path>& read) {
  const std::string texts = TextsBeside(site);
  std::set<std::string> names;
  for (const fs::path& other : others) {
    const fs::path path = fs::absolute(other).lexically_normal();
    const bool is_read = std::ranges::any_of(
        read, [&](const fs::path& file) { return file == path || Holds(path, file); });
    const std::string name = other.filename().string();
    const bool is_named =
        texts.find("\n" + name + "\n") != texts.npos || texts.find("\n" + name + "/") != texts.npos;
    if (!is_read && !is_named) names.insert(name + (fs::is_directory(other) ? "/" : ""));
  }
  if (names.empty()) return "";
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return InputError(site.building(),
                    "not read, as no model names it and its kind is not known: " + list)
      .what();
}

}  // namespace insitu
