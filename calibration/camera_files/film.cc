// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/camera_files/film.h"

#include <math.h>  // boost's pchip calls isnan without its namespace

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <boost/math/interpolators/pchip.hpp>
#include <cmath>

#include "calibration/algebra/decompositions.h"
#include "calibration/files/csv_file.h"
#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/files/wording.h"

namespace insitu {
namespace {

constexpr double kOpencvSuffices_px = 0.05;

// Moves the centroid to the origin and the mean distance from it to 1.
Eigen::Matrix3d Normalizing(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& point : points) center += point / static_cast<double>(points.size());
  double distance = 0;
  for (const Eigen::Vector2d& point : points) distance += (point - center).norm();
  const double scale = static_cast<double>(points.size()) / std::max(distance, 1e-300);
  Eigen::Matrix3d matrix;
  matrix << scale, 0, -scale * center.x(), 0, scale, -scale * center.y(), 0, 0, 1;
  return matrix;
}

Eigen::Vector2d Mapped(const Eigen::Matrix3d& map, const Eigen::Vector2d& point) {
  return (map * point.homogeneous()).hnormalized();
}

// How the mapped places change with the first `count` of the map's elements, row by row.
Eigen::MatrixXd DesignOf(const std::vector<Eigen::Vector2d>& from, const Eigen::Matrix3d& map,
                         int count) {
  Eigen::MatrixXd design = Eigen::MatrixXd::Zero(2 * from.size(), count);
  for (size_t i = 0; i < from.size(); ++i) {
    const Eigen::Vector3d mapped = map * from[i].homogeneous();
    const Eigen::Vector2d position = mapped.hnormalized();
    for (const Eigen::Index axis : {0, 1}) {
      const auto row = static_cast<Eigen::Index>(2 * i + axis);
      design.block<1, 3>(row, 3 * axis) = from[i].homogeneous().transpose() / mapped.z();
      if (count > 6) {
        design.block<1, 2>(row, 6) = -position[axis] / mapped.z() * from[i].transpose();
      }
    }
  }
  return design;
}

// One Gauss-Newton step on the first `count` of the map's elements; false: singular. `root_weights`
// of the coordinates.
bool Improve(const std::vector<Eigen::Vector2d>& from, const std::vector<Eigen::Vector2d>& to,
             const Eigen::VectorXd& root_weights, int count, Eigen::Matrix3d* map) {
  Eigen::VectorXd rest(2 * from.size());
  for (size_t i = 0; i < from.size(); ++i) rest.segment<2>(2 * i) = to[i] - Mapped(*map, from[i]);
  rest.array() *= root_weights.array();
  const LeastSquaresSolution step =
      SolveLeastSquares(root_weights.asDiagonal() * DesignOf(from, *map, count), rest, 1e-9);
  if (step.rank < count) return false;
  for (int i = 0; i < count; ++i) (*map)(i / 3, i % 3) += step.x(i);
  return true;
}

// The diagonal of I - A (A^T A)^-1 A^T.
std::vector<Eigen::Vector2d> RedundanciesOf(const Eigen::MatrixXd& design) {
  const Eigen::MatrixXd basis = OrthonormalBasis(design);
  std::vector<Eigen::Vector2d> redundancies;
  for (Eigen::Index row = 0; row < design.rows(); row += 2) {
    const Eigen::Vector2d used = basis.middleRows<2>(row).rowwise().squaredNorm();
    redundancies.push_back((1 - used.array()).max(0));
  }
  return redundancies;
}

int Parameters(FilmTransformation transformation) {
  return transformation == FilmTransformation::kAffine ? 6 : 8;
}

std::map<std::string, Eigen::Vector2d> CertifiedMarks(const JsonNode& list) {
  std::map<std::string, Eigen::Vector2d> marks;
  for (const JsonNode& item : list.Items()) {
    const std::string mark = item.At("mark").Text();
    const Eigen::Vector2d image_mm(item.At("x_mm").Number(), item.At("y_mm").Number());
    if (!marks.emplace(mark, image_mm).second) throw item.Error("mark " + mark + " stands twice");
  }
  return marks;
}

bool HoldsFilm(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / "film.json") ||
         std::filesystem::exists(folder / "fiducials.csv");
}

