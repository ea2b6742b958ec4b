// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/bounced_light.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace insitu::demo {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kPointsAcross = 4;  // of a cell, that its reflectance and its sun are means of

AlignedBox2d BoxOf(const Face& face) {
  AlignedBox2d box;
  for (const Vector2d& corner : face.outline) box.extend(corner);
  return box;
}

Vector3d PointOn(const Face& face, const Vector2d& uv) {
  return face.vertices[0] + uv.x() * face.u_axis + uv.y() * face.v_axis;
}

// The side of a box that is quartered alone, if any: one much longer than the other.
std::optional<int> LongSide(const AlignedBox2d& box, bool keep_wide) {
  int side = 0;
  const double longest = box.sizes().maxCoeff(&side);
  if (!keep_wide || longest < 3 * box.sizes().minCoeff()) return std::nullopt;
  return side;
}

AlignedBox2d QuarterOf(const AlignedBox2d& box, int quarter, bool keep_wide) {
  if (const std::optional<int> side = LongSide(box, keep_wide)) {
    AlignedBox2d strip = box;
    strip.min()[*side] += box.sizes()[*side] * quarter / 4;
    strip.max()[*side] = strip.min()[*side] + box.sizes()[*side] / 4;
    return strip;
  }
  const Vector2d half = box.sizes() / 2;
  const Vector2d low = box.min() + half.cwiseProduct(Vector2d(quarter % 2, quarter / 2));
  return {low, low + half};
}

int QuarterAt(const AlignedBox2d& box, const Vector2d& uv, bool keep_wide) {
  if (const std::optional<int> side = LongSide(box, keep_wide)) {
    const double share = (uv[*side] - box.min()[*side]) / box.sizes()[*side];
    return std::clamp(static_cast<int>(4 * share), 0, 3);
  }
  const Vector2d middle = box.center();
  return (uv.x() >= middle.x() ? 1 : 0) + (uv.y() >= middle.y() ? 2 : 0);
}

// Points of a rectangle that lie on the face; its middle if none does.
std::vector<Vector2d> PointsIn(const Face& face, const AlignedBox2d& box) {
  std::vector<Vector2d> points;
  for (int i = 0; i < kPointsAcross * kPointsAcross; ++i) {
    const int column = i % kPointsAcross, row = i / kPointsAcross;
    const Vector2d share(column + 0.5, row + 0.5);
    const Vector2d uv = box.min() + share.cwiseProduct(box.sizes()) / kPointsAcross;
    if (Contains(face.outline, uv)) points.push_back(uv);
  }
  if (points.empty()) points.emplace_back(box.center());
  return points;
}

}  // namespace

BouncedLight::BouncedLight(const Place& place, const BouncedLightOptions& options)
    : place_(place), options_(options) {
  for (const Face& face : place.building.faces) {
    for (const Vector3d& vertex : face.vertices) focus_.extend(vertex);
  }
  if (focus_.isEmpty()) focus_.extend(Vector3d::Zero());
  AddFaces(place.site->natural);
  AddFaces(place.site->scenery);
  AddFaces(place.building);
  Solve();
}

void BouncedLight::AddFaces(const Scene& scene) {
  for (const Face& face : scene.faces) {
    Tree& tree = trees_[&face];
    tree.box = BoxOf(face);
    tree.root = static_cast<int>(quads_.size());
    quads_.emplace_back();
    Split(face, tree.box, tree.root);
  }
}

void BouncedLight::Split(const Face& face, const AlignedBox2d& box, int node) {
  const Vector3d center = PointOn(face, box.center());
  const double toward_focus = box.diagonal().norm() / 2;
  const double distance = std::max(0.0, focus_.exteriorDistance(center) - toward_focus);
  if (box.sizes().maxCoeff() <= std::max(options_.smallest, options_.growth * distance)) {
    quads_[node].cell = static_cast<int>(cells_.size());
    cells_.push_back(MakeCell(face, box));
    return;
  }
  const int quarters = static_cast<int>(quads_.size());
  quads_[node].quarters = quarters;
  quads_.resize(quads_.size() + 4);
  for (int i = 0; i < 4; ++i)
    Split(face, QuarterOf(box, i, options_.keep_cells_wide), quarters + i);
}

