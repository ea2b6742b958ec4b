// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment/survey_network.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>

#include "calibration/algebra/decompositions.h"
#include "calibration/files/error_at.h"
#include "reconstruction/geometry/plane.h"

namespace insitu {
namespace {

constexpr double kOriginStep = 10;        // [m]
constexpr double kLeastLength = 1e-6;     // [m]
constexpr double kHardPlaneSigma = 1e-5;  // [m]
// Of the focal length, for it and the principal point, and of k1. An assumption, not a measurement:
// a px or two in the corners, as focusing and handling change a lens that was calibrated with care.
constexpr double kUsualLensSigma = 5e-4;
constexpr double kPlumbSigma = 1;  // [m], camera positions known worse hold no plumb

// A round point near the control, or near the points where there is none.
Eigen::Vector3d RoundedCentroid(const Survey& survey, const StartValues& start) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  int count = 0;
  for (const ControlPoint& point : survey.control_points) {
    if (point.role == ControlRole::kControl) mean += (point.position - mean) / ++count;
  }
  if (count == 0) {
    for (const auto& [name, point] : start.points) mean += (point.position - mean) / ++count;
    for (const StartTiePoint& point : start.tie_points) mean += (point.position - mean) / ++count;
  }
  return (mean / kOriginStep).array().round() * kOriginStep;
}

// Not that of a lens without calibration, nor one with parameters that the calibration held.
bool IsPositiveDefinite(const Eigen::MatrixXd& covariance) {
  return covariance.size() > 0 && Decorrelation(covariance).has_value();
}

bool HasPlainIntrinsics(const Camera& camera) {
  return camera.lens_model().starts_with("LENSMODEL_OPENCV") ||
         camera.lens_model() == "LENSMODEL_PINHOLE";
}

// fx and fy together, cx, cy, and k1 where there is one.
Eigen::MatrixXd UsualCovariance(const Camera& camera) {
  const auto count = static_cast<Eigen::Index>(camera.intrinsics().size());
  const double variance = std::pow(kUsualLensSigma * camera.intrinsics()[0], 2);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(count, count);
  covariance.topLeftCorner<2, 2>().setConstant(variance);
  covariance.block<2, 2>(2, 2) = variance * Eigen::Matrix2d::Identity();
  if (count > 4) covariance(4, 4) = std::pow(kUsualLensSigma, 2);
  return covariance;
}

// Builds the network's lists in order; names become indices.
class Builder {
 public:
  Builder(const Survey& survey, const StartValues& start, const std::vector<PhotoLens>& lenses,
          const AdjustmentOptions& options)
      : survey_(survey), start_(start), lenses_(lenses), options_(options) {
    network_.origin = RoundedCentroid(survey, start);
  }

  SurveyNetwork Build() {
    AddPhotos();
    for (const auto& [name, point] : start_.points) {
      result_.index_of_point[name] = static_cast<int>(network_.points.size());
      network_.points.push_back({name, point.position - network_.origin});
    }
    AddPlanes();
    if (!survey_.sun_pairs.empty()) {
      result_.sun = AddDirection("sun", survey_.sun_pairs, options_.sun_sigma);
    }
    AddZenith();
    AddMarks();
    AddTiePoints();
    AddControl();
    AddCameraPositions();
    for (const GeometricConstraint& constraint : survey_.constraints) AddConstraint(constraint);
    return std::move(result_);
  }

 private:
  int Photo(const std::string& name) const { return result_.index_of_photo.at(name); }
  int Point(const std::string& name) const { return result_.index_of_point.at(name); }

  int CameraOf(size_t photo) {
    const Camera& camera = start_.cameras[photo].camera;
    PhotoLens lens;
    if (!lenses_.empty()) lens = lenses_.at(photo);
    for (size_t i = 0; i < network_.cameras.size(); ++i) {
      const NetworkCamera& known = network_.cameras[i];
      if (known.name == lens.camera &&
          std::get<Camera>(known.lens).intrinsics() == camera.intrinsics()) {
        return static_cast<int>(i);
      }
    }
    NetworkCamera added{lens.camera, camera, {}, lens.covariance};
    if (lens.covariance.size() == 0 && survey_.tie_points && !options_.is_self_calibrating &&
        SurveyedPlaces() < 3 && HasPlainIntrinsics(camera)) {
      added.calibration_covariance = UsualCovariance(camera);
      result_.usual_lenses.push_back(lens.camera);
    }
    const int index = static_cast<int>(network_.cameras.size());
    if (options_.is_self_calibrating) {
      added.is_free.assign(camera.intrinsics().size(), true);
      if (IsPositiveDefinite(lens.covariance)) {
        network_.lenses.push_back({index, camera.intrinsics(), lens.covariance});
      }
    }
    network_.cameras.push_back(added);
    return index;
  }

