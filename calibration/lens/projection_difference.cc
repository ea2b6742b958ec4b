// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/lens/projection_difference.h"

#include <algorithm>
#include <cmath>

#include "calibration/algebra/decompositions.h"
#include "calibration/files/error.h"

namespace insitu {
namespace {

struct Node {
  Eigen::Vector2d pixel;
  Eigen::Vector3d sight_in_a;
  double weight;
};

// One step of Gauss and Newton on the rotation; false if it has come to rest.
bool Improve(const Camera& b, const std::vector<Node>& nodes, Eigen::Quaterniond* b_from_a) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Node& node : nodes) {
    const Eigen::Vector3d sight = *b_from_a * node.sight_in_a;
    Eigen::Matrix<double, 2, 3> pixel_from_point;
    const auto pixel = b.Project(sight, &pixel_from_point);
    if (!pixel) continue;
    Eigen::Matrix3d cross;
    cross << 0, -sight.z(), sight.y(), sight.z(), 0, -sight.x(), -sight.y(), sight.x(), 0;
    const Eigen::Matrix<double, 2, 3> pixel_from_turn = -pixel_from_point * cross;
    normal += node.weight * pixel_from_turn.transpose() * pixel_from_turn;
    right += node.weight * pixel_from_turn.transpose() * (node.pixel - *pixel);
  }
  const Eigen::Vector3d turn = SolveSymmetric(normal, right);
  if (!turn.allFinite() || turn.norm() < 1e-13) return false;
  *b_from_a = (Eigen::AngleAxisd(turn.norm(), turn.normalized()) * *b_from_a).normalized();
  return true;
}

}  // namespace

std::vector<Eigen::Vector2d> FrameCenters(int width, int height, int columns, int rows) {
  INSITU_CHECK(columns > 0 && rows > 0);
  std::vector<Eigen::Vector2d> centers;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      centers.emplace_back(width * (column + 0.5) / columns - 0.5,
                           height * (row + 0.5) / rows - 0.5);
    }
  }
  return centers;
}

ProjectionDifference CompareLenses(const Camera& a, const Camera& b, int columns, int rows,
                                   const std::vector<double>& weights) {
  INSITU_CHECK(a.width() == b.width() && a.height() == b.height());
  ProjectionDifference difference{.columns = columns, .rows = rows};
  std::vector<Node> nodes;
  for (const Eigen::Vector2d& pixel : FrameCenters(a.width(), a.height(), columns, rows)) {
    nodes.push_back({pixel, a.Unproject(pixel), weights.empty() ? 1 : weights[nodes.size()]});
  }
  constexpr int kMostSteps = 20;
  for (int i = 0; i < kMostSteps && Improve(b, nodes, &difference.b_from_a); ++i) continue;
  double sum = 0;
  int count = 0;
  for (const Node& node : nodes) {
    const auto pixel = b.Project(difference.b_from_a * node.sight_in_a);
    difference.px.emplace_back();
    if (!pixel) continue;
    const double length = (*pixel - node.pixel).norm();
    if (!std::isfinite(length)) continue;
    difference.px.back() = length;
    difference.largest_px = std::max(difference.largest_px, length);
    sum += length * length;
    ++count;
  }
  difference.rms_px = count > 0 ? std::sqrt(sum / count) : 0;
  return difference;
}

}  // namespace insitu
