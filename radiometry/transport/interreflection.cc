// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/transport/interreflection.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "calibration/files/error.h"
#include "radiometry/transport/cosine_directions.h"
#include "radiometry/transport/make_patches.h"

namespace insitu {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSettled = 1e-3;  // relative change of light that is none
constexpr int kMostSweeps = 64;
// Of a piece: more is an error of the photograph or of the light.
constexpr double kMostAlbedo = 0.97;

// Total light and what it falls on, for a mean reflection.
struct MeanBrdfSum {
  Spectrum radiance = Spectrum::Zero(), irradiance = Spectrum::Zero();

  void Add(const MeanBrdfSum& other) {
    radiance += other.radiance;
    irradiance += other.irradiance;
  }
  bool IsEmpty() const { return (irradiance == 0).all(); }
  Spectrum Value() const {
    return (irradiance > 0).select(radiance / irradiance.max(1e-300), 0.0).min(kMostAlbedo / kPi);
  }
};

// Materials by number: the first polygon's is 0.
std::vector<int> MaterialOfPolygons(const SceneGeometry& scene) {
  std::map<std::string, int> numbers;
  std::vector<int> of_polygon;
  for (const Polygon& polygon : scene.polygons) {
    const int next = static_cast<int>(numbers.size());
    of_polygon.push_back(numbers.try_emplace(polygon.material, next).first->second);
  }
  return of_polygon;
}

double LargestShare(const Spectrum& change, const Spectrum& of) {
  return change.abs().maxCoeff() / std::max(of.maxCoeff(), 1e-300);
}

// In the same order: a piece's point lies in its own voxel.
Patches PatchesOf(const SceneGeometry& scene, const SolvedLight& solved, const PatchGrid& grid) {
  const int beyond = static_cast<int>(scene.polygons.size());
  Patches patches(grid);
  for (const SolvedPiece& piece : solved.pieces) {
    const SurfacePoint& point = piece.point;
    const bool is_natural = piece.polygon >= 0;
    const bool is_back =
        is_natural && scene.polygons.at(piece.polygon).normal.dot(point.normal) < 0;
    const int face = piece.is_beyond ? beyond : piece.polygon;
    const GridPlace place = grid.At(point.position);
    const int index = is_natural ? patches.AddOfPolygon(face, is_back, place)
                                 : patches.AddPlanned(point.normal, place);
    INSITU_CHECK(index + 1 == std::ssize(patches.all()));
    Patch& patch = patches.all()[index];
    patch.point = point;
    patch.polygon = piece.polygon;
    patch.is_beyond = piece.is_beyond;
    patch.is_seen = piece.is_seen;
  }
  return patches;
}

}  // namespace

void InterreflectionOptions::Check() const {
  INSITU_CHECK(!bounces || *bounces >= 0);
  INSITU_CHECK(patch_directions >= 16);
  INSITU_CHECK(point_directions >= 16);
}

void GatheredParts::Add(double weight, const GatheredParts& parts) {
  sky += weight * parts.sky;
  surroundings += weight * parts.surroundings;
  sky_blocked += weight * parts.sky_blocked;
  surroundings_blocked += weight * parts.surroundings_blocked;
  bounced += weight * parts.bounced;
}

Interreflection::Interreflection(const TransportScene& scene, const Daylight& light,
                                 Patches patches, const InterreflectionOptions& options)
    : scene_(scene),
      options_(options),
      patch_directions_(options.patch_directions),
      point_directions_(options.point_directions),
      surroundings_(scene, light, std::move(patches)) {
  options_.Check();
}

Interreflection::Interreflection(const TransportScene& scene, const Daylight& light,
                                 const PatchGrid& grid, const InterreflectionOptions& options)
    : Interreflection(scene, light,
                      MakePatches(scene.site, scene.natural, scene.planned,
                                  GroundOf(scene.site.scene, grid), light, grid),
                      options) {
  GatherMeetings();
}

