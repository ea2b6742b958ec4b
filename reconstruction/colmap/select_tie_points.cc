// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/colmap/select_tie_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "calibration/files/error.h"

namespace insitu {
namespace {

constexpr double kLeastSigmaPx = 0.1;       // no feature is found better
constexpr double kSmallestLimitPx = 1;      // what a mark may always be off
constexpr double kRayleighMedian = 1.1774;  // median of |(vx, vy)| for sigma 1 on each axis

double Residual(const std::map<std::string, Camera>& cameras, const TiePoints& tie_points,
                const Eigen::Vector3d& position, const TiePointMark& mark) {
  const Camera& camera = cameras.at(mark.photo);
  const auto pixel = camera.Project(tie_points.cam_from_model.at(mark.photo) * position);
  if (!pixel || !camera.Sees(mark.pixel)) return std::numeric_limits<double>::infinity();
  return (*pixel - mark.pixel).norm();
}

// A point with the residual of each of its marks [px].
struct JudgedPoint {
  TiePoint point;
  std::vector<double> residuals;
};

std::vector<JudgedPoint> Judged(const std::map<std::string, Camera>& cameras,
                                const TiePoints& tie_points) {
  std::vector<JudgedPoint> judged;
  for (const TiePoint& point : tie_points.points) {
    judged.push_back({point, {}});
    for (const TiePointMark& mark : point.marks) {
      judged.back().residuals.push_back(Residual(cameras, tie_points, point.position, mark));
    }
  }
  return judged;
}

double ResidualLimit(const std::vector<JudgedPoint>& points, double limit_sigma) {
  std::vector<double> residuals;
  for (const JudgedPoint& point : points) {
    residuals.insert(residuals.end(), point.residuals.begin(), point.residuals.end());
  }
  if (residuals.empty()) return kSmallestLimitPx;
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  const double sigma = *middle / kRayleighMedian;
  return std::max(kSmallestLimitPx, limit_sigma * sigma);
}

// Marks over the limit go, and of several on one photo all but the best.
int DropMarks(double limit_px, JudgedPoint* judged) {
  std::vector<size_t> order(judged->point.marks.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return judged->residuals[a] < judged->residuals[b]; });
  JudgedPoint kept{{judged->point.position, {}}, {}};
  std::set<std::string> photos;
  for (const size_t i : order) {
    const TiePointMark& mark = judged->point.marks[i];
    if (judged->residuals[i] > limit_px || !photos.insert(mark.photo).second) continue;
    kept.point.marks.push_back(mark);
    kept.residuals.push_back(judged->residuals[i]);
  }
  const int dropped = static_cast<int>(order.size() - kept.residuals.size());
  *judged = kept;
  return dropped;
}

double LargestAngle(const TiePoints& tie_points, const TiePoint& point) {
  std::vector<Eigen::Vector3d> rays;
  for (const TiePointMark& mark : point.marks) {
    const Eigen::Vector3d center = Center(tie_points.cam_from_model.at(mark.photo));
    rays.push_back((point.position - center).normalized());
  }
  double largest = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    for (size_t k = i + 1; k < rays.size(); ++k) {
      largest = std::max(largest, std::atan2(rays[i].cross(rays[k]).norm(), rays[i].dot(rays[k])));
    }
  }
  return largest;
}

double SquareSum(const JudgedPoint& point) {
  double sum = 0;
  for (const double residual : point.residuals) sum += residual * residual;
  return sum;
}

// Counts points in the cells of each photo.
class Cells {
 public:
  Cells(const std::map<std::string, Camera>& cameras, const TiePointSelection& selection)
      : cameras_(cameras), selection_(selection) {
    const double cells = selection.columns * selection.rows;
    points_per_cell_ = static_cast<int>(std::ceil(selection.points_per_photo / cells));
  }

