// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/tiles/render_inputs.h"

#include <set>

#include "calibration/files/sha256.h"
#include "calibration/foreground_matte.h"

namespace insitu {
namespace {

std::string HashLine(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) return "none\n";
  return Sha256(file) + "\n";
}

}  // namespace

std::string SiteInputsSha256(const SitePaths& site, const NaturalEnvironment& natural,
                             const ArtificialEnvironment& building) {
  std::string text = HashLine("/proc/self/exe");
  text += HashLine(site.environment());
  for (const InputImage& image : natural.input_images) text += HashLine(image.file);
  if (!building.triangles.empty() || !building.lights.empty()) {
    text += HashLine(site.artificial());
    text += HashLine(std::filesystem::path(site.artificial()).replace_extension(".bin"));
  }
  for (const auto& [polygon, mask] : PolygonMasks(site)) text += HashLine(site.survey() / mask);
  std::set<std::string> textures;
  for (const SurfaceMaterial& material : building.materials) {
    textures.insert(material.texture);
    for (const SurfaceMap& map : material.maps) textures.insert(map.file);
  }
  for (const std::string& texture : textures) {
    if (!texture.empty()) text += HashLine(site.building() / texture);
  }
  return Sha256OfText(text);
}

std::string PhotographInputsSha256(const SitePaths& site, const std::string& site_inputs,
                                   const std::filesystem::path& photograph) {
  const std::string name = photograph.stem().string();
  return Sha256OfText(site_inputs + "\n" + HashLine(photograph) +
                      HashLine(site.survey() / "foreground" / (name + ".png")) +
                      HashLine(site.survey() / "shadows" / (name + ".png")) +
                      (site.hour.empty() ? "" : HashLine(site.relit_photo(name))));
}

}  // namespace insitu
