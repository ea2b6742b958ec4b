// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/reconstruction/network/random_network.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <random>
#include <set>

#include "reconstruction/geometry/plane.h"

namespace insitu {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  double Normal(double sigma) { return std::normal_distribution<double>(0, sigma)(generator_); }
  Vector3d Normal3(const Vector3d& sigma) {
    return {Normal(sigma.x()), Normal(sigma.y()), Normal(sigma.z())};
  }

 private:
  std::mt19937 generator_;
};

constexpr double kPlaneSigma = 0.004, kSunSigma = 0.02, kZenithSigma = 0.005;  // [m]

// Builds the truth. Boxes stand on the plane across the zenith through the origin.
class Town {
 public:
  explicit Town(unsigned seed) : random_(seed) {}

  Network Build() {
    zenith_ = Vector3d(random_.Uniform(-0.02, 0.02), random_.Uniform(-0.02, 0.02), 1).normalized();
    east_ = zenith_.unitOrthogonal();
    north_ = zenith_.cross(east_);
    network_.origin = {2600000, 1200000, 400};
    const double azimuth = random_.Uniform(0, 2 * M_PI), height = random_.Uniform(0.5, 1.2);
    sun_ = Local(std::cos(azimuth) * std::cos(height), std::sin(azimuth) * std::cos(height),
                 std::sin(height));
    network_.directions = {{"sun", sun_}, {"zenith", zenith_}};
    AddGround();
    for (int i = 0; i < 3; ++i) AddBox(Local(9.0 * i - 9, random_.Uniform(-4, 4), 0));
    AddControlAndTiePoints();
    AddPhotos();
    AddMarks();
    SurveyWhatNoPhotoShows();
    AddConstraints();
    return std::move(network_);
  }

 private:
  Vector3d Local(double east, double north, double up) const {
    return east * east_ + north * north_ + up * zenith_;
  }

  int AddPoint(const Vector3d& position) {
    const int index = static_cast<int>(network_.points.size());
    network_.points.push_back({std::to_string(index), position});
    return index;
  }

  int AddPlane(const std::vector<int>& vertices, const Vector3d& normal) {
    Vector3d centroid = Vector3d::Zero();
    for (const int v : vertices) centroid += network_.points[v].position / vertices.size();
    const int index = static_cast<int>(network_.planes.size());
    network_.planes.push_back({"plane" + std::to_string(index), normal, centroid, 0});
    for (const int v : vertices) network_.on_planes.push_back({index, v, kPlaneSigma});
    return index;
  }

  void AddGround() {
    std::vector<int> corners;
    for (const auto& [x, y] : {std::pair{-18., -14.}, {18., -14.}, {18., 14.}, {-18., 14.}}) {
      corners.push_back(AddPoint(Local(x, y, 0)));
    }
    AddPlane(corners, zenith_);
  }

  void AddBox(const Vector3d& foot) {
    const double turn = random_.Uniform(0, M_PI / 2);
    const Vector3d right = Local(std::cos(turn), std::sin(turn), 0) * random_.Uniform(3, 5);
    const Vector3d back = Local(-std::sin(turn), std::cos(turn), 0) * random_.Uniform(3, 5);
    const Vector3d up = zenith_ * random_.Uniform(4, 9);
    std::array<int, 8> corner{};
    for (int i = 0; i < 8; ++i) {
      corner[i] = AddPoint(foot + (i & 1 ? right : Vector3d::Zero()) +
                           (i & 2 ? back : Vector3d::Zero()) + (i & 4 ? up : Vector3d::Zero()));
    }
    walls_.push_back(AddPlane({corner[0], corner[1], corner[5], corner[4]}, -back.normalized()));
    walls_.push_back(AddPlane({corner[1], corner[3], corner[7], corner[5]}, right.normalized()));
    AddPlane({corner[4], corner[5], corner[7], corner[6]}, zenith_);
    for (const auto& [bottom, top] : {std::pair{0, 4}, {1, 5}, {3, 7}}) {
      network_.along_directions.push_back({1, corner[bottom], corner[top], kZenithSigma});
    }
    // The shadow of a roof's corner on the ground.
    const Vector3d top = network_.points[corner[5]].position;
    const int shadow = AddPoint(top - sun_ * (top.dot(zenith_) / sun_.dot(zenith_)));
    network_.along_directions.push_back({0, shadow, corner[5], kSunSigma});
    network_.on_planes.push_back({0, shadow, kPlaneSigma});
    tops_.push_back(corner[5]);
    neighbours_.push_back(corner[4]);
  }

