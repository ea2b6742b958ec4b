// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/formats/assimp_model.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <string_view>
#include <utility>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "calibration/files/wording.h"
#include "calibration/files/xml_file.h"
#include "calibration/photo/photograph.h"
#include "renderer/formats/cut_short.h"
#include "renderer/formats/file_reference.h"
#include "renderer/formats/isolated.h"
#include "renderer/formats/ply_syntax.h"
#include "renderer/mesh/face_triangles.h"

namespace insitu {
namespace {

namespace fs = std::filesystem;
using Eigen::Affine3d;
using Eigen::Vector3d;

constexpr char kColorsOnly[] = "its faces are shown, these colours are not";
constexpr double kLargestCoordinate = 1e12;  // [m]

Affine3d ToEigen(const aiMatrix4x4& m) {
  Affine3d result = Affine3d::Identity();
  result.matrix().topRows<3>() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3,
      m.c4;
  return result;
}

// These formats have y up, by their definition or by Assimp's doing.
Affine3d ZUpFrom(ModelFormat format) {
  Affine3d z_up = Affine3d::Identity();
  if (format == ModelFormat::kGltf || format == ModelFormat::kCollada) {
    z_up.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  }
  return z_up;
}

// glTF's colours are linear by its definition; the others' are what a screen shows.
Vector3d LinearColor(ModelFormat format, const aiColor4D& color) {
  Vector3d rgb = Vector3d(color.r, color.g, color.b).cwiseMax(0).cwiseMin(1);
  if (!rgb.allFinite()) return Vector3d::Constant(0.5);
  if (format != ModelFormat::kGltf) {
    for (double& channel : rgb) channel = LinearFromSrgb(channel);
  }
  return rgb;
}

class SceneReader {
 public:
  SceneReader(const fs::path& path, ModelFormat format, const aiScene& scene)
      : path_(path), format_(format), scene_(scene), index_(&model_.mesh.surfaces) {}

  Model Read() {
    const ModelMesh& mesh = model_.mesh;
    AddNode(*scene_.mRootNode, ZUpFrom(format_), path_.stem().string(), 0);
    AddImages();
    if (!has_uvs_) model_.mesh.corner_uvs.clear();
    if (!has_normals_) model_.mesh.corner_normals.clear();
    double largest = 0;
    for (const Vector3d& v : mesh.vertices) largest = std::max(largest, v.cwiseAbs().maxCoeff());
    WarnOfPrecision(largest);
    DropUnused(&model_.mesh);
    return std::move(model_);
  }

 private:
  void AddNode(const aiNode& node, const Affine3d& world_from_parent, const std::string& layer,
               int depth) {
    constexpr int kDeepest = 1000;
    if (depth > kDeepest) throw InputError(path_, "nodes within nodes, more than 1000 deep");
    const Affine3d world_from_node = world_from_parent * ToEigen(node.mTransformation);
    const std::string name = node.mName.C_Str();
    const bool is_named =
        !name.empty() && name.front() != '$' && name.find('<') == std::string::npos;
    const std::string& own_layer = is_named ? name : layer;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      AddMesh(*scene_.mMeshes[node.mMeshes[i]], world_from_node, own_layer);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
      AddNode(*node.mChildren[i], world_from_node, own_layer, depth + 1);
    }
  }

