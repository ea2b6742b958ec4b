// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment/align_tie_points.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "calibration/files/error.h"
#include "calibration/files/wording.h"
#include "reconstruction/geometry/intersection.h"

namespace insitu {
namespace {

constexpr double kLeastAngle = 0.02;   // [rad], between the rays to a control point
constexpr double kBendOfModel = 2e-3;  // of the control's extent: how far image matching drifts

struct Located {
  std::string name;
  Eigen::Vector3d model, world, world_sigma;
  double model_sigma = 0;  // in the model's unit
};

std::optional<Located> Locate(const Survey& survey, const std::map<std::string, Camera>& cameras,
                              const TiePoints& tie_points, const ControlPoint& control) {
  std::vector<PosedCamera> posed;
  std::vector<const ImageObservation*> marks;
  for (const ImageObservation& mark : survey.observations) {
    const auto pose = tie_points.cam_from_model.find(mark.photo);
    if (mark.point != control.name || pose == tie_points.cam_from_model.end()) continue;
    posed.push_back({mark.photo, cameras.at(mark.photo), pose->second});
    marks.push_back(&mark);
  }
  std::vector<Sight> sights;
  for (size_t i = 0; i < posed.size(); ++i) sights.push_back({&posed[i], marks[i]->pixel});
  const auto position = Intersect(sights, kLeastAngle);
  if (!position) return std::nullopt;
  Located located{"control point '" + control.name + "'", *position, control.position,
                  control.sigma};
  for (size_t i = 0; i < posed.size(); ++i) {  // no better than its worst ray: errs to caution
    const double distance = (*position - Center(posed[i].cam_from_world)).norm();
    const double sigma_px = std::max(marks[i]->sigma_px, tie_points.sigma_px);
    located.model_sigma =
        std::max(located.model_sigma, sigma_px / posed[i].camera.focal_px() * distance);
  }
  return located;
}

// Root mean square distance from the mean.
double Extent(const std::vector<Located>& located, Eigen::Vector3d Located::*position) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < located.size(); ++i) {
    mean += (located[i].*position - mean) / static_cast<double>(i + 1);
  }
  double squares = 0;
  for (const Located& point : located) squares += (point.*position - mean).squaredNorm();
  return std::sqrt(squares / static_cast<double>(std::max<size_t>(located.size(), 1)));
}

// Of opposite directions any half turn.
Eigen::Quaterniond ShortestTurn(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d a = from.normalized(), b = to.normalized();
  const bool opposite = a.dot(b) < -1 + 1e-12;
  const Eigen::Vector3d axis = opposite ? a.unitOrthogonal() : a.cross(b);
  const double cosine = opposite ? 0 : 1 + a.dot(b);
  return Eigen::Quaterniond(cosine, axis.x(), axis.y(), axis.z()).normalized();
}

// Fewer than three pairs: position, and with two of them scale and the direction between them.
Similarity3 AsFarAsKnown(const std::vector<SimilarityPair>& pairs) {
  Similarity3 world_from_model;
  if (pairs.empty()) return world_from_model;
  if (pairs.size() >= 2) {
    const Eigen::Vector3d source = pairs[1].source - pairs[0].source;
    const Eigen::Vector3d target = pairs[1].target - pairs[0].target;
    if (source.norm() > 0 && target.norm() > 0) {
      world_from_model.scale = target.norm() / source.norm();
      world_from_model.rotation = ShortestTurn(source, target);
    }
  }
  world_from_model.translation = pairs[0].target - world_from_model * pairs[0].source;
  return world_from_model;
}