  void AddControlAndTiePoints() {
    const double sigma = random_.Uniform(0.003, 0.008);
    for (int i = 0; i < 7; ++i) {
      const int point = AddPoint(
          Local(random_.Uniform(-14, 14), random_.Uniform(-10, 10), random_.Uniform(0, 3)));
      network_.control.push_back(
          {point, network_.points[point].position, {sigma, sigma, 2 * sigma}});
    }
    for (int i = 0; i < 25; ++i) {
      const int point = AddPoint(
          Local(random_.Uniform(-14, 14), random_.Uniform(-10, 10), random_.Uniform(0, 8)));
      network_.points[point].is_tie_point = true;
    }
  }

  void AddPhotos() {
    const double focal = random_.Uniform(1800, 2600);
    network_.cameras.push_back(
        {"camera", Camera("LENSMODEL_OPENCV4",
                          {focal, focal, 1499.5, 999.5, -0.1, 0.05, 1e-3, -1e-3}, 3000, 2000)});
    for (int i = 0; i < 5; ++i) {
      const double angle = -0.9 + 0.45 * i + random_.Uniform(-0.1, 0.1);
      const double distance = random_.Uniform(28, 42);
      const Vector3d center =
          Local(distance * std::sin(angle), -distance * std::cos(angle), random_.Uniform(1.5, 9));
      const Vector3d forward =
          (Local(random_.Uniform(-2, 2), random_.Uniform(-2, 2), random_.Uniform(1, 4)) - center)
              .normalized();
      Eigen::Matrix3d cam_from_local;
      cam_from_local.row(2) = forward;
      cam_from_local.row(0) = forward.cross(zenith_).normalized();
      cam_from_local.row(1) = forward.cross(cam_from_local.row(0).transpose());
      network_.photos.push_back(
          {"photo" + std::to_string(i), 0, Eigen::Quaterniond(cam_from_local), center});
    }
    network_.centers.push_back({2, network_.photos[2].center, Vector3d::Constant(0.01)});
  }

  std::optional<Vector2d> PixelOf(const NetworkPhoto& photo, const Vector3d& point) const {
    const Camera& camera = std::get<Camera>(network_.cameras[0].lens);
    const auto pixel = camera.Project(photo.cam_from_local * (point - photo.center));
    if (!pixel || !camera.Sees(*pixel)) return std::nullopt;
    return pixel;
  }

  void AddMarks() {
    const double sigma = random_.Uniform(0.3, 0.8);
    for (int photo = 0; photo < static_cast<int>(network_.photos.size()); ++photo) {
      for (int point = 0; point < static_cast<int>(network_.points.size()); ++point) {
        const auto pixel = PixelOf(network_.photos[photo], network_.points[point].position);
        if (pixel) network_.marks.push_back({photo, point, *pixel, sigma});
      }
      for (size_t i = 0; i < tops_.size(); ++i) {
        const Vector3d a = network_.points[tops_[i]].position;
        const Vector3d b = network_.points[neighbours_[i]].position;
        const auto pixel = PixelOf(network_.photos[photo], a + random_.Uniform(0.2, 0.8) * (b - a));
        if (pixel) network_.edges.push_back({photo, tops_[i], neighbours_[i], *pixel, 2 * sigma});
      }
    }
  }

