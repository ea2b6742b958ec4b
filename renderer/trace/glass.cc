// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/glass.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "radiometry/light/fresnel.h"
#include "radiometry/light/split_mix.h"
#include "renderer/trace/mirror.h"
#include "renderer/trace/sampling.h"
#include "renderer/trace/through_glass.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

using TraceRay = std::function<Spectrum(const Ray&)>;

constexpr int kSplitDepth = 2;      // mirrors and panes before it
constexpr int kMostInterior = 12;   // faces met inside a body
constexpr double kLittle = 0.02;    // share of light inside a body that is not followed any more
constexpr double kStep = 1e-4;      // [m], off a face of a body
constexpr int kMostScattered = 64;  // faces met inside a rough one
// Of what a camera ray's facet of rough glass lets through: behind it lies whatever stands there,
// the sun's patches on a floor beside its walls.
constexpr int kWaysPerFacet = 4;

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

// A face of rough glass as a viewer's ray meets it.
class RoughGlassFace {
 public:
  RoughGlassFace(const MontageScene& scene, const SceneHit& hit, const SpectralMaterial& material,
                 const Ray& ray, const LightDirections& light, int depth, const TraceFurther& trace)
      : scene_(scene),
        material_(scene.material_of_triangle[hit.index]),
        mirrors_(material.specular ? material.specular->weight : 0),
        glass_(*material.glass),
        surface_(hit.surface),
        frame_(FrameAbout(hit.surface.normal)),
        view_(frame_.transpose() * -ray.direction),
        light_(light),
        depth_(depth),
        trace_(trace) {}

  Spectrum Color() const {
    const int facets = depth_ == 0 ? kFacetsPerRay : 1;
    RayParts* const parts = depth_ == 0 ? light_.parts : nullptr;
    std::optional<RayParts> of_facets;
    if (parts) of_facets.emplace();
    Spectrum radiance = Spectrum::Zero();
    for (int i = 0; i < facets; ++i) {
      radiance += OfFacet(i, facets, of_facets ? &*of_facets : nullptr);
    }
    radiance /= facets;
    const Spectrum lights = mirrors_ * MirroredLights();
    if (parts) {
      parts->light[kBuildingTransmission] += of_facets->light[kBuildingTransmission] / facets;
      parts->light[kBuildingReflection] += of_facets->light[kBuildingReflection] / facets + lights;
    }
    return radiance + lights;
  }

 private:
  const RoughInterface& Outside() const { return glass_.rough->from_outside(); }
  const RoughInterface& Inside() const { return glass_.rough->from_inside(); }

  Spectrum OfFacet(int i, int facets, RayParts* parts) const {
    LightDirections further = light_;
    further.sees_lights = false;
    further.share = light_.share / facets;
    further.parts = nullptr;
    if (i > 0) further.seed = SplitMix64(light_.seed + i);
    PathNumbers numbers{SplitMix64(further.seed + 4 * static_cast<uint64_t>(depth_) + 3)};
    const GlassFacet facet = Outside().Choose(view_, SpreadAfter(FacetChoice(light_, depth_), i));
    const TraceRay trace = [&](const Ray& out) { return trace_(out, further); };
    const auto mirrored = [&] { return trace(From(true, frame_ * facet.mirrored)); };
    const int ways = depth_ == 0 ? kWaysPerFacet : 1;
    const auto behind = [&] {
      Spectrum sum = Spectrum::Zero();
      for (int way = 0; way < ways; ++way) {
        sum += glass_.is_solid ? ThroughBody(frame_ * facet.refracted, &numbers, trace)
                               : ThroughPane(facet.refracted, &numbers, trace);
      }
      return Spectrum(sum / ways);
    };
    return Both(Spectrum::Constant(mirrors_ * facet.mirrors),
                Spectrum::Constant(glass_.weight * facet.lets_through), mirrored, behind, depth_,
                PathChoice(further, depth_), parts);
  }

  Ray From(bool is_front, const Vector3d& direction) const {
    const double off = is_front ? kBuildingClearance : -kBuildingClearance;
    return {surface_.position + off * surface_.normal, direction.normalized()};
  }

  Spectrum MirroredLights() const {
    return LightsByLobe(scene_, From(true, surface_.normal).origin, light_, true,
                        [&](const Vector3d& to_light) {
                          const Vector3d local = frame_.transpose() * to_light;
                          return local.z() > 0 ? Outside().Lobe(view_, local) : 0;
                        });
  }

  // Sun and lamps that come in at a face, on the way of what is seen inside from `to_viewer`.
  Spectrum LightsInto(const Vector3d& outside, const Eigen::Matrix3d& to_frame,
                      const Vector3d& to_viewer) const {
    return LightsByLobe(scene_, outside, light_, true, [&](const Vector3d& to_light) {
      const Vector3d local = to_frame * to_light;
      return local.z() < 0 ? Inside().Lobe(to_viewer, local) : 0;
    });
  }

