// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/report/report_lens_residuals.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace insitu {
namespace {

constexpr int kCellsOfCamera = 12;  // per longer side
constexpr int kRadiusBins = 12;

struct RadiusBin {
  int marks = 0;
  Eigen::Array2d sum = Eigen::Array2d::Zero(), squares = Eigen::Array2d::Zero();
};

Json::Value Pair(const Eigen::Array2d& values) {
  Json::Value json(Json::arrayValue);
  json.append(values.x());
  json.append(values.y());
  return json;
}

// Residuals along and across the radius from the frame's middle, in rings of equal width.
Json::Value ResidualsByRadius(const std::vector<ImageMark>& marks, int width, int height) {
  const Eigen::Vector2d middle((width - 1) / 2.0, (height - 1) / 2.0);
  const double step = std::hypot(width, height) / 2 / kRadiusBins;
  std::vector<RadiusBin> bins(kRadiusBins);
  for (const ImageMark& mark : marks) {
    const Eigen::Vector2d ray = mark.pixel - middle;
    const double radius = ray.norm();
    if (radius == 0) continue;
    const Eigen::Array2d parts(
        mark.residual.dot(ray) / radius,
        (ray.x() * mark.residual.y() - ray.y() * mark.residual.x()) / radius);
    RadiusBin& bin = bins[std::min(static_cast<int>(radius / step), kRadiusBins - 1)];
    bin.marks += 1;
    bin.sum += parts;
    bin.squares += parts.square();
  }
  Json::Value json(Json::arrayValue);
  for (int i = 0; i < kRadiusBins; ++i) {
    if (bins[i].marks == 0) continue;
    Json::Value row;
    row["radius_px"] = (i + 0.5) * step;
    row["marks"] = bins[i].marks;
    row["mean_px"] = Pair(bins[i].sum / bins[i].marks);  // radial, tangential
    row["rms_px"] = Pair((bins[i].squares / bins[i].marks).sqrt());
    json.append(row);
  }
  return json;
}

}  // namespace

Json::Value ResidualGrid(const std::vector<ImageMark>& marks, int width, int height, int cells) {
  const double size = static_cast<double>(std::max(width, height)) / cells;
  struct Cell {
    int marks = 0;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  };
  std::map<std::pair<int, int>, Cell> grid;  // by row and column
  for (const ImageMark& mark : marks) {
    Cell& cell = grid[{static_cast<int>(std::floor((mark.pixel.y() + 0.5) / size)),
                       static_cast<int>(std::floor((mark.pixel.x() + 0.5) / size))}];
    cell.marks += 1;
    cell.sum += mark.residual;
  }
  Json::Value json(Json::arrayValue);
  for (const auto& [place, cell] : grid) {
    Json::Value row;
    row["x"] = (place.second + 0.5) * size - 0.5;
    row["y"] = (place.first + 0.5) * size - 0.5;
    row["marks"] = cell.marks;
    row["vx"] = cell.sum.x() / cell.marks;
    row["vy"] = cell.sum.y() / cell.marks;
    json.append(row);
  }
  return json;
}

Json::Value LensResidualsSection(const Adjustment& adjustment,
                                 const std::vector<ImageMark>& marks) {
  std::map<int, std::vector<ImageMark>> marks_of_camera;
  for (const ImageMark& mark : marks) {
    marks_of_camera[adjustment.poses[mark.photo].camera].push_back(mark);
  }
  Json::Value json(Json::arrayValue);
  for (const auto& [index, own] : marks_of_camera) {
    const Camera& camera = adjustment.scene.cameras[own.front().photo].camera;
    Json::Value row;
    row["camera"] = index;
    row["width"] = camera.width();
    row["height"] = camera.height();
    row["marks"] = static_cast<Json::UInt64>(own.size());
    row["grid"] = ResidualGrid(own, camera.width(), camera.height(), kCellsOfCamera);
    row["by_radius"] = ResidualsByRadius(own, camera.width(), camera.height());
    json.append(row);
  }
  return json;
}

}  // namespace insitu
