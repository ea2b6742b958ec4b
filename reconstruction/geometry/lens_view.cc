// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/geometry/lens_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace insitu {
namespace {

constexpr int kGrid = 16;              // cells of the frame along a side, whose corners are asked
constexpr double kArcStep = 0.05;      // [rad], at most
constexpr double kSamePixel = 1e-6;    // [px]
constexpr int kMostHalvings = 12;      // of a step, to follow a bend
constexpr int kBorderHalvings = 40;    // to find where the frame ends
constexpr double kBeyondReach = 1e-9;  // of a cosine, for rounding

// Whether the model is not turned inside out at a point in the camera frame.
bool IsUpright(const Eigen::Matrix<double, 2, 3>& pixel_from_point) {
  return pixel_from_point.leftCols<2>().determinant() > 0;
}

// Follows a curve over t in [0, 1] through the frame.
class CurveTracer {
 public:
  using Pixel = std::optional<Eigen::Vector2d>;
  CurveTracer(std::function<Pixel(double)> pixel_at, double tolerance_px)
      : pixel_at_(std::move(pixel_at)), tolerance_px_(tolerance_px) {}

  std::vector<Polyline> Trace(int steps) {
    double last = 0;
    Pixel last_pixel = pixel_at_(0);
    if (last_pixel) pieces_.push_back({*last_pixel});
    for (int i = 1; i <= steps; ++i) {
      const double next = static_cast<double>(i) / steps;
      const Pixel pixel = pixel_at_(next);
      Step(last, last_pixel, next, pixel);
      last = next;
      last_pixel = pixel;
    }
    std::erase_if(pieces_, [](const Polyline& piece) { return piece.size() < 2; });
    return std::move(pieces_);
  }

 private:
  void Step(double last, const Pixel& last_pixel, double next, const Pixel& pixel) {
    if (last_pixel && pixel) {
      Follow(last, *last_pixel, next, *pixel, 0);
    } else if (last_pixel) {
      const auto [t, border] = Border(last, *last_pixel, next);
      Follow(last, *last_pixel, t, border, 0);
    } else if (pixel) {
      const auto [t, border] = Border(next, *pixel, last);
      pieces_.push_back({border});
      Follow(t, border, next, *pixel, 0);
    }
  }

  // The last visible place on the way from a visible to an invisible one.
  std::pair<double, Eigen::Vector2d> Border(double visible, Eigen::Vector2d at,
                                            double invisible) const {
    for (int i = 0; i < kBorderHalvings; ++i) {
      const double middle = 0.5 * (visible + invisible);
      const Pixel pixel = pixel_at_(middle);
      (pixel ? visible : invisible) = middle;
      if (pixel) at = *pixel;
    }
    return {visible, at};
  }

  // Appends what leads from a pixel, which is there already, to another.
  void Follow(double from, const Eigen::Vector2d& a, double to, const Eigen::Vector2d& b,
              int halvings) {
    const double middle = 0.5 * (from + to);
    const Pixel pixel = pixel_at_(middle);
    if (pixel && halvings < kMostHalvings && Deviation(a, b, *pixel) > tolerance_px_) {
      Follow(from, a, middle, *pixel, halvings + 1);
      Follow(middle, *pixel, to, b, halvings + 1);
    } else if ((b - a).norm() > kSamePixel) {
      pieces_.back().push_back(b);
    }
  }

  static double Deviation(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                          const Eigen::Vector2d& pixel) {
    const Eigen::Vector2d chord = b - a, offset = pixel - a;
    const double length = chord.norm();
    if (length < kSamePixel) return offset.norm();
    return std::abs(chord.x() * offset.y() - chord.y() * offset.x()) / length;
  }

  std::function<Pixel(double)> pixel_at_;
  double tolerance_px_;
  std::vector<Polyline> pieces_;
};

}  // namespace

LensView::LensView(const Camera& camera) : camera_(camera), least_cosine_(1) {
  for (int i = 0; i <= kGrid; ++i) {
    for (int k = 0; k <= kGrid; ++k) {
      const Eigen::Vector2d pixel(camera.width() * i / double{kGrid} - 0.5,
                                  camera.height() * k / double{kGrid} - 0.5);
      const Eigen::Vector3d sight = camera.Unproject(pixel);
      if (!sight.allFinite()) continue;
      Eigen::Matrix<double, 2, 3> pixel_from_point;
      const auto again = camera.Project(sight, &pixel_from_point);
      if (!again || (*again - pixel).norm() > 0.01 || !IsUpright(pixel_from_point)) continue;
      least_cosine_ = std::min(least_cosine_, sight.z());
    }
  }
}

std::optional<Eigen::Vector2d> LensView::PixelOf(const Eigen::Vector3d& in_cam) const {
  if (!(in_cam.z() > 0) || in_cam.z() < (least_cosine_ - kBeyondReach) * in_cam.norm()) {
    return std::nullopt;
  }
  Eigen::Matrix<double, 2, 3> pixel_from_point;
  const auto pixel = camera_.Project(in_cam, &pixel_from_point);
  if (!pixel || !camera_.Sees(*pixel) || !IsUpright(pixel_from_point)) return std::nullopt;
  return pixel;
}

std::vector<Polyline> ImageOfArc(const LensView& view, const Eigen::Vector3d& from,
                                 const Eigen::Vector3d& to, double tolerance_px) {
  const Eigen::Vector3d start = from.normalized(), end = to.normalized();
  const double sine = start.cross(end).norm(), angle = std::atan2(sine, start.dot(end));
  if (!(sine > 1e-12)) return {};
  const Eigen::Vector3d across = (end - start.dot(end) * start).normalized();
  const int steps = std::max(2, static_cast<int>(std::ceil(angle / kArcStep)));
  return CurveTracer(
             [&](double t) {
               return view.PixelOf(std::cos(t * angle) * start + std::sin(t * angle) * across);
             },
             tolerance_px)
      .Trace(steps);
}

std::vector<Polyline> ImageOfOutline(const LensView& view, const Rigid3& cam_from_world,
                                     const std::vector<Eigen::Vector3d>& vertices,
                                     double tolerance_px) {
  std::vector<Eigen::Vector3d> in_cam;
  for (const Eigen::Vector3d& vertex : vertices) {
    in_cam.push_back(cam_from_world.rotation * (vertex - Center(cam_from_world)));
  }
  std::vector<Polyline> pieces;
  for (size_t i = 0; i < in_cam.size(); ++i) {
    for (Polyline& piece :
         ImageOfArc(view, in_cam[i], in_cam[(i + 1) % in_cam.size()], tolerance_px)) {
      const bool is_next = !pieces.empty() && (pieces.back().back() - piece[0]).norm() < 1e-3;
      if (is_next) {
        pieces.back().insert(pieces.back().end(), piece.begin() + 1, piece.end());
      } else {
        pieces.push_back(std::move(piece));
      }
    }
  }
  return pieces;
}

}  // namespace insitu
