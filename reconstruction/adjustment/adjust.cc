// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment/adjust.h"

#include <ceres/sphere_manifold.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "calibration/files/error.h"
#include "calibration/files/wording.h"
#include "reconstruction/adjustment/adjusted_observations.h"
#include "reconstruction/adjustment/adjusted_unknowns.h"
#include "reconstruction/adjustment/planarity.h"
#include "reconstruction/adjustment/plane_effect.h"
#include "reconstruction/adjustment/polygon_covariance.h"
#include "reconstruction/adjustment/solution_errors.h"
#include "reconstruction/diagnosis/survey_diagnosis.h"
#include "reconstruction/geometry/plane.h"

namespace insitu {
namespace {

void CompareWithSurvey(const Survey& survey, Adjustment* adjustment) {
  std::map<std::string, const AdjustedPoint*> adjusted;
  for (const AdjustedPoint& point : adjustment->points) adjusted[point.name] = &point;
  for (const ControlPoint& surveyed : survey.control_points) {
    const auto point = adjusted.find(surveyed.name);
    if (point == adjusted.end()) continue;
    PointComparison comparison{surveyed.name,  point->second->position - surveyed.position,
                               surveyed.sigma, surveyed.position,
                               surveyed.sigma, point->second->covariance.diagonal().cwiseSqrt()};
    if (surveyed.role == ControlRole::kControl) {
      adjustment->control.push_back(comparison);
      continue;
    }
    const Eigen::Array3d variance = point->second->covariance.diagonal();
    comparison.sigma = (surveyed.sigma.array().square() + variance).sqrt();
    adjustment->check.push_back(comparison);
  }
}

// Root mean square of differences over their sigmas.
double RmsOverSigma(const std::vector<PointComparison>& comparisons) {
  double squares = 0;
  for (const PointComparison& point : comparisons) {
    squares += point.difference.cwiseQuotient(point.sigma).squaredNorm();
  }
  return comparisons.empty() ? 0 : std::sqrt(squares / (3.0 * comparisons.size()));
}

Direction AdjustedDirection(const SurveyNetwork& survey_network, const NetworkSolution& solution,
                            int index) {
  const NetworkDirection& direction = survey_network.network.directions[index];
  const std::optional<int> column = solution.columns.direction[index];
  if (!column) return {direction.unit, Eigen::Matrix3d::Zero()};
  Eigen::Matrix<double, 3, 2, Eigen::RowMajor> unit_from_tangent;
  ceres::SphereManifold<3>().PlusJacobian(direction.unit.data(), unit_from_tangent.data());
  return {direction.unit, unit_from_tangent *
                              Covariance(survey_network.network, solution, *column, 2, *column, 2) *
                              unit_from_tangent.transpose()};
}

std::vector<Polygon> AdjustedPolygons(const Survey& survey, const SurveyNetwork& survey_network) {
  const Network& network = survey_network.network;
  std::vector<Polygon> polygons;
  for (const PolygonOutline& outline : survey.polygons) {
    Polygon polygon;
    polygon.name = outline.name;
    polygon.material = outline.material;
    for (const std::string& vertex : outline.vertices) {
      polygon.vertices.push_back(network.points[survey_network.index_of_point.at(vertex)].position +
                                 network.origin);
    }
    if (outline.photo) {
      const auto photo = survey_network.index_of_photo.find(*outline.photo);
      if (photo != survey_network.index_of_photo.end()) polygon.photo = photo->second;
    }
    const Eigen::Vector3d newell = OutlineNormal(polygon.vertices);
    const auto plane = survey_network.index_of_plane.find(outline.name);
    polygon.normal = plane == survey_network.index_of_plane.end()
                         ? newell
                         : network.planes[plane->second].normal;
    if (polygon.normal.dot(newell) < 0) polygon.normal = -polygon.normal;
    polygons.push_back(std::move(polygon));
  }
  return polygons;
}

// The median posterior sigma of the coordinates of the polygons' vertices [m].
double MedianVertexSigma(const Survey& survey, const std::vector<AdjustedPoint>& points) {
  std::set<std::string> vertices;
  for (const PolygonOutline& polygon : survey.polygons) {
    vertices.insert(polygon.vertices.begin(), polygon.vertices.end());
  }
  std::vector<double> sigmas;
  for (const AdjustedPoint& point : points) {
    if (!vertices.contains(point.name)) continue;
    for (int axis = 0; axis < 3; ++axis) {
      sigmas.push_back(std::sqrt(point.covariance(axis, axis)));
    }
  }
  if (sigmas.empty()) return 0;
  const auto middle = sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() / 2);
  std::nth_element(sigmas.begin(), middle, sigmas.end());
  return *middle;
}

SceneGeometry AdjustedScene(const Survey& survey, const SurveyNetwork& survey_network,
                            const NetworkSolution& solution, const Adjustment& adjustment) {
  const Network& network = survey_network.network;
  SceneGeometry scene;
  scene.origin = network.origin;
  for (size_t i = 0; i < network.photos.size(); ++i) {
    const NetworkPhoto& photo = network.photos[i];
    scene.cameras.push_back({photo.name, std::get<Camera>(network.cameras[photo.camera].lens),
                             adjustment.poses[i].cam_from_world});
  }
  scene.camera_covariances = CameraCovariances(network, solution);
  scene.polygons = AdjustedPolygons(survey, survey_network);
  std::vector<Eigen::MatrixXd> covariances = PolygonCovariances(survey, survey_network, solution);
  for (size_t i = 0; i < covariances.size(); ++i) {
    scene.polygons[i].covariance = std::move(covariances[i]);
  }
  if (survey_network.sun) {
    scene.sun = AdjustedDirection(survey_network, solution, *survey_network.sun);
  }
  scene.zenith = AdjustedDirection(survey_network, solution, *survey_network.zenith);
  scene.vertex_sigma = MedianVertexSigma(survey, adjustment.points);
  return scene;
}

std::map<std::string, StartPoint> JudgedPoints(const std::vector<AdjustedPoint>& points) {
  std::map<std::string, StartPoint> judged;
  for (const AdjustedPoint& point : points) judged[point.name] = {point.position, 0};
  return judged;
}

void WarnOfMasks(const Survey& survey, Adjustment* adjustment) {
  for (const PolygonOutline& polygon : survey.polygons) {
    if (!polygon.mask) continue;
    adjustment->warnings.push_back("polygon '" + polygon.name +
                                   "': its mask is not used, what it covers will be shaded");
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

NetworkSolution Solve(const Survey& survey, SurveyNetwork* survey_network) {
  try {
    return SolveNetwork(&survey_network->network);
  } catch (const NoSolution& failure) {
    throw NoSolutionError(failure, survey_network->network, survey);
  } catch (const RankDefect& defect) {
    throw RankDefectError(defect, *survey_network, survey);
  }
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
  SurveyNetwork survey_network = MakeSurveyNetwork(survey, start.values, lenses, options);
  const NetworkSolution solution = Solve(survey, &survey_network);
  const Network& network = survey_network.network;

  Adjustment adjustment;
  AddStatistics(solution, options, &adjustment);
  adjustment.unknowns_of = CountUnknowns(network, solution.columns);
  WarnOfStart(start, survey, &adjustment);
  WarnOfMasks(survey, &adjustment);
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
