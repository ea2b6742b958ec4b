// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "renderer/levels/avr_levels.h"
#include "renderer/levels/drawn_picture.h"

namespace insitu {
namespace {

constexpr double kWidthOfDiagonal = 1e-3;  // of a line, of the picture's diagonal
constexpr double kLeastWidth = 2;          // [px]
constexpr double kDash = 5, kGap = 4;      // line widths
constexpr double kClearance = 0.02;        // [m], and a thousandth of the distance
constexpr double kBeside = 1;              // of an edge [px]: there the building is, or is not
constexpr int kMostSteps = 4000;           // of an edge
constexpr int kSubpixelBits = 4;

using Chain = std::vector<Eigen::Vector3d>;  // [m], world

// Edges that end where the next begins, as lines: a dash goes on from one to the other.
class Chains {
 public:
  explicit Chains(const std::vector<OutlineEdge>& edges) : edges_(edges), is_used_(edges.size()) {
    for (size_t i = 0; i < edges.size(); ++i) {
      at_[KeyOf(edges[i].first)].push_back(i);
      at_[KeyOf(edges[i].second)].push_back(i);
    }
    for (size_t i = 0; i < edges.size(); ++i) {
      if (!is_used_[i]) all_.push_back(From(i));
    }
  }
  const std::vector<Chain>& all() const { return all_; }

 private:
  using Key = std::array<double, 3>;
  static Key KeyOf(const Eigen::Vector3d& point) { return {point.x(), point.y(), point.z()}; }

  // Towards both sides of an edge.
  Chain From(size_t edge) {
    is_used_[edge] = 1;
    Chain back = Onwards(edges_[edge].first), chain = Onwards(edges_[edge].second);
    std::reverse(back.begin(), back.end());
    back.insert(back.end(), chain.begin(), chain.end());
    return back;
  }

  Chain Onwards(Eigen::Vector3d point) {
    Chain chain = {point};
    while (true) {
      const auto& here = at_.at(KeyOf(point));
      const auto next =
          std::find_if(here.begin(), here.end(), [&](size_t i) { return !is_used_[i]; });
      if (next == here.end()) return chain;
      is_used_[*next] = 1;
      const auto& [first, second] = edges_[*next];
      point = KeyOf(first) == KeyOf(point) ? second : first;
      chain.push_back(point);
    }
  }

  const std::vector<OutlineEdge>& edges_;
  std::map<Key, std::vector<size_t>> at_;
  std::vector<char> is_used_;
  std::vector<Chain> all_;
};

enum class Sight { kSeen, kHidden, kNotDrawn };

class OutlineDrawing {
 public:
  explicit OutlineDrawing(const DrawnView& view)
      : view_(view),
        eye_(Center(view.camera.cam_from_world)),
        width_(std::max(kLeastWidth,
                        kWidthOfDiagonal * std::hypot(view.photo.width, view.photo.height))),
        shares_(view.photo.height, view.photo.width, CV_8U, cv::Scalar(0)) {}

  void Draw(const Chain& chain) {
    double along = 0;  // [px]
    for (size_t i = 0; i + 1 < chain.size(); ++i) DrawEdge(chain[i], chain[i + 1], &along);
  }

  Raster Shares() const {
    Raster shares(shares_.cols, shares_.rows, 1);
    for (int y = 0; y < shares_.rows; ++y) {
      for (int x = 0; x < shares_.cols; ++x) {
        *shares.At(x, y) = static_cast<float>(shares_.at<uint8_t>(y, x)) / 255;
      }
    }
    return shares;
  }

 private:
  // In steps of about a line's width, since lenses bend lines and things hide parts of them.
  void DrawEdge(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double* along) {
    const int steps = StepsOf(from, to);
    std::optional<Eigen::Vector2d> last;
    for (int i = 0; i <= steps; ++i) {
      const Eigen::Vector3d point = from + (to - from) * (static_cast<double>(i) / steps);
      const auto pixel = PixelOf(point);
      if (pixel && last) {
        const double length = (*pixel - *last).norm();
        DrawPiece(*last, *pixel, SightAt((point + PreviousOf(from, to, i, steps)) / 2),
                  *along + length / 2);
        *along += length;
      }
      last = pixel;
    }
  }

  static Eigen::Vector3d PreviousOf(const Eigen::Vector3d& from, const Eigen::Vector3d& to, int i,
                                    int steps) {
    return from + (to - from) * (static_cast<double>(i - 1) / steps);
  }