  // Takes the point if none of its photos is full and it fills a gap in one.
  bool Take(const TiePoint& point) {
    bool fills_gap = selection_.points_per_photo == 0;
    for (const TiePointMark& mark : point.marks) {
      const bool is_full = in_photo_[mark.photo] >= selection_.points_per_photo;
      if (is_full && selection_.points_per_photo > 0) return false;
      fills_gap = fills_gap || CountOf(mark) < points_per_cell_;
    }
    if (!fills_gap) return false;
    for (const TiePointMark& mark : point.marks) {
      in_photo_[mark.photo] += 1;
      CountOf(mark) += 1;
    }
    return true;
  }

 private:
  int& CountOf(const TiePointMark& mark) {
    const Camera& camera = cameras_.at(mark.photo);
    const auto cell = [](double x, int size, int cells) {  // the frame's far edge is the last one's
      return std::min(static_cast<int>((x + 0.5) / size * cells), cells - 1);
    };
    const int column = cell(mark.pixel.x(), camera.width(), selection_.columns);
    const int row = cell(mark.pixel.y(), camera.height(), selection_.rows);
    return in_cell_[{mark.photo, row * selection_.columns + column}];
  }

  const std::map<std::string, Camera>& cameras_;
  const TiePointSelection& selection_;
  int points_per_cell_ = 0;
  std::map<std::string, int> in_photo_;
  std::map<std::pair<std::string, int>, int> in_cell_;
};

// Of one coordinate, from the residuals of an adjustment of these photos and points alone.
double SigmaPx(const std::vector<JudgedPoint>& points, size_t photos) {
  double squares = 0, redundancy = 7 - 6.0 * static_cast<double>(photos);
  for (const JudgedPoint& point : points) {
    squares += SquareSum(point);
    redundancy += 2.0 * static_cast<double>(point.residuals.size()) - 3;
  }
  return redundancy > 0 ? std::max(kLeastSigmaPx, std::sqrt(squares / redundancy)) : 1;
}

}  // namespace

void TiePointSelection::Check() const {
  INSITU_CHECK(points_per_photo >= 0);
  INSITU_CHECK(columns > 0);
  INSITU_CHECK(rows > 0);
  INSITU_CHECK(min_angle >= 0);
  INSITU_CHECK(limit_sigma > 0);
}

TiePointCounts SelectTiePoints(const std::map<std::string, Camera>& cameras,
                               const TiePointSelection& selection, TiePoints* tie_points) {
  selection.Check();
  TiePointCounts counts;
  counts.found = static_cast<int>(tie_points->points.size());
  std::vector<JudgedPoint> points = Judged(cameras, *tie_points);
  const double limit_px = ResidualLimit(points, selection.limit_sigma);
  std::vector<JudgedPoint> good;
  for (JudgedPoint& point : points) {
    counts.marks_off += DropMarks(limit_px, &point);
    if (point.point.marks.size() < 2) {
      counts.too_few_rays += 1;
    } else if (LargestAngle(*tie_points, point.point) < selection.min_angle) {
      counts.weak_angle += 1;
    } else {
      good.push_back(point);
    }
  }
  std::stable_sort(good.begin(), good.end(), [](const JudgedPoint& a, const JudgedPoint& b) {
    if (a.residuals.size() != b.residuals.size()) return a.residuals.size() > b.residuals.size();
    return SquareSum(a) < SquareSum(b);
  });
  Cells cells(cameras, selection);
  const auto crowded = std::stable_partition(
      good.begin(), good.end(), [&](const JudgedPoint& point) { return cells.Take(point.point); });
  counts.crowded = static_cast<int>(good.end() - crowded);
  good.erase(crowded, good.end());
  tie_points->points.clear();
  for (const JudgedPoint& point : good) tie_points->points.push_back(point.point);
  tie_points->sigma_px = SigmaPx(good, tie_points->cam_from_model.size());
  counts.kept = static_cast<int>(good.size());
  return counts;
}

}  // namespace insitu
