// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment/align_tie_points.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "calibration/files/error.h"
#include "calibration/files/wording.h"
#include "reconstruction/colmap/upright_model.h"
#include "reconstruction/geometry/intersection.h"

namespace insitu {
namespace {

constexpr double kLeastAngle = 0.02;   // [rad], between the rays to a control point
constexpr double kBendOfModel = 2e-3;  // of the control's extent: how far image matching drifts

constexpr char kControlPoint[] = "control point ";

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
  Located located{std::string(kControlPoint) + "'" + control.name + "'", *position,
                  control.position, control.sigma};
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

// Fewer than three pairs: position, and with two of them scale and the direction between them; the
// rest from what else is stated.
Similarity3 AsFarAsKnown(const std::vector<SimilarityPair>& pairs, const UprightModel& upright) {
  Similarity3 world_from_model = upright.world_from_model;
  if (pairs.empty()) return world_from_model;
  if (pairs.size() >= 2) {
    const Eigen::Vector3d source = pairs[1].source - pairs[0].source;
    const Eigen::Vector3d target = pairs[1].target - pairs[0].target;
    if (source.norm() > 0 && target.norm() > 0) {
      world_from_model.scale = target.norm() / source.norm();
      const Eigen::Quaterniond up = upright.world_from_model.rotation;
      world_from_model.rotation = ShortestTurn(up * source, target) * up;
    }
  }
  world_from_model.translation = pairs[0].target - world_from_model * pairs[0].source;
  return world_from_model;
}

// Places that tell no tilt, as satellite positions on a line do: plumb by what else is stated, then
// turned about the zenith and scaled to fit in plan.
Similarity3 LevelFit(const std::vector<SimilarityPair>& pairs, const UprightModel& upright) {
  Similarity3 fit = upright.world_from_model;
  Eigen::Vector3d source = Eigen::Vector3d::Zero(), target = Eigen::Vector3d::Zero();
  for (const SimilarityPair& pair : pairs) {
    source += pair.source / static_cast<double>(pairs.size());
    target += pair.target / static_cast<double>(pairs.size());
  }
  double along = 0, across = 0, squares = 0;
  for (const SimilarityPair& pair : pairs) {
    const Eigen::Vector2d s = (fit.rotation * (pair.source - source)).head<2>();
    const Eigen::Vector2d t = (pair.target - target).head<2>();
    along += s.dot(t);
    across += s.x() * t.y() - s.y() * t.x();
    squares += s.squaredNorm();
  }
  const Eigen::AngleAxisd heading(std::atan2(across, along), Eigen::Vector3d::UnitZ());
  fit.rotation = heading * fit.rotation;
  if (upright.lengths == 0 && squares > 0) fit.scale = std::hypot(along, across) / squares;
  if (!(fit.scale > 0)) fit.scale = 1;
  fit.translation = target - fit.scale * (fit.rotation * source);
  return fit;
}

// Whether no surveyed point is among what is known, and the tilt that is fitted means nothing.
bool NeedsLevelFit(const ModelControl& control, const std::optional<SimilarityFit>& fit) {
  constexpr double kUncertainTilt = 0.1;  // [rad]
  const bool has_points = std::ranges::any_of(
      control.names, [](const std::string& name) { return name.starts_with(kControlPoint); });
  if (control.pairs.size() < 3 || has_points) return false;
  if (!fit) return true;
  const double tilt = std::sqrt(std::max(fit->covariance(0, 0), fit->covariance(1, 1)));
  return fit->sigma0 * tilt > kUncertainTilt;
}

// "orientation and scale are arbitrary, a unit is no metre", as far as nothing else is stated.
std::string Arbitrary(const std::string& before, const UprightModel& upright) {
  std::string text = before + (upright.plumb > 0 ? "heading" : "orientation");
  if (upright.lengths == 0) text += " and scale";
  const bool is_one = before.empty() && upright.lengths > 0;
  text += is_one ? " is arbitrary" : " are arbitrary";
  if (upright.lengths == 0) text += ", a unit is image matching's own and no metre";
  text += upright.plumb > 0
              ? "; turned upright by " + std::to_string(upright.plumb) + " plumb or level lines"
              : "; turned upright as the cameras were held";
  if (upright.lengths > 0) {
    text += "; scale by " + std::to_string(upright.lengths) +
            (upright.lengths == 1 ? " length" : " lengths");
  }
  return text;
}

// What stays arbitrary without a fit.
std::string DatumWarning(const ModelControl& control, const UprightModel& upright) {
  const size_t pairs = control.pairs.size();
  if (pairs == 0) {
    return "no control: " +
           Arbitrary(upright.lengths > 0 ? "position and " : "position, ", upright) +
           "; mark three surveyed points on two photos each, or survey three camera positions";
  }
  if (pairs == 1) {
    return "only " + control.names[0] + " is known: " + Arbitrary("", upright) +
           "; mark two more surveyed points on two photos each";
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
  if (NeedsLevelFit(control, alignment.fit)) {
    alignment.fit.reset();
    alignment.world_from_model = LevelFit(control.pairs, FindUpright(survey, cameras, *tie_points));
    Transform(alignment.world_from_model, tie_points);
    return alignment;
  }
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
    const UprightModel upright = FindUpright(survey, cameras, *tie_points);
    alignment.world_from_model = AsFarAsKnown(control.pairs, upright);
    alignment.warnings.push_back(DatumWarning(control, upright));
    if (upright.is_contradictory) {
      alignment.warnings.emplace_back(
          "the distances or heights of constraints.json contradict each other in scale by over a "
          "tenth: check their values and points");
    }
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
