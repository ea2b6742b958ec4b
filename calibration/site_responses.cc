// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/site_responses.h"

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/files/raw_ending.h"
#include "calibration/files/wording.h"
#include "calibration/photo/paired_response.h"
#include "calibration/photo/photograph.h"
#include "calibration/program/program.h"

namespace insitu {
namespace {

constexpr double kWellRegistered = 0.5;  // [px]

PairRegistration Register(const PhotographPair& pair, const Raster& raw, const Raster& picture) {
  const PairRegistration found = RegisterPair(raw, picture);
  const std::string beside = " beside " + pair.picture.filename().string();
  if (found.pieces == 0) {
    throw InputError(pair.raw, "shows nothing of what the picture" + beside +
                                   " shows, expected the raw of the same moment");
  }
  if (found.residual_px >= kWellRegistered) {
    throw InputError(pair.raw, "lies on the picture" + beside + " to " +
                                   Formatted("%.2f", found.residual_px) +
                                   " px only, expected under 0.5 px; take the raw alone, or the "
                                   "picture alone");
  }
  return found;
}

Json::Value EntryOf(const std::string& photo, const PairedResponse& response) {
  Json::Value entry;
  entry["photos"].append(photo);
  const char* const channels[] = {"red", "green", "blue"};
  for (int c = 0; c < 3; ++c) {
    for (const auto& [code, light] : response.curves[c]) {
      entry[channels[c]].append(ToJson(Eigen::VectorXd(Eigen::Vector2d(code, light))));
    }
    entry["matrix"].append(ToJson(Eigen::VectorXd(response.rec709.row(c).transpose())));
  }
  entry["sigma"] = response.sigma;
  return entry;
}

std::string LineOf(const std::string& photo, const PairRegistration& found,
                   const PairedResponse& response) {
  return photo + ": lies on its raw to " + Formatted("%.2f", found.residual_px) + " px (" +
         std::to_string(found.pieces) + " pieces), " + Formatted("%.3f", found.scale) +
         " px of the raw a pixel; response from " + std::to_string(response.places) +
         " places, light to " + Formatted("%.1f", 100 * response.sigma) + " %\n";
}

}  // namespace

std::vector<PhotographPair> PairsOf(const SitePaths& site) {
  std::vector<PhotographPair> pairs;
  for (const std::filesystem::path& picture : ListPhotographs(site)) {
    if (HasRawEnding(picture)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(site.photos())) {
      const std::filesystem::path& raw = entry.path();
      if (HasRawEnding(raw) && raw.stem() == picture.stem()) pairs.push_back({picture, raw});
    }
  }
  return pairs;
}

PairedResponses MeasurePairedResponses(const std::vector<PhotographPair>& pairs) {
  PairedResponses all;
  Progress progress("response", static_cast<int>(pairs.size()));
  for (const PhotographPair& pair : pairs) {
    const Raster raw = ReadPhotograph(pair.raw).linear;
    const Raster picture = ReadPhotograph(pair.picture).linear;
    const PairRegistration found = Register(pair, raw, picture);
    const std::string photo = pair.picture.stem().string();
    const auto response = FitPairedResponse(raw, picture, found);
    if (!response) {
      throw InputError(pair.raw, "has too few even places that neither it nor " +
                                     pair.picture.filename().string() +
                                     " has clipped, expected a hundred");
    }
    all.file["curves"].append(EntryOf(photo, *response));
    all.report += LineOf(photo, found, *response);
    progress.Step();
  }
  return all;
}

}  // namespace insitu
