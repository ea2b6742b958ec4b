// SPDX-License-Identifier: GPL-3.0-or-later
// From tie points in a frame of their own to start values and an adjustment in the world.
#include "reconstruction/survey/tie_points.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "reconstruction/adjustment/adjust.h"
#include "reconstruction/adjustment/align_tie_points.h"
#include "reconstruction/adjustment/start_values.h"
#include "reconstruction/colmap/select_tie_points.h"
#include "tests/reconstruction/survey/synthetic_network.h"

namespace insitu {
namespace {

const Similarity3 kModelFromWorld = Inverse(
    Similarity3{12,
                Eigen::Quaterniond(Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, -1).normalized())),
                {1000, 2000, 400}});

std::map<std::string, Camera> CamerasOf(const SyntheticNetwork& network) {
  std::map<std::string, Camera> cameras;
  for (size_t i = 0; i < network.photos.size(); ++i) {
    cameras.emplace(network.photos[i], network.cameras[i]);
  }
  return cameras;
}

// The town's photographs in a model's frame, with `count` points between its houses, without error.
TiePoints ModelOf(const SyntheticNetwork& network, int count) {
  TiePoints tie_points;
  for (size_t i = 0; i < network.photos.size(); ++i) {
    tie_points.cam_from_model[network.photos[i]] =
        CamFromTarget(network.cam_from_world[i], kModelFromWorld);
  }
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> along(-8, 8), up(0, 8);
  const Eigen::Vector3d middle(1000, 2000, 400);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d world =
        middle + Eigen::Vector3d(along(generator), along(generator), up(generator));
    TiePoint point{kModelFromWorld * world, {}};
    for (size_t photo = 0; photo < network.photos.size(); ++photo) {
      const auto pixel = network.cameras[photo].Project(network.cam_from_world[photo] * world);
      if (pixel && network.cameras[photo].Sees(*pixel)) {
        point.marks.push_back({network.photos[photo], *pixel});
      }
    }
    if (point.marks.size() >= 2) tie_points.points.push_back(point);
  }
  tie_points.sigma_px = 0.5;
  return tie_points;
}

double LargestCenterError(const SyntheticNetwork& network,
                          const std::map<std::string, Rigid3>& poses) {
  double largest = 0;
  for (size_t i = 0; i < network.photos.size(); ++i) {
    const Eigen::Vector3d truth = Center(network.cam_from_world[i]);
    largest = std::max(largest, (Center(poses.at(network.photos[i])) - truth).norm());
  }
  return largest;
}

StartValues Start(const SyntheticNetwork& network, const Survey& survey) {
  return FindStartValues(survey, network.photos, network.cameras);
}

class TiePointsFile : public testing::Test {
 protected:
  TiePointsFile() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    site_.root = std::filesystem::path(testing::TempDir()) / "tie_points" / test->name();
    std::filesystem::remove_all(site_.root);
  }
  SitePaths site_;
};

TEST_F(TiePointsFile, ReturnsEveryDigit) {
  EXPECT_FALSE(ReadTiePoints(site_));
  TiePoints written = ModelOf(MakeSyntheticNetwork(), 20);
  written.not_placed = {"P9"};
  written.remarks = {"one \"remark\""};
  WriteTiePoints(site_, written);
  const auto read = ReadTiePoints(site_);
  ASSERT_TRUE(read);
  ASSERT_EQ(read->points.size(), written.points.size());
  for (size_t i = 0; i < read->points.size(); ++i) {
    EXPECT_EQ(read->points[i].position, written.points[i].position);
    ASSERT_EQ(read->points[i].marks.size(), written.points[i].marks.size());
    for (size_t k = 0; k < read->points[i].marks.size(); ++k) {
      EXPECT_EQ(read->points[i].marks[k].photo, written.points[i].marks[k].photo);
      EXPECT_EQ(read->points[i].marks[k].pixel, written.points[i].marks[k].pixel);
    }
  }
  for (const auto& [photo, pose] : written.cam_from_model) {
    EXPECT_EQ(read->cam_from_model.at(photo).translation, pose.translation);
  }
  EXPECT_EQ(read->sigma_px, 0.5);
  EXPECT_EQ(read->not_placed, written.not_placed);
  EXPECT_EQ(read->remarks, written.remarks);
}

