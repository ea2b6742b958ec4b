// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/site_cameras.h"

#include <gmock/gmock.h>

#include <exiv2/exiv2.hpp>

#include "calibration/calibration_report.h"
#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"
#include "calibration/lens/camera.h"
#include "calibration/photo/photograph.h"
#include "calibration/site_calibration.h"
#include "calibration/site_undistortion.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;

class SiteCameras : public testing::Test {
 protected:
  // A JPEG with EXIF, if it is to have any.
  fs::path AddPhoto(const fs::path& path, int width, int height, const std::string& model = "",
                    int focal_mm = 0, int focal_35mm = 0) {
    const fs::path file = folder_.path() / path;
    const fs::path plain = folder_.path() / "plain.png";
    fs::create_directories(file.parent_path());
    WritePng(plain, Raster(width, height), Encoding::kSrgb8);
    WriteJpeg(file, Raster(width, height), plain);
    fs::remove(plain);
    const auto image = Exiv2::ImageFactory::open(file.string());
    image->readMetadata();
    if (!model.empty()) image->exifData()["Exif.Image.Model"] = model;
    if (focal_mm > 0) image->exifData()["Exif.Photo.FocalLength"] = Exiv2::Rational(focal_mm, 1);
    if (focal_35mm > 0) {
      image->exifData()["Exif.Photo.FocalLengthIn35mmFilm"] = static_cast<uint16_t>(focal_35mm);
    }
    image->writeMetadata();
    return file;
  }
  void AddCamera(const std::string& name, int width, int height, double focal = 500) {
    WritePosedCamera(
        site_.boards() / name / "camera.cameramodel",
        {"", Camera::Pinhole(focal, focal, width / 2.0, height / 2.0, width, height), Rigid3()},
        "");
  }
  std::vector<std::string> Cameras() { return CamerasOfPhotos(site_, ListPhotographs(site_)); }
  ScratchFolder folder_;
  const SitePaths site_{folder_.path()};
};

TEST_F(SiteCameras, OneCameraHasNoName) {
  AddPhoto("photos/a.jpg", 64, 48);
  AddPhoto("photos/b.jpg", 64, 48);
  EXPECT_EQ(Cameras(), (std::vector<std::string>{"", ""}));
  AddCamera("", 64, 48);
  EXPECT_EQ(Cameras(), (std::vector<std::string>{"", ""}));
}

TEST_F(SiteCameras, SizeTellsThemApart) {
  AddCamera("wide", 64, 48);
  AddCamera("phone", 48, 64);
  AddPhoto("photos/a.jpg", 48, 64);
  AddPhoto("photos/b.jpg", 64, 48);
  EXPECT_EQ(Cameras(), (std::vector<std::string>{"phone", "wide"}));
  AddPhoto("photos/c.jpg", 80, 48);
  EXPECT_EQ(InputErrorOf([&] { Cameras(); }),
            (site_.photos() / "c.jpg").string() +
                ": its size, model and focal length fit none of the cameras phone, wide; expected "
                "\"cameras\": {\"c\": \"...\"} in " +
                site_.description().string());
}

// Zoom settings and models of the boards' own EXIF.
TEST_F(SiteCameras, ExifTellsThemApart) {
  AddPhoto("calibration/24mm/board_1.jpg", 64, 48, "X-T3", 24);
  AddPhoto("calibration/50mm/board_1.jpg", 64, 48, "X-T3", 50);
  AddPhoto("calibration/other/board_1.jpg", 64, 48, "D700", 50);
  AddPhoto("photos/a.jpg", 64, 48, "X-T3", 50);
  AddPhoto("photos/b.jpg", 64, 48, "D700", 50);
  EXPECT_EQ(Cameras(), (std::vector<std::string>{"50mm", "other"}));
  AddPhoto("photos/c.jpg", 64, 48);
  EXPECT_NE(InputErrorOf([&] { Cameras(); }).find("fit the cameras 24mm, 50mm, other"),
            std::string::npos);
  folder_.Write("site.json", R"({"cameras": {"c": "24mm"}})");
  EXPECT_EQ(Cameras(), (std::vector<std::string>{"50mm", "other", "24mm"}));
}

