// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/camera_calibration.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "calibration/boards/calibration_verdict.h"
#include "calibration/camera_files/read_camera_file.h"
#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "calibration/files/wording.h"
#include "calibration/photo/exif.h"
#include "calibration/photo/photograph.h"

namespace insitu {
namespace fs = std::filesystem;
namespace {

constexpr double kStatedDeviation_px = 0.1;  // more of a fitted lens is worth a word

void JudgeDeviation(double deviation_px, CameraCalibration* camera) {
  if (deviation_px <= kStatedDeviation_px) return;
  camera->findings.push_back(
      {deviation_px > 1 ? Severity::kFail : Severity::kReview,
       Formatted("mrcal's lens model follows the lens as it was given up to %.2f px only.",
                 deviation_px),
       "Calibrate the camera with a board."});
}

// ---- boards --------------------------------------------------------------------------------

// A lens is calibrated at one zoom setting; EXIF tells where that was not heeded: against the first
// that states its focal length, a board if one does.
void JudgeFocalLengths(const std::vector<fs::path>& boards, const std::vector<fs::path>& photos,
                       CameraCalibration* camera) {
  std::vector<fs::path> all = boards;
  all.insert(all.end(), photos.begin(), photos.end());
  std::optional<double> first_mm;
  std::string first;
  for (size_t i = 0; i < all.size(); ++i) {
    const auto focal_mm = ReadExifCamera(all[i]).focal_mm;
    if (!focal_mm) continue;
    if (!first_mm) {
      first_mm = focal_mm;
      first = i < boards.size() ? "the boards" : all[i].filename().string();
    }
    if (std::abs(*focal_mm / *first_mm - 1) < 0.02) continue;
    camera->findings.push_back(
        {Severity::kFail,
         all[i].filename().string() + Formatted(" was taken at %.1f mm, ", *focal_mm) + first +
             Formatted(" at %.1f mm.", *first_mm),
         "Calibrate each zoom setting with boards of its own, in a folder of its own."});
    return;
  }
}

CameraCalibration FromBoards(const SitePaths& site, const CameraFolder& folder,
                             const std::vector<fs::path>& photos,
                             const BoardCalibrationOptions& options) {
  const Board board = ReadBoard(folder.folder / "board.txt");
  const fs::path model = site.camera(folder.name);
  const BoardCalibration boards = CalibrateFromBoards(folder.board_photos, board, model, options);
  CameraCalibration camera{.name = folder.name, .camera = ReadCamera(model)};
  camera.findings = JudgeBoards(boards, {camera.camera.width(), camera.camera.height()});
  JudgeFocalLengths(folder.board_photos, photos, &camera);
  camera.lens = boards.lens;
  camera.boards = boards;
  return camera;
}

// ---- camera files --------------------------------------------------------------------------

void NoteUnusedBoards(const CameraFolder& folder, CameraCalibration* camera) {
  if (folder.board_photos.empty()) return;
  const std::string file = folder.file.filename().string();
  camera->findings.push_back(
      {Severity::kNote,
       "The board photographs beside " + file + " are not used: a finished camera goes first.",
       "Take " + file + " out of the folder to calibrate from the boards."});
}

CameraCalibration FromFile(const SitePaths& site, const CameraFolder& folder,
                           const std::vector<fs::path>& photos) {
  CameraFileOptions options{.photo_size = std::nullopt, .camera = folder.name};
  if (!photos.empty()) options.photo_size = ReadPhotographSize(photos.front());
  const CameraFile file = ReadCameraFile(folder.file, options);
  CameraCalibration camera{.name = folder.name, .camera = file.camera};
  camera.file = file;
  NoteUnusedBoards(folder, &camera);
  JudgeFocalLengths({}, photos, &camera);
  JudgeDeviation(file.largest_deviation_px, &camera);
  const fs::path model = site.camera(folder.name);
  if (file.format != "mrcal") {
    WritePosedCamera(model, {"", file.camera, Rigid3()},
                     "from " + folder.file.filename().string() + ", " + file.format);
    return camera;
  }
  WriteWhole(model, ReadWhole(folder.file));
  if (!HoldsSolution(model)) return camera;
  camera.lens = AssessLens(model, model.parent_path() / "boards");
  for (const Finding& finding :
       JudgeLens(*camera.lens, {file.camera.width(), file.camera.height()})) {
    camera.findings.push_back(finding);
  }
  return camera;
}

// ---- scanned film --------------------------------------------------------------------------

void CheckInside(const fs::path& fiducials, const std::string& photo,
                 const std::vector<Fiducial>& marks, const Eigen::Vector2i& size) {
  for (const Fiducial& mark : marks) {
    const Eigen::Array2d p = mark.bitmap_px.array();
    if ((p >= -0.5).all() && (p <= size.cast<double>().array() - 0.5).all()) continue;
    std::ostringstream message;
    message << "mark " << mark.mark << " of photo " << photo << " lies at (" << p.x() << ", "
            << p.y() << "), outside its " << size.x() << "x" << size.y()
            << " px; are these another photo's fiducials?";
    throw InputError(fiducials, message.str());
  }
}

FilmMap MapOfScan(const fs::path& fiducials, const std::string& photo, const FilmCamera& film,
                  const std::vector<Fiducial>& marks, const Eigen::Vector2i& size) {
  const auto map = FitFilmMap(marks, film.transformation);
  if (!map) {
    throw InputError(fiducials, "photo " + photo + " has " + std::to_string(marks.size()) +
                                    " marks, expected at least three (projective: four) that are "
                                    "not on one line");
  }
  double largest = 0;
  for (const Eigen::Vector2d& residual : map->residuals_px) {
    largest = std::max(largest, residual.norm());
  }
  const double limit = 0.005 * size.cast<double>().norm();  // film shrinks by less than this
  if (largest > limit) {
    throw InputError(fiducials, "photo " + photo +
                                    Formatted(": its marks do not fit, off by %.1f px "
                                              "where film shrinks by less than %.1f px; "
                                              "marks exchanged, or another photo's?",
                                              largest, limit));
  }
  return *map;
}

void JudgeScan(const FilmScan& scan, const Eigen::Vector2i& size, CameraCalibration* camera) {
  JudgeDeviation(scan.fit.largest_deviation_px, camera);
  if (!scan.map.sigma_px) {
    camera->findings.push_back({Severity::kReview,
                                "No fiducial mark more than needed: its errors stay unseen.",
                                "Measure four marks or more (projective: five)."});
  } else if (*scan.map.sigma_px > 1) {
    camera->findings.push_back(
        {Severity::kReview,
         Formatted("The fiducial marks fit to %.2f px only.", *scan.map.sigma_px),
         "Measure them again; of old or buckled film try projective."});
  }
  if (scan.film.distortion.empty()) return;
  double farthest = 0;
  const Eigen::Matrix3d image_from_bitmap = scan.map.bitmap_from_image.inverse();
  for (const Eigen::Vector2d& corner :
       {Eigen::Vector2d(0, 0), Eigen::Vector2d(size.x(), 0), Eigen::Vector2d(0, size.y()),
        Eigen::Vector2d(size.x(), size.y())}) {
    const Eigen::Vector2d pixel = corner.array() - 0.5;
    const Eigen::Vector2d image = (image_from_bitmap * pixel.homogeneous()).hnormalized();
    farthest = std::max(farthest, (image - scan.film.principal_point_mm).norm());
  }
  if (farthest <= 1.02 * scan.film.distortion.back().x()) return;
  camera->findings.push_back(
      {Severity::kReview,
       Formatted("The distortion table ends at %.1f mm, the scan reaches to %.1f mm; beyond it is "
                 "continued straight.",
                 scan.film.distortion.back().x(), farthest),
       "Trust nothing near the scan's corners."});
}

CameraCalibration FromScan(const SitePaths& site, const FilmCamera& film, const fs::path& fiducials,
                           const fs::path& photo, const std::vector<Fiducial>& marks) {
  const std::string name = photo.stem().string();
  const Eigen::Vector2i size = ReadPhotographSize(photo);
  CheckInside(fiducials, name, marks, size);
  CheckCertified(film, fiducials, marks);
  const FilmMap map = MapOfScan(fiducials, name, film, marks, size);
  const auto fit = FitFilmCamera(film, map, size.x(), size.y());
  if (!fit) {
    throw InputError(fiducials, "photo " + name +
                                    " is mirrored against its marks (or y_mm counts "
                                    "down), or its lens cannot be shown; expected a scan seen from "
                                    "the front and y_mm counting up");
  }
  CameraCalibration camera{.name = name, .camera = fit->camera};
  camera.scan = FilmScan{film, marks, map, *fit};
  JudgeScan(*camera.scan, size, &camera);
  WritePosedCamera(site.camera(name), {name, fit->camera, Rigid3()}, "scanned film");
  return camera;
}

}  // namespace

CameraCalibration CalibrateCamera(const SitePaths& site, const CameraFolder& folder,
                                  const std::vector<fs::path>& photos,
                                  const BoardCalibrationOptions& options) {
  INSITU_CHECK(folder.source != CameraSource::kFilm);
  const bool has_boards = folder.source == CameraSource::kBoards;
  return has_boards ? FromBoards(site, folder, photos, options) : FromFile(site, folder, photos);
}

std::vector<CameraCalibration> CalibrateScans(const SitePaths& site, const CameraFolder& folder,
                                              const std::vector<fs::path>& photos) {
  INSITU_CHECK(folder.source == CameraSource::kFilm);
  const FilmCamera film = ReadFilmCamera(folder.file);
  const fs::path fiducials = folder.folder / "fiducials.csv";
  const auto marks_of_photo = ReadFiducials(fiducials);
  std::vector<CameraCalibration> cameras;
  for (const fs::path& photo : photos) {
    const auto marks = marks_of_photo.find(photo.stem().string());
    if (marks == marks_of_photo.end()) continue;
    cameras.push_back(FromScan(site, film, fiducials, photo, marks->second));
  }
  return cameras;
}

CameraCalibration CameraFromExif(const SitePaths& site, const std::vector<fs::path>& photos) {
  const std::string expected =
      "no calibration, expected camera.cameramodel, or board_* photos and board.txt";
  if (photos.empty()) throw InputError(site.boards(), expected);
  const ExifCamera exif = ReadExifCamera(photos.front());
  const auto focal = exif.FocalPx();
  if (!focal) throw InputError(site.boards(), expected + "; and EXIF tells no focal length");
  for (const fs::path& photo : photos) {
    const ExifCamera other = ReadExifCamera(photo);
    const auto other_focal = other.FocalPx();
    if (other.size == exif.size && other_focal && std::abs(*other_focal / *focal - 1) < 0.02) {
      continue;
    }
    throw InputError(site.boards(), expected + "; EXIF tells other cameras of " +
                                        photo.filename().string() + " and " +
                                        photos.front().filename().string());
  }
  CameraCalibration camera{
      .name = "",
      // Distortion of nothing, so that a self-calibrating adjustment has what to find.
      .camera =
          Camera("LENSMODEL_OPENCV4",
                 {*focal, *focal, (exif.size.x() - 1) / 2.0, (exif.size.y() - 1) / 2.0, 0, 0, 0, 0},
                 exif.size.x(), exif.size.y())};
  camera.exif_focal_px = *focal;
  camera.findings.push_back(
      {Severity::kFail,
       Formatted("NOT CALIBRATED: the focal length of %.0f px is EXIF's, without distortion and "
                 "principal point.",
                 *focal),
       "Photograph a chessboard with this camera and this focal length, or let the adjustment "
       "calibrate the camera (insitu-reconstruct --self-calibrate); until then nothing is better "
       "than some per cent."});
  WritePosedCamera(site.camera(), {"", camera.camera, Rigid3()}, "not calibrated: EXIF");
  return camera;
}

std::string CameraCalibration::BriefReport() const {
  std::string text = name.empty() ? "" : name + ": ";
  if (boards) {
    text += boards->BriefReport();
  } else {
    text += camera.lens_model() + ", " + SizeText(camera.width(), camera.height());
    if (file) text += ", brought with the site (" + file->format + ")";
    if (scan) text += ", scanned film";
    if (exif_focal_px) text += ", EXIF";
    if (file || scan) {
      text += Formatted(", deviation at most %.4f px",
                        file ? file->largest_deviation_px : scan->fit.largest_deviation_px);
    }
    if (scan && scan->map.sigma_px) text += Formatted(", fiducials %.3f px", *scan->map.sigma_px);
    if (lens)
      text += Formatted(", RMS %.3f px (weighted %.3f px)", lens->rms_px, lens->weighted_rms_px);
  }
  for (const Finding& finding : findings) {
    text += "\n  " + finding.reason + " " + finding.remedy;
  }
  return text;
}

}  // namespace insitu
