// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/gltf/gltf_model.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <array>
#include <cstring>

#include "calibration/files/error.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/renderer/mesh/mesh_measures.h"

namespace insitu {
namespace {

using Eigen::Vector3d;
using testing::Contains;
using testing::HasSubstr;

template <typename T>
std::string BytesOf(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

std::string WordOf(size_t value) { return BytesOf(std::vector<uint32_t>{uint32_t(value)}); }

// A binary file; blanks end its JSON at a multiple of four.
std::string Glb(std::string json, std::string bytes) {
  while (json.size() % 4 != 0) json += ' ';
  while (bytes.size() % 4 != 0) bytes += '\0';
  return "glTF" + WordOf(2) + WordOf(28 + json.size() + bytes.size()) + WordOf(json.size()) +
         "JSON" + json + WordOf(bytes.size()) + std::string("BIN\0", 4) + bytes;
}

const std::vector<float> kTriangle = {0, 0, 0, 1, 0, 0, 0, 2, 0};  // 1 m2, upright as y is up

// A triangle in the node `node`; `more` are members of the file beside the usual ones.
std::string Gltf(const std::string& node = R"({"mesh": 0})", const std::string& more = "",
                 const std::string& primitive = R"("attributes": {"POSITION": 0}, "material": 0)",
                 const std::string& material = R"({"name": "Wall"})") {
  return R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [)" + node +
         R"(], "materials": [)" + material + R"(], "meshes": [{"primitives": [{)" + primitive +
         R"(}]}], "accessors": [
             {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
             {"bufferView": 1, "componentType": 5126, "count": 2, "type": "VEC3"},
             {"bufferView": 2, "componentType": 5122, "count": 3, "type": "VEC3",
              "normalized": true},
             {"bufferView": 3, "componentType": 5121, "count": 3, "type": "VEC4",
              "normalized": true}],
           "bufferViews": [{"buffer": 0, "byteLength": 36},
                           {"buffer": 0, "byteOffset": 36, "byteLength": 24},
                           {"buffer": 0, "byteOffset": 60, "byteLength": 24, "byteStride": 8},
                           {"buffer": 0, "byteOffset": 84, "byteLength": 12}],
           "buffers": [{"byteLength": 96}])" +
         more + "}";
}

std::string Bytes() {
  return BytesOf(kTriangle) + BytesOf(std::vector<float>{0, 0, 0, 0, 0, 50}) +
         BytesOf(std::vector<int16_t>{0, 0, 0, 0, 32767, 0, 0, 0, 0, 32767, 0, 0}) +
         BytesOf(std::vector<uint8_t>{255, 0, 0, 255, 255, 0, 0, 255, 255, 0, 0, 255});
}

class GltfModel : public testing::Test {
 protected:
  Model Read(const std::string& json) {
    return ReadGltf(GltfFile(folder_.Write("house.glb", Glb(json, Bytes()))));
  }
  std::string Complaint(const std::string& json) {
    try {
      Read(json);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  ScratchFolder folder_;
};

// A northing of a national grid is beyond single precision.
TEST_F(GltfModel, NodesStandInDoublePrecision) {
  const Model model = Read(
      Gltf(R"({"mesh": 0, "name": "Tower", "translation": [2600000.123, 500, -1200000.456]})"));
  EXPECT_THAT(model.mesh.vertices, Contains(Vector3d(2600000.123, 1200000.456, 502)));
  EXPECT_EQ(model.mesh.surfaces[0].layer, "Tower");
  EXPECT_EQ(model.mesh.surfaces[0].material, "Wall");
}

TEST_F(GltfModel, MirroredNodesKeepTheirOutside) {
  const Model plain = Read(Gltf()), mirrored = Read(Gltf(R"({"mesh": 0, "scale": [-1, 1, 1]})"));
  const auto normal = [](const Model& model) {
    const auto& [a, b, c] = std::array{model.mesh.vertices[model.mesh.triangles[0][0]],
                                       model.mesh.vertices[model.mesh.triangles[0][1]],
                                       model.mesh.vertices[model.mesh.triangles[0][2]]};
    return Vector3d((b - a).cross(c - a).normalized());
  };
  EXPECT_NEAR((normal(plain) - normal(mirrored)).norm(), 0, 1e-12);
}

TEST_F(GltfModel, InstancesAndQuantisedPositions) {
  const Model copies = Read(Gltf(
      R"({"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 1}}}})",
      R"(, "extensionsRequired": ["EXT_mesh_gpu_instancing"])"));
  EXPECT_NEAR(AreaOf(copies.mesh), 2, 1e-9);
  EXPECT_THAT(copies.mesh.vertices, Contains(Vector3d(0, -50, 2)));
  const Model quantised = Read(Gltf(R"({"mesh": 0, "scale": [3, 3, 3]})",
                                    R"(, "extensionsRequired": ["KHR_mesh_quantization"])",
                                    R"("attributes": {"POSITION": 2})"));
  EXPECT_NEAR(AreaOf(quantised.mesh), 4.5, 1e-9);
}

