// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/light/rough_glass.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "calibration/files/error.h"
#include "radiometry/light/split_mix.h"

namespace insitu {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

constexpr int kShareCosines = 40;  // of a table
constexpr int kShareSide = 32;     // facets of an entry, squared
constexpr double kLeastShareCosine = 1e-3;
constexpr int kMostFaces = 32;  // that light inside a pane meets
constexpr int kSheetPaths = 512;

// Cosines are squared so that there are more of them at grazing sight.
double TableCosine(int j) {
  const double share = static_cast<double>(j) / (kShareCosines - 1);
  return std::max(kLeastShareCosine, share * share);
}

// Between two entries: `blend(weight, entry)` for each.
template <typename Blend>
void InTable(double cosine, const Blend& blend) {
  const double v = std::sqrt(std::clamp(cosine, 0.0, 1.0)) * (kShareCosines - 1);
  const int j = std::min(static_cast<int>(v), kShareCosines - 2);
  blend(1 - (v - j), j);
  blend(v - j, j + 1);
}

Vector3d ViewAt(double cosine) { return {std::sqrt(1 - cosine * cosine), 0, cosine}; }

Vector2d FacetNumber(int i, int side) {
  const int column = i % side, row = i / side;
  return {(column + 0.5) / side, (row + 0.5) / side};
}

// What single scattering leaves of a facet's light on both its ways.
struct SeenShares {
  double mirrored = 0, through = 0;
};
SeenShares SharesOf(const Roughness& roughness, double F, const GlassFacet& facet) {
  return {F * SmithMasking(roughness, facet.mirrored.z()),
          F < 1 ? (1 - F) * SmithMasking(roughness, -facet.refracted.z()) : 0};
}

// `m`: a facet's normal that the viewer sees; its directions, and F.
double SetDirections(const Vector3d& m, double index, const Vector3d& to_viewer,
                     GlassFacet* facet) {
  const double cosine = std::clamp(m.dot(to_viewer), 0.0, 1.0);
  const double F = FresnelReflectance(cosine, index);
  facet->mirrored = (2 * cosine * m - to_viewer).normalized();
  if (F >= 1) return F;
  const double inner = RefractedCosine(cosine, index);
  facet->refracted = (-to_viewer / index + (cosine / index - inner) * m).normalized();
  return F;
}

Vector3d Turned(const Vector3d& direction) {
  return {direction.x(), direction.y(), -direction.z()};
}

// At the face that a way inside meets, in its own frame: z is where the viewer is, inside.
Vector3d ToViewer(bool is_front, const Vector3d& direction) {
  return is_front ? Turned(-direction) : Vector3d(-direction);
}

}  // namespace

RoughInterface::RoughInterface(const Roughness& roughness, double index)
    : roughness_(roughness), index_(index) {
  INSITU_CHECK(roughness.slope > 0 && index > 0);
  for (int j = 0; j < kShareCosines; ++j) {
    const Vector3d view = ViewAt(TableCosine(j));
    double through = 0, shut = 0;
    for (int i = 0; i < kShareSide * kShareSide; ++i) {
      const GlassFacet facet = Choose(view, FacetNumber(i, kShareSide));
      through += facet.lets_through;
      shut += facet.is_shut;
    }
    through_.push_back(through / (kShareSide * kShareSide));
    shut_.push_back(shut / (kShareSide * kShareSide));
  }
}

double RoughInterface::Transmittance(double cosine) const {
  double through = 0;
  InTable(cosine, [&](double weight, int j) { through += weight * through_[j]; });
  return through;
}

GlassFacet RoughInterface::Choose(const Vector3d& to_viewer, const Vector2d& uniform) const {
  GlassFacet facet;
  const Vector3d m = VisibleFacet(roughness_, to_viewer, uniform);
  const double F = SetDirections(m, index_, to_viewer, &facet);
  const SeenShares shares = SharesOf(roughness_, F, facet);
  const double all = shares.mirrored + shares.through;
  if (all > 0) {
    facet.mirrors = shares.mirrored / all;
    facet.lets_through = shares.through / all;
    return facet;
  }
  PathNumbers numbers{std::bit_cast<uint64_t>(uniform.x()) +
                      3 * std::bit_cast<uint64_t>(uniform.y())};
  const double radius = std::sqrt(numbers.Next()), angle = 2 * std::numbers::pi * numbers.Next();
  facet.mirrored = {radius * std::cos(angle), radius * std::sin(angle),
                    std::sqrt(1 - radius * radius)};
  facet.mirrors = 1;
  facet.is_shut = true;
  return facet;
}

double RoughInterface::Lobe(const Vector3d& to_viewer, const Vector3d& to_light) const {
  if (to_viewer.z() <= 0 || to_light.z() == 0) return 0;
  double shut = 0;
  InTable(to_viewer.z(), [&](double weight, int j) { shut += weight * shut_[j]; });
  return LobeOfFacets(to_viewer, to_light) + shut * std::max(0.0, to_light.z()) / std::numbers::pi;
}

