// SPDX-License-Identifier: GPL-3.0-or-later
// Solid textures: surfaces whose normals a stochastic field in space turns. [Durisch92, §7, after
// Haruyama & Barsky 1984; Blinn 1978; Perlin 1985]
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "radiometry/library/material_keys.h"

namespace insitu {

struct Bumps {
  double rms_slope = 0;  // of both directions together, as Roughness has it; above 0, at most 1
  double longest = 0, shortest = 0;  // wavelengths [m], longest >= shortest > 0
  double spectrum = 0;  // p: an octave's share of the slopes' variance goes as its wavelength^p
  // Where level waves run to, in the world; nullopt: alike in all directions of space.
  std::optional<Eigen::Vector3d> direction = {};
  double spread = 0;  // of the waves' directions about it, one sigma [rad]

  bool operator==(const Bumps&) const = default;
};

// Of an entry of materials.json: "bumps" with rms_slope, scale_m, shortest_m, spectrum, direction,
// spread_deg. nullopt: it has none. Throws InputError.
std::optional<Bumps> ReadBumps(const MaterialKeys& material);

// The same in the environment descriptions.
Json::Value BumpsJson(const Bumps& bumps);
Bumps BumpsOf(const JsonNode& node);

// A sum of sinusoids, a function of the place alone and so the same in every photograph.
class BumpField {
 public:
  // `name` chooses one of the fields of these statistics. Waves with a direction are level at this
  // zenith. Places are later given relative to `origin` [m], world.
  BumpField(const Bumps& bumps, const std::string& name, const Eigen::Vector3d& zenith,
            const Eigen::Vector3d& origin);

  struct Turned {
    Eigen::Vector3d normal;  // unit
    double variance = 0;     // of the slopes that are too fine to be seen singly
  };
  // What is seen of a surface (`normal` unit) by a ray that stands for a Gaussian about `position`
  // [m]. Columns of `spread`: its standard deviations along two directions, [m]; zero: a point.
  Turned At(const Eigen::Vector3d& position, const Eigen::Vector3d& normal,
            const Eigen::Matrix<double, 3, 2>& spread) const;

 private:
  struct Wave {
    Eigen::Vector3d vector;  // [rad/m]
    Eigen::Vector3d slope;   // amplitude of the gradient, along the vector
    double phase;
  };
  std::vector<Wave> waves_;
};

}  // namespace insitu
