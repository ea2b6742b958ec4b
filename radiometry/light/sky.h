// SPDX-License-Identifier: GPL-3.0-or-later
// How the radiance of the sky depends on the direction.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "radiometry/spectrum/spectrum.h"

namespace insitu {

// Relative radiance exp(gradation G + glow H), per wavelength. Both zero: the uniform sky of
// [Durisch92, Eq. (5)].
struct SkyShape {
  Spectrum gradation = Spectrum::Zero();  // 1: the overcast sky; below zero: bright at the horizon
  Spectrum glow = Spectrum::Zero();       // 1: as about the sun of a clear sky

  bool IsUniform() const { return (gradation == 0).all() && (glow == 0).all(); }
};

// G = ln((1 + 2 sine) / 3) at a height above the horizon, 0 at the zenith: to the power 1 the
// overcast sky of Moon and Spencer, to -1.2 the gradation V of the CIE's clear sky to 10 %.
double SkyGradation(double sine);
// H = ln f, f the CIE's scattering indicatrix 4 (ISO 15469), at an angle from the sun; 0 at a right
// angle.
double SkyGlow(double cosine);

// A shape scaled so that open level ground receives of it what a uniform sky of radiance 1 sends.
class RelativeSky {
 public:
  RelativeSky() = default;  // uniform
  // `zenith` and `sun` are unit directions, world.
  RelativeSky(const SkyShape& shape, const Eigen::Vector3d& zenith, const Eigen::Vector3d& sun);

  // Towards a unit direction; below the horizon, as at the horizon. Exactly 1 of a uniform sky.
  Spectrum Towards(const Eigen::Vector3d& direction) const;
  // What it was divided by: exp(G + H), averaged by cosine.
  const Spectrum& scale() const { return scale_; }

 private:
  SkyShape shape_;
  Eigen::Vector3d zenith_ = Eigen::Vector3d::UnitZ(), sun_ = Eigen::Vector3d::UnitZ();
  bool is_uniform_ = true;
  Spectrum scale_ = Spectrum::Ones();
};

// The same in pieces three degrees high and wide, for what meets the sky often.
class SkyPieces {
 public:
  SkyPieces(const RelativeSky& sky, bool is_uniform, const Eigen::Vector3d& zenith);

  int Of(const Eigen::Vector3d& direction) const;  // a unit direction above the horizon
  const Spectrum& At(int piece) const { return relative_[piece]; }

 private:
  Eigen::Matrix3d from_world_;
  std::vector<Spectrum> relative_;
};

}  // namespace insitu
