// SPDX-License-Identifier: GPL-3.0-or-later
// What rays meet: two Embree scenes about one local origin, materials as spectra, sky facets, and
// the input images that natural surfaces take their colour from.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "calibration/photo/raster.h"
#include "radiometry/light/bumps.h"
#include "radiometry/light/photographed_color.h"
#include "radiometry/light/rough_glass.h"
#include "radiometry/natural_environment.h"
#include "reconstruction/geometry/ray_scene.h"
#include "renderer/building/artificial_environment.h"
#include "renderer/trace/irradiance_map.h"

namespace insitu {

// A surface as the illumination model sees it.
struct SpectralMetal {
  Spectrum index, extinction;  // n - i k
};

struct SpectralGlass {
  double weight = 1;  // share of what is not mirrored that goes through
  bool is_solid = false;
  double index = 1.5;
  double thickness = 0;                    // of a pane [m]
  Spectrum absorption = Spectrum::Zero();  // [1/m]
  // Both faces of a rough pane; of a rough body its one interface from both sides. null: smooth.
  std::shared_ptr<const RoughSheet> rough = {};
};

struct SpectralMaterial {
  double diffuse_weight = 1;
  Spectrum brdf = Spectrum::Zero();  // rho [1/sr]; zero for natural surfaces: it is in the photo
  double transmission = 0;  // of a natural surface: share of its radiance that comes from behind
  double metal_share = 0;   // mean of its map: so much of it has no diffuse part
  Spectrum translucence = Spectrum::Zero();  // the same for light of the other side [1/sr]
  std::optional<Specular> specular = {};
  Spectrum mirror_color = Spectrum::Ones();     // of a bare mirror
  std::optional<SpectralMetal> metal = {};      // goes before it
  std::optional<SpectralGlass> glass = {};      // nullopt: opaque
  std::shared_ptr<const BumpField> bumps = {};  // null: flat

  bool IsTranslucent() const { return (translucence > 0).any(); }
};

struct LampSpectrum {
  Eigen::Vector3d position;  // [m], local
  Spectrum intensity;        // radiance unit times m^2
  std::optional<LightDistribution> distribution = {};
  double radius = 0;        // of its luminous sphere [m]
  bool is_visible = false;  // that sphere itself
};

// The luminous side of an area light, u x v pointing to where it shines.
struct LuminousPanel {
  Eigen::Vector3d corner, u, v;  // [m], local
  Spectrum radiance;
};

// An axis-aligned box about the planned building; a light ray that misses it is not blocked by it.
struct InfluenceBox {
  Eigen::Array3f low = Eigen::Array3f::Constant(1);
  Eigen::Array3f high = Eigen::Array3f::Constant(-1);

  bool IsEmpty() const { return (low > high).any(); }
  // Slab test of the half line from `origin`; `inverse_direction` may hold infinities.
  bool MayMeet(const Eigen::Array3f& origin, const Eigen::Array3f& inverse_direction) const {
    const Eigen::Array3f a = (low - origin) * inverse_direction;
    const Eigen::Array3f b = (high - origin) * inverse_direction;
    const float near = a.min(b).maxCoeff();
    const float far = a.max(b).minCoeff();
    return near <= far && far >= 0;
  }
};

// Some of the building's faces as a scene of their own.
struct FaceSubset {
  TriangleMesh mesh;
  RayScene rays;
  std::vector<int> triangles;  // index among all
};

// A building with glass: what blocks light, and what lets it through.
struct SplitFaces {
  FaceSubset opaque, clear;
};

constexpr int kMostFacets = 4 * kMostPolarFacets * kMostPolarFacets;

struct InterreflectedLight;
class SurfaceTextures;

struct MontageScene {
  NaturalEnvironment natural;
  TriangleMesh natural_mesh;
  RayScene natural_rays;
  std::vector<int> polygon_of_triangle;
  std::vector<SpectralMaterial> material_of_polygon;
  std::optional<int> ground;  // the largest polygon that lies level; its plane goes on beyond it

  TriangleMesh artificial_mesh;
  RayScene artificial_rays;
  std::vector<Eigen::Vector3d> artificial_normals;  // of each triangle, unit
  std::vector<int> material_of_triangle;
  std::vector<SpectralMaterial> artificial_materials;
  std::optional<SplitFaces> split_faces;  // nullopt: nothing is of glass
  InfluenceBox building_box;
  std::vector<LampSpectrum> lamps;
  std::vector<LuminousPanel> panels;

  RelativeSky sky;  // as the light has it
  SkyFacets facets;
  std::vector<Eigen::Vector3f> facet_directions;         // the same, for packets
  std::vector<Eigen::Array3f> inverse_facet_directions;  // for the slab test
  double solar_disc_radius = 0;                          // tangent of the sun's half angle

  // In the order of natural.scene.cameras [Durisch92, §4.1]; empty: not in memory.
  std::vector<Raster> input_images;
  std::vector<LocalImage> images;  // the same with their pinhole cameras
  // Mean BRDF of each polygon's material over the photographs, for polygons that none shows; read
  // without light among surfaces alone, which has its own.
  std::vector<Spectrum> mean_brdf_of_polygon;

  // Light among surfaces; null: the paper's uniform ambient light [Durisch92, Eq. (4)]. It refers
  // to this scene, which must not be moved once it has it.
  std::shared_ptr<const InterreflectedLight> interreflected;

  std::shared_ptr<const SurfaceTextures> textures = {};  // of the building; null: none
  // Width that a ray of the sharpest photograph stands for, one of four of a pixel [rad].
  double ray_angle = 0;
  // Rays as the paper prints them: what leaves has the horizon's colour, surfaces are looked up by
  // their image attribute alone, rough mirrors are Hall and Greenberg's.
  bool as_printed = false;

  const SpectralMaterial& MaterialOfTriangle(int triangle) const {
    return artificial_materials[material_of_triangle[triangle]];
  }
  // Of the building where a ray of artificial_rays meets it: unit, outwards.
  const Eigen::Vector3d& NormalOf(const RayHit& hit) const {
    return hit.sphere_normal ? *hit.sphere_normal : artificial_normals[hit.triangle];
  }
  const RayScene& OpaqueRays() const {
    return split_faces ? split_faces->opaque.rays : artificial_rays;
  }

  PhotographedSite Photographed() const {
    return {natural.scene, natural_rays,    polygon_of_triangle, images,
            natural.air,   natural.spectra, as_printed};
  }
};

}  // namespace insitu