double RoughInterface::LobeOfFacets(const Vector3d& to_viewer, const Vector3d& to_light) const {
  const bool is_through = to_light.z() < 0;
  Vector3d half = to_viewer + (is_through ? index_ : 1) * to_light;
  const double length = half.norm();
  if (length < 1e-12) return 0;
  half /= half.z() < 0 ? -length : length;
  const double of_viewer = to_viewer.dot(half), of_light = to_light.dot(half);
  if (of_viewer <= 0 || (of_light > 0) == is_through) return 0;
  GlassFacet facet;
  const double F = SetDirections(half, index_, to_viewer, &facet);
  const SeenShares shares = SharesOf(roughness_, F, facet);
  const double share = is_through ? shares.through : shares.mirrored;
  if (share <= 0) return 0;
  // Facets that the viewer sees, by solid angle of theirs; then by that of the light.
  const double facets = SmithMasking(roughness_, to_viewer.z()) * FacetDensity(roughness_, half) *
                        of_viewer / to_viewer.z();
  const double bend = index_ * of_light + of_viewer;
  const double per_light =
      is_through ? index_ * index_ * -of_light / (bend * bend) : 1 / (4 * of_viewer);
  return facets * per_light * share / (shares.mirrored + shares.through);
}

double PathNumbers::Next() { return static_cast<double>(SplitMix64(seed++) >> 11) * 0x1p-53; }

RoughSheet::RoughSheet(const Roughness& roughness, double index, const Spectrum& absorption,
                       double thickness)
    : outside_(roughness, index),
      inside_(roughness, 1 / index),
      optical_depth_(absorption * thickness) {
  INSITU_CHECK(index > 1 && thickness >= 0 && (absorption >= 0).all());
  for (int j = 0; j < kShareCosines; ++j) {
    const Vector3d view = ViewAt(TableCosine(j));
    SheetOptics optics{Spectrum::Zero(), Spectrum::Zero()};
    for (int i = 0; i < kSheetPaths; ++i) {
      PathNumbers numbers{static_cast<uint64_t>(kSheetPaths * j + i) << 8};
      // A lattice: the fractional parts of multiples of the golden ratio.
      const double second = std::fmod((i + 0.5) * 0.6180339887498949, 1.0);
      const GlassFacet facet = outside_.Choose(view, {(i + 0.5) / kSheetPaths, second});
      optics.reflectance += facet.mirrors;
      if (facet.lets_through > 0) AddLeaving(facet, &numbers, &optics);
    }
    optics.transmittance /= kSheetPaths;
    optics.reflectance /= kSheetPaths;
    optics_.push_back(optics);
  }
}

GlassFacet RoughSheet::ChooseInside(bool is_front, const Vector3d& to_viewer,
                                    PathNumbers* numbers) const {
  const double u = numbers->Next(), v = numbers->Next();
  GlassFacet facet = inside_.Choose(to_viewer, {u, v});
  if (!is_front) return facet;
  facet.mirrored = Turned(facet.mirrored);
  facet.refracted = Turned(facet.refracted);
  return facet;
}

// What leaves at each face, of a way that goes on inside.
void RoughSheet::AddLeaving(const GlassFacet& entry, PathNumbers* numbers,
                            SheetOptics* optics) const {
  Vector3d direction = entry.refracted;
  Spectrum share = Spectrum::Constant(entry.lets_through);
  for (int face = 0; face < kMostFaces && (share > 0).any(); ++face) {
    const bool is_front = direction.z() > 0;
    share *= Passed(direction);
    const GlassFacet facet = ChooseInside(is_front, ToViewer(is_front, direction), numbers);
    const double leaves = face + 1 == kMostFaces ? 1 : facet.lets_through;
    (is_front ? optics->reflectance : optics->transmittance) += share * leaves;
    share *= facet.mirrors;
    direction = facet.mirrored;
  }
}

Spectrum RoughSheet::Passed(const Vector3d& direction) const {
  return (-optical_depth_ / std::max(1e-6, std::abs(direction.z()))).exp();
}

RoughSheet::Origin RoughSheet::Follow(const Vector3d& refracted, PathNumbers* numbers,
                                      const std::function<void(const Arrival&)>& arrives) const {
  Origin origin{refracted};
  Spectrum share = Spectrum::Ones();
  for (int face = 0; face < kMostFaces; ++face) {
    const bool is_front = origin.direction.z() > 0;
    share *= Passed(origin.direction);
    const Vector3d to_viewer = ToViewer(is_front, origin.direction);
    if (arrives) arrives({is_front, to_viewer, share});
    const GlassFacet facet = ChooseInside(is_front, to_viewer, numbers);
    const bool leaves = numbers->Next() < facet.lets_through;
    origin.direction = leaves ? facet.refracted : facet.mirrored;
    if (!leaves) continue;
    origin.share = share;
    return origin;
  }
  // Trapped by total reflection, which ends somewhere: what is left leaves as it is.
  origin.share = share;
  return origin;
}

SheetOptics RoughSheet::Optics(double cosine) const {
  SheetOptics optics{Spectrum::Zero(), Spectrum::Zero()};
  InTable(cosine, [&](double weight, int j) {
    optics.transmittance += weight * optics_[j].transmittance;
    optics.reflectance += weight * optics_[j].reflectance;
  });
  return optics;
}

}  // namespace insitu
