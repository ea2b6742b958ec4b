// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/live/one_ray.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "calibration/algebra/decompositions.h"
#include "reconstruction/geometry/plane.h"
#include "reconstruction/network/unit_tangents.h"

namespace insitu {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kBand95 = 1.95996;  // sigmas, of what varies along one line
constexpr double kGrazing = 1e-4;    // cosine, of a sight along a plane

Matrix3d CrossBy(const Vector3d& v) {
  Matrix3d matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

// Derivatives by all that is uncertain: a row for each component of a quantity; columns: the
// unknowns, the parameters of each considered lens, the mark's x and y, the distance from the
// plane.
class Uncertain {
 public:
  Uncertain(const SolvedSurvey& solved, double sigma_px, double plane_sigma)
      : network_(solved.survey_network.network),
        solution_(solved.solution),
        noise_(sigma_px, sigma_px, plane_sigma) {
    size_ = solution_.columns.count;
    for (const MatrixXd& by_lens : solution_.lens_sensitivity) {
      lens_.push_back(size_);
      size_ += by_lens.cols();
    }
  }

  MatrixXd Nothing(Eigen::Index rows) const { return MatrixXd::Zero(rows, size_ + 3); }
  auto ByMark(MatrixXd* by) const { return by->middleCols(size_, 2); }
  auto ByDistance(MatrixXd* by) const { return by->col(size_ + 2); }

  void AddUnknown(const std::optional<int>& column, const MatrixXd& by_unknown,
                  MatrixXd* by) const {
    if (column) by->middleCols(*column, by_unknown.cols()) += by_unknown;
  }

  // `by_parameters`: by all of a photo's lens.
  void AddLens(int photo, const MatrixXd& by_parameters, MatrixXd* by) const {
    const int camera = network_.photos[photo].camera;
    if (const std::optional<int> column = solution_.columns.camera[camera]) {
      int free = *column;
      for (Eigen::Index k = 0; k < by_parameters.cols(); ++k) {
        if (network_.cameras[camera].is_free[k]) by->col(free++) += by_parameters.col(k);
      }
    } else if (solution_.lens_sensitivity[camera].size() > 0) {
      by->middleCols(lens_[camera], by_parameters.cols()) += by_parameters;
    }
  }

  MatrixXd Covariance(const MatrixXd& by) const {
    const double variance = solution_.sigma0 * solution_.sigma0;
    const auto by_unknowns = by.leftCols(solution_.columns.count);
    MatrixXd covariance =
        variance * by_unknowns * solution_.cofactor.Times(MatrixXd(by_unknowns.transpose()));
    for (size_t i = 0; i < lens_.size(); ++i) {
      const MatrixXd& sensitivity = solution_.lens_sensitivity[i];
      if (sensitivity.size() == 0) continue;
      const MatrixXd by_lens =
          by_unknowns * sensitivity + by.middleCols(lens_[i], sensitivity.cols());
      covariance += by_lens * network_.cameras[i].calibration_covariance * by_lens.transpose();
    }
    const MatrixXd by_noise = by.rightCols<3>() * noise_.asDiagonal();
    return covariance + variance * by_noise * by_noise.transpose();
  }

 private:
  const Network& network_;
  const NetworkSolution& solution_;
  Vector3d noise_;
  std::vector<Eigen::Index> lens_;  // first column, by camera
  Eigen::Index size_ = 0;           // columns but those of the noise
};

// A quantity with its derivatives.
struct Value3 {
  Vector3d value;
  MatrixXd by;
};
struct Value2 {
  Vector2d value;
  MatrixXd by;
};

class Ray {
 public:
  Ray(const SolvedSurvey& solved, const SingleMark& mark, double plane_sigma)
      : survey_network_(solved.survey_network),
        network_(solved.survey_network.network),
        columns_(solved.solution.columns),
        uncertain_(solved, mark.sigma_px, plane_sigma),
        photo_(survey_network_.index_of_photo.at(mark.photo)),
        sight_(SightOf(mark.pixel)) {}

  const Uncertain& uncertain() const { return uncertain_; }
  int photo() const { return photo_; }
  const Vector3d& sight() const { return sight_.value; }

  // From the centre of a photo to that of the mark's.
  Value3 Base(int other) const {
    Value3 base{network_.photos[photo_].center - network_.photos[other].center,
                uncertain_.Nothing(3)};
    uncertain_.AddUnknown(columns_.center[photo_], Matrix3d::Identity(), &base.by);
    uncertain_.AddUnknown(columns_.center[other], -Matrix3d::Identity(), &base.by);
    return base;
  }

  // Local.
  std::optional<Value3> Meet(const PolygonOutline& polygon) const {
    const Vector3d& center = network_.photos[photo_].center;
    const auto [normal, on_plane] = PlaneOf(polygon);
    const double slope = normal.dot(sight_.value);
    const double distance = normal.dot(on_plane - center) / slope;
    if (std::abs(slope) < kGrazing || !(distance > 0)) return std::nullopt;
    Value3 point{center + distance * sight_.value, uncertain_.Nothing(3)};
    const Matrix3d along =
        Matrix3d::Identity() - sight_.value * normal.transpose() / slope;  // the ray, to the plane
    uncertain_.AddUnknown(columns_.center[photo_], along, &point.by);
    point.by += distance * along * sight_.by;
    point.by += sight_.value / slope * PlaneShift(polygon, normal, point.value);
    return point;
  }

  // Of a point or, to any length, a direction from a photo's centre; nullopt: not in the frame.
  std::optional<Value2> Image(int photo, const Value3& from_center) const {
    const Camera& camera = LensOf(photo);
    const Matrix3d turn = network_.photos[photo].cam_from_local.toRotationMatrix();
    const Vector3d in_cam = turn * from_center.value;
    Eigen::Matrix<double, 2, 3> by_point;
    Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor> by_lens(2, Parameters(camera));
    const auto pixel =
        camera.ProjectWith(camera.intrinsics().data(), in_cam, &by_point, by_lens.data());
    if (!pixel || !camera.Sees(*pixel)) return std::nullopt;
    Value2 image{*pixel, by_point * turn * from_center.by};
    uncertain_.AddUnknown(columns_.rotation[photo], -by_point * CrossBy(in_cam), &image.by);
    uncertain_.AddLens(photo, by_lens, &image.by);
    return image;
  }

  // The direction from a photo's centre to the place on the ray that a pixel of the photo shows.
  Value3 TowardsPlaceAt(int other, const Vector2d& pixel) const {
    const Value3 base = Base(other);
    const Vector3d look =
        network_.photos[other].cam_from_local.conjugate() * LensOf(other).Unproject(pixel);
    const double to_sight = look.cross(sight_.value).norm(),
                 to_base = look.cross(base.value).norm();
    const double share = to_sight / (to_sight + to_base);  // 0: at infinity, 1: the other's centre
    return {(1 - share) * sight_.value + share * base.value,
            (1 - share) * sight_.by + share * base.by};
  }

 private:
  const Camera& LensOf(int photo) const {
    return std::get<Camera>(network_.cameras[network_.photos[photo].camera].lens);
  }

  static Eigen::Index Parameters(const Camera& camera) {
    return static_cast<Eigen::Index>(camera.intrinsics().size());
  }

  // Unit, local.
  Value3 SightOf(const Vector2d& pixel) const {
    const Camera& camera = LensOf(photo_);
    const Vector3d in_cam = camera.Unproject(pixel);
    Eigen::Matrix<double, 2, 3> by_point;
    Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor> by_lens(2, Parameters(camera));
    camera.ProjectWith(camera.intrinsics().data(), in_cam, &by_point, by_lens.data());
    const Eigen::Matrix<double, 3, 2> from_pixel =
        by_point.transpose() * (by_point * by_point.transpose()).inverse();
    const Matrix3d back = network_.photos[photo_].cam_from_local.conjugate().toRotationMatrix();
    Value3 sight{back * in_cam, uncertain_.Nothing(3)};
    uncertain_.ByMark(&sight.by) += back * from_pixel;
    uncertain_.AddLens(photo_, -back * from_pixel * by_lens, &sight.by);
    uncertain_.AddUnknown(columns_.rotation[photo_], back * CrossBy(in_cam), &sight.by);
    return sight;
  }

  Vector3d VertexOf(const std::string& name) const {
    return network_.points[survey_network_.index_of_point.at(name)].position;
  }

  std::pair<Vector3d, Vector3d> PlaneOf(const PolygonOutline& polygon) const {
    const auto index = survey_network_.index_of_plane.find(polygon.name);
    if (index == survey_network_.index_of_plane.end()) {  // a triangle
      std::vector<Vector3d> corners;
      for (const std::string& vertex : polygon.vertices) corners.push_back(VertexOf(vertex));
      return {OutlineNormal(corners), corners[0]};
    }
    const NetworkPlane& plane = network_.planes[index->second];
    return {plane.normal, plane.centroid + plane.offset * plane.normal};
  }

  // How far the plane moves along its normal at a point of it: a row.
  MatrixXd PlaneShift(const PolygonOutline& polygon, const Vector3d& normal,
                      const Vector3d& point) const {
    MatrixXd shift = uncertain_.Nothing(1);
    uncertain_.ByDistance (&shift)(0) = 1;
    const auto index = survey_network_.index_of_plane.find(polygon.name);
    if (index == survey_network_.index_of_plane.end()) {
      AddCornerShifts(polygon, normal, point, &shift);
      return shift;
    }
    const NetworkPlane& plane = network_.planes[index->second];
    MatrixXd by_plane(1, 3);
    by_plane << -(point - plane.centroid).transpose() * TangentsOf(plane.normal), 1;
    uncertain_.AddUnknown(columns_.plane[index->second], by_plane, &shift);
    return shift;
  }

  // Of a triangle: each corner counts as its barycentric coordinate says.
  void AddCornerShifts(const PolygonOutline& polygon, const Vector3d& normal, const Vector3d& point,
                       MatrixXd* shift) const {
    const auto corner = [&](int i) { return VertexOf(polygon.vertices[i % 3]); };
    const double whole = (corner(1) - corner(0)).cross(corner(2) - corner(0)).dot(normal);
    for (int i = 0; i < 3; ++i) {
      const Vector3d a = corner(i + 1), b = corner(i + 2);
      const double share = (a - point).cross(b - point).dot(normal) / whole;
      const int index = survey_network_.index_of_point.at(polygon.vertices[i]);
      uncertain_.AddUnknown(columns_.point[index], share * normal.transpose(), shift);
    }
  }

  const SurveyNetwork& survey_network_;
  const Network& network_;
  const NetworkColumns& columns_;
  Uncertain uncertain_;
  int photo_;
  Value3 sight_;
};

ImageUncertainty UncertaintyOf(const Value2& image, const Eigen::Matrix2d& covariance) {
  ImageUncertainty result;
  result.pixel = image.value;
  result.covariance_px = covariance;
  const Vector2d sigmas = EigenOfSymmetric(covariance).values.cwiseMax(0).cwiseSqrt();
  result.minor_px = sigmas[0];
  result.major_px = sigmas[1];
  return result;
}

}  // namespace

std::optional<PointOnPlane> WhereRayMeets(const SolvedSurvey& solved, const SingleMark& mark,
                                          const PolygonOutline& polygon, double plane_sigma) {
  const Ray ray(solved, mark, plane_sigma);
  const std::optional<Value3> met = ray.Meet(polygon);
  if (!met) return std::nullopt;
  const Network& network = solved.survey_network.network;
  PointOnPlane point{met->value + network.origin, ray.uncertain().Covariance(met->by), {}};
  for (const auto& [photo, index] : solved.survey_network.index_of_photo) {
    Value3 from_center{met->value - network.photos[index].center, met->by};
    ray.uncertain().AddUnknown(solved.solution.columns.center[index], -Matrix3d::Identity(),
                               &from_center.by);
    const std::optional<Value2> image = ray.Image(index, from_center);
    if (!image) continue;
    point.images[photo] = UncertaintyOf(*image, ray.uncertain().Covariance(image->by));
  }
  return point;
}

std::vector<Eigen::Vector2d> EpipolarBand(const SolvedSurvey& solved, const SingleMark& mark,
                                          const std::string& other, const Polyline& curve) {
  const Ray ray(solved, mark, 0);
  const int photo = solved.survey_network.index_of_photo.at(other);
  std::vector<Vector2d> band;
  for (size_t i = 0; i < curve.size(); ++i) {
    const Vector2d along = curve[std::min(i + 1, curve.size() - 1)] - curve[i == 0 ? 0 : i - 1];
    const Vector2d across = Vector2d(-along.y(), along.x()).normalized();
    const std::optional<Value2> image = ray.Image(photo, ray.TowardsPlaceAt(photo, curve[i]));
    if (!image) {  // rounding at the frame's edge
      band.push_back(band.empty() ? Vector2d(Vector2d::Zero()) : band.back());
      continue;
    }
    const MatrixXd by_across = across.transpose() * image->by;
    const double variance = ray.uncertain().Covariance(by_across)(0, 0);
    band.push_back(kBand95 * std::sqrt(std::max(0.0, variance)) * across);
  }
  return band;
}

}  // namespace insitu