  void AddMesh(const aiMesh& mesh, const Affine3d& world_from_node, const std::string& layer) {
    ++model_.entities["mesh"];
    if (mesh.HasVertexColors(0)) ++model_.skipped[{"mesh with colours by vertex", kColorsOnly}];
    if (mesh.HasTextureCoords(1)) {
      ++model_.skipped[{"second set of texture coordinates", "only the first is read"}];
    }
    const int first = static_cast<int>(model_.mesh.vertices.size());
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D& v = mesh.mVertices[i];
      const Vector3d point = world_from_node * Vector3d(v.x, v.y, v.z);
      if (!(point.cwiseAbs().maxCoeff() <= kLargestCoordinate)) {
        throw InputError(path_, "a vertex of \"" + layer + "\" is not finite or beyond 1e12 m");
      }
      model_.mesh.vertices.push_back(point);
    }
    const int surface = index_.IndexOf(NamesOf(mesh, layer));
    const bool mirrored = world_from_node.linear().determinant() < 0;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      AddFace(mesh, mesh.mFaces[f], first, mirrored, surface, world_from_node);
    }
  }

  void AddFace(const aiMesh& mesh, const aiFace& face, int first, bool mirrored, int surface,
               const Affine3d& world_from_node) {
    if (face.mNumIndices < 3) {
      ++model_.skipped[{"line or point", "no surface"}];
      return;
    }
    if (face.mNumIndices > kMostCorners) {
      throw InputError(path_, "a face has over 10000 corners");
    }
    ++model_.entities["face"];
    std::vector<int> corners;
    for (unsigned i = 0; i < face.mNumIndices; ++i) {
      if (face.mIndices[i] >= mesh.mNumVertices) {
        throw InputError(path_, "a face names vertex " + std::to_string(face.mIndices[i]) +
                                    ", expected 0 to " + std::to_string(mesh.mNumVertices - 1));
      }
      corners.push_back(first + static_cast<int>(face.mIndices[i]));
    }
    const auto triangles = FaceTriangles(model_.mesh.vertices, corners);
    if (triangles.empty()) ++model_.degenerate_faces;
    for (Eigen::Vector3i triangle : triangles) {
      if (mirrored) std::swap(triangle[1], triangle[2]);
      model_.mesh.triangles.push_back(triangle);
      model_.mesh.surface_of_triangle.push_back(surface);
      AddCorners(mesh, triangle, first, world_from_node);
    }
  }

  void AddCorners(const aiMesh& mesh, const Eigen::Vector3i& triangle, int first,
                  const Affine3d& world_from_node) {
    const std::vector<Vector3d>& all = model_.mesh.vertices;
    const Vector3d facet = (all[triangle[1]] - all[triangle[0]])
                               .cross(all[triangle[2]] - all[triangle[0]])
                               .normalized();
    for (const int corner : triangle) {
      const int i = corner - first;
      Vector3d normal = facet;
      if (mesh.HasNormals()) {
        const aiVector3D& n = mesh.mNormals[i];
        const Vector3d turned =
            world_from_node.linear().inverse().transpose() * Vector3d(n.x, n.y, n.z);
        if (turned.allFinite() && turned.norm() > 1e-9) normal = turned.normalized();
        has_normals_ = true;
      }
      model_.mesh.corner_normals.push_back(normal.cast<float>());
      Eigen::Vector2f uv(0, 0);
      if (mesh.HasTextureCoords(0)) {
        uv = {mesh.mTextureCoords[0][i].x, mesh.mTextureCoords[0][i].y};
        if (!uv.allFinite()) uv.setZero();
        has_uvs_ = true;
      }
      model_.mesh.corner_uvs.push_back(uv);
    }
  }

  SurfaceNames NamesOf(const aiMesh& mesh, const std::string& layer) const {
    SurfaceNames names;
    names.layer = layer;
    if (mesh.mMaterialIndex >= scene_.mNumMaterials) return names;
    const aiMaterial& material = *scene_.mMaterials[mesh.mMaterialIndex];
    aiString text;
    if (material.Get(AI_MATKEY_NAME, text) == AI_SUCCESS) names.material = text.C_Str();
    if (names.material == AI_DEFAULT_MATERIAL_NAME) names.material.clear();
    aiColor4D color;
    if (!names.material.empty() && material.Get(AI_MATKEY_COLOR_DIFFUSE, color) == AI_SUCCESS) {
      names.rgb = LinearColor(format_, color);
    }
    float opacity = 1;
    const bool is_opaque = format_ == ModelFormat::kGltf &&
                           material.Get("$mat.gltf.alphaMode", 0, 0, text) == AI_SUCCESS &&
                           std::string_view(text.C_Str()) == "OPAQUE";  // whatever alpha says
    if (!is_opaque && material.Get(AI_MATKEY_OPACITY, opacity) == AI_SUCCESS && opacity >= 0 &&
        opacity < 1) {
      names.opacity = opacity;
    }
    if (material.GetTexture(aiTextureType_DIFFUSE, 0, &text) == AI_SUCCESS) {
      names.texture = text.C_Str();
      names.texture_place = path_.string();
    }
    return names;
  }

  // Of height 0 are those in a file format of their own, of `mWidth` bytes.
  void AddImages() {
    for (unsigned i = 0; i < scene_.mNumTextures; ++i) {
      const aiTexture& image = *scene_.mTextures[i];
      if (image.mHeight != 0) continue;
      model_.images["*" + std::to_string(i)] = {reinterpret_cast<const char*>(image.pcData),
                                                image.mWidth};
    }
  }

  void WarnOfPrecision(double largest) {
    const double step = largest * std::numeric_limits<float>::epsilon();
    if (step < 1e-3) return;
    const std::string text = Formatted(
        "coordinates up to %.0f m are read in single precision, to %.3f m: export about "
        "a local origin and place it with placement.json",
        largest, step);
    model_.warnings.push_back(InputError(path_, text).what());
  }

  fs::path path_;
  ModelFormat format_;
  const aiScene& scene_;
  Model model_;
  SurfaceIndex index_;
  bool has_uvs_ = false, has_normals_ = false;
};

