// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets_synthetic/building_writer.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"
#include "datasets_synthetic/pavilion.h"

namespace insitu::demo {
namespace {

namespace fs = std::filesystem;

class BuildingWriter : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  const fs::path folder_ =
      fs::path(testing::TempDir()) / ("insitu_building_" + std::to_string(getpid()));
};

struct Group {
  int code;
  std::string value;
};

std::vector<Group> Groups(const fs::path& path) {
  std::istringstream text(ReadWhole(path));
  std::vector<Group> groups;
  std::string code, value;
  while (std::getline(text, code) && std::getline(text, value)) {
    groups.push_back({std::stoi(code), value});
  }
  return groups;
}

TEST_F(BuildingWriter, WritesEveryKindOfEntityIntoAWellFormedDxf) {
  const Building pavilion = MakePavilion(0.4);
  WriteDxf(folder_ / "a.dxf", pavilion, {2600507, 1200318, 431.5});
  std::map<std::string, size_t> entities;
  std::map<std::string, int> handles;
  for (const Group& group : Groups(folder_ / "a.dxf")) {
    if (group.code == 0) ++entities[group.value];
    if (group.code == 5 && group.value != "FFFF") ++handles[group.value];
  }
  EXPECT_EQ(entities["SECTION"], 5u);
  EXPECT_EQ(entities["SECTION"], entities["ENDSEC"]);
  EXPECT_EQ(entities["BLOCK"], entities["ENDBLK"]);
  EXPECT_EQ(entities["3DFACE"], pavilion.panels.size() + pavilion.window.size());
  EXPECT_EQ(entities["INSERT"], pavilion.windows.size());
  EXPECT_EQ(entities["POLYLINE"], 2u);
  EXPECT_EQ(entities["VERTEX"], pavilion.bodies[0].vertices.size() +
                                    pavilion.bodies[0].triangles.size() +
                                    pavilion.meshes[0].vertices.size());
  EXPECT_EQ(entities["EOF"], 1u);
  for (const auto& [handle, count] : handles) EXPECT_EQ(count, 1) << handle;
}

TEST_F(BuildingWriter, KeepsSurveyCoordinates) {
  const Building pavilion = MakePavilion(0.4);
  const Eigen::Vector3d origin(2600507, 1200318, 431.5);
  WriteDxf(folder_ / "a.dxf", pavilion, origin);
  bool in_entities = false;
  std::vector<double> x, y;
  for (const Group& group : Groups(folder_ / "a.dxf")) {
    in_entities = in_entities || (group.code == 2 && group.value == "ENTITIES");
    if (in_entities && group.code == 10) x.push_back(std::stod(group.value));
    if (in_entities && group.code == 20) y.push_back(std::stod(group.value));
  }
  ASSERT_FALSE(x.empty());
  EXPECT_NEAR(x[0], origin.x() + pavilion.panels[0].corners[0].x(), 1e-6);
  EXPECT_NEAR(y[0], origin.y() + pavilion.panels[0].corners[0].y(), 1e-6);
}

TEST_F(BuildingWriter, DescribesEveryLayer) {
  WriteDxf(folder_ / "a.dxf", MakePavilion(0), Eigen::Vector3d::Zero());
  WriteBuildingMaterials(folder_ / "materials.json", MakePavilion(0), ClearMorning());
  const JsonNode layers = JsonNode::Load(folder_ / "materials.json").At("layers");
  for (const Group& group : Groups(folder_ / "a.dxf")) {
    if (group.code != 8 || group.value == "0") continue;
    const std::vector<double> rgb = layers.At(group.value).At("diffuse_rgb").Numbers();
    ASSERT_EQ(rgb.size(), 3u);
    for (const double value : rgb) {
      EXPECT_GT(value, 0);
      EXPECT_LT(value, 1);
    }
  }
  EXPECT_EQ(layers.At("PAV_GLASS").At("ior").Number(), MirrorIndex(Material::kGlass));
}

}  // namespace
}  // namespace insitu::demo
