// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/glass.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "radiometry/light/fresnel.h"
#include "renderer/trace/mirror.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

using TraceRay = std::function<Spectrum(const Ray&)>;

constexpr int kSplitDepth = 2;     // mirrors and panes before it
constexpr int kMostInterior = 12;  // faces met inside a body
constexpr double kLittle = 0.02;   // share of light inside a body that is not followed any more
constexpr double kStep = 1e-4;     // [m], off a face of a body

// Light at a pane or an interface: what it mirrors and what it lets through, by functions that
// find it out. Deep in a path only one of them is asked, and stands for both. `parts` of a camera
// ray's first face are told of each; null: nobody asks.
Spectrum Both(const Spectrum& mirror, const Spectrum& through,
              const std::function<Spectrum()>& mirrored, const std::function<Spectrum()>& behind,
              int depth, double choice, RayParts* parts) {
  const double a = mirror.maxCoeff(), b = through.maxCoeff();
  if (depth < kSplitDepth) {
    Spectrum sum = Spectrum::Zero();
    if (a > 0) sum += mirror * mirrored();
    if (parts) parts->light[kBuildingReflection] += sum;
    const Spectrum image = sum;
    if (b > 0) sum += through * behind();
    if (parts) parts->light[kBuildingTransmission] += sum - image;
    return sum;
  }
  if (a + b <= 0) return Spectrum::Zero();
  const double share = a / (a + b);
  return choice < share ? Spectrum(mirror * mirrored() / share)
                        : Spectrum(through * behind() / (1 - share));
}

// nullopt: totally reflected. `index` of what lies behind the face, relative to before it.
std::optional<Vector3d> Refracted(const Vector3d& direction, const Vector3d& normal, double index) {
  const double cosine = -direction.dot(normal);
  const double square = 1 - (1 - cosine * cosine) / (index * index);
  if (square <= 0) return std::nullopt;
  return (direction / index + (cosine / index - std::sqrt(square)) * normal).normalized();
}

Vector3d MirroredDirection(const Vector3d& direction, const Vector3d& normal) {
  return (direction - 2 * direction.dot(normal) * normal).normalized();
}

// A ray within a body of glass.
class BodyPath {
 public:
  BodyPath(const MontageScene& scene, int material, const TraceRay& trace)
      : scene_(scene), material_(material), trace_(trace) {}

  // Radiance that comes back along it. `throughput`: what is left of it at the viewer.
  Spectrum Follow(const Ray& ray, double throughput, int faces) const {
    const auto hit = FindHit(scene_, ray, World::kWithBuilding);
    const SpectralGlass& glass = *scene_.artificial_materials[material_].glass;
    if (!hit) return scene_.natural.air.horizon;  // the body is open
    const Spectrum left = (-glass.absorption * hit->distance).exp();
    const bool is_own = hit->is_building && scene_.material_of_triangle[hit->index] == material_;
    if (!is_own) {  // something stands in the glass
      return left * trace_(ray);
    }
    const SurfacePoint& face = hit->surface;
    const double cosine = std::min(1.0, -ray.direction.dot(face.normal));
    const double F = FresnelReflectance(cosine, 1 / glass.index);
    Spectrum radiance = Spectrum::Zero();
    if (const auto out = Refracted(ray.direction, face.normal, 1 / glass.index)) {
      const Ray rest = {face.position - kStep * face.normal, *out};
      radiance += (1 - F) * trace_(rest);
    }
    const double further = throughput * F * left.maxCoeff();
    if (further > kLittle && faces < kMostInterior) {
      const Ray back = {face.position + kStep * face.normal,
                        MirroredDirection(ray.direction, face.normal)};
      radiance += F * Follow(back, further, faces + 1);
    }
    return left * radiance;
  }

 private:
  const MontageScene& scene_;
  int material_;
  const TraceRay& trace_;
};

}  // namespace

Spectrum GlassColor(const MontageScene& scene, const SceneHit& hit, const Ray& ray,
                    const LightDirections& light, int depth,
                    const std::function<Spectrum()>& straight_on, const TraceRay& trace) {
  const int index = scene.material_of_triangle[hit.index];
  const SpectralMaterial& material = scene.artificial_materials[index];
  const SpectralGlass& glass = *material.glass;
  const double cosine = std::min(1.0, -ray.direction.dot(hit.surface.normal));
  const double mirrors = material.specular ? material.specular->weight : 0;
  const auto mirrored = [&] {
    return trace({hit.surface.position + kBuildingClearance * hit.surface.normal,
                  MirroredDirection(ray.direction, hit.surface.normal)});
  };
  const double choice = PathChoice(light, depth);
  RayParts* const parts = depth == 0 ? light.parts : nullptr;
  if (!glass.is_solid) {
    const SheetOptics pane = ThinSheet(cosine, glass.index, glass.absorption, glass.thickness);
    return Both(mirrors * pane.reflectance, glass.weight * pane.transmittance, mirrored,
                straight_on, depth, choice, parts);
  }
  const double F = mirrors * FresnelReflectance(cosine, glass.index);
  const auto inside = [&] {
    const auto direction = Refracted(ray.direction, hit.surface.normal, glass.index);
    const Ray within = {hit.surface.position - kStep * hit.surface.normal, *direction};
    return BodyPath(scene, index, trace).Follow(within, 1, 0);
  };
  return Both(Spectrum::Constant(F), Spectrum::Constant(glass.weight * (1 - F)), mirrored, inside,
              depth, choice, parts);
}

}  // namespace insitu
