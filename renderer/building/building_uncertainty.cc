// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/building_uncertainty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "calibration/files/wording.h"

namespace insitu {
namespace {

constexpr double kSamePlace = 1e-3;  // [m], vertices nearer than this are one corner

}  // namespace

std::optional<std::vector<CornerUncertainty>> BuildingUncertainty(
    const SceneGeometry& scene, size_t camera, const ArtificialEnvironment& building) {
  if (scene.camera_covariances.empty()) return std::nullopt;
  std::vector<CornerUncertainty> corners;
  std::set<std::array<long long, 3>> seen;
  for (const Eigen::Vector3d& vertex : building.vertices) {
    const Eigen::Vector3d cell = ((vertex - scene.origin) / kSamePlace).array().round();
    const bool is_new =
        seen.insert({std::llround(cell.x()), std::llround(cell.y()), std::llround(cell.z())})
            .second;
    if (!is_new) continue;
    const auto image = ProjectWithUncertainty(scene.cameras.at(camera),
                                              scene.camera_covariances.at(camera), vertex);
    if (image) corners.push_back({vertex, *image});
  }
  return corners;
}

UncertaintySummary Summarize(const std::vector<CornerUncertainty>& corners) {
  INSITU_CHECK(!corners.empty());
  std::vector<double> px, m;
  for (const CornerUncertainty& corner : corners) {
    px.push_back(corner.image.major_px);
    m.push_back(corner.image.major_m);
  }
  std::sort(px.begin(), px.end());
  std::sort(m.begin(), m.end());
  return {static_cast<int>(corners.size()), px[px.size() / 2], px.back(), m[m.size() / 2],
          m.back()};
}

void WriteUncertainty(const std::filesystem::path& path,
                      const std::vector<CornerUncertainty>& corners) {
  std::string text = "x,y,z,pixel_x,pixel_y,sigma_major_px,sigma_minor_px,sigma_mm\n";
  for (const CornerUncertainty& corner : corners) {
    text +=
        Formatted("%.4f,%.4f,%.4f,%.2f,%.2f,%.4f,%.4f,%.3f\n", corner.corner.x(), corner.corner.y(),
                  corner.corner.z(), corner.image.pixel.x(), corner.image.pixel.y(),
                  corner.image.major_px, corner.image.minor_px, 1000 * corner.image.major_m);
  }
  WriteWhole(path, text);
}

}  // namespace insitu
