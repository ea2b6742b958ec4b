// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/exchange/export_survey.h"

#include "calibration/lens/lens_residual.h"
#include "reconstruction/exchange/fit_brown.h"
#include "reconstruction/exchange/import_dbat.h"
#include "reconstruction/exchange/read_survey_file.h"
#include "reconstruction/network/solve_network.h"
#include "tests/reconstruction/exchange/text_files.h"
#include "tests/reconstruction/survey/synthetic_network.h"

namespace insitu {
namespace {

class SurveyExported : public TextFiles {
 protected:
  SurveyExported() {
    for (const std::string& photo : town_.photos) photographs_.push_back(photo + ".jpg");
  }
  SyntheticNetwork town_ = MakeSyntheticNetwork();
  std::vector<std::filesystem::path> photographs_;
};

// Whoever reads our files with another program finds the same orientations: here with our own
// reader of DBAT's scripts and its lens model.
TEST_F(SurveyExported, DbatFindsTheSameOrientations) {
  const SurveyExport done = ExportDbat(town_.survey, town_.cameras, photographs_, folder_);
  EXPECT_EQ(done.written.size(), 6u);
  ImportedProject project = ReadDbatProject(folder_ / "script.xml");
  ASSERT_EQ(project.network.photos.size(), town_.photos.size());
  EXPECT_EQ(project.check_points.size(), 2u);
  SolveNetwork(&project.network);
  for (size_t i = 0; i < town_.photos.size(); ++i) {
    EXPECT_EQ(project.network.photos[i].name, town_.photos[i]);
    const Eigen::Vector3d center = project.network.origin + project.network.photos[i].center;
    EXPECT_LT((center - Center(town_.cam_from_world[i])).norm(), 2e-3);
  }
}

TEST_F(SurveyExported, OdmListIsReadBack) {
  const SurveyExport done = ExportOdm(town_.survey, photographs_, "EPSG:2056", folder_);
  const SurveyFile file = ReadSurveyFile(
      done.written[0], [](const std::string&) { return std::optional<Eigen::Vector2i>(); });
  EXPECT_EQ(file.crs, "EPSG:2056");
  std::map<std::pair<std::string, std::string>, Eigen::Vector2d> pixels;
  for (const auto& mark : town_.survey.observations) pixels[{mark.photo, mark.point}] = mark.pixel;
  EXPECT_GT(file.marks.size(), 20u);
  for (const SurveyedMark& mark : file.marks) {
    EXPECT_EQ(pixels.at({mark.photo, mark.point}), mark.pixel);
  }
  for (const SurveyedPoint& point : file.points) {
    EXPECT_EQ(town_.points.at(point.name), point.position);
  }
  EXPECT_THROW(ExportOdm(town_.survey, photographs_, "nowhere", folder_), InputError);
}

// A Brown camera is found again from the sights that its corrections make.
TEST(BrownFits, ComeNearEveryOrdinaryLens) {
  const Camera distorted("LENSMODEL_OPENCV5", {3000, 3010, 2010, 1490, -0.1, 0.03, 1e-4, -2e-4, 0},
                         4000, 3000);
  const auto fit = FitBrown(distorted);
  ASSERT_TRUE(fit);
  EXPECT_LT(fit->largest_px, 0.15);
  EXPECT_GE(fit->largest_px, fit->rms_px);
  const Camera pinhole = Camera::Pinhole(3000, 3000, 1999.5, 1499.5, 4000, 3000);
  const auto exact = FitBrown(pinhole, 24);
  ASSERT_TRUE(exact);
  EXPECT_LT(exact->largest_px, 1e-8);
  EXPECT_NEAR(exact->lens.parameters[0], 24, 1e-9);
  EXPECT_NEAR(exact->lens.parameters[1], 16, 1e-9);
  EXPECT_NEAR(exact->lens.parameters[2], -12, 1e-9);
}

}  // namespace
}  // namespace insitu