Interreflection::Interreflection(const TransportScene& scene, const Daylight& light,
                                 const PatchGrid& grid, const SolvedLight& solved,
                                 const InterreflectionOptions& options)
    : Interreflection(scene, light, PatchesOf(scene.site.scene, solved, grid), options) {
  sky_ = solved.sky;
  beyond_ = solved.beyond;
  brdf_of_polygon_ = solved.brdf_of_polygon;
  for (const SolvedPiece& piece : solved.pieces) {
    before_.push_back(piece.before);
    change_.push_back(piece.change);
    irradiance_.push_back(piece.irradiance);
  }
}

SolvedLight Interreflection::Solution() const {
  SolvedLight solved{sky_, beyond_, brdf_of_polygon_, {}};
  for (size_t i = 0; i < before_.size(); ++i) {
    const Patch& patch = Pieces()[i];
    solved.pieces.push_back({patch.point, patch.polygon, patch.is_beyond, patch.is_seen, before_[i],
                             change_[i], irradiance_[i]});
  }
  return solved;
}

void Interreflection::GatherMeetings() {
  const std::vector<Patch>& all = Pieces();
  meetings_.resize(all.size());
  tbb::parallel_for(size_t{0}, all.size(), [&](size_t i) {
    meetings_[i] = surroundings_.Meet(all[i].point, patch_directions_);
  });
  SumSeen();
}

Spectrum Interreflection::RadianceBefore(int patch) const {
  if (Meeting::IsSky(patch)) return sky_ * surroundings_.RelativeSky(patch);
  if (patch == Meeting::kDark) return Spectrum::Zero();
  return patch == Meeting::kBeyond ? beyond_ : before_[patch];
}

Spectrum Interreflection::RadianceAfter(const Meeting& meeting) const {
  Spectrum radiance;
  if (meeting.material >= 0 && meeting.after >= 0) {
    radiance = scene_.planned.brdf_of_material[meeting.material] * irradiance_[meeting.after];
    if (meeting.behind >= 0) {
      radiance += (*scene_.planned.translucence_of_material)[meeting.material] *
                  irradiance_[meeting.behind];
    }
  } else if (meeting.after < 0) {
    radiance = RadianceBefore(meeting.after);
  } else {
    radiance = before_[meeting.after] + change_[meeting.after];
  }
  if (meeting.panes != 0) radiance *= surroundings_.Through(meeting);
  return radiance;
}

Spectrum Interreflection::ChangeAlong(const Meeting& meeting) const {
  if (meeting.material >= 0 || meeting.panes != 0) {
    return RadianceAfter(meeting) - RadianceBefore(meeting.before);
  }
  return meeting.after < 0 ? Spectrum::Zero().eval() : change_[meeting.after];
}

void Interreflection::Solve(const Daylight& light) {
  sky_ = light.sky_radiance;
  beyond_.setZero();
  const size_t n = Pieces().size();
  before_.assign(n, Spectrum::Zero());
  brdf_.assign(n, Spectrum::Zero());
  change_.assign(n, Spectrum::Zero());
  irradiance_.assign(n, Spectrum::Zero());
  brdf_of_polygon_.assign(scene_.site.scene.polygons.size(), Spectrum::Zero());
  if (n == 0) return;
  SolveBefore(light);
  if (surroundings_.IsPlanned() || scene_.lamps) SolveAfter(light);
}

// From all pieces that a photograph shows, by material; where it shows none of it, of the site.
void Interreflection::SetBrdfs(const std::vector<Spectrum>& irradiance) {
  const std::vector<int> material_of = MaterialOfPolygons(scene_.site.scene);
  std::vector<MeanBrdfSum> of_material(material_of.size());
  MeanBrdfSum of_site;
  for (size_t i = 0; i < irradiance.size(); ++i) {
    const Patch& patch = Pieces()[i];
    if (!patch.is_seen) continue;
    brdf_[i] = MeanBrdfSum{patch.photographed, irradiance[i]}.Value();
    if (patch.is_beyond) continue;  // a photograph may show anything there
    const MeanBrdfSum one = {patch.area * patch.photographed, patch.area * irradiance[i]};
    of_material[material_of[patch.polygon]].Add(one);
    of_site.Add(one);
  }
  for (size_t p = 0; p < brdf_of_polygon_.size(); ++p) {
    const MeanBrdfSum& sum = of_material[material_of[p]];
    brdf_of_polygon_[p] = (sum.IsEmpty() ? of_site : sum).Value();
  }
}

