// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/placement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "calibration/files/error.h"
#include "renderer/building/site_check.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

Similarity SomeSimilarity(double scale) {
  Similarity t;
  t.scale = scale;
  t.rotation = Eigen::AngleAxisd(0.7, Vector3d(0.1, -0.2, 1).normalized()).toRotationMatrix();
  t.shift = {2600100, 1200200, 430};
  return t;
}

std::vector<PointPair> Pairs(const Similarity& t, double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 1);
  std::vector<PointPair> pairs;
  for (const Vector3d& p : {Vector3d(0, 0, 0), Vector3d(20, 0, 0), Vector3d(20, 12, 0),
                            Vector3d(0, 12, 3), Vector3d(10, 6, 9)}) {
    PointPair pair{"p", p, t * p, 0.01 * (1 + static_cast<double>(pairs.size()))};
    for (double& x : pair.in_survey) x += noise * pair.sigma * normal(random);
    pairs.push_back(pair);
  }
  return pairs;
}

TEST(AdjustSimilarity, ExactPairsGiveTheTransformationBack) {
  for (const bool free : {false, true}) {
    const Similarity truth = SomeSimilarity(free ? 0.9 : 1);
    const auto result = AdjustSimilarity(Pairs(truth, 0, 1), free);
    ASSERT_TRUE(result);
    EXPECT_NEAR(result->world_from_model.scale, truth.scale, 1e-9);
    EXPECT_NEAR((result->world_from_model.rotation - truth.rotation).norm(), 0, 1e-9);
    EXPECT_NEAR((result->world_from_model.shift - truth.shift).norm(), 0, 1e-7);
    EXPECT_EQ(result->redundancy, free ? 8 : 9);
  }
}

// Over many samples the mean of sigma0^2 is 1, and errors are as large as their sigmas say.
TEST(AdjustSimilarity, SigmasTellTheTruth) {
  const Similarity truth = SomeSimilarity(1);
  constexpr int kSamples = 400;
  double sigma0_square = 0;
  Vector3d turn_square = Vector3d::Zero(), sigma = Vector3d::Zero();
  for (unsigned seed = 1; seed <= kSamples; ++seed) {
    const auto result = AdjustSimilarity(Pairs(truth, 1, seed), false);
    sigma0_square += result->sigma0 * result->sigma0 / kSamples;
    const Eigen::AngleAxisd turn(
        Eigen::Matrix3d(result->world_from_model.rotation * truth.rotation.transpose()));
    turn_square += (turn.angle() * turn.axis()).cwiseAbs2() / kSamples;
    sigma = result->sigma_rotation;
  }
  EXPECT_NEAR(sigma0_square, 1, 0.1);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(std::sqrt(turn_square[axis]) / sigma[axis], 1, 0.12) << axis;
  }
}

TEST(AdjustSimilarity, NeedsThreePairsOffALine) {
  std::vector<PointPair> pairs = Pairs(SomeSimilarity(1), 0, 1);
  pairs.resize(2);
  EXPECT_FALSE(AdjustSimilarity(pairs, false));
  pairs.push_back(pairs[0]);
  pairs.back().in_model = {40, 0, 0};
  EXPECT_FALSE(AdjustSimilarity(pairs, false));
}

class PlacementFile : public testing::Test {
 protected:
  Placement Read(const std::string& text, double unit = 1) {
    folder_.Write("building/placement.json", text);
    return ReadPlacement({folder_.path()}, "house.dxf", unit);
  }
  std::string Complaint(const std::string& text) {
    try {
      Read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  Vector3d Placed(const std::string& text, const Vector3d& point, double unit = 1) {
    ModelMesh mesh;
    mesh.vertices = {point};
    Place({folder_.path()}, Read(text, unit), unit, &mesh);
    return mesh.vertices[0];
  }
  ScratchFolder folder_;
};

TEST_F(PlacementFile, ScalesTurnsAndShifts) {
  const std::string text = R"({"scale": 2, "rotation_deg": 90, "shift": [100, 200, 300]})";
  EXPECT_NEAR((Placed(text, {1, 0, 5}) - Vector3d(100, 202, 310)).norm(), 0, 1e-12);
}

// The importer took inches for the unit; the file was drawn in millimetres, y up.
TEST_F(PlacementFile, UnitAndUpReplaceTheModelsOwn) {
  const Vector3d read = 0.0254 * Vector3d(1000, 3000, -2000);
  EXPECT_NEAR((Placed(R"({"unit": "mm", "up": "y"})", read, 0.0254) - Vector3d(1, 2, 3)).norm(), 0,
              1e-12);
}

TEST_F(PlacementFile, PairsOfNamedPointsInTheModelsUnits) {
  folder_.Write("survey/control_points.csv",
                "name,x,y,z,sigma_x,sigma_y,sigma_z,role\nA,10,20,5,0.01,0.01,0.01,control\n"
                "B,10,23,5,0.02,0.02,0.02,control\nC,6,20,5,0.01,0.01,0.01,check\n");
  const std::string text = R"({"pairs": [
    {"model": [0, 0, 0], "point": "A"}, {"model": [3000, 0, 0], "point": "B"},
    {"model": [0, 4000, 0], "point": "C"}]})";
  const Placement placement = Read(text, 1e-3);
  ASSERT_TRUE(placement.adjusted);
  EXPECT_NEAR(placement.pairs[1].sigma, 0.02, 1e-12);
  EXPECT_NEAR((Placed(text, {3, 4, 1}, 1e-3) - Vector3d(6, 23, 6)).norm(), 0, 1e-9);
  EXPECT_THAT(Complaint(R"({"pairs": [{"model": [0, 0, 0], "point": "Z"}]})"),
              HasSubstr("placement.json:1: "));
}

