// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/camera_files/film.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

// A metric camera of 60 x 60 mm with marks in the corners and edges.
std::vector<Fiducial> Marks() {
  std::vector<Fiducial> marks;
  for (const Eigen::Vector2d& p :
       {Eigen::Vector2d(-28, -28), Eigen::Vector2d(28, -28), Eigen::Vector2d(28, 28),
        Eigen::Vector2d(-28, 28), Eigen::Vector2d(0, 27), Eigen::Vector2d(-27, 1)}) {
    marks.push_back({std::to_string(marks.size() + 1), p, {}});
  }
  return marks;
}

// Bitmap of 40 px/mm, turned by `angle`, y down.
Eigen::Matrix3d Scan(double angle, double shear = 0) {
  Eigen::Matrix3d map;
  map << 40 * std::cos(angle), 40 * std::sin(angle) + shear, 1250,  //
      40 * std::sin(angle), -40 * std::cos(angle), 1240,            //
      0, 0, 1;
  return map;
}

std::vector<Fiducial> Scanned(const Eigen::Matrix3d& map) {
  std::vector<Fiducial> marks = Marks();
  for (Fiducial& mark : marks) {
    mark.bitmap_px = (map * mark.image_mm.homogeneous()).hnormalized();
  }
  return marks;
}

FilmCamera Film() {
  FilmCamera film;
  film.focal_mm = 60.2;
  film.principal_point_mm = {0.05, -0.03};
  for (double r = 5; r <= 45; r += 5) film.distortion.emplace_back(r, 2e-6 * r * r * r);
  return film;
}

TEST(FilmMap, AffineGivesTheMapBack) {
  const Eigen::Matrix3d truth = Scan(0.01, 0.02);
  const auto map = FitFilmMap(Scanned(truth), FilmTransformation::kAffine);
  ASSERT_TRUE(map);
  EXPECT_LT((map->bitmap_from_image - truth).norm(), 1e-9);
  EXPECT_LT(*map->sigma_px, 1e-9);
}

TEST(FilmMap, ProjectiveGivesTheMapBack) {
  Eigen::Matrix3d truth = Scan(-0.02);
  truth.row(2) << 2e-5, -1e-5, 1;
  const auto map = FitFilmMap(Scanned(truth), FilmTransformation::kProjective);
  ASSERT_TRUE(map);
  EXPECT_LT((map->bitmap_from_image - truth).norm(), 1e-6);
}

// Residuals of least squares are orthogonal to the design; sigma divides by 12 - 6.
TEST(FilmMap, ResidualsAndSigma) {
  std::vector<Fiducial> marks = Scanned(Scan(0));
  marks[1].bitmap_px.x() += 0.6;
  const auto map = FitFilmMap(marks, FilmTransformation::kAffine);
  ASSERT_TRUE(map);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero(), moment = Eigen::Vector2d::Zero();
  double squares = 0;
  for (size_t i = 0; i < marks.size(); ++i) {
    sum += map->residuals_px[i];
    moment += map->residuals_px[i] * marks[i].image_mm.x();
    squares += map->residuals_px[i].squaredNorm();
  }
  EXPECT_LT(sum.norm(), 1e-9);
  EXPECT_LT(moment.norm(), 1e-7);
  EXPECT_NEAR(*map->sigma_px, std::sqrt(squares / 6), 1e-12);
}

// Of the corners of a square an affine map leaves one combination of errors, (1, -1, 1, -1) / 2; of
// a dubious mark's error it therefore leaves 9 / 12 there and 1 / 12 with each of the others.
TEST(FilmMap, ADubiousMarkCountsANinth) {
  std::vector<Fiducial> marks = Scanned(Scan(0));
  marks.resize(4);
  marks[1].bitmap_px.x() += 0.6;
  marks[1].sigma_times = kDubiousFiducial;
  const auto map = FitFilmMap(marks, FilmTransformation::kAffine);
  ASSERT_TRUE(map);
  EXPECT_NEAR(map->residuals_px[1].x(), -0.45, 1e-9);
  for (const int i : {0, 2, 3}) EXPECT_NEAR(std::abs(map->residuals_px[i].x()), 0.05, 1e-9);
  EXPECT_NEAR(map->redundancies[1].x(), 0.75, 1e-9);
  EXPECT_NEAR(*map->sigma_px, 0.6 / std::sqrt(24), 1e-9);
}

