// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment/adjust.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "calibration/files/error.h"
#include "calibration/files/wording.h"
#include "reconstruction/adjustment/adjusted_observations.h"
#include "reconstruction/adjustment/adjusted_scene.h"
#include "reconstruction/adjustment/adjusted_unknowns.h"
#include "reconstruction/adjustment/find_start_values.h"
#include "reconstruction/adjustment/planarity.h"
#include "reconstruction/adjustment/plane_effect.h"
#include "reconstruction/adjustment/solve_survey.h"
#include "reconstruction/diagnosis/survey_diagnosis.h"

namespace insitu {
namespace {

// Root mean square of differences over their sigmas.
double RmsOverSigma(const std::vector<PointComparison>& comparisons) {
  double squares = 0;
  for (const PointComparison& point : comparisons) {
    squares += point.difference.cwiseQuotient(point.sigma).squaredNorm();
  }
  return comparisons.empty() ? 0 : std::sqrt(squares / (3.0 * comparisons.size()));
}

std::map<std::string, StartPoint> JudgedPoints(const std::vector<AdjustedPoint>& points) {
  std::map<std::string, StartPoint> judged;
  for (const AdjustedPoint& point : points) judged[point.name] = {point.position, 0};
  return judged;
}

void WarnOfMasks(const Survey& survey, Adjustment* adjustment) {
  for (const PolygonOutline& polygon : survey.polygons) {
    if (!polygon.mask || polygon.photo) continue;
    adjustment->warnings.push_back("polygon '" + polygon.name +
                                   "': its mask is not used, for it has no photo, in whose frame "
                                   "a mask lies");
  }
}

// A control point that took no part although it lies where a point without coordinates is.
void WarnOfMisnamedControl(const Survey& survey, const std::vector<Diagnosis>& diagnoses,
                           Adjustment* adjustment) {
  constexpr double kSamePlace = 0.05;       // [m], besides their sigmas
  std::set<std::string> surveyed, settled;  // settled: used, or told of already
  for (const ControlPoint& point : survey.control_points) surveyed.insert(point.name);
  for (const AdjustedPoint& point : adjustment->points) settled.insert(point.name);
  for (const Diagnosis& diagnosis : diagnoses) settled.insert(diagnosis.unused_control);
  for (const ControlPoint& point : survey.control_points) {
    if (settled.contains(point.name)) continue;
    for (const AdjustedPoint& there : adjustment->points) {
      if (there.is_tie_point || surveyed.contains(there.name)) continue;
      const double sigma = std::sqrt(there.covariance.trace() + point.sigma.squaredNorm());
      const double distance = (there.position - point.position).norm();
      if (distance > kSamePlace + 3 * sigma || sigma > 1) continue;
      adjustment->warnings.push_back(
          point.place.path.filename().string() + ":" + std::to_string(point.place.line) +
          ": point '" + point.name + "' is marked on no photo, and point '" + there.name +
          Number("', %.0f mm from it, has no coordinates: are they one? Expected: one name in all "
                 "files",
                 1000 * distance));
    }
  }
}

void AddStatistics(const NetworkSolution& solution, const AdjustmentOptions& options,
                   Adjustment* adjustment) {
  adjustment->iterations = solution.iterations;
  adjustment->is_converged = solution.is_converged;
  adjustment->observations = solution.observations;
  adjustment->unknowns = solution.unknowns;
  adjustment->datum_defect = solution.datum.defect();
  adjustment->redundancy = solution.redundancy;
  adjustment->datum = DatumInWords(solution.datum);
  adjustment->datum_worth = solution.datum_worth;
  adjustment->has_scale = !solution.datum.is_free[6];
  adjustment->sigma0 = solution.sigma0;
  adjustment->critical_w = CriticalTestValue(options.significance);
  adjustment->chi_square_p = ChiSquareTwoSided(solution.square_sum, solution.redundancy);
  GlobalTest& test = adjustment->global_test;
  test.statistic = solution.square_sum;
  test.p = adjustment->chi_square_p;
  if (solution.redundancy == 0) return;
  test.low = ChiSquareQuantile(solution.redundancy, test.alpha / 2);
  test.high = ChiSquareQuantile(solution.redundancy, 1 - test.alpha / 2);
}

std::map<std::string, int> CountUnknowns(const Network& network, const NetworkColumns& columns) {
  std::map<std::string, int> counts;
  for (const Unknown& unknown : columns.unknowns) {
    switch (unknown.kind) {
      case Unknown::Kind::kCamera:
        ++counts["interior orientations"];
        break;
      case Unknown::Kind::kPhoto:
        ++counts["exterior orientations"];
        break;
      case Unknown::Kind::kPoint:
        ++counts[network.points[unknown.index].is_tie_point ? "tie points" : "points"];
        break;
      case Unknown::Kind::kPlane:
        ++counts["planes"];
        break;
      case Unknown::Kind::kDirection:
        ++counts["directions"];
        break;
    }
  }
  return counts;
}

// Start values of a survey that does not contradict itself, with what looks odd in it nevertheless.
struct SoundStart {
  StartValues values;
  std::vector<Diagnosis> diagnoses;
};

SoundStart FindSoundStart(const Survey& survey, const std::vector<std::string>& photos,
                          const std::vector<Camera>& cameras,
                          const std::map<std::string, Rigid3>& initial_cam_from_world,
                          double plane_sigma) {
  SoundStart start;
  start.diagnoses = RequireSound(survey, photos, cameras);
  try {
    start.values = FindStartValues(survey, photos, cameras, initial_cam_from_world);
    RequirePlanar(survey, start.values.points, plane_sigma);
    return start;
  } catch (const InputError& symptom) {
    ThrowDiagnosed(start.diagnoses, symptom);
  }
}

void WarnOfStart(const SoundStart& start, const Survey& survey, Adjustment* adjustment) {
  adjustment->warnings = start.values.warnings;
  for (const Diagnosis& diagnosis : start.diagnoses) {
    adjustment->warnings.push_back(Text(diagnosis));
  }
  if (survey.zenith_pairs.empty()) {
    adjustment->warnings.push_back("no zenith pairs: the z axis was taken for the zenith");
  }
}

}  // namespace

Adjustment Adjust(const Survey& survey, const std::vector<std::string>& photos,
                  const std::vector<Camera>& cameras, const AdjustmentOptions& options,
                  const std::vector<PhotoLens>& lenses,
                  const std::map<std::string, Rigid3>& initial_cam_from_world) {
  options.Check();
  INSITU_CHECK(lenses.empty() || lenses.size() == photos.size());
  const SoundStart start =
      FindSoundStart(survey, photos, cameras, initial_cam_from_world, options.plane_sigma);
  const auto [survey_network, solution] = SolveSurvey(survey, start.values, lenses, options);
  const Network& network = survey_network.network;

  Adjustment adjustment;
  AddStatistics(solution, options, &adjustment);
  adjustment.unknowns_of = CountUnknowns(network, solution.columns);
  WarnOfStart(start, survey, &adjustment);
  WarnOfMasks(survey, &adjustment);
  for (const std::string& camera : survey_network.usual_lenses) {
    adjustment.warnings.push_back(
        "camera '" + camera +
        "': its calibration states no uncertainty and no control shows any; 0.05 % of the focal "
        "length is taken, also for the principal point");
  }
  adjustment.residuals = AdjustedObservations(survey_network, solution, options.significance);
  adjustment.cameras = AdjustedCameras(network, solution);
  adjustment.poses = AdjustedPoses(network, solution);
  adjustment.points = AdjustedPoints(network, solution);
  adjustment.planes = AdjustedPlanes(survey_network, solution);
  adjustment.plane_effect = FindPlaneEffect(survey_network, solution);
  adjustment.correlations = HighCorrelations(network, solution);
  CompareWithSurvey(survey, &adjustment);
  WarnOfMisnamedControl(survey, start.diagnoses, &adjustment);
  adjustment.left_out = LeaveOneOut(survey_network, solution);
  adjustment.check_rms_over_sigma = RmsOverSigma(adjustment.check);
  adjustment.left_out_rms_over_sigma = RmsOverSigma(adjustment.left_out);
  RequirePlanar(survey, JudgedPoints(adjustment.points), options.plane_sigma);
  RequireSimpleOutlines(survey, JudgedPoints(adjustment.points));
  adjustment.scene = AdjustedScene(survey, survey_network, solution, adjustment);
  return adjustment;
}

}  // namespace insitu