TEST_F(SiteCameras, SiteJsonMayErr) {
  AddCamera("wide", 64, 48);
  AddCamera("long", 64, 48);
  AddPhoto("photos/a.jpg", 64, 48);
  folder_.Write("site.json", R"({"cameras": {"a": "tele"}})");
  EXPECT_EQ(InputErrorOf([&] { Cameras(); }),
            site_.description().string() +
                ":1: \"cameras.a\" is \"tele\", expected a folder of calibration/: long, wide");
  folder_.Write("site.json", R"({"cameras": {"z": "wide"}})");
  EXPECT_EQ(InputErrorOf([&] { Cameras(); }),
            site_.description().string() +
                ":1: \"cameras.z\" is of a photo that is not in the folder photos");
}

TEST_F(SiteCameras, CameraHereAndInFolders) {
  AddCamera("", 64, 48);
  AddCamera("wide", 64, 48);
  EXPECT_NE(
      InputErrorOf([&] { ListCameraFolders(site_); }).find("expected each camera in a folder"),
      std::string::npos);
}

TEST_F(SiteCameras, TwoCameraFilesSideBySide) {
  folder_.Write("calibration/a.yml", "");
  folder_.Write("calibration/b.yml", "");
  EXPECT_EQ(InputErrorOf([&] { ListCameraFolders(site_); }),
            (site_.boards() / "b.yml").string() +
                ": is a second camera file beside a.yml, expected one a folder");
}

// Notes beside the boards are no camera; a camera beside them is, and says so.
TEST_F(SiteCameras, OtherFilesBesideBoards) {
  AddPhoto("calibration/board_1.png", 64, 48);
  folder_.Write("calibration/notes.json", R"({"photographer": "Anna"})");
  folder_.Write("calibration/settings.xml", "<settings/>");
  folder_.Write("calibration/tripod.yml", "height: 1.6\n");
  auto folders = ListCameraFolders(site_);
  ASSERT_EQ(folders.size(), 1u);
  EXPECT_EQ(folders[0].source, CameraSource::kBoards);
  folder_.Write("calibration/lens.yml",
                "image_width: 64\nimage_height: 48\ncamera_matrix:\n"
                "  data: [50, 0, 31.5, 0, 50, 23.5, 0, 0, 1]\n");
  folders = ListCameraFolders(site_);
  ASSERT_EQ(folders.size(), 1u);
  EXPECT_EQ(folders[0].file.filename(), "lens.yml");
  const CameraCalibration camera = CalibrateSite(site_).cameras.front();
  ASSERT_EQ(camera.findings.size(), 1u);
  EXPECT_EQ(camera.findings[0].severity, Severity::kNote);
  EXPECT_NE(camera.findings[0].reason.find("beside lens.yml are not used"), std::string::npos);
  EXPECT_EQ(JsonNode::Load(site_.calibration_report()).At("verdict").At("status").Text(), "pass");
}

TEST_F(SiteCameras, ALensAdjustedFromAnEarlierCalibrationGoes) {
  AddCamera("", 64, 48);
  EXPECT_EQ(CalibrateSite(site_).BriefReport().find("removed"), std::string::npos);
  folder_.Write("work/reconstruction/lenses/camera.cameramodel", "");
  EXPECT_NE(CalibrateSite(site_).BriefReport().find("is removed"), std::string::npos);
  EXPECT_FALSE(fs::exists(site_.adjusted_camera()));
}

TEST_F(SiteCameras, SeveralCamerasFromCalibrationToInputImages) {
  AddCamera("wide", 64, 48, 50);
  AddCamera("long", 64, 48, 90);
  AddPhoto("photos/a.jpg", 64, 48);
  AddPhoto("photos/b.jpg", 64, 48);
  folder_.Write("site.json", R"({"cameras": {"a": "wide", "b": "long"}})");
  EXPECT_EQ(CamerasOf(ListCameraFolders(site_)), (std::vector<std::string>{"long", "wide"}));
  EXPECT_EQ(CalibrateSite(site_).cameras.size(), 2u);
  EXPECT_EQ(ReadCamera(site_.camera("long")).focal_px(), 90);
  EXPECT_EQ(JsonNode::Load(site_.calibration_report("wide")).At("photos").Items()[0].Text(), "a");
  const SiteUndistortion result = UndistortSite(site_);
  EXPECT_EQ(result.photos, 2);
  EXPECT_NEAR(ReadCamera(site_.pinhole_camera("wide")).focal_px(), 50, 1);
  EXPECT_NEAR(ReadCamera(site_.pinhole_camera("long")).focal_px(), 90, 2);
  EXPECT_TRUE(fs::exists(site_.input_image("b")));
}

// ---- EXIF as a last resort -------------------------------------------------------------------

