// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/foreign/collada_model.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "calibration/color/color_space.h"
#include "calibration/files/error.h"
#include "calibration/files/wording.h"
#include "renderer/foreign/collada_geometry.h"
#include "renderer/foreign/collada_library.h"
#include "renderer/foreign/collada_material.h"
#include "renderer/foreign/mesh_builder.h"
#include "renderer/foreign/unit_comment.h"
#include "renderer/mesh/outline_with_holes.h"

namespace insitu {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

std::vector<double> NumbersIn(const XmlNode& node, size_t count) {
  int faulty = 0;
  std::vector<double> numbers = ColladaNumbers(node, &faulty);
  if (faulty == 0 && numbers.size() >= count) return numbers;
  throw node.Error("expected " + std::to_string(count) + " numbers");
}

// Of one transformation element; identity: it is none.
Affine3d TransformBy(const XmlNode& node) {
  const std::string kind = node.Name();
  Affine3d transform = Affine3d::Identity();
  if (kind == "matrix") {
    constexpr size_t kEntries = 16;
    const std::vector<double> m = NumbersIn(node, kEntries);
    transform.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(m.data());
    transform.makeAffine();
  } else if (kind == "translate") {
    transform.translate(Vector3d(NumbersIn(node, 3).data()));
  } else if (kind == "scale") {
    transform.scale(Vector3d(NumbersIn(node, 3).data()));
  } else if (kind == "rotate") {
    const std::vector<double> r = NumbersIn(node, 4);
    const Vector3d axis(r.data());
    if (axis.norm() > 0) {
      transform.rotate(Eigen::AngleAxisd(r[3] * std::numbers::pi / 180, axis.normalized()));
    }
  }
  return transform;
}

class ColladaReader {
 public:
  explicit ColladaReader(const std::filesystem::path& path)
      : path_(path), root_(XmlNode::Load(path)), library_(root_), builder_(path, &model_) {}

  Model Read() {
    if (root_.Name() != "COLLADA") throw root_.Error("expected the element COLLADA");
    model_.format = "COLLADA";
    const Affine3d world_from_file = WorldFromFile();
    const std::string layer = path_.stem().string();
    for (const XmlNode& scene : Scenes()) {
      for (const XmlNode& node : scene.Children("node")) {
        AddNode(node, world_from_file, layer, 0);
      }
    }
    if (model_.entities.empty()) AddUnplaced(world_from_file);
    if (root_.Find("library_animations")) ++model_.skipped[{"animation", "shown at rest"}];
    builder_.Finish();
    return std::move(model_);
  }

 private:
  Affine3d WorldFromFile() {
    const auto asset = root_.Find("asset");
    const auto up = asset ? asset->Find("up_axis") : std::nullopt;
    std::string axis = up ? up->Text() : "Y_UP";
    if (axis != "X_UP" && axis != "Y_UP" && axis != "Z_UP") {
      if (!axis.empty()) Warn("its up_axis " + Quoted(axis) + " is none: y is taken as up");
      axis = "Y_UP";  // by definition
    }
    Affine3d turn = Affine3d::Identity();
    if (axis == "Y_UP") turn.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    if (axis == "X_UP") turn.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    model_.metres_per_unit = MetresPerUnit(asset ? asset->Find("unit") : std::nullopt);
    return Eigen::Scaling(model_.metres_per_unit.value_or(1)) * turn;
  }
  // nullopt: not stated; what its unit is called counts for nothing, as in other programs.
  std::optional<double> MetresPerUnit(const std::optional<XmlNode>& unit) {
    const std::string name = unit ? unit->Attribute("name").value_or("") : "";
    if (!unit || !unit->Attribute("meter")) {
      if (!name.empty()) Warn("its unit " + Quoted(name) + " has no length: taken as 1 m");
      return std::nullopt;
    }
    const double metres = unit->NumberAttribute("meter");
    if (!(metres > 0)) throw unit->Error("is of no length");
    const auto named = MetresOfUnitNamed(name);
    if (named && std::abs(*named / metres - 1) > 0.01) {
      Warn(Formatted("its unit is called %s and stated to be %g m, which is taken",
                     Quoted(name).c_str(), metres));
    }
    return metres;
  }
  void Warn(const std::string& message) {
    model_.warnings.emplace_back(InputError(path_, message).what());
  }

