// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/foreign/ply_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "calibration/files/error.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/renderer/mesh/mesh_measures.h"

namespace insitu {
namespace {

using Eigen::Vector3d;
using testing::Contains;
using testing::HasSubstr;

constexpr char kXyz[] = "property double x\nproperty double y\nproperty double z\n";
constexpr char kList[] = "property list uchar int vertex_indices\n";

template <typename T>
std::string Little(T value) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}
template <typename T>
std::string Big(T value) {
  const std::string bytes = Little(value);
  return {bytes.rbegin(), bytes.rend()};
}

class PlyModel : public testing::Test {
 protected:
  Model Read(const std::string& content) { return ReadPly(folder_.Write("a.ply", content)); }
  std::string Complaint(const std::string& content) {
    try {
      Read(content);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  static std::string Text(const std::string& elements, const std::string& body) {
    return "ply\nformat ascii 1.0\n" + elements + "end_header\n" + body;
  }
  ScratchFolder folder_;
};

TEST_F(PlyModel, AnyOrderOfElementsAndAnyLines) {
  const std::string faces = std::string("element face 1\n") + kList;
  const std::string vertices = std::string("element vertex 3\n") + kXyz;
  EXPECT_NEAR(AreaOf(Read(Text(vertices + faces, "0 0 0 1 0 0\n\n0 2 0 3 0 1 2")).mesh), 1, 1e-12);
  const Model model = Read(Text(faces + vertices, "3 0 1 2\n0 0 0\n2600000.123 0 0\n0 2 0\n"));
  EXPECT_THAT(model.mesh.vertices, Contains(Vector3d(2600000.123, 0, 0)));
}

TEST_F(PlyModel, CommentsNameTheUnit) {
  const std::string elements =
      std::string("element vertex 3\n") + kXyz + "element face 1\n" + kList;
  const auto read = [&](const std::string& comment) {
    return Read(Text(comment + elements, "0 0 0 1000 0 0 0 2000 0 3 0 1 2"));
  };
  const Model model = read("comment made by hand\ncomment\ncomment units: mm\n");
  EXPECT_NEAR(AreaOf(model.mesh), 1, 1e-12);
  EXPECT_EQ(model.metres_per_unit, 0.001);
  EXPECT_THAT(model.warnings, Contains(testing::HasSubstr("\"units: mm\" is taken as its unit")));
  EXPECT_EQ(read("").metres_per_unit, std::nullopt);
}

TEST_F(PlyModel, StripsAreWoundAlike) {
  const Model model = Read(Text(std::string("element vertex 4\n") + kXyz +
                                    "element tristrips 1\nproperty list int int vertex_indices\n",
                                "0 0 0\n10 0 0\n0 6 0\n10 6 0\n8 0 1 2 3 -1 0 1 2\n"));
  EXPECT_NEAR(AreaOf(model.mesh), 90, 1e-9);
  for (const Eigen::Vector3i& t : model.mesh.triangles) {
    const Vector3d& a = model.mesh.vertices[t[0]];
    EXPECT_GT((model.mesh.vertices[t[1]] - a).cross(model.mesh.vertices[t[2]] - a).z(), 0);
  }
}

// The first byte of the body is that of a line's end: 0x0A, and 0x0D too.
TEST_F(PlyModel, BinaryOfEitherOrder) {
  const std::string elements = std::string("element vertex 3\nproperty uchar n\n") + kXyz +
                               "element face 1\n" + kList + "end_header\n";
  const double points[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
  for (const bool big : {false, true}) {
    for (const char first : {'\n', '\r'}) {
      std::string body;
      for (const auto& point : points) {
        body += first;
        for (const double x : point) body += big ? Big(x) : Little(x);
      }
      body += '\3';
      for (const int i : {0, 1, 2}) body += big ? Big(i) : Little(i);
      const std::string head = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                               "_endian 1.0\n" + elements;
      EXPECT_NEAR(AreaOf(Read(head + body).mesh), 1, 1e-12);
      EXPECT_THAT(Complaint(head + body.substr(0, 40)),
                  HasSubstr("ends in vertex 2 of the 3 that line 3 states: it is cut short"));
      EXPECT_EQ(Read(head + body + "\n\n?").skipped.size(), 2u);  // n, and what is behind
    }
  }
}

TEST_F(PlyModel, AttributesOfVerticesAndFaces) {
  const Model model =
      Read(Text(std::string("comment TextureFile a b.png\nelement vertex 3\n") + kXyz +
                    "property float nx\nproperty float ny\n"
                    "property float nz\nproperty uchar red\nproperty uchar green\n"
                    "property uchar blue\nelement face 1\n" +
                    kList + "property list uchar float texcoord\n",
                "0 0 0 0 0 -1 255 0 0\n1 0 0 0 0 -1 255 0 0\n"
                "0 2 0 nan 0 -1 255 0 0\n3 0 1 2 6 0 0 0.5 0 0 1\n"));
  ASSERT_EQ(model.mesh.corner_normals.size(), 3u);
  EXPECT_EQ(model.mesh.corner_normals[0], Eigen::Vector3f(0, 0, -1));
  EXPECT_EQ(model.mesh.corner_normals[2], Eigen::Vector3f(0, 0, 1));  // the face's own
  EXPECT_EQ(model.mesh.corner_uvs[1], Eigen::Vector2f(0.5, 0));
  EXPECT_EQ(model.mesh.surfaces[0].texture, "a b.png");
  EXPECT_EQ(model.mesh.surfaces[0].rgb, Vector3d(1, 0, 0));
}

TEST_F(PlyModel, WhatIsNoPointCostsItsFaces) {
  const std::string elements =
      std::string("element vertex 4\n") + kXyz + "element face 2\n" + kList;
  const Model model =
      Read(Text(elements, "0 0 0\n1 0 0\n0 2 0\n-1.#IND 0 nan\n3 0 1 2\n3 0 1 3\n"));
  EXPECT_EQ(model.mesh.triangles.size(), 1u);
  EXPECT_EQ(model.skipped.at({"face", "at a vertex that is no point"}), 1);
}

TEST_F(PlyModel, FaultsAreNamed) {
  const std::string elements =
      std::string("element vertex 3\n") + kXyz + "element face 1\n" + kList;
  const std::string points = "0 0 0\n1 0 0\n0 2 0\n";
  EXPECT_EQ(Complaint(Text(elements, points + "3 0 1 2\n")), "");
  EXPECT_THAT(Complaint(Text(elements, points + "3 0 1 3\n")), HasSubstr("names vertex 3"));
  EXPECT_THAT(Complaint(Text(elements, points + "3 0 1 -1\n")), HasSubstr("names vertex -1"));
  EXPECT_THAT(Complaint(Text(elements, "0 0 0\n1 0 x\n")), HasSubstr("a.ply:11: \"x\""));
  EXPECT_THAT(Complaint("ply\nformat ascii 1.0\nelement vertex 3\n"), HasSubstr("end_header"));
  EXPECT_THAT(Complaint("ply\nformat binary 1.0\nend_header\n"), HasSubstr("a.ply:2: \"binary\""));
}

}  // namespace
}  // namespace insitu
