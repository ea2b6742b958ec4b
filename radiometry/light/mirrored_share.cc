// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/mirrored_share.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace insitu {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

constexpr int kSlopes = 25, kCosines = 41;  // of the table
constexpr int kSide = 20;                   // facets of an entry, squared
constexpr double kLeastCosine = 1e-3;

// Cosines are squared so that there are more of them at grazing sight.
double CosineOf(int j) {
  const double share = static_cast<double>(j) / (kCosines - 1);
  return std::max(kLeastCosine, share * share);
}

double ShareByFacets(const Roughness& roughness, double cosine) {
  const Vector3d view(std::sqrt(1 - cosine * cosine), 0, cosine);
  double sum = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const int column = i % kSide, row = i / kSide;
    const Vector2d uniform((column + 0.5) / kSide, (row + 0.5) / kSide);
    const Vector3d facet = VisibleFacet(roughness, view, uniform);
    sum += SmithMasking(roughness, (2 * facet.dot(view) * facet - view).z());
  }
  return sum / (kSide * kSide);
}

using ShareTable = std::array<std::array<double, kCosines>, kSlopes>;

ShareTable MakeTable(FacetDistribution distribution) {
  ShareTable table;
  table[0].fill(1);
  for (int i = 1; i < kSlopes; ++i) {
    const Roughness roughness{static_cast<double>(i) / (kSlopes - 1), distribution};
    for (int j = 0; j < kCosines; ++j) table[i][j] = ShareByFacets(roughness, CosineOf(j));
  }
  return table;
}

const ShareTable& TableOf(FacetDistribution distribution) {
  static const ShareTable ggx = MakeTable(FacetDistribution::kGgx);
  if (distribution == FacetDistribution::kGgx) return ggx;
  static const ShareTable beckmann = MakeTable(FacetDistribution::kBeckmann);
  return beckmann;
}

}  // namespace

double MirroredShare(const Roughness& roughness, double cosine) {
  if (roughness.slope <= 0) return 1;
  const ShareTable& table = TableOf(roughness.distribution);
  const double u = std::min(roughness.slope, 1.0) * (kSlopes - 1);
  const double v = std::sqrt(std::clamp(cosine, 0.0, 1.0)) * (kCosines - 1);
  const int i = std::min(static_cast<int>(u), kSlopes - 2);
  const int j = std::min(static_cast<int>(v), kCosines - 2);
  const double s = u - i, t = v - j;
  return (1 - s) * ((1 - t) * table[i][j] + t * table[i][j + 1]) +
         s * ((1 - t) * table[i + 1][j] + t * table[i + 1][j + 1]);
}

}  // namespace insitu