bool IsGlb(const fs::path& path) {
  char magic[4] = {};
  std::ifstream(path, std::ios::binary).read(magic, sizeof(magic));
  return std::string_view(magic, sizeof(magic)) == "glTF";
}

const char* EndingFor(ModelFormat format, const fs::path& path) {
  if (format == ModelFormat::kCollada) return ".dae";
  if (format == ModelFormat::kPly) return ".ply";
  return IsGlb(path) ? ".glb" : ".gltf";
}

// Assimp goes by the ending; a file that ends otherwise is shown to it under another name.
class RenamingIo : public Assimp::DefaultIOSystem {
 public:
  RenamingIo(std::string shown, std::string real)
      : shown_(std::move(shown)), real_(std::move(real)) {}
  bool Exists(const char* name) const override {
    return DefaultIOSystem::Exists(Real(name).c_str());
  }
  Assimp::IOStream* Open(const char* name, const char* mode) override {
    return DefaultIOSystem::Open(Real(name).c_str(), mode);
  }

 private:
  // Files that the model names are found as FindReference finds them.
  std::string Real(const char* name) const {
    if (name == shown_) return real_;
    std::error_code none;
    if (fs::is_regular_file(name, none)) return name;
    const auto found = FindReference(real_, name);
    return found ? found->string() : name;
  }
  std::string shown_, real_;
};

Model ReadHere(const fs::path& path, ModelFormat format) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
  std::string shown = path.string();
  const std::string ending = EndingFor(format, path);
  if (path.extension() != ending) shown += ending;
  importer.SetIOHandler(new RenamingIo(shown, path.string()));  // the importer's from here on
  const aiScene* scene = importer.ReadFile(shown, 0);
  if (!scene || !scene->mRootNode) {
    throw InputError(path, std::string("is not read: ") + importer.GetErrorString());
  }
  return SceneReader(path, format, *scene).Read();
}

const char* NameOf(ModelFormat format) {
  switch (format) {
    case ModelFormat::kGltf:
      return "glTF";
    case ModelFormat::kCollada:
      return "COLLADA";
    default:
      return "PLY";
  }
}

// A small file that takes longer never ends.
int SecondsFor(const fs::path& path) {
  constexpr double kLeast = 8, kPerByte = 30e-6, kMost = 1e6;
  return static_cast<int>(
      std::min(kMost, kLeast + kPerByte * static_cast<double>(fs::file_size(path))));
}

Json::Value GltfJson(const fs::path& path) {
  if (!IsGlb(path)) return ReadJson(path);
  uint32_t head[5] = {};  // "glTF", version, length; length and kind of the JSON chunk
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(head), sizeof(head));
  const uint64_t rest = fs::file_size(path) - std::min<uint64_t>(fs::file_size(path), sizeof(head));
  std::string text(std::min<uint64_t>(head[3], rest), '\0');
  file.read(text.data(), std::ssize(text));
  return ParseJson(path, text);
}

