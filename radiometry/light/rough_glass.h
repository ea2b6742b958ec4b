// SPDX-License-Identifier: GPL-3.0-or-later
// Rough glass: small facets that mirror and refract, of one interface and of a pane that has two.
// Directions are unit, in a frame whose z axis is the mean normal on the viewer's side, and point
// away from the surface. Radiances are over the square of the index where they are, so that between
// two places in air it does not matter.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "radiometry/light/fresnel.h"
#include "radiometry/light/microfacet.h"

namespace insitu {

// What a facet that the viewer sees shows him.
struct GlassFacet {
  Eigen::Vector3d mirrored, refracted;  // to where the light comes from
  // Their shares, which add up to 1; 0 where the direction ends on the wrong side or light is
  // totally reflected.
  double mirrors = 0, lets_through = 0;
  bool is_shut = false;  // neither way is open, and light comes back as from a matte face
};

// F and 1 - F of each facet, both masked by others [Walter et al. 2007, Eqs. 20, 21; Smith]. What
// others keep from going one way goes the other, or the same: a facet's two shares are enlarged
// until they add up to 1, so that no light is lost. That and the masking of the viewer's side are
// all that it takes; it is not reciprocal where much is masked.
class RoughInterface {
 public:
  // `index` of what lies behind it, relative to the viewer's side, > 0. roughness.slope > 0.
  RoughInterface(const Roughness& roughness, double index);

  GlassFacet Choose(const Eigen::Vector3d& to_viewer, const Eigen::Vector2d& uniform) const;

  // Radiance towards the viewer per radiance and solid angle, cosine included, that is mirrored
  // (to_light.z > 0) or let through (< 0) [1/sr].
  double Lobe(const Eigen::Vector3d& to_viewer, const Eigen::Vector3d& to_light) const;

  // Share of what a viewer at this cosine sees that comes through, 0..1.
  double Transmittance(double cosine) const;

 private:
  double LobeOfFacets(const Eigen::Vector3d& to_viewer, const Eigen::Vector3d& to_light) const;

  Roughness roughness_;
  double index_;
  std::vector<double> through_, shut_;  // by the root of the cosine
};

// Numbers in [0, 1) that follow from a seed.
struct PathNumbers {
  uint64_t seed = 0;
  double Next();
};

// A pane in air, both of whose faces are rough alike: light is refracted or mirrored at one facet
// after the other until it leaves, and absorbed on its ways between them. [Guo et al. 2018]
class RoughSheet {
 public:
  // `absorption` [1/m] >= 0, `thickness` [m] >= 0, `index` > 1.
  RoughSheet(const Roughness& roughness, double index, const Spectrum& absorption,
             double thickness);

  const RoughInterface& from_outside() const { return outside_; }
  const RoughInterface& from_inside() const { return inside_; }

  // Light inside that reaches the face on the viewer's side (is_front) or the other one: `share` of
  // it reaches the viewer if it comes from where `to_viewer`, in the frame of that face seen from
  // inside, asks `from_inside` for.
  struct Arrival {
    bool is_front = false;
    Eigen::Vector3d to_viewer;
    Spectrum share;
  };
  // Where light comes from that leaves the pane, and its share; 0: it stays inside.
  struct Origin {
    Eigen::Vector3d direction;
    Spectrum share = Spectrum::Zero();
  };
  // Follows back what is seen inside along `refracted`, told of each face that is met.
  Origin Follow(const Eigen::Vector3d& refracted, PathNumbers* numbers,
                const std::function<void(const Arrival&)>& arrives = {}) const;

  // All light that a viewer at this cosine sees come through, and mirrored; good to 0.01.
  SheetOptics Optics(double cosine) const;

 private:
  // Of the face that is met inside, in the pane's frame.
  GlassFacet ChooseInside(bool is_front, const Eigen::Vector3d& to_viewer,
                          PathNumbers* numbers) const;
  void AddLeaving(const GlassFacet& entry, PathNumbers* numbers, SheetOptics* optics) const;
  Spectrum Passed(const Eigen::Vector3d& direction) const;  // from one face to the other

  RoughInterface outside_, inside_;
  Spectrum optical_depth_;           // straight through
  std::vector<SheetOptics> optics_;  // by the root of the cosine
};

}  // namespace insitu
