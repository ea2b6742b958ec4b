// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/exchange/read_survey_file.h"

#include "tests/reconstruction/exchange/text_files.h"

namespace insitu {
namespace {

std::optional<Eigen::Vector2i> SizeOfPhoto(const std::string& photo) {
  if (photo == "none") return std::nullopt;
  return Eigen::Vector2i(4000, 3000);
}

SurveyFile Read(const std::filesystem::path& path) { return ReadSurveyFile(path, SizeOfPhoto); }

const char kOdm[] =
    "WGS84 UTM 32N\n"
    "# comment\n"
    "465000.5 5250000.25 410.125 1200.5 800.25 IMG_1.JPG tower\n"
    "465000.5 5250000.25 410.125 900 700 IMG_2.JPG tower\n"
    "465010 5250005 NaN 10 20 IMG_2.JPG flat\n";
const char kOdmUnnamed[] =
    "+proj=utm +zone=32 +ellps=WGS84 +towgs84=0,0,0 +units=m +no_defs\n"
    "1 2 3 10 20 a.jpg\n4 5 6 30 40 a.jpg\n1 2 3 50 60 b.jpg\n";
const char kJson[] =
    "{\"points\": [\n"
    " {\"id\": \"p\", \"position\": {\"latitude\": 47.5, \"longitude\": 8.25, \"altitude\": 400},\n"
    "  \"observations\": [{\"shot_id\": \"a.jpg\", \"projection\": [0.25, -0.125]},\n"
    "                     {\"shot_id\": \"none\", \"projection\": [0, 0]}]},\n"
    " {\"id\": \"tie\", \"observations\": []}]}\n";
const char kPix4dPoints[] =
    "GCP0,46.23456,6.56114,299.931,0.02,0.03\nGCP1,46.23,6.56,299,0.02,0.03\n";
const char kPix4dMarks[] = "IMG_1.JPG,GCP0,1000.5,2000.25,1\nIMG_2.JPG,1,3,4,0.5\n";
const char kMetashapeCsv[] =
    "#CoordinateSystem: LOCAL_CS[\"Local Coordinates (m)\",LOCAL_DATUM[\"Local Datum\",0],"
    "UNIT[\"metre\",1,AUTHORITY[\"EPSG\",\"9001\"]]]\n"
    "#Label,X/Easting,Y/Northing,Z/Altitude,Accuracy_X/"
    "Y_(m),Accuracy_Z_(m),Error_(m),X_error,Enable\n"
    "target 1,1.5,2.5,3.5,0.01,0.02,9,9,1\n"
    "target 2,4,5,6,0.01,0.02,9,9,0\n"
    "#Total error,1,1,1\n";
const char kMetashapeXml[] =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<document version=\"1.5.0\">\n"
    "  <chunk label=\"Chunk 1\" enabled=\"true\">\n"
    "    <cameras next_id=\"2\"><camera id=\"0\" label=\"IMG_1\"/><group id=\"0\">\n"
    "      <camera id=\"1\" label=\"IMG_2.JPG\"/></group></cameras>\n"
    "    <markers next_id=\"1\">\n"
    "      <marker id=\"0\" label=\"A\"><reference x=\"10\" y=\"20\" z=\"30\" sxy=\"0.01\" "
    "sz=\"0.02\" enabled=\"true\"/></marker>\n"
    "    </markers>\n"
    "    <frames next_id=\"1\"><frame id=\"0\"><markers><marker marker_id=\"0\">\n"
    "      <location camera_id=\"0\" pinned=\"true\" x=\"100.5\" y=\"200.5\"/>\n"
    "      <location camera_id=\"1\" pinned=\"false\" x=\"1\" y=\"2\"/>\n"
    "    </marker></markers></frame></frames>\n"
    "  </chunk>\n"
    "</document>\n";
const char kMicMacPoints[] =
    "<?xml version=\"1.0\" ?>\n<DicoAppuisFlottant>\n"
    "<OneAppuisDAF><Pt>0.5 -3.75 2.5</Pt><NamePt>Stone-1</NamePt>\n"
    "<Incertitude>1 1 1</Incertitude></OneAppuisDAF>\n"
    "<OneAppuisDAF><Pt>1 2 3</Pt><NamePt>Stone-2</NamePt>\n"
    "<Incertitude>0.01 0.01 0.02</Incertitude></OneAppuisDAF>\n</DicoAppuisFlottant>\n";
const char kMicMacMarks[] =
    "<SetOfMesureAppuisFlottants><MesureAppuiFlottant1Im><NameIm>IMG_1.JPG</NameIm>\n"
    "<OneMesureAF1I><NamePt>Stone-1</NamePt><PtIm>452.25 808.5</PtIm></OneMesureAF1I>\n"
    "</MesureAppuiFlottant1Im></SetOfMesureAppuisFlottants>\n";
const char kMmviiPoints[] =
    "<Root><Type>\"MMVII_Serialization\"</Type><Data><SetGCP><Measures>\n"
    "<el><Name>\"Stone-1\"</Name><Pt>0.5 -3.75 2.5</Pt>\n"
    "<__Opt__Sigma2>0.0001 0 0 0.0001 0 0.0004</__Opt__Sigma2></el>\n"
    "</Measures></SetGCP></Data></Root>\n";
const char kMmviiMarks[] =
    "<Root><Data><SetMesIm><NameIm>\"IMG_1.JPG\"</NameIm><Measures>\n"
    "<el><Name>\"Stone-1\"</Name><Pt>452.25 808.5</Pt><Sigma2>0.25 0 0.25</Sigma2></el>\n"
    "</Measures></SetMesIm></Data></Root>\n";

class SurveyFileRead : public TextFiles {};

TEST_F(SurveyFileRead, OdmListWithNames) {
  const SurveyFile file = Read(Write("gcp_list.txt", kOdm));
  EXPECT_EQ(file.crs, "WGS84 UTM 32N");
  ASSERT_EQ(file.points.size(), 1u);
  EXPECT_EQ(file.points[0].name, "tower");
  EXPECT_EQ(file.points[0].position, Eigen::Vector3d(465000.5, 5250000.25, 410.125));
  EXPECT_FALSE(file.points[0].sigma);
  ASSERT_EQ(file.marks.size(), 2u);  // that without height is left out
  EXPECT_EQ(file.marks[1].photo, "IMG_2");
  EXPECT_EQ(file.marks[0].pixel, Eigen::Vector2d(1200.5, 800.25));  // ODM's pixels are ours
  EXPECT_EQ(file.marks[0].place.line, 3);
  EXPECT_EQ(file.remarks.size(), 1u);
}

TEST_F(SurveyFileRead, OdmListWithoutNamesGroupsByPlace) {
  const SurveyFile file = Read(Write("gcp_list.txt", kOdmUnnamed));
  ASSERT_EQ(file.points.size(), 2u);
  ASSERT_EQ(file.marks.size(), 3u);
  EXPECT_EQ(file.marks[0].point, file.marks[2].point);
  EXPECT_NE(file.marks[0].point, file.marks[1].point);
}

TEST_F(SurveyFileRead, OpenSfmJsonCountsFromTheMiddle) {
  const SurveyFile file = Read(Write("ground_control_points.json", kJson));
  ASSERT_EQ(file.points.size(), 1u);
  EXPECT_EQ(file.points[0].position, Eigen::Vector3d(8.25, 47.5, 400));
  ASSERT_EQ(file.marks.size(), 1u);
  EXPECT_EQ(file.marks[0].pixel, Eigen::Vector2d(1999.5 + 1000, 1499.5 - 500));
  EXPECT_EQ(file.remarks.size(), 1u);
}

TEST_F(SurveyFileRead, Pix4dPointsKeepTheOrderOfTheirSystem) {
  const SurveyFile file = Read(Write("gcp.csv", kPix4dPoints));
  EXPECT_TRUE(file.has_axes_of_crs);
  ASSERT_EQ(file.points.size(), 2u);
  EXPECT_EQ(*file.points[0].sigma, Eigen::Vector3d(0.02, 0.02, 0.03));
}

TEST_F(SurveyFileRead, Pix4dMarksCountFromTheCorner) {
  const SurveyFile file = Read(Write("marks.csv", kPix4dMarks));
  ASSERT_EQ(file.marks.size(), 2u);
  EXPECT_EQ(file.marks[0].pixel, Eigen::Vector2d(1000, 1999.75));
  EXPECT_EQ(file.marks[1].point, "1");
}

TEST_F(SurveyFileRead, MetashapeTable) {
  const SurveyFile file = Read(Write("reference.csv", kMetashapeCsv));
  ASSERT_TRUE(file.crs);
  EXPECT_TRUE(file.crs->starts_with("LOCAL_CS"));
  ASSERT_EQ(file.points.size(), 2u);
  EXPECT_EQ(file.points[0].name, "target 1");
  EXPECT_EQ(file.points[0].position, Eigen::Vector3d(1.5, 2.5, 3.5));
  ASSERT_TRUE(file.points[0].sigma);
  EXPECT_EQ(*file.points[0].sigma, Eigen::Vector3d(0.01, 0.01, 0.02));
  EXPECT_EQ(file.points[1].role, ControlRole::kCheck);
}

TEST_F(SurveyFileRead, MetashapeTableWithOneAccuracy) {
  const SurveyFile file = Read(Write("reference.csv",
                                     "# CoordinateSystem: LOCAL_CS[\"Local Coordinates (m)\"]\n"
                                     "#Label,Enable,X,Y,Z,Accuracy_X/Y/Z_(m),X_error,X_est,X_var\n"
                                     "p,1,1.5,2.5,3.5,0.01,9,9,9\nq,1,4,5,6,0.01/0.02/0.03,9,9,9\n"
                                     "r,1,7,8,9,0.01/0.03,9,9,9\n"));
  ASSERT_TRUE(file.crs);
  ASSERT_EQ(file.points.size(), 3u);
  EXPECT_EQ(file.points[0].position, Eigen::Vector3d(1.5, 2.5, 3.5));
  EXPECT_EQ(file.points[0].sigma, Eigen::Vector3d(0.01, 0.01, 0.01));
  EXPECT_EQ(file.points[1].sigma, Eigen::Vector3d(0.01, 0.02, 0.03));
  EXPECT_EQ(file.points[2].sigma, Eigen::Vector3d(0.01, 0.01, 0.03));
}

TEST_F(SurveyFileRead, MetashapeXmlTakesPinnedProjectionsOnly) {
  const SurveyFile file = Read(Write("markers.xml", kMetashapeXml));
  ASSERT_EQ(file.points.size(), 1u);
  ASSERT_TRUE(file.points[0].sigma);
  EXPECT_EQ(*file.points[0].sigma, Eigen::Vector3d(0.01, 0.01, 0.02));
  ASSERT_EQ(file.marks.size(), 1u);
  EXPECT_EQ(file.marks[0].photo, "IMG_1");
  EXPECT_EQ(file.marks[0].pixel, Eigen::Vector2d(100, 200));  // from (0.5, 0.5)
  ASSERT_EQ(file.remarks.size(), 1u);
  EXPECT_NE(file.remarks[0].text().find("not pinned"), std::string::npos);
}

TEST_F(SurveyFileRead, MicMacXml) {
  const SurveyFile points = Read(Write("points.xml", kMicMacPoints));
  ASSERT_EQ(points.points.size(), 2u);
  EXPECT_FALSE(points.points[0].sigma);  // 1 1 1 is what MicMac writes for nothing stated
  EXPECT_EQ(*points.points[1].sigma, Eigen::Vector3d(0.01, 0.01, 0.02));
  const SurveyFile marks = Read(Write("marks.xml", kMicMacMarks));
  ASSERT_EQ(marks.marks.size(), 1u);
  EXPECT_EQ(marks.marks[0].pixel, Eigen::Vector2d(452.25, 808.5));
  const std::string text = kMicMacPoints;
  const std::string wrapped = "<Global>" + text.substr(text.find('\n')) + "</Global>";
  EXPECT_EQ(Read(Write("global.xml", wrapped)).points.size(), 2u);
}

TEST_F(SurveyFileRead, MmviiXmlHasVariances) {
  const SurveyFile points = Read(Write("points.xml", kMmviiPoints));
  ASSERT_EQ(points.points.size(), 1u);
  EXPECT_EQ(points.points[0].name, "Stone-1");
  EXPECT_NEAR((*points.points[0].sigma - Eigen::Vector3d(0.01, 0.01, 0.02)).norm(), 0, 1e-15);
  const SurveyFile marks = Read(Write("marks.xml", kMmviiMarks));
  ASSERT_EQ(marks.marks.size(), 1u);
  EXPECT_EQ(marks.marks[0].sigma_px, 0.5);
}

TEST_F(SurveyFileRead, Lists) {
  const SurveyFile jag3d = Read(Write("points.txt", "p1 1.5 2.5 3.5\n12 4 5 6 0.01 0.02 0.03\n"));
  ASSERT_EQ(jag3d.points.size(), 2u);
  EXPECT_EQ(*jag3d.points[1].sigma, Eigen::Vector3d(0.01, 0.02, 0.03));
  const SurveyFile colmap = Read(Write("centers.txt", "IMG_1.JPG 1 2 3\n"));
  EXPECT_TRUE(colmap.points.empty());
  ASSERT_EQ(colmap.centers.size(), 1u);
  EXPECT_EQ(colmap.centers[0].name, "IMG_1");
  const SurveyFile micmac = Read(Write("marks.txt", "p1 IMG_1.JPG 10 20\n"));
  ASSERT_EQ(micmac.marks.size(), 1u);
  EXPECT_EQ(micmac.marks[0].point, "p1");
}

TEST_F(SurveyFileRead, TablesWithHeader) {
  const SurveyFile points =
      Read(Write("editor.csv", "GCP Label,Northing,Easting,Elevation\ng1,20,10,30\n"));
  ASSERT_EQ(points.points.size(), 1u);
  EXPECT_EQ(points.points[0].position, Eigen::Vector3d(10, 20, 30));
  const SurveyFile marks =
      Read(Write("marks.csv", "image_name;gcp_name;image_u;image_v\nIMG_1.JPG;g1;1.5;2.5\n"));
  ASSERT_EQ(marks.marks.size(), 1u);
  EXPECT_EQ(marks.marks[0].pixel, Eigen::Vector2d(1.5, 2.5));
  EXPECT_FALSE(marks.remarks.empty());
  const SurveyFile german =
      Read(Write("points.csv",
                 "Point;East;North;Height;sE;sN;sH\ng1;2600000,25;1200000,5;430;0,01;0,01;0,02\n"));
  ASSERT_EQ(german.points.size(), 1u);
  EXPECT_EQ(german.points[0].position, Eigen::Vector3d(2600000.25, 1200000.5, 430));
  EXPECT_EQ(german.points[0].sigma, Eigen::Vector3d(0.01, 0.01, 0.02));
}

const char kIor[] = "1 -999 -28.0 0.5 0.25 0 0 13\n0\n0 0\n0 0\n36.0 24.0 3600 2400\n";

TEST_F(SurveyFileRead, AiconTables) {
  Write("example.ior", kIor);
  const SurveyFile points = Read(Write("example.obc",
                                       "6 573.5 -49.25 -121.75 0.25 0.5 1 66 1 1 0\n"
                                       "7 1.5 2.5 3.5 0.25 0.5 1 66 0 1 0\n"));
  ASSERT_EQ(points.points.size(), 1u);  // the other is flagged
  EXPECT_NEAR((points.points[0].position - Eigen::Vector3d(0.5735, -0.04925, -0.12175)).norm(), 0,
              1e-15);
  EXPECT_NEAR(points.points[0].sigma->z(), 0.001, 1e-18);
  const SurveyFile marks = Read(Write("example.phc",
                                      "1 6 1.0 2.0 0 0 0 0 1 1 1\n"
                                      "1 7 1.0 2.0 0 0 0 0 1 0 1\n"));
  ASSERT_EQ(marks.marks.size(), 1u);
  EXPECT_NEAR((marks.marks[0].pixel - Eigen::Vector2d(1799.5 + 100, 1199.5 - 200)).norm(), 0, 1e-9);
}

TEST_F(SurveyFileRead, FaultsAreNamedWithTheirLine) {
  const auto expect = [&](const std::string& name, const std::string& content, int line,
                          const std::string& subject) {
    const std::filesystem::path path = Write(name, content);
    ExpectError([&] { Read(path); }, name, line, subject);
  };
  expect("empty.txt", "", 0, "empty");
  expect("prose.txt", "Dear surveyor,\nhere are the points.\n", 1, "no format that we know");
  expect("odm.txt", "EPSG:32632\n1 2 3 4 5 a.jpg\n1 2 x 4 5 a.jpg\n", 3, "\"x\"");
  expect("odm2.txt", "EPSG:32632\n1 2 3 4 5 a.jpg\n1 2 3 4 5\n", 3, "image's name");
  expect("odm3.txt", "EPSG:32632\n1 2 3 4 5 a.jpg p\n1 2 3 4 5 b.jpg q\n", 3,
         "stands at the place");
  expect("pix4d.csv", "p,1,2,3,0.01,0.01\nq,1,2,3,0,0.01\n", 2, "accuracy");
  expect("pix4d5.csv", "p,1,2,3\nq,1,2,3,4\n", 2, "5 values");
  expect("marks.csv", "a.jpg,p,1,2\na.jpg,p,1\n", 2, "y is missing");
  expect("table.csv", "name,x,y,z\np,1,2,inf\n", 2, "finite");
  expect("page.html", "<html><body>no</body></html>", 1, "no survey that we know");
  expect("cameras.xml", "<document><cameras/></document>", 1, "of DBAT the script");
  expect("accuracy.csv", "Label,X,Y,Z,Accuracy_X/Y/Z_(m)\np,1,2,3,0.1/x/0.1\n", 2, "\"x\"");
  expect("cut.xml", "<DicoAppuisFlottant>\n<OneAppuisDAF>", 2, "XML");
  expect("points.xml",
         "<DicoAppuisFlottant>\n<OneAppuisDAF><Pt>1 2</Pt><NamePt>p</NamePt></OneAppuisDAF>"
         "</DicoAppuisFlottant>",
         2, "2 numbers, expected 3");
  expect("points.json", "{\"points\": [\n{\"observations\": []}]}", 2, "id");
  expect("marks.phc", "1 6 1.0 2.0 0 0 0 0 1 1 1\n", 0, ".ior");
}

// Raw photographs too, which we do not read: their developed ones have the same name.
TEST_F(SurveyFileRead, PhotographsGoByTheirNameWithoutFoldersAndEnding) {
  const SurveyFile file = Read(Write("marks.csv", "a/IMG.DNG,p,1,2\nC:\\b\\c.d.TIFF,p,3,4\n"));
  ASSERT_EQ(file.marks.size(), 2u);
  EXPECT_EQ(file.marks[0].photo, "IMG");
  EXPECT_EQ(file.marks[1].photo, "c.d");
}

TEST_F(SurveyFileRead, NothingCrashesOnCutOrGarbledFiles) {
  Write("cut.ior", kIor);
  for (const char* content :
       {kOdm, kOdmUnnamed, kJson, kPix4dPoints, kPix4dMarks, kMetashapeCsv, kMetashapeXml,
        kMicMacPoints, kMicMacMarks, kMmviiPoints, kMmviiMarks}) {
    ExpectNoHarmWhenCut("cut.txt", content, Read);
  }
}

}  // namespace
}  // namespace insitu