  int StepsOf(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
    const auto a = PixelOf(from), b = PixelOf(to);
    if (!a || !b) return kMostSteps;  // it may come into the frame
    return std::clamp(static_cast<int>(std::ceil((*b - *a).norm() / width_)), 1, kMostSteps);
  }

  // nullopt: behind the camera, or where the lens's model has folded back into the frame.
  std::optional<Eigen::Vector2d> PixelOf(const Eigen::Vector3d& point) const {
    constexpr double kSame = 1e-4;  // [rad]
    const Eigen::Vector3d in_cam = (view_.camera.cam_from_world * point).normalized();
    const auto pixel = view_.camera.camera.Project(in_cam);
    if (!pixel || !IsNearFrame(*pixel)) return std::nullopt;
    const Eigen::Vector3d back = view_.camera.camera.Unproject(*pixel).normalized();
    return (back - in_cam).norm() < kSame ? pixel : std::nullopt;
  }

  bool HitsBuilding(const Eigen::Vector2d& pixel) const {
    const Eigen::Vector3d direction = view_.camera.cam_from_world.rotation.inverse() *
                                      view_.camera.camera.Unproject(pixel).normalized();
    return view_.scene.artificial_rays.IsOccluded(
        {eye_ - view_.scene.natural.scene.origin, direction});
  }

  // Whether the building is on one side of a piece of line alone.
  bool IsBorder(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
    const Eigen::Vector2d along = (b - a).normalized();
    const Eigen::Vector2d aside = kBeside * Eigen::Vector2d(-along.y(), along.x());
    return HitsBuilding((a + b) / 2 + aside) != HitsBuilding((a + b) / 2 - aside);
  }

  Sight SightAt(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d to = point - eye_;
    const double distance = to.norm();
    Ray ray = {eye_ - view_.scene.natural.scene.origin, to / distance};
    ray.far = distance * (1 - 1e-3) - kClearance;
    if (ray.far <= 0) return Sight::kNotDrawn;
    if (view_.scene.artificial_rays.IsOccluded(ray)) return Sight::kNotDrawn;
    if (view_.scene.natural_rays.IsOccluded(ray)) return Sight::kHidden;
    return IsBehindForeground(point) ? Sight::kHidden : Sight::kSeen;
  }

  bool IsBehindForeground(const Eigen::Vector3d& point) const {
    const auto pixel = PixelOf(point);
    if (!view_.foreground || !pixel) return false;
    const int x = static_cast<int>(std::lround(pixel->x())),
              y = static_cast<int>(std::lround(pixel->y()));
    if (x < 0 || y < 0 || x >= view_.photo.width || y >= view_.photo.height) return false;
    return *view_.foreground->share.At(x, y) > 0.5F;
  }

  void DrawPiece(const Eigen::Vector2d& a, const Eigen::Vector2d& b, Sight sight, double along) {
    if (sight == Sight::kNotDrawn || a == b || !IsBorder(a, b)) return;
    const double period = (kDash + kGap) * width_;
    if (sight == Sight::kHidden && std::fmod(along, period) > kDash * width_) return;
    cv::line(shares_, Fixed(a), Fixed(b), cv::Scalar(255), static_cast<int>(std::lround(width_)),
             cv::LINE_AA, kSubpixelBits);
  }

  bool IsNearFrame(const Eigen::Vector2d& pixel) const {
    return pixel.x() > -width_ && pixel.y() > -width_ && pixel.x() < view_.photo.width + width_ &&
           pixel.y() < view_.photo.height + width_;
  }

  static cv::Point Fixed(const Eigen::Vector2d& pixel) {
    return {static_cast<int>(std::lround(pixel.x() * (1 << kSubpixelBits))),
            static_cast<int>(std::lround(pixel.y() * (1 << kSubpixelBits)))};
  }

  const DrawnView& view_;
  const Eigen::Vector3d eye_;  // [m], world
  const double width_;         // of a line [px]
  cv::Mat shares_;
};

}  // namespace

RenderResult DrawOutline(const DrawnView& view, const BuildingEdges& edges) {
  OutlineDrawing drawing(view);
  const std::vector<OutlineEdge> outline = edges.OutlineFrom(Center(view.camera.cam_from_world));
  const Chains chains(outline);
  for (const Chain& chain : chains.all()) drawing.Draw(chain);
  return DrawnOnto(view, drawing.Shares());
}

}  // namespace insitu
