// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/convert.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <sstream>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/photo/photograph.h"
#include "renderer/building/shown_environment.h"
#include "renderer/convert_report.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/renderer/dxf/dxf_text.h"
#include "tests/renderer/formats/model_texts.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

const char kMaterials[] = R"({
 "layers": {
  "WALL": {"diffuse_rgb": [0.5, 0.4, 0.3], "diffuse_weight": 0.8, "specular": "none",
           "specular_weight": 0, "ior": null, "roughness": null},
  "GLASS": {"diffuse_rgb": [0.03, 0.03, 0.04],
            "specular": "fresnel",
            "specular_weight": 0.9,
            "ior": 1.5,
            "roughness": 0.0}
 }
})";

std::string Replaced(std::string text, const std::string& what, const std::string& with) {
  return text.replace(text.find(what), what.size(), with);
}

class Convert : public testing::Test {
 protected:
  void Write(const std::string& name, const std::string& content) {
    folder_.Write("building/" + name, content);
  }
  Conversion Converted() const {
    const SitePaths site{folder_.path()};
    Conversion conversion = ConvertBuilding(site);
    RequireSurface(site, conversion);
    return conversion;
  }
  std::string Complaint() const {
    try {
      Converted();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  // A building of one wall and one pane, with these materials.
  std::string ComplaintAbout(const std::string& materials) {
    Write("a.dxf", DrawingText(UnitSquare("WALL") + UnitSquare("GLASS")));
    Write("materials.json", materials);
    return Complaint();
  }

  ScratchFolder folder_;
};

TEST_F(Convert, LayersGetTheirMaterials) {
  Write("a.dxf", DrawingText(UnitSquare("GLASS") + UnitSquare("WALL")));
  Write("materials.json", kMaterials);
  const Conversion conversion = Converted();
  const ArtificialEnvironment& building = conversion.environment;
  EXPECT_THAT(conversion.warnings, ElementsAre(HasSubstr("2 faces lie on others of another name")));
  ASSERT_EQ(building.materials.size(), 2u);
  EXPECT_THAT(building.material_of_triangle, ElementsAre(0, 0, 1, 1));
  EXPECT_EQ(building.materials[0].name, "GLASS");
  EXPECT_EQ(building.materials[0].diffuse_weight, 1);
  EXPECT_EQ(building.materials[0].specular->weight, 0.9);
  EXPECT_EQ(building.materials[0].specular->index, 1.5);
  EXPECT_EQ(building.materials[1].diffuse_rgb, Eigen::Vector3d(0.5, 0.4, 0.3));
  EXPECT_EQ(building.materials[1].diffuse_weight, 0.8);
  EXPECT_FALSE(building.materials[1].specular);
  EXPECT_TRUE(building.lights.empty());
}

const char kObjects[] = R"({"objects": [
 {"name": "ball", "material": "STEEL", "diffuse_rgb": [0.5, 0.5, 0.5],
  "sphere": {"center": [2, 3, 1.5], "radius_m": 0.5}},
 {"name": "sign", "layer": "WALL", "polygon": {"vertices": [[0, 0, 2], [2, 0, 2], [2, 0, 3], [0, 0, 3]],
  "holes": [[[0.5, 0, 2.25], [1, 0, 2.25], [1, 0, 2.75], [0.5, 0, 2.75]]]}}]})";

TEST_F(Convert, ObjectsTypedByHandAreAModelOfTheirOwn) {
  Write("objects.json", kObjects);
  Write("objects.dxf", DrawingText(UnitSquare("GLASS")));
  Write("materials.json", kMaterials);
  const Conversion conversion = Converted();
  ASSERT_EQ(conversion.models.size(), 2u);
  ASSERT_EQ(conversion.environment.spheres.size(), 1u);
  const EnvironmentSphere& ball = conversion.environment.spheres[0];
  EXPECT_EQ(ball.center, Vector3d(2, 3, 1.5));
  EXPECT_EQ(ball.radius, 0.5);
  EXPECT_EQ(conversion.environment.materials[ball.material].name, "STEEL");
  EXPECT_NEAR(conversion.elements.at("ball").area, std::numbers::pi, 1e-12);
  EXPECT_NEAR(conversion.elements.at("ball").volume.value(), std::numbers::pi / 6, 1e-12);
  EXPECT_NEAR(conversion.elements.at("WALL").area, 1.75, 1e-12);
  EXPECT_EQ(conversion.box.max(), Vector3d(2.5, 3.5, 3));
  EXPECT_THAT(conversion.BriefReport(), HasSubstr("1 spheres"));
  const fs::path report = folder_.path() / "report.json";
  WriteConvertReport(report, conversion);
  EXPECT_EQ(ReadJson(report)["spheres"], 1);
  EXPECT_NEAR(ReadJson(report)["elements"]["ball"]["area_m2"].asDouble(), std::numbers::pi, 1e-12);
}

