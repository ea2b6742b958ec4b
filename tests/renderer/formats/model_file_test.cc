// SPDX-License-Identifier: GPL-3.0-or-later
// Models in formats other than DXF, told apart by their content.
#include "renderer/formats/model_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <stdexcept>

#include "calibration/files/error.h"
#include "renderer/convert.h"
#include "renderer/formats/isolated.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/renderer/dxf/dxf_text.h"
#include "tests/renderer/mesh/mesh_measures.h"

namespace insitu {
namespace {

using Eigen::Vector3d;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

const char kObj[] = R"(# a house on a national grid
mtllib house.mtl
o house
v 2600000.123456 1200000.654321 430.5
v 2600004.123456 1200000.654321 430.5
v 2600004.123456 1200003.654321 430.5
v 2600000.123456 1200003.654321 430.5
vt 0 0
vt 1 0
vt 1 1
vn 0 0 1
usemtl BRICK
f 1/1/1 2/2/1 3/3/1 \
  4//1
g roof
f -4 -3 -2
l 1 2
)";

class ModelFile : public testing::Test {
 protected:
  Model Read(const std::string& name, const std::string& content) {
    return ReadModel(folder_.Write(name, content));
  }
  std::string Complaint(const std::string& name, const std::string& content) {
    try {
      Read(name, content);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  ScratchFolder folder_;
};

TEST_F(ModelFile, ObjKeepsEveryDigitAndItsNames) {
  folder_.Write("house.mtl", "newmtl BRICK\nKd 0.4 0.2 0.1\nd 0.5\nmap_Kd -s 1 1 1 brick.png\n");
  const Model model = Read("house.obj", kObj);
  EXPECT_EQ(model.mesh.vertices[0], Vector3d(2600000.123456, 1200000.654321, 430.5));
  EXPECT_EQ(model.mesh.triangles.size(), 3u);
  ASSERT_EQ(model.mesh.surfaces.size(), 2u);
  EXPECT_EQ(model.mesh.surfaces[0].layer, "house");
  EXPECT_EQ(model.mesh.surfaces[1].layer, "house/roof");
  EXPECT_EQ(model.mesh.surfaces[0].material, "BRICK");
  EXPECT_EQ(model.mesh.surfaces[0].rgb, Vector3d(0.4, 0.2, 0.1));
  EXPECT_EQ(model.mesh.surfaces[0].opacity, 0.5);
  EXPECT_EQ(model.mesh.surfaces[0].texture, "brick.png");
  EXPECT_THAT(model.mesh.surfaces[0].texture_place, HasSubstr("house.mtl:4"));
  EXPECT_EQ(model.mesh.corner_normals.size(), 9u);
  EXPECT_EQ(model.mesh.corner_uvs[2], Eigen::Vector2f(1, 1));
  EXPECT_EQ(model.entities.at("f"), 2);
  EXPECT_EQ(model.skipped.begin()->first.first, "l");
}

TEST_F(ModelFile, FaultyObj) {
  const auto complaint = [&](const std::string& line) {
    return Complaint("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + line + "\n");
  };
  EXPECT_EQ(complaint("f 1 2 3"), "");
  EXPECT_THAT(complaint("f 1 2 4"), HasSubstr("a.obj:4: a face names vertex 4, expected 1 to 3"));
  EXPECT_THAT(complaint("f 1 2 -4"), HasSubstr("names vertex -4"));
  EXPECT_THAT(complaint("f 1 2 0"), HasSubstr("names vertex 0"));
  EXPECT_THAT(complaint("f 1 2"), HasSubstr("at least 3 corners"));
  std::string long_face = "f";
  for (int i = 0; i < 5001; ++i) long_face += " 1 2";
  EXPECT_THAT(complaint(long_face), HasSubstr("a.obj:4: a face has over 10000 corners"));
  EXPECT_THAT(complaint("f 1/1 2/1 3/1"), HasSubstr("texture coordinate 1"));
  EXPECT_THAT(complaint("f 1 2 x"), HasSubstr("a.obj:4: \"x\""));
  EXPECT_THAT(complaint("v 1e300 0 0"), HasSubstr("at most 1e12"));
  EXPECT_THAT(complaint("v nan 0 0"), HasSubstr("a.obj:4: \"nan\""));
  EXPECT_THAT(complaint("v 1 2"), HasSubstr("the line ends"));
}

TEST_F(ModelFile, MissingTextureIsRefusedUnlessTheMaterialIsListed) {
  folder_.Write("building/house.obj", kObj);
  folder_.Write("building/house.mtl", "newmtl BRICK\nKd 1 1 1\nmap_Kd brick.png\n");
  const SitePaths site{folder_.path()};
  try {
    ConvertBuilding(site);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("house.mtl:3: names the texture"));
    EXPECT_THAT(error.what(), HasSubstr("brick.png, which is not there"));
  }
  folder_.Write("building/materials.json",
                R"({"materials": {"BRICK": {"diffuse_rgb": [1, 0, 0]}}})");
  EXPECT_EQ(ConvertBuilding(site).environment.triangles.size(), 3u);
}

const char kPly[] = R"(ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
element face 4
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
0 1 0
0 0 1
3 0 2 1
3 0 1 3
3 0 3 2
3 1 2 3
)";

const char kStl[] = R"(solid tetra
facet normal 0 0 -1
 outer loop
  vertex 0 0 0
  vertex 0 1 0
  vertex 1 0 0
 endloop
endfacet
endsolid tetra
)";

// One triangle in a node "Wall" that stands 5 m along x; glTF has y up.
const char kGltf[] = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"mesh": 0, "name": "Wall", "translation": [5, 0, 0]}],
 "materials": [{"name": "Red", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0, 0, 1]}}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                "min": [0, 0, 0], "max": [1, 2, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAAAA"}]})";

const char kCollada[] = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
 <asset><unit meter="0.001" name="millimeter"/><up_axis>Z_UP</up_axis></asset>
 <library_geometries><geometry id="g" name="g"><mesh>
  <source id="p"><float_array id="pa" count="9">0 0 0 1000 0 0 0 0 2000</float_array>
   <technique_common><accessor source="#pa" count="3" stride="3"><param name="X" type="float"/>
    <param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common>
  </source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
  <triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
 </mesh></geometry></library_geometries>
 <library_visual_scenes><visual_scene id="s"><node id="n" name="Gate">
  <instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
 <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
)";