TEST_F(TiePointsFile, RefusesAFileCutShortOrWithoutSense) {
  WriteTiePoints(site_, ModelOf(MakeSyntheticNetwork(), 20));
  const std::string content = ReadWhole(site_.tie_points());
  for (const size_t size : {content.size() / 3, content.size() / 2, content.size() - 3}) {
    WriteWhole(site_.tie_points(), content.substr(0, size));
    EXPECT_THROW(ReadTiePoints(site_), InputError) << size;
  }
  std::string other = content;
  const size_t format = other.find("insitu tie points");
  WriteWhole(site_.tie_points(), other.replace(format, 6, "outsit"));
  EXPECT_THROW(ReadTiePoints(site_), InputError);
}

TEST_F(TiePointsFile, RefusesPlacesThatNoPhotoHas) {
  for (const char* photo : {"-1", "2", "0.7", "1e300", "0"}) {
    WriteWhole(site_.tie_points(),
               R"({"format": "insitu tie points", "version": 1, "sigma_px": 1, "photos": [
  {"name": "a", "rotation_wxyz": [1, 0, 0, 0], "translation": [0, 0, 0]},
  {"name": "b", "rotation_wxyz": [1, 0, 0, 0], "translation": [1, 0, 0]}],
 "not_placed": [], "remarks": [], "points": [
  [1, 2, 3, 0, 10, 20, )" +
                   std::string(photo) + ", 30, 40]]}\n");
    try {
      ReadTiePoints(site_);
      ADD_FAILURE() << photo;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(":5: "), std::string::npos) << error.what();
    }
  }
}

TEST(TiePointName, IsRecognised) {
  EXPECT_EQ(TiePointName(0), "tie_000001");
  for (const size_t index : {0, 999998, 999999, 12345678}) {
    EXPECT_TRUE(IsTiePointName(TiePointName(index))) << index;
  }
  for (const char* name : {"tie_", "tie_12345", "tie_12345a", "tie_point", "Tie_000001", "a1"}) {
    EXPECT_FALSE(IsTiePointName(name)) << name;
  }
}

TEST(AlignTiePoints, PutsTheModelWhereControlHasIt) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  TiePoints tie_points = ModelOf(network, 30);
  const auto alignment = AlignTiePoints(network.survey, CamerasOf(network), &tie_points);
  ASSERT_TRUE(alignment.fit);
  EXPECT_TRUE(alignment.warnings.empty());
  EXPECT_NEAR(alignment.world_from_model.scale, 12, 1e-6);
  EXPECT_LT(LargestCenterError(network, tie_points.cam_from_model), 1e-5);
}

TEST(AlignTiePoints, NamesAControlPointOfTheWrongName) {
  SyntheticNetwork network = MakeSyntheticNetwork();
  for (ControlPoint& point : network.survey.control_points) {
    if (point.name == "g4") point.position += Eigen::Vector3d(3, 0, 0);
  }
  TiePoints tie_points = ModelOf(network, 30);
  const auto alignment = AlignTiePoints(network.survey, CamerasOf(network), &tie_points);
  ASSERT_EQ(alignment.warnings.size(), 1u);
  EXPECT_NE(alignment.warnings[0].find("control point 'g4' is 3 m from"), std::string::npos)
      << alignment.warnings[0];
  EXPECT_LT(LargestCenterError(network, tie_points.cam_from_model), 1e-5);
}

TEST(AlignTiePoints, RefusesAMirrorImage) {
  SyntheticNetwork network = MakeSyntheticNetwork();
  for (ControlPoint& point : network.survey.control_points) {
    std::swap(point.position.x(), point.position.y());
  }
  TiePoints tie_points = ModelOf(network, 30);
  EXPECT_THROW(AlignTiePoints(network.survey, CamerasOf(network), &tie_points), InputError);
}

TEST(AlignTiePoints, UsesCameraPositionsWhereThereIsNoControl) {
  SyntheticNetwork network = MakeSyntheticNetwork();
  Survey survey;
  for (size_t i = 0; i < network.photos.size(); ++i) {
    survey.camera_positions.push_back({network.photos[i],
                                       Center(network.cam_from_world[i]),
                                       Eigen::Vector3d::Constant(0.01),
                                       PositionRole::kWeighted,
                                       {}});
  }
  TiePoints tie_points = ModelOf(network, 30);
  EXPECT_TRUE(AlignTiePoints(survey, CamerasOf(network), &tie_points).fit);
  EXPECT_LT(LargestCenterError(network, tie_points.cam_from_model), 1e-5);

  survey.camera_positions.resize(2);
  tie_points = ModelOf(network, 30);
  const auto alignment = AlignTiePoints(survey, CamerasOf(network), &tie_points);
  EXPECT_FALSE(alignment.fit);
  EXPECT_NEAR(alignment.world_from_model.scale, 12, 1e-6);
  for (int i = 0; i < 2; ++i) {
    const auto& pose = tie_points.cam_from_model.at(network.photos[i]);
    EXPECT_LT((Center(pose) - survey.camera_positions[i].position).norm(), 1e-6);
  }
  EXPECT_NE(alignment.warnings.at(0).find("the rotation about the line"), std::string::npos);
}