TEST_F(Convert, ASphereShowsTheMeanOfItsTexture) {
  Write("objects.json", kObjects);
  WritePng(folder_.path() / "building/brick.png", Raster(2, 2), Encoding::kSrgb8);
  Write("materials.json", R"({"materials": {"STEEL": {"texture": "brick.png"}}})");
  EXPECT_THAT(Converted().warnings,
              Contains(HasSubstr("1 spheres of \"STEEL\" show the mean colour of its texture")));
}

// Once, where the other puts it, whichever is read first.
TEST_F(Convert, ADrawingThatAnotherRefersToIsNoModelOfItsOwn) {
  Write("grid.dxf", DrawingText(UnitSquare("WALL")));
  Write("house.dxf", DrawingText("0 INSERT\n 2 grid\n 10 50\n 20 0\n",
                                 "0 BLOCK\n 2 grid\n 70 4\n 1 C:\\cad\\grid.dwg\n 0 ENDBLK\n"));
  const Conversion conversion = Converted();
  ASSERT_EQ(conversion.models.size(), 1u);
  EXPECT_EQ(conversion.box.min(), Vector3d(50, 0, 0));
  EXPECT_EQ(conversion.triangles_of_layer.at("grid|WALL"), 2);
  EXPECT_THAT(conversion.warnings,
              Contains(HasSubstr("grid.dxf: read where house.dxf refers to it (XREF)")));
}

// Three storeys of slabs, y up.
TEST_F(Convert, FloorsAlongYAreNoticed) {
  std::string obj;
  for (const char* level : {"0", "0.3", "3", "3.3", "6", "6.3"}) {
    for (const char* place : {"0 9", "0 0", "12 0", "12 9"}) {  // x, z
      std::istringstream words(place);
      std::string x, z;
      words >> x >> z;
      obj.append("v ").append(x).append(" ").append(level).append(" ").append(z).append("\n");
    }
    obj += "f -4 -3 -2 -1\n";
  }
  Write("house.obj", obj);
  EXPECT_THAT(Converted().warnings, Contains(HasSubstr("look along y, as floors do")));
}

TEST_F(Convert, ASphereIsPlacedAndHiddenAsFacesAre) {
  Write("objects.json", kObjects);
  Write("placement.json", R"({"scale": 2, "rotation_deg": 90, "shift": [100, 0, 1]})");
  const Conversion conversion = Converted();
  const EnvironmentSphere& ball = conversion.environment.spheres.at(0);
  EXPECT_LT((ball.center - Vector3d(94, 4, 4)).norm(), 1e-12);
  EXPECT_NEAR(ball.radius, 1, 1e-12);
  Write("materials.json", R"({"materials": {"STEEL": {"hidden": true}}})");
  EXPECT_TRUE(Converted().environment.spheres.empty());
}

TEST_F(Convert, DrawingsJoinInOrderOfTheirNames) {
  Write("b.DXF", DrawingText(UnitSquare("WALL", "1") + UnitSquare("WALL")));
  Write("a.dxf", DrawingText(UnitSquare("GLASS") + UnitSquare("WALL")));
  Write("a.txt", "not a drawing");
  Write("materials.json", kMaterials);
  const Conversion conversion = Converted();
  const ArtificialEnvironment& building = conversion.environment;
  EXPECT_THAT(building.material_of_triangle, ElementsAre(0, 0, 1, 1, 1, 1));
  EXPECT_EQ(conversion.solids.duplicate_faces, 2);  // the wall that is in both
  EXPECT_EQ(building.vertices.size(), 8u);
  EXPECT_EQ(building.triangles[4].minCoeff(), 4);
}

