// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/trace/surface_textures.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/texture.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "calibration/files/sha256.h"
#include "calibration/files/whole_file.h"
#include "calibration/photo/photograph.h"
#include "renderer/building/data_map.h"
#include "renderer/building/shown_environment.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

// Levels are means of light: an image must be linear before it is made coarser.
void WriteLevels(const fs::path& path, Raster image) {
  const OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT);
  const OIIO::ImageBuf pixels(spec, image.data.data());
  OIIO::ImageSpec config;
  config.attribute("wrapmodes", "periodic,periodic");
  config.attribute("maketx:fileformatname", "openexr");
  config.attribute("DateTime", "");
  WriteWhole(path, [&](const fs::path& temporary) {
    if (!OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, pixels,
                                          temporary.string(), config)) {
      throw std::runtime_error(path.string() + ": " + OIIO::geterror());
    }
  });
}

// Of coordinates in repeats, by metres along the face.
Eigen::Matrix<double, 2, 3> Gradient(const std::array<Eigen::Vector3d, 3>& corners,
                                     const std::array<Eigen::Vector2d, 3>& uv) {
  Eigen::Matrix<double, 3, 2> edges;
  edges << corners[1] - corners[0], corners[2] - corners[0];
  Eigen::Matrix2d steps;
  steps << uv[1] - uv[0], uv[2] - uv[0];
  return steps * (edges.transpose() * edges).inverse() * edges.transpose();
}

constexpr double kLeastCosine = 0.02;  // of a facet that is seen
// Of a ray's share: a square of its width has about this standard deviation in widths.
constexpr double kSigmaOfWidth = 0.29;

// The ray's cone meets the surface in an ellipse: along the line of sight longer by the
// obliqueness.
Eigen::Matrix<double, 3, 2> SpreadOn(const Eigen::Vector3d& normal,
                                     const Eigen::Vector3d& to_viewer, double width) {
  const double cosine = std::max(0.01, std::abs(normal.dot(to_viewer)));
  Eigen::Vector3d across = normal.cross(to_viewer);
  if (across.squaredNorm() < 1e-12) across = normal.unitOrthogonal();
  across.normalize();
  Eigen::Matrix<double, 3, 2> spread;
  spread << across, normal.cross(across) / cosine;
  return kSigmaOfWidth * width * spread;
}

// Variances of slopes add; a smooth mirror takes the distribution that many waves have.
Roughness Rougher(const Roughness& roughness, double variance) {
  if (variance <= 0) return roughness;
  Roughness rougher = roughness;
  if (roughness.slope == 0) rougher.distribution = FacetDistribution::kBeckmann;
  rougher.slope = std::min(1.0, std::sqrt(roughness.slope * roughness.slope + variance));
  return rougher;
}

// A facet that turns away is seen edge on.
Eigen::Vector3d OnViewersSide(const Eigen::Vector3d& normal, const Eigen::Vector3d& to_viewer) {
  const double cosine = normal.dot(to_viewer);
  if (cosine >= kLeastCosine) return normal;
  return (normal + (kLeastCosine - cosine) * to_viewer).normalized();
}

// Bare metal of the surface's colour.
void MakeMetal(SpectralMaterial* material) {
  material->mirror_color = std::numbers::pi * material->brdf;
  material->specular->index.reset();
  material->metal.reset();
  material->brdf.setZero();
  material->translucence.setZero();
}

void ApplyMaps(const MapValues& maps, const FacePlace& place, const Eigen::Vector3d& to_viewer,
               double choice, BumpedSurface* surface) {
  SpectralMaterial& material = surface->material;
  if (maps.transmission && material.glass) material.glass->weight = *maps.transmission;
  if (material.glass) return;
  if (!maps.gradient.isZero(0)) {
    // Seen from behind, the relief is hollow where it is raised.
    const double side = place.is_back ? -1 : 1;
    surface->surface.normal =
        OnViewersSide((surface->surface.normal - side * maps.gradient).normalized(), to_viewer);
  }
  if (!material.specular) return;
  if (maps.metallic && choice < *maps.metallic) MakeMetal(&material);
  Roughness& roughness = material.specular->roughness;
  if (maps.roughness) roughness.slope = *maps.roughness;
  roughness = Rougher(roughness, maps.variance);
}

}  // namespace

