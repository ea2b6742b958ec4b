// SPDX-License-Identifier: GPL-3.0-or-later
// Models of all formats, whole and damaged.
#include "renderer/formats/model_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "calibration/files/error.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/calibration/files/wrong_field.h"
#include "tests/renderer/formats/model_texts.h"
#include "tests/renderer/mesh/mesh_measures.h"

namespace insitu {
namespace {

using Eigen::Vector3d;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

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

TEST_F(ModelFile, ColladaComesInMetres) {
  const Model model = Read("gate.dae", kCollada);
  ASSERT_EQ(model.mesh.triangles.size(), 1u);
  EXPECT_EQ(model.mesh.surfaces[0].layer, "Gate");
  Eigen::AlignedBox3d box;
  for (const Vector3d& v : model.mesh.vertices) box.extend(v);
  EXPECT_NEAR((box.sizes() - Vector3d(1, 0, 2)).norm(), 0, 1e-6);
}

TEST_F(ModelFile, IfcOfAnotherSchemaOrCutShort) {
  const std::string head = "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('IFC2X2'));\nENDSEC;\n";
  EXPECT_THAT(Complaint("a.ifc", head + "END-ISO-10303-21;\n"),
              HasSubstr("a.ifc:3: is of schema IFC2X2, expected IFC2X3"));
  std::string old = head;
  old.replace(old.find("IFC2X2"), 6, "IFC2X3");
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
              HasSubstr("ends in face 4 of the 4 that line 7 states: it is cut short"));
  EXPECT_THAT(Complaint("a.ply", ply.substr(0, 140)), HasSubstr("a.ply:8: its head ends here"));
  EXPECT_THAT(Complaint("a.stl", stl.substr(0, stl.find("endfacet"))),
              HasSubstr("a.stl:7: the file ends in a facet"));
  EXPECT_THAT(
      Complaint("a.stl", std::string(80, ' ') + std::string("\2\0\0\0", 4) + std::string(50, '\0')),
      HasSubstr("a.stl: is 134 bytes long, expected 184"));
  EXPECT_THAT(Complaint("a.glb", std::string("glTF\2\0\0\0\0\1\0\0", 12)),
              HasSubstr("a.glb: is 12 bytes long, expected 256"));
  EXPECT_THAT(Complaint("a.gltf", gltf.substr(0, 400)), HasSubstr("a.gltf:6: "));
  EXPECT_THAT(Complaint("a.dae", collada.substr(0, 700)), HasSubstr("a.dae:"));
}

TEST_F(ModelFile, StlStatementsMayBeTornOrShareALine) {
  std::string torn = kStl;
  for (const char* word : {"endfacet", "endloop", "endsolid"}) {
    torn.replace(torn.find(word), 3, "end ");
  }
  EXPECT_NEAR(AreaOf(Read("a.stl", torn).mesh), 0.5, 1e-7);
  std::string line = kStl;
  std::ranges::replace(line, '\n', ' ');
  const Model model = Read("a.stl", line + line.replace(0, 5, "solid roof of"));
  EXPECT_NEAR(AreaOf(model.mesh), 1, 1e-7);
  EXPECT_TRUE(model.warnings.empty());
}

TEST_F(ModelFile, SinglePrecisionFarAwayIsToldOf) {
  std::string binary = std::string(80, ' ') + std::string("\1\0\0\0", 4);
  for (const float x :
       {0.f, 0.f, 0.f, 2600000.f, 0.f, 0.f, 2600001.f, 0.f, 0.f, 2600000.f, 1.f, 0.f}) {
    binary.append(reinterpret_cast<const char*>(&x), sizeof(x));
  }
  EXPECT_THAT(Read("a.stl", binary + std::string(2, '\0')).warnings,
              Contains(HasSubstr("up to 2600001 m in single precision, to 0.310 m")));
}

// What other programs write and is no fault of the geometry.
TEST_F(ModelFile, StlAsItIsWritten) {
  const std::string stl = kStl;
  EXPECT_NEAR(AreaOf(Read("a.stl", "\xEF\xBB\xBF\n" + NameKey(stl)).mesh), 0.5, 1e-7);
  EXPECT_EQ(Read("a.stl", stl.substr(0, stl.find("endsolid"))).warnings.size(), 1u);
  std::string nonsense = stl;
  nonsense.replace(nonsense.find("0 0 -1"), 6, "-1.#IND -1.#IND -1.#IND");
  EXPECT_NEAR(AreaOf(Read("a.stl", nonsense).mesh), 0.5, 1e-7);
  const Model several =
      Read("a.stl", "solid walls\n" + stl.substr(stl.find('\n') + 1) +
                        "solid roof\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1\n"
                        "vertex 1 0 1\nvertex 0 1 1\nendloop\nendfacet\n"
                        "facet normal 0 0 1\nouter loop\nvertex 0 0 1\nvertex nan 0 1\n"
                        "vertex 0 1 1\nendloop\nendfacet\nendsolid roof\n");
  ASSERT_EQ(several.mesh.surfaces.size(), 2u);
  EXPECT_EQ(several.mesh.surfaces[1].layer, "roof");
  EXPECT_EQ(several.skipped.at({"facet", "at a corner that is no point"}), 1);
  const std::string corners(
      "\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x80\x3F\0\0\0\0\0\0\0\0"
      "\0\0\0\0\0\0\x80\x3F\0\0\0\0",
      36);
  const std::string facet = std::string(12, '\0') + corners + std::string(2, '\0');
  for (const std::string& count :
       {std::string(4, '\0'), std::string("\1\0\0\0", 4), std::string(4, '\xFF')}) {
    std::string binary(80, ' ');
    binary.append(count).append(facet).append("\r\n");
    const Model model = Read("a.stl", binary);
    EXPECT_NEAR(AreaOf(model.mesh), 0.5, 1e-7);
    EXPECT_EQ(model.skipped.size(), 1u);  // the bytes behind
  }
  const Model named = Read("a.stl", "solid house units: mm" + stl.substr(stl.find('\n')));
  EXPECT_EQ(named.metres_per_unit, 0.001);
  EXPECT_NEAR(AreaOf(named.mesh), 0.5e-6, 1e-12);
  std::string head = "by Acme; units=cm";
  head.resize(80);
  const Model headed = Read("a.stl", head + std::string("\1\0\0\0", 4) + facet);
  EXPECT_NEAR(AreaOf(headed.mesh), 0.5e-4, 1e-10);
}

// They would break lists, and terminals.
TEST_F(ModelFile, ControlCharactersInNamesAreBlanks) {
  const std::string faces = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const Model model = ReadModel(folder_.Write("a.obj", "g a\x1B[31mb\n" + faces + "odd\x07 1\n"));
  EXPECT_EQ(model.mesh.surfaces[0].layer, "a [31mb");
  EXPECT_EQ(model.skipped.begin()->first.first, "odd ");
  EXPECT_TRUE(Read("b.obj", faces + std::string(3, '\0')).skipped.empty());
  EXPECT_TRUE(Read("b.obj", faces + "\x1A").skipped.empty());
}

TEST_F(ModelFile, GltfExtensionsAreRefusedOrNamed) {
  const auto with = [](const std::string& list) {
    std::string gltf = kGltf;
    return gltf.replace(gltf.find("\"scene\""), 0, "\"" + list + "\": [\"EXT_unknown\"], ");
  };
  EXPECT_THAT(Complaint("a.gltf", with("extensionsRequired")), HasSubstr("EXT_unknown"));
  EXPECT_THAT(Read("a.gltf", with("extensionsUsed")).warnings, Contains(HasSubstr("EXT_unknown")));
}

TEST_F(ModelFile, DamagedFilesAreRefusedOrRead) {
  for (const char* content : {kPly, kStl, kGltf, kCollada}) {
    const std::string whole = content;
    for (size_t length = 40; length < whole.size(); length += 97) {
      Complaint("cut.bin", whole.substr(0, length));  // any answer but a crash
    }
  }
}

// Every tenth byte in turn becomes another.
TEST_F(ModelFile, ChangedBytesAreRefusedOrRead) {
  for (const char* content : {kPly, kStl, kGltf, kCollada, kObj}) {
    const std::string whole = content;
    for (size_t place = 0; place < whole.size(); place += 10) {
      for (const char other : {'9', '-', ' ', '"', '\xFF'}) {
        std::string changed = whole;
        changed[place] = other;
        Complaint("changed.bin", changed);  // any answer but a crash
      }
    }
  }
}

TEST(ImportOptions, NameTheFieldThatIsWrong) {
  EXPECT_EQ(WrongField(ImportOptions()), "");
  EXPECT_THAT(WrongField(ImportOptions{.dxf = {}, .seconds = 0}), HasSubstr("seconds"));
  EXPECT_THAT(WrongField(ImportOptions{.dxf = {.chord_tolerance = 0}}),
              HasSubstr("chord_tolerance"));
  EXPECT_THAT(WrongField(DxfOptions{.most_pieces = 0}), HasSubstr("most_pieces"));
}

}  // namespace
}  // namespace insitu
