// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment/start_growth.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "calibration/algebra/decompositions.h"
#include "calibration/files/error.h"
#include "reconstruction/adjustment/align_tie_points.h"

namespace insitu {
namespace {

constexpr double kStrongAngle = 0.03;  // [rad], rays at a smaller angle are asked after planes
constexpr double kWeakAngle = 1e-3;    // [rad]

std::optional<Eigen::Vector3d> WherePlanesMeet(const std::vector<Plane>& planes) {
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

}  // namespace

StartGrowth::StartGrowth(const Survey& survey, const std::vector<std::string>& photos,
                         const std::vector<Camera>& cameras,
                         const std::map<std::string, Rigid3>& initial_cam_from_world)
    : survey_(survey), initial_cam_from_world_(initial_cam_from_world) {
  for (size_t i = 0; i < photos.size(); ++i) {
    values_.cameras.push_back({photos[i], cameras[i], {}});
    index_of_photo_[photos[i]] = i;
  }
  is_posed_.assign(photos.size(), false);
  marks_on_.resize(photos.size());
  for (const ImageObservation& mark : survey.observations) {
    const auto photo = index_of_photo_.find(mark.photo);
    if (photo == index_of_photo_.end()) continue;
    marks_on_[photo->second].push_back(&mark);
    marks_of_[mark.point].push_back(&mark);
  }
  for (const PolygonOutline& polygon : survey.polygons) {
    for (const std::string& vertex : AllVertices(polygon)) polygons_of_[vertex].push_back(&polygon);
  }
}

void StartGrowth::TakeControl() {
  unknown_ = PointsInUse(survey_);
  for (const ControlPoint& control : survey_.control_points) {
    const bool in_use = unknown_.contains(control.name);
    if (control.role == ControlRole::kCheck) {
      if (!in_use) {
        values_.warnings.push_back("check point '" + control.name + "' is marked on no photo");
      }
    } else if (in_use) {
      SetKnown(control.name, {control.position, control.sigma.maxCoeff()});
    }
  }
  strong_ = on_planes_ = weak_ = unknown_;
}

void StartGrowth::PlaceByTiePoints() {
  std::map<std::string, Camera> cameras;
  for (const PosedCamera& posed : values_.cameras) cameras.emplace(posed.photo, posed.camera);
  TiePoints tie_points = *survey_.tie_points;
  const TiePointAlignment alignment = AlignTiePoints(survey_, cameras, &tie_points);
  bool can_resect_all = true;
  for (size_t i = 0; i < cameras.size(); ++i) can_resect_all = can_resect_all && CanResect(i);
  if (!alignment.fit && can_resect_all) return;
  if (!alignment.fit && alignment.pairs >= 3 && !alignment.warnings.empty()) {
    throw InputError(FileOfObservations(survey_).path, alignment.warnings.at(0));
  }
  values_.warnings = alignment.warnings;
  for (const auto& [photo, cam_from_world] : tie_points.cam_from_model) {
    const size_t index = index_of_photo_.at(photo);
    values_.cameras[index].cam_from_world = cam_from_world;
    SetPosed(index);
  }
  aligned_ = std::move(tie_points);
}

void StartGrowth::TakeTiePoints() {
  const TiePoints& source = aligned_ ? *aligned_ : *survey_.tie_points;
  values_.tie_point_sigma_px = source.sigma_px;
  size_t far = 0;
  for (size_t i = 0; i < source.points.size(); ++i) {
    StartTiePoint point{TiePointName(i), source.points[i].position, {}};
    std::vector<Sight> sights;
    for (const TiePointMark& mark : source.points[i].marks) {
      const size_t photo = index_of_photo_.at(mark.photo);
      if (!is_posed_[photo]) continue;
      point.marks.push_back({static_cast<int>(photo), mark.pixel});
      sights.push_back({&values_.cameras[photo], mark.pixel});
    }
    if (point.marks.size() < 2) continue;
    if (!aligned_) {
      const auto position = Intersect(sights, kStrongAngle);
      if (!position) {
        ++far;
        continue;
      }
      point.position = *position;
    }
    values_.tie_points.push_back(std::move(point));
  }
  if (far == 0) return;
  values_.warnings.push_back(std::to_string(far) + " of " + std::to_string(source.points.size()) +
                             " tie points are left out: their rays hardly meet");
}

StartGrowth::PhotoMarks StartGrowth::MarksOf(size_t photo) const {
  PhotoMarks marks;
  for (const ImageObservation* mark : marks_on_[photo]) {
    if (marks.first == nullptr) marks.first = mark;
    const auto known = values_.points.find(mark->point);
    if (known == values_.points.end()) continue;
    if (marks.first_known == nullptr) marks.first_known = mark;
    const double sigma_m = known->second.sigma;
    marks.known.push_back({known->second.position, mark->pixel, mark->sigma_px,
                           std::isfinite(sigma_m) ? sigma_m : 0});
  }
  return marks;
}

bool StartGrowth::CanResect(size_t photo) const {
  std::vector<Eigen::Vector3d> positions;
  for (const ResectionPoint& point : MarksOf(photo).known) positions.push_back(point.world);
  return !AreCollinear(positions);
}

std::optional<Resections> StartGrowth::Resect(size_t photo,
                                              const std::vector<ResectionPoint>& points) {
  PosedCamera& posed = values_.cameras[photo];
  std::optional<Rigid3> initial;
  if (const auto given = initial_cam_from_world_.find(posed.photo);
      given != initial_cam_from_world_.end()) {
    initial = given->second;
  }
  std::optional<SurveyedCenter> place;
  for (const CameraPosition& position : survey_.camera_positions) {
    if (position.photo != posed.photo || position.role == PositionRole::kFree) continue;
    place = SurveyedCenter{position.position, position.sigma.maxCoeff()};
  }
  auto resections = ResectAll(posed.camera, points, initial, place);
  if (resections) posed.cam_from_world = resections->best.cam_from_world;
  return resections;
}

void StartGrowth::SetPosed(size_t photo) {
  is_posed_[photo] = true;
  for (const ImageObservation* mark : marks_on_[photo]) {
    for (auto* changed : {&strong_, &on_planes_, &weak_}) changed->insert(mark->point);
  }
}

void StartGrowth::SetKnown(const std::string& name, const StartPoint& point) {
  values_.points.emplace(name, point);
  unknown_.erase(name);
  if (const auto marks = marks_of_.find(name); marks != marks_of_.end()) {
    for (const ImageObservation* mark : marks->second) {
      changed_photos_.insert(index_of_photo_.at(mark->photo));
    }
  }
  const auto polygons = polygons_of_.find(name);
  if (polygons == polygons_of_.end()) return;
  for (const PolygonOutline* polygon : polygons->second) {
    for (const std::string& vertex : AllVertices(*polygon)) on_planes_.insert(vertex);
  }
}

std::set<size_t> StartGrowth::TakeChangedPhotos() {
  std::set<size_t> changed = std::exchange(changed_photos_, {});
  std::erase_if(changed, [&](size_t photo) { return IsPosed(photo); });
  return changed;
}

void StartGrowth::FindPoints() {
  while (FindEach(&strong_, [&](const auto& name) { return FromSights(name, kStrongAngle); }) ||
         FindEach(&on_planes_, [&](const auto& name) { return FromPlanes(name); }) ||
         FindEach(&weak_, [&](const auto& name) { return FromSights(name, kWeakAngle); })) {
  }
}

template <typename Finder>
bool StartGrowth::FindEach(std::set<std::string>* changed, const Finder& find) {
  std::vector<std::pair<std::string, StartPoint>> found;
  for (const std::string& name : *changed) {
    if (!unknown_.contains(name)) continue;
    if (const std::optional<StartPoint> point = find(name)) found.emplace_back(name, *point);
  }
  changed->clear();
  for (const auto& [name, point] : found) SetKnown(name, point);
  return !found.empty();
}

StartGrowth::PointSights StartGrowth::SightsOf(const std::string& point) const {
  PointSights seen;
  const auto marks = marks_of_.find(point);
  if (marks == marks_of_.end()) return seen;
  for (const ImageObservation* mark : marks->second) {
    const size_t photo = index_of_photo_.at(mark->photo);
    if (!is_posed_[photo]) continue;
    seen.sights.push_back({&values_.cameras[photo], mark->pixel});
    seen.sigmas_px.push_back(mark->sigma_px);
  }
  return seen;
}

std::optional<StartPoint> StartGrowth::FromSights(const std::string& name, double min_angle) const {
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
  const double weakest = EigenOfSymmetric(normal).values[0];
  return StartPoint{*position, 1 / std::sqrt(weakest)};
}

// Planes of polygons with this vertex and three other known ones.
std::vector<Plane> StartGrowth::PlanesThrough(const std::string& name) const {
  std::vector<Plane> planes;
  const auto polygons = polygons_of_.find(name);
  if (polygons == polygons_of_.end()) return planes;
  for (const PolygonOutline* polygon : polygons->second) {
    std::vector<Eigen::Vector3d> others;
    for (const std::string& vertex : AllVertices(*polygon)) {
      const auto known = values_.points.find(vertex);
      if (known != values_.points.end()) others.push_back(known->second.position);
    }
    if (!AreCollinear(others, 0.01)) planes.push_back(FitPlane(others));
  }
  return planes;
}

// Where a sight meets a plane, nearest to the plane's known vertices; or where three planes meet.
std::optional<StartPoint> StartGrowth::FromPlanes(const std::string& name) const {
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

}  // namespace insitu
