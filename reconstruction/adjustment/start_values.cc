// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment/start_values.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "reconstruction/adjustment/align_tie_points.h"
#include "reconstruction/geometry/intersection.h"
#include "reconstruction/geometry/plane.h"
#include "reconstruction/geometry/resection.h"

namespace insitu {
namespace {

constexpr double kStrongAngle = 0.03;  // [rad], rays at a smaller angle are asked after planes
constexpr double kWeakAngle = 1e-3;    // [rad]

// Grows the set of known points and posed photos from one another.
class StartFinder {
 public:
  StartFinder(const Survey& survey, const std::vector<std::string>& photos,
              const std::vector<Camera>& cameras,
              const std::map<std::string, Rigid3>& initial_cam_from_world)
      : survey_(survey), initial_cam_from_world_(initial_cam_from_world) {
    for (size_t i = 0; i < photos.size(); ++i) {
      result_.cameras.push_back({photos[i], cameras[i], {}});
      index_of_photo_[photos[i]] = i;
    }
    is_posed_.assign(photos.size(), false);
    for (const ImageObservation& mark : survey.observations) {
      RequireOnPhotograph("point '" + mark.point + "'", mark.photo, mark.pixel, mark.place);
    }
    for (const EdgeMark& mark : survey.edges) {
      RequireOnPhotograph("edge '" + mark.from + "' to '" + mark.to + "'", mark.photo, mark.pixel,
                          mark.place);
    }
  }

  StartValues Find() {
    TakeControl();
    if (survey_.tie_points) PlaceByTiePoints();
    std::vector<size_t> ambiguous, waiting;
    for (size_t photo = 0; photo < result_.cameras.size(); ++photo) {
      if (is_posed_[photo]) continue;
      if (survey_.tie_points && !CanResect(photo)) {
        waiting.push_back(photo);
        continue;
      }
      is_posed_[photo] = !ResectFromControl(photo);
      if (!is_posed_[photo]) ambiguous.push_back(photo);
    }
    FindPoints();
    for (const size_t photo : ambiguous) ResectAgain(photo);
    FindPoints();
    ResectWaiting(std::move(waiting));
    RequireAllFound();
    if (survey_.tie_points) TakeTiePoints();
    return std::move(result_);
  }

 private:
  void RequireOnPhotograph(const std::string& what, const std::string& photo,
                           const Eigen::Vector2d& pixel, const FilePlace& place) const {
    const Camera& camera = result_.cameras[index_of_photo_.at(photo)].camera;
    if (camera.Sees(pixel)) return;
    throw InputError(place.path, place.line,
                     what + " is marked outside photo '" + photo +
                         "', expected a position within " + std::to_string(camera.width()) + "x" +
                         std::to_string(camera.height()) + " pixels");
  }

  void TakeControl() {
    unknown_ = PointsInUse(survey_);
    for (const ControlPoint& control : survey_.control_points) {
      const bool in_use = unknown_.contains(control.name);
      if (control.role == ControlRole::kCheck) {
        if (!in_use) {
          result_.warnings.push_back("check point '" + control.name + "' is marked on no photo");
        }
      } else if (in_use) {
        SetKnown(control.name, {control.position, control.sigma.maxCoeff()});
      }
    }
  }

  // Photos that image matching placed stand where its model, moved into the world, has them. Where
  // too little control tells where that is, photos that show enough of their own are resected.
  void PlaceByTiePoints() {
    std::map<std::string, Camera> cameras;
    for (const PosedCamera& posed : result_.cameras) cameras.emplace(posed.photo, posed.camera);
    TiePoints tie_points = *survey_.tie_points;
    const TiePointAlignment alignment = AlignTiePoints(survey_, cameras, &tie_points);
    bool can_resect_all = true;
    for (size_t i = 0; i < cameras.size(); ++i) can_resect_all = can_resect_all && CanResect(i);
    if (!alignment.fit && can_resect_all) return;
    if (!alignment.fit && alignment.pairs >= 3) {
      throw InputError(FileOfObservations().path, alignment.warnings.at(0));
    }
    result_.warnings = alignment.warnings;
    for (const auto& [photo, cam_from_world] : tie_points.cam_from_model) {
      const size_t index = index_of_photo_.at(photo);
      result_.cameras[index].cam_from_world = cam_from_world;
      is_posed_[index] = true;
    }
    aligned_ = std::move(tie_points);
  }

  bool CanResect(size_t photo) const {
    std::vector<Eigen::Vector3d> positions;
    for (const ResectionPoint& point : MarksOf(photo).known) positions.push_back(point.world);
    return !AreCollinear(positions);
  }

  // Photos that image matching left out and that show too little control: from points that others
  // determine, as long as that helps.
  void ResectWaiting(std::vector<size_t> waiting) {
    while (!waiting.empty()) {
      const auto next = std::find_if(waiting.begin(), waiting.end(),
                                     [&](size_t photo) { return CanResect(photo); });
      const size_t photo = next == waiting.end() ? waiting.front() : *next;
      if (ResectFromControl(photo)) ResectAgain(photo);  // throws if it still shows too little
      is_posed_[photo] = true;
      std::erase(waiting, photo);
      FindPoints();
    }
  }

