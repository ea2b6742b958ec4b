// SPDX-License-Identifier: GPL-3.0-or-later
// What is written from rows is what the programs read.
#include <gtest/gtest.h>

#include <filesystem>

#include "radiometry/measure/samples.h"
#include "reconstruction/editing/site_edit.h"
#include "reconstruction/survey/read_survey.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/radiometry/measure/synthetic_site.h"
#include "tests/reconstruction/survey/synthetic_network.h"

namespace insitu {
namespace {

// All rows of a site, one operation each, into a site without a survey.
void CopyRows(const SiteEdit& from, SiteEdit& to) {
  for (const EditedTable& table : EditedTables()) {
    for (const Json::Value& row : from.Rows(table.name)) {
      const Operation operation{
          "copy " + std::to_string(to.revision()), "copy", {{table.name, Json::Value(), row}}};
      const EditOutcome outcome = to.Apply(operation);
      ASSERT_TRUE(outcome.is_done()) << outcome.refused.text() << OneLineJson(row);
    }
  }
  ASSERT_TRUE(to.Save().is_saved());
}

void ExpectSamePoints(const std::vector<ControlPoint>& a, const std::vector<ControlPoint>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_EQ(a[i].position, b[i].position);
    EXPECT_EQ(a[i].sigma, b[i].sigma);
    EXPECT_EQ(a[i].role, b[i].role);
  }
}

void ExpectSameMarks(const Survey& a, const Survey& b) {
  ASSERT_EQ(a.observations.size(), b.observations.size());
  for (size_t i = 0; i < a.observations.size(); ++i) {
    EXPECT_EQ(a.observations[i].photo, b.observations[i].photo);
    EXPECT_EQ(a.observations[i].point, b.observations[i].point);
    EXPECT_EQ(a.observations[i].pixel, b.observations[i].pixel);
    EXPECT_EQ(a.observations[i].sigma_px, b.observations[i].sigma_px);
  }
  ASSERT_EQ(a.edges.size(), b.edges.size());
  for (size_t i = 0; i < a.edges.size(); ++i) EXPECT_EQ(a.edges[i].pixel, b.edges[i].pixel);
}

void ExpectSameShapes(const Survey& a, const Survey& b) {
  ASSERT_EQ(a.polygons.size(), b.polygons.size());
  for (size_t i = 0; i < a.polygons.size(); ++i) {
    EXPECT_EQ(a.polygons[i].name, b.polygons[i].name);
    EXPECT_EQ(a.polygons[i].vertices, b.polygons[i].vertices);
    EXPECT_EQ(a.polygons[i].photo, b.polygons[i].photo);
    EXPECT_EQ(a.polygons[i].material, b.polygons[i].material);
  }
  ASSERT_EQ(a.sun_pairs.size(), b.sun_pairs.size());
  for (size_t i = 0; i < a.sun_pairs.size(); ++i) {
    EXPECT_EQ(a.sun_pairs[i].from, b.sun_pairs[i].from);
    EXPECT_EQ(a.sun_pairs[i].to, b.sun_pairs[i].to);
  }
  ASSERT_EQ(a.zenith_pairs.size(), b.zenith_pairs.size());
  EXPECT_EQ(a.camera_positions.size(), b.camera_positions.size());
  ASSERT_EQ(a.constraints.size(), b.constraints.size());
  for (size_t i = 0; i < a.constraints.size(); ++i) {
    EXPECT_EQ(a.constraints[i].kind, b.constraints[i].kind);
    EXPECT_EQ(a.constraints[i].points, b.constraints[i].points);
    EXPECT_EQ(a.constraints[i].sigma, b.constraints[i].sigma);
  }
}

TEST(ReadByPrograms, TheSurvey) {
  SyntheticNetworkOptions options;
  options.has_extras = true;
  const SyntheticNetwork network = MakeSyntheticNetwork(options);
  const ScratchFolder folder;
  const SitePaths written{folder.path() / "written"}, copied{folder.path() / "copied"};
  WriteSurvey(written, network.survey);
  const SiteEdit from(written, network.photos);
  SiteEdit to(copied, network.photos);
  EXPECT_TRUE(from.read_only().empty());
  ASSERT_NO_FATAL_FAILURE(CopyRows(from, to));
  const Survey a = ReadSurvey(written, network.photos), b = ReadSurvey(copied, network.photos);
  ASSERT_GT(a.edges.size() * a.constraints.size() * a.camera_positions.size(), 0u);
  ExpectSamePoints(a.control_points, b.control_points);
  ExpectSameMarks(a, b);
  ExpectSameShapes(a, b);
}

TEST(ReadByPrograms, NoMarkThatIsOffAndEveryOther) {
  const SyntheticNetwork network = MakeSyntheticNetwork();
  const ScratchFolder folder;
  const SitePaths site{folder.path()};
  WriteSurvey(site, network.survey);
  SiteEdit edit(site, network.photos);
  const auto marks = edit.Rows("observations");
  const auto change = [&](size_t index, const std::string& key, const Json::Value& value) {
    Json::Value row = marks[index];
    row[key] = value;
    EXPECT_TRUE(edit.Apply({key + std::to_string(index), "", {{"observations", marks[index], row}}})
                    .is_done());
  };
  change(0, "state", "off");
  change(1, "state", "dubious");
  change(2, "note", "at the kerb");
  change(3, "x", 0.30000000000000004);
  change(4, "state", "off");
  EXPECT_TRUE(edit.Save().is_saved());
  const Survey read = ReadSurvey(site, network.photos);
  ASSERT_EQ(read.observations.size(), marks.size() - 2);
  EXPECT_EQ(read.observations[0].point, marks[1]["point"].asString());
  EXPECT_EQ(read.observations[2].pixel.x(), 0.30000000000000004);
  EXPECT_EQ(read.observations[3].point, marks[5]["point"].asString());
}

TEST(ReadByPrograms, TheSamples) {
  const SyntheticSite synthetic = MakeSyntheticSite("read_by_programs");
  std::vector<Photograph> photos;
  for (const char* photo : {"A.exr", "B.exr"}) {
    photos.push_back(ReadPhotograph(synthetic.site.photos() / photo));
  }
  const LightSamples a = ReadSamples(synthetic.site, synthetic.scene, photos);
  const ScratchFolder folder;
  const SitePaths copied{folder.path()};
  {
    const SiteEdit from(synthetic.site, {"A", "B"});
    SiteEdit to(copied, {"A", "B"});
    ASSERT_NO_FATAL_FAILURE(CopyRows(from, to));
  }
  const LightSamples b = ReadSamples(copied, synthetic.scene, photos);
  EXPECT_EQ(a.horizon.size(), b.horizon.size());
  ASSERT_EQ(a.haze.size(), b.haze.size());
  ASSERT_EQ(a.daylight.size(), b.daylight.size());
  for (size_t i = 0; i < a.haze.size(); ++i) {
    EXPECT_EQ(a.haze[i].pixel, b.haze[i].pixel);
    EXPECT_EQ(a.haze[i].polygon, b.haze[i].polygon);
  }
  EXPECT_EQ(a.daylight_reflectance, b.daylight_reflectance);
  SiteEdit to(copied, {"A", "B"});
  for (const Json::Value& row : to.Rows("haze")) {
    EXPECT_TRUE(to.Apply({OneLineJson(row), "", {{"haze", row, Json::Value()}}}).is_done());
  }
  EXPECT_TRUE(to.Save().is_saved());
  EXPECT_TRUE(ReadSamples(copied, synthetic.scene, photos).haze.empty());
}

}  // namespace
}  // namespace insitu
