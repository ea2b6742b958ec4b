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
#include <stdexcept>

#include "calibration/files/sha256.h"
#include "calibration/files/whole_file.h"
#include "calibration/photo/photograph.h"
#include "renderer/building/shown_environment.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

Eigen::Vector3d MeanOf(const Raster& image) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) sum += image.Rgb(x, y);
  }
  return sum / (static_cast<double>(image.width) * image.height);
}

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

}  // namespace

struct SurfaceTextures::Face {
  int material;
  std::array<Eigen::Vector2d, 3> uv;
  Eigen::Matrix<double, 2, 3> uv_from_metres;
  Eigen::Vector3d normal;  // unit
};

struct SurfaceTextures::Images {
  struct Image {
    OIIO::TextureSystem::TextureHandle* handle = nullptr;  // null: the material has none
    Eigen::Array3d tint = Eigen::Array3d::Ones();          // the model's colour times the image
  };
  OIIO::TextureSystem* system = OIIO::TextureSystem::create(/*shared=*/false);
  std::vector<Image> of_material;

  Images() = default;
  Images(const Images&) = delete;
  Images& operator=(const Images&) = delete;
  ~Images() { OIIO::TextureSystem::destroy(system); }

  Image Load(const SurfaceMaterial& material, const fs::path& folder, const fs::path& cache) {
    const fs::path file = (folder / material.texture).lexically_normal();
    const Raster linear = ReadPhotograph(file).linear;
    const fs::path levels = cache / (Sha256(file) + ".exr");
    if (!fs::exists(levels)) WriteLevels(levels, linear);
    const Eigen::Array3d mean = MeanOf(linear).array();
    const Eigen::Array3d tint = (mean > 0).select(material.diffuse_rgb.array() / mean, 1.0);
    return {system->get_texture_handle(OIIO::ustring(levels.string())), tint};
  }
};

SurfaceTextures::SurfaceTextures(const ArtificialEnvironment& environment, const fs::path& folder,
                                 const fs::path& cache, double pixel_angle)
    // The fewest rays of a pixel are four: each stands for half its width.
    : ray_angle_(pixel_angle / 2),
      face_of_triangle_(environment.triangles.size(), -1),
      images_(std::make_unique<Images>()) {
  for (const SurfaceMaterial& material : environment.materials) {
    images_->of_material.push_back(
        material.texture.empty() ? Images::Image() : images_->Load(material, folder, cache));
  }
  for (size_t t = 0; t < environment.triangles.size(); ++t) {
    const int material = environment.material_of_triangle[t];
    if (!images_->of_material[material].handle) continue;
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

std::optional<Eigen::Vector3d> SurfaceTextures::Albedo(const FacePlace& place, double distance,
                                                       const Eigen::Vector3d& direction) const {
  if (place.triangle >= std::ssize(face_of_triangle_)) return std::nullopt;  // on a sphere
  const int index = face_of_triangle_[place.triangle];
  if (index < 0) return std::nullopt;
  const Face& face = faces_[index];
  const auto& [a, b, c] = face.uv;
  const Eigen::Vector2d at = a + place.uv.x() * (b - a) + place.uv.y() * (c - a);
  const Eigen::Vector2d within = at - at.array().floor().matrix();  // single precision from here
  // The ray's cone meets the face in an ellipse: across the line of sight as wide as the cone,
  // along it longer by the obliqueness.
  const double cosine = std::max(0.01, std::abs(face.normal.dot(direction)));
  Eigen::Vector3d across = face.normal.cross(direction);
  if (across.squaredNorm() < 1e-12) across = face.normal.unitOrthogonal();
  across.normalize();
  const double width = distance * ray_angle_;
  const Eigen::Vector2d dx = face.uv_from_metres * (width * across);
  const Eigen::Vector2d dy = face.uv_from_metres * (width / cosine * face.normal.cross(across));
  const Images::Image& image = images_->of_material[face.material];
  OIIO::TextureOpt options;
  options.interpmode = OIIO::TextureOpt::InterpBilinear;  // its bicubic one blurs what is close
  options.swrap = options.twrap = OIIO::TextureOpt::WrapPeriodic;
  float rgb[3] = {0, 0, 0};
  const auto f = [](double value) { return static_cast<float>(value); };
  // Rows of an image go down, v goes up.
  const bool is_read =
      images_->system->texture(image.handle, nullptr, options, f(within.x()), f(1 - within.y()),
                               f(dx.x()), f(-dx.y()), f(dy.x()), f(-dy.y()), 3, rgb);
  if (!is_read) throw std::runtime_error("a texture: " + images_->system->geterror());
  const Eigen::Array3d albedo = Eigen::Array3f(rgb[0], rgb[1], rgb[2]).cast<double>() * image.tint;
  return albedo.max(0).min(1).matrix();
}

BumpedSurface BumpedAt(const MontageScene& scene, const SurfacePoint& surface,
                       const SpectralMaterial& material, const Eigen::Vector3d& to_viewer,
                       double distance) {
  BumpedSurface bumped{surface, material};
  if (!material.bumps) return bumped;
  const auto spread = SpreadOn(surface.normal, to_viewer, scene.ray_angle * distance);
  const BumpField::Turned turned = material.bumps->At(surface.position, surface.normal, spread);
  bumped.surface.normal = turned.normal;
  const double cosine = turned.normal.dot(to_viewer);
  if (cosine < kLeastCosine) {
    bumped.surface.normal = (turned.normal + (kLeastCosine - cosine) * to_viewer).normalized();
  }
  if (!material.specular) return bumped;
  Roughness& roughness = bumped.material.specular->roughness;
  roughness = Rougher(roughness, turned.variance);
  return bumped;
}

}  // namespace insitu