struct SurfaceTextures::Face {
  int material;
  std::array<Eigen::Vector2d, 3> uv;
  Eigen::Matrix<double, 2, 3> uv_from_metres;
  Eigen::Vector3d normal;  // unit
};

struct SurfaceTextures::Footprint {
  Eigen::Vector2d at, dx, dy;  // in repeats, and what a ray spans
};

struct SurfaceTextures::Images {
  using Handle = OIIO::TextureSystem::TextureHandle*;
  struct Map {
    SurfaceMap says;
    Handle handle;
  };
  struct Image {
    Handle handle = nullptr;                       // null: the material has none of its colour
    Eigen::Array3d tint = Eigen::Array3d::Ones();  // the model's colour times the image
    std::vector<Map> maps = {};

    bool IsEmpty() const { return !handle && maps.empty(); }
  };
  OIIO::TextureSystem* system = OIIO::TextureSystem::create(/*shared=*/false);
  std::vector<Image> of_material;

  Images() = default;
  Images(const Images&) = delete;
  Images& operator=(const Images&) = delete;
  ~Images() { OIIO::TextureSystem::destroy(system); }

  Image Load(const SurfaceMaterial& material, const fs::path& folder, const fs::path& cache) {
    Image image;
    if (!material.texture.empty()) image = LoadColor(material, folder, cache);
    for (const SurfaceMap& map : material.maps) {
      const fs::path file = (folder / map.file).lexically_normal();
      const std::string kind =
          std::to_string(static_cast<int>(map.kind)) + "_" + std::to_string(map.channel) +
          (map.is_squared ? "s" : "") +
          (map.kind == SurfaceMap::Kind::kNormal ? std::to_string(map.factor) : std::string());
      const fs::path levels = cache / (Sha256(file) + "_" + kind + ".exr");
      if (!fs::exists(levels)) WriteLevels(levels, ReadDataMap(file, map));
      image.maps.push_back({map, HandleOf(levels)});
    }
    return image;
  }

  Handle HandleOf(const fs::path& levels) {
    return system->get_texture_handle(OIIO::ustring(levels.string()));
  }

  // `count` channels from `first`, the mean over the footprint.
  void Sample(Handle handle, const Footprint& over, int first, int count, float* values) const {
    OIIO::TextureOpt options;
    options.interpmode = OIIO::TextureOpt::InterpBilinear;  // its bicubic one blurs what is close
    options.swrap = options.twrap = OIIO::TextureOpt::WrapPeriodic;
    options.firstchannel = first;
    const auto f = [](double value) { return static_cast<float>(value); };
    // Rows of an image go down, v goes up.
    const bool is_read = system->texture(handle, nullptr, options, f(over.at.x()),
                                         f(1 - over.at.y()), f(over.dx.x()), f(-over.dx.y()),
                                         f(over.dy.x()), f(-over.dy.y()), count, values);
    if (!is_read) throw std::runtime_error("a texture: " + system->geterror());
  }

  Image LoadColor(const SurfaceMaterial& material, const fs::path& folder, const fs::path& cache) {
    const fs::path file = (folder / material.texture).lexically_normal();
    const Raster linear = ReadPhotograph(file).linear;
    const fs::path levels = cache / (Sha256(file) + ".exr");
    if (!fs::exists(levels)) WriteLevels(levels, linear);
    const Eigen::Array3d mean = MeanColor(linear).array();
    const Eigen::Array3d tint = (mean > 0).select(material.diffuse_rgb.array() / mean, 1.0);
    return {HandleOf(levels), tint};
  }
};