  std::vector<XmlNode> Scenes() const {
    const auto scene = root_.Find("scene");
    const auto instance = scene ? scene->Find("instance_visual_scene") : std::nullopt;
    if (instance)
      return {library_.At("visual_scene", instance->RequiredAttribute("url"), *instance)};
    std::vector<XmlNode> all;
    for (const XmlNode& library : root_.Children("library_visual_scenes")) {
      for (const XmlNode& one : library.Children("visual_scene")) all.push_back(one);
    }
    return all;
  }

  // Geometries that no scene shows, if there are no others.
  void AddUnplaced(const Affine3d& world_from_file) {
    for (const XmlNode& library : root_.Children("library_geometries")) {
      for (const XmlNode& geometry : library.Children("geometry")) {
        const std::string name = geometry.Attribute("name").value_or("");
        AddGeometry(geometry, {}, world_from_file, name.empty() ? path_.stem().string() : name);
      }
    }
  }

  void AddNode(const XmlNode& node, const Affine3d& world_from_parent, const std::string& above,
               int depth) {
    constexpr int kDeepest = 1000, kMostNodes = 10'000'000;
    if (depth > kDeepest) throw node.Error("nodes within nodes, over 1000 deep");
    if (++visited_ > kMostNodes) throw node.Error("over ten million nodes");
    Affine3d world_from_node = world_from_parent;
    const std::string name = node.Attribute("name").value_or(node.Attribute("id").value_or(""));
    const std::string& layer = name.empty() ? above : name;
    for (const XmlNode& child : node.Children()) {
      const std::string kind = child.Name();
      if (kind == "lookat" || kind == "skew") {
        ++model_.skipped[{kind, "a transformation that is not read: what it moves is elsewhere"}];
      }
      world_from_node = world_from_node * TransformBy(child);
    }
    for (const XmlNode& child : node.Children()) {
      AddChild(child, world_from_node, layer, depth);
    }
  }

  void AddChild(const XmlNode& child, const Affine3d& world_from_node, const std::string& layer,
                int depth) {
    const std::string kind = child.Name();
    if (kind == "node") {
      AddNode(child, world_from_node, layer, depth + 1);
    } else if (kind == "instance_node") {
      const auto node = Instanced("node", child);
      if (node) AddNode(*node, world_from_node, layer, depth + 1);
    } else if (kind == "instance_geometry") {
      const auto geometry = Instanced("geometry", child);
      if (geometry) AddGeometry(*geometry, BoundBy(child), world_from_node, layer);
    } else if (kind == "instance_controller") {
      AddController(child, world_from_node, layer);
    } else if (kind == "instance_light" || kind == "instance_camera") {
      ++model_.skipped[{kind, "not shown: lamps are listed in lights.json"}];
    }
  }

  // One that is of another file, or not there, costs itself alone.
  std::optional<XmlNode> Instanced(const std::string& kind, const XmlNode& instance) {
    const std::string url = instance.RequiredAttribute("url");
    if (url.find('#') != url.npos && !url.starts_with('#')) {
      ++model_.skipped[{kind + " of another file", "not read: " + url.substr(0, 80)}];
      return std::nullopt;
    }
    auto found = library_.Find(kind, url);
    if (!found) ++model_.skipped[{kind, Quoted(url) + " is named and not there"}];
    return found;
  }

  void AddController(const XmlNode& instance, const Affine3d& world_from_node,
                     const std::string& layer) {
    const auto controller = Instanced("controller", instance);
    if (!controller) return;
    const auto skin = controller->Find("skin"), morph = controller->Find("morph");
    if (!skin && !morph) return;
    ++model_.skipped[{skin ? "skin" : "morph", "its mesh is shown at rest"}];
    const std::string source = (skin ? *skin : *morph).RequiredAttribute("source");
    const auto geometry = library_.Find("geometry", source);
    if (geometry) AddGeometry(*geometry, BoundBy(instance), world_from_node, layer);
  }

  // Symbol -> material.
  std::map<std::string, SurfaceNames> BoundBy(const XmlNode& instance) {
    std::map<std::string, SurfaceNames> bound;
    for (const XmlNode& material : instance.Descendants("instance_material")) {
      const std::string target = material.Attribute("target").value_or("");
      bound[material.Attribute("symbol").value_or("")] = MaterialOf(target);
    }
    return bound;
  }
  SurfaceNames MaterialOf(const std::string& url) {
    const auto [found, is_new] = materials_.try_emplace(url);
    if (!is_new) return found->second;
    if (const auto material = library_.Find("material", url)) {
      found->second = ReadColladaMaterial(library_, *material, &model_);
    } else {
      ++model_.skipped[{"material that is not there", "its faces are shown without"}];
    }
    return found->second;
  }

