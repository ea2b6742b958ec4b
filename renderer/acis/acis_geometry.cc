// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/acis/acis_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace insitu {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Kind = AcisToken::Kind;

constexpr double kLargest = 1e12;
constexpr double kSmall = 1e-9;  // of a size

// Behind the references, without the bounds of intervals ("F 3.1", or "I" for none).
std::vector<double> ValuesOf(const AcisRecord& record) {
  size_t first = 0;
  for (size_t i = 0; i < record.tokens.size(); ++i) {
    if (record.tokens[i].kind == Kind::kReference) first = i + 1;
  }
  std::vector<double> values;
  for (size_t i = first; i < record.tokens.size(); ++i) {
    const AcisToken& token = record.tokens[i];
    const bool is_bounded = (token.kind == Kind::kWord && token.word == "F") ||
                            (token.kind == Kind::kFlag && token.number == 1);
    if (is_bounded && i + 1 < record.tokens.size() && record.tokens[i + 1].kind == Kind::kNumber) {
      ++i;
    } else if (token.kind == Kind::kNumber) {
      values.push_back(token.number);
    }
  }
  return values;
}

bool AreSound(const std::vector<double>& values, size_t count) {
  if (values.size() < count) return false;
  return std::ranges::all_of(values, [](double v) { return std::abs(v) <= kLargest; });
}

Vector3d VectorAt(const std::vector<double>& values, size_t first) {
  return {values[first], values[first + 1], values[first + 2]};
}

// nullopt: directions without a length.
std::optional<Eigen::Matrix3d> AxesOf(const Vector3d& z, const Vector3d& x) {
  if (!(z.norm() > 0)) return std::nullopt;
  const Vector3d axis = z.normalized();
  Vector3d across = x - axis.dot(x) * axis;
  if (!(across.norm() > kSmall * x.norm()) || !(x.norm() > 0)) across = axis.unitOrthogonal();
  Eigen::Matrix3d axes;
  axes.col(0) = across.normalized();
  axes.col(2) = axis;
  axes.col(1) = axis.cross(axes.col(0));
  return axes;
}

std::optional<AcisSurface> ConeOf(const std::vector<double>& values) {
  if (!AreSound(values, 12)) return std::nullopt;
  const Vector3d major = VectorAt(values, 6);
  const auto axes = AxesOf(VectorAt(values, 3), major);
  const double cosine = values[11];
  if (!axes || !(major.norm() > 0) || !(values[9] > 0) || cosine == 0) return std::nullopt;
  AcisSurface cone{AcisSurface::Kind::kCone, VectorAt(values, 0), *axes};
  cone.radius = major.norm();
  cone.ratio = values[9];
  cone.slope = values[10] / std::abs(cosine);
  cone.looks_inwards = cosine < 0;
  return cone;
}

std::optional<AcisSurface> SphereOf(const std::vector<double>& values) {
  if (!AreSound(values, 4) || values[3] == 0) return std::nullopt;
  AcisSurface sphere{AcisSurface::Kind::kSphere, VectorAt(values, 0)};
  sphere.radius = std::abs(values[3]);
  sphere.looks_inwards = values[3] < 0;
  return sphere;
}

// One that meets itself is left.
std::optional<AcisSurface> TorusOf(const std::vector<double>& values) {
  if (!AreSound(values, 8)) return std::nullopt;
  const auto axes =
      AxesOf(VectorAt(values, 3), values.size() < 11 ? Vector3d::Zero() : VectorAt(values, 8));
  if (!axes || values[7] == 0 || values[6] <= std::abs(values[7])) return std::nullopt;
  AcisSurface torus{AcisSurface::Kind::kTorus, VectorAt(values, 0), *axes};
  torus.radius = values[6];
  torus.tube = std::abs(values[7]);
  torus.looks_inwards = values[7] < 0;
  return torus;
}

}  // namespace

Vector3d AcisSurface::PointAt(const Vector2d& uv) const {
  const double c = std::cos(uv.x()), s = std::sin(uv.x());
  Vector3d local(c, s, 0);
  if (kind == Kind::kCone) {
    const double across = radius + slope * uv.y();
    local = {across * c, across * ratio * s, uv.y()};
  } else if (kind == Kind::kSphere) {
    local = radius * Vector3d(std::cos(uv.y()) * c, std::cos(uv.y()) * s, std::sin(uv.y()));
  } else if (kind == Kind::kTorus) {
    const double across = radius + tube * std::cos(uv.y());
    local = {across * c, across * s, tube * std::sin(uv.y())};
  }
  return origin + axes * local;
}

Vector2d AcisSurface::ParametersOf(const Vector3d& point) const {
  const Vector3d local = axes.transpose() * (point - origin);
  const double across = local.head<2>().norm();
  const double u = std::atan2(local.y() / ratio, local.x());
  if (kind == Kind::kSphere) return {u, std::atan2(local.z(), across)};
  if (kind == Kind::kTorus) return {u, std::atan2(local.z(), across - radius)};
  return {u, local.z()};
}

