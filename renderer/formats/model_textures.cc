// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/formats/model_textures.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "renderer/foreign/file_reference.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

std::string EndingOf(std::string_view image) {
  if (image.starts_with("\x89PNG")) return ".png";
  if (image.starts_with("\xFF\xD8\xFF")) return ".jpg";
  return "";
}

// The file of an image "*0" that the model holds; empty: none that is read.
std::string WrittenImage(const SitePaths& site, const fs::path& file, const std::string& name,
                         const Model& model) {
  const auto image = model.images.find(name);
  const std::string ending = image == model.images.end() ? "" : EndingOf(image->second);
  if (ending.empty()) return "";
  const fs::path folder = fs::absolute(site.design() / "building_textures").lexically_normal();
  const fs::path path = folder / (file.filename().string() + "_" + name.substr(1) + ending);
  WriteWhole(path, image->second);
  return path.string();
}

// Empty, with a warning: no such file.
std::string TextureBeside(const fs::path& file, const std::string& texture,
                          const SurfaceNames& names, Model* model) {
  if (const auto path = FindReference(file, texture)) {
    model->files.push_back(*path);
    return path->string();
  }
  const std::string warning =
      (names.texture_place.empty() ? file.string() : names.texture_place) + ": names the texture " +
      texture + ", which is not there: left out of material \"" + names.material +
      "\"; put the image beside the model, or list the material in materials.json";
  if (std::ranges::find(model->warnings, warning) == model->warnings.end()) {
    model->warnings.push_back(warning);
  }
  return "";
}

// Where the image lies that a surface names; empty, with a warning: nowhere.
std::string Located(const SitePaths& site, const fs::path& file, const std::string& texture,
                    const SurfaceNames& names, Model* model) {
  if (!texture.starts_with('*')) return TextureBeside(file, texture, names, model);
  const std::string written = WrittenImage(site, file, texture, *model);
  if (written.empty()) {
    model->warnings.push_back(InputError(file, "the texture inside it of material \"" +
                                                   names.material +
                                                   "\" is neither PNG nor JPEG: left out")
                                  .what());
  }
  return written;
}

}  // namespace

void LocateTextures(const SitePaths& site, const fs::path& file, Model* model) {
  for (SurfaceNames& names : model->mesh.surfaces) {
    if (!names.texture.empty()) names.texture = Located(site, file, names.texture, names, model);
    for (SurfaceMap& map : names.maps) map.file = Located(site, file, map.file, names, model);
    std::erase_if(names.maps, [](const SurfaceMap& map) { return map.file.empty(); });
  }
}

}  // namespace insitu