  void AddPhotos() {
    for (size_t i = 0; i < start_.cameras.size(); ++i) {
      const PosedCamera& posed = start_.cameras[i];
      result_.index_of_photo[posed.photo] = static_cast<int>(i);
      network_.photos.push_back({posed.photo, CameraOf(i), posed.cam_from_world.rotation,
                                 Center(posed.cam_from_world) - network_.origin});
    }
  }

  bool IsConstrained(const std::string& polygon) const {
    return std::any_of(survey_.constraints.begin(), survey_.constraints.end(), [&](const auto& c) {
      return std::find(c.polygons.begin(), c.polygons.end(), polygon) != c.polygons.end();
    });
  }

  void AddPlanes() {
    const double sigma = options_.has_hard_planes ? kHardPlaneSigma : options_.plane_sigma;
    for (const PolygonOutline& polygon : survey_.polygons) {
      const std::vector<std::string> names = AllVertices(polygon);
      if (names.size() < 4 && !IsConstrained(polygon.name)) continue;
      std::vector<Eigen::Vector3d> vertices;
      for (const std::string& name : names) {
        vertices.push_back(network_.points[Point(name)].position);
      }
      Plane plane = FitPlane(vertices);
      vertices.resize(polygon.vertices.size());  // holes may turn either way
      if (plane.normal.dot(OutlineNormal(vertices)) < 0) plane.normal = -plane.normal;
      const int index = static_cast<int>(network_.planes.size());
      result_.index_of_plane[polygon.name] = index;
      network_.planes.push_back({polygon.name, plane.normal, plane.point, 0});
      for (const std::string& name : names) {
        network_.on_planes.push_back({index, Point(name), sigma});
      }
    }
  }

  Eigen::Vector3d Step(const DirectionPair& pair) const {
    return network_.points[Point(pair.to)].position - network_.points[Point(pair.from)].position;
  }