  // In the world: as aligned, else intersected from the resected photos.
  void TakeTiePoints() {
    const TiePoints& source = aligned_ ? *aligned_ : *survey_.tie_points;
    result_.tie_point_sigma_px = source.sigma_px;
    size_t far = 0;
    for (size_t i = 0; i < source.points.size(); ++i) {
      StartTiePoint point{TiePointName(i), source.points[i].position, {}};
      std::vector<Sight> sights;
      for (const TiePointMark& mark : source.points[i].marks) {
        const size_t photo = index_of_photo_.at(mark.photo);
        point.marks.push_back({static_cast<int>(photo), mark.pixel});
        sights.push_back({&result_.cameras[photo], mark.pixel});
      }
      if (!aligned_) {
        const auto position = Intersect(sights, kStrongAngle);
        if (!position) {
          ++far;
          continue;
        }
        point.position = *position;
      }
      result_.tie_points.push_back(std::move(point));
    }
    if (far == 0) return;
    result_.warnings.push_back(std::to_string(far) + " of " + std::to_string(source.points.size()) +
                               " tie points are left out: their rays hardly meet");
  }

  void SetKnown(const std::string& name, const StartPoint& point) {
    result_.points.emplace(name, point);
    unknown_.erase(name);
  }

  struct PhotoMarks {
    std::vector<ResectionPoint> known;  // those of known points
    const ImageObservation* first_known = nullptr;
    const ImageObservation* first = nullptr;  // of all
  };

  PhotoMarks MarksOf(size_t photo) const {
    PhotoMarks marks;
    for (const ImageObservation& mark : survey_.observations) {
      if (mark.photo != result_.cameras[photo].photo) continue;
      if (marks.first == nullptr) marks.first = &mark;
      const auto known = result_.points.find(mark.point);
      if (known == result_.points.end()) continue;
      if (marks.first_known == nullptr) marks.first_known = &mark;
      marks.known.push_back({known->second.position, mark.pixel, mark.sigma_px});
    }
    return marks;
  }

  // Returns whether three points left several poses to choose from.
  bool ResectFromControl(size_t photo) {
    const std::string& name = result_.cameras[photo].photo;
    const auto [points, first_known, first] = MarksOf(photo);
    if (points.size() < 3) {
      const FilePlace place = first ? first->place : FileOfObservations();
      throw InputError(place.path, place.line,
                       "photo '" + name + "' shows " + std::to_string(points.size()) +
                           " control points, expected at least three (check points do not "
                           "count); mark more, or let insitu-tie-points connect it to photos that "
                           "show them");
    }
    std::vector<Eigen::Vector3d> positions;
    for (const ResectionPoint& point : points) positions.push_back(point.world);
    if (AreCollinear(positions)) {
      throw InputError(first_known->place.path, first_known->place.line,
                       "the " + std::to_string(points.size()) + " control points on photo '" +
                           name + "' lie on one line, expected one well beside it");
    }
    return Resect(photo, points, first_known->place).ambiguous;
  }

  void ResectAgain(size_t photo) {
    const PhotoMarks marks = MarksOf(photo);
    if (Resect(photo, marks.known, marks.first_known->place).ambiguous) {
      result_.warnings.push_back("photo '" + result_.cameras[photo].photo +
                                 "' fits its three control points from several places; the most "
                                 "upright was taken: mark a fourth or give an estimate");
    }
    is_posed_[photo] = true;
  }

  ResectionResult Resect(size_t photo, const std::vector<ResectionPoint>& points,
                         const FilePlace& place) {
    PosedCamera& posed = result_.cameras[photo];
    std::optional<Rigid3> initial;
    if (const auto given = initial_cam_from_world_.find(posed.photo);
        given != initial_cam_from_world_.end()) {
      initial = given->second;
    }
    const auto resection = insitu::Resect(posed.camera, points, initial);
    if (!resection) {
      throw InputError(place.path, place.line,
                       "photo '" + posed.photo + "' cannot be resected from its " +
                           std::to_string(points.size()) +
                           " control points, expected marks that one camera position explains");
    }
    posed.cam_from_world = resection->cam_from_world;
    return *resection;
  }

  FilePlace FileOfObservations() const {
    if (!survey_.observations.empty()) return {survey_.observations[0].place.path, 0};
    return {"survey/observations.csv", 0};
  }

  // Strong intersections first, then planes, then weak intersections, until nothing changes.
  void FindPoints() {
    while (FindEach([&](const auto& name) { return FromSights(name, kStrongAngle); }) ||
           FindEach([&](const auto& name) { return FromPlanes(name); }) ||
           FindEach([&](const auto& name) { return FromSights(name, kWeakAngle); })) {
    }
  }

