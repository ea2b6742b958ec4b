// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/formats/ifc_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>

#include "calibration/files/error.h"
#include "renderer/formats/model_file.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/renderer/mesh/mesh_measures.h"

namespace insitu {
namespace {

using testing::HasSubstr;

// A box of 10 x 6 x 3 feet, whose wall is named in \X2\ code and has no owner history.
constexpr char kBox[] = R"(ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('a.ifc','',(''),(''),'','','');
FILE_SCHEMA(('IFC2X3'));
ENDSEC;
DATA;
#1=IFCCARTESIANPOINT((0.,0.,0.));
#2=IFCAXIS2PLACEMENT3D(#1,$,$);
#3=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-5,#2,$);
#4=IFCDIMENSIONALEXPONENTS(1,0,0,0,0,0,0);
#5=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);
#6=IFCMEASUREWITHUNIT(IFCRATIOMEASURE(0.3048),#5);
#7=IFCCONVERSIONBASEDUNIT(#4,.LENGTHUNIT.,'FOOT',#6);
#8=IFCUNITASSIGNMENT((#7));
#9=IFCPROJECT('0YvctVUKr0kugbFTf53O9L',$,'p',$,$,$,$,(#3),#8);
#10=IFCLOCALPLACEMENT($,#2);
#11=IFCCARTESIANPOINT((5.,3.));
#12=IFCAXIS2PLACEMENT2D(#11,$);
#13=IFCRECTANGLEPROFILEDEF(.AREA.,$,#12,10.,6.);
#14=IFCDIRECTION((0.,0.,1.));
#15=IFCEXTRUDEDAREASOLID(#13,#2,#14,3.);
#16=IFCSHAPEREPRESENTATION(#3,'Body','SweptSolid',(#15));
#17=IFCPRODUCTDEFINITIONSHAPE($,$,(#16));
#18=IFCWALL('1YvctVUKr0kugbFTf53O9L',$,'Au\X2\00DF\X0\enwand',$,$,#10,#17,$);
ENDSEC;
END-ISO-10303-21;
)";

TEST(IfcModel, UnitsNamesAndFacesAreTheFiles) {
  if (!WebIfcFolder()) GTEST_SKIP() << "web-ifc is not there: scripts/setup fetches it";
  const ScratchFolder folder;
  const Model model = ReadIfc(folder.Write("a.ifc", kBox), 60);
  constexpr double kFoot = 0.3048;
  EXPECT_NEAR(AreaOf(model.mesh), 216 * kFoot * kFoot, 1e-5);
  EXPECT_NEAR(VolumeOf(model.mesh), 180 * kFoot * kFoot * kFoot, 1e-5);
  Eigen::AlignedBox3d box;
  for (const auto& v : model.mesh.vertices) box.extend(v);
  EXPECT_NEAR((box.max() - kFoot * Eigen::Vector3d(10, 6, 3)).norm(), 0, 1e-6);
  ASSERT_EQ(model.mesh.surfaces.size(), 1u);
  EXPECT_EQ(model.mesh.surfaces[0].layer,
            "IfcWall_Au\xC3\x9F"
            "enwand");
  EXPECT_EQ(model.mesh.surfaces[0].rgb, std::nullopt);
  EXPECT_EQ(model.format, "IFC2X3");
}

TEST(IfcModel, WithoutItsReaderIsRefusedWithAWord) {
  const ScratchFolder folder;
  const char* set = getenv("INSITU_WEB_IFC");
  const std::string before = set == nullptr ? "" : set;
  setenv("INSITU_WEB_IFC", "/nowhere", 1);
  std::string complaint;
  try {
    ReadIfc(folder.Write("a.ifc", kBox), 60);
  } catch (const InputError& error) {
    complaint = error.what();
  }
  unsetenv("INSITU_WEB_IFC");
  if (!before.empty()) setenv("INSITU_WEB_IFC", before.c_str(), 1);  // for the tests that follow
  EXPECT_THAT(complaint, HasSubstr("web-ifc is missing"));
}

// Quantities may be in another unit than lengths: litres here.
TEST(IfcModel, StatedVolumesAreHeldAgainstTheFaces) {
  if (!WebIfcFolder()) GTEST_SKIP() << "web-ifc is not there: scripts/setup fetches it";
  const auto warnings = [](const std::string& litres) {
    const ScratchFolder folder;
    std::string text = kBox;
    text.insert(text.rfind("ENDSEC;"),
                "#90=IFCQUANTITYVOLUME('NetVolume',$,$," + litres +
                    ");\n#91=IFCELEMENTQUANTITY('a',$,'BaseQuantities',$,$,(#90));\n"
                    "#92=IFCRELDEFINESBYPROPERTIES('b',$,$,$,(#18),#91);\n"
                    "#93=IFCSIUNIT(*,.VOLUMEUNIT.,.DECI.,.CUBIC_METRE.);\n");
    return ReadIfc(folder.Write("a.ifc", text), 60).warnings;
  };
  EXPECT_TRUE(warnings("5097.").empty());
  const ScratchFolder folder;
  std::string text = kBox;  // as Revit says it
  text.insert(text.rfind("ENDSEC;"),
              "#90=IFCPROPERTYSINGLEVALUE('Volume',$,IFCVOLUMEMEASURE(6.),$);\n"
              "#91=IFCPROPERTYSET('a',$,'PSet_Revit_Dimensions',$,(#90));\n"
              "#92=IFCRELDEFINESBYPROPERTIES('b',$,$,$,(#18),#91);\n");
  EXPECT_THAT(ReadIfc(folder.Write("a.ifc", text), 60).warnings,
              testing::ElementsAre(HasSubstr("5.097 m3, stated 6.000")));
  const std::vector<std::string> off = warnings("6000.");
  ASSERT_EQ(off.size(), 1u);
  EXPECT_THAT(off[0], HasSubstr("1 of 1 elements that state their volume have another"));
  EXPECT_THAT(off[0], HasSubstr("5.097 m3, stated 6.000"));
}

// The box made a slab: 152 square feet in all, 60 of its larger side.
TEST(IfcModel, StatedAreasAreHeldAgainstTheFaces) {
  if (!WebIfcFolder()) GTEST_SKIP() << "web-ifc is not there: scripts/setup fetches it";
  const auto warnings = [](const std::string& name, const std::string& area) {
    const ScratchFolder folder;
    std::string text = kBox;
    text.replace(text.find("#14,3.)"), 7, "#14,1.)");
    text.insert(text.rfind("ENDSEC;"),
                "#90=IFCQUANTITYAREA('" + name + "',$,$," + area +
                    ");\n#91=IFCELEMENTQUANTITY('a',$,'BaseQuantities',$,$,(#90));\n"
                    "#92=IFCRELDEFINESBYPROPERTIES('b',$,$,$,(#18),#91);\n");
    return ReadIfc(folder.Write("a.ifc", text), 60).warnings;
  };
  EXPECT_TRUE(warnings("Total Surface Area", "14.121").empty());
  EXPECT_TRUE(warnings("NetSideArea", "5.574").empty());
  EXPECT_TRUE(warnings("Footprint Area", "1").empty());
  const std::vector<std::string> off = warnings("NetSurfaceArea", "25.");
  ASSERT_EQ(off.size(), 1u);
  EXPECT_THAT(off[0], HasSubstr("elements that state their surface area have another"));
  EXPECT_THAT(off[0], HasSubstr("14.121 m2, stated 25.000"));
  EXPECT_THAT(warnings("NetSideArea", "2.787"), testing::ElementsAre(HasSubstr("5.574 m2")));
}

TEST(IfcModel, NoUnitAndNamesInACodePage) {
  if (!WebIfcFolder()) GTEST_SKIP() << "web-ifc is not there: scripts/setup fetches it";
  const ScratchFolder folder;
  std::string text = kBox;
  EXPECT_EQ(ReadIfc(folder.Write("a.ifc", text), 60).metres_per_unit, 1);
  text.replace(text.find("IFCUNITASSIGNMENT((#7))"), 23, "IFCUNITASSIGNMENT(())");
  text.replace(text.find("Au\\X2\\00DF\\X0\\enwand"), 20,
               "Au\xDF"
               "enwand");
  for (const bool is_wide : {false, true}) {
    std::string wide = "\xFF\xFE";
    for (const char c : text) wide += {c, '\0'};
    const Model model = ReadModel(folder.Write("a.ifc", is_wide ? wide : text));
    EXPECT_EQ(model.metres_per_unit, std::nullopt);
    EXPECT_EQ(model.mesh.surfaces.at(0).layer,
              "IfcWall_Au\xC3\x9F"
              "enwand");
  }
}

// Storey and presentation layer are its block; materials of sets and of types have names.
TEST(IfcModel, StoreysLayersAndMaterialsNameElements) {
  if (!WebIfcFolder()) GTEST_SKIP() << "web-ifc is not there: scripts/setup fetches it";
  const ScratchFolder folder;
  std::string text = kBox;
  text.insert(text.rfind("ENDSEC;"),
              "#50=IFCBUILDINGSTOREY('s',$,'Erdgeschoss',$,$,#10,$,$,.ELEMENT.,0.);\n"
              "#51=IFCRELCONTAINEDINSPATIALSTRUCTURE('r',$,$,$,(#18),#50);\n"
              "#52=IFCPRESENTATIONLAYERASSIGNMENT('A-WALL',$,(#16),$);\n"
              "#53=IFCMATERIAL('Beton');\n#54=IFCMATERIALLAYER(#53,0.2,$);\n"
              "#55=IFCMATERIALLAYERSET((#54),$);\n#56=IFCMATERIALLAYERSETUSAGE(#55,.AXIS2.,."
              "POSITIVE.,0.);\n"
              "#57=IFCRELASSOCIATESMATERIAL('m',$,$,$,(#18),#56);\n");
  const Model model = ReadIfc(folder.Write("a.ifc", text), 60);
  ASSERT_EQ(model.mesh.surfaces.size(), 1u);
  EXPECT_EQ(model.mesh.surfaces[0].block, "Erdgeschoss/A-WALL");
  EXPECT_EQ(model.mesh.surfaces[0].material, "Beton");
}

// web-ifc has triangles without a place on images: each is named with its style.
TEST(IfcModel, ImagesOfStylesAreNamed) {
  if (!WebIfcFolder()) GTEST_SKIP() << "web-ifc is not there: scripts/setup fetches it";
  const ScratchFolder folder;
  const auto skipped = [&](const std::string& schema, const std::string& image) {
    std::string text = kBox;
    if (schema == "IFC4") {
      text.replace(text.find("IFC2X3"), 6, schema);
      text.replace(text.find("#17,$);"), 7, "#17,$,$);");
    }
    text.insert(
        text.rfind("ENDSEC;"),
        "#58=" + image +
            ";\n#59=IFCSURFACESTYLEWITHTEXTURES((#58));\n"
            "#60=IFCSURFACESTYLE('Ziegel',.BOTH.,(#59));\n#61=IFCTEXTURECOORDINATEGENERATOR(" +
            (schema == "IFC4" ? "(#58)," : "") + "'COORD',());\n");
    return ReadIfc(folder.Write("a.ifc", text), 60).skipped;
  };
  const std::string told =
      " of style \"Ziegel\": its colour alone is shown, give it the image in "
      "materials.json";
  const std::pair<std::string, std::string> place = {"IfcTextureCoordinateGenerator",
                                                     "where an image lies on faces: not read"};
  const auto old = skipped("IFC2X3", "IFCIMAGETEXTURE(.T.,.T.,.TEXTURE.,$,'brick.png')");
  EXPECT_EQ(old.at({"IfcImageTexture", "brick.png" + told}), 1);
  EXPECT_EQ(old.at(place), 1);
  const auto with_address =
      skipped("IFC4", "IFCIMAGETEXTURE(.T.,.T.,'TEXTURE',$,$,'maps/brick.png')");
  EXPECT_EQ(with_address.at({"IfcImageTexture", "maps/brick.png" + told}), 1);
  EXPECT_EQ(with_address.at(place), 1);
  const auto within = skipped("IFC4", "IFCBLOBTEXTURE(.T.,.T.,'TEXTURE',$,$,'PNG',\"0FF\")");
  EXPECT_EQ(within.at({"IfcBlobTexture", "an image within the file" + told}), 1);
}

// In IFC4, metres of a map and a model in feet.
TEST(IfcModel, MapConversionIsInMetres) {
  if (!WebIfcFolder()) GTEST_SKIP() << "web-ifc is not there: scripts/setup fetches it";
  const ScratchFolder folder;
  std::string text = kBox;
  text.replace(text.find("IFC2X3"), 6, "IFC4");
  text.replace(text.find("#17,$);"), 7, "#17,$,$);");
  text.insert(text.rfind("ENDSEC;"),
              "#60=IFCPROJECTEDCRS('EPSG:2056',$,$,$,$,$,#5);\n"
              "#61=IFCMAPCONVERSION(#3,#60,2600000.125,1200000.25,430.,0.,1.,0.3048);\n");
  const Model model = ReadIfc(folder.Write("a.ifc", text), 60);
  ASSERT_TRUE(model.map_from_model);
  EXPECT_EQ(model.map_from_model->translation, Eigen::Vector3d(2600000.125, 1200000.25, 430));
  EXPECT_NEAR(model.map_from_model->scale, 1, 1e-12);
  EXPECT_NEAR(
      (*model.map_from_model * Eigen::Vector3d(1, 0, 0) - model.map_from_model->translation).y(), 1,
      1e-9);
  EXPECT_THAT(model.warnings, testing::Contains(HasSubstr("\"map_conversion\": true")));
}

TEST(IfcModel, RigidOperationsAndSitesStatePlaces) {
  if (!WebIfcFolder()) GTEST_SKIP() << "web-ifc is not there: scripts/setup fetches it";
  const ScratchFolder folder;
  std::string text = kBox;
  text.insert(text.rfind("ENDSEC;"),
              "#50=IFCSITE('s',$,'Site',$,$,#10,$,$,.ELEMENT.,(47,22,30),(-8,-30,0),4.,$,$);\n");
  EXPECT_THAT(ReadIfc(folder.Write("a.ifc", text), 60).warnings,
              testing::Contains(HasSubstr("latitude 47.375000, longitude -8.500000")));
  text.replace(text.find("IFC2X3"), 6, "IFC4X3");
  text.replace(text.find("#17,$);"), 7, "#17,$,$);");
  text.insert(text.rfind("ENDSEC;"),
              "#60=IFCPROJECTEDCRS('EPSG:2056',$,$,$,$,$,#5);\n#61=IFCRIGIDOPERATION(#3,#60,"
              "IFCLENGTHMEASURE(2600000.125),IFCLENGTHMEASURE(1200000.25),430.);\n");
  const Model model = ReadIfc(folder.Write("a.ifc", text), 60);
  ASSERT_TRUE(model.map_from_model);
  EXPECT_EQ(model.map_from_model->translation, Eigen::Vector3d(2600000.125, 1200000.25, 430));
}

// What web-ifc alone takes for metres, or for nothing.
TEST(IfcModel, UnitsWithAnOffsetAndSmallLettersAreRead) {
  if (!WebIfcFolder()) GTEST_SKIP() << "web-ifc is not there: scripts/setup fetches it";
  const ScratchFolder folder;
  const double area = 216 * 0.3048 * 0.3048;
  std::string text = kBox;
  text.replace(text.find("IFCCONVERSIONBASEDUNIT(#4,.LENGTHUNIT.,'FOOT',#6)"), 49,
               "IFCCONVERSIONBASEDUNITWITHOFFSET(#4,.LENGTHUNIT.,'FOOT',#6,0.)");
  EXPECT_NEAR(AreaOf(ReadIfc(folder.Write("a.ifc", text), 60).mesh), area, 1e-5);
  text = kBox;
  text.replace(text.find("IFCWALL("), 8, "IfcWall /* it's */ (");
  text.replace(text.find("IFCRECTANGLEPROFILEDEF"), 22, "ifcRectangleProfileDef");
  const Model small = ReadIfc(folder.Write("a.ifc", text), 60);
  EXPECT_NEAR(AreaOf(small.mesh), area, 1e-5);
  EXPECT_EQ(small.mesh.surfaces.at(0).layer,
            "IfcWall_Au\xC3\x9F"
            "enwand");
  text = kBox;
  text.replace(text.find("IFCCONVERSIONBASEDUNIT(#4,.LENGTHUNIT.,'FOOT',#6)"), 49,
               "IFCCONTEXTDEPENDENTUNIT(#4,.LENGTHUNIT.,'brick')");
  const Model other = ReadIfc(folder.Write("a.ifc", text), 60);
  EXPECT_EQ(other.metres_per_unit, std::nullopt);
  EXPECT_THAT(other.warnings, testing::Contains(HasSubstr("called \"brick\" and not defined")));
}

// Faces of a solid that lack one, and what web-ifc itself complains of.
// A foot of twelve inches of 25.4 mm; directions of any length; a schema's full name.
TEST(IfcModel, WhatWebIfcTakesOtherwiseIsMended) {
  if (!WebIfcFolder()) GTEST_SKIP() << "web-ifc is not there: scripts/setup fetches it";
  const ScratchFolder folder;
  const double area = 216 * 0.3048 * 0.3048;
  std::string text = kBox;
  text.replace(text.find("#7=IFC"), 3, "#90=");
  text.insert(text.find("#8=IFC"),
              "#91=IFCMEASUREWITHUNIT(IFCRATIOMEASURE(12.),#92);\n"
              "#92=IFCCONVERSIONBASEDUNIT(#4,.LENGTHUNIT.,'INCH',#93);\n"
              "#93=IFCMEASUREWITHUNIT(IFCLENGTHMEASURE(25.4),#94);\n"
              "#94=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);\n"
              "#7=IFCCONVERSIONBASEDUNIT(#4,.LENGTHUNIT.,'FOOT',#91);\n");
  text.replace(text.find("(0.,0.,1.)"), 10, "(0.,0.,5.)");
  text.replace(text.find("'IFC2X3'"), 8, "'IFC2X3_TC1'");
  EXPECT_NEAR(AreaOf(ReadIfc(folder.Write("a.ifc", text), 60).mesh), area, 1e-5);
}

// A square whose corners are named by way of PnIndex.
TEST(IfcModel, FacesNamePointsByWayOfAnIndex) {
  if (!WebIfcFolder()) GTEST_SKIP() << "web-ifc is not there: scripts/setup fetches it";
  const ScratchFolder folder;
  std::string text = kBox;
  text.replace(text.find("IFC2X3"), 6, "IFC4");
  text.replace(text.find("#17,$);"), 7, "#17,$,$);");
  text.replace(text.find("#15=IFC"), 3, "#95");
  text.insert(
      text.find("#16=IFC"),
      "#96=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(4.,0.,0.),(4.,0.,4.),(9.,9.,9.),(0.,0.,4.)));\n"
      "#97=IFCINDEXEDPOLYGONALFACE((1,2,3,4));\n"
      "#15=IFCPOLYGONALFACESET(#96,.F.,(#97),(1,2,3,5));\n");
  EXPECT_NEAR(AreaOf(ReadIfc(folder.Write("a.ifc", text), 60).mesh), 16 * 0.3048 * 0.3048, 1e-5);
}

TEST(IfcModel, RoundThingsAreRound) {
  if (!WebIfcFolder()) GTEST_SKIP() << "web-ifc is not there: scripts/setup fetches it";
  const ScratchFolder folder;
  std::string text = kBox;
  text.replace(text.find("IFCRECTANGLEPROFILEDEF(.AREA.,$,#12,10.,6.)"), 43,
               "IFCCIRCLEPROFILEDEF(.AREA.,$,#12,2.)");
  const double volume = std::numbers::pi * 4 * 3 * std::pow(0.3048, 3);
  EXPECT_NEAR(VolumeOf(ReadIfc(folder.Write("a.ifc", text), 60).mesh), volume, 0.004 * volume);
}

TEST(IfcModel, OpenSolidsAndItsReadersLogAreTold) {
  if (!WebIfcFolder()) GTEST_SKIP() << "web-ifc is not there: scripts/setup fetches it";
  const ScratchFolder folder;
  std::string text = kBox;
  text.replace(text.find("'SweptSolid',(#15)"), 18, "'Brep',(#70)");
  text.insert(text.rfind("ENDSEC;"),
              "#70=IFCFACETEDBREP(#71);\n#71=IFCCLOSEDSHELL((#72));\n#72=IFCFACE((#73));\n"
              "#73=IFCFACEOUTERBOUND(#74,.T.);\n#74=IFCPOLYLOOP((#75,#76,#77));\n"
              "#75=IFCCARTESIANPOINT((0.,0.,0.));\n#76=IFCCARTESIANPOINT((9.,0.,0.));\n"
              "#77=IFCCARTESIANPOINT((0.,9.,0.));\n");
  EXPECT_THAT(
      ReadIfc(folder.Write("a.ifc", text), 60).warnings,
      testing::Contains(HasSubstr("1 of 1 elements that are solids in the file have open edges")));
  text = kBox;
  text.replace(text.find("SOLID(#13"), 9, "SOLID(#99");
  const Model broken = ReadIfc(folder.Write("a.ifc", text), 60);
  EXPECT_THAT(broken.warnings, testing::Contains(HasSubstr("web-ifc says")));
}

// A whole one as an item, placed in feet; one that is part of something else has facets.
TEST(IfcModel, SpheresStaySpheres) {
  if (!WebIfcFolder()) GTEST_SKIP() << "web-ifc is not there: scripts/setup fetches it";
  const ScratchFolder folder;
  std::string text = kBox;
  text.insert(text.rfind("ENDSEC;"),
              "#30=IFCCARTESIANPOINT((1.,2.,30.));\n#31=IFCAXIS2PLACEMENT3D(#30,$,$);\n"
              "#32=IFCSPHERE(#31,5.);\n#33=IFCCSGSOLID(#32);\n"
              "#34=IFCSHAPEREPRESENTATION(#3,'Body','CSG',(#33));\n"
              "#35=IFCPRODUCTDEFINITIONSHAPE($,$,(#34));\n"
              "#36=IFCBUILDINGELEMENTPROXY('2',$,'Ball',$,$,#10,#35,$,$);\n"
              "#37=IFCBOOLEANRESULT(.UNION.,#15,#32);\n#38=IFCCSGSOLID(#37);\n"
              "#39=IFCSHAPEREPRESENTATION(#3,'Body','CSG',(#38));\n"
              "#40=IFCPRODUCTDEFINITIONSHAPE($,$,(#39));\n"
              "#41=IFCBUILDINGELEMENTPROXY('3',$,'Both',$,$,#10,#40,$,$);\n");
  const Model model = ReadIfc(folder.Write("a.ifc", text), 60);
  ASSERT_EQ(model.mesh.spheres.size(), 1u);
  const ModelSphere& ball = model.mesh.spheres[0];
  EXPECT_LT((ball.center - 0.3048 * Eigen::Vector3d(1, 2, 30)).norm(), 1e-6);
  EXPECT_NEAR(ball.radius, 5 * 0.3048, 1e-6);
  EXPECT_EQ(model.mesh.surfaces[ball.surface].layer, "IfcBuildingElementProxy_Ball");
  EXPECT_GT(model.mesh.triangles.size(), 60u);
}

}  // namespace
}  // namespace insitu
