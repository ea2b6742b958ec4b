// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer's way in: any bytes as a model file (scripts/fuzz convert). Bad input must end in an
// InputError, everything else in a mesh whose indices are sound.
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>

#include "calibration/files/error.h"
#include "renderer/formats/model_file.h"
#include "renderer/mesh/solids.h"

namespace insitu {
namespace {

// In a folder of its own: the files that a model names are sought about it.
const std::filesystem::path& FuzzedFile() {
  static const std::filesystem::path path = [] {
    const std::string name = "convert_fuzzer_" + std::to_string(getpid());
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / name;
    std::filesystem::create_directories(folder);
    return folder / "model";
  }();
  return path;
}

void Check(const ModelMesh& mesh) {
  const int vertices = static_cast<int>(mesh.vertices.size());
  if (mesh.surface_of_triangle.size() != mesh.triangles.size()) std::abort();
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    if (triangle.minCoeff() < 0 || triangle.maxCoeff() >= vertices) std::abort();
  }
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    if (!vertex.allFinite()) std::abort();
  }
  for (const ModelSphere& sphere : mesh.spheres) {
    if (!sphere.center.allFinite() || !(sphere.radius > 0)) std::abort();
    if (sphere.surface < 0 || sphere.surface >= std::ssize(mesh.surfaces)) std::abort();
  }
}

}  // namespace
}  // namespace insitu

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  std::ofstream(insitu::FuzzedFile(), std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  insitu::ImportOptions options;
  options.dxf.most_pieces = 500000;  // sanitized code takes ten times as long
  options.dxf.chord_tolerance = 0.05;
  options.seconds = 5;
  try {
    insitu::Model model = insitu::ReadModel(insitu::FuzzedFile(), options);
    insitu::Check(model.mesh);
    insitu::MendSolids(&model.mesh);
    insitu::Check(model.mesh);
  } catch (const insitu::InputError&) {
  }
  return 0;
}