  template <typename Finder>
  bool FindEach(const Finder& find) {
    std::vector<std::pair<std::string, StartPoint>> found;
    for (const std::string& name : unknown_) {
      if (const std::optional<StartPoint> point = find(name)) found.emplace_back(name, *point);
    }
    for (const auto& [name, point] : found) SetKnown(name, point);
    return !found.empty();
  }

  struct PointSights {
    std::vector<Sight> sights;
    std::vector<double> sigmas_px;  // of their marks
  };

  PointSights SightsOf(const std::string& point) const {
    PointSights seen;
    for (const ImageObservation& mark : survey_.observations) {
      const size_t photo = index_of_photo_.at(mark.photo);
      if (mark.point != point || !is_posed_[photo]) continue;
      seen.sights.push_back({&result_.cameras[photo], mark.pixel});
      seen.sigmas_px.push_back(mark.sigma_px);
    }
    return seen;
  }

  std::optional<StartPoint> FromSights(const std::string& name, double min_angle) const {
    const auto [sights, sigmas_px] = SightsOf(name);
    const auto position = Intersect(sights, min_angle);
    if (!position) return std::nullopt;
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    for (size_t i = 0; i < sights.size(); ++i) {
      const Eigen::Vector3d ray = *position - Center(sights[i].camera->cam_from_world);
      const double sigma = sigmas_px[i] / sights[i].camera->camera.focal_px() * ray.norm();
      const Eigen::Vector3d along = ray.normalized();
      normal += (Eigen::Matrix3d::Identity() - along * along.transpose()) / (sigma * sigma);
    }
    const double weakest =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(normal, Eigen::EigenvaluesOnly)
            .eigenvalues()[0];
    return StartPoint{*position, 1 / std::sqrt(weakest)};
  }

  // Planes of polygons with this vertex and three other known ones.
  std::vector<Plane> PlanesThrough(const std::string& name) const {
    std::vector<Plane> planes;
    for (const PolygonOutline& polygon : survey_.polygons) {
      std::vector<Eigen::Vector3d> others;
      bool has_vertex = false;
      for (const std::string& vertex : polygon.vertices) {
        has_vertex = has_vertex || vertex == name;
        const auto known = result_.points.find(vertex);
        if (known != result_.points.end()) others.push_back(known->second.position);
      }
      if (has_vertex && !AreCollinear(others, 0.01)) planes.push_back(FitPlane(others));
    }
    return planes;
  }

  // Where a sight meets a plane, nearest to the plane's known vertices; or where three planes meet.
  std::optional<StartPoint> FromPlanes(const std::string& name) const {
    const std::vector<Sight> sights = SightsOf(name).sights;
    const std::vector<Plane> planes = PlanesThrough(name);
    std::optional<Eigen::Vector3d> best;
    double nearest = std::numeric_limits<double>::infinity();
    for (const Plane& plane : planes) {
      for (const Sight& sight : sights) {
        const auto hit = IntersectPlane(sight, plane.normal, plane.normal.dot(plane.point));
        if (!hit || (*hit - plane.point).norm() >= nearest) continue;
        nearest = (*hit - plane.point).norm();
        best = hit;
      }
    }
    if (sights.empty()) best = WherePlanesMeet(planes);
    if (!best) return std::nullopt;
    return StartPoint{*best, std::numeric_limits<double>::infinity()};
  }

  static std::optional<Eigen::Vector3d> WherePlanesMeet(const std::vector<Plane>& planes) {
    if (planes.size() < 3) return std::nullopt;
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Plane& plane : planes) {
      normal += plane.normal * plane.normal.transpose();
      right += plane.normal * plane.normal.dot(plane.point - planes[0].point);
    }
    if (normal.determinant() < 1e-3) return std::nullopt;  // nearly parallel to one line
    return planes[0].point + normal.inverse() * right;
  }

  void RequireAllFound() const {
    if (unknown_.empty()) return;
    const std::string& name = *unknown_.begin();
    const size_t rays = SightsOf(name).sights.size();
    const FilePlace place = PlaceOfPoint(survey_, name);
    throw InputError(place.path, place.line,
                     "point '" + name + "' is marked on " + std::to_string(rays) +
                         (rays == 1 ? " photo" : " photos") +
                         " and cannot be determined; expected marks on two photos from different "
                         "places, or one mark and a polygon with three other known vertices, or "
                         "its coordinates as a control point");
  }

  const Survey& survey_;
  const std::map<std::string, Rigid3>& initial_cam_from_world_;
  StartValues result_;
  std::map<std::string, size_t> index_of_photo_;
  std::vector<bool> is_posed_;
  std::set<std::string> unknown_;
  std::optional<TiePoints> aligned_;  // the tie points in the world, if their poses are used
};

}  // namespace

StartValues FindStartValues(const Survey& survey, const std::vector<std::string>& photos,
                            const std::vector<Camera>& cameras,
                            const std::map<std::string, Rigid3>& initial_cam_from_world) {
  INSITU_CHECK(photos.size() == cameras.size());
  return StartFinder(survey, photos, cameras, initial_cam_from_world).Find();
}

}  // namespace insitu