TEST(FindStartValues, TakesPosesAndTiePointsFromTheAlignedModel) {
  SyntheticNetwork network = MakeSyntheticNetwork();
  network.survey.tie_points = ModelOf(network, 30);
  const StartValues start = Start(network, network.survey);
  ASSERT_EQ(start.tie_points.size(), network.survey.tie_points->points.size());
  EXPECT_EQ(start.tie_points[0].name, "tie_000001");
  EXPECT_EQ(start.tie_point_sigma_px, 0.5);
  for (const StartTiePoint& point : start.tie_points) {
    for (const StartTiePoint::Mark& mark : point.marks) {
      const PosedCamera& posed = start.cameras[mark.photo];
      const auto pixel = posed.camera.Project(posed.cam_from_world * point.position);
      ASSERT_TRUE(pixel);
      EXPECT_LT((*pixel - mark.pixel).norm(), 1e-3);
    }
  }
}

// P4, which image matching left out, shows no control: it is resected from what the others tell.
TEST(FindStartValues, ResectsAPhotoThatMatchingLeftOut) {
  SyntheticNetwork network = MakeSyntheticNetwork();
  network.survey.tie_points = ModelOf(network, 30);
  TiePoints& tie_points = *network.survey.tie_points;
  tie_points.cam_from_model.erase("P4");
  for (TiePoint& point : tie_points.points) {
    std::erase_if(point.marks, [](const TiePointMark& mark) { return mark.photo == "P4"; });
  }
  std::erase_if(network.survey.observations, [](const ImageObservation& mark) {
    return mark.photo == "P4" && (mark.point[0] == 'g' || mark.point[0] == 'a');
  });
  const StartValues start = Start(network, network.survey);
  EXPECT_LT((Center(start.cameras[3].cam_from_world) - Center(network.cam_from_world[3])).norm(),
            1e-4);

  std::erase_if(network.survey.observations,
                [](const ImageObservation& mark) { return mark.photo == "P4"; });
  EXPECT_THROW(Start(network, network.survey), InputError);
}

TEST(FindStartValues, IntersectsTiePointsWhereTheirModelCannotBeAligned) {
  SyntheticNetwork network = MakeSyntheticNetwork();
  TiePoints model = ModelOf(network, 30);
  for (const char* photo : {"P2", "P3", "P4"}) model.cam_from_model.erase(photo);  // no two rays
  model.cam_from_model["P2"] = model.cam_from_model["P1"];
  for (TiePoint& point : model.points) {
    std::erase_if(point.marks, [](const TiePointMark& m) { return m.photo > "P2"; });
  }
  std::erase_if(model.points, [](const TiePoint& point) { return point.marks.size() < 2; });
  network.survey.tie_points = model;
  const StartValues start = Start(network, network.survey);
  ASSERT_GT(start.tie_points.size(), 10u);
  EXPECT_LT((Center(start.cameras[0].cam_from_world) - Center(network.cam_from_world[0])).norm(),
            1e-4);
}

TEST(FindStartValues, WithoutControlIsTheModelAsItIs) {
  SyntheticNetwork network = MakeSyntheticNetwork();
  Survey survey;
  survey.tie_points = ModelOf(network, 30);
  const StartValues start = Start(network, survey);
  for (const PosedCamera& posed : start.cameras) {
    EXPECT_LT((posed.cam_from_world.translation -
               survey.tie_points->cam_from_model.at(posed.photo).translation)
                  .norm(),
              1e-9);
  }
  ASSERT_EQ(start.warnings.size(), 1u);
  EXPECT_NE(start.warnings[0].find("no control: position, orientation and scale are arbitrary"),
            std::string::npos);
}

