// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/prepare/film_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/camera_files/film.h"
#include "calibration/site_cameras.h"
#include "tests/reconstruction/editing/edited_site.h"

namespace insitu {
namespace {

using testing::HasSubstr;

// A camera of 56 x 56 mm, scanned with 10 px/mm, y down.
class FilmMessageTest : public EditedSite {
 protected:
  FilmMessageTest() { Open(); }

  Json::Value Message() const {
    return FilmMessage(site_, edit_->Tables(), {{"A", {600, 600}}, {"B", {600, 600}}});
  }
  EditOutcome Put(const std::string& table, const std::string& row) {
    return Apply(std::to_string(++count_), table, none_, RowOf(row));
  }
  void TypeCertificate() {
    ASSERT_TRUE(
        Put("film", R"({"focal_mm": 61.02, "principal_point_mm": [0.01, -0.02]})").is_done());
    for (const char* row :
         {R"({"mark": "1", "x_mm": -28, "y_mm": -28})", R"({"mark": "2", "x_mm": 28, "y_mm": -28})",
          R"({"mark": "3", "x_mm": 28, "y_mm": 28})",
          R"({"mark": "4", "x_mm": -28, "y_mm": 28})"}) {
      ASSERT_TRUE(Put("film_marks", row).is_done());
    }
  }
  // Of photo A, `off` px away.
  void Place(const std::string& mark, double x_mm, double y_mm, double off = 0) {
    Json::Value row;
    row["mark"] = mark;
    row["photo"] = "A";
    row["x_mm"] = x_mm;
    row["y_mm"] = y_mm;
    row["x"] = 300 + 10 * x_mm + off;
    row["y"] = 300 - 10 * y_mm;
    ASSERT_TRUE(Apply(std::to_string(++count_), "fiducials", none_, row).is_done());
  }

