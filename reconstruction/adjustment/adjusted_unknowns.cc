// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment/adjusted_unknowns.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "calibration/lens/lens_residual.h"
#include "reconstruction/network/unit_tangents.h"

namespace insitu {
namespace {

Eigen::MatrixXd CorrelationOf(const Eigen::MatrixXd& covariance) {
  const Eigen::VectorXd scale = covariance.diagonal().cwiseSqrt().cwiseInverse();
  return scale.asDiagonal() * covariance * scale.asDiagonal();
}

Eigen::Vector2i SizeOf(const Lens& lens) {
  if (const auto* camera = std::get_if<Camera>(&lens)) return {camera->width(), camera->height()};
  const auto& metric = std::get<MetricCamera>(lens);
  return {metric.width, metric.height};
}

// Share of the frame within the hull of the marks.
double Coverage(const std::vector<cv::Point2f>& marks, const Eigen::Vector2i& size) {
  if (marks.size() < 3) return 0;
  std::vector<cv::Point2f> hull;
  cv::convexHull(marks, hull);
  return cv::contourArea(hull) / (static_cast<double>(size.x()) * size.y());
}

// Rotation and centre; zero for a fixed centre.
Eigen::Matrix<double, 6, 6> PoseCovariance(const Network& network, const NetworkSolution& solution,
                                           size_t photo) {
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  const int rotation = *solution.columns.rotation[photo];
  const int size = solution.columns.center[photo] ? 6 : 3;
  covariance.topLeftCorner(size, size) =
      Covariance(network, solution, rotation, size, rotation, size);
  return covariance;
}

int FreeParameters(const NetworkCamera& camera) {
  return static_cast<int>(std::count(camera.is_free.begin(), camera.is_free.end(), true));
}

// Of the pose with its adjusted lens: the free parameters among all.
void AddAdjustedLens(const Network& network, const NetworkSolution& solution, size_t photo,
                     Eigen::MatrixXd* covariance) {
  const NetworkCamera& camera = network.cameras[network.photos[photo].camera];
  const int lens = *solution.columns.camera[network.photos[photo].camera];
  const int free = FreeParameters(camera), rotation = *solution.columns.rotation[photo];
  const int size = solution.columns.center[photo] ? 6 : 3;
  const Eigen::MatrixXd joint = Covariance(network, solution, rotation, size, lens, free);
  const Eigen::MatrixXd own = Covariance(network, solution, lens, free, lens, free);
  std::vector<int> place;  // of a free parameter in the covariance
  for (size_t k = 0; k < camera.is_free.size(); ++k) {
    if (camera.is_free[k]) place.push_back(6 + static_cast<int>(k));
  }
  for (int i = 0; i < free; ++i) {
    covariance->col(place[i]).head(size) = joint.col(i);
    covariance->row(place[i]).head(size) = joint.col(i).transpose();
    for (int j = 0; j < free; ++j) (*covariance)(place[i], place[j]) = own(i, j);
  }
}

// Of the pose with its considered lens: the pose moves with it as the sensitivity says.
void AddConsideredLens(const Network& network, const NetworkSolution& solution, size_t photo,
                       Eigen::MatrixXd* covariance) {
  const int camera = network.photos[photo].camera;
  const Eigen::MatrixXd& lens = network.cameras[camera].calibration_covariance;
  const int size = solution.columns.center[photo] ? 6 : 3;
  const Eigen::MatrixXd joint =
      solution.lens_sensitivity[camera].middleRows(*solution.columns.rotation[photo], size) * lens;
  covariance->block(0, 6, size, lens.cols()) = joint;
  covariance->block(6, 0, lens.cols(), size) = joint.transpose();
  covariance->bottomRightCorner(lens.rows(), lens.cols()) = lens;
}

Eigen::MatrixXd LensCorrelation(const Network& network, const NetworkSolution& solution,
                                size_t photo, const AdjustedPose& pose) {
  const int camera = network.photos[photo].camera;
  const std::optional<int> lens = solution.columns.camera[camera];
  if (!lens || !solution.columns.center[photo]) return {};
  const int free = FreeParameters(network.cameras[camera]);
  const Eigen::MatrixXd joint =
      Covariance(network, solution, *solution.columns.rotation[photo], 6, *lens, free);
  const Eigen::VectorXd lens_sigma =
      Covariance(network, solution, *lens, free, *lens, free).diagonal().cwiseSqrt();
  return pose.covariance.diagonal().cwiseSqrt().cwiseInverse().asDiagonal() * joint *
         lens_sigma.cwiseInverse().asDiagonal();
}

}  // namespace

std::vector<std::string> ColumnNames(const Network& network, const Unknown& unknown) {
  switch (unknown.kind) {
    case Unknown::Kind::kCamera: {
      std::vector<std::string> names;
      const NetworkCamera& camera = network.cameras[unknown.index];
      const std::vector<std::string> all = LensParameterNames(camera.lens);
      for (size_t i = 0; i < all.size(); ++i) {
        if (camera.is_free[i]) names.push_back("camera " + camera.name + " " + all[i]);
      }
      return names;
    }
    case Unknown::Kind::kPhoto: {
      const std::string photo = "photo " + network.photos[unknown.index].name + " ";
      return {photo + "rotation x", photo + "rotation y", photo + "rotation z",
              photo + "center x",   photo + "center y",   photo + "center z"};
    }
    case Unknown::Kind::kPoint: {
      const std::string point = "point " + network.points[unknown.index].name + " ";
      return {point + "x", point + "y", point + "z"};
    }
    case Unknown::Kind::kPlane: {
      const std::string plane = "plane of polygon " + network.planes[unknown.index].name + " ";
      return {plane + "normal", plane + "normal", plane + "offset"};
    }
    case Unknown::Kind::kDirection:
      break;
  }
  const std::string direction = "direction to the " + network.directions[unknown.index].name;
  return {direction, direction};
}

std::vector<AdjustedCamera> AdjustedCameras(const Network& network,
                                            const NetworkSolution& solution) {
  std::vector<AdjustedCamera> cameras;
  for (size_t i = 0; i < network.cameras.size(); ++i) {
    const NetworkCamera& camera = network.cameras[i];
    AdjustedCamera adjusted;
    adjusted.name = camera.name;
    const auto* model = std::get_if<Camera>(&camera.lens);
    adjusted.lens_model = model ? model->lens_model() : "metric";
    adjusted.is_considered = solution.lens_sensitivity[i].size() > 0;
    const std::vector<double> values = LensParameters(camera.lens);
    const std::vector<std::string> names = LensParameterNames(camera.lens);
    Eigen::MatrixXd covariance;
    if (const auto column = solution.columns.camera[i]) {
      const int free = FreeParameters(camera);
      covariance = Covariance(network, solution, *column, free, *column, free);
      adjusted.correlation = CorrelationOf(covariance);
    }
    int next = 0;
    for (size_t k = 0; k < values.size(); ++k) {
      AdjustedCamera::Parameter parameter;
      parameter.name = names[k];
      parameter.value = values[k];
      parameter.is_adjusted = !camera.is_free.empty() && camera.is_free[k];
      if (parameter.is_adjusted) {
        parameter.sigma = std::sqrt(covariance(next, next));
        ++next;
        const bool is_distortion = k >= (model ? 4u : 3u);
        if (is_distortion) parameter.significance = NormalTwoSided(values[k] / parameter.sigma);
      } else if (adjusted.is_considered) {
        const auto row = static_cast<Eigen::Index>(k);
        parameter.sigma = std::sqrt(camera.calibration_covariance(row, row));
      }
      adjusted.parameters.push_back(parameter);
    }
    cameras.push_back(std::move(adjusted));
  }
  return cameras;
}

std::vector<AdjustedPose> AdjustedPoses(const Network& network, const NetworkSolution& solution) {
  std::vector<AdjustedPose> poses(network.photos.size());
  std::vector<double> squares(poses.size(), 0);
  std::vector<std::vector<cv::Point2f>> marks(poses.size());
  for (size_t row = 0; row < solution.rows.size(); ++row) {
    if (solution.rows[row].kind != ObservationRow::Kind::kMark) continue;
    const MarkObservation& mark = network.marks[solution.rows[row].index];
    const double residual = solution.residuals[static_cast<Eigen::Index>(row)];
    squares[mark.photo] += residual * residual;
    double& largest = poses[mark.photo].max_px[solution.rows[row].component];
    largest = std::max(largest, std::abs(residual));
    if (solution.rows[row].component == 0) {
      marks[mark.photo].emplace_back(mark.pixel.x(), mark.pixel.y());
    }
  }
  for (size_t i = 0; i < poses.size(); ++i) {
    const NetworkPhoto& photo = network.photos[i];
    const Eigen::Vector3d center = photo.center + network.origin;
    AdjustedPose& pose = poses[i];
    pose.photo = photo.name;
    pose.camera = photo.camera;
    pose.cam_from_world = {photo.cam_from_local, -(photo.cam_from_local * center)};
    pose.covariance = PoseCovariance(network, solution, i);
    pose.lens_correlation = LensCorrelation(network, solution, i, pose);
    pose.points = static_cast<int>(marks[i].size());
    pose.rms_px = pose.points > 0 ? std::sqrt(squares[i] / pose.points) : 0;
    pose.coverage = Coverage(marks[i], SizeOf(network.cameras[photo.camera].lens));
  }
  return poses;
}

std::vector<Eigen::MatrixXd> CameraCovariances(const Network& network,
                                               const NetworkSolution& solution) {
  std::vector<Eigen::MatrixXd> covariances;
  for (size_t photo = 0; photo < network.photos.size(); ++photo) {
    const int camera = network.photos[photo].camera;
    const bool is_adjusted = solution.columns.camera[camera].has_value();
    const bool is_considered = solution.lens_sensitivity[camera].size() > 0;
    const auto lens_size = static_cast<Eigen::Index>(
        is_adjusted || is_considered ? LensParameters(network.cameras[camera].lens).size() : 0);
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(6 + lens_size, 6 + lens_size);
    covariance.topLeftCorner<6, 6>() = PoseCovariance(network, solution, photo);
    if (is_adjusted) AddAdjustedLens(network, solution, photo, &covariance);
    if (is_considered) AddConsideredLens(network, solution, photo, &covariance);
    covariances.push_back(covariance);
  }
  return covariances;
}

std::vector<AdjustedPoint> AdjustedPoints(const Network& network, const NetworkSolution& solution) {
  std::vector<AdjustedPoint> points;
  std::vector<double> squares(network.points.size(), 0);
  for (size_t i = 0; i < network.points.size(); ++i) {
    const NetworkPoint& point = network.points[i];
    AdjustedPoint adjusted;
    adjusted.name = point.name;
    adjusted.position = point.position + network.origin;
    adjusted.covariance.setZero();
    if (const auto column = solution.columns.point[i]) {
      adjusted.covariance = Covariance(network, solution, *column, 3, *column, 3);
    }
    adjusted.is_tie_point = point.is_tie_point;
    points.push_back(adjusted);
  }
  for (size_t row = 0; row < solution.rows.size(); ++row) {
    if (solution.rows[row].kind != ObservationRow::Kind::kMark) continue;
    const int point = network.marks[solution.rows[row].index].point;
    squares[point] += std::pow(solution.residuals[static_cast<Eigen::Index>(row)], 2);
    if (solution.rows[row].component == 0) ++points[point].rays;
  }
  for (size_t i = 0; i < points.size(); ++i) {
    if (points[i].rays > 0) points[i].rms_px = std::sqrt(squares[i] / points[i].rays);
  }
  return points;
}

namespace {

// Of a plane's normal n after the zenith z is turned back by its own error:
// dn - dz (z . n) + z (dz . n).
Eigen::Matrix3d TiltCovariance(const SurveyNetwork& survey_network, const NetworkSolution& solution,
                               int plane) {
  const Network& network = survey_network.network;
  const Eigen::Vector3d &n = network.planes[plane].normal,
                        &z = network.directions[*survey_network.zenith].unit;
  Eigen::MatrixXd by_unknowns = Eigen::MatrixXd::Zero(3, solution.columns.count);
  by_unknowns.middleCols<2>(*solution.columns.plane[plane]) = TangentsOf(n);
  if (const auto column = solution.columns.direction[*survey_network.zenith]) {
    const Eigen::Matrix<double, 3, 2> dz = TangentsOf(z);
    by_unknowns.middleCols<2>(*column) = z * (n.transpose() * dz) - z.dot(n) * dz;
  }
  return CovarianceOf(network, solution, by_unknowns);
}

AdjustedPlane Adjusted(const SurveyNetwork& survey_network, const NetworkSolution& solution,
                       int index) {
  const Network& network = survey_network.network;
  const NetworkPlane& plane = network.planes[index];
  const Eigen::Vector3d zenith = network.directions[*survey_network.zenith].unit;
  const int column = *solution.columns.plane[index];
  const Eigen::MatrixXd covariance = Covariance(network, solution, column, 3, column, 3);
  const Eigen::Matrix<double, 3, 2> tangents = TangentsOf(plane.normal);
  AdjustedPlane adjusted;
  adjusted.polygon = plane.name;
  adjusted.normal = plane.normal;
  adjusted.centroid = plane.centroid + network.origin;
  adjusted.offset = plane.offset;
  adjusted.normal_covariance = tangents * covariance.topLeftCorner<2, 2>() * tangents.transpose();
  adjusted.tilt_covariance = TiltCovariance(survey_network, solution, index);
  adjusted.offset_sigma = std::sqrt(covariance(2, 2));
  const double sine = plane.normal.dot(zenith);
  if (std::abs(sine) < std::sin(M_PI / 8)) {  // a wall
    adjusted.off_vertical = std::asin(sine);
    adjusted.off_vertical_sigma =
        std::sqrt(zenith.dot(adjusted.tilt_covariance * zenith) / (1 - sine * sine));
  }
  return adjusted;
}

}  // namespace

std::vector<AdjustedPlane> AdjustedPlanes(const SurveyNetwork& survey_network,
                                          const NetworkSolution& solution) {
  const Network& network = survey_network.network;
  std::vector<AdjustedPlane> planes;
  for (int i = 0; i < static_cast<int>(network.planes.size()); ++i) {
    planes.push_back(Adjusted(survey_network, solution, i));
  }
  std::vector<int> vertices(planes.size(), 0);
  for (const PlaneObservation& on_plane : network.on_planes) {
    const NetworkPlane& plane = network.planes[on_plane.plane];
    const double distance =
        plane.normal.dot(network.points[on_plane.point].position - plane.centroid) - plane.offset;
    planes[on_plane.plane].planarity_rms += distance * distance;
    planes[on_plane.plane].vertex_sigma = on_plane.sigma;
    ++vertices[on_plane.plane];
  }
  for (size_t i = 0; i < planes.size(); ++i) {
    planes[i].planarity_rms = std::sqrt(planes[i].planarity_rms / vertices[i]);
  }
  return planes;
}

namespace {

// Whose correlations are told; nullopt: tie points are too many, planes and directions have none
// that a user could help.
std::optional<Correlation::Of> OwnerOf(const Network& network, const Unknown& unknown) {
  switch (unknown.kind) {
    case Unknown::Kind::kCamera:
      return Correlation::Of::kCamera;
    case Unknown::Kind::kPhoto:
      return Correlation::Of::kPhoto;
    case Unknown::Kind::kPoint:
      if (network.points[unknown.index].is_tie_point) return std::nullopt;
      return Correlation::Of::kPoint;
    case Unknown::Kind::kPlane:
    case Unknown::Kind::kDirection:
      break;
  }
  return std::nullopt;
}

}  // namespace

std::vector<Correlation> HighCorrelations(const Network& network, const NetworkSolution& solution) {
  std::vector<Correlation> high;
  const NetworkColumns& columns = solution.columns;
  for (int first = 0; first < columns.count;) {
    const Unknown& unknown = columns.unknowns[first];
    int count = 1;
    while (first + count < columns.count && columns.unknowns[first + count].kind == unknown.kind &&
           columns.unknowns[first + count].index == unknown.index) {
      ++count;
    }
    if (const std::optional<Correlation::Of> owner = OwnerOf(network, unknown)) {
      const std::vector<std::string> names = ColumnNames(network, unknown);
      const Eigen::MatrixXd correlation =
          CorrelationOf(Covariance(network, solution, first, count, first, count));
      for (int i = 0; i < count; ++i) {
        for (int j = i + 1; j < count; ++j) {
          if (std::abs(correlation(i, j)) > kHighCorrelation) {
            high.push_back({*owner, names[i], names[j], correlation(i, j)});
          }
        }
      }
    }
    first += count;
  }
  std::stable_sort(high.begin(), high.end(), [](const Correlation& a, const Correlation& b) {
    return std::abs(a.value) > std::abs(b.value);
  });
  return high;
}

}  // namespace insitu
