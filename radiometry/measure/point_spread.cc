// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "radiometry/measure/measure_image_quality.h"
#include "radiometry/measure/robust_weights.h"

namespace insitu {
namespace {

constexpr double kSamePlace = 8;     // [px]: pieces whose middles share such a cell are one
constexpr int kEdgesOverField = 20;  // fewest, for a growth towards the corners
constexpr double kFieldSpan = 0.25;  // of the squared half diagonal, that they must cover
constexpr double kSignificant = 3;   // growth over its standard deviation
constexpr double kOutlier = 3;       // robust standard deviations

// An edge longer than that runs towards the camera's own plane: its halves are looked at.
constexpr double kFarOut = 1e5;  // [px]
constexpr int kMostHalvings = 24;

using Cell = std::pair<long, long>;

// A world point's pixel; nullopt behind the camera or beyond the frame.
std::optional<Eigen::Vector2d> SeenAt(const PosedCamera& posed, const Eigen::Vector3d& point) {
  const auto pixel = posed.camera.Project(posed.cam_from_world * point);
  if (!pixel || !posed.camera.Sees(*pixel)) return std::nullopt;
  return pixel;
}

// The piece between two shares of an edge from `start` to `end`.
std::optional<EdgePiece> PieceOf(const PosedCamera& posed, const Eigen::Vector3d& start,
                                 const Eigen::Vector3d& end, double from, double to) {
  EdgePiece piece;
  for (int i = 0; i < 3; ++i) {
    const double share = from + (to - from) * i / 2;
    const auto pixel = SeenAt(posed, (1 - share) * start + share * end);
    if (!pixel) return std::nullopt;
    piece[i] = *pixel;
  }
  return piece;
}

void AddPieces(const PosedCamera& posed, const Eigen::Vector3d& start, const Eigen::Vector3d& end,
               std::set<Cell>* taken, std::vector<EdgePiece>* pieces, int halvings = 0) {
  const auto first = posed.camera.Project(posed.cam_from_world * start);
  const auto last = posed.camera.Project(posed.cam_from_world * end);
  if (!first || !last || *first == *last) return;
  if (!((*last - *first).norm() < kFarOut)) {
    if (halvings == kMostHalvings) return;
    const Eigen::Vector3d middle = (start + end) / 2;
    AddPieces(posed, start, middle, taken, pieces, halvings + 1);
    AddPieces(posed, middle, end, taken, pieces, halvings + 1);
    return;
  }
  const auto length = SlantedLength((*last - *first).normalized());
  const int count = length ? static_cast<int>((*last - *first).norm() / *length) : 0;
  for (int i = 0; i < count; ++i) {
    const auto piece = PieceOf(posed, start, end, i / static_cast<double>(count),
                               (i + 1) / static_cast<double>(count));
    if (!piece) continue;
    const Eigen::Vector2d cell = (*piece)[1] / kSamePlace;
    if (!taken->emplace(std::lround(cell.x()), std::lround(cell.y())).second) continue;
    pieces->push_back(*piece);
  }
}

void AddRing(const PosedCamera& posed, const std::vector<Eigen::Vector3d>& ring,
             std::set<Cell>* taken, std::vector<EdgePiece>* pieces) {
  for (size_t i = 0; i < ring.size(); ++i) {
    AddPieces(posed, ring[i], ring[(i + 1) % ring.size()], taken, pieces);
  }
}

struct FieldSpread {
  double share;     // squared distance from the centre over the squared half diagonal
  double variance;  // [px^2]
};

// Its variance in the centre and the growth to a corner, by least squares; the growth is 0 where it
// is not significant. [px^2]
Eigen::Vector2d FitField(const std::vector<FieldSpread>& field, double variance) {
  const Eigen::Vector2d even(variance, 0);
  const auto [least, most] = std::minmax_element(
      field.begin(), field.end(), [](const auto& a, const auto& b) { return a.share < b.share; });
  if (field.size() < kEdgesOverField || most->share - least->share < kFieldSpan) return even;
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (const FieldSpread& spread : field) {
    const Eigen::Vector2d row(1, spread.share);
    normal += row * row.transpose();
    right += row * spread.variance;
  }
  const Eigen::Matrix2d cofactor = normal.inverse();
  const Eigen::Vector2d fit = cofactor * right;
  double squares = 0;
  for (const FieldSpread& spread : field) {
    squares += std::pow(spread.variance - fit.dot(Eigen::Vector2d(1, spread.share)), 2);
  }
  const double error = std::sqrt(squares / static_cast<double>(field.size() - 2) * cofactor(1, 1));
  const bool is_growth = std::abs(fit[1]) > kSignificant * error;
  return is_growth && fit[0] > 0 && fit.sum() > 0 ? fit : even;
}

}  // namespace

std::vector<EdgePiece> EdgePiecesIn(const SceneGeometry& scene, size_t index) {
  std::set<Cell> taken;
  std::vector<EdgePiece> pieces;
  for (const Polygon& polygon : scene.polygons) {
    AddRing(scene.cameras[index], polygon.vertices, &taken, &pieces);
    for (const auto& hole : polygon.holes) AddRing(scene.cameras[index], hole, &taken, &pieces);
  }
  return pieces;
}

std::optional<PointSpread> MeasurePointSpread(const Photograph& photo,
                                              const std::vector<EdgePiece>& pieces) {
  const Eigen::Vector2d half(photo.linear.width / 2.0, photo.linear.height / 2.0);
  std::vector<double> sigmas, shares;
  for (const EdgePiece& piece : pieces) {
    const auto spread = MeasureEdgeSpread(photo, piece);
    if (!spread) continue;
    sigmas.push_back(spread->sigma);
    shares.push_back((piece[1] - half).squaredNorm() / half.squaredNorm());
  }
  if (sigmas.size() < kFewestEdges) return std::nullopt;
  const double median = Median(sigmas);
  std::vector<double> deviations;
  for (const double sigma : sigmas) deviations.push_back(std::abs(sigma - median));
  const double spread = kSigmaOverMedian * Median(deviations);
  std::vector<FieldSpread> field;
  for (size_t i = 0; i < sigmas.size(); ++i) {
    if (deviations[i] <= kOutlier * spread) field.push_back({shares[i], sigmas[i] * sigmas[i]});
  }
  const Eigen::Vector2d fit = FitField(field, median * median);
  return PointSpread{std::sqrt(fit[0]), std::sqrt(fit.sum()), spread,
                     static_cast<int>(sigmas.size())};
}

}  // namespace insitu
