// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/verdict/geometry_verdict.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "calibration/algebra/decompositions.h"
#include "calibration/files/wording.h"
#include "reconstruction/verdict/image_marks.h"

namespace insitu {
namespace {

constexpr double kSmallAngle = 5 * M_PI / 180;
constexpr double kShortBase = 0.05;      // of the distance to the points
constexpr double kNarrowControl = 0.02;  // width over length of what counts as one line
constexpr double kFewOutside = 0.1;      // of all marks
constexpr double kSmallCoverage = 0.1;

// Control points are determined by the survey; only the others depend on their rays. Tie points
// are too many to name: their numbers are in a section of their own.
void JudgeRays(const Adjustment& adjustment, const std::vector<ImageMark>& marks,
               std::vector<Finding>* findings) {
  std::set<std::string> controlled;
  for (const PointComparison& point : adjustment.control) controlled.insert(point.name);
  const std::map<std::string, double> angles = LargestRayAngles(adjustment, marks);
  std::vector<std::string> few, narrow;
  for (const AdjustedPoint& point : adjustment.points) {
    if (controlled.contains(point.name) || point.is_tie_point) continue;
    const auto angle = angles.find(point.name);
    if (point.rays < 2) few.push_back(point.name);
    if (angle != angles.end() && angle->second < kSmallAngle) narrow.push_back(point.name);
  }
  if (!few.empty()) {
    findings->push_back({Severity::kReview,
                         Listing("points on fewer than two photos, held by planes or other "
                                 "constraints alone",
                                 few),
                         "mark them on a second photo, or trust them no more than their planes"});
  }
  if (!narrow.empty()) {
    findings->push_back({Severity::kReview,
                         Listing("points whose rays meet within 5 degrees", narrow),
                         "mark them on a photo taken further aside, or take one"});
  }
}

void JudgeBase(const Adjustment& adjustment, std::vector<Finding>* findings) {
  if (adjustment.poses.size() == 1) {
    findings->push_back({Severity::kReview,
                         "one photo only: nothing but the survey and its planes tells depth",
                         "take a second photo from aside"});
  }
  if (adjustment.poses.size() < 2 || adjustment.points.empty()) return;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const AdjustedPoint& point : adjustment.points) middle += point.position;
  middle /= static_cast<double>(adjustment.points.size());
  double base = 0, distance = 0;
  for (const AdjustedPose& pose : adjustment.poses) {
    const Eigen::Vector3d center = Center(pose.cam_from_world);
    distance = std::max(distance, (center - middle).norm());
    for (const AdjustedPose& other : adjustment.poses) {
      base = std::max(base, (center - Center(other.cam_from_world)).norm());
    }
  }
  if (base >= kShortBase * distance) return;
  findings->push_back({Severity::kReview,
                       "the photos were taken from nearly one place: the longest base is " +
                           Number("%.2f", base) + " m at a distance of " +
                           Number("%.0f", distance) + " m",
                       "take photos from further aside"});
}

void JudgeControlFigure(const Adjustment& adjustment, std::vector<Finding>* findings) {
  const size_t count = adjustment.control.size();
  if (count < 3) return;  // the datum says the rest
  Eigen::Matrix3Xd points(3, count);
  for (size_t i = 0; i < count; ++i) {
    points.col(static_cast<Eigen::Index>(i)) = adjustment.control[i].surveyed;
  }
  const Eigen::Matrix3Xd centered = points.colwise() - points.rowwise().mean();
  const Eigen::Vector3d spread = EigenOfSymmetric<3>(centered * centered.transpose()).values;
  if (spread[1] > kNarrowControl * kNarrowControl * spread[2]) return;
  findings->push_back({Severity::kReview,
                       "the control points lie nearly on one line: the site can turn about it",
                       "survey control points aside of that line"});
}

void JudgeFrames(const Adjustment& adjustment, const std::vector<ImageMark>& marks,
                 const CameraContexts& cameras, std::vector<Finding>* findings) {
  std::vector<std::string> small, outside;
  size_t count = 0;
  for (const AdjustedPose& pose : adjustment.poses) {
    if (pose.coverage < kSmallCoverage) {
      small.push_back(pose.photo + " " + Number("%.0f", 100 * pose.coverage) + " %");
    }
  }
  for (const ImageMark& mark : marks) {
    const AdjustedPose& pose = adjustment.poses[mark.photo];
    const CameraContext& camera = ContextOf(cameras, pose.camera);
    if (mark.is_tie_point) continue;
    ++count;
    if (!IsCalibratedAt(camera, mark.pixel)) outside.push_back(mark.point + " on " + pose.photo);
  }
  if (!small.empty()) {
    findings->push_back({Severity::kReview,
                         Listing("photos whose marks span less than a tenth of the frame", small),
                         "spread marks over the frame, towards its corners"});
  }
  if (outside.empty()) return;
  findings->push_back(
      {outside.size() < kFewOutside * count ? Severity::kNote : Severity::kReview,
       Listing("marks where no board was photographed, so that the lens is hardly known", outside,
               3),
       "photograph boards in those parts of the frame, or mark other points"});
}

}  // namespace

void JudgeGeometry(const Adjustment& adjustment, const CameraContexts& cameras,
                   std::vector<Finding>* findings) {
  const std::vector<ImageMark> marks = ImageMarks(adjustment);
  JudgeRays(adjustment, marks, findings);
  JudgeBase(adjustment, findings);
  JudgeControlFigure(adjustment, findings);
  JudgeFrames(adjustment, marks, cameras, findings);
}

}  // namespace insitu