TEST_F(Convert, BareMirrorHasNoIndex) {
  Write("a.dxf", DrawingText(UnitSquare("M")));
  Write("materials.json",
        R"({"layers": {"M": {"diffuse_rgb": [0, 0, 0], "specular": "mirror", "ior": null}}})");
  const SurfaceMaterial mirror = Converted().environment.materials.at(0);
  EXPECT_EQ(mirror.specular->weight, 1);
  EXPECT_EQ(mirror.specular->index, std::nullopt);
}

TEST_F(Convert, Lights) {
  Write("a.dxf", DrawingText(UnitSquare("WALL")));
  Write("materials.json", kMaterials);
  Write("lights.json", R"({"lights": [
    {"name": "lamp", "position": [1, 2, 3], "intensity_rgb": [4, 5, 6]}]})");
  const std::vector<PointLight> lights = Converted().environment.lights;
  ASSERT_EQ(lights.size(), 1u);
  EXPECT_EQ(lights[0].name, "lamp");
  EXPECT_EQ(lights[0].position, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(lights[0].intensity_rgb, Eigen::Vector3d(4, 5, 6));
  Write("lights.json",
        "{\"lights\": [\n{\"name\": \"lamp\", \"position\": [1, 2, 3],\n"
        "\"intensity_rgb\": [4, -5, 6]}]}");
  EXPECT_THAT(Complaint(), HasSubstr("lights.json:3: "));
  EXPECT_THAT(Complaint(), HasSubstr("is negative"));
}

TEST_F(Convert, WarnsOfWhatItLeavesOutOrGuesses) {
  Write("a.dxf", DxfText(EntitiesSection(UnitSquare("DOOR") + "0 LINE\n0 LINE\n0 3DSOLID\n" +
                                         "0 3DFACE\n10 0\n20 0\n11 1\n21 0\n12 2\n22 0\n") +
                         "0 EOF"));
  Write("materials.json", kMaterials);
  const Conversion conversion = Converted();
  EXPECT_THAT(
      conversion.warnings,
      ElementsAre(HasSubstr("a.dxf: names no unit"),
                  HasSubstr("left out: 1 3DSOLID (holds no ACIS body"),
                  HasSubstr("left out: 2 LINE"), HasSubstr("1 faces of no area"),
                  HasSubstr("materials.json: not listed, shown in mid grey: \"DOOR\""),
                  HasSubstr("\"GLASS\" is listed but"), HasSubstr("\"WALL\" is listed but")));
  EXPECT_EQ(conversion.environment.materials[0].diffuse_rgb, Eigen::Vector3d(0.5, 0.5, 0.5));
  for (const std::string& warning : conversion.warnings) {
    EXPECT_THAT(conversion.BriefReport(), HasSubstr("warning: " + warning));
  }
}

TEST_F(Convert, ReportNamesSizeAndPlace) {
  Write("a.dxf", DrawingText(UnitSquare("WALL")));
  Write("materials.json", kMaterials);
  EXPECT_THAT(Converted().BriefReport(),
              testing::AllOf(HasSubstr("2 triangles, 0 lights\n"),
                             HasSubstr("from (0.000, 0.000, 0.000) to (1.000, 1.000, 0.000) m"),
                             HasSubstr("WALL: 2 faces, 1.00 m2, open\n")));
}

TEST_F(Convert, TheTerminalListsTheLargestAlone) {
  std::ostringstream model;
  for (int i = 0; i < 40; ++i) {
    const int x = 3 * i, size = i + 1;
    model << "o part" << size << "\nusemtl m" << size << "\nv " << x << " 0 0\nv " << x << " "
          << size << " 0\nv " << x << " 0 1\nf -3 -2 -1\n";
  }
  Write("a.obj", model.str());
  const std::string report = Converted().BriefReport();
  EXPECT_THAT(report, HasSubstr(" m\n  part40: 1 faces, 20.00 m2, open\n  part39: "));
  EXPECT_THAT(report, HasSubstr("  part11: 1 faces, 5.50 m2, open\n  and 10 smaller ones"));
  EXPECT_THAT(report, HasSubstr("and 10 more"));
}

