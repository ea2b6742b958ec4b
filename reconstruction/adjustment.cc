// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <set>
#include <utility>

#include "reconstruction/old_network.h"
#include "reconstruction/planarity.h"
#include "reconstruction/plane.h"
#include "reconstruction/statistics.h"

namespace insitu {
namespace {

// The solution with what its statistics need.
struct Solution {
  const Network& network;
  const AdjustmentProblem& problem;
  Eigen::MatrixXd covariance;  // of all unknowns, scaled by sigma0^2
};

std::string NameOf(const Unknown& unknown) {
  switch (unknown.kind) {
    case Unknown::Kind::kPhoto:
      return "photo '" + unknown.name + "'";
    case Unknown::Kind::kPoint:
      return "point '" + unknown.name + "'";
    case Unknown::Kind::kPolygon:
      return "plane of polygon '" + unknown.name + "'";
    case Unknown::Kind::kSun:
    case Unknown::Kind::kZenith:
      break;
  }
  return "direction '" + unknown.name + "'";
}

FilePlace PlaceOf(const Unknown& unknown, const Survey& survey) {
  if (unknown.kind == Unknown::Kind::kPoint) return PlaceOfPoint(survey, unknown.name);
  if (unknown.kind == Unknown::Kind::kSun) return survey.sun_pairs[0].place;
  if (unknown.kind == Unknown::Kind::kZenith) return survey.zenith_pairs[0].place;
  for (const PolygonOutline& polygon : survey.polygons) {
    if (unknown.kind == Unknown::Kind::kPolygon && polygon.name == unknown.name) {
      return polygon.place;
    }
  }
  for (const ImageObservation& mark : survey.observations) {
    if (mark.photo == unknown.name) return mark.place;
  }
  return survey.observations[0].place;
}

InputError RankDefect(const AdjustmentProblem& problem, const Jacobian& jacobian,
                      const Survey& survey) {
  std::vector<Unknown> unknowns;
  std::set<std::string> names;
  for (const int column : UndeterminedColumns(jacobian)) {
    const Unknown& unknown = problem.UnknownOf(column);
    if (names.insert(NameOf(unknown)).second) unknowns.push_back(unknown);
  }
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  const FilePlace place = PlaceOf(unknowns.front(), survey);
  return InputError(place.path, place.line,
                    "the observations do not determine " + list +
                        "; expected more marks, control points or polygons that hold them");
}

std::vector<AdjustedPose> AdjustedPoses(const Solution& solution) {
  std::vector<AdjustedPose> poses;
  for (const NetworkPose& pose : solution.network.poses) {
    const Eigen::Vector3d center = pose.center + solution.network.origin;
    const int column = solution.problem.ColumnOf(pose.cam_from_local.coeffs().data());
    AdjustedPose adjusted;
    adjusted.photo = pose.photo;
    adjusted.cam_from_world = {pose.cam_from_local, -(pose.cam_from_local * center)};
    adjusted.covariance = solution.covariance.block<6, 6>(column, column);
    poses.push_back(adjusted);
  }
  return poses;
}

std::vector<AdjustedPoint> AdjustedPoints(const Solution& solution) {
  std::vector<AdjustedPoint> points;
  for (const auto& [name, position] : solution.network.points) {
    const int column = solution.problem.ColumnOf(position.data());
    points.push_back({name, position + solution.network.origin,
                      solution.covariance.block<3, 3>(column, column)});
  }
  return points;
}

// Counts of marks and root mean squares, sqrt(sum(vx^2 + vy^2) / marks), of photos and points.
void AddImageResiduals(Adjustment* adjustment) {
  std::map<std::string, std::pair<int, double>> of_photo, of_point;  // rows, sum of squares
  for (const ObservationResidual& row : adjustment->residuals) {
    if (row.photo.empty()) continue;
    for (auto* sums : {&of_photo[row.photo], &of_point[row.subject]}) {
      sums->first += 1;
      sums->second += row.residual * row.residual;
    }
  }
  for (AdjustedPose& pose : adjustment->poses) {
    const auto [rows, squares] = of_photo[pose.photo];
    pose.points = rows / 2;
    pose.rms_px = std::sqrt(squares / pose.points);
  }
  for (AdjustedPoint& point : adjustment->points) {
    const auto [rows, squares] = of_point[point.name];
    point.rays = rows / 2;
    point.rms_px = point.rays > 0 ? std::sqrt(squares / point.rays) : 0;
  }
}

void CompareWithSurvey(const Survey& survey, Adjustment* adjustment) {
  std::map<std::string, const AdjustedPoint*> adjusted;
  for (const AdjustedPoint& point : adjustment->points) adjusted[point.name] = &point;
  double squares = 0;
  for (const ControlPoint& surveyed : survey.control_points) {
    const auto point = adjusted.find(surveyed.name);
    if (point == adjusted.end()) continue;
    PointComparison comparison{surveyed.name, point->second->position - surveyed.position,
                               surveyed.sigma};
    if (surveyed.role == ControlRole::kControl) {
      adjustment->control.push_back(comparison);
      continue;
    }
    const Eigen::Array3d variance = point->second->covariance.diagonal();
    comparison.sigma = (surveyed.sigma.array().square() + variance).sqrt();
    squares += comparison.difference.cwiseQuotient(comparison.sigma).squaredNorm();
    adjustment->check.push_back(comparison);
  }
  const size_t coordinates = 3 * adjustment->check.size();
  if (coordinates > 0) {
    adjustment->check_rms_over_sigma = std::sqrt(squares / static_cast<double>(coordinates));
  }
}

Direction AdjustedDirection(const Solution& solution, const Eigen::Vector3d& unit) {
  const int column = solution.problem.ColumnOf(unit.data());
  Eigen::Matrix<double, 3, 2, Eigen::RowMajor> unit_from_tangent;
  ceres::SphereManifold<3>().PlusJacobian(unit.data(), unit_from_tangent.data());
  return {unit, unit_from_tangent * solution.covariance.block<2, 2>(column, column) *
                    unit_from_tangent.transpose()};
}

std::vector<Polygon> AdjustedPolygons(const Survey& survey, const Network& network) {
  std::map<std::string, Eigen::Vector3d> normal_of_polygon;
  for (const NetworkPlane& plane : network.planes) normal_of_polygon[plane.polygon] = plane.normal;
  std::vector<Polygon> polygons;
  for (const PolygonOutline& outline : survey.polygons) {
    Polygon polygon;
    polygon.name = outline.name;
    polygon.material = outline.material;
    for (const std::string& vertex : outline.vertices) {
      polygon.vertices.push_back(network.points.at(vertex) + network.origin);
    }
    for (size_t i = 0; i < network.poses.size(); ++i) {
      if (outline.photo == network.poses[i].photo) polygon.photo = static_cast<int>(i);
    }
    const Eigen::Vector3d newell = OutlineNormal(polygon.vertices);
    const auto adjusted = normal_of_polygon.find(outline.name);
    polygon.normal = adjusted == normal_of_polygon.end() ? newell : adjusted->second;
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

SceneGeometry AdjustedScene(const Survey& survey, const Solution& solution,
                            const Adjustment& adjustment) {
  const Network& network = solution.network;
  SceneGeometry scene;
  scene.origin = network.origin;
  for (size_t i = 0; i < network.poses.size(); ++i) {
    const NetworkPose& pose = network.poses[i];
    scene.cameras.push_back({pose.photo, pose.camera, adjustment.poses[i].cam_from_world});
  }
  scene.polygons = AdjustedPolygons(survey, network);
  if (network.sun) scene.sun = AdjustedDirection(solution, *network.sun);
  scene.zenith = network.zenith ? AdjustedDirection(solution, *network.zenith)
                                : Direction{Eigen::Vector3d::UnitZ(), Eigen::Matrix3d::Zero()};
  scene.vertex_sigma = MedianVertexSigma(survey, adjustment.points);
  return scene;
}

std::map<std::string, StartPoint> JudgedPoints(const std::vector<AdjustedPoint>& points) {
  std::map<std::string, StartPoint> judged;
  for (const AdjustedPoint& point : points) judged[point.name] = {point.position, 0};
  return judged;
}

std::string Format(const char* format, ...) __attribute__((format(printf, 1, 2)));
std::string Format(const char* format, ...) {
  char line[256];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  return line;
}

void WarnOfMasks(const Survey& survey, Adjustment* adjustment) {
  for (const PolygonOutline& polygon : survey.polygons) {
    if (!polygon.mask) continue;
    adjustment->warnings.push_back("polygon '" + polygon.name +
                                   "': its mask is not used, what it covers will be shaded");
  }
}

void AddStatistics(const AdjustmentProblem::Linearization& linear, const Eigen::MatrixXd& cofactor,
                   Adjustment* adjustment) {
  adjustment->observations = static_cast<int>(linear.jacobian.rows());
  adjustment->unknowns = static_cast<int>(linear.jacobian.cols());
  adjustment->redundancy = adjustment->observations - adjustment->unknowns;
  const double square_sum = linear.residuals.squaredNorm();
  adjustment->sigma0 =
      adjustment->redundancy > 0 ? std::sqrt(square_sum / adjustment->redundancy) : 1;
  adjustment->chi_square_p = ChiSquareTwoSided(square_sum, adjustment->redundancy);
  adjustment->residuals = linear.rows;
  const Eigen::VectorXd redundancy = RedundancyNumbers(linear.jacobian, cofactor);
  for (int row = 0; row < redundancy.size(); ++row) {
    adjustment->residuals[row].redundancy = redundancy[row];
  }
}

}  // namespace

Adjustment Adjust(const Survey& survey, const std::vector<std::string>& photos,
                  const std::vector<Camera>& cameras, const AdjustmentOptions& options) {
  INSITU_CHECK(options.plane_sigma > 0 && options.zenith_sigma > 0 && options.sun_sigma > 0);
  const StartValues start = FindStartValues(survey, photos, cameras, options);
  RequirePlanar(survey, start.points, options.plane_sigma);
  Network network = MakeNetwork(survey, start);
  AdjustmentProblem problem(survey, options, network);
  const AdjustmentProblem::Termination termination = problem.Solve();
  if (!termination.usable) {
    throw InputError(survey.observations[0].place.path,
                     "the adjustment fails, expected marks that fit their points");
  }
  const AdjustmentProblem::Linearization linear = problem.Linearize();
  const std::optional<Eigen::MatrixXd> cofactor = Cofactor(linear.jacobian);
  if (!cofactor) throw RankDefect(problem, linear.jacobian, survey);

  Adjustment adjustment;
  adjustment.iterations = termination.iterations;
  adjustment.warnings = start.warnings;
  if (!termination.converged) adjustment.warnings.push_back("the adjustment has not converged");
  if (!network.zenith) {
    adjustment.warnings.push_back("no zenith pairs: the z axis was taken for the zenith");
  }
  WarnOfMasks(survey, &adjustment);
  AddStatistics(linear, *cofactor, &adjustment);
  const double variance_factor = adjustment.sigma0 * adjustment.sigma0;
  const Solution solution{network, problem, variance_factor * *cofactor};
  adjustment.poses = AdjustedPoses(solution);
  adjustment.points = AdjustedPoints(solution);
  AddImageResiduals(&adjustment);
  CompareWithSurvey(survey, &adjustment);
  RequirePlanar(survey, JudgedPoints(adjustment.points), options.plane_sigma);
  RequireSimpleOutlines(survey, JudgedPoints(adjustment.points));
  adjustment.scene = AdjustedScene(survey, solution, adjustment);
  return adjustment;
}

std::string Adjustment::BriefReport() const {
  std::string text = Format(
      "%zu photos, %zu points, %zu polygons: %d observations, %d unknowns, redundancy %d\n",
      poses.size(), points.size(), scene.polygons.size(), observations, unknowns, redundancy);
  text += Format("sigma0 %.3f (1 expected; p of the global test %.3f), %d iterations\n", sigma0,
                 chi_square_p, iterations);
  for (const AdjustedPose& pose : poses) {
    const Eigen::Vector3d sigma = pose.covariance.diagonal().tail<3>().cwiseSqrt();
    text += Format("photo %s: %d points, RMS %.2f px, camera to %.1f mm\n", pose.photo.c_str(),
                   pose.points, pose.rms_px, 1000 * sigma.norm());
  }
  if (check.empty()) {
    text += "no check points: accuracy not verified\n";
  } else {
    text += Format("check points: %zu, RMS %.2f of their combined sigma\n", check.size(),
                   check_rms_over_sigma);
  }
  for (const std::string& warning : warnings) text += "warning: " + warning + "\n";
  return text;
}

}  // namespace insitu