  Spectrum ThroughPane(const Vector3d& refracted, PathNumbers* numbers,
                       const TraceRay& trace) const {
    const Eigen::Matrix3d of_back = frame_.transpose();
    Eigen::Matrix3d of_front = of_back;  // its normal points inside
    of_front.row(2) = -of_front.row(2);
    Spectrum lights = Spectrum::Zero();
    const auto arrives = [&](const RoughSheet::Arrival& face) {
      lights += face.share * LightsInto(From(face.is_front, surface_.normal).origin,
                                        face.is_front ? of_front : of_back, face.to_viewer);
    };
    const RoughSheet::Origin origin = glass_.rough->Follow(refracted, numbers, arrives);
    const Ray out = From(origin.direction.z() > 0, frame_ * origin.direction);
    return lights + origin.share * trace(out);
  }

  Spectrum ThroughBody(const Vector3d& refracted, PathNumbers* numbers,
                       const TraceRay& trace) const {
    Ray ray = {surface_.position - kStep * surface_.normal, refracted.normalized()};
    Spectrum lights = Spectrum::Zero(), share = Spectrum::Ones();
    for (int i = 0; i < kMostScattered; ++i) {
      const auto hit = FindHit(scene_, ray, World::kWithBuilding);
      if (!hit) break;  // the body is open
      share *= (-glass_.absorption * hit->distance).exp();
      const bool is_own = hit->is_building && scene_.material_of_triangle[hit->index] == material_;
      if (!is_own) return lights + share * trace(ray);  // something stands in the glass
      const SurfacePoint& face = hit->surface;
      const Eigen::Matrix3d frame = FrameAbout(face.normal);
      const Vector3d to_viewer = frame.transpose() * -ray.direction;
      lights += share * LightsInto(face.position - kBuildingClearance * face.normal,
                                   frame.transpose(), to_viewer);
      const double u = numbers->Next(), v = numbers->Next();
      const GlassFacet facet = Inside().Choose(to_viewer, {u, v});
      if (numbers->Next() < facet.lets_through) {
        const Vector3d out = (frame * facet.refracted).normalized();
        return lights + share * trace({face.position - kStep * face.normal, out});
      }
      ray = {face.position + kStep * face.normal, (frame * facet.mirrored).normalized()};
    }
    return lights + share * scene_.natural.air.horizon;
  }

  const MontageScene& scene_;
  int material_;
  double mirrors_;  // its specular weight
  const SpectralGlass& glass_;
  SurfacePoint surface_;
  Eigen::Matrix3d frame_;
  Vector3d view_;  // in that frame
  const LightDirections& light_;
  int depth_;
  const TraceFurther& trace_;
};

}  // namespace

Spectrum GlassReflectance(const SpectralMaterial& material, double cosine) {
  const double mirrors = material.specular ? material.specular->weight : 0;
  const SpectralGlass& glass = *material.glass;
  if (glass.is_solid) return Spectrum::Constant(mirrors * (1 - FaceTransmittance(glass, cosine)));
  return mirrors * PaneOptics(glass, cosine).reflectance;
}

LightDirections Part(LightDirections light, const MontageScene& scene, const Spectrum& share) {
  light.share *= std::min(1.0, share.head(scene.natural.spectra.bins().count).mean());
  return light;
}

Spectrum GlassColor(const MontageScene& scene, const SceneHit& hit,
                    const SpectralMaterial& material, const Ray& ray, const LightDirections& light,
                    int depth, const std::function<Spectrum()>& straight_on,
                    const TraceFurther& trace) {
  const int index = scene.material_of_triangle[hit.index];
  const SpectralGlass& glass = *material.glass;
  if (glass.rough && !scene.as_printed) {
    return RoughGlassFace(scene, hit, material, ray, light, depth, trace).Color();
  }
  const double cosine = std::min(1.0, -ray.direction.dot(hit.surface.normal));
  const double mirrors = material.specular ? material.specular->weight : 0;
  // A pane mirrors it, at two faces; a body lets most of it through.
  const LightDirections further =
      glass.is_solid ? light : Part(light, scene, 2 * MirrorReflectance(material, cosine));
  const TraceRay trace_ray = [&](const Ray& out) { return trace(out, further); };
  const auto mirrored = [&] {
    return trace_ray({hit.surface.position + kBuildingClearance * hit.surface.normal,
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
    return BodyPath(scene, index, trace_ray).Follow(within, 1, 0);
  };
  return Both(Spectrum::Constant(F), Spectrum::Constant(glass.weight * (1 - F)), mirrored, inside,
              depth, choice, parts);
}

}  // namespace insitu
