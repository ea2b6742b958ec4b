// SPDX-License-Identifier: GPL-3.0-or-later
#include "radiometry/transport/interreflection.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "calibration/files/error.h"
#include "radiometry/transport/cosine_directions.h"
#include "radiometry/transport/make_patches.h"

namespace insitu {
namespace {

constexpr double kPi = std::numbers::pi;
// The building's faces win over polygons that survey noise leaves just before them.
constexpr double kCoincidence = 0.01;  // [m]
constexpr double kSettled = 1e-3;      // relative change of light that is none
constexpr int kMostSweeps = 64;
constexpr double kMostAlbedo =
    0.97;  // of a piece: more is an error of the photograph or of the light

Eigen::AlignedBox3d BoxOf(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex : mesh.vertices) box.extend(vertex.cast<double>());
  // Embree's robust mode may report hits this far outside.
  if (box.isEmpty()) return box;
  return {box.min() - Eigen::Vector3d::Constant(1e-3), box.max() + Eigen::Vector3d::Constant(1e-3)};
}

bool MayMeet(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& origin,
             const Eigen::Vector3d& direction) {
  if (box.isEmpty()) return false;
  const Eigen::Array3d inverse = direction.array().inverse();
  const Eigen::Array3d a = (box.min() - origin).array() * inverse;
  const Eigen::Array3d b = (box.max() - origin).array() * inverse;
  const double far = a.max(b).minCoeff();
  return far >= 0 && a.min(b).maxCoeff() <= far;
}

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
    const int index = is_natural ? patches.AddOfPolygon(face, is_back, point.position)
                                 : patches.AddPlanned(point.normal, point.position);
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

Interreflection::Interreflection(const TransportScene& scene, const Daylight& light,
                                 const PatchGrid& grid, const InterreflectionOptions& options)
    : scene_(scene),
      options_(options),
      patch_directions_(options.patch_directions),
      point_directions_(options.point_directions),
      planned_box_(BoxOf(scene.planned.mesh)),
      clear_box_(scene.planned.clear ? BoxOf(scene.planned.clear->mesh) : Eigen::AlignedBox3d()),
      zenith_(light.zenith_direction),
      sky_pieces_(light.Sky(), light.sky_shape.IsUniform(), light.zenith_direction),
      ground_(GroundOf(scene.site.scene, grid)),
      patches_(grid) {
  options_.Check();
  patches_ = MakePatches(scene.site, scene.natural, scene.planned, ground_, light, patches_.grid());
  GatherMeetings();
}

Interreflection::Interreflection(const TransportScene& scene, const Daylight& light,
                                 const PatchGrid& grid, const SolvedLight& solved,
                                 const InterreflectionOptions& options)
    : scene_(scene),
      options_(options),
      patch_directions_(options.patch_directions),
      point_directions_(options.point_directions),
      planned_box_(BoxOf(scene.planned.mesh)),
      clear_box_(scene.planned.clear ? BoxOf(scene.planned.clear->mesh) : Eigen::AlignedBox3d()),
      zenith_(light.zenith_direction),
      sky_pieces_(light.Sky(), light.sky_shape.IsUniform(), light.zenith_direction),
      ground_(GroundOf(scene.site.scene, grid)),
      patches_(PatchesOf(scene.site.scene, solved, grid)),
      sky_(solved.sky),
      beyond_(solved.beyond),
      brdf_of_polygon_(solved.brdf_of_polygon) {
  options_.Check();
  for (const SolvedPiece& piece : solved.pieces) {
    before_.push_back(piece.before);
    change_.push_back(piece.change);
    irradiance_.push_back(piece.irradiance);
  }
}

SolvedLight Interreflection::Solution() const {
  SolvedLight solved{sky_, beyond_, brdf_of_polygon_, {}};
  for (size_t i = 0; i < before_.size(); ++i) {
    const Patch& patch = patches_.all()[i];
    solved.pieces.push_back({patch.point, patch.polygon, patch.is_beyond, patch.is_seen, before_[i],
                             change_[i], irradiance_[i]});
  }
  return solved;
}

void Interreflection::MeetSite(const Ray& ray, const std::optional<RayHit>& hit,
                               Meeting* meeting) const {
  meeting->before = kBeyond;
  if (hit) {
    const int polygon = scene_.site.polygon_of_triangle[hit->triangle];
    meeting->is_back = scene_.site.scene.polygons[polygon].normal.dot(ray.direction) > 0;
    meeting->distance = hit->distance;
    meeting->before =
        patches_.OfPolygon(polygon, meeting->is_back, ray.origin + hit->distance * ray.direction);
  } else if (ray.direction.dot(zenith_) > 0) {
    meeting->before = kSky - sky_pieces_.Of(ray.direction);
  } else if (ground_) {
    meeting->before = GroundBeyond(ray);
  }
  meeting->after = meeting->before;
}

void Interreflection::MeetPlanned(const Ray& ray, const RayHit& hit, Meeting* meeting) const {
  const Eigen::Vector3d& normal = scene_.planned.normals[hit.triangle];
  meeting->is_back = normal.dot(ray.direction) > 0;
  meeting->distance = hit.distance;
  meeting->material = scene_.planned.material_of_triangle[hit.triangle];
  meeting->after = patches_.OfPlanned(meeting->is_back ? Eigen::Vector3d(-normal) : normal,
                                      ray.origin + hit.distance * ray.direction);
}

std::vector<Interreflection::Meeting> Interreflection::Meet(
    const SurfacePoint& surface, const CosineDirections& directions) const {
  const Eigen::Vector3d origin = surface.position + kSurveyClearance * surface.normal;
  const std::vector<Eigen::Vector3d> all = directions.About(surface.normal);
  std::vector<Meeting> meetings(all.size());
  std::array<double, kPacketSize> far;
  for (size_t first = 0; first < all.size(); first += kPacketSize) {
    const size_t size = std::min<size_t>(kPacketSize, all.size() - first);
    const std::span<const Eigen::Vector3d> packet(&all[first], size);
    far.fill(std::numeric_limits<double>::infinity());
    const auto on_site = scene_.site.rays.NearestOfPacket(origin, packet, {far.data(), size});
    bool may_meet = false;
    for (size_t i = 0; i < size; ++i) {
      MeetSite({origin, packet[i]}, on_site[i], &meetings[first + i]);
      if (on_site[i]) far[i] = on_site[i]->distance + kCoincidence;
      may_meet = may_meet || MayMeet(planned_box_, origin, packet[i]);
    }
    if (may_meet) {
      const auto on_planned =
          scene_.planned.rays.NearestOfPacket(origin, packet, {far.data(), size});
      for (size_t i = 0; i < size; ++i) {
        if (on_planned[i]) MeetPlanned({origin, packet[i]}, *on_planned[i], &meetings[first + i]);
      }
    }
    for (size_t i = 0; i < size; ++i) {
      if (MayMeet(clear_box_, origin, packet[i])) {
        MeetGlass({origin, packet[i]}, &meetings[first + i]);
      }
    }
  }
  return meetings;
}

// A ray that goes through more panes than are counted loses nothing in the others; kinds of glass
// beyond the fifteenth count as the fifteenth.
void Interreflection::MeetGlass(const Ray& ray, Meeting* meeting) const {
  constexpr int kBits = 4, kMostPanes = 16 / kBits, kMostKinds = (1 << kBits) - 1;
  const ClearFaces& clear = *scene_.planned.clear;
  Ray rest = ray;
  if (meeting->distance > 0) rest.far = meeting->distance;
  for (int i = 0; i < kMostPanes; ++i) {
    const auto hit = clear.rays.Nearest(rest);
    if (!hit) return;
    const int kind = std::min(clear.kind_of_triangle[hit->triangle], kMostKinds - 1);
    meeting->panes = static_cast<uint16_t>(meeting->panes << kBits | (kind + 1));
    rest.near = hit->distance + kSurveyClearance;
  }
}

Spectrum Interreflection::Through(const Meeting& meeting) const {
  Spectrum share = Spectrum::Ones();
  for (unsigned panes = meeting.panes; panes != 0; panes >>= 4) {
    share *= scene_.planned.clear->mean_transmittance[(panes & 15) - 1];
  }
  return share;
}

int Interreflection::GroundBeyond(const Ray& ray) const {
  const auto place = ground_->Meet(scene_.site.scene, ray);
  const int face = static_cast<int>(scene_.site.scene.polygons.size());
  return place ? patches_.OfPolygon(face, false, *place) : kBeyond;
}

void Interreflection::GatherMeetings() {
  const std::vector<Patch>& all = patches_.all();
  meetings_.resize(all.size());
  tbb::parallel_for(size_t{0}, all.size(),
                    [&](size_t i) { meetings_[i] = Meet(all[i].point, patch_directions_); });
  SumSeen();
}

Spectrum Interreflection::RadianceBefore(int patch) const {
  if (IsSky(patch)) return sky_ * sky_pieces_.At(kSky - patch);
  if (patch == kDark) return Spectrum::Zero();
  return patch == kBeyond ? beyond_ : before_[patch];
}

Spectrum Interreflection::RadianceAfter(const Meeting& meeting) const {
  Spectrum radiance;
  if (meeting.material >= 0 && meeting.after >= 0) {
    radiance = scene_.planned.brdf_of_material[meeting.material] * irradiance_[meeting.after];
  } else if (meeting.after < 0) {
    radiance = RadianceBefore(meeting.after);
  } else {
    radiance = before_[meeting.after] + change_[meeting.after];
  }
  if (meeting.panes != 0) radiance *= Through(meeting);
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
  const size_t n = patches_.all().size();
  before_.assign(n, Spectrum::Zero());
  brdf_.assign(n, Spectrum::Zero());
  change_.assign(n, Spectrum::Zero());
  irradiance_.assign(n, Spectrum::Zero());
  brdf_of_polygon_.assign(scene_.site.scene.polygons.size(), Spectrum::Zero());
  if (n == 0) return;
  SolveBefore(light);
  if (!planned_box_.isEmpty() || !clear_box_.isEmpty() || scene_.lamps) SolveAfter(light);
}

// From all pieces that a photograph shows, by material; where it shows none of it, of the site.
void Interreflection::SetBrdfs(const std::vector<Spectrum>& irradiance) {
  std::map<std::string, MeanBrdfSum> of_material;
  MeanBrdfSum of_site;
  for (size_t i = 0; i < irradiance.size(); ++i) {
    const Patch& patch = patches_.all()[i];
    if (!patch.is_seen) continue;
    brdf_[i] = MeanBrdfSum{patch.photographed, irradiance[i]}.Value();
    if (patch.is_beyond) continue;  // a photograph may show anything there
    const MeanBrdfSum one = {patch.area * patch.photographed, patch.area * irradiance[i]};
    of_material[scene_.site.scene.polygons[patch.polygon].material].Add(one);
    of_site.Add(one);
  }
  for (size_t p = 0; p < brdf_of_polygon_.size(); ++p) {
    const MeanBrdfSum& sum = of_material[scene_.site.scene.polygons[p].material];
    brdf_of_polygon_[p] = (sum.IsEmpty() ? of_site : sum).Value();
  }
}

// Where no ground goes on, what is below the horizon is as bright as all that is seen.
void Interreflection::SetBeyond() {
  beyond_.setZero();
  double area = 0;
  for (size_t i = 0; i < before_.size(); ++i) {
    const Patch& patch = patches_.all()[i];
    if (!patch.is_seen) continue;
    beyond_ += patch.area * before_[i];
    area += patch.area;
  }
  if (area > 0) beyond_ /= area;
}

// What does not change from sweep to sweep is summed once, whatever the daylight.
void Interreflection::SumSeen() {
  const size_t n = patches_.all().size();
  seen_.assign(n, SeenFromPiece());
  tbb::parallel_for(size_t{0}, n, [&](size_t i) {
    if (patches_.all()[i].polygon < 0) return;
    SeenFromPiece& seen = seen_[i];
    for (const Meeting& meeting : meetings_[i]) {
      if (IsSky(meeting.before)) {
        seen.sky += sky_pieces_.At(kSky - meeting.before);
      } else if (meeting.before == kBeyond) {
        ++seen.beyond;
      } else if (meeting.before != kDark && IsUnseen(meeting.before)) {
        seen.unseen.push_back(meeting.before);
      } else if (meeting.before != kDark) {
        seen.photographed += patches_.all()[meeting.before].photographed;
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
  const std::vector<Patch>& all = patches_.all();
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
  const std::vector<Patch>& all = patches_.all();
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
  const std::vector<Patch>& all = patches_.all();
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

GatheredLight Interreflection::At(const SurfacePoint& surface) const {
  GatheredLight light;
  int skies = 0, unseen = 0, backs = 0;
  Spectrum relative_sky = Spectrum::Zero();
  for (const Meeting& meeting : Meet(surface, point_directions_)) {
    if (meeting.distance > 0) light.nearness += 1 / meeting.distance;
    backs += meeting.is_back;
    unseen += IsUnseen(meeting.before);
    if (IsSky(meeting.before)) {
      ++skies;
      relative_sky += sky_pieces_.At(kSky - meeting.before);
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

bool Interreflection::IsUnseen(int patch) const {
  if (IsDirect()) return false;
  if (patch >= 0) return !patches_.all()[patch].is_seen;
  return patch == kBeyond;
}

}  // namespace insitu
