// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/gltf/gltf_primitive.h"

#include <numeric>

#include "calibration/files/error.h"
#include "renderer/gltf/gltf_draco.h"
#include "renderer/gltf/gltf_json.h"

namespace insitu {
namespace {

enum GltfMode { kTriangleList = 4, kTriangleStrip = 5, kTriangleFan = 6 };

class GltfPrimitiveReader {
 public:
  GltfPrimitiveReader(GltfFile* file, const Json::Value& json, int texture_set, Model* model)
      : file_(file), json_(json), uv_("TEXCOORD_" + std::to_string(texture_set)), model_(*model) {}

  GltfPrimitive Read() {
    const int mode = IndexOf(json_, "mode").value_or(kTriangleList);
    if (mode < kTriangleList) {
      ++model_.skipped[{"points or lines", "no surface"}];
      return {};
    }
    ReadDraco();
    primitive_.positions = Values("POSITION");
    if (primitive_.positions.components != 3) {
      throw InputError(file_->path(), "a mesh has no positions of three coordinates");
    }
    primitive_.normals = LikePositions("NORMAL", 3, 3);
    primitive_.colors = LikePositions("COLOR_0", 3, 4);
    primitive_.uvs = LikePositions(uv_, 2, 2);
    AddTriangles(mode, Indices());
    CountWhatIsNotRead();
    return std::move(primitive_);
  }

 private:
  void ReadDraco() {
    const Json::Value& draco = ExtensionOf(json_, "KHR_draco_mesh_compression");
    if (!draco.isObject()) return;
    std::map<std::string, int> ids;
    const Json::Value& attributes = MemberOf(draco, "attributes");
    if (attributes.isObject()) {
      for (const std::string& name : attributes.getMemberNames()) {
        if (const auto id = IndexOf(attributes, name.c_str())) ids[name] = *id;
      }
    }
    draco_ = DecodeDraco(file_->View(IndexOf(draco, "bufferView").value_or(-1)), ids);
    if (draco_) return;
    throw InputError(file_->path(),
                     "a mesh cannot be decompressed (Draco): it is damaged; export "
                     "it without compression");
  }

  // None: not there.
  GltfValues Values(const std::string& name) {
    if (draco_) {
      const auto found = draco_->attributes.find(name);
      if (found != draco_->attributes.end()) return std::move(found->second);
    }
    const auto accessor = IndexOf(MemberOf(json_, "attributes"), name.c_str());
    return accessor ? ReadGltfAccessor(file_, *accessor) : GltfValues{};
  }
  GltfValues LikePositions(const std::string& name, int fewest, int most) {
    GltfValues values;
    try {
      values = Values(name);
    } catch (const InputError& error) {
      model_.warnings.push_back(std::string(error.what()) + ": " + name + " is left out");
    }
    if (values.components == 0) return {};
    if (values.components >= fewest && values.components <= most &&
        values.count() == primitive_.positions.count()) {
      return values;
    }
    ++model_.skipped[{name, "does not go with the positions"}];
    return {};
  }

  std::vector<uint32_t> Indices() {
    if (draco_) return std::move(draco_->indices);
    if (const auto accessor = IndexOf(json_, "indices")) return ReadGltfIndices(file_, *accessor);
    std::vector<uint32_t> all(primitive_.positions.count());
    std::iota(all.begin(), all.end(), 0u);
    return all;
  }

  void AddTriangles(int mode, const std::vector<uint32_t>& indices) {
    const auto count = static_cast<uint32_t>(primitive_.positions.count());
    for (const uint32_t index : indices) {
      if (index < count) continue;
      throw InputError(file_->path(), "a face names vertex " + std::to_string(index) +
                                          ", expected 0 to " + std::to_string(int64_t{count} - 1));
    }
    const bool is_list = mode == kTriangleList || draco_;
    const size_t step = is_list ? 3 : 1;
    if (is_list && indices.size() % 3 != 0) {
      ++model_.skipped[{"indices", "too few for a last triangle"}];
    }
    primitive_.triangles.reserve(indices.size() / step);
    for (size_t i = 0; i + 2 < indices.size(); i += step) {
      const uint32_t first = mode == kTriangleFan && !is_list ? indices[0] : indices[i];
      const bool turned = !is_list && mode == kTriangleStrip && i % 2 == 1;
      primitive_.triangles.emplace_back(first, indices[turned ? i + 2 : i + 1],
                                        indices[turned ? i + 1 : i + 2]);
    }
  }

  void CountWhatIsNotRead() {
    const Json::Value& attributes = MemberOf(json_, "attributes");
    if (attributes.isObject()) {
      for (const std::string& name : attributes.getMemberNames()) {
        const bool known = name == "POSITION" || name == "NORMAL" || name == "TANGENT" ||
                           name == "COLOR_0" || name == uv_ || name == "TEXCOORD_0";
        if (!known) ++model_.skipped[{name.substr(0, 40), "an attribute that is not shown"}];
      }
    }
    const Json::Value& targets = MemberOf(json_, "targets");
    if (targets.isArray() && !targets.empty()) {
      ++model_.skipped[{"morph targets", "the mesh is shown without them"}];
    }
  }

  GltfFile* file_;
  const Json::Value& json_;
  std::string uv_;
  Model& model_;
  std::optional<DracoMesh> draco_;
  GltfPrimitive primitive_;
};

}  // namespace

GltfPrimitive ReadGltfPrimitive(GltfFile* file, const Json::Value& json, int texture_set,
                                Model* model) {
  return GltfPrimitiveReader(file, json, texture_set, model).Read();
}

}  // namespace insitu
