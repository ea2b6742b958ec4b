// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/preview/preview_image.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "renderer/building/shown_environment.h"

namespace insitu {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr int kOversampling = 2;  // each way

// Rows: right, up, towards the viewer.
Matrix3d ViewFromWorld() {
  const double turn = -std::numbers::pi / 4 - 0.12, above = std::numbers::pi / 6;
  const Vector3d to_viewer(std::sin(turn) * std::cos(above), -std::cos(turn) * std::cos(above),
                           std::sin(above));
  const Vector3d right = Vector3d::UnitZ().cross(to_viewer).normalized();
  Matrix3d view;
  view.row(0) = right.transpose();
  view.row(1) = to_viewer.cross(right).transpose();
  view.row(2) = to_viewer.transpose();
  return view;
}

struct Fragment {
  float depth = -std::numeric_limits<float>::infinity();  // greater is nearer
  int triangle = -1;
};

class Canvas {
 public:
  Canvas(const ArtificialEnvironment& building, int width, int height)
      : building_(building),
        width_(width),
        height_(height),
        fragments_(static_cast<size_t>(width) * height),
        view_(ViewFromWorld()) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& vertex : building.vertices) box.extend(view_ * vertex);
    center_ = box.center();
    const Vector3d size = box.sizes().cwiseMax(1e-9);
    constexpr double kFilled = 0.92;
    scale_ = kFilled * std::min(width / size.x(), height / size.y());
  }

  void DrawAll() {
    for (size_t t = 0; t < building_.triangles.size(); ++t) Draw(static_cast<int>(t));
  }

  Vector3f Color(int x, int y) const {
    const Fragment& fragment = At(x, y);
    if (fragment.triangle < 0) return Vector3f(0.83f, 0.86f, 0.9f);
    Vector3f color = Shade(fragment.triangle);
    if (IsEdge(x, y)) color *= 0.45f;
    return color;
  }

 private:
  const Fragment& At(int x, int y) const { return fragments_[static_cast<size_t>(y) * width_ + x]; }

  Vector3f Projected(int vertex) const {
    const Vector3d v = (view_ * building_.vertices[vertex] - center_) * scale_;
    return {static_cast<float>(v.x() + width_ / 2.0), static_cast<float>(height_ / 2.0 - v.y()),
            static_cast<float>(v.z())};
  }

  void Draw(int t) {
    const Eigen::Vector3i& corners = building_.triangles[t];
    const Vector3f a = Projected(corners[0]), b = Projected(corners[1]), c = Projected(corners[2]);
    const float area = (b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y());
    if (!(std::abs(area) > 1e-9f)) return;
    const auto low = [](float v) { return static_cast<int>(std::floor(v)); };
    const int x0 = std::max(0, low(std::min({a.x(), b.x(), c.x()})));
    const int x1 = std::min(width_ - 1, low(std::max({a.x(), b.x(), c.x()})) + 1);
    const int y0 = std::max(0, low(std::min({a.y(), b.y(), c.y()})));
    const int y1 = std::min(height_ - 1, low(std::max({a.y(), b.y(), c.y()})) + 1);
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const float px = static_cast<float>(x), py = static_cast<float>(y);
        const float u = ((px - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (py - a.y())) / area;
        const float v = ((b.x() - a.x()) * (py - a.y()) - (px - a.x()) * (b.y() - a.y())) / area;
        if (u < 0 || v < 0 || u + v > 1) continue;
        const float depth = a.z() + u * (b.z() - a.z()) + v * (c.z() - a.z());
        Fragment& fragment = fragments_[static_cast<size_t>(y) * width_ + x];
        if (depth > fragment.depth) fragment = {depth, t};
      }
    }
  }

  Vector3d Normal(int t) const {
    const Eigen::Vector3i& corners = building_.triangles[t];
    const Vector3d& a = building_.vertices[corners[0]];
    const Vector3d normal =
        (building_.vertices[corners[1]] - a).cross(building_.vertices[corners[2]] - a).normalized();
    return normal.dot(view_.row(2).transpose()) < 0 ? Vector3d(-normal) : normal;
  }

  Vector3f Shade(int t) const {
    const Vector3d to_sun = Vector3d(-0.1, -0.75, 0.65).normalized();
    const Vector3d normal = Normal(t);
    const double light = 0.28 + 0.12 * normal.z() + 0.75 * std::max(0.0, normal.dot(to_sun));
    const SurfaceMaterial& material = building_.materials[building_.material_of_triangle[t]];
    Vector3d albedo = material.diffuse_rgb;
    if (material.specular && material.specular->weight > 0.3) {  // what it would mirror: sky
      albedo = 0.5 * albedo + 0.5 * Vector3d(0.35, 0.5, 0.65);
    }
    return (albedo * light).cast<float>();
  }

  bool IsEdge(int x, int y) const {
    const Fragment& here = At(x, y);
    for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(0, 1)}) {
      if (x + dx >= width_ || y + dy >= height_) continue;
      const Fragment& there = At(x + dx, y + dy);
      if (there.triangle == here.triangle) continue;
      if (there.triangle < 0) return true;
      if (Normal(here.triangle).dot(Normal(there.triangle)) < 0.8) return true;
      if (std::abs(here.depth - there.depth) > 12) return true;
    }
    return false;
  }

  const ArtificialEnvironment& building_;
  int width_, height_;
  std::vector<Fragment> fragments_;
  Matrix3d view_;
  Vector3d center_ = Vector3d::Zero();
  double scale_ = 1;
};

}  // namespace

Raster PreviewImage(const ArtificialEnvironment& building, int width, int height) {
  if (!building.spheres.empty()) {
    return PreviewImage(Faceted(building, kDrawnSphereLevel), width, height);
  }
  Canvas canvas(building, width * kOversampling, height * kOversampling);
  canvas.DrawAll();
  Raster picture(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      Vector3f sum = Vector3f::Zero();
      for (int i = 0; i < kOversampling * kOversampling; ++i) {
        sum += canvas.Color(x * kOversampling + i % kOversampling,
                            y * kOversampling + i / kOversampling);
      }
      Vector3f::Map(picture.At(x, y)) = sum / (kOversampling * kOversampling);
    }
  }
  return picture;
}

}  // namespace insitu
