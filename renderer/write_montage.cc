// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/write_montage.h"

#include <map>

#include "calibration/files/json_file.h"
#include "calibration/files/sha256.h"
#include "calibration/files/whole_file.h"
#include "calibration/photo/exif.h"
#include "renderer/trace/profile.h"

namespace insitu {
namespace {

// Of all files of survey/, by their names and contents; "" if there are none.
std::string SurveySha256(const SitePaths& site) {
  if (!std::filesystem::is_directory(site.survey())) return "";
  std::map<std::string, std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(site.survey())) {
    if (!entry.is_regular_file()) continue;
    files[entry.path().lexically_relative(site.survey()).generic_string()] = entry.path();
  }
  std::string text;
  for (const auto& [name, file] : files) text += Sha256(file) + "  " + name + "\n";
  return Sha256OfText(text);
}

std::string WhatIsShown(AvrLevel level) {
  switch (level) {
    case AvrLevel::kSilhouette:
      return "a drawing, the planned building's silhouette whatever hides it (AVR 0)";
    case AvrLevel::kOutline:
      return "a drawing, the planned building's outline, dashed where it is hidden (AVR 1)";
    case AvrLevel::kForm:
      return "the planned building's form in one grey, not in its materials (AVR 2)";
    case AvrLevel::kMaterials:
      break;
  }
  return "the planned building";
}

MontageStatement StatementOf(MontageStatement statement, const std::filesystem::path& photograph,
                             const RenderResult& result) {
  statement.photograph_sha256 = Sha256(photograph);
  const bool is_simulated = !statement.simulation.empty();
  statement.is_composite = is_simulated || result.building_pixels + result.changed_pixels > 0;
  statement.computed = statement.is_composite
                           ? std::to_string(result.building_pixels) + " pixels of " +
                                 statement.computed + ", " + std::to_string(result.changed_pixels) +
                                 " pixels of its surroundings whose light it "
                                 "changes; all others are the photograph's" +
                                 (is_simulated ? ", simulated at another hour" : "")
                           : "nothing: all pixels are the photograph's";
  return statement;
}

// As the photograph's montage is turned.
void WriteUpright(const std::filesystem::path& file, const Raster& picture,
                  const std::filesystem::path& photograph) {
  const CodedPhotograph upright =
      Upright(CodesOf(picture, Encoding::kLinear, {}), ReadOrientation(photograph));
  WriteWhole(file, [&](const std::filesystem::path& temporary) { WriteCodes(temporary, upright); });
}

}  // namespace

MontageStatement StatementOf(const SitePaths& site, const MontageKind& kind) {
  MontageStatement statement;
  statement.computed = WhatIsShown(kind.avr);
  statement.quality = kind.quality;
  statement.parameters = kind.parameters;
  statement.program = std::string("insitu ") + INSITU_VERSION;
  statement.survey_sha256 = SurveySha256(site);
  if (kind.with_building) statement.model_sha256 = Sha256(site.artificial());
  if (!site.hour.empty()) {
    statement.simulation =
        JsonNode::Load(site.environment()).At("simulation").At("statement").Text();
  }
  return statement;
}

std::vector<std::string> WriteMontage(const SitePaths& site,
                                      const std::filesystem::path& photograph,
                                      const MontageFormat& format, Photograph photo, Raster linear,
                                      const RenderResult& result,
                                      const MontageStatement& statement) {
  const PhaseScope phase(Phase::kFiles);
  return WriteMontageFiles(
      site.montage(photograph.stem().string()),
      {std::move(linear), std::move(photo), photograph, format.frame == Frame::kPhoto,
       StatementOf(statement, photograph, result), format.with_tiff, format.is_quick});
}

void WriteSunShares(const SitePaths& site, const std::filesystem::path& photograph,
                    const std::optional<SunShares>& shares) {
  const std::filesystem::path file = site.montage(photograph.stem().string()) += ".shadows.exr";
  if (!shares) {
    std::filesystem::remove(file);
    return;
  }
  Raster picture(shares->share.width, shares->share.height);
  for (size_t i = 0; i < shares->share.data.size(); ++i) {
    picture.data[3 * i] = shares->share.data[i];
    picture.data[3 * i + 1] = shares->sigma.data[i];
  }
  WriteUpright(file, picture, photograph);
}

void WriteLayers(const SitePaths& site, const std::filesystem::path& photograph,
                 const RenderResult& result) {
  const std::filesystem::path stem = site.montage(photograph.stem().string());
  WriteUpright(std::filesystem::path(stem) += ".layers.exr", result.layers, photograph);
  const std::filesystem::path file = std::filesystem::path(stem) += ".unseen.exr";
  if (result.unseen_pixels == 0) {
    std::filesystem::remove(file);
    return;
  }
  Raster picture(result.unseen.width, result.unseen.height);
  for (size_t i = 0; i < result.unseen.data.size(); ++i)
    picture.data[3 * i] = result.unseen.data[i];
  WriteUpright(file, picture, photograph);
}

void RemoveMontage(const SitePaths& site, const std::string& photo) {
  for (const char* ending : {".exr", ".png", ".jpg", ".tif", ".layers.exr", ".shadows.exr",
                             ".unseen.exr", ".parts.exr"}) {
    std::filesystem::remove(site.montage(photo) += ending);
  }
}

}  // namespace insitu
