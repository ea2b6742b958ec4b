// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/colmap_export.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "calibration/files/error.h"
#include "calibration/lens/lens_residual.h"

namespace insitu {
namespace {

constexpr double kGoodFitPx = 0.01;
constexpr int kSteps = 30;  // of the grid over a photograph, each way

using RowMajor2 = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor>;

struct Sample {
  Eigen::Vector2d pixel;
  Eigen::Vector3d point;  // that it shows, (x / z, y / z, 1)
};

// By Newton's method on the lens's own residual, from a sight along the axis.
std::optional<Sample> SampleAt(const Lens& lens, const Eigen::Vector2d& pixel) {
  const std::vector<double> parameters = LensParameters(lens);
  Sample sample{pixel, Eigen::Vector3d::UnitZ()};
  for (int iteration = 0; iteration < 50; ++iteration) {
    Eigen::Vector2d residual;
    Eigen::Matrix<double, 2, 3> by_point;
    LensDerivatives derivatives;
    derivatives.by_point = &by_point;
    if (!LensResidual(lens, parameters.data(), sample.point, pixel, &residual, derivatives)) break;
    const Eigen::Vector2d step = by_point.leftCols<2>().inverse() * residual;
    if (!step.allFinite()) break;
    sample.point.head<2>() -= step;
    if (step.norm() < 1e-13) return sample;
  }
  return std::nullopt;
}

Eigen::Vector2i SizeOf(const Lens& lens) {
  if (const auto* camera = std::get_if<Camera>(&lens)) return {camera->width(), camera->height()};
  const auto& metric = std::get<MetricCamera>(lens);
  return {metric.width, metric.height};
}

std::vector<Sample> SamplesOver(const Lens& lens) {
  const Eigen::Vector2i size = SizeOf(lens);
  std::vector<Sample> samples;
  for (int row = 0; row <= kSteps; ++row) {
    for (int column = 0; column <= kSteps; ++column) {
      const Eigen::Vector2d pixel(-0.5 + size.x() * column / double{kSteps},
                                  -0.5 + size.y() * row / double{kSteps});
      if (const auto sample = SampleAt(lens, pixel)) samples.push_back(*sample);
    }
  }
  return samples;
}

// The shortest of the least-squares solutions.
Eigen::VectorXd LeastSquares(const Eigen::MatrixXd& design, const Eigen::VectorXd& right) {
  return design.completeOrthogonalDecomposition().solve(right);
}

// Of pixels as a linear function of x / z and y / z each.
std::vector<double> PinholeOf(const std::vector<Sample>& samples) {
  std::vector<double> focal_and_center(4);
  for (int axis = 0; axis < 2; ++axis) {
    Eigen::MatrixXd design(samples.size(), 2);
    Eigen::VectorXd pixels(samples.size());
    for (size_t i = 0; i < samples.size(); ++i) {
      design.row(static_cast<Eigen::Index>(i)) << samples[i].point[axis], 1;
      pixels[static_cast<Eigen::Index>(i)] = samples[i].pixel[axis];
    }
    const Eigen::Vector2d line = LeastSquares(design, pixels);
    focal_and_center[static_cast<size_t>(axis)] = line[0];
    focal_and_center[static_cast<size_t>(axis) + 2] = line[1];
  }
  return focal_and_center;
}

double LargestDifference(const Camera& camera, const std::vector<Sample>& samples) {
  double largest = 0;
  for (const Sample& sample : samples) {
    const auto pixel = camera.Project(sample.point);
    if (!pixel || !pixel->allFinite()) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, (*pixel - sample.pixel).norm());
  }
  return largest;
}

// Least squares over the samples from `intrinsics` on; parameters that the samples do not tell
// apart take the shortest step.
Camera Fitted(const std::string& model, std::vector<double> intrinsics,
              const std::vector<Sample>& samples, const Eigen::Vector2i& size) {
  const auto count = static_cast<Eigen::Index>(intrinsics.size());
  const Camera camera(model, intrinsics, size.x(), size.y());
  for (int iteration = 0; iteration < 30; ++iteration) {
    Eigen::MatrixXd jacobian(2 * samples.size(), count);
    Eigen::VectorXd misclosure(2 * samples.size());
    for (size_t i = 0; i < samples.size(); ++i) {
      RowMajor2 by_parameters(2, count);
      const auto pixel =
          camera.ProjectWith(intrinsics.data(), samples[i].point, nullptr, by_parameters.data());
      const auto row = static_cast<Eigen::Index>(2 * i);
      jacobian.middleRows<2>(row) = by_parameters;
      misclosure.segment<2>(row) = samples[i].pixel - *pixel;
    }
    const Eigen::VectorXd scale = jacobian.colwise().norm().cwiseMax(1e-12);
    const Eigen::VectorXd step =
        LeastSquares(jacobian * scale.cwiseInverse().asDiagonal(), misclosure);
    for (Eigen::Index k = 0; k < count; ++k)
      intrinsics[static_cast<size_t>(k)] += step[k] / scale[k];
    if (!step.allFinite() || step.norm() < 1e-9) break;
  }
  return Camera(model, intrinsics, size.x(), size.y());
}

// A mark on its way into a model, all by index.
struct ExportedMark {
  int photo = 0, point = 0;
  Eigen::Vector2d pixel;
  double error_px = 0;
};

uint32_t Id(int index) { return static_cast<uint32_t>(index) + 1; }

// Keypoints for all marks, and tracks for points with two or more.
void AddMarks(const std::vector<ExportedMark>& marks, const std::vector<Eigen::Vector3d>& positions,
              ColmapModel* model) {
  std::map<int, std::vector<const ExportedMark*>> marks_of_point;
  for (const ExportedMark& mark : marks) marks_of_point[mark.point].push_back(&mark);
  for (const auto& [index, its_marks] : marks_of_point) {
    ColmapPoint point{positions[static_cast<size_t>(index)], {128, 128, 128}, 0, {}};
    for (const ExportedMark* mark : its_marks) {
      ColmapImage& image = model->images.at(Id(mark->photo));
      const auto keypoint = static_cast<uint32_t>(image.keypoints.size());
      image.keypoints.push_back({ColmapFromPixel(mark->pixel), std::nullopt});
      if (its_marks.size() < 2) continue;
      image.keypoints.back().point = Id(index);
      point.track.push_back({Id(mark->photo), keypoint});
      point.error_px += mark->error_px / static_cast<double>(its_marks.size());
    }
    if (!point.track.empty()) model->points[Id(index)] = point;
  }
}

// What COLMAP will see of it, in its lens: residuals of a fitted lens differ by what the fit does.
double Error(const Network& network, const std::vector<std::optional<Camera>>& cameras,
             const MarkObservation& mark) {
  const NetworkPhoto& photo = network.photos[mark.photo];
  const auto pixel = cameras[photo.camera]->Project(
      photo.cam_from_local * (network.points[mark.point].position - photo.center));
  return pixel ? (*pixel - mark.pixel).norm() : 0;
}

}  // namespace