TEST_F(GltfModel, MaterialsOfEveryKind) {
  const auto names = [this](const std::string& material) {
    return Read(Gltf(R"({"mesh": 0})", "", R"("attributes": {"POSITION": 0}, "material": 0)",
                     R"({"name": "M", )" + material + "}"))
        .mesh.surfaces[0];
  };
  const std::string clear = R"("pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0, 0.25]})";
  EXPECT_EQ(names(clear).opacity, 1);  // OPAQUE whatever alpha says
  EXPECT_EQ(names(clear + R"(, "alphaMode": "BLEND")").opacity, 0.25);
  EXPECT_EQ(names(clear).rgb, Vector3d(1, 0.5, 0));
  EXPECT_EQ(names(R"("extensions": {"KHR_materials_pbrSpecularGlossiness":
                     {"diffuseFactor": [0, 0.5, 1, 1]}})")
                .rgb,
            Vector3d(0, 0.5, 1));
  const SurfaceNames glass = names(R"("extensions": {"KHR_materials_transmission":
      {"transmissionFactor": 0.9}, "KHR_materials_ior": {"ior": 1.33}, "KHR_materials_volume":
      {"thicknessFactor": 1, "attenuationDistance": 2, "attenuationColor": [1, 0.5, 0.25]}})");
  EXPECT_NEAR(glass.opacity, 0.1, 1e-12);
  EXPECT_TRUE(glass.is_solid);
  EXPECT_EQ(glass.index, 1.33);
  EXPECT_NEAR((glass.absorption_rgb - Vector3d(0, std::log(2) / 2, std::log(2))).norm(), 0, 1e-12);
}

TEST_F(GltfModel, MapsBesideTheColour) {
  const auto read = [this](const std::string& material) {
    return Read(Gltf(R"({"mesh": 0})",
                     R"(, "images": [{"uri": "a.png"}], "textures": [{"source": 0}])",
                     R"("attributes": {"POSITION": 0}, "material": 0)", "{" + material + "}"));
  };
  const std::string metal = R"("pbrMetallicRoughness": {"roughnessFactor": 0.5,
      "metallicRoughnessTexture": {"index": 0}}, "normalTexture": {"index": 0, "scale": 0.7)";
  const std::vector<SurfaceMap> maps = read(metal + "}").mesh.surfaces[0].maps;
  ASSERT_EQ(maps.size(), 3u);
  EXPECT_EQ(maps[0].factor, 0.7);
  EXPECT_EQ(maps[1].channel, 1);
  EXPECT_EQ(maps[1].factor, 0.5);
  EXPECT_TRUE(maps[1].is_squared);
  EXPECT_EQ(maps[2].channel, 2);
  EXPECT_EQ(maps[2].file, "a.png");
  // At other coordinates than the first: named and left out.
  const Model other = read(metal + R"(, "texCoord": 1})");
  EXPECT_EQ(other.mesh.surfaces[0].maps.size(), 1u);
  const SurfaceNames blind = read(R"("extensions": {"KHR_materials_diffuse_transmission":
      {"diffuseTransmissionFactor": 0.25, "diffuseTransmissionColorFactor": [1, 0.5, 0]}})")
                                 .mesh.surfaces[0];
  EXPECT_EQ(blind.diffuse_weight, 0.75);
  EXPECT_EQ(blind.translucent_rgb, Vector3d(0.25, 0.125, 0));
}

TEST_F(GltfModel, ColoursByVertexAreShownByFaceAndSaid) {
  const Model model = Read(
      Gltf(R"({"mesh": 0})", "", R"("attributes": {"POSITION": 0, "COLOR_0": 3}, "material": 0)"));
  EXPECT_EQ(model.mesh.surfaces[0].rgb, Vector3d(1, 0, 0));
  EXPECT_EQ(model.skipped.begin()->first.first, "mesh with colours by vertex");
}

