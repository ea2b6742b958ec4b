// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/exchange/import_survey.h"

#include <cmath>

#include "reconstruction/exchange/read_survey_file.h"
#include "reconstruction/geometry/coordinate_system.h"
#include "tests/reconstruction/exchange/text_files.h"

namespace insitu {
namespace {

const std::set<std::string> kPhotos = {"IMG_1", "IMG_2"};

std::optional<Eigen::Vector2i> SizeOfPhoto(const std::string& photo) {
  if (!kPhotos.contains(photo)) return std::nullopt;
  return Eigen::Vector2i(4000, 3000);
}

class SurveyImported : public TextFiles {
 protected:
  SurveyImport Import(const std::vector<std::string>& names) const {
    std::vector<std::filesystem::path> files;
    for (const std::string& name : names) files.push_back(folder_ / name);
    return ImportSurvey(files, kPhotos, SizeOfPhoto, options_);
  }

  static bool Says(const SurveyImport& import, const std::string& words) {
    for (const std::string& line : import.report) {
      if (line.find(words) != std::string::npos) return true;
    }
    return false;
  }

  SurveyImportOptions options_;
};

TEST_F(SurveyImported, FilesAreMerged) {
  options_.sigma_m = 0.01;
  options_.mark_sigma_px = 0.5;
  options_.check_points = {"b"};
  Write("points.txt", "a 1 2 3\nb 4 5 6 0.001 0.002 0.003\n");
  Write("marks.csv", "IMG_1.JPG,a,100.5,200.5\nIMG_1.JPG,unknown,1,2\nIMG_9.JPG,a,1,2\n");
  const SurveyImport import = Import({"points.txt", "marks.csv"});
  ASSERT_EQ(import.control_points.size(), 2u);
  EXPECT_EQ(import.control_points[0].sigma, Eigen::Vector3d::Constant(0.01));
  EXPECT_EQ(import.control_points[1].sigma, Eigen::Vector3d(0.001, 0.002, 0.003));
  EXPECT_EQ(import.control_points[1].role, ControlRole::kCheck);
  ASSERT_EQ(import.observations.size(), 1u);
  EXPECT_EQ(import.observations[0].pixel, Eigen::Vector2d(100, 200));
  EXPECT_TRUE(Says(import, "taken as they are, in metres"));
  EXPECT_TRUE(Says(import, "not in the folder photos"));
  EXPECT_TRUE(Says(import, "without coordinates"));
}

TEST_F(SurveyImported, OptionsNameTheFieldThatIsWrong) {
  const auto fault = [&] {
    try {
      Import({});
    } catch (const CheckError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  options_.sigma_m = 0;
  EXPECT_NE(fault().find("*sigma_m > 0"), std::string::npos);
  options_.sigma_m = 0.01;
  options_.mark_sigma_px = -1;
  EXPECT_NE(fault().find("mark_sigma_px"), std::string::npos);
}

TEST_F(SurveyImported, SigmaMustComeFromSomewhere) {
  Write("points.txt", "# names\na 1 2 3\n");
  ExpectError([&] { Import({"points.txt"}); }, "points.txt", 2, "--sigma-m");
  options_.sigma_m = 0.01;
  Write("marks.csv", "IMG_1.JPG,a,100.5,200.5\n");
  ExpectError([&] { Import({"points.txt", "marks.csv"}); }, "marks.csv", 1, "--mark-sigma-px");
}

TEST_F(SurveyImported, ContradictionsAreFound) {
  options_.sigma_m = 0.01;
  options_.mark_sigma_px = 0.5;
  Write("a.txt", "a 1 2 3\n");
  Write("b.txt", "b 1 2 3\na 1 2 4\n");
  ExpectError([&] { Import({"a.txt", "b.txt"}); }, "b.txt", 2, "another place");
  Write("twice.csv", "IMG_1.JPG,a,1,2\nIMG_1.JPG,a,1,3\n");
  ExpectError([&] { Import({"a.txt", "twice.csv"}); }, "twice.csv", 2, "elsewhere");
  Write("off.csv", "IMG_1.JPG,a,5000,2\n");
  ExpectError([&] { Import({"a.txt", "off.csv"}); }, "off.csv", 1, "another size");
  Write("other.csv", "IMG_9.JPG,a,1,2\n");
  ExpectError([&] { Import({"other.csv"}); }, "other.csv", 0, "--photo");
  options_.photo_names["IMG_9"] = "IMG_2";
  EXPECT_EQ(Import({"a.txt", "other.csv"}).observations[0].photo, "IMG_2");
}

// On a zone's central meridian E is 500 km and N 0.9996 of the meridian's arc, on WGS 84 by the
// series 111132.954 B - 16038.509 sin 2B + 16.833 sin 4B - 0.022 sin 6B. [Snyder 1987, (3-21)]
TEST_F(SurveyImported, DegreesBecomeUtm) {
  options_.sigma_m = 0.01;
  Write("gcp_list.txt", "EPSG:4326\n9 47 410.5 100 200 IMG_1.JPG a\n");
  options_.mark_sigma_px = 1;
  const SurveyImport import = Import({"gcp_list.txt"});
  const Eigen::Vector3d& position = import.control_points[0].position;
  EXPECT_NEAR(position.x(), 500000, 1e-6);
  const double latitude = 47 * M_PI / 180;
  const double arc = 111132.95255 * 47 - 16038.50841 * std::sin(2 * latitude) +
                     16.83261 * std::sin(4 * latitude) - 0.02198 * std::sin(6 * latitude);
  EXPECT_NEAR(position.y(), 0.9996 * arc, 0.01);
  EXPECT_EQ(position.z(), 410.5);
  EXPECT_TRUE(Says(import, "UTM zone 32N"));
  EXPECT_TRUE(Says(import, "heights are kept"));
}

TEST_F(SurveyImported, LatitudeFirstIsPutRight) {
  options_.sigma_m = 0.01;
  options_.file_crs = "EPSG:4326";
  Write("pix4d.csv", "a,47,9,410.5\n");
  EXPECT_NEAR(Import({"pix4d.csv"}).control_points[0].position.x(), 500000, 1e-6);
  Write("list.txt", "a 9 47 410.5\n");
  EXPECT_NEAR(Import({"list.txt"}).control_points[0].position.x(), 500000, 1e-6);
}

TEST_F(SurveyImported, ProjectedCoordinatesKeepEveryDigit) {
  options_.sigma_m = 0.01;
  Write("gcp_list.txt", "EPSG:2056\na 2600000.125 1200000.0625 410.5\n");
  EXPECT_EQ(Import({"gcp_list.txt"}).control_points[0].position,
            Eigen::Vector3d(2600000.125, 1200000.0625, 410.5));
  options_.crs = "EPSG:21781";  // the older frame of the same projection: 2 000 km and 1 000 km off
  EXPECT_NEAR((Import({"gcp_list.txt"}).control_points[0].position -
               Eigen::Vector3d(600000.125, 200000.0625, 410.5))
                  .norm(),
              0, 2);
}

TEST_F(SurveyImported, MixedOrImpossibleSystemsAreRefused) {
  options_.sigma_m = 0.01;
  Write("swiss.txt", "EPSG:2056\na 2600000 1200000 410\n");
  Write("utm.txt", "EPSG:32632\nb 400000 5200000 410\n");
  Write("none.txt", "c 1 2 3\n");
  ExpectError([&] { Import({"swiss.txt", "utm.txt"}); }, "utm.txt", 0, "mixed");
  ExpectError([&] { Import({"swiss.txt", "none.txt"}); }, "none.txt", 0, "mixed");
  Write("feet.txt", "EPSG:2263\na 987654 123456 410\n");
  ExpectError([&] { Import({"feet.txt"}); }, "feet.txt", 0, "metres");
  Write("unknown.txt", "EPSG:99999999\na 1 2 3\n");
  ExpectError([&] { Import({"unknown.txt"}); }, "unknown.txt", 0, "not known");
  Write("metres.txt", "EPSG:4326\na 2600000 1200000 410\n");
  ExpectError([&] { Import({"metres.txt"}); }, "metres.txt", 2, "longitude");
  Write("degrees.csv", "label,longitude,latitude,altitude\na,9,47,410\n");
  ExpectError([&] { Import({"degrees.csv"}); }, "degrees.csv", 0, "--file-crs");
  options_.file_crs = "EPSG:2056";
  ExpectError([&] { Import({"degrees.csv"}); }, "degrees.csv", 0, "no system of degrees");
  options_.file_crs.reset();
  Write("feet_up.txt", "EPSG:32618+6360\na 400000 5200000 410\n");  // UTM, NAVD88 height (ftUS)
  ExpectError([&] { Import({"feet_up.txt"}); }, "feet_up.txt", 0, "heights in another unit");
  options_.crs = "EPSG:2056";
  ExpectError([&] { Import({"none.txt"}); }, "none.txt", 0, "--file-crs");
}

// Photo names with blanks, of another case, in tables between tabulators.
TEST_F(SurveyImported, PhotoNamesWithBlanksAndOfOtherCase) {
  options_.sigma_m = 0.01;
  options_.mark_sigma_px = 0.5;
  Write("tabs.txt", "EPSG:32632\n465000\t5250000\t400\t10\t20\timg_1.jpg\tp 1\n");
  const SurveyImport tabs = Import({"tabs.txt"});
  ASSERT_EQ(tabs.observations.size(), 1u);
  EXPECT_EQ(tabs.observations[0].photo, "IMG_1");
  EXPECT_EQ(tabs.observations[0].point, "p 1");
  EXPECT_TRUE(Says(tabs, "taken for the site's \"IMG_1\""));
  const SurveyFile blanks = ReadSurveyFile(
      Write("blanks.txt", "EPSG:32632\n465000 5250000 400 10 20 IMG 1 (2).jpg p\n"), SizeOfPhoto);
  EXPECT_EQ(blanks.marks[0].photo, "IMG 1 (2)");
  EXPECT_EQ(blanks.marks[0].point, "p");
  const SurveyFile words = ReadSurveyFile(
      Write("words.txt", "LV95\n2600000 1200000 400 10 20 IMG_1.jpg p\n"), SizeOfPhoto);
  EXPECT_EQ(words.crs, "LV95");
}

TEST_F(SurveyImported, PlacesOutsideTheAreaOfUseAreTold) {
  options_.sigma_m = 0.01;
  Write("near.txt", "EPSG:32632\na 930000 5250000 410\nb 500000 5250000 410\n");
  EXPECT_TRUE(Says(Import({"near.txt"}), "WARNING: 1 of 2 points, point \"a\""));
  Write("swapped.txt", "EPSG:2056\na 1200000 2600000 410\n");
  ExpectError([&] { Import({"swapped.txt"}); }, "swapped.txt", 2, "with x and y exchanged");
  Write("band.txt", "WGS84 UTM 17S\na 713000 3967000 120\n");
  options_.crs = "EPSG:32617";
  ExpectError([&] { Import({"band.txt"}); }, "band.txt", 2, "outside the area of use");
  options_.crs.reset();
  EXPECT_TRUE(Says(Import({"band.txt"}), "write 17N"));
}

TEST_F(SurveyImported, SystemsInFeetWithColumnsThatStateTheirUnit) {
  options_.sigma_m = 0.01;
  options_.file_crs = "EPSG:2263";
  Write("feet.csv",
        "Name,Easting (US ft),Northing (US ft),Height (US ft)\na,987654,123456,39.37\n");
  const SurveyImport import = Import({"feet.csv"});
  EXPECT_NEAR(import.control_points[0].position.x(), 987654 * 1200.0 / 3937, 1e-6);
  EXPECT_NEAR(import.control_points[0].position.z(), 12, 1e-9);
  options_.crs = "EPSG:32618";
  EXPECT_NEAR(Import({"feet.csv"}).control_points[0].position.y(), 4.45e6, 1e5);
}

TEST_F(SurveyImported, NamesAreQuotedWhereTheyNeedIt) {
  options_.sigma_m = 0.01;
  Write("points.csv", "name,x,y,z\n\"a,b\",1,2,3\n");
  EXPECT_EQ(Import({"points.csv"}).control_points[0].name, "a,b");
}

TEST(CoordinateSystems, AreKnownByTheWordsOfOpenDroneMap) {
  const auto utm = CoordinateSystem::FromText("WGS84 UTM 32N");
  ASSERT_TRUE(utm);
  EXPECT_EQ(utm->Code(), "EPSG:32632");
  EXPECT_EQ(*utm, CoordinateSystem::UtmZone(9, 47));
  EXPECT_EQ(CoordinateSystem::UtmZone(-70.5, -33.4).Code(), "EPSG:32719");
  EXPECT_TRUE(CoordinateSystem::FromText("WGS84")->is_geographic());
  EXPECT_TRUE(CoordinateSystem::FromText("+proj=utm +zone=32 +datum=WGS84 +units=m +no_defs"));
  EXPECT_FALSE(CoordinateSystem::FromText("EPSG:4978"));  // geocentric
  EXPECT_EQ(CoordinateSystem::FromText("EPSG:2056")->metres_per_height(), 1);
  EXPECT_EQ(CoordinateSystem::FromText("EPSG:2056+5728")->metres_per_height(), 1);  // LN02
  EXPECT_EQ(CoordinateSystem::FromText("EPSG:4979")->metres_per_height(), 1);       // ellipsoidal
  EXPECT_NEAR(CoordinateSystem::FromText("EPSG:32618+6360")->metres_per_height(), 0.3048006, 1e-7);
  EXPECT_EQ(CoordinateSystem::FromText("EPSG:32618+5715")->metres_per_height(), -1);  // depth
  EXPECT_FALSE(CoordinateSystem::FromText("Mars"));
  EXPECT_FALSE(CoordinateSystem::FromText(""));
}

}  // namespace
}  // namespace insitu