TEST_F(PlacementFile, EntriesOfSingleModels) {
  EXPECT_EQ(Read(R"({"shift": [1, 1, 1], "models": {"house.dxf": {"shift": [2, 2, 2]}}})")
                .world_from_model.shift,
            Vector3d(2, 2, 2));
}

// EPSG:2056 to 21781, the two Swiss grids: 2 000 000 and 1 000 000 m apart, within centimetres.
TEST_F(PlacementFile, CoordinateSystems) {
  const Vector3d placed =
      Placed(R"({"model_crs": "EPSG:21781", "survey_crs": "EPSG:2056"})", {600100, 200200, 430});
  EXPECT_NEAR((placed - Vector3d(2600100, 1200200, 430)).head<2>().norm(), 0, 2);
  EXPECT_THAT(placed.z(), testing::DoubleNear(430, 1));
  // Unknown; in feet; in degrees; with heights in feet.
  for (const char* bad : {"EPSG:1", "EPSG:2263", "EPSG:4326", "EPSG:32618+6360"}) {
    folder_.Write("building/placement.json",
                  R"({"survey_crs": "EPSG:2056", "model_crs": ")" + std::string(bad) + R"("})");
    ModelMesh mesh;
    EXPECT_THROW(Place({folder_.path()}, ReadPlacement({folder_.path()}, "a", 1), 1, &mesh),
                 InputError)
        << bad;
  }
}

TEST_F(PlacementFile, BadInput) {
  EXPECT_THAT(Complaint(R"({"unit": "parsec"})"), HasSubstr("expected mm, cm"));
  EXPECT_THAT(Complaint(R"({"up": "x"})"), HasSubstr("neither"));
  EXPECT_THAT(Complaint(R"({"scale": 0})"), HasSubstr("not above 0"));
  EXPECT_THAT(Complaint(R"({"rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 2]]})"),
              HasSubstr("is no rotation"));
  EXPECT_THAT(Complaint(R"({"pairs": []})"), HasSubstr("three or more pairs"));
  EXPECT_THAT(Complaint(R"({"model_crs": "EPSG:2056"})"), HasSubstr("survey_crs"));
  EXPECT_EQ(Complaint("{}"), "");
}

AlignedBox3d Box(const Vector3d& low, const Vector3d& size) { return {low, low + size}; }

TEST(SiteCheck, NamesTheFactorThatIsOff) {
  const Vector3d origin(2600000, 1200000, 400), size(20, 12, 9);
  const AlignedBox3d site = Box(origin, {120, 90, 30});
  EXPECT_THAT(SuspicionsOf(Box(origin, size), site), IsEmpty());
  EXPECT_THAT(SuspicionsOf(Box(1000 * origin, 1000 * size), site), Contains(HasSubstr("of 1000:")));
  EXPECT_THAT(SuspicionsOf(Box(304.8 * origin, 304.8 * size), site),
              Contains(HasSubstr("of 304.8:")));
  EXPECT_THAT(SuspicionsOf(Box(25.4 * origin, 25.4 * size), site), Contains(HasSubstr("of 25.4:")));
  EXPECT_THAT(SuspicionsOf(Box(origin / 1000, size / 1000), site), Contains(HasSubstr("0.001:")));
  EXPECT_THAT(SuspicionsOf(Box(Vector3d::Zero(), size), site),
              Contains(HasSubstr("from the site")));
  EXPECT_THAT(SuspicionsOf(Box(Vector3d::Zero(), 1000 * size), {}), Contains(HasSubstr("1000:")));
  EXPECT_THAT(SuspicionsOf(Box(Vector3d::Zero(), size), {}), IsEmpty());
}

}  // namespace
}  // namespace insitu