TEST_F(ModelFile, FormatsAreToldByContent) {
  const std::pair<std::string, ModelFormat> cases[] = {
      {DrawingText(UnitSquare("W")), ModelFormat::kDxf},
      {"999\nby hand\n0\nSECTION\n", ModelFormat::kDxf},
      {kObj, ModelFormat::kObj},
      {kPly, ModelFormat::kPly},
      {kStl, ModelFormat::kStl},
      {kGltf, ModelFormat::kGltf},
      {kCollada, ModelFormat::kCollada},
      {"ISO-10303-21;\nHEADER;", ModelFormat::kIfc}};
  for (const auto& [content, format] : cases) {
    EXPECT_EQ(DetectModelFormat(folder_.Write("anything.txt", content)), format);
  }
  EXPECT_EQ(DetectModelFormat(folder_.Write("anything.obj", "hello\n")), std::nullopt);
  EXPECT_THAT(Complaint("a.obj", "AC1032 ..."), HasSubstr("is a DWG drawing"));
  EXPECT_THAT(Complaint("a.3dm", "3D Geometry File Format "), HasSubstr("is a Rhino model"));
}

TEST_F(ModelFile, PlyAndStl) {
  const Model ply = Read("tetra.ply", kPly);
  EXPECT_NEAR(VolumeOf(ply.mesh), 1.0 / 6, 1e-7);
  EXPECT_EQ(ply.mesh.surfaces[0].layer, "tetra");
  EXPECT_EQ(ply.metres_per_unit, std::nullopt);
  EXPECT_NEAR(AreaOf(Read("named_otherwise.txt", kStl).mesh), 0.5, 1e-7);
}