// What stays arbitrary without a fit.
std::string DatumWarning(const ModelControl& control) {
  const size_t pairs = control.pairs.size();
  if (pairs == 0) {
    return "no control: position, orientation and scale are arbitrary, a unit is image matching's "
           "own and no metre; mark three surveyed points on two photos each, or survey three "
           "camera positions";
  }
  if (pairs == 1) {
    return "only " + control.names[0] +
           " is known: orientation and scale are arbitrary, a unit is no metre; mark two more "
           "surveyed points on two photos each";
  }
  if (pairs == 2) {
    return "only " + control.names[0] + " and " + control.names[1] +
           " are known: the rotation about the line between them is arbitrary; mark one more "
           "surveyed point on two photos";
  }
  return "the " + std::to_string(pairs) +
         " places that are known of the photos' model lie on one line or do not agree: no three of "
         "them fit; check names and coordinates, and survey a point well beside the line";
}

void WarnOfOutliers(const ModelControl& control, const SimilarityFit& fit,
                    std::vector<std::string>* warnings) {
  for (size_t i = 0; i < control.pairs.size(); ++i) {
    if (fit.is_inlier[i]) continue;
    warnings->push_back(control.names[i] + " is " + Number("%.3g m", fit.residuals[i].norm()) +
                        " from where the tie points put it, the others fit to " +
                        Number("%.2g m", fit.rms) + ": check its name, coordinates and marks");
  }
}

}  // namespace

ModelControl FindModelControl(const Survey& survey, const std::map<std::string, Camera>& cameras,
                              const TiePoints& tie_points) {
  std::vector<Located> located;
  for (const ControlPoint& point : survey.control_points) {
    if (point.role != ControlRole::kControl) continue;
    if (const auto found = Locate(survey, cameras, tie_points, point)) located.push_back(*found);
  }
  for (const CameraPosition& surveyed : survey.camera_positions) {
    const auto pose = tie_points.cam_from_model.find(surveyed.photo);
    if (pose == tie_points.cam_from_model.end()) continue;
    located.push_back({"the camera position of photo '" + surveyed.photo + "'",
                       Center(pose->second), surveyed.position, surveyed.sigma});
  }
  const double model_extent = Extent(located, &Located::model);
  const double extent = Extent(located, &Located::world);
  const double scale = model_extent > 0 ? extent / model_extent : 1;
  ModelControl control;
  for (const Located& point : located) {
    const double own = std::hypot(scale * point.model_sigma, kBendOfModel * extent);
    control.names.push_back(point.name);
    control.pairs.push_back(
        {point.model, point.world, (point.world_sigma.array().square() + own * own).sqrt()});
  }
  return control;
}

TiePointAlignment AlignTiePoints(const Survey& survey, const std::map<std::string, Camera>& cameras,
                                 TiePoints* tie_points) {
  const ModelControl control = FindModelControl(survey, cameras, *tie_points);
  TiePointAlignment alignment;
  alignment.pairs = static_cast<int>(control.pairs.size());
  alignment.fit = FitSimilarity(control.pairs);
  if (alignment.fit && alignment.fit->is_mirrored) {
    const FilePlace place = survey.control_points.empty() ? survey.camera_positions[0].place
                                                          : survey.control_points[0].place;
    throw InputError(
        place.path, 0,
        "the photographs show the mirror image of these coordinates, expected "
        "right-handed x, y, z: are x and y (east and north) swapped, or is z downward?");
  }
  if (alignment.fit) {
    alignment.world_from_model = alignment.fit->target_from_source;
    WarnOfOutliers(control, *alignment.fit, &alignment.warnings);
  } else {
    alignment.world_from_model = AsFarAsKnown(control.pairs);
    alignment.warnings.push_back(DatumWarning(control));
  }
  Transform(alignment.world_from_model, tie_points);
  return alignment;
}

void Transform(const Similarity3& target_from_model, TiePoints* tie_points) {
  for (auto& [photo, cam_from_model] : tie_points->cam_from_model) {
    cam_from_model = CamFromTarget(cam_from_model, target_from_model);
  }
  for (TiePoint& point : tie_points->points) {
    point.position = target_from_model * point.position;
  }
}

}  // namespace insitu