bool AcisSurface::IsPole(const Vector3d& point) const {
  if (kind != Kind::kCone && kind != Kind::kSphere) return false;
  const Vector3d local = axes.transpose() * (point - origin);
  return local.head<2>().norm() < 1e-6 * radius;
}

double AcisSurface::DistanceTo(const Vector3d& point) const {
  if (kind == Kind::kPlane) return std::abs(axes.col(2).dot(point - origin));
  return (PointAt(ParametersOf(point)) - point).norm();
}

std::optional<AcisSurface> AcisSurfaceOf(const AcisRecord& record) {
  const std::vector<double> values = ValuesOf(record);
  if (record.type == "cone-surface") return ConeOf(values);
  if (record.type == "sphere-surface") return SphereOf(values);
  if (record.type == "torus-surface") return TorusOf(values);
  if (record.type != "plane-surface" || !AreSound(values, 6)) return std::nullopt;
  const auto axes = AxesOf(VectorAt(values, 3), Vector3d::Zero());
  if (!axes) return std::nullopt;
  return AcisSurface{AcisSurface::Kind::kPlane, VectorAt(values, 0), *axes};
}

Vector3d AcisEllipse::PointAt(double angle) const {
  return center + std::cos(angle) * x + std::sin(angle) * y;
}

double AcisEllipse::AngleOf(const Vector3d& point) const {
  const Vector3d way = point - center;
  return std::atan2(way.dot(y) / y.squaredNorm(), way.dot(x) / x.squaredNorm());
}

std::optional<AcisEllipse> AcisEllipseOf(const AcisRecord& record) {
  const std::vector<double> values = ValuesOf(record);
  if (record.type != "ellipse-curve" || !AreSound(values, 10)) return std::nullopt;
  const Vector3d normal = VectorAt(values, 3), x = VectorAt(values, 6);
  if (!(normal.norm() > 0) || !(x.norm() > 0) || values[9] == 0) return std::nullopt;
  return AcisEllipse{VectorAt(values, 0), x, values[9] * normal.normalized().cross(x)};
}

std::optional<Vector3d> AcisPointOf(const AcisRecord& record) {
  const std::vector<double> values = ValuesOf(record);
  if (!AreSound(values, 3)) return std::nullopt;
  return VectorAt(values, 0);
}

// Rows times a point, a scale, a shift.
std::optional<Eigen::Affine3d> AcisTransformOf(const AcisRecord& record) {
  constexpr size_t kNumbers = 13;
  const std::vector<double> values = ValuesOf(record);
  if (!AreSound(values, kNumbers)) return std::nullopt;
  const size_t first = values.size() - kNumbers;
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  for (size_t row = 0; row < 3; ++row) {
    const Vector3d image = values[first + 12] * VectorAt(values, first + 3 * row);
    transform.linear().col(static_cast<Eigen::Index>(row)) = image;
  }
  transform.translation() = VectorAt(values, first + 9);
  if (std::abs(transform.linear().determinant()) < 1e-30) return std::nullopt;
  return transform;
}

bool IsAcisReversed(const AcisRecord& record, size_t index) {
  if (index + 1 < record.tokens.size() && record.tokens[index + 1].kind == Kind::kNumber) {
    return record.tokens[index + 1].number == 1;  // of ACIS 1
  }
  for (size_t i = index + 1; i < record.tokens.size(); ++i) {
    const AcisToken& token = record.tokens[i];
    if (token.kind == Kind::kFlag) return token.number == 1;
    if (token.kind == Kind::kWord) return token.word == "reversed";
  }
  return false;
}

double ChordAngle(double radius, double tolerance) {
  constexpr double kFullTurn = 2 * std::numbers::pi;
  const double sagitta = std::min(tolerance / radius, 1.0);
  return std::clamp(2 * std::acos(1 - sagitta), kFullTurn / 1024, kFullTurn / 24);
}

Eigen::Matrix3d AxesAwayFrom(const std::vector<Vector3d>& directions) {
  double best = -1;
  Vector3d axis = Vector3d::UnitZ();
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = 0; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const Vector3d candidate = Vector3d(x, y, z).normalized();
        double nearest = 0;
        for (const Vector3d& d : directions)
          nearest = std::max(nearest, std::abs(candidate.dot(d)));
        if (1 - nearest <= best + 1e-9) continue;
        best = 1 - nearest;
        axis = candidate;
      }
    }
  }
  Eigen::Matrix3d axes;
  axes.col(2) = axis;
  axes.col(0) = axis.unitOrthogonal();
  axes.col(1) = axis.cross(axes.col(0));
  return axes;
}

}  // namespace insitu