  // A plane alone does not determine its vertex.
  void SurveyWhatNoPhotoShows() {
    std::set<int> known;
    for (const MarkObservation& mark : network_.marks) known.insert(mark.point);
    for (const ControlObservation& control : network_.control) known.insert(control.point);
    for (int point = 0; point < static_cast<int>(network_.points.size()); ++point) {
      if (known.contains(point)) continue;
      network_.control.push_back(
          {point, network_.points[point].position, Vector3d::Constant(0.005)});
    }
  }

  void AddConstraints() {
    const auto position = [&](int point) { return network_.points[point].position; };
    network_.distances.push_back(
        {tops_[0], tops_[1], (position(tops_[0]) - position(tops_[1])).norm(), 0.005});
    network_.heights.push_back(
        {1, tops_[0], tops_[2], (position(tops_[2]) - position(tops_[0])).dot(zenith_), 0.005});
    for (size_t i = 0; i < walls_.size(); i += 2) {
      network_.angles.push_back({PlaneNormal{walls_[i]}, DirectionUnit{1}, false, 0.002});
      network_.angles.push_back({PlaneNormal{walls_[i]}, PlaneNormal{walls_[i + 1]}, false, 0.002});
      network_.angles.push_back(
          {EdgeUnit{tops_[i / 2], neighbours_[i / 2]}, DirectionUnit{1}, false, 0.002});
    }
    network_.angles.push_back({PlaneNormal{0}, DirectionUnit{1}, true, 0.001});
  }

  Random random_;
  Network network_;
  Vector3d zenith_, east_, north_, sun_;
  std::vector<int> walls_, tops_, neighbours_;
};

}  // namespace

Network MakeRandomNetwork(unsigned seed) { return Town(seed).Build(); }

Network WithNoise(const Network& truth, unsigned seed) {
  Random random(seed);
  Network noisy = truth;
  for (MarkObservation& mark : noisy.marks) {
    mark.pixel += Vector2d(random.Normal(mark.sigma_px), random.Normal(mark.sigma_px));
  }
  for (ControlObservation& control : noisy.control) {
    control.position += random.Normal3(control.sigma);
  }
  for (CenterObservation& center : noisy.centers) center.position += random.Normal3(center.sigma);
  for (DistanceObservation& d : noisy.distances) d.distance += random.Normal(d.sigma);
  for (HeightObservation& h : noisy.heights) h.height += random.Normal(h.sigma);
  for (PlaneObservation& p : noisy.on_planes) p.distance += random.Normal(p.sigma);
  for (DirectionObservation& d : noisy.along_directions) {
    d.across += Vector2d(random.Normal(d.sigma), random.Normal(d.sigma));
  }
  for (AngleObservation& a : noisy.angles) {
    a.departure += Vector2d(random.Normal(a.sigma), random.Normal(a.sigma));
  }
  for (EdgeObservation& edge : noisy.edges) {
    edge.pixel += Vector2d(random.Normal(edge.sigma_px), random.Normal(edge.sigma_px));
  }
  return noisy;
}

Network WithRoughStart(const Network& network, unsigned seed) {
  Random random(seed);
  Network rough = network;
  const auto turn = [&] {
    const Vector3d axis = random.Normal3(Vector3d::Constant(1)).normalized();
    return Eigen::Quaterniond(Eigen::AngleAxisd(random.Normal(0.003), axis));
  };
  for (NetworkPhoto& photo : rough.photos) {
    photo.center += random.Normal3(Vector3d::Constant(0.05));
    photo.cam_from_local = (turn() * photo.cam_from_local).normalized();
  }
  for (NetworkPoint& point : rough.points)
    point.position += random.Normal3(Vector3d::Constant(0.02));
  for (NetworkPlane& plane : rough.planes) plane.normal = (turn() * plane.normal).normalized();
  for (NetworkDirection& direction : rough.directions) {
    direction.unit = (turn() * direction.unit).normalized();
  }
  return rough;
}

}  // namespace insitu