std::vector<std::filesystem::path> FoldersIn(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> folders;
  if (!std::filesystem::is_directory(folder)) return folders;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const bool is_hidden = entry.path().filename().string().starts_with('.');
    if (entry.is_directory() && !is_hidden) folders.push_back(entry.path());
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

FilmTransformation TransformationOf(const JsonNode& file) {
  const auto node = file.Find("transformation");
  if (!node || node->Text() == "affine") return FilmTransformation::kAffine;
  if (node->Text() == "projective") return FilmTransformation::kProjective;
  throw node->Error("is \"" + node->Text() + "\", expected affine or projective");
}

void CheckSame(const CsvRow& row, const std::map<std::string, Eigen::Vector2d>& calibrated,
               const Fiducial& fiducial) {
  const Eigen::Vector2d& other = calibrated.at(fiducial.mark);
  if (other == fiducial.image_mm) return;
  throw row.Error("mark " + fiducial.mark +
                  " has other millimetres than further up, expected those of one camera");
}

// Of a mark that is switched off the line is a comment, so nothing else can stand there.
double SigmaTimes(const CsvRow& row) {
  const std::string* state = row.Find("state");
  if (state == nullptr || *state == "on") return 1;
  if (*state == "dubious") return kDubiousFiducial;
  throw row.Error("state is " + Quoted(*state) + ", expected dubious or nothing");
}

}  // namespace

std::map<std::string, std::vector<Fiducial>> ReadFiducials(const std::filesystem::path& path) {
  std::map<std::string, std::vector<Fiducial>> marks_of_photo;
  std::map<std::string, Eigen::Vector2d> calibrated;
  for (const CsvRow& row : ReadCsv(path, {"mark", "x_mm", "y_mm", "photo", "x", "y"})) {
    const Fiducial fiducial{row.Text("mark"),
                            {row.Number("x_mm"), row.Number("y_mm")},
                            {row.Number("x"), row.Number("y")},
                            SigmaTimes(row)};
    calibrated.emplace(fiducial.mark, fiducial.image_mm);
    CheckSame(row, calibrated, fiducial);
    std::vector<Fiducial>& marks = marks_of_photo[row.Text("photo")];
    for (const Fiducial& other : marks) {
      if (other.mark == fiducial.mark) {
        throw row.Error("mark " + fiducial.mark + " stands twice for photo " + row.Text("photo"));
      }
    }
    marks.push_back(fiducial);
  }
  return marks_of_photo;
}

std::optional<FilmMap> FitFilmMap(const std::vector<Fiducial>& marks,
                                  FilmTransformation transformation) {
  const int count = Parameters(transformation);
  const auto observations = static_cast<int>(2 * marks.size());
  if (observations < count) return std::nullopt;
  std::vector<Eigen::Vector2d> image, bitmap;
  Eigen::VectorXd root_weights(observations);
  for (const Fiducial& fiducial : marks) {
    root_weights.segment<2>(2 * static_cast<Eigen::Index>(image.size()))
        .setConstant(1 / fiducial.sigma_times);
    image.push_back(fiducial.image_mm);
    bitmap.push_back(fiducial.bitmap_px);
  }
  const Eigen::Matrix3d to_image = Normalizing(image), to_bitmap = Normalizing(bitmap);
  for (Eigen::Vector2d& point : image) point = Mapped(to_image, point);
  for (Eigen::Vector2d& point : bitmap) point = Mapped(to_bitmap, point);
  Eigen::Matrix3d map = Eigen::Matrix3d::Identity();
  if (!Improve(image, bitmap, root_weights, 6, &map)) return std::nullopt;
  constexpr int kSteps = 12;  // of a problem that is nearly linear
  for (int i = 0; count > 6 && i < kSteps; ++i) {
    if (!Improve(image, bitmap, root_weights, count, &map)) return std::nullopt;
  }
  FilmMap result{.transformation = transformation};
  result.bitmap_from_image = to_bitmap.inverse() * map * to_image;
  result.bitmap_from_image /= result.bitmap_from_image(2, 2);
  double sum = 0;
  for (const Fiducial& fiducial : marks) {
    result.residuals_px.push_back(Mapped(result.bitmap_from_image, fiducial.image_mm) -
                                  fiducial.bitmap_px);
    sum += (result.residuals_px.back() / fiducial.sigma_times).squaredNorm();
  }
  result.redundancies = RedundanciesOf(root_weights.asDiagonal() * DesignOf(image, map, count));
  if (observations > count) result.sigma_px = std::sqrt(sum / (observations - count));
  return result;
}

FilmCamera ReadFilmCamera(const std::filesystem::path& path) {
  const JsonNode file = JsonNode::Load(path);
  FilmCamera film;
  film.path = path;
  film.focal_mm = file.At("focal_mm").Number();
  if (!(film.focal_mm > 0)) throw file.At("focal_mm").Error("is not positive");
  if (const auto point = file.Find("principal_point_mm")) {
    const std::vector<double> numbers = point->Numbers();
    if (numbers.size() != 2) throw point->Error("expected two numbers, x and y");
    film.principal_point_mm = {numbers[0], numbers[1]};
  }
  film.transformation = TransformationOf(file);
  if (const auto list = file.Find("fiducials")) film.fiducials = CertifiedMarks(*list);
  const auto table = file.Find("distortion");
  if (!table) return film;
  for (const JsonNode& row : table->Items()) {
    const std::vector<double> numbers = row.Numbers();
    const bool rises = numbers.size() == 2 &&
                       numbers[0] > (film.distortion.empty() ? 0 : film.distortion.back().x());
    if (!rises) throw row.Error("expected [radius_mm, distortion_mm] with radii rising from > 0");
    film.distortion.emplace_back(numbers[0], numbers[1]);
  }
  if (film.distortion.size() == 1) throw table->Error("expected two radii or more, or none");
  return film;
}

