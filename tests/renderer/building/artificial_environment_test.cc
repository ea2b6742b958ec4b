// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/artificial_environment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/files/error.h"
#include "calibration/files/whole_file.h"
#include "renderer/building/shown_environment.h"
#include "tests/calibration/files/scratch_folder.h"

namespace insitu {
namespace {

using testing::HasSubstr;

ArtificialEnvironment GlazedTriangle() {
  ArtificialEnvironment environment;
  environment.materials = {
      {"WALL", {0.1, 1.0 / 3, 0.7}, 0.9, std::nullopt, {}, "wall.png"},
      {"GLASS", {0.03, 0.03, 0.03}, 1, Specular{0.8, 1.52, {0.1, FacetDistribution::kBeckmann}}},
      {"MIRROR", {0, 0, 0}, 1, Specular{1, std::nullopt}}};
  environment.materials[1].glass = Glass{0.9, true, 1.52, 0.004, {3, 2, 1}};
  environment.materials[2].specular_rgb = {0.9, 0.7, 0.4};
  environment.materials[2].metal = Metal{{{400, 1.5}, {700, 0.2}}, {{400, 1.9}, {700, 3.9}}};
  environment.vertices = {
      {2600000.1, 1200000.2, 400.3}, {2600001, 1200000, 1.0 / 3}, {0, -1, 1e-9}};
  environment.triangles = {{0, 1, 2}, {2, 1, 0}};
  environment.material_of_triangle = {2, 0};
  environment.spheres = {{{2600000.7, 1200000, 400 + 1.0 / 3}, 1.0 / 7, 1}};
  environment.lights = {{"lamp", {1, 2, 3}, {0.5, 0, 1e-7}}};
  return environment;
}

// What reading a site's description says; empty if it is read.
std::string Complaint(const SitePaths& site) {
  try {
    ReadArtificialEnvironment(site);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// Puts `with` in the place of `what` in building.json.
void Edit(const SitePaths& site, const std::string& what, const std::string& with) {
  std::string json = ReadWhole(site.artificial());
  ASSERT_NE(json.find(what), std::string::npos) << json;
  WriteWhole(site.artificial(), json.replace(json.find(what), what.size(), with));
}

TEST(ArtificialEnvironment, ReturnsFromItsFilesToTheLastBit) {
  const ScratchFolder folder;
  const SitePaths site{folder.path()};
  const ArtificialEnvironment written = GlazedTriangle();
  WriteArtificialEnvironment(site, written);
  const ArtificialEnvironment read = ReadArtificialEnvironment(site);
  EXPECT_EQ(read.vertices, written.vertices);
  EXPECT_EQ(read.triangles, written.triangles);
  EXPECT_EQ(read.material_of_triangle, written.material_of_triangle);
  ASSERT_EQ(read.materials.size(), 3u);
  for (int m = 0; m < 3; ++m) {
    EXPECT_EQ(read.materials[m].name, written.materials[m].name);
    EXPECT_EQ(read.materials[m].diffuse_rgb, written.materials[m].diffuse_rgb);
    EXPECT_EQ(read.materials[m].diffuse_weight, written.materials[m].diffuse_weight);
  }
  EXPECT_FALSE(read.materials[0].specular);
  EXPECT_EQ(read.materials[1].specular->weight, 0.8);
  EXPECT_EQ(read.materials[1].specular->index, 1.52);
  EXPECT_EQ(read.materials[2].specular->index, std::nullopt);
  ASSERT_EQ(read.spheres.size(), 1u);
  EXPECT_EQ(read.spheres[0].center, written.spheres[0].center);
  EXPECT_EQ(read.spheres[0].radius, 1.0 / 7);
  EXPECT_EQ(read.spheres[0].material, 1);
  ASSERT_EQ(read.lights.size(), 1u);
  EXPECT_EQ(read.lights[0].name, "lamp");
  EXPECT_EQ(read.lights[0].position, written.lights[0].position);
  EXPECT_EQ(read.lights[0].intensity_rgb, written.lights[0].intensity_rgb);
}

TEST(ArtificialEnvironment, OfTheVersionBeforeHasNoSpheres) {
  const ScratchFolder folder;
  const SitePaths site{folder.path()};
  ArtificialEnvironment written = GlazedTriangle();
  WriteArtificialEnvironment(site, written);
  Edit(site, "\"version\" : 4", "\"version\" : 3");
  EXPECT_TRUE(ReadArtificialEnvironment(site).spheres.empty());
  written.spheres[0].material = 3;
  WriteArtificialEnvironment(site, written);
  EXPECT_THAT(Complaint(site), HasSubstr("names a material that is not there"));
}

TEST(ArtificialEnvironment, FacetsCanStandForItsSpheres) {
  ArtificialEnvironment building = GlazedTriangle();
  building.corner_uvs.assign(6, Eigen::Vector2f(1, 2));
  building.corner_normals.assign(6, Eigen::Vector3f(0, 0, 1));
  const ArtificialEnvironment faceted = Faceted(building, 2);
  EXPECT_TRUE(faceted.spheres.empty());
  ASSERT_EQ(faceted.triangles.size(), 2u + 128);
  EXPECT_EQ(faceted.material_of_triangle.back(), 1);
  EXPECT_EQ(faceted.corner_uvs.size(), 3 * faceted.triangles.size());
  EXPECT_EQ(faceted.corner_normals.size(), 3 * faceted.triangles.size());
  for (const int corner : faceted.triangles.back()) {
    const Eigen::Vector3d out = faceted.vertices[corner] - building.spheres[0].center;
    EXPECT_NEAR(out.norm(), 1.0 / 7, 1e-9);
  }
}

TEST(ArtificialEnvironment, KeepsEveryFieldOfItsMaterialsAndLights) {
  const ScratchFolder folder;
  ArtificialEnvironment written = GlazedTriangle();
  written.materials[0].texture_size = {1.5, 0.75};
  written.materials[2].reflectance = {{400, 0.1}, {700, 0.9}};
  written.corner_normals.assign(6, Eigen::Vector3f(0, 0.6f, 0.8f));
  written.corner_uvs = {{0, 0}, {1, 0}, {0, 1}, {0.5f, 0.25f}, {2, 2}, {-1, 3}};
  written.lights[0].distribution =
      LightDistribution{Eigen::Matrix3d::Identity(), {0, 30, 90}, {0, 90}, {1, 0.5, 0, 1, 0.4, 0}};
  written.lights[0].spectrum = {{380, 1}, {780, 2}};
  written.lights[0].candela = 120;
  written.lights[0].radius = 0.09;
  written.lights[0].edge_u = {1, 0, 0};
  written.lights[0].edge_v = {0, 2, 0};
  written.lights[0].is_visible = true;
  WriteArtificialEnvironment(SitePaths{folder.path()}, written);
  const ArtificialEnvironment read = ReadArtificialEnvironment({folder.path()});
  EXPECT_EQ(read.materials[0].texture, "wall.png");
  EXPECT_EQ(read.materials[0].texture_size, Eigen::Vector2d(1.5, 0.75));
  EXPECT_FALSE(read.materials[1].texture_size);
  EXPECT_EQ(read.materials[1].specular->roughness, (Roughness{0.1, FacetDistribution::kBeckmann}));
  ASSERT_TRUE(read.materials[1].glass);
  EXPECT_EQ(read.materials[1].glass->weight, 0.9);
  EXPECT_TRUE(read.materials[1].glass->is_solid);
  EXPECT_EQ(read.materials[1].glass->index, 1.52);
  EXPECT_EQ(read.materials[1].glass->thickness, 0.004);
  EXPECT_EQ(read.materials[1].glass->absorption_rgb, Eigen::Vector3d(3, 2, 1));
  EXPECT_EQ(read.materials[2].specular_rgb, Eigen::Vector3d(0.9, 0.7, 0.4));
  ASSERT_TRUE(read.materials[2].metal);
  EXPECT_EQ(read.materials[2].metal->extinction, written.materials[2].metal->extinction);
  EXPECT_EQ(read.materials[2].reflectance, written.materials[2].reflectance);
  EXPECT_EQ(read.corner_normals, written.corner_normals);
  EXPECT_EQ(read.corner_uvs, written.corner_uvs);
  ASSERT_TRUE(read.lights[0].distribution);
  EXPECT_EQ(read.lights[0].distribution->values, written.lights[0].distribution->values);
  EXPECT_EQ(read.lights[0].spectrum, written.lights[0].spectrum);
  EXPECT_EQ(read.lights[0].candela, 120);
  EXPECT_EQ(read.lights[0].radius, 0.09);
  EXPECT_EQ(read.lights[0].edge_u, Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(read.lights[0].edge_v, Eigen::Vector3d(0, 2, 0));
  EXPECT_TRUE(read.lights[0].is_visible);
  EXPECT_TRUE(NotShown(read).empty());
}

TEST(ArtificialEnvironment, SameInputSameBytes) {
  const ScratchFolder one, two;
  for (const ScratchFolder* folder : {&one, &two}) {
    WriteArtificialEnvironment(SitePaths{folder->path()}, GlazedTriangle());
  }
  for (const char* name : {"work/building.json", "work/building.bin"}) {
    EXPECT_EQ(ReadWhole(one.path() / name), ReadWhole(two.path() / name));
  }
}

TEST(ArtificialEnvironment, EmptyBuildingIsOne) {
  const ScratchFolder folder;
  WriteArtificialEnvironment(SitePaths{folder.path()}, {});
  EXPECT_TRUE(ReadArtificialEnvironment({folder.path()}).triangles.empty());
}

TEST(ArtificialEnvironment, FilesThatDoNotBelongTogether) {
  const ScratchFolder folder;
  const SitePaths site{folder.path()};
  WriteArtificialEnvironment(site, GlazedTriangle());
  std::string mesh = ReadWhole(folder.path() / "work/building.bin");
  WriteWhole(folder.path() / "work/building.bin", mesh.substr(0, mesh.size() - 1));
  EXPECT_THAT(Complaint(site), HasSubstr("building.bin: does not belong to building.json"));
  mesh[5] ^= 1;
  WriteWhole(folder.path() / "work/building.bin", mesh);
  EXPECT_THAT(Complaint(site), HasSubstr("building.bin: does not belong to building.json"));
  std::filesystem::remove(folder.path() / "work/building.bin");
  EXPECT_THAT(Complaint(site), HasSubstr("building.bin"));
}

TEST(ArtificialEnvironment, BadInput) {
  const ScratchFolder folder;
  const SitePaths site{folder.path()};
  EXPECT_THAT(Complaint(site), HasSubstr("building.json"));
  WriteArtificialEnvironment(site, GlazedTriangle());
  Edit(site, "\"vertices\" : 3", "\"vertices\" : -3");
  EXPECT_THAT(Complaint(site), HasSubstr("is negative, expected a count"));
  WriteArtificialEnvironment(site, GlazedTriangle());
  Edit(site, "\"version\" : 4", "\"version\" : 7");
  EXPECT_THAT(Complaint(site), HasSubstr("is not a version this program reads, expected 4"));
}

TEST(ArtificialEnvironment, IndicesOutOfRange) {
  const ScratchFolder folder;
  const SitePaths site{folder.path()};
  ArtificialEnvironment faulty = GlazedTriangle();
  faulty.triangles[1][2] = 3;
  WriteArtificialEnvironment(site, faulty);
  EXPECT_THAT(Complaint(site), HasSubstr("triangle 1 names a vertex or a material"));
  faulty = GlazedTriangle();
  faulty.material_of_triangle[0] = -1;
  WriteArtificialEnvironment(site, faulty);
  EXPECT_THAT(Complaint(site), HasSubstr("triangle 0 names a vertex or a material"));
}

}  // namespace
}  // namespace insitu