SurfaceTextures::SurfaceTextures(const ArtificialEnvironment& environment, const fs::path& folder,
                                 const fs::path& cache, double pixel_angle)
    // The fewest rays of a pixel are four: each stands for half its width.
    : ray_angle_(pixel_angle / 2),
      face_of_triangle_(environment.triangles.size(), -1),
      images_(std::make_unique<Images>()) {
  for (const SurfaceMaterial& material : environment.materials) {
    images_->of_material.push_back(images_->Load(material, folder, cache));
  }
  for (size_t t = 0; t < environment.triangles.size(); ++t) {
    const int material = environment.material_of_triangle[t];
    if (images_->of_material[material].IsEmpty()) continue;
    const auto uv = TextureCoordinates(environment, static_cast<int>(t));
    if (!uv) continue;
    const Eigen::Vector3i& triangle = environment.triangles[t];
    const std::array<Eigen::Vector3d, 3> corners = {environment.vertices[triangle[0]],
                                                    environment.vertices[triangle[1]],
                                                    environment.vertices[triangle[2]]};
    const Eigen::Vector3d normal =
        (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    const Face face{material, *uv, Gradient(corners, *uv), normal};
    if (!face.uv_from_metres.allFinite()) continue;  // a sliver
    face_of_triangle_[t] = static_cast<int>(faces_.size());
    faces_.push_back(face);
  }
}

SurfaceTextures::~SurfaceTextures() = default;

// Slopes of normals are along u and v, of heights of code by repeat.
void SurfaceTextures::AddRelief(const SurfaceMap& says, const Face& face, const float* relief,
                                MapValues* values) {
  Eigen::Matrix<double, 3, 2> axes = face.uv_from_metres.transpose();  // gradients of u and v
  if (says.kind == SurfaceMap::Kind::kNormal) {
    const Eigen::Vector3d along_u = axes.col(1).cross(face.normal).normalized();
    const double side = along_u.dot(axes.col(0)) < 0 ? -1 : 1;
    axes.col(0) = side * along_u;
    axes.col(1) = face.normal.cross(along_u);
    if (axes.col(1).dot(face.uv_from_metres.row(1)) < 0) axes.col(1) = -axes.col(1);
  } else {
    axes *= says.factor;
  }
  const double u = relief[0], v = relief[1];
  values->gradient += axes * Eigen::Vector2d(u, v);
  const double of_u = relief[2] - u * u, of_v = relief[3] - v * v, of_both = relief[4] - u * v;
  const double variance = of_u * axes.col(0).squaredNorm() + of_v * axes.col(1).squaredNorm() +
                          2 * of_both * axes.col(0).dot(axes.col(1));
  values->variance += std::max(0.0, variance);
}

const SurfaceTextures::Face* SurfaceTextures::FaceAt(const FacePlace& place) const {
  if (place.triangle >= std::ssize(face_of_triangle_)) return nullptr;  // on a sphere
  const int index = face_of_triangle_[place.triangle];
  return index < 0 ? nullptr : &faces_[index];
}

// The ray's cone meets the face in an ellipse: across the line of sight as wide as the cone, along
// it longer by the obliqueness.
SurfaceTextures::Footprint SurfaceTextures::FootprintOf(const Face& face, const FacePlace& place,
                                                        double distance,
                                                        const Eigen::Vector3d& direction) const {
  const auto& [a, b, c] = face.uv;
  const Eigen::Vector2d at = a + place.uv.x() * (b - a) + place.uv.y() * (c - a);
  const Eigen::Vector2d within = at - at.array().floor().matrix();  // single precision from here
  const double cosine = std::max(0.01, std::abs(face.normal.dot(direction)));
  Eigen::Vector3d across = face.normal.cross(direction);
  if (across.squaredNorm() < 1e-12) across = face.normal.unitOrthogonal();
  across.normalize();
  const double width = distance * ray_angle_;
  return {within, face.uv_from_metres * (width * across),
          face.uv_from_metres * (width / cosine * face.normal.cross(across))};
}

std::optional<Eigen::Vector3d> SurfaceTextures::Albedo(const FacePlace& place, double distance,
                                                       const Eigen::Vector3d& direction) const {
  const Face* face = FaceAt(place);
  if (!face) return std::nullopt;
  const Images::Image& image = images_->of_material[face->material];
  if (!image.handle) return std::nullopt;
  float rgb[3] = {0, 0, 0};
  images_->Sample(image.handle, FootprintOf(*face, place, distance, direction), 0, 3, rgb);
  const Eigen::Array3d albedo = Eigen::Array3f(rgb[0], rgb[1], rgb[2]).cast<double>() * image.tint;
  return albedo.max(0).min(1).matrix();
}

MapValues SurfaceTextures::Maps(const FacePlace& place, double distance,
                                const Eigen::Vector3d& direction) const {
  MapValues values;
  const Face* face = FaceAt(place);
  if (!face) return values;
  const std::vector<Images::Map>& maps = images_->of_material[face->material].maps;
  if (maps.empty()) return values;
  const Footprint over = FootprintOf(*face, place, distance, direction);
  for (const Images::Map& map : maps) {
    if (IsRelief(map.says)) {
      float relief[kReliefChannels];
      images_->Sample(map.handle, over, 0, 4, relief);
      images_->Sample(map.handle, over, 4, 1, relief + 4);
      AddRelief(map.says, *face, relief, &values);
      continue;
    }
    float value = 0;
    images_->Sample(map.handle, over, 0, 1, &value);
    const double says = std::clamp(FactorOf(map.says) * value, 0.0, 1.0);
    if (map.says.kind == SurfaceMap::Kind::kRoughness) values.roughness = says;
    if (map.says.kind == SurfaceMap::Kind::kMetallic) values.metallic = says;
    if (map.says.kind == SurfaceMap::Kind::kTransmission) values.transmission = says;
  }
  return values;
}

BumpedSurface BumpedAt(const MontageScene& scene, const SurfacePoint& surface,
                       const SpectralMaterial& material, const Eigen::Vector3d& to_viewer,
                       double distance) {
  BumpedSurface bumped{surface, material};
  if (!material.bumps) return bumped;
  const auto spread = SpreadOn(surface.normal, to_viewer, scene.ray_angle * distance);
  const BumpField::Turned turned = material.bumps->At(surface.position, surface.normal, spread);
  bumped.surface.normal = OnViewersSide(turned.normal, to_viewer);
  if (!material.specular) return bumped;
  Roughness& roughness = bumped.material.specular->roughness;
  roughness = Rougher(roughness, turned.variance);
  return bumped;
}

BumpedSurface BuildingSurfaceAt(const MontageScene& scene, const SurfacePoint& surface,
                                const FacePlace& place, double distance,
                                const Eigen::Vector3d& to_viewer, double choice) {
  BumpedSurface found{surface, scene.MaterialOfTriangle(place.triangle)};
  if (scene.textures) {
    const SurfaceTextures& textures = *scene.textures;
    if (const auto albedo = textures.Albedo(place, distance, -to_viewer)) {
      found.material.brdf = scene.natural.spectra.ReflectanceFromRgb(*albedo) / std::numbers::pi;
    }
    const MapValues maps = textures.Maps(place, distance, -to_viewer);
    ApplyMaps(maps, place, to_viewer, choice, &found);
  }
  if (found.material.glass) return found;
  return BumpedAt(scene, found.surface, found.material, to_viewer, distance);
}

double TransmissionAt(const MontageScene& scene, const FacePlace& place,
                      const Eigen::Vector3d& direction) {
  const double mean = scene.MaterialOfTriangle(place.triangle).glass->weight;
  if (!scene.textures) return mean;
  return scene.textures->Maps(place, 0, direction).transmission.value_or(mean);
}

}  // namespace insitu