// Where no ground goes on, what is below the horizon is as bright as all that is seen.
void Interreflection::SetBeyond() {
  beyond_.setZero();
  double area = 0;
  for (size_t i = 0; i < before_.size(); ++i) {
    const Patch& patch = Pieces()[i];
    if (!patch.is_seen) continue;
    beyond_ += patch.area * before_[i];
    area += patch.area;
  }
  if (area > 0) beyond_ /= area;
}

// What does not change from sweep to sweep is summed once, whatever the daylight.
void Interreflection::SumSeen() {
  const size_t n = Pieces().size();
  seen_.assign(n, SeenFromPiece());
  tbb::parallel_for(size_t{0}, n, [&](size_t i) {
    if (Pieces()[i].polygon < 0) return;
    SeenFromPiece& seen = seen_[i];
    for (const Meeting& meeting : meetings_[i]) {
      if (Meeting::IsSky(meeting.before)) {
        seen.sky += surroundings_.RelativeSky(meeting.before);
      } else if (meeting.before == Meeting::kBeyond) {
        ++seen.beyond;
      } else if (meeting.before != Meeting::kDark && IsUnseen(meeting.before)) {
        seen.unseen.push_back(meeting.before);
      } else if (meeting.before != Meeting::kDark) {
        seen.photographed += Pieces()[meeting.before].photographed;
      }
    }
  });
}

Spectrum Interreflection::GatheredBefore(size_t piece) const {
  const SeenFromPiece& seen = seen_[piece];
  if (IsDirect()) return kPi / options_.patch_directions * seen.sky * sky_;
  Spectrum sum = seen.photographed + seen.sky * sky_ + seen.beyond * beyond_;
  for (int other : seen.unseen) sum += before_[other];
  return kPi / options_.patch_directions * sum;
}

void Interreflection::SolveBefore(const Daylight& light) {
  const std::vector<Patch>& all = Pieces();
  for (size_t i = 0; i < all.size(); ++i) before_[i] = all[i].photographed;
  SetBeyond();
  std::vector<Spectrum> irradiance(all.size(), Spectrum::Zero());
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    tbb::parallel_for(size_t{0}, all.size(), [&](size_t i) {
      if (all[i].polygon < 0) return;
      irradiance[i] = GatheredBefore(i) + light.sun_radiance * all[i].sun_before;
    });
    SetBrdfs(irradiance);
    double largest = 0;
    for (size_t i = 0; i < all.size(); ++i) {
      if (all[i].is_seen || all[i].polygon < 0) continue;
      brdf_[i] = brdf_of_polygon_[all[i].polygon];
      const Spectrum radiance = brdf_[i] * irradiance[i];
      largest = std::max(largest, LargestShare(radiance - before_[i], sky_));
      before_[i] = radiance;
    }
    if (largest < kSettled) break;
  }
  if (!IsDirect()) return;
  for (Spectrum& radiance : before_) radiance.setZero();
  beyond_.setZero();
}

// True if the planned faces' light still changes.
bool Interreflection::SweepPlanned(const Daylight& light) {
  const std::vector<Patch>& all = Pieces();
  const double weight = kPi / options_.patch_directions;
  std::vector<Spectrum> next(all.size(), Spectrum::Zero());
  tbb::parallel_for(size_t{0}, all.size(), [&](size_t i) {
    if (all[i].polygon >= 0) return;
    Spectrum sum = Spectrum::Zero();
    for (const Meeting& meeting : meetings_[i]) sum += RadianceAfter(meeting);
    next[i] = weight * sum + light.sun_radiance * all[i].sun_after;
    if (scene_.lamps) next[i] += scene_.lamps(all[i].point);
  });
  double largest = 0;
  const Spectrum open = kPi * sky_;
  for (size_t i = 0; i < all.size(); ++i) {
    largest = std::max(largest, LargestShare(next[i] - irradiance_[i], open));
  }
  irradiance_ = std::move(next);
  return largest > kSettled;
}

