// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/site_check.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "calibration/files/csv_file.h"
#include "calibration/files/wording.h"
#include "reconstruction/geometry/scene_geometry.h"

namespace insitu {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

struct DrawnUnit {
  double metres;
  const char* name;
};

constexpr DrawnUnit kUnits[] = {{1e-3, "millimetres"},
                                {1e-2, "centimetres"},
                                {1, "metres"},
                                {0.0254, "inches"},
                                {0.3048, "feet"}};

// The model's coordinates are `value` times too large.
struct Factor {
  double value;
  std::string meaning;
};

// What a model may have been drawn in, whose coordinates were taken for `taken` metres each.
std::vector<Factor> FactorsOf(double taken) {
  const auto is_taken = [&](const DrawnUnit& unit) {
    return std::abs(unit.metres / taken - 1) < 1e-4;  // feet of both kinds
  };
  const auto known = std::ranges::find_if(kUnits, is_taken);
  const std::string as =
      known == std::end(kUnits) ? Number("units of %g m", taken) : std::string(known->name);
  std::vector<Factor> factors;
  for (const DrawnUnit& unit : kUnits) {
    if (is_taken(unit)) continue;
    factors.push_back({taken / unit.metres, std::string(unit.name) + " taken as " + as});
  }
  return factors;
}

// Sizes a planned building may have, from a kiosk to a district [m].
constexpr double kSmallest = 1, kLargest = 3000;

// A model whose file names no unit, and that is larger than the site, was drawn in another one.
bool IsLikely(double size, const AlignedBox3d& site, bool names_unit) {
  if (size < kSmallest || size > kLargest) return false;
  if (site.isEmpty()) return true;
  constexpr double kMost = 5, kMostWithoutUnit = 2;
  const double share = size / site.diagonal().norm();
  return share > 0.02 && share < (names_unit ? kMost : kMostWithoutUnit);
}

double Distance(const AlignedBox3d& building, const AlignedBox3d& site) {
  return std::sqrt(building.squaredExteriorDistance(site));
}

bool IsFar(const AlignedBox3d& building, const AlignedBox3d& site) {
  return !site.isEmpty() && Distance(building, site) > std::max(2 * site.diagonal().norm(), 200.0);
}

AlignedBox3d Scaled(const AlignedBox3d& box, double factor) {
  return {box.min() * factor, box.max() * factor};
}

// The factor that puts the building onto the site, or else brings its size to the likely one
// nearest to a tenth of the site.
std::optional<Factor> FactorOff(const AlignedBox3d& building, const AlignedBox3d& site,
                                std::optional<double> metres_per_unit) {
  const double size = building.diagonal().norm();
  std::optional<Factor> best;
  double best_misfit = 0;
  for (const Factor& factor : FactorsOf(metres_per_unit.value_or(1))) {
    const AlignedBox3d box = Scaled(building, 1 / factor.value);
    if (!IsLikely(size / factor.value, site, metres_per_unit.has_value())) continue;
    const bool lands = !site.isEmpty() && IsFar(building, site) && !IsFar(box, site);
    const double usual = site.isEmpty() ? 30 : site.diagonal().norm() / 3;
    const double misfit = std::abs(std::log(size / factor.value / usual)) - (lands ? 100 : 0);
    if (best && misfit >= best_misfit) continue;
    best = factor;
    best_misfit = misfit;
  }
  return best;
}

}  // namespace

AlignedBox3d SiteBox(const SitePaths& site) {
  AlignedBox3d box;
  if (std::filesystem::exists(site.scene())) {
    for (const Polygon& polygon : ReadSceneGeometry(site).polygons) {
      for (const Vector3d& vertex : polygon.vertices) box.extend(vertex);
    }
  }
  const std::filesystem::path points = site.survey() / "control_points.csv";
  if (!box.isEmpty() || !std::filesystem::exists(points)) return box;
  for (const CsvRow& row : ReadCsv(points, {"name", "x", "y", "z"})) {
    box.extend(Vector3d(row.Number("x"), row.Number("y"), row.Number("z")));
  }
  return box;
}

std::vector<std::string> SuspicionsOf(const AlignedBox3d& building, const AlignedBox3d& site,
                                      std::optional<double> metres_per_unit) {
  std::vector<std::string> suspicions;
  if (building.isEmpty()) return suspicions;
  const double size = building.diagonal().norm();
  const bool far = IsFar(building, site);
  if (far) {
    suspicions.push_back(
        Number("the building lies %.0f m from the site", Distance(building, site)) +
        Number(" (%.0f m across): see placement.json", site.diagonal().norm()));
  }
  const bool is_likely = IsLikely(size, site, metres_per_unit.has_value());
  if (!is_likely) {
    suspicions.push_back(
        Number("the building is %.4g m across", size) +
        (site.isEmpty() ? "" : Number(", the site %.4g m", site.diagonal().norm())));
  }
  if (suspicions.empty()) return suspicions;
  const std::optional<Factor> factor = FactorOff(building, site, metres_per_unit);
  const bool lands = factor && far && !IsFar(Scaled(building, 1 / factor->value), site);
  if (factor && (lands || !is_likely)) {
    suspicions.push_back(Number("its unit looks wrong by a factor of %.5g: ", factor->value) +
                         factor->meaning + "? (\"unit\" in placement.json)");
  }
  return suspicions;
}

}  // namespace insitu
