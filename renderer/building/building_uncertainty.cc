// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/building_uncertainty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "calibration/files/wording.h"

namespace insitu {
namespace {

constexpr double kSamePlace = 1e-3;  // [m], corners nearer than this are one
constexpr size_t kMostRows = 10000;

// The largest of each cell of this size [px], in their order.
std::vector<CornerUncertainty> OneACell(const std::vector<CornerUncertainty>& corners,
                                        double cell) {
  std::map<std::pair<long, long>, size_t> worst;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& pixel = corners[i].image.pixel;
    const auto [place, is_new] =
        worst.try_emplace({std::lround(pixel.x() / cell), std::lround(pixel.y() / cell)}, i);
    if (!is_new && corners[i].image.major_px > corners[place->second].image.major_px) {
      place->second = i;
    }
  }
  std::set<size_t> kept;
  for (const auto& [place, corner] : worst) kept.insert(corner);
  std::vector<CornerUncertainty> left;
  for (const size_t i : kept) left.push_back(corners[i]);
  return left;
}

}  // namespace

std::optional<std::vector<CornerUncertainty>> BuildingUncertainty(
    const SceneGeometry& scene, size_t camera, const std::vector<Eigen::Vector3d>& corners) {
  if (scene.camera_covariances.empty()) return std::nullopt;
  std::vector<CornerUncertainty> known;
  std::set<std::array<long long, 3>> seen;
  for (const Eigen::Vector3d& corner : corners) {
    const Eigen::Vector3d cell = ((corner - scene.origin) / kSamePlace).array().round();
    const bool is_new =
        seen.insert({std::llround(cell.x()), std::llround(cell.y()), std::llround(cell.z())})
            .second;
    if (!is_new) continue;
    const auto image = ProjectWithUncertainty(scene.cameras.at(camera),
                                              scene.camera_covariances.at(camera), corner);
    if (image) known.push_back({corner, *image});
  }
  return known;
}

std::vector<CornerUncertainty> ThinnedOut(std::vector<CornerUncertainty> corners) {
  for (double cell = 1; corners.size() > kMostRows; cell *= 2) corners = OneACell(corners, cell);
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