BouncedLight::Cell BouncedLight::MakeCell(const Face& face, const AlignedBox2d& box) const {
  Cell cell;
  cell.normal = face.normal;
  cell.albedo = cell.before = cell.after = Spectrum::Zero();
  const std::vector<Vector2d> points = PointsIn(face, box);
  Vector2d middle = Vector2d::Zero();
  for (const Vector2d& uv : points) {
    const Vector3d point = PointOn(face, uv) + kLift * cell.normal;
    const BeforeAfter sun = VisibleSun(place_, point, cell.normal, cells_.size());
    cell.albedo += FaceReflectance(face, uv, box.sizes().maxCoeff() / kPointsAcross);
    cell.sun.before += sun.before / static_cast<double>(points.size());
    cell.sun.after += sun.after / static_cast<double>(points.size());
    middle += uv;
  }
  cell.albedo /= static_cast<double>(points.size());
  cell.point = PointOn(face, middle / static_cast<double>(points.size())) + kLift * cell.normal;
  return cell;
}

int BouncedLight::CellAt(const Spot& spot) const {
  if (spot.normal.dot(spot.face->normal) < 0) return kDark;
  const Tree& tree = trees_.at(spot.face);
  const Vector2d uv = spot.face->Local(spot.point);
  AlignedBox2d box = tree.box;
  int node = tree.root;
  while (quads_[node].cell < 0) {
    const int quarter = QuarterAt(box, uv, options_.keep_cells_wide);
    box = QuarterOf(box, quarter, options_.keep_cells_wide);
    node = quads_[node].quarters + quarter;
  }
  return quads_[node].cell;
}

BouncedLight::Meeting BouncedLight::Meet(const Ray& ray) const {
  const Sighting seen = LookForLight(place_, ray);
  Meeting meeting;
  if (ray.direction.dot(place_.site->zenith) > 0) meeting.before = kSky;
  if (seen.before) meeting.before = CellAt(*seen.before);
  const bool on_building = seen.after && seen.after->on_building;
  meeting.after = on_building ? CellAt(*seen.after) : meeting.before;
  return meeting;
}

Incoming BouncedLight::Sum(const std::vector<Meeting>& meetings) const {
  Incoming light;
  light.before = light.after = Spectrum::Zero();
  for (const Meeting& meeting : meetings) {
    light.sky.before += meeting.before == kSky;
    light.sky.after += meeting.after == kSky;
    if (meeting.before >= 0) light.before += cells_[meeting.before].before;
    if (meeting.after >= 0) light.after += cells_[meeting.after].after;
  }
  const auto count = static_cast<double>(meetings.size());
  light.sky = {light.sky.before / count, light.sky.after / count};
  light.before /= count;
  light.after /= count;
  return light;
}

// One bounce more for every cell; the largest change of a radiance.
double BouncedLight::Sweep(const std::vector<std::vector<Meeting>>& meetings) {
  const Daylight& daylight = place_.daylight;
  std::vector<std::pair<Spectrum, Spectrum>> next(cells_.size());
  tbb::parallel_for(size_t{0}, cells_.size(), [&](size_t i) {
    const Cell& cell = cells_[i];
    const Incoming light = Sum(meetings[i]);
    const double cosine = std::max(0.0, cell.normal.dot(place_.site->sun)) / std::numbers::pi;
    next[i].first = cell.albedo * (cosine * cell.sun.before * daylight.sun_irradiance +
                                   light.sky.before * daylight.sky_radiance + light.before);
    next[i].second = cell.albedo * (cosine * cell.sun.after * daylight.sun_irradiance +
                                    light.sky.after * daylight.sky_radiance + light.after);
  });
  double largest = 0;
  for (size_t i = 0; i < cells_.size(); ++i) {
    largest = std::max({largest, (next[i].first - cells_[i].before).abs().maxCoeff(),
                        (next[i].second - cells_[i].after).abs().maxCoeff()});
    cells_[i].before = next[i].first;
    cells_[i].after = next[i].second;
  }
  return largest;
}

void BouncedLight::Solve() {
  constexpr double kSettled = 1e-4;  // of the sky's radiance
  constexpr int kMostSweeps = 50;
  std::vector<std::vector<Meeting>> meetings(cells_.size());
  tbb::parallel_for(size_t{0}, cells_.size(), [&](size_t i) {
    for (const Vector3d& out : CosineDirections(cells_[i].normal, options_.strata, i)) {
      meetings[i].push_back(Meet({cells_[i].point, out}));
    }
  });
  const double settled = kSettled * place_.daylight.sky_radiance.maxCoeff();
  for (int sweep = 0; sweep < kMostSweeps && Sweep(meetings) > settled; ++sweep) {
  }
}

Incoming BouncedLight::Gather(const Vector3d& point, const Vector3d& normal, int strata,
                              uint64_t seed) const {
  std::vector<Meeting> meetings;
  meetings.reserve(static_cast<size_t>(strata) * strata);
  for (const Vector3d& out : CosineDirections(normal, strata, seed)) {
    meetings.push_back(Meet({point, out}));
  }
  return Sum(meetings);
}

}  // namespace insitu::demo
