// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/gltf/gltf_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "calibration/files/error.h"
#include "calibration/files/wording.h"
#include "renderer/foreign/mesh_builder.h"
#include "renderer/foreign/single_precision.h"
#include "renderer/gltf/gltf_extensions.h"
#include "renderer/gltf/gltf_json.h"
#include "renderer/gltf/gltf_material.h"
#include "renderer/gltf/gltf_node.h"
#include "renderer/gltf/gltf_primitive.h"

namespace insitu {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

class GltfReader {
 public:
  explicit GltfReader(GltfFile* file) : file_(*file), builder_(file->path(), &model_) {}

  Model Read() {
    model_.format = "glTF";
    model_.metres_per_unit = 1;  // by its definition
    model_.warnings = CheckGltfExtensions(file_);
    for (const GltfNode& node : ReadGltfNodes(&file_, &model_)) {
      if (node.light >= 0) AddLamp(node);
      if (node.mesh >= 0) AddMesh(node);
    }
    CountWhatIsNotShown();
    WarnOfPrecision();
    model_.files = file_.files();
    builder_.Finish();
    return std::move(model_);
  }

 private:
  void AddMesh(const GltfNode& node) {
    const Json::Value& mesh = file_.Item("meshes", node.mesh, "a node");
    const Json::Value& primitives = MemberOf(mesh, "primitives");
    if (!primitives.isArray()) return;
    for (int i = 0; i < static_cast<int>(primitives.size()); ++i) {
      const std::optional<int> material_index = IndexOf(primitives[i], "material");
      GltfMaterial material;
      if (material_index && file_.Find("materials", *material_index).isNull()) {
        ++model_.skipped[{"material", "a mesh names one that is not there"}];
      } else if (material_index) {
        material = MaterialOf(*material_index);
      }
      const GltfPrimitive& primitive =
          PrimitiveOf({node.mesh, i}, primitives[i], material.texture_set);
      if (primitive.triangles.empty()) continue;
      material.names.layer = node.layer;
      for (const Affine3d& world_from_node : node.world_from_node) {
        AddPrimitive(primitive, material, world_from_node);
      }
    }
  }

  const GltfMaterial& MaterialOf(int index) {
    const auto found = materials_.find(index);
    if (found != materials_.end()) return found->second;
    return materials_[index] = ReadGltfMaterial(&file_, index, &model_);
  }
  const GltfPrimitive& PrimitiveOf(const std::pair<int, int>& key, const Json::Value& json,
                                   int texture_set) {
    const auto found = primitives_.find(key);
    if (found != primitives_.end()) return found->second;
    return primitives_[key] = ReadGltfPrimitive(&file_, json, texture_set, &model_);
  }

  void AddPrimitive(const GltfPrimitive& primitive, const GltfMaterial& material,
                    const Affine3d& world_from_node) {
    constexpr size_t kMostTriangles = 200'000'000;
    if (model_.mesh.triangles.size() + primitive.triangles.size() > kMostTriangles) {
      throw InputError(file_.path(), "has over 200 million triangles with its instances");
    }
    ++model_.entities["mesh"];
    model_.entities["face"] += static_cast<int>(primitive.triangles.size());
    if (primitive.colors.components > 0) builder_.SayColorsByVertex();
    const int first = static_cast<int>(model_.mesh.vertices.size());
    for (int i = 0; i < primitive.positions.count(); ++i) {
      const Vector3d here = Eigen::Map<const Vector3d>(primitive.positions.numbers.data() + 3 * i);
      largest_local_ = std::max(largest_local_, here.cwiseAbs().maxCoeff());
      builder_.AddVertex(world_from_node * here, material.names.layer);
    }
    const Eigen::Matrix3d turn = world_from_node.linear().inverse().transpose();
    const bool mirrored = world_from_node.linear().determinant() < 0;
    const int surface = builder_.SurfaceOf(material.names);
    for (Eigen::Vector3i triangle : primitive.triangles) {
      if (mirrored) std::swap(triangle[1], triangle[2]);
      AddTriangle(primitive, material, turn, first, triangle, surface);
    }
  }