void Interreflection::SweepNatural(const Daylight& light) {
  const std::vector<Patch>& all = Pieces();
  const double weight = kPi / options_.patch_directions;
  std::vector<Spectrum> next(all.size(), Spectrum::Zero());
  tbb::parallel_for(size_t{0}, all.size(), [&](size_t i) {
    if (all[i].polygon < 0) return;
    Spectrum sum = Spectrum::Zero();
    for (const Meeting& meeting : meetings_[i]) sum += ChangeAlong(meeting);
    Spectrum E = weight * sum + light.sun_radiance * (all[i].sun_after - all[i].sun_before);
    if (scene_.lamps) E += scene_.lamps(all[i].point);
    next[i] = (brdf_[i] * E).max(-before_[i]);
  });
  change_ = std::move(next);
}

void Interreflection::SolveAfter(const Daylight& light) {
  const int sweeps = std::min(options_.bounces.value_or(kMostSweeps), kMostSweeps);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const bool changes = SweepPlanned(light);
    SweepNatural(light);
    if (!changes) break;
  }
}

std::vector<Meeting> Interreflection::Meet(const SurfacePoint& surface) const {
  return surroundings_.Meet(surface, point_directions_);
}

GatheredLight Interreflection::Gathered(const std::vector<Meeting>& meetings) const {
  GatheredLight light;
  int skies = 0, unseen = 0, backs = 0;
  Spectrum relative_sky = Spectrum::Zero();
  for (const Meeting& meeting : meetings) {
    if (meeting.distance > 0) light.nearness += 1 / meeting.distance;
    backs += meeting.is_back;
    unseen += IsUnseen(meeting.before);
    if (Meeting::IsSky(meeting.before)) {
      ++skies;
      relative_sky += surroundings_.RelativeSky(meeting.before);
    } else {
      light.surroundings_before += RadianceBefore(meeting.before);
    }
    light.change += ChangeAlong(meeting);
  }
  const double count = options_.point_directions;
  light.nearness /= count;
  light.inside = backs / count;
  light.sky = kPi * skies / count;
  light.unseen = kPi * unseen / count;
  if (skies > 0) light.relative_sky = relative_sky / skies;
  light.sky_before = light.sky * light.relative_sky * sky_;
  light.surroundings_before *= kPi / count;
  light.change *= kPi / count;
  return light;
}

GatheredParts Interreflection::PartsAt(const SurfacePoint& surface) const {
  GatheredParts parts;
  const double weight = kPi / options_.point_directions;
  for (const Meeting& meeting : Meet(surface)) {
    const Spectrum before = weight * RadianceBefore(meeting.before);
    const bool is_sky_after = meeting.material < 0 && Meeting::IsSky(meeting.after);
    const Spectrum change = weight * ChangeAlong(meeting);
    (is_sky_after ? parts.sky : parts.surroundings) += before + change;
    Spectrum blocked = Spectrum::Zero();
    if (meeting.material >= 0) {
      blocked = before;
    } else if (meeting.panes != 0) {
      blocked = before * (1 - surroundings_.Through(meeting));
    }
    (Meeting::IsSky(meeting.before) ? parts.sky_blocked : parts.surroundings_blocked) += blocked;
    parts.bounced += change + blocked;
  }
  return parts;
}

bool Interreflection::IsUnseen(int patch) const {
  if (IsDirect()) return false;
  if (patch >= 0) return !Pieces()[patch].is_seen;
  return patch == Meeting::kBeyond;
}

}  // namespace insitu