void CheckCertified(const FilmCamera& film, const std::filesystem::path& fiducials,
                    const std::vector<Fiducial>& marks) {
  if (film.fiducials.empty()) return;
  for (const Fiducial& fiducial : marks) {
    const auto listed = film.fiducials.find(fiducial.mark);
    if (listed != film.fiducials.end() && listed->second == fiducial.image_mm) continue;
    throw InputError(fiducials,
                     "mark " + fiducial.mark +
                         (listed == film.fiducials.end() ? " is not among those of "
                                                         : " has other millimetres in ") +
                         film.path.string());
  }
}

std::vector<std::filesystem::path> FilmFolders(const std::filesystem::path& calibration) {
  std::vector<std::filesystem::path> folders = FoldersIn(calibration);
  folders.insert(folders.begin(), calibration);
  std::erase_if(folders, [](const auto& folder) { return !HoldsFilm(folder); });
  return folders;
}

std::filesystem::path FilmFolder(const std::filesystem::path& calibration) {
  const std::vector<std::filesystem::path> folders = FilmFolders(calibration);
  if (!folders.empty()) return folders.front();
  return FoldersIn(calibration).empty() ? calibration : calibration / "film";
}

double DistortionAt(const FilmCamera& film, double radius_mm) {
  if (film.distortion.empty()) return 0;
  std::vector<double> radii = {0}, values = {0};
  for (const Eigen::Vector2d& row : film.distortion) {
    radii.insert(radii.begin(), -row.x());  // an odd function has a smooth start
    values.insert(values.begin(), -row.y());
    radii.push_back(row.x());
    values.push_back(row.y());
  }
  const double last = radii.back(), value = values.back();
  boost::math::interpolators::pchip curve(std::move(radii), std::move(values));
  if (radius_mm < last) return curve(radius_mm);
  return value + (radius_mm - last) * curve.prime(last);
}

Eigen::Vector3d SightOfFilm(const FilmCamera& film, const Eigen::Vector2d& image_mm) {
  const Eigen::Vector2d measured = image_mm - film.principal_point_mm;
  const double radius = measured.norm();
  const double scale = radius > 0 ? 1 - DistortionAt(film, radius) / radius : 1;
  return {scale * measured.x(), -scale * measured.y(), film.focal_mm};
}

std::optional<CameraFit> FitFilmCamera(const FilmCamera& film, const FilmMap& map, int width,
                                       int height) {
  const Eigen::Matrix2d linear = map.bitmap_from_image.topLeftCorner<2, 2>();
  if (!(linear.determinant() < 0)) return std::nullopt;  // y up to y down: else it is mirrored
  const Eigen::Matrix3d image_from_bitmap = map.bitmap_from_image.inverse();
  const auto sight = [&](const Eigen::Vector2d& pixel) {
    return SightOfFilm(film, Mapped(image_from_bitmap, pixel));
  };
  FitCameraOptions options;
  options.turn_axes = true;
  options.start_fit_from_lens =
      Eigen::AngleAxisd(std::atan2(linear(1, 0), linear(0, 0)), Eigen::Vector3d::UnitZ());
  auto fit = FitCamera(sight, width, height, options);
  if (fit && fit->largest_deviation_px <= kOpencvSuffices_px) return fit;
  const double half_width = 0.5 * width / std::sqrt(std::abs(linear.determinant()));
  const double fov_deg = 1.3 * 2 * std::atan(half_width / film.focal_mm) * 180 / M_PI;
  options.lens_model = "LENSMODEL_SPLINED_STEREOGRAPHIC_order=3_Nx=14_Ny=" +
                       std::to_string(std::max(6, 14 * height / width + 1)) +
                       "_fov_x_deg=" + std::to_string(static_cast<int>(std::ceil(fov_deg)));
  options.turn_axes = false;  // the spline shows any turn
  if (fit) options.start_fit_from_lens = fit->fit_from_lens;
  const auto splined = FitCamera(sight, width, height, options);
  if (!splined) return fit;
  return fit && fit->largest_deviation_px < splined->largest_deviation_px ? fit : splined;
}

}  // namespace insitu