// The windows stand before their wall, the report's box is the architect's.
TEST_F(Convert, BoxIsThatOfTheModel) {
  Write("a.dxf", DrawingText(UnitSquare("WALL") +
                             "0 3DFACE\n8 GLASS\n10 0.2\n20 0.2\n30 0\n11 0.8\n21 0.2\n31 0\n"
                             "12 0.8\n22 0.7\n32 0\n13 0.2\n23 0.7\n33 0\n"));
  Write("materials.json", kMaterials);
  const Conversion conversion = Converted();
  EXPECT_THAT(conversion.warnings, ElementsAre(HasSubstr("2 faces are drawn on larger ones")));
  EXPECT_EQ(conversion.box.sizes(), Eigen::Vector3d(1, 1, 0));
  double highest = 0;
  for (const Eigen::Vector3d& v : conversion.environment.vertices)
    highest = std::max(highest, v.z());
  EXPECT_EQ(highest, 0.002);
}

TEST_F(Convert, NeedsADrawingWithSurfaces) {
  EXPECT_THAT(Complaint(), HasSubstr("building: no model, expected a DXF"));
  Write("materials.json", kMaterials);
  Write("a.dxf", DrawingText("0 LINE\n"));
  EXPECT_THAT(Complaint(), HasSubstr("a.dxf: has no surface to show"));
  EXPECT_THAT(Complaint(), HasSubstr("it has 1 LINE"));
}

TEST_F(Convert, BadMaterials) {
  ASSERT_EQ(ComplaintAbout(kMaterials), "");
  const auto complaint = [&](const std::string& what, const std::string& with) {
    return ComplaintAbout(Replaced(kMaterials, what, with));
  };
  EXPECT_THAT(complaint("0.4, 0.3]", "1.4, 0.3]"), HasSubstr("materials.json:3: "));
  EXPECT_THAT(complaint("0.4, 0.3]", "-0.1, 0.3]"), HasSubstr("is no albedo"));
  EXPECT_THAT(complaint("\"diffuse_weight\": 0.8", "\"diffuse_weight\": 1.8"),
              HasSubstr("is out of range, expected 0 to 1"));
  EXPECT_THAT(complaint("\"fresnel\"", "\"shiny\""), HasSubstr("materials.json:6: "));
  EXPECT_THAT(complaint("\"fresnel\"", "\"shiny\""),
              HasSubstr("expected \"none\", \"fresnel\", \"mirror\" or \"conductor\""));
  EXPECT_THAT(complaint("0.9", "-0.9"), HasSubstr("materials.json:7: "));
  EXPECT_THAT(complaint("1.5", "0.9"), HasSubstr("materials.json:8: "));
  EXPECT_THAT(complaint("1.5", "null"), HasSubstr("\"ior\" is missing"));
  EXPECT_THAT(complaint("0.0}", "1.2}"), HasSubstr("materials.json:9: "));
  EXPECT_THAT(complaint("\"layers\"", "\"layer\""), HasSubstr("\"layers\" is missing"));
  EXPECT_THAT(complaint("{\n", ""), HasSubstr("materials.json:"));
}

// What today's renderer cannot show is kept, and said.
TEST_F(Convert, RoughGlassAndTextureAreKept) {
  Write("a.dxf", DrawingText(UnitSquare("WALL") + UnitSquare("GLASS")));
  WritePng(folder_.path() / "building/brick.png", Raster(2, 2), Encoding::kSrgb8);
  Write("materials.json", Replaced(Replaced(kMaterials, "0.0}", "0.2, \"transmission\": 0.9}"),
                                   "\"roughness\": null", "\"texture\": \"brick.png\""));
  const ArtificialEnvironment building = Converted().environment;
  EXPECT_EQ(building.materials[1].specular->roughness.slope, 0.2);
  EXPECT_EQ(building.materials[1].glass->weight, 0.9);
  EXPECT_EQ(building.materials[0].texture, "brick.png");
  EXPECT_THAT(NotShown(building), ElementsAre(HasSubstr("texture")));
}