ColmapLensFit FitColmapLens(const Lens& lens) {
  if (const auto* camera = std::get_if<Camera>(&lens)) {
    if (const auto exact = ColmapFromCamera(*camera)) return {*exact, 0};
  }
  const std::vector<Sample> samples = SamplesOver(lens);
  INSITU_CHECK(samples.size() >= kSteps);
  std::vector<double> start = PinholeOf(samples);
  std::optional<Camera> best;
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& [model, parameters] : std::vector<std::pair<std::string, size_t>>{
           {"LENSMODEL_OPENCV4", 8}, {"LENSMODEL_OPENCV5", 9}, {"LENSMODEL_OPENCV8", 12}}) {
    start.resize(parameters, 0);
    const Camera fitted = Fitted(model, start, samples, SizeOf(lens));
    const double largest = LargestDifference(fitted, samples);
    if (largest < smallest) {
      smallest = largest;
      best = fitted;
      start = fitted.intrinsics();
    }
    if (smallest < kGoodFitPx) break;
  }
  INSITU_CHECK(best.has_value());
  return {*ColmapFromCamera(*best), smallest};
}

ColmapModel ColmapFromNetwork(const Network& network) {
  ColmapModel model;
  std::vector<std::optional<Camera>> cameras;
  for (size_t i = 0; i < network.cameras.size(); ++i) {
    const ColmapLens lens = FitColmapLens(network.cameras[i].lens).lens;
    model.cameras[Id(static_cast<int>(i))] = lens;
    cameras.push_back(CameraFromColmap(lens));
  }
  for (size_t i = 0; i < network.photos.size(); ++i) {
    const NetworkPhoto& photo = network.photos[i];
    const Eigen::Vector3d center = photo.center + network.origin;
    model.images[Id(static_cast<int>(i))] = {
        photo.name, Id(photo.camera), {photo.cam_from_local, -(photo.cam_from_local * center)}, {}};
  }
  std::vector<Eigen::Vector3d> positions;
  for (const NetworkPoint& point : network.points) {
    positions.push_back(point.position + network.origin);
  }
  std::vector<ExportedMark> marks;
  for (const MarkObservation& mark : network.marks) {
    marks.push_back({mark.photo, mark.point, mark.pixel, Error(network, cameras, mark)});
  }
  AddMarks(marks, positions, &model);
  return model;
}

ColmapModel ColmapFromAdjustment(const Adjustment& adjustment) {
  ColmapModel model;
  std::map<std::string, int> index_of_photo, index_of_point;
  for (size_t i = 0; i < adjustment.scene.cameras.size(); ++i) {
    const PosedCamera& posed = adjustment.scene.cameras[i];
    const ColmapLens lens = FitColmapLens(posed.camera).lens;
    auto known = std::find_if(model.cameras.begin(), model.cameras.end(),
                              [&](const auto& camera) { return camera.second == lens; });
    if (known == model.cameras.end()) {
      known = model.cameras.emplace(Id(static_cast<int>(i)), lens).first;
    }
    index_of_photo[posed.photo] = static_cast<int>(i);
    model.images[Id(static_cast<int>(i))] = {posed.photo, known->first, posed.cam_from_world, {}};
  }
  std::vector<Eigen::Vector3d> positions;
  for (const AdjustedPoint& point : adjustment.points) {
    index_of_point[point.name] = static_cast<int>(positions.size());
    positions.push_back(point.position);
  }
  std::vector<ExportedMark> marks;
  const auto& rows = adjustment.residuals;
  for (size_t i = 0; i + 1 < rows.size(); ++i) {  // both coordinates of a mark stand together
    if (rows[i].kind != ObservationKind::kImage || rows[i].axis != 0) continue;
    marks.push_back({index_of_photo.at(rows[i].photo),
                     index_of_point.at(rows[i].subject),
                     {rows[i].observed, rows[i + 1].observed},
                     std::hypot(rows[i].residual, rows[i + 1].residual)});
  }
  AddMarks(marks, positions, &model);
  return model;
}

}  // namespace insitu