TEST_F(ModelFile, GltfIsTurnedUpright) {
  const Model model = Read("wall.gltf", kGltf);
  ASSERT_EQ(model.mesh.triangles.size(), 1u);
  EXPECT_EQ(model.mesh.surfaces[0].layer, "Wall");
  EXPECT_EQ(model.mesh.surfaces[0].material, "Red");
  EXPECT_NEAR((*model.mesh.surfaces[0].rgb - Vector3d(0.5, 0, 0)).norm(), 0, 1e-6);
  EXPECT_THAT(model.mesh.vertices, Contains(Vector3d(5, 0, 2)));
  EXPECT_EQ(model.metres_per_unit, 1);
}

// As GLB and glTF mostly come: a red image inside the file.
TEST_F(ModelFile, TexturesInsideTheModelBecomeFiles) {
  std::string text = kGltf;
  const auto replace = [&text](const std::string& what, const std::string& with) {
    text.replace(text.find(what), what.size(), with);
  };
  replace("\"baseColorFactor\": [0.5, 0, 0, 1]", "\"baseColorTexture\": {\"index\": 0}");
  replace("\"meshes\"", R"("textures": [{"source": 0}], "images": [{"mimeType": "image/png", "uri":
      "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/pLvAAAAAElFTkSuQmCC"
      }], "meshes")");
  folder_.Write("building/wall.gltf", text);
  const SitePaths site{folder_.path()};
  const SurfaceMaterial material = ConvertBuilding(site).environment.materials.at(0);
  EXPECT_EQ(material.texture, "../work/building_textures/wall.gltf_0.png");
  EXPECT_TRUE(std::filesystem::is_regular_file(site.building() / material.texture));
  EXPECT_NEAR((material.diffuse_rgb - Vector3d(1, 0, 0)).norm(), 0, 1e-6);
  replace("iVBORw0KGgo", "AAAAAAAAAAA");
  folder_.Write("building/wall.gltf", text);
  EXPECT_THAT(ConvertBuilding(site).warnings, Contains(HasSubstr("neither PNG nor JPEG")));
}

TEST_F(ModelFile, ColladaComesInMetres) {
  const Model model = Read("gate.dae", kCollada);
  ASSERT_EQ(model.mesh.triangles.size(), 1u);
  EXPECT_EQ(model.mesh.surfaces[0].layer, "Gate");
  Eigen::AlignedBox3d box;
  for (const Vector3d& v : model.mesh.vertices) box.extend(v);
  EXPECT_NEAR((box.sizes() - Vector3d(1, 0, 2)).norm(), 0, 1e-6);
}

TEST_F(ModelFile, IfcOfAnotherSchemaOrCutShort) {
  const std::string head = "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('IFC4'));\nENDSEC;\n";
  EXPECT_THAT(Complaint("a.ifc", head + "END-ISO-10303-21;\n"),
              HasSubstr("a.ifc:3: is of schema IFC4, expected IFC2X3"));
  std::string old = head;
  old.replace(old.find("IFC4"), 4, "IFC2X3");
  EXPECT_THAT(Complaint("a.ifc", old), HasSubstr("a.ifc:4: the file ends here"));
  EXPECT_THAT(Complaint("a.ifc", "ISO-10303-21;\nENDSEC;\n"), HasSubstr("no FILE_SCHEMA"));
}

// A statement that is none would be passed over, and with it what it describes.
TEST_F(ModelFile, FaultyIfcStatements) {
  const auto complaint = [this](const std::string& statement) {
    return Complaint("a.ifc", "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('IFC2X3'));\nENDSEC;\nDATA;\n" +
                                  statement + "\nENDSEC;\nEND-ISO-10303-21;\n");
  };
  EXPECT_THAT(complaint("#1=IFCWALL('a;b',(1,2));\n#garbage\n#2=IFCWALL();"),
              HasSubstr("a.ifc:7: \"#garbage#2=IFCWALL()\", expected an instance"));
  EXPECT_THAT(complaint("#1=IFCWALL((1,2);"), HasSubstr("a.ifc:6: "));
  EXPECT_THAT(complaint("#=IFCWALL();"), HasSubstr("a.ifc:6: "));
  EXPECT_THAT(complaint("/* #1 */ #1 =\n IFCWALL ('it''s', *, $);\n#2=(IFCA()IFCB());"),
              Not(HasSubstr("expected an instance")));
}