TEST_F(Convert, ASizeThatNoBuildingHasIsRefused) {
  Write("house.obj", "v 0 0 0\nv 1e-5 0 0\nv 0 1e-5 0\nf 1 2 3\n");
  EXPECT_THAT(Complaint(), HasSubstr("expected 1 mm to 100 km"));
}

TEST_F(Convert, MissingTextureCostsOnlyItself) {
  Write("house.obj", kObj);
  Write("house.mtl", "newmtl BRICK\nKd 1 1 1\nmap_Kd brick.png\n");
  const Conversion conversion = Converted();
  EXPECT_EQ(conversion.environment.triangles.size(), 3u);
  EXPECT_THAT(conversion.warnings, Contains(AllOf(HasSubstr("house.mtl:3: names the texture"),
                                                  HasSubstr("brick.png, which is not there"))));
}

TEST_F(Convert, FilesThatNobodyReadsAreNamed) {
  Write("house.obj", kObj);
  Write("house.mtl", "newmtl BRICK\nKd 1 1 1\nmap_Kd C:\\x\\brick.png\n");
  Write("maps/brick.png", "no image");
  Write("notes.txt", "");
  Write("unused.png", "");
  Write("listed.png", "");
  Write("plan.pdf", "%PDF");
  Write("README.md", "");
  Write("old/a.txt", "");
  Write("materials.json",
        R"({"layers": {}, "materials": {"x": {"comment": "listed.png", "hidden": true}}})");
  const Conversion conversion = Converted();
  EXPECT_THAT(conversion.warnings,
              AllOf(Contains(HasSubstr("its kind is not known: notes.txt, old/, unused.png")),
                    Contains(HasSubstr("plan.pdf: not read: it is a PDF document")),
                    Contains(AllOf(HasSubstr("brick.png"), HasSubstr("left out of \"BRICK\"")))));
}

// As GLB and glTF mostly come: a red image inside the file.
TEST_F(Convert, TexturesInsideTheModelBecomeFiles) {
  std::string text = kGltf;
  const auto replace = [&text](const std::string& what, const std::string& with) {
    text.replace(text.find(what), what.size(), with);
  };
  replace("\"baseColorFactor\": [0.5, 0, 0, 1]", "\"baseColorTexture\": {\"index\": 0}");
  replace("\"meshes\"", R"("textures": [{"source": 0}], "images": [{"mimeType": "image/png", "uri":
      "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/pLvAAAAAElFTkSuQmCC"
      }], "meshes")");
  Write("wall.gltf", text);
  const SurfaceMaterial material = Converted().environment.materials.at(0);
  EXPECT_EQ(material.texture, "../work/building_textures/wall.gltf_0.png");
  EXPECT_TRUE(std::filesystem::is_regular_file(folder_.path() / "building" / material.texture));
  EXPECT_NEAR((material.diffuse_rgb - Vector3d(1, 0, 0)).norm(), 0, 1e-6);
  replace("iVBORw0KGgo", "AAAAAAAAAAA");
  Write("wall.gltf", text);
  EXPECT_THAT(Converted().warnings, Contains(HasSubstr("neither PNG nor JPEG")));
}

TEST_F(Convert, GlassThatBoundsNoBodyIsTold) {
  Write("materials.json", R"({"layers": {"GLASS": {"diffuse_rgb": [0, 0, 0], "ior": 1.5,
    "specular": "fresnel", "transmission": 1, "solid": true}, "*": {"diffuse_rgb": [0, 0, 0]}}})");
  Write("a.dxf", DrawingText(UnitSquare("WALL") + UnitSquare("GLASS")));
  EXPECT_THAT(Converted().warnings, Contains(HasSubstr("\"GLASS\" is solid glass")));
  std::filesystem::remove(folder_.path() / "building/a.dxf");
  Write("b.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\ng GLASS\n"
        "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  EXPECT_THAT(Converted().warnings, testing::Not(Contains(HasSubstr("is solid glass"))));
}

}  // namespace
}  // namespace insitu