  void AddGeometry(const XmlNode& node, const std::map<std::string, SurfaceNames>& bound,
                   const Affine3d& world_from_node, const std::string& layer) {
    const auto [found, is_new] = geometries_.try_emplace(node.Attribute("id").value_or(""));
    if (is_new || found->first.empty()) found->second = ReadColladaGeometry(node, &model_);
    const ColladaGeometry& geometry = found->second;
    ++model_.entities["geometry"];
    const int first = static_cast<int>(model_.mesh.vertices.size());
    for (const Vector3d& position : geometry.positions) {
      builder_.AddVertex(world_from_node * position, layer);
    }
    for (const ColladaPart& part : geometry.parts) {
      SurfaceNames names;
      const auto material = bound.find(part.material);
      if (material != bound.end()) {
        names = material->second;
      } else if (!part.material.empty()) {
        names = MaterialOf(part.material);  // careless programs write the id itself
      }
      names.layer = layer;
      AddPart(part, builder_.SurfaceOf(names), first, world_from_node);
    }
  }

  void AddPart(const ColladaPart& part, int surface, int first, const Affine3d& world_from_node) {
    if (!part.colors.empty()) builder_.SayColorsByVertex();
    model_.entities["face"] += static_cast<int>(part.faces.size());
    const Eigen::Matrix3d turn = world_from_node.linear().inverse().transpose();
    const bool mirrored = world_from_node.linear().determinant() < 0;
    for (const ColladaFace& face : part.faces) {
      std::vector<ColladaCorner> corners = Joined(face, first);
      if (mirrored) std::reverse(corners.begin(), corners.end());
      face_.Clear();
      Vector3d color = Vector3d::Zero();
      for (const ColladaCorner& corner : corners) {
        face_.corners.push_back(first + corner.position);
        if (!part.normals.empty()) {
          const Vector3d normal =
              corner.normal >= 0 ? Vector3d(turn * part.normals[corner.normal]) : Vector3d::Zero();
          face_.normals.push_back(normal.normalized().cast<float>());
        }
        if (!part.uvs.empty()) {
          face_.uvs.push_back(corner.uv >= 0 ? Eigen::Vector2f(part.uvs[corner.uv].cast<float>())
                                             : Eigen::Vector2f(0, 0));
        }
        if (corner.color >= 0) color += part.colors[corner.color];
      }
      int shown = surface;
      if (!part.colors.empty() && !corners.empty()) {
        color /= static_cast<double>(corners.size());
        for (double& channel : color) channel = LinearFromSrgb(std::clamp(channel, 0.0, 1.0));
        shown = builder_.ColoredSurface(surface, color);
      }
      builder_.AddFace(face_, shown);
    }
  }

  // With its holes, as one outline.
  std::vector<ColladaCorner> Joined(const ColladaFace& face, int first) {
    if (face.holes.empty()) return face.corners;
    std::map<int, ColladaCorner> corner_of;
    const auto places = [&](const std::vector<ColladaCorner>& corners) {
      std::vector<int> vertices;
      for (const ColladaCorner& corner : corners) {
        vertices.push_back(first + corner.position);
        corner_of[vertices.back()] = corner;
      }
      return vertices;
    };
    const std::vector<int> outline = places(face.corners);
    std::vector<std::vector<int>> holes;
    for (const std::vector<ColladaCorner>& hole : face.holes) holes.push_back(places(hole));
    int lost = 0;
    std::vector<ColladaCorner> joined;
    for (const int vertex : OutlineWithHoles(model_.mesh.vertices, outline, holes, &lost)) {
      joined.push_back(corner_of[vertex]);
    }
    if (lost > 0) {
      model_.skipped[{"hole of a face", "crosses its outline or has no area: it is closed"}] +=
          lost;
    }
    return joined;
  }

  std::filesystem::path path_;
  XmlNode root_;
  ColladaLibrary library_;
  Model model_;
  MeshBuilder builder_;
  BuiltFace face_;
  std::map<std::string, SurfaceNames> materials_;
  std::map<std::string, ColladaGeometry> geometries_;
  int visited_ = 0;
};

}  // namespace

Model ReadCollada(const std::filesystem::path& path) { return ColladaReader(path).Read(); }

}  // namespace insitu