TEST(FilmMap, NeedsMarks) {
  std::vector<Fiducial> marks = Scanned(Scan(0));
  marks.resize(3);
  const auto map = FitFilmMap(marks, FilmTransformation::kAffine);
  ASSERT_TRUE(map);
  EXPECT_FALSE(map->sigma_px);  // no mark more than needed
  EXPECT_FALSE(FitFilmMap(marks, FilmTransformation::kProjective));
  marks.pop_back();
  EXPECT_FALSE(FitFilmMap(marks, FilmTransformation::kAffine));
  for (int i = 0; i < 3; ++i) marks.push_back({"", {5.0 * i, 10.0 * i}, {20.0 * i, 40.0 * i}});
  marks.erase(marks.begin(), marks.begin() + 2);
  EXPECT_FALSE(FitFilmMap(marks, FilmTransformation::kAffine));  // on one line
}

TEST(Film, DistortionFollowsItsTable) {
  const FilmCamera film = Film();
  EXPECT_EQ(DistortionAt(film, 0), 0);
  EXPECT_NEAR(DistortionAt(film, 20), 2e-6 * 8000, 1e-15);
  EXPECT_NEAR(DistortionAt(film, 22.5), 2e-6 * std::pow(22.5, 3), 5e-4);  // between, monotone
  EXPECT_GT(DistortionAt(film, 50), DistortionAt(film, 45));
}

// An object at tan a: the film shows it at radius c tan a + distortion. [Durisch92, §3.5]
TEST(Film, SightUndoesTheDistortion) {
  FilmCamera film = Film();
  film.principal_point_mm.setZero();
  const Eigen::Vector3d sight = SightOfFilm(film, {20, 0});
  EXPECT_NEAR(film.focal_mm * sight.x() / sight.z(), 20 - 2e-6 * 8000, 1e-12);
  EXPECT_LT(SightOfFilm(film, {0, 20}).y(), 0);  // up in the image is -y of the camera
}

class FilmScans : public testing::TestWithParam<double> {};

// Scans laid in at any angle are the same camera, turned about its axis.
TEST_P(FilmScans, BecomeOrdinaryCameras) {
  FilmMap map;
  map.bitmap_from_image = Scan(GetParam());
  const FilmCamera film = Film();
  const auto fit = FitFilmCamera(film, map, 2500, 2480);
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->camera.lens_model(), "LENSMODEL_OPENCV8");
  EXPECT_LT(fit->largest_deviation_px, 0.05);
  const Eigen::Vector2d image(-17, 11);
  const auto pixel = fit->camera.Project(fit->fit_from_lens * SightOfFilm(film, image));
  EXPECT_LT((*pixel - (map.bitmap_from_image * image.homogeneous()).hnormalized()).norm(), 0.05);
}
INSTANTIATE_TEST_SUITE_P(Angles, FilmScans, testing::Values(0.0, 0.01, M_PI / 2, M_PI, -M_PI / 2));

// A scanner whose axes are not square: no lens of OpenCV's shears, a splined one does.
TEST(Film, ShearedScanIsSplined) {
  FilmMap map;
  map.bitmap_from_image = Scan(0, 0.04);
  const auto fit = FitFilmCamera(Film(), map, 2500, 2480);
  ASSERT_TRUE(fit);
  EXPECT_LT(fit->largest_deviation_px, 0.05);
  EXPECT_TRUE(fit->camera.lens_model().starts_with("LENSMODEL_SPLINED"));
}

TEST(Film, MirroredScanIsRefused) {
  FilmMap map;
  map.bitmap_from_image = Scan(0);
  map.bitmap_from_image(0, 0) *= -1;
  EXPECT_FALSE(FitFilmCamera(Film(), map, 2500, 2480));
}

class FilmFiles : public testing::Test {
 protected:
  ScratchFolder folder_;
};

TEST_F(FilmFiles, Fiducials) {
  const std::string head = "mark,x_mm,y_mm,photo,x,y\n";
  const auto marks = ReadFiducials(folder_.Write("fiducials.csv", head + "1,-28,28,west,10,12.5\n"
                                                                         "2,28,28,west,2300,11\n"
                                                                         "1,-28,28,east,9,13\n"));
  ASSERT_EQ(marks.at("west").size(), 2u);
  EXPECT_EQ(marks.at("west")[0].bitmap_px, Eigen::Vector2d(10, 12.5));
  const auto error = [&](const std::string& rows) {
    const auto path = folder_.Write("fiducials.csv", head + rows);
    return InputErrorOf([&] { ReadFiducials(path); }).substr(path.string().size());
  };
  EXPECT_EQ(error("1,-28,28,west,10,12\n1,-28,28,west,11,12\n"),
            ":3: mark 1 stands twice for photo west");
  EXPECT_EQ(error("1,-28,28,west,10,12\n1,28,28,east,11,12\n"),
            ":3: mark 1 has other millimetres than further up, expected those of one camera");
}