TEST_F(SiteCameras, ExifAloneIsNoCalibration) {
  EXPECT_EQ(CamerasOf(ListCameraFolders(site_)), std::vector<std::string>{""});
  AddPhoto("photos/a.jpg", 360, 240, "X-T3", 0, 36);
  const SiteCalibration calibration = CalibrateSite(site_);
  const CameraCalibration& camera = calibration.cameras.front();
  EXPECT_TRUE(camera.exif_focal_px);
  EXPECT_NEAR(camera.camera.focal_px(), 360, 1e-6);
  // Without distortion, but a model that self-calibration can give some.
  EXPECT_EQ(camera.camera.lens_model(), "LENSMODEL_OPENCV4");
  EXPECT_NEAR(camera.camera.Project({0.3, 0.2, 1})->x(), 0.3 * 360 + 179.5, 1e-9);
  ASSERT_EQ(camera.findings.size(), 1u);
  EXPECT_EQ(camera.findings[0].severity, Severity::kFail);
  EXPECT_NE(camera.BriefReport().find("NOT CALIBRATED"), std::string::npos);
  EXPECT_EQ(JsonNode::Load(site_.calibration_report()).At("verdict").At("status").Text(), "fail");
}

TEST_F(SiteCameras, ExifOfTwoCameras) {
  AddPhoto("photos/a.jpg", 360, 240, "X-T3", 0, 36);
  AddPhoto("photos/b.jpg", 360, 240, "X-T3", 0, 50);
  EXPECT_NE(InputErrorOf([&] { CalibrateSite(site_); }).find("EXIF tells other cameras"),
            std::string::npos);
}

// ---- scanned film ----------------------------------------------------------------------------

class ScannedFilm : public SiteCameras {
 protected:
  ScannedFilm() {
    AddPhoto("photos/west.jpg", 480, 480);
    folder_.Write("calibration/film.json",
                  R"({"focal_mm": 60, "distortion": [[20, 0.01], [45, 0.05]]})");
    WriteMarks(kWest);
  }
  void WriteMarks(const std::string& rows) {
    folder_.Write("calibration/fiducials.csv", "mark,x_mm,y_mm,photo,x,y\n" + rows);
  }
  // 8 px/mm.
  const std::string kWest =
      "1,-28,-28,west,16,463\n2,28,-28,west,464,463\n3,28,28,west,464,15\n4,-28,28,west,16,15\n";
};

TEST_F(ScannedFilm, EachScanHasItsCamera) {
  AddPhoto("photos/east.jpg", 500, 490);
  WriteMarks(kWest +
             "1,-28,-28,east,20,473\n2,28,-28,east,468,473\n3,28,28,east,468,25\n"
             "4,-28,28,east,20,25\n");
  EXPECT_EQ(Cameras(), (std::vector<std::string>{"east", "west"}));
  EXPECT_EQ(CamerasOf(ListCameraFolders(site_)), Cameras());
  const SiteCalibration calibration = CalibrateSite(site_);
  ASSERT_EQ(calibration.cameras.size(), 2u);
  EXPECT_NEAR(ReadCamera(site_.camera("west")).focal_px(), 480, 1);
  EXPECT_EQ(ReadCamera(site_.camera("east")).width(), 500);
  const JsonNode film = JsonNode::Load(site_.calibration_report("west")).At("film");
  EXPECT_EQ(film.At("fiducials").Items().size(), 4u);
  EXPECT_LT(film.At("sigma_px").Number(), 1e-9);
  EXPECT_FALSE(ReadIntrinsicsCovariance(site_, "west"));
  EXPECT_EQ(UndistortSite(site_).photos, 2);
}

TEST_F(ScannedFilm, MarksOfAnotherPhoto) {
  const std::string fiducials = (site_.boards() / "fiducials.csv").string();
  WriteMarks(
      "1,-28,-28,west,16,463\n2,28,-28,west,464,463\n3,28,28,west,464,15\n4,-28,28,west,16,900\n");
  EXPECT_EQ(InputErrorOf([&] { CalibrateSite(site_); }),
            fiducials +
                ": mark 4 of photo west lies at (16, 900), outside its 480x480 px; are "
                "these another photo's fiducials?");
  WriteMarks(
      "1,-28,-28,west,16,463\n2,28,-28,west,464,15\n3,28,28,west,464,463\n4,-28,28,west,16,15\n");
  EXPECT_NE(InputErrorOf([&] { CalibrateSite(site_); }).find("its marks do not fit"),
            std::string::npos);
  WriteMarks(kWest + "1,-28,-28,south,16,463\n");
  EXPECT_EQ(InputErrorOf([&] { CalibrateSite(site_); }),
            fiducials + ": photo south is not in the folder photos");
  AddPhoto("photos/south.jpg", 480, 480);
  WriteMarks(kWest);
  EXPECT_EQ(InputErrorOf([&] { CalibrateSite(site_); }),
            fiducials +
                ": has no marks of photo south, expected three or more of every scanned "
                "photo");
  fs::remove(site_.photos() / "south.jpg");
  WriteMarks(
      "1,-28,-28,west,464,463\n2,28,-28,west,16,463\n3,28,28,west,16,15\n4,-28,28,west,464,15\n");
  EXPECT_NE(InputErrorOf([&] { CalibrateSite(site_); }).find("is mirrored"), std::string::npos);
  WriteMarks("1,-28,-28,west,16,463\n2,28,-28,west,464,463\n");
  EXPECT_NE(
      InputErrorOf([&] { CalibrateSite(site_); }).find("has 2 marks, expected at least three"),
      std::string::npos);
}