std::vector<std::string> ExtensionNames(const Json::Value& json, const char* list) {
  std::vector<std::string> names;
  if (!json.isObject() || !json[list].isArray()) return names;
  for (const Json::Value& name : json[list]) {
    if (name.isString()) names.push_back(name.asString());
  }
  return names;
}

// What Assimp reads, or what changes nothing that is shown.
bool IsUnderstood(const std::string& extension) {
  static const std::set<std::string> kUnderstood = {
      "KHR_materials_unlit", "KHR_materials_pbrSpecularGlossiness", "KHR_materials_sheen",
      "KHR_materials_clearcoat"};
  return kUnderstood.contains(extension);
}

// The specification demands that a required extension that is not understood refuses the file.
std::vector<std::string> CheckGltfExtensions(const fs::path& path) {
  const Json::Value json = GltfJson(path);
  for (const std::string& name : ExtensionNames(json, "extensionsRequired")) {
    if (IsUnderstood(name)) continue;
    throw InputError(path, "requires the glTF extension " + name.substr(0, 60) +
                               ", which is not read: export it without (no compression, no "
                               "quantisation, no instancing), or as OBJ, IFC or DXF");
  }
  std::vector<std::string> warnings;
  for (const std::string& name : ExtensionNames(json, "extensionsUsed")) {
    if (IsUnderstood(name)) continue;
    warnings.push_back(InputError(path, "uses the glTF extension " + name.substr(0, 60) +
                                            ", which is not read: what it says is left out")
                           .what());
  }
  return warnings;
}

void CheckGlb(const fs::path& path) {
  uint32_t head[3] = {};  // "glTF", version, length
  std::ifstream(path, std::ios::binary).read(reinterpret_cast<char*>(head), sizeof(head));
  if (head[1] != 2) {
    throw InputError(path, "is binary glTF of version " + std::to_string(head[1]) + ", expected 2");
  }
  RequireLength(path, head[2]);
}

// Faults that Assimp passes over in silence, or tells no line of.
void CheckSyntax(const fs::path& path, ModelFormat format) {
  if (format == ModelFormat::kPly) CheckPly(path);
  if (format == ModelFormat::kGltf && IsGlb(path)) CheckGlb(path);
}

// After Assimp has failed: throws InputError at the line if glTF is no JSON or COLLADA no XML.
void ExplainFailure(const fs::path& path, ModelFormat format) {
  if (format == ModelFormat::kGltf && !IsGlb(path)) ReadJson(path);
  if (format == ModelFormat::kCollada) XmlNode::Load(path);
}

int64_t FacesOf(const Model& model) {
  const auto faces = model.entities.find("face");
  return faces == model.entities.end() ? 0 : faces->second;
}

}  // namespace

Model ReadWithAssimp(const fs::path& path, ModelFormat format, int seconds) {
  CheckSyntax(path, format);
  std::vector<std::string> lost;
  if (format == ModelFormat::kGltf) lost = CheckGltfExtensions(path);
  const IsolationLimits limits{.seconds = std::min(seconds, SecondsFor(path))};
  IsolatedModel isolated = ReadIsolated([&] { return ReadHere(path, format); }, limits);
  if (!isolated.model) {
    ExplainFailure(path, format);
    const std::string prefix = path.string() + ": ";
    std::string failure = isolated.failure;
    if (failure.starts_with(prefix)) failure.erase(0, prefix.size());
    throw InputError(path, failure + " (" + NameOf(format) + ", read by Assimp)");
  }
  if (format == ModelFormat::kPly) RequirePlyFaces(path, FacesOf(*isolated.model));
  isolated.model->format = NameOf(format);
  isolated.model->warnings.insert(isolated.model->warnings.end(), lost.begin(), lost.end());
  // glTF and COLLADA name their unit or define it; Assimp has turned it into metres.
  const bool has_unit = format != ModelFormat::kPly;
  if (has_unit) isolated.model->metres_per_unit = 1;
  return *std::move(isolated.model);
}

}  // namespace insitu