TEST_F(FilmFiles, AMarkMayBeDubious) {
  const std::string text =
      "mark,x_mm,y_mm,photo,x,y,state\n1,-28,28,west,10,12.5,dubious\n"
      "2,28,28,west,2300,11,\n";
  const auto marks = ReadFiducials(folder_.Write("fiducials.csv", text)).at("west");
  EXPECT_EQ(marks[0].sigma_times, 3);
  EXPECT_EQ(marks[1].sigma_times, 1);
  const auto path = folder_.Write("fiducials.csv", text + "3,1,2,west,3,4,doubtful\n");
  EXPECT_THAT(InputErrorOf([&] { ReadFiducials(path); }),
              testing::HasSubstr(":4: state is \"doubtful\", expected dubious or nothing"));
}

TEST_F(FilmFiles, ACertificateThatListsItsMarksIsHeldAgainstThoseMeasured) {
  const FilmCamera film = ReadFilmCamera(folder_.Write(
      "film.json",
      R"({"focal_mm": 99.4, "fiducials": [{"mark": "1", "x_mm": -28, "y_mm": 28.01}]})"));
  EXPECT_EQ(film.fiducials.at("1"), Eigen::Vector2d(-28, 28.01));
  const std::filesystem::path fiducials = "f.csv";
  EXPECT_NO_THROW(CheckCertified(film, fiducials, {{"1", {-28, 28.01}, {}}}));
  EXPECT_NO_THROW(CheckCertified(FilmCamera(), fiducials, {{"1", {-28, 28}, {}}}));
  const std::string path = film.path.string();
  EXPECT_EQ(InputErrorOf([&] {
              CheckCertified(film, fiducials, {{"1", {-28, 28}, {}}});
            }),
            "f.csv: mark 1 has other millimetres in " + path);
  EXPECT_EQ(InputErrorOf([&] {
              CheckCertified(film, fiducials, {{"2", {-28, 28}, {}}});
            }),
            "f.csv: mark 2 is not among those of " + path);
  EXPECT_THAT(InputErrorOf([&] {
                ReadFilmCamera(folder_.Write("film.json", R"({"focal_mm": 9, "fiducials": [
    {"mark": "1", "x_mm": 1, "y_mm": 2},
    {"mark": "1", "x_mm": 1, "y_mm": 2}]})"));
              }),
              testing::EndsWith("film.json:3: \"fiducials[1]\" mark 1 stands twice"));
}

TEST_F(FilmFiles, Folders) {
  const auto calibration = folder_.path() / "calibration";
  EXPECT_EQ(FilmFolder(calibration), calibration);
  folder_.Write("calibration/wide/board.txt", "");
  EXPECT_EQ(FilmFolder(calibration), calibration / "film");
  folder_.Write("calibration/old/fiducials.csv", "");
  EXPECT_EQ(FilmFolder(calibration), calibration / "old");
  folder_.Write("calibration/film.json", "");
  EXPECT_EQ(FilmFolders(calibration),
            (std::vector<std::filesystem::path>{calibration, calibration / "old"}));
}

TEST_F(FilmFiles, Film) {
  const FilmCamera film = ReadFilmCamera(
      folder_.Write("film.json", R"({"focal_mm": 99.4, "principal_point_mm": [0.01, -0.02],
                       "distortion": [[10, 0.001], [20, 0.003]], "transformation": "projective"})"));
  EXPECT_EQ(film.distortion[1], Eigen::Vector2d(20, 0.003));
  EXPECT_EQ(film.transformation, FilmTransformation::kProjective);
  const auto error = [&](const std::string& text) {
    const auto path = folder_.Write("film.json", text);
    return InputErrorOf([&] { ReadFilmCamera(path); }).substr(path.string().size());
  };
  EXPECT_EQ(error(R"({"focal_mm": -1})"), ":1: \"focal_mm\" is not positive");
  EXPECT_EQ(error(R"({"focal_mm": 9, "distortion": [[10, 0], [5, 0]]})"),
            ":1: \"distortion[1]\" expected [radius_mm, distortion_mm] with radii rising from > 0");
  EXPECT_EQ(error(R"({"focal_mm": 9, "transformation": "helmert"})"),
            ":1: \"transformation\" is \"helmert\", expected affine or projective");
}

}  // namespace
}  // namespace insitu
