// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/gltf/gltf_node.h"

#include <set>

#include "calibration/files/error.h"
#include "renderer/gltf/gltf_accessor.h"
#include "renderer/gltf/gltf_json.h"

namespace insitu {
namespace {

using Eigen::Affine3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

// glTF has y up.
Affine3d ZUp() {
  Affine3d z_up = Affine3d::Identity();
  z_up.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return z_up;
}

Affine3d Composed(const Vector3d& shift, const Eigen::Vector4d& xyzw, const Vector3d& scale) {
  Quaterniond rotation(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
  if (!(rotation.norm() > 1e-9)) rotation = Quaterniond::Identity();
  return Eigen::Translation3d(shift) * rotation.normalized() * Eigen::Scaling(scale);
}

Affine3d TransformOf(const Json::Value& node) {
  constexpr int kEntries = 16;
  if (const auto matrix = NumbersOf(node, "matrix", kEntries)) {
    Affine3d transform;
    transform.matrix() = Eigen::Map<const Eigen::Matrix4d>(matrix->data());  // by columns, as ours
    transform.makeAffine();
    return transform;
  }
  const auto shift = NumbersOf(node, "translation", 3), turn = NumbersOf(node, "rotation", 4),
             scale = NumbersOf(node, "scale", 3);
  return Composed(shift ? Vector3d(*shift) : Vector3d::Zero(),
                  turn ? Eigen::Vector4d(*turn) : Eigen::Vector4d::UnitW(),
                  scale ? Vector3d(*scale) : Vector3d::Ones());
}

class GltfNodeReader {
 public:
  GltfNodeReader(GltfFile* file, Model* model) : file_(file), model_(*model) {}

  std::vector<GltfNode> Read() {
    for (const int root : Roots()) Add(root, ZUp(), file_->path().stem().string(), 0);
    return std::move(nodes_);
  }

 private:
  static std::vector<int> IndicesIn(const Json::Value& array) {
    std::vector<int> indices;
    if (!array.isArray()) return indices;
    for (const Json::Value& index : array) {
      if (index.isInt()) indices.push_back(index.asInt());
    }
    return indices;
  }

  std::vector<int> Roots() const {
    const Json::Value& scenes = MemberOf(file_->json(), "scenes");
    if (scenes.isArray() && !scenes.empty()) {
      const int scene = IndexOf(file_->json(), "scene").value_or(0);
      return IndicesIn(MemberOf(file_->Item("scenes", scene, "the file"), "nodes"));
    }
    const Json::Value& nodes = MemberOf(file_->json(), "nodes");
    std::set<int> held;
    for (const Json::Value& node : nodes) {
      for (const int child : IndicesIn(MemberOf(node, "children"))) held.insert(child);
    }
    std::vector<int> roots;
    for (int i = 0; i < static_cast<int>(nodes.size()); ++i) {
      if (!held.contains(i)) roots.push_back(i);
    }
    return roots;
  }

  void Add(int index, const Affine3d& world_from_parent, const std::string& above, int depth) {
    constexpr int kDeepest = 1000, kMost = 10'000'000;
    if (depth > kDeepest) throw InputError(file_->path(), "nodes within nodes, over 1000 deep");
    if (++visited_ > kMost) throw InputError(file_->path(), "has over ten million nodes");
    const Json::Value& json = file_->Item("nodes", index, "a scene or node");
    if (MemberOf(ExtensionOf(json, "KHR_node_visibility"), "visible") == Json::Value(false)) {
      ++model_.skipped[{"node", "said to be invisible, with what is below it"}];
      return;
    }
    const Affine3d world_from_node = world_from_parent * TransformOf(json);
    const std::string name = TextOf(json, "name");
    GltfNode node{.layer = name.empty() ? above : name,
                  .world_from_node = {},
                  .mesh = IndexOf(json, "mesh").value_or(-1),
                  .light = IndexOf(ExtensionOf(json, "KHR_lights_punctual"), "light").value_or(-1)};
    if (node.mesh >= 0) {
      node.world_from_node = Instances(json, world_from_node);
      if (IndexOf(json, "skin")) ++model_.skipped[{"skin", "its mesh is shown at rest"}];
    } else {
      node.world_from_node = {world_from_node};
    }
    if (IndexOf(json, "camera")) ++model_.skipped[{"camera", "no surface"}];
    const std::string layer = node.layer;
    if (node.mesh >= 0 || node.light >= 0) nodes_.push_back(std::move(node));
    for (const int child : IndicesIn(MemberOf(json, "children"))) {
      Add(child, world_from_node, layer, depth + 1);
    }
  }

  std::vector<Affine3d> Instances(const Json::Value& json, const Affine3d& world_from_node) {
    const Json::Value& attributes =
        MemberOf(ExtensionOf(json, "EXT_mesh_gpu_instancing"), "attributes");
    if (!attributes.isObject()) return {world_from_node};
    const GltfValues shifts = InstanceValues(attributes, "TRANSLATION", 3);
    const GltfValues turns = InstanceValues(attributes, "ROTATION", 4);
    const GltfValues scales = InstanceValues(attributes, "SCALE", 3);
    const int count = std::max({shifts.count(), turns.count(), scales.count()});
    std::vector<Affine3d> instances;
    for (int i = 0; i < count; ++i) {
      const auto row =
          [i]<int n>(const GltfValues& values,
                     const Eigen::Matrix<double, n, 1>& other) -> Eigen::Matrix<double, n, 1> {
        if (i >= values.count()) return other;
        return Eigen::Map<const Eigen::Matrix<double, n, 1>>(values.numbers.data() + i * n);
      };
      instances.push_back(world_from_node *
                          Composed(row(shifts, Vector3d(Vector3d::Zero())),
                                   row(turns, Eigen::Vector4d(Eigen::Vector4d::UnitW())),
                                   row(scales, Vector3d(Vector3d::Ones()))));
    }
    return instances;
  }
  GltfValues InstanceValues(const Json::Value& attributes, const char* name, int components) {
    const auto accessor = IndexOf(attributes, name);
    if (!accessor) return {};
    GltfValues values = ReadGltfAccessor(file_, *accessor);
    if (values.components == components) return values;
    throw InputError(file_->path(), std::string("an instance's ") + name + " is of another size");
  }

  GltfFile* file_;
  Model& model_;
  std::vector<GltfNode> nodes_;
  int visited_ = 0;
};

}  // namespace

std::vector<GltfNode> ReadGltfNodes(GltfFile* file, Model* model) {
  return GltfNodeReader(file, model).Read();
}

}  // namespace insitu