  void AddTriangle(const GltfPrimitive& primitive, const GltfMaterial& material,
                   const Eigen::Matrix3d& turn, int first, const Eigen::Vector3i& triangle,
                   int surface) {
    face_.Clear();
    Vector3d color = Vector3d::Zero();
    for (const int v : triangle) {
      face_.corners.push_back(first + v);
      if (primitive.normals.components > 0) {
        const Vector3d normal =
            turn * Eigen::Map<const Vector3d>(primitive.normals.numbers.data() + 3 * v);
        face_.normals.push_back(normal.normalized().cast<float>());
      }
      if (primitive.uvs.components > 0) {
        const Eigen::Vector2d uv =
            material.image_from_texture *
            Eigen::Vector2d(primitive.uvs.numbers[2 * v], primitive.uvs.numbers[2 * v + 1]);
        face_.uvs.emplace_back(static_cast<float>(uv.x()), static_cast<float>(1 - uv.y()));
      }
      if (primitive.colors.components > 0) {
        const int size = primitive.colors.components;
        color += Eigen::Map<const Vector3d>(primitive.colors.numbers.data() + size * v) / 3;
      }
    }
    const bool colored = primitive.colors.components > 0;
    builder_.AddFace(face_, colored ? builder_.ColoredSurface(surface, color) : surface);
  }

  void AddLamp(const GltfNode& node) {
    const Json::Value& lights =
        MemberOf(ExtensionOf(file_.json(), "KHR_lights_punctual"), "lights");
    if (!lights.isArray() || node.light >= static_cast<int>(lights.size())) {
      ++model_.skipped[{"light", "a node names one that is not there"}];
      return;
    }
    const Json::Value& light = lights[node.light];
    const std::string type = TextOf(light, "type");
    if (type != "point" && type != "spot") {
      ++model_.skipped[{Quoted(type) + " light", "light from afar is the site's own"}];
      return;
    }
    constexpr double kDegree = std::numbers::pi / 180;
    ModelLamp lamp;
    lamp.name = TextOf(light, "name").empty() ? node.layer : TextOf(light, "name");
    const Affine3d& world_from_node = node.world_from_node.front();
    lamp.position = world_from_node.translation();
    lamp.direction = (world_from_node.linear() * -Vector3d::UnitZ()).normalized();
    lamp.candela = std::max(0.0, NumberOf(light, "intensity", 1));
    if (const auto color = NumbersOf(light, "color", 3)) lamp.rgb = color->cwiseMax(0).cwiseMin(1);
    if (type == "spot") {
      const Json::Value& spot = MemberOf(light, "spot");
      lamp.inner_deg = NumberOf(spot, "innerConeAngle", 0) / kDegree;
      lamp.outer_deg = NumberOf(spot, "outerConeAngle", std::numbers::pi / 4) / kDegree;
    }
    model_.lamps.push_back(lamp);
  }

  void CountWhatIsNotShown() {
    const Json::Value& animations = MemberOf(file_.json(), "animations");
    if (animations.isArray() && !animations.empty()) {
      model_.skipped[{"animation", "shown at rest"}] += static_cast<int>(animations.size());
    }
    const Json::Value& scenes = MemberOf(file_.json(), "scenes");
    if (scenes.isArray() && scenes.size() > 1) {
      model_.skipped[{"scene", "the file shows another"}] += static_cast<int>(scenes.size()) - 1;
    }
  }

  // Positions are stored in single precision, whatever we do.
  void WarnOfPrecision() {
    const std::string note = SinglePrecisionNote(file_.path(), largest_local_);
    if (!note.empty()) model_.warnings.push_back(note);
  }

  GltfFile& file_;
  Model model_;
  MeshBuilder builder_;
  BuiltFace face_;
  std::map<int, GltfMaterial> materials_;
  std::map<std::pair<int, int>, GltfPrimitive> primitives_;
  double largest_local_ = 0;
};

}  // namespace

Model ReadGltf(GltfFile file) { return GltfReader(&file).Read(); }

}  // namespace insitu
