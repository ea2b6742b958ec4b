// SPDX-License-Identifier: GPL-3.0-or-later
// New sites, and the examples of FILES.md, which every reader must take.
#include "reconstruction/new_site.h"

#include <gmock/gmock.h>

#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"
#include "calibration/photo/photograph.h"
#include "reconstruction/editing/edited_tables.h"
#include "reconstruction/editing/row_checks.h"
#include "reconstruction/site_schemas.h"
#include "reconstruction/site_sun.h"
#include "reconstruction/survey/read_survey.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;

class NewSiteFolder : public testing::Test {
 protected:
  NewSiteFolder() {
    for (const std::string photo : {"IMG_0001", "IMG_0002"}) {
      Raster picture(640, 480);
      picture.SetRgb(photo.back() - '0', 0, {1, 1, 1});
      WritePng(pictures_ / (photo + ".png"), picture, Encoding::kSrgb8);
    }
  }
  ScratchFolder folder_;
  const fs::path pictures_ = folder_.path() / "pictures";
  const SitePaths site_{folder_.path() / "mill"};
  const std::vector<std::string> photos_ = {"IMG_0001", "IMG_0002"};
};

TEST_F(NewSiteFolder, HoldsTemplatesThatAreRead) {
  const NewSite made = MakeNewSite(site_, pictures_);
  EXPECT_THAT(made.written, Contains("photos/IMG_0002.png"));
  EXPECT_THAT(made.written, Contains("survey/control_points.csv"));
  EXPECT_THAT(made.remarks, Contains(HasSubstr("2 photographs in")));
  EXPECT_THAT(made.remarks, Contains(HasSubstr("no photograph states its place")));
  const Survey survey = ReadSurvey(site_, photos_);
  EXPECT_TRUE(survey.control_points.empty() && survey.observations.empty());
  EXPECT_EQ(JsonNode::Load(site_.description()).At("name").Text(), "mill");
  EXPECT_EQ(JsonNode::Load(site_.survey() / "samples.json").At("daylight").Items().size(), 0u);
  for (const SiteSchema& schema : kSiteSchemas) {
    EXPECT_NO_THROW(ReadJson(site_.root / "schemas" / schema.name));
  }
}

TEST_F(NewSiteFolder, KeepsWhatIsThere) {
  const std::string own = "name,x,y,z,sigma_x,sigma_y,sigma_z,role\n";
  WriteWhole(site_.survey() / "control_points.csv", own);
  MakeNewSite(site_, pictures_);
  EXPECT_EQ(ReadWhole(site_.survey() / "control_points.csv"), own);
  EXPECT_TRUE(MakeNewSite(site_).written.empty());
}

TEST_F(NewSiteFolder, NeedsPhotographs) {
  EXPECT_THAT(InputErrorOf([&] { MakeNewSite(site_); }), HasSubstr("--photos FOLDER"));
  EXPECT_FALSE(fs::exists(site_.root));
  WriteWhole(site_.photos() / "IMG_0001.png", "another");
  EXPECT_THAT(InputErrorOf([&] { MakeNewSite(site_, pictures_); }),
              HasSubstr("already with another content"));
  EXPECT_FALSE(fs::exists(site_.description()));
}

// The first block of code behind a heading that names a file.
std::string ExampleOf(const std::string& file) {
  const std::string text =
      ReadWhole(fs::path(INSITU_SOURCE_FOLDER) / "reconstruction" / "FILES.md");
  const size_t heading = text.find("## `" + file + "`\n");
  if (heading == std::string::npos) return "";
  const size_t begin = text.find('\n', text.find("```", heading)) + 1;
  return text.substr(begin, text.find("```", begin) - begin);
}

class FilesOfDocument : public NewSiteFolder {
 protected:
  FilesOfDocument() {
    MakeNewSite(site_, pictures_);
    for (const std::string file :
         {"site.json", "survey/control_points.csv", "survey/observations.csv",
          "survey/polygons.json", "survey/directions.json", "survey/constraints.json",
          "survey/camera_positions.csv", "survey/edges.csv", "survey/samples.json"}) {
      WriteWhole(site_.root / file, ExampleOf(file));
    }
  }
};

TEST_F(FilesOfDocument, AreReadAsASurvey) {
  const Survey survey = ReadSurvey(site_, photos_);
  EXPECT_EQ(survey.control_points.size(), 3u);
  EXPECT_EQ(survey.observations.size(), 8u);
  EXPECT_EQ(survey.polygons.size(), 1u);
  EXPECT_EQ(survey.sun_pairs.size() + survey.zenith_pairs.size(), 2u);
  EXPECT_EQ(survey.constraints.size(), 4u);
  EXPECT_EQ(survey.camera_positions.size(), 1u);
  EXPECT_EQ(survey.edges.size(), 1u);
  const SitePhotos photos{{}, photos_, {}, {}, {}};
  const auto sun = SunCircumstancesOf(site_, photos, survey);
  ASSERT_TRUE(sun.has_value());
  EXPECT_EQ(sun->local_time, "2024-05-15T09:45:00+02:00");
}

TEST_F(FilesOfDocument, HoldSamplesThatThePageTakes) {
  const Json::Value samples = ReadJson(site_.survey() / "samples.json");
  for (const EditedTable& table : EditedTables()) {
    if (table.file != "survey/samples.json" || table.member.empty()) continue;
    for (const Json::Value& row : samples[table.member]) {
      EXPECT_EQ(FaultOfRow(table, row, photos_), std::nullopt);
    }
  }
  EXPECT_EQ(samples["daylight"].size(), 3u);
}

}  // namespace
}  // namespace insitu