TEST_F(ModelFile, FilesThatWereCut) {
  const std::string ply = kPly, stl = kStl, gltf = kGltf, collada = kCollada;
  EXPECT_THAT(Complaint("a.ply", ply.substr(0, ply.size() - 8)),
              HasSubstr("a.ply: holds 7 vertices, faces and so on, expected 8"));
  EXPECT_THAT(Complaint("a.ply", ply.substr(0, 140)), HasSubstr("a.ply:8: its head ends here"));
  EXPECT_THAT(Complaint("a.stl", stl.substr(0, stl.find("endsolid"))),
              HasSubstr("a.stl:8: the file ends here, expected endsolid"));
  EXPECT_THAT(
      Complaint("a.stl", std::string(80, ' ') + std::string("\2\0\0\0", 4) + std::string(50, '\0')),
      HasSubstr("a.stl: is 134 bytes long, expected 184"));
  EXPECT_THAT(Complaint("a.glb", std::string("glTF\2\0\0\0\0\1\0\0", 12)),
              HasSubstr("a.glb: is 12 bytes long, expected 256"));
  EXPECT_THAT(Complaint("a.gltf", gltf.substr(0, 400)), HasSubstr("a.gltf:6: "));
  EXPECT_THAT(Complaint("a.dae", collada.substr(0, 700)), HasSubstr("a.dae:"));
}

TEST_F(ModelFile, DamagedFilesAreRefusedOrRead) {
  for (const char* content : {kPly, kStl, kGltf, kCollada}) {
    const std::string whole = content;
    for (size_t length = 40; length < whole.size(); length += 97) {
      Complaint("cut.bin", whole.substr(0, length));  // any answer but a crash
    }
  }
}

TEST(Isolated, ACrashOrAnEndlessLoopThereIsAFailureHere) {
  const auto crash = [] {
    std::raise(SIGSEGV);
    return Model{};
  };
  EXPECT_THAT(ReadIsolated(crash).failure, HasSubstr("breaks its reader"));
  const auto loop = [] {
    volatile bool on = true;
    while (on) continue;
    return Model{};
  };
  EXPECT_THAT(ReadIsolated(loop, {.seconds = 1}).failure, HasSubstr("longer than 1 s"));
  const auto refuse = []() -> Model { throw std::runtime_error("no"); };
  EXPECT_EQ(ReadIsolated(refuse).failure, "no");
}

TEST(Isolated, BringsTheWholeModel) {
  Model model;
  model.mesh.surfaces = {{"a", "b", "c", Vector3d(1, 0.5, 0), 0.3, "t.png", "m:1"}, {}};
  model.mesh.vertices = {{1, 2, 3}, {4, 5, 6}, {7, 8, 1e9 / 3}};
  model.mesh.triangles = {{0, 1, 2}};
  model.mesh.surface_of_triangle = {1};
  model.mesh.corner_uvs = {{0, 1}, {1, 1}, {1, 0}};
  model.entities = {{"mesh", 2}};
  model.images = {{"*0", std::string("\x89PNG\0", 5)}};
  model.skipped = {{{"line", "no surface"}, 3}};
  model.warnings = {"careful"};
  model.metres_per_unit = 0.5;
  const auto read = ReadIsolated([&] { return model; }).model;
  ASSERT_TRUE(read);
  EXPECT_EQ(read->mesh.surfaces, model.mesh.surfaces);
  EXPECT_EQ(read->mesh.vertices, model.mesh.vertices);
  EXPECT_EQ(read->mesh.triangles, model.mesh.triangles);
  EXPECT_EQ(read->mesh.corner_uvs, model.mesh.corner_uvs);
  EXPECT_EQ(read->entities, model.entities);
  EXPECT_EQ(read->images, model.images);
  EXPECT_EQ(read->skipped, model.skipped);
  EXPECT_EQ(read->warnings, model.warnings);
  EXPECT_EQ(read->metres_per_unit, 0.5);
}

}  // namespace
}  // namespace insitu