TEST_F(SiteCameras, APanoramaIsRefused) {
  const fs::path photo = AddPhoto("photos/a.jpg", 40, 20);
  {
    Exiv2::XmpProperties::registerNs("http://ns.google.com/photos/1.0/panorama/", "GPano");
    const auto image = Exiv2::ImageFactory::open(photo.string());
    image->readMetadata();
    image->xmpData()["Xmp.GPano.ProjectionType"] = "equirectangular";
    image->writeMetadata();
  }
  EXPECT_EQ(InputErrorOf([&] { Cameras(); }).find(photo.string() + ": is a panorama (GPano: equi"),
            0u);
}

TEST_F(SiteCameras, TwoFocalLengthsUnderOneCameraFileAreTold) {
  AddCamera("", 40, 20);
  AddPhoto("photos/a.jpg", 40, 20, "", 30);
  AddPhoto("photos/b.jpg", 40, 20, "", 50);
  const auto findings = CalibrateSite(site_, {}).cameras.front().findings;
  const auto told = std::find_if(findings.begin(), findings.end(), [](const Finding& each) {
    return each.reason == "b.jpg was taken at 50.0 mm, a.jpg at 30.0 mm.";
  });
  ASSERT_NE(told, findings.end());
  EXPECT_EQ(told->severity, Severity::kFail);
}

constexpr char kImages[] =
    "# Image list\n"
    "7 1 0 0 0 0 0 0 12 shots/a b.jpg\n10 20 -1 30 40 -1 50 60 -1 70 80 -1\n"
    "8 1 0 0 0 0 0 0 3 shots/c.jpg\n\n9 1 0 0 0 0 0 0 4 shots/elsewhere.jpg\n\n";

// COLMAP's usual cameras.txt, of which the site has a part of the photographs.
TEST_F(SiteCameras, ColmapHasALensForEachPhotograph) {
  WriteWhole(site_.boards() / "cameras.txt",
             "3 PINHOLE 64 48 500 500 32 24\n4 PINHOLE 64 48 600 600 32 24\n"
             "12 PINHOLE 64 48 700 700 32 24\n");
  AddPhoto("photos/a b.jpg", 64, 48);
  AddPhoto("photos/c.jpg", 64, 48);
  EXPECT_THAT(InputErrorOf([&] { CalibrateSite(site_); }), testing::HasSubstr("images.txt beside"));
  WriteWhole(site_.boards() / "images.txt", kImages);
  EXPECT_EQ(CamerasOf(ListCameraFolders(site_)), (std::vector<std::string>{"12", "3"}));
  EXPECT_EQ(Cameras(), (std::vector<std::string>{"12", "3"}));
  CalibrateSite(site_);
  EXPECT_NEAR(ReadCamera(site_.camera("12")).intrinsics()[0], 700, 1e-9);
  EXPECT_NEAR(ReadCamera(site_.camera("3")).intrinsics()[0], 500, 1e-9);
  EXPECT_FALSE(fs::exists(site_.camera("4")));
}

TEST_F(SiteCameras, ColmapOfOtherPhotographsIsRefused) {
  WriteWhole(site_.boards() / "cameras.txt",
             "3 PINHOLE 64 48 500 500 32 24\n4 PINHOLE 64 48 600 600 32 24\n");
  WriteWhole(site_.boards() / "images.txt", kImages);
  AddPhoto("photos/x.jpg", 64, 48);
  EXPECT_THAT(InputErrorOf([&] { CalibrateSite(site_); }),
              testing::HasSubstr("images.txt: names none of the photographs in photos/"));
}

}  // namespace
}  // namespace insitu