  int count_ = 0;
};

TEST_F(FilmMessageTest, WithoutFilmThereIsNone) { EXPECT_TRUE(Message().isNull()); }

TEST_F(FilmMessageTest, SaysWhatIsMissing) {
  ASSERT_TRUE(Put("film_marks", R"({"mark": "1", "x_mm": -28, "y_mm": -28})").is_done());
  const Json::Value message = Message();
  EXPECT_EQ(message["missing"][0]["text_said"]["key"], "filmNoFocal");
  EXPECT_EQ(message["missing"][0]["text"], "the principal distance");
  EXPECT_EQ(message["missing"][1]["text"], "2 more fiducial marks with their millimetres");
  EXPECT_EQ(message["photos"].size(), 2U);  // no other camera: all are scans
}

TEST_F(FilmMessageTest, ResidualsInPixelsAndMillimetresAfterEachMark) {
  TypeCertificate();
  Place("1", -28, -28);
  Place("2", 28, -28);
  EXPECT_EQ(Message()["photos"]["A"]["predicted"]["3"][0].asDouble(), 580);
  Place("3", 28, 28);
  EXPECT_TRUE(Message()["photos"]["A"]["sigma_px"].isNull());
  EXPECT_TRUE(Message()["photos"]["A"]["marks"][0]["w"].isNull());
  Place("4", -28, 28, 0.8);
  const Json::Value scan = Message()["photos"]["A"];
  EXPECT_EQ(scan["redundancy"], 2);
  EXPECT_NEAR(scan["px_per_mm"].asDouble(), 10, 0.02);
  EXPECT_NEAR(std::abs(scan["marks"][0]["vx"].asDouble()), 0.2, 1e-9);
  EXPECT_NEAR(std::abs(scan["marks"][0]["vx_mm"].asDouble()), 0.02, 1e-4);
  EXPECT_NEAR(scan["sigma_px"].asDouble(), std::sqrt(4 * 0.2 * 0.2 / 2), 1e-9);
  EXPECT_EQ(Message()["photos"]["B"]["unplaced"].size(), 4U);
}

// What the page has written, the programs read.
TEST_F(FilmMessageTest, TheFilesAreReadByTheFilmReader) {
  TypeCertificate();
  for (const auto& [mark, x, y] : {std::tuple("1", -28, -28), {"2", 28, -28}, {"3", 28, 28}}) {
    Place(mark, x, y);
  }
  ASSERT_TRUE(edit_->Save().is_saved());
  const FilmCamera film = ReadFilmCamera(site_.boards() / "film.json");
  EXPECT_EQ(film.focal_mm, 61.02);
  EXPECT_EQ(film.fiducials.size(), 4U);
  const auto marks = ReadFiducials(site_.boards() / "fiducials.csv").at("A");
  ASSERT_EQ(marks.size(), 3U);
  EXPECT_EQ(marks[2].bitmap_px, Eigen::Vector2d(580, 20));
  EXPECT_NO_THROW(CheckCertified(film, "", marks));
  EXPECT_EQ(ListCameraFolders(site_)[0].source, CameraSource::kFilm);
}

// A mark switched off stays in the file, as a comment that no program reads.
TEST_F(FilmMessageTest, AMarkSwitchedOffIsLeftOutByMapAndReader) {
  TypeCertificate();
  for (const auto& [mark, x, y] : {std::tuple("1", -28, -28), {"2", 28, -28}, {"3", 28, 28}}) {
    Place(mark, x, y);
  }
  Place("4", -28, 28, 50);
  Json::Value before = edit_->Rows("fiducials")[3], after = before;
  after["state"] = "off";
  ASSERT_TRUE(Apply("off", "fiducials", before, after).is_done());
  const Json::Value scan = Message()["photos"]["A"];
  EXPECT_EQ(scan["placed"], 3);
  EXPECT_TRUE(scan["unplaced"].empty());
  EXPECT_TRUE(scan["suspicions"].empty());
  ASSERT_TRUE(edit_->Save().is_saved());
  const auto file = site_.boards() / "fiducials.csv";
  EXPECT_THAT(Content("calibration/fiducials.csv"), HasSubstr("\n#off 4,-28,28,A,70,20"));
  EXPECT_EQ(ReadFiducials(file).at("A").size(), 3U);
  Reopen();
  EXPECT_EQ(edit_->Rows("fiducials")[3]["state"], "off");
  EXPECT_EQ(Message()["photos"]["A"]["placed"], 3);
}

// A dubious mark has three times the sigma of others, in the page's map and in the programs'.
TEST_F(FilmMessageTest, ADubiousMarkWeighsLess) {
  TypeCertificate();
  for (const auto& [mark, x, y] : {std::tuple("1", -28, -28), {"2", 28, -28}, {"3", 28, 28}}) {
    Place(mark, x, y);
  }
  Place("4", -28, 28, 0.8);
  Json::Value before = edit_->Rows("fiducials")[3], after = before;
  after["state"] = "dubious";
  ASSERT_TRUE(Apply("doubt", "fiducials", before, after).is_done());
  const Json::Value marks = Message()["photos"]["A"]["marks"];  // in any order: all w are equal
  for (const Json::Value& mark : marks) {
    EXPECT_NEAR(std::abs(mark["vx"].asDouble()), mark["mark"] == "4" ? 0.6 : 0.2 / 3, 1e-9);
    EXPECT_NEAR(mark["w"].asDouble(), 0.6 / (3 * 0.5 * std::sqrt(0.75)), 1e-9);
  }
  ASSERT_TRUE(edit_->Save().is_saved());
  EXPECT_EQ(ReadFiducials(site_.boards() / "fiducials.csv").at("A")[3].sigma_times, 3);
}

// Files that are there keep every byte that no edit touches.
TEST_F(FilmMessageTest, FilesThatAreThereKeepTheirManner) {
  const std::string film =
      "{\"focal_mm\": 60.20, \"comment\":\"lab\",\r\n \"distortion\": [[20, 0.0020],[40,0.005]]}";
  const std::string marks =
      "# scanned 1994\r\nmark,x_mm,y_mm,photo,x,y,note\r\n1,-28.000,28.0,A,16.0,15,faint\r\n";
  folder_.Write("calibration/old/film.json", film);
  folder_.Write("calibration/old/fiducials.csv", marks);
  Reopen();
  EXPECT_EQ(Message()["folder"], "calibration/old");
  Json::Value before = edit_->Rows("fiducials")[0], after = before;
  after["x"] = 16.5;
  ASSERT_TRUE(Apply("move", "fiducials", before, after).is_done());
  before = after = edit_->Rows("film")[0];
  after["focal_mm"] = 60.3;
  ASSERT_TRUE(Apply("focal", "film", before, after).is_done());
  ASSERT_TRUE(edit_->Save().is_saved());
  EXPECT_EQ(Content("calibration/old/fiducials.csv"), Replaced(marks, "16.0,15", "16.5,15"));
  EXPECT_EQ(Content("calibration/old/film.json"), Replaced(film, "60.20", "60.3"));
  edit_->Undo("u1");
  edit_->Undo("u2");
  ASSERT_TRUE(edit_->Save().is_saved());
  EXPECT_EQ(Content("calibration/old/fiducials.csv"), marks);
  EXPECT_EQ(Content("calibration/old/film.json"), film);
}

TEST_F(FilmMessageTest, AFileAtFaultIsReadOnlyAndNamedWithItsLine) {
  folder_.Write("calibration/film.json", "{\"focal_mm\": 60}");
  folder_.Write("calibration/fiducials.csv", "mark,x_mm,y_mm,photo,x,y\n1,-28,abc,A,16,15\n");
  Reopen();
  EXPECT_THAT(
      Put("fiducials", R"({"mark": "2", "x_mm": 1, "y_mm": 2, "photo": "A", "x": 1, "y": 2})")
          .refused.text(),
      HasSubstr("calibration/fiducials.csv:2:"));
}

// What the tables allow and the programs' reader does not.
TEST_F(FilmMessageTest, WhatTheReaderObjectsToIsTold) {
  folder_.Write("calibration/film.json",
                "{\"focal_mm\": 60,\n \"fiducials\": [{\"mark\": \"1\", \"x_mm\": \"a\"}]}");
  Reopen();
  EXPECT_THAT(Message()["faults"][0]["text"].asString(), HasSubstr("film.json:2:"));
  folder_.Write("calibration/film.json", "{\"focal_mm\": 60, \"transformation\": \"helmert\"}");
  Reopen();
  EXPECT_THAT(Message()["faults"][0]["text"].asString(),
              HasSubstr("expected affine or projective"));
}

TEST_F(FilmMessageTest, WhatNoReaderTakesIsRefused) {
  const std::string nan = R"({"mark": "1", "x_mm": "nan", "y_mm": 2})";
  EXPECT_EQ(Put("film_marks", nan).refused.text(), "film_marks: x_mm is no number");
  EXPECT_EQ(Put("film", R"({"focal_mm": 0})").refused.text(), "film: focal_mm is not more than 0");
  EXPECT_THAT(Put("film", R"({"focal_mm": 9, "distortion": [[10, 0], [5, 0]]})").refused.text(),
              HasSubstr("radii rising"));
  EXPECT_THAT(Put("film", R"({"focal_mm": 9, "transformation": "helmert"})").refused.text(),
              HasSubstr("expected affine or projective"));
  EXPECT_THAT(
      Put("fiducials", R"({"mark": "1", "x_mm": 1, "y_mm": 2, "photo": "Z", "x": 1, "y": 2})")
          .refused.text(),
      HasSubstr("Z"));
}

TEST_F(FilmMessageTest, MillimetresThatDifferFromTheCertificateAreTold) {
  TypeCertificate();
  Place("1", -28.5, -28);
  EXPECT_EQ(Message()["faults"][0]["text"],
            "mark 1 of A has other millimetres than the certificate");
}

TEST_F(FilmMessageTest, ACameraBesideItIsRefused) {
  EXPECT_TRUE(RefusalOfFilm(site_).empty());
  folder_.Write("calibration/camera.cameramodel", "");
  EXPECT_THAT(RefusalOfFilm(site_).text(),
              HasSubstr("calibration/camera.cameramodel is of another camera"));
}

}  // namespace
}  // namespace insitu
