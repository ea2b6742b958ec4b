// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/surface_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "datasets_synthetic/random.h"

namespace insitu::demo {
namespace {

struct Octave {
  double size_m;
  double amplitude;  // of the reflectance, relative
};

struct Surface {
  std::string name;
  Spectrum reflectance;
  std::vector<Octave> mottle;
  Eigen::Vector2d course_m = Eigen::Vector2d::Zero();  // bricks or tiles; zero: none
  double mirror_index = 0;
};

Spectrum Ramp(double at_380, double at_780) { return Spectrum::LinSpaced(kBands, at_380, at_780); }

// In the order of Material.
std::array<Surface, kMaterials> MakeSurfaces() {
  const std::vector<Octave> grass = {
      {0.03, 0.28}, {0.12, 0.20}, {0.5, 0.08}, {2.0, 0.03}, {9.0, 0.015}};
  const std::vector<Octave> mineral = {{0.05, 0.03}, {0.35, 0.04}, {1.5, 0.03}};
  const std::vector<Octave> gravel = {{0.02, 0.25}, {0.06, 0.25}, {0.8, 0.08}};
  const std::vector<Octave> forest = {{6, 0.35}, {20, 0.30}, {60, 0.2}};
  const Eigen::Vector2d bricks(0.26, 0.085), tiles(0.22, 0.34), plain(0, 0);
  return {{
      {"lawn", 0.035 + 0.085 * Bell(552, 36) + 0.05 * Step(575, 45) + 0.30 * Step(712, 11), grass,
       plain},
      {"forest", 0.02 + 0.035 * Bell(550, 35) + 0.22 * Step(714, 11), forest, plain},
      {"gravel", 0.26 + 0.14 * Step(530, 60), gravel, plain},
      {"concrete", Ramp(0.38, 0.45), mineral, plain},
      {"brick", 0.085 + 0.27 * Step(582, 27), {{0.6, 0.10}}, bricks},
      {"rooftile", 0.06 + 0.27 * Step(580, 24), {{0.5, 0.12}}, tiles},
      {"metal_grey", Ramp(0.22, 0.24), {}, plain},
      {"PAV_WALL", 0.53 + 0.11 * Step(500, 45), {}, plain},
      {"PAV_ROOF", Ramp(0.17, 0.15), {}, plain},
      {"PAV_FRAME", 0.10 + 0.26 * Step(585, 45), {}, plain},
      {"PAV_GLASS", Ramp(0.035, 0.025), {}, plain, 1.8},
      {"CONE_RED", 0.05 + 0.45 * Step(600, 14), {}, plain},
      {"SPHERE_STONE", 0.20 + 0.27 * Step(545, 35), {}, plain},
      {"TORUS_BLUE", 0.06 + 0.34 * Bell(460, 38), {}, plain},
      {"BRIDGE_TIMBER", 0.12 + 0.30 * Step(575, 45), {}, plain},
      {"BRIDGE_ROOF", Ramp(0.13, 0.15), {}, plain},
      {"plaster_white", Ramp(0.66, 0.72), {{0.4, 0.02}, {1.7, 0.02}}, plain},
      {"plaster_pale", Ramp(0.47, 0.52), {{0.4, 0.02}, {1.7, 0.02}}, plain},
      {"stucco", 0.22 + 0.26 * Step(545, 40), {{0.3, 0.03}, {2.0, 0.04}}, plain},
      {"paving", Ramp(0.19, 0.23), {{0.04, 0.10}, {0.6, 0.06}}, Eigen::Vector2d(0.6, 0.4)},
      {"boards", 0.05 + 0.16 * Step(590, 40), {{0.15, 0.10}}, Eigen::Vector2d(2.4, 0.18)},
      {"pane", Ramp(0.035, 0.030), {}, plain, 1.52},
      {"water", 0.03 + 0.06 * Bell(560, 60), {}, plain, 1.333},
  }};
}

const Surface& SurfaceOf(Material material) {
  static const std::array<Surface, kMaterials> surfaces = MakeSurfaces();
  return surfaces[static_cast<size_t>(material)];
}

// How much of a detail of `size` survives averaging over `footprint`.
double Visible(double size, double footprint) { return std::min(1.0, size / (2 * footprint)); }

// Relative tint of the brick or tile at a position; each course is shifted by half a brick.
double CourseTint(const Eigen::Vector2d& course, const Eigen::Vector2d& position) {
  const double row = std::floor(position.y() / course.y());
  const double shift = std::fmod(row, 2.0) == 0 ? 0 : 0.5;
  const double column = std::floor(position.x() / course.x() + shift);
  return CellNoise(static_cast<int64_t>(column), static_cast<int64_t>(row), 77) - 0.5;
}

}  // namespace

const std::string& MaterialName(Material material) { return SurfaceOf(material).name; }

const Spectrum& PlainReflectance(Material material) { return SurfaceOf(material).reflectance; }

double MirrorIndex(Material material) { return SurfaceOf(material).mirror_index; }

Spectrum TexturedReflectance(Material material, const Eigen::Vector2d& position, double footprint) {
  const Surface& surface = SurfaceOf(material);
  double factor = 1;
  for (const Octave& octave : surface.mottle) {
    const Eigen::Vector2d cell = position / octave.size_m;
    const double noise = ValueNoise(cell.x(), cell.y(), static_cast<uint64_t>(material));
    factor += 2 * octave.amplitude * Visible(octave.size_m, footprint) * (noise - 0.5);
  }
  if (!surface.course_m.isZero()) {
    factor +=
        0.5 * Visible(surface.course_m.y(), footprint) * CourseTint(surface.course_m, position);
  }
  return std::max(0.1, factor) * surface.reflectance;
}

const Spectrum& WindowReflectance() {
  static const Spectrum window = Ramp(0.062, 0.045);
  return window;
}

const Spectrum& TargetReflectance(bool white) {
  static const Spectrum bright = Spectrum::Constant(0.75), dark = Spectrum::Constant(0.04);
  return white ? bright : dark;
}

}  // namespace insitu::demo