  int AddDirection(const std::string& name, const std::vector<DirectionPair>& pairs, double sigma) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const DirectionPair& pair : pairs) sum += Step(pair);
    for (const DirectionPair& pair : pairs) {
      if (Step(pair).dot(sum) > 0) continue;
      throw ErrorAt(pair.place,
                    Sentence("pairAway",
                             "the pair '{from}' to '{to}' points away from the other pairs, "
                             "expected two distinct points in the order that the file's keys name",
                             {{"from", pair.from}, {"to", pair.to}}));
    }
    const int index = static_cast<int>(network_.directions.size());
    network_.directions.push_back({name, sum.normalized()});
    for (const DirectionPair& pair : pairs) {
      network_.along_directions.push_back({index, Point(pair.from), Point(pair.to), sigma});
    }
    return index;
  }

  // Where fewer than three places are surveyed, the zenith is what decides about up: it is the z
  // axis, and the pairs turn the network.
  void AddZenith() {
    if (!survey_.zenith_pairs.empty()) {
      result_.zenith = AddDirection("zenith", survey_.zenith_pairs, options_.zenith_sigma);
      if (SurveyedPlaces() >= 3) return;
      network_.directions[*result_.zenith].unit = Eigen::Vector3d::UnitZ();
      network_.directions[*result_.zenith].is_fixed = true;
    } else {
      result_.zenith = static_cast<int>(network_.directions.size());
      network_.directions.push_back({"zenith", Eigen::Vector3d::UnitZ(), true});
    }
  }

  std::ptrdiff_t SurveyedPlaces() const {
    return std::ranges::count_if(survey_.control_points,
                                 [&](const ControlPoint& point) {
                                   return point.role == ControlRole::kControl &&
                                          start_.points.contains(point.name);
                                 }) +
           std::ranges::count_if(survey_.camera_positions, [](const CameraPosition& position) {
             return position.role == PositionRole::kFixed ||
                    (position.role == PositionRole::kWeighted &&
                     position.sigma.maxCoeff() < kPlumbSigma);
           });
  }

  void AddMarks() {
    for (const ImageObservation& mark : survey_.observations) {
      network_.marks.push_back({Photo(mark.photo), Point(mark.point), mark.pixel, mark.sigma_px});
    }
    for (const EdgeMark& edge : survey_.edges) {
      RequireApart(edge.from, edge.to, edge.place);
      network_.edges.push_back(
          {Photo(edge.photo), Point(edge.from), Point(edge.to), edge.pixel, edge.sigma_px});
    }
  }

  void AddTiePoints() {
    for (const StartTiePoint& tie : start_.tie_points) {
      const int point = static_cast<int>(network_.points.size());
      network_.points.push_back({tie.name, tie.position - network_.origin, false, true});
      for (const StartTiePoint::Mark& mark : tie.marks) {
        network_.marks.push_back({mark.photo, point, mark.pixel, start_.tie_point_sigma_px});
      }
    }
  }

  void AddControl() {
    for (const ControlPoint& control : survey_.control_points) {
      const auto point = result_.index_of_point.find(control.name);
      if (control.role != ControlRole::kControl || point == result_.index_of_point.end()) continue;
      network_.control.push_back(
          {point->second, control.position - network_.origin, control.sigma});
    }
  }

  void AddCameraPositions() {
    for (const CameraPosition& surveyed : survey_.camera_positions) {
      NetworkPhoto& photo = network_.photos[Photo(surveyed.photo)];
      const Eigen::Vector3d position = surveyed.position - network_.origin;
      if (surveyed.role == PositionRole::kFixed) {
        photo.center = position;
        photo.is_center_fixed = true;
      } else if (surveyed.role == PositionRole::kWeighted) {
        network_.centers.push_back(
            {Photo(surveyed.photo), position, surveyed.sigma, surveyed.lever_arm});
      }
    }
  }

  // Between points in one place there is no direction.
  void RequireApart(const std::string& from, const std::string& to, const FilePlace& place) const {
    if (Step({from, to, place}).norm() > kLeastLength) return;
    throw ErrorAt(place, Sentence("pointsOneSpot",
                                  "'{from}' and '{to}' lie in the same place, expected two "
                                  "distinct points",
                                  {{"from", from}, {"to", to}}));
  }

  std::vector<UnitReference> UnitsOf(const GeometricConstraint& constraint) const {
    std::vector<UnitReference> units;
    for (const std::string& polygon : constraint.polygons) {
      units.push_back(PlaneNormal{result_.index_of_plane.at(polygon)});
    }
    for (size_t i = 0; i + 1 < constraint.points.size(); i += 2) {
      units.push_back(EdgeUnit{Point(constraint.points[i]), Point(constraint.points[i + 1])});
    }
    return units;
  }

  void AddConstraint(const GeometricConstraint& constraint) {
    using Kind = GeometricConstraint::Kind;
    for (size_t i = 0; i + 1 < constraint.points.size() && constraint.kind != Kind::kHeight;
         i += 2) {
      RequireApart(constraint.points[i], constraint.points[i + 1], constraint.place);
    }
    if (constraint.kind == Kind::kDistance) {
      network_.distances.push_back({Point(constraint.points[0]), Point(constraint.points[1]),
                                    constraint.value, constraint.sigma});
    } else if (constraint.kind == Kind::kHeight) {
      network_.heights.push_back({*result_.zenith, Point(constraint.points[0]),
                                  Point(constraint.points[1]), constraint.value, constraint.sigma});
    } else {
      std::vector<UnitReference> units = UnitsOf(constraint);
      bool is_parallel = constraint.kind == Kind::kParallel;
      if (constraint.kind == Kind::kVertical || constraint.kind == Kind::kHorizontal) {
        // A wall's normal is across the zenith where an edge is along it.
        is_parallel = constraint.polygons.empty() == (constraint.kind == Kind::kVertical);
        units.push_back(DirectionUnit{*result_.zenith});
      }
      network_.angles.push_back({units.at(0), units.at(1), is_parallel, constraint.sigma});
    }
  }

  const Survey& survey_;
  const StartValues& start_;
  const std::vector<PhotoLens>& lenses_;
  const AdjustmentOptions& options_;
  SurveyNetwork result_;
  Network& network_ = result_.network;
};

}  // namespace

SurveyNetwork MakeSurveyNetwork(const Survey& survey, const StartValues& start,
                                const std::vector<PhotoLens>& lenses,
                                const AdjustmentOptions& options) {
  return Builder(survey, start, lenses, options).Build();
}

}  // namespace insitu
