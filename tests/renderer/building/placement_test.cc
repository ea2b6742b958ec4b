// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/placement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/files/error.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

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
  EXPECT_NEAR(placement.pairs[1].points.sigma.x(), 0.02, 1e-12);
  EXPECT_NEAR((Placed(text, {3, 4, 1}, 1e-3) - Vector3d(6, 23, 6)).norm(), 0, 1e-9);
  EXPECT_THAT(Complaint(R"({"pairs": [{"model": [0, 0, 0], "point": "Z"}]})"),
              HasSubstr("placement.json:1: "));
}

TEST_F(PlacementFile, EntriesOfSingleModels) {
  EXPECT_EQ(Read(R"({"shift": [1, 1, 1], "models": {"house.dxf": {"shift": [2, 2, 2]}}})")
                .world_from_model.translation,
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

// As an IFC file states where on the map it stands.
TEST_F(PlacementFile, MapConversionOfTheModel) {
  folder_.Write("building/placement.json", R"({"map_conversion": true})");
  Similarity3 map;
  map.translation = {2600000.125, 1200000.25, 430};
  const Placement placement = ReadPlacement({folder_.path()}, "house.ifc", 1, map);
  EXPECT_EQ(placement.world_from_model * Vector3d(1, 2, 3), Vector3d(2600001.125, 1200002.25, 433));
  EXPECT_THAT(Complaint(R"({"map_conversion": true})"), HasSubstr("states no map conversion"));
  EXPECT_EQ(Complaint(R"({"map_conversion": false})"), "");
}

TEST_F(PlacementFile, BadInput) {
  EXPECT_THAT(Complaint(R"({"unit": "parsec"})"), HasSubstr("expected mm, cm"));
  EXPECT_THAT(Complaint(R"({"up": "x"})"), HasSubstr("neither"));
  EXPECT_THAT(Complaint(R"({"scale": 0})"), HasSubstr("not above 0"));
  EXPECT_THAT(Complaint(R"({"rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 2]]})"),
              HasSubstr("is no rotation"));
  EXPECT_THAT(Complaint(R"({"pairs": []})"), HasSubstr("three or more pairs"));
  EXPECT_THAT(Complaint(R"({"pairs": [{"model": [0, 0, 0], "survey": [0, 0, 0], "sigma": 0}]})"),
              HasSubstr("is not above 0"));
  EXPECT_THAT(Complaint(R"({"model_crs": "EPSG:2056"})"), HasSubstr("survey_crs"));
  EXPECT_EQ(Complaint("{}"), "");
}

}  // namespace
}  // namespace insitu
