// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/exchange/import_dbat.h"

#include <cmath>
#include <map>
#include <set>

#include "calibration/lens/lens_residual.h"
#include "reconstruction/exchange/dbat_script.h"
#include "reconstruction/geometry/intersection.h"
#include "reconstruction/geometry/omega_phi_kappa.h"
#include "reconstruction/geometry/resection.h"

namespace insitu {
namespace {

using Indices = std::map<std::string, int>;

// Rays of less than this meet nowhere that a start value could be [rad].
constexpr double kMinAngle = 1e-5;

// The script with names resolved to indices, and what is known so far of photos and points.
class Project {
 public:
  explicit Project(const DbatScript& script);

  ImportedProject Build();

 private:
  int PhotoOf(const std::string& id, const FilePlace& place) const;
  void AddCameras();
  void AddPhotos();
  void AddPoints();
  void AddControl();
  void AddMarks();
  void PlacePhotosFromPrior();
  void PlaceByTurns();
  bool ResectPhotos();
  bool IntersectPoints();
  void TakeStartValues();
  Eigen::Vector3d Local(const Eigen::Vector3d& position) const {
    return script_.metres_per_unit * position - network().origin;
  }
  Network& network() { return project_.network; }
  const Network& network() const { return project_.network; }

  const DbatScript& script_;
  ImportedProject project_;
  Indices photos_, points_;
  std::vector<Camera> ideal_;  // by camera: the pinhole of its constant
  std::vector<std::vector<int>> marks_of_photo_, marks_of_point_;
  std::vector<Eigen::Vector2d> ideal_pixels_;          // by mark: what the pinhole would show
  std::vector<std::optional<PosedCamera>> posed_;      // by photo
  std::vector<std::optional<Eigen::Vector3d>> known_;  // by point, local
};

// The lens about its principal point, without its distortion.
Camera IdealCamera(const MetricCamera& lens) {
  const double c = lens.parameters[0];
  return Camera::Pinhole(c / lens.pixel_mm.x(), c / lens.pixel_mm.y(), 0, 0, lens.width,
                         lens.height);
}

// A backward lens corrects what is measured: its residual against the axis is the corrected mark.
Eigen::Vector2d IdealPixel(const MetricCamera& lens, const Eigen::Vector2d& measured) {
  Eigen::Vector2d residual;
  LensResidual(lens, lens.parameters.data(), Eigen::Vector3d::UnitZ(), measured, &residual, {});
  return -residual;
}

Project::Project(const DbatScript& script) : script_(script) {
  AddCameras();
  AddPhotos();
  AddPoints();
  AddControl();
  AddMarks();
}

int Project::PhotoOf(const std::string& id, const FilePlace& place) const {
  const auto photo = photos_.find(id);
  if (photo != photos_.end()) return photo->second;
  throw InputError(place.path, place.line, "image \"" + id + "\" is not in the list of images");
}

void Project::AddCameras() {
  const auto& estimated = script_.is_estimated;
  const bool is_free = std::find(estimated.begin(), estimated.end(), true) != estimated.end();
  for (const DbatCamera& camera : script_.cameras) {
    const MetricCamera lens = MetricFromDbat(camera);
    network().cameras.push_back(
        {camera.name, lens, is_free ? script_.is_estimated : std::vector<bool>()});
    ideal_.push_back(IdealCamera(lens));
  }
}

void Project::AddPhotos() {
  for (const DbatImage& image : script_.images) {
    int camera = 0;
    while (!image.camera.empty() && image.camera != script_.cameras[camera].id) {
      if (++camera == static_cast<int>(script_.cameras.size())) {
        throw InputError(image.place.path, image.place.line,
                         "camera \"" + image.camera + "\" is not known");
      }
    }
    photos_.emplace(image.id, static_cast<int>(photos_.size()));
    network().photos.push_back({image.photo, camera});
  }
}

// Points are those that are surveyed, or marked often enough; in the order of the tables.
void Project::AddPoints() {
  std::map<std::string, int> rays;
  for (const DbatMark& mark : script_.marks) ++rays[mark.point];
  std::set<std::string> left_out;
  const auto add = [&](const std::string& id) {
    if (!points_.emplace(id, static_cast<int>(points_.size())).second) return;
    network().points.push_back({id, Eigen::Vector3d::Zero()});
  };
  for (const DbatControlPoint& point : script_.control) add(point.id);
  for (const DbatMark& mark : script_.marks) {
    if (points_.contains(mark.point) || rays[mark.point] >= std::max(2, script_.min_rays)) {
      add(mark.point);
    } else {
      left_out.insert(mark.point);
    }
  }
  if (!left_out.empty()) {
    project_.remarks.push_back(std::to_string(left_out.size()) +
                               " points with too few rays are left out");
  }
}

void Project::AddControl() {
  const auto& first = !script_.control.empty()              ? script_.control[0].position
                      : !script_.prior_orientations.empty() ? script_.prior_orientations[0].center
                                                            : Eigen::Vector3d(0, 0, 0);
  if (first.norm() * script_.metres_per_unit > 1e4) {  // a national grid
    network().origin = (script_.metres_per_unit * first).array().round();
  }
  known_.resize(network().points.size());
  for (const DbatControlPoint& point : script_.control) {
    const int index = points_.at(point.id);
    known_[index] = Local(point.position);
    network().points[index].is_fixed = point.sigma.isZero(0);
    if (network().points[index].is_fixed) continue;
    network().control.push_back({index, *known_[index], script_.metres_per_unit * point.sigma});
  }
  for (const DbatControlPoint& point : script_.check) {
    const auto index = points_.find(point.id);
    if (index == points_.end()) {
      project_.remarks.push_back("check point \"" + point.id + "\" is seen too seldom");
      continue;
    }
    project_.check_points.push_back(
        {index->second, Local(point.position), script_.metres_per_unit * point.sigma});
  }
}

void Project::AddMarks() {
  marks_of_photo_.resize(network().photos.size());
  marks_of_point_.resize(network().points.size());
  for (const DbatMark& mark : script_.marks) {
    const int photo = PhotoOf(mark.image, mark.place);
    const auto point = points_.find(mark.point);
    if (point == points_.end()) continue;
    const Eigen::Vector2d pixel = mark.pixel.array() - kDbatFirstPixelCenter;
    const int camera = network().photos[photo].camera;
    const auto& lens = std::get<MetricCamera>(network().cameras[camera].lens);
    const int index = static_cast<int>(network().marks.size());
    marks_of_photo_[photo].push_back(index);
    marks_of_point_[point->second].push_back(index);
    network().marks.push_back({photo, point->second, pixel, *mark.sigma_px});
    ideal_pixels_.push_back(IdealPixel(lens, pixel));
  }
}

void Project::PlacePhotosFromPrior() {
  for (const DbatOrientation& prior : script_.prior_orientations) {
    const int photo = PhotoOf(prior.image, prior.place);
    const Eigen::Quaterniond rotation = CamFromWorldOmegaPhiKappa(prior.omega_phi_kappa);
    posed_[photo] = PosedCamera{network().photos[photo].name,
                                ideal_[network().photos[photo].camera],
                                {rotation, -(rotation * Local(prior.center))}};
  }
}

// Every photo with four known points or more, of those that are not yet placed.
bool Project::ResectPhotos() {
  bool is_news = false;
  for (size_t photo = 0; photo < posed_.size(); ++photo) {
    if (posed_[photo]) continue;
    std::vector<ResectionPoint> points;
    for (const int mark : marks_of_photo_[photo]) {
      const auto& known = known_[network().marks[mark].point];
      if (known) points.push_back({*known, ideal_pixels_[mark], network().marks[mark].sigma_px});
    }
    if (points.size() < 4) continue;
    const Camera& camera = ideal_[network().photos[photo].camera];
    const auto resection = Resect(camera, points);
    if (!resection) continue;
    posed_[photo] = PosedCamera{network().photos[photo].name, camera, resection->cam_from_world};
    is_news = true;
  }
  return is_news;
}

bool Project::IntersectPoints() {
  bool is_news = false;
  for (size_t point = 0; point < known_.size(); ++point) {
    if (known_[point]) continue;
    std::vector<Sight> sights;
    for (const int mark : marks_of_point_[point]) {
      const auto& posed = posed_[network().marks[mark].photo];
      if (posed) sights.push_back({&*posed, ideal_pixels_[mark]});
    }
    known_[point] = Intersect(sights, kMinAngle);
    is_news |= known_[point].has_value();
  }
  return is_news;
}

void Project::PlaceByTurns() {
  // Both are asked each time: each may go on where the other has come further.
  while (static_cast<int>(ResectPhotos()) + static_cast<int>(IntersectPoints()) > 0) {
  }
}

void Project::TakeStartValues() {
  for (size_t i = 0; i < posed_.size(); ++i) {
    const DbatImage& image = script_.images[i];
    if (!posed_[i]) {
      throw InputError(image.place.path, image.place.line,
                       "image \"" + image.id +
                           "\" cannot be placed: it has no prior orientation "
                           "and fewer than four marks of points that are known");
    }
    network().photos[i].cam_from_local = posed_[i]->cam_from_world.rotation;
    network().photos[i].center = Center(posed_[i]->cam_from_world);
  }
  for (const DbatMark& mark : script_.marks) {
    const auto point = points_.find(mark.point);
    if (point == points_.end() || known_[point->second]) continue;
    throw InputError(mark.place.path, mark.place.line,
                     "the rays to point \"" + mark.point + "\" do not meet before the cameras");
  }
  for (size_t i = 0; i < known_.size(); ++i) network().points[i].position = *known_[i];
}

ImportedProject Project::Build() {
  posed_.resize(network().photos.size());
  if (script_.start_from_prior_orientations) PlacePhotosFromPrior();
  PlaceByTurns();
  TakeStartValues();
  return std::move(project_);
}

}  // namespace

ImportedProject ReadDbatProject(const std::filesystem::path& path) {
  const DbatScript script = ReadDbatScript(path);
  return Project(script).Build();
}

}  // namespace insitu