TEST(SelectTiePoints, DropsWhatIsOffAndWhatIsWeakAndCountsIt) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  TiePoints tie_points = ModelOf(network, 400);
  std::mt19937 generator(3);
  std::normal_distribution<double> normal(0, 0.5);
  for (TiePoint& point : tie_points.points) {
    for (TiePointMark& mark : point.marks) {
      mark.pixel += Eigen::Vector2d(normal(generator), normal(generator));
    }
  }
  tie_points.points[0].marks[0].pixel.x() += 40;
  tie_points.points[1].position = kModelFromWorld * Eigen::Vector3d(1000, 9000, 400);
  for (TiePointMark& mark : tie_points.points[1].marks) {  // far away: rays are all but parallel
    const size_t photo = static_cast<size_t>(mark.photo[1] - '1');
    mark.pixel = *network.cameras[photo].Project(network.cam_from_world[photo] *
                                                 Eigen::Vector3d(1000, 9000, 400));
  }
  const size_t found = tie_points.points.size();
  const TiePointCounts counts = SelectTiePoints(CamerasOf(network), {}, &tie_points);
  EXPECT_EQ(counts.found, static_cast<int>(found));
  EXPECT_GE(counts.marks_off, 1);
  EXPECT_LE(counts.marks_off, 10);  // four sigma of 1500 marks
  EXPECT_EQ(counts.weak_angle, 1);
  EXPECT_EQ(counts.kept + counts.crowded + counts.weak_angle + counts.too_few_rays, counts.found);
}

// Residuals of noise alone about the true points: their redundancy is higher than SelectTiePoints
// reckons with (it takes points and poses for adjusted), by 2n / (2n - 3p - 6m + 7).
TEST(SelectTiePoints, MeasuresSigma) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  TiePoints tie_points = ModelOf(network, 2000);
  std::mt19937 generator(3);
  std::normal_distribution<double> normal(0, 0.5);
  size_t marks = 0;
  for (TiePoint& point : tie_points.points) {
    for (TiePointMark& mark : point.marks) {
      mark.pixel += Eigen::Vector2d(normal(generator), normal(generator));
    }
    marks += point.marks.size();
  }
  const double n = static_cast<double>(marks), p = static_cast<double>(tie_points.points.size());
  SelectTiePoints(CamerasOf(network), {.points_per_photo = 0, .limit_sigma = 6}, &tie_points);
  const double expected = 0.5 * std::sqrt(2 * n / (2 * n - 3 * p - 6 * 4 + 7));
  EXPECT_NEAR(tie_points.sigma_px, expected, 0.05 * expected);
}

TEST(SelectTiePoints, KeepsThePointsOfMostRaysWellSpread) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  TiePoints tie_points = ModelOf(network, 3000);
  const TiePoints all = tie_points;
  const TiePointSelection selection{.points_per_photo = 100, .columns = 10, .rows = 10};
  SelectTiePoints(CamerasOf(network), selection, &tie_points);
  std::map<std::string, int> count;
  for (const TiePoint& point : tie_points.points) {
    for (const TiePointMark& mark : point.marks) count[mark.photo] += 1;
  }
  for (const auto& [photo, points] : count) {
    EXPECT_LE(points, 100) << photo;
    EXPECT_GE(points, 20) << photo;
  }
  const auto rays = [](const TiePoints& points) {
    double sum = 0;
    for (const TiePoint& point : points.points) sum += static_cast<double>(point.marks.size());
    return sum / static_cast<double>(points.points.size());
  };
  EXPECT_GE(rays(tie_points), rays(all) - 0.2);
}

// More observations of the same photographs: smaller sigmas, the truth still within them.
TEST(Adjust, GainsFromTiePoints) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  Survey survey = WithNoise(network.survey, 4);
  const Adjustment without = Adjust(survey, network.photos, network.cameras);
  survey.tie_points = ModelOf(network, 200);
  std::mt19937 generator(3);
  std::normal_distribution<double> normal(0, 0.5);
  for (TiePoint& point : survey.tie_points->points) {
    for (TiePointMark& mark : point.marks) {
      mark.pixel += Eigen::Vector2d(normal(generator), normal(generator));
    }
  }
  const Adjustment with = Adjust(survey, network.photos, network.cameras);
  for (size_t i = 0; i < 4; ++i) {
    const Eigen::Matrix3d covariance = with.poses[i].covariance.bottomRightCorner(3, 3);
    const Eigen::Matrix3d before = without.poses[i].covariance.bottomRightCorner(3, 3);
    EXPECT_LT(covariance.trace() / std::pow(with.sigma0, 2),
              before.trace() / std::pow(without.sigma0, 2));
    const Eigen::Vector3d error =
        Center(with.poses[i].cam_from_world) - Center(network.cam_from_world[i]);
    EXPECT_LT(error.dot(covariance.inverse() * error), 16.3);  // chi-square, 3, 0.1 %
  }
}

}  // namespace
}  // namespace insitu
