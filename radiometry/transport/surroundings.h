// SPDX-License-Identifier: GPL-3.0-or-later
// What is seen from a point in all directions: pieces of surfaces and of the sky, before and after
// a building is put there.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "radiometry/light/daylight.h"
#include "radiometry/light/photographed_color.h"
#include "radiometry/transport/cosine_directions.h"
#include "radiometry/transport/patches.h"

namespace insitu {

struct TransportScene {
  PhotographedSite site;
  const TriangleMesh& natural;  // the triangles of its polygons
  PlannedFaces planned;         // an empty mesh: nothing is planned
  // Irradiance of lamps that are planned, what stands between taken into account; may be empty.
  std::function<Spectrum(const SurfacePoint&)> lamps;
};

// What a ray from a surface meets: a piece, no object below the horizon or above it, from where the
// sky's pieces are counted down, or, where only the sky counts, something that sends nothing.
struct Meeting {
  static constexpr int kDark = -1, kBeyond = -2, kSky = -3;
  static bool IsSky(int met) { return met <= kSky; }

  int before = kDark, after = kDark;
  int material = -1;    // of the planned face met after; -1: none is met
  int behind = kDark;   // the piece on its other side, if light comes through to this one
  double distance = 0;  // after [m]; 0: none
  bool is_back = false;
  // The panes before it, a byte each: the class of the cosine at which it is met, and in the lower
  // half its kind, counted from 1.
  uint32_t panes = 0;
};

class Surroundings {
 public:
  // `scene` must outlive it.
  Surroundings(const TransportScene& scene, const Daylight& light, Patches patches);

  const Patches& patches() const { return patches_; }
  bool IsPlanned() const { return !planned_box_.isEmpty() || !clear_box_.isEmpty(); }

  // In all directions in turn. Thread-safe.
  std::vector<Meeting> Meet(const SurfacePoint& surface, const CosineDirections& directions) const;

  Spectrum Through(const Meeting& meeting) const;  // what its panes let through
  // Radiance of a piece of the sky over that of a uniform one.
  const Spectrum& RelativeSky(int met) const { return sky_pieces_.At(Meeting::kSky - met); }

 private:
  void MeetSite(const Ray& ray, const std::optional<RayHit>& hit, Meeting* meeting) const;
  void MeetPlanned(const Ray& ray, const RayHit& hit, Meeting* meeting) const;
  void MeetGlass(const Ray& ray, Meeting* meeting) const;
  int GroundBeyond(const Ray& ray) const;

  const TransportScene& scene_;
  Eigen::AlignedBox3d planned_box_, clear_box_;
  Eigen::Vector3d zenith_;
  SkyPieces sky_pieces_;
  std::optional<GroundPlane> ground_;
  Patches patches_;
};

}  // namespace insitu