TEST_F(GltfModel, PunctualLightsBecomeLamps) {
  const Model model = Read(Gltf(
      R"({"mesh": 0, "translation": [0, 3, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}})",
      R"(, "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "intensity": 800,
          "name": "Lamp", "spot": {"outerConeAngle": 0.7853981633974483}}]}})"));
  ASSERT_EQ(model.lamps.size(), 1u);
  EXPECT_EQ(model.lamps[0].candela, 800);
  EXPECT_NEAR((model.lamps[0].position - Vector3d(0, 0, 3)).norm(), 0, 1e-12);
  EXPECT_NEAR((model.lamps[0].direction - Vector3d(0, 1, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR(*model.lamps[0].outer_deg, 45, 1e-9);
}

TEST_F(GltfModel, CornersBeyondTheLastTriangleAreCounted) {
  std::string text = Gltf();
  text.replace(text.find("\"count\": 3"), 10, "\"count\": 2");
  EXPECT_EQ(Read(text).skipped.at({"indices", "too few for a last triangle"}), 1);
}

TEST_F(GltfModel, FaultsAreNamed) {
  EXPECT_THAT(Complaint(Gltf("{\"mesh\": 7}")), HasSubstr("meshes[7], which is not there"));
  EXPECT_THAT(Complaint(Gltf("{\"mesh\": 0, \"children\": [0]}")), HasSubstr("over 1000 deep"));
  EXPECT_THAT(Complaint(Gltf("{\"mesh\": 0}", "", R"("attributes": {"NORMAL": 0})")),
              HasSubstr("no positions"));
  EXPECT_THAT(Complaint(Gltf("{\"mesh\": 0}", R"(, "extensionsRequired": ["ACME_x"])")),
              HasSubstr("ACME_x"));
  const Model without = Read(
      Gltf("{\"mesh\": 0}", "", R"("material": 7, "attributes": {"POSITION": 0, "NORMAL": 9})"));
  EXPECT_FALSE(without.mesh.triangles.empty());
  EXPECT_EQ(without.skipped.at({"material", "a mesh names one that is not there"}), 1);
  ASSERT_EQ(without.warnings.size(), 1u);
  EXPECT_THAT(without.warnings[0], HasSubstr("NORMAL is left out"));
  std::string long_view = Gltf();
  long_view.replace(long_view.find("\"byteLength\": 36"), 16, "\"byteLength\": 99");
  EXPECT_THAT(Complaint(long_view), HasSubstr("which has 96: the file is cut short"));
  std::string old = Gltf();
  old.replace(old.find("2.0"), 3, "1.0");
  EXPECT_THAT(Complaint(old), HasSubstr("version \"1.0\", expected 2.0"));
}

// Positions and triangles in one buffer each, compressed as gltfpack does.
TEST_F(GltfModel, Meshopt) {
  std::string vertices(meshopt_encodeVertexBufferBound(3, 12), '\0');
  vertices.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(vertices.data()),
                                             vertices.size(), kTriangle.data(), 3, 12));
  const std::string json =
      R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
       "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
       "extensionsRequired": ["EXT_meshopt_compression"],
       "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
       "bufferViews": [{"buffer": 1, "byteLength": 36, "extensions": {"EXT_meshopt_compression":
         {"buffer": 0, "byteLength": )" +
      std::to_string(vertices.size()) +
      R"(, "byteStride": 12, "count": 3, "mode": "ATTRIBUTES"}}}],
       "buffers": [{"byteLength": 1}, {"byteLength": 36}]})";
  const Model model = ReadGltf(GltfFile(folder_.Write("a.glb", Glb(json, vertices))));
  EXPECT_NEAR(AreaOf(model.mesh), 1, 1e-6);
  vertices[0] = 'x';
  EXPECT_THROW(ReadGltf(GltfFile(folder_.Write("a.glb", Glb(json, vertices)))), InputError);
}

TEST_F(GltfModel, Draco) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(1);
  const int id = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  builder.SetAttributeValuesForFace(id, draco::FaceIndex(0), kTriangle.data(), &kTriangle[3],
                                    &kTriangle[6]);
  const auto mesh = builder.Finalize();
  draco::Encoder encoder;
  draco::EncoderBuffer buffer;
  ASSERT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  const std::string bytes(buffer.data(), buffer.size());
  const std::string json =
      R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
       "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "extensions":
         {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}}]}],
       "extensionsRequired": ["KHR_draco_mesh_compression"],
       "accessors": [{"componentType": 5126, "count": 3, "type": "VEC3"},
                     {"componentType": 5123, "count": 3, "type": "SCALAR"}],
       "bufferViews": [{"buffer": 0, "byteLength": )" +
      std::to_string(bytes.size()) + R"(}], "buffers": [{"byteLength": 1}]})";
  const Model model = ReadGltf(GltfFile(folder_.Write("a.glb", Glb(json, bytes))));
  EXPECT_NEAR(AreaOf(model.mesh), 1, 1e-6);
}

}  // namespace
}  // namespace insitu
