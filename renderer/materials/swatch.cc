// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/materials/swatch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "calibration/algebra/decompositions.h"
#include "radiometry/light/fresnel.h"
#include "radiometry/light/microfacet.h"
#include "radiometry/spectrum/color.h"
#include "renderer/trace/make_montage_scene.h"
#include "renderer/trace/mirror.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
constexpr double kGroundAlbedo = 0.2;
constexpr double kBodyThickness = 0.1;  // [m], of solid glass
constexpr int kFacets = 8;              // squared, of a rough mirror
constexpr int kSamples = 2;             // squared, of a pixel

// What a swatch is seen in: x to the right, y up, z towards the viewer, who is far away.
class SwatchScene {
 public:
  SwatchScene(const SurfaceMaterial& material, const SwatchLight& light,
              const SpectralBasis& spectra)
      : material_(SpectralMaterialOf(spectra, material)), light_(light) {
    const double h = light.sun_height, across = std::cos(h) * std::sqrt(0.5);
    to_sun_ = Vector3d(-across, std::sin(h), across);
    const Spectrum on_ground = light.sun_irradiance * std::sin(h) + kPi * light.sky_radiance;
    ground_ = kGroundAlbedo / kPi * on_ground;
  }

  // Radiance towards the viewer of a surface element; `behind` is what would be seen without it.
  Spectrum Radiance(const Vector3d& normal, const Spectrum& behind) const {
    const double cosine = std::clamp(normal.z(), 0.0, 1.0);
    const Spectrum mirror = MirrorReflectance(material_, cosine);
    if (material_.glass) return Clear(normal, cosine, behind);
    Spectrum L = (1 - mirror) * material_.diffuse_weight * material_.brdf * Irradiance(normal);
    if ((mirror > 0).any()) L += mirror * MirrorImage(normal);
    return L;
  }

  Spectrum Irradiance(const Vector3d& normal) const {
    const double up = (1 + normal.y()) / 2;
    return light_.sun_irradiance * std::max(0.0, normal.dot(to_sun_)) +
           kPi * (up * light_.sky_radiance + (1 - up) * ground_);
  }

 private:
  Spectrum Around(const Vector3d& direction) const {
    return direction.y() > 0 ? light_.sky_radiance : ground_;
  }

  Spectrum MirrorImage(const Vector3d& normal) const {
    const Roughness& roughness = material_.specular->roughness;
    const Vector3d to_viewer = Vector3d::UnitZ();
    const SurfacePoint surface{Vector3d::Zero(), normal};
    if (roughness.slope == 0) {
      return Around(2 * normal.z() * normal - to_viewer);
    }
    Spectrum sum = Spectrum::Zero();
    for (int i = 0; i < kFacets * kFacets; ++i) {
      const int column = i % kFacets, row = i / kFacets;
      const Eigen::Vector2d uniform((column + 0.5) / kFacets, (row + 0.5) / kFacets);
      const MirroredRay mirrored = ChooseMirrored(surface, roughness, to_viewer, 0, uniform);
      if (mirrored.weight > 0) sum += mirrored.weight * Around(mirrored.ray.direction);
    }
    const auto to_frame = RotationBetween(normal, Vector3d::UnitZ());
    return sum / (kFacets * kFacets) +
           MirrorLobe(roughness, to_frame * to_viewer, to_frame * to_sun_) * light_.sun_irradiance;
  }

  // As a pane, and so are bodies: straight on.
  Spectrum Clear(const Vector3d& normal, double cosine, const Spectrum& behind) const {
    const SpectralGlass& glass = *material_.glass;
    const double thickness = glass.is_solid ? kBodyThickness : glass.thickness;
    const SheetOptics sheet = ThinSheet(cosine, glass.index, glass.absorption, thickness);
    Spectrum L = glass.weight * sheet.transmittance * behind;
    L += (1 - glass.weight) * material_.brdf * Irradiance(normal);
    if (!material_.specular) return L;
    const Vector3d mirrored = 2 * normal.z() * normal - Vector3d::UnitZ();
    return L + material_.specular->weight * sheet.reflectance * Around(mirrored);
  }

  SpectralMaterial material_;
  SwatchLight light_;
  Vector3d to_sun_;
  Spectrum ground_;
};

// The normal of the sphere that fills its square, nullopt beside it; x and y are -1 to 1.
std::optional<Vector3d> SphereNormal(double x, double y) {
  constexpr double kRadius = 0.92;
  const double square = (x * x + y * y) / (kRadius * kRadius);
  if (square >= 1) return std::nullopt;
  return Vector3d(x / kRadius, y / kRadius, std::sqrt(1 - square));
}

}  // namespace

SwatchLight D65Light(const SpectralBins& bins) {
  const double height = 40 * kPi / 180;
  const Spectrum d65 = IlluminantD65(bins);
  // On the level four parts of sun and one of sky.
  return {height, 4 * kPi / std::sin(height) * d65, d65};
}

SwatchLight LightOf(const Daylight& daylight) {
  const double sine = daylight.sun_direction.dot(daylight.zenith_direction);
  return {std::asin(std::clamp(sine, -1.0, 1.0)), daylight.sun_radiance * daylight.sun_solid_angle,
          daylight.sky_radiance + daylight.ambient_radiance};
}

Raster MakeSwatch(const SurfaceMaterial& material, const SwatchLight& light,
                  const SpectralBasis& spectra, int height) {
  const SwatchScene scene(material, light, spectra);
  const Vector3d to_viewer = Vector3d::UnitZ();
  const Spectrum board = spectra.Ones() / kPi * scene.Irradiance(to_viewer);
  const double white = spectra.RgbFromSpectrum(board).y();
  Raster picture(2 * height, height);
  const auto color_at = [&](double px, double py) {
    const bool is_wall = px >= height;
    const double x = 2 * (is_wall ? px - height : px) / height - 1, y = 1 - 2 * py / height;
    const bool is_dark =
        (static_cast<int>(8 * px / height) + static_cast<int>(8 * py / height)) % 2;
    const Spectrum behind = (is_dark ? 0.4 : 0.8) * board;
    const auto normal = is_wall ? std::optional(to_viewer) : SphereNormal(x, y);
    if (!normal) return behind;
    return scene.Radiance(*normal, behind);
  };
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      Spectrum sum = Spectrum::Zero();
      for (int i = 0; i < kSamples * kSamples; ++i) {
        const int column = i % kSamples, row = i / kSamples;
        sum += color_at(x + (column + 0.5) / kSamples, y + (row + 0.5) / kSamples);
      }
      const Spectrum mean = sum / (kSamples * kSamples);
      picture.SetRgb(x, y, spectra.RgbFromSpectrum(mean) / white);
    }
  }
  return picture;
}

}  // namespace insitu
