// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/formats/objects_model.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "calibration/files/json_file.h"
#include "calibration/files/wording.h"
#include "renderer/mesh/face_triangles.h"
#include "renderer/mesh/outline_with_holes.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

constexpr char kFormat[] = "insitu objects";
constexpr int kVersion = 1;
constexpr double kPlanar = 1e-3;         // [m]
constexpr double kFarthestPoint = 1e12;  // [m]

void RequireKnown(const JsonNode& object, const std::set<std::string>& keys) {
  for (const auto& [key, value] : object.Members()) {
    if (!keys.contains(key)) throw value.Error("is no key of an object here");
  }
}

// What is stated is heeded; nothing need be.
void RequireFormat(const JsonNode& root) {
  const auto format = root.Find("format"), version = root.Find("version");
  if (format && format->Text() != kFormat) {
    throw format->Error(std::string("is another format, expected \"") + kFormat + "\"");
  }
  if (version && version->Integer() != kVersion) {
    throw version->Error("is not a version that is read, expected " + std::to_string(kVersion));
  }
}

Vector3d PointOf(const JsonNode& node) {
  const Vector3d point = node.Vector3();
  if (point.cwiseAbs().maxCoeff() <= kFarthestPoint) return point;
  throw node.Error("is beyond 1e12 m");
}

// Twice its area, along its normal.
Vector3d AreaOf(const std::vector<Vector3d>& vertices, const std::vector<int>& ring) {
  Vector3d area = Vector3d::Zero();
  const Vector3d& first = vertices[ring[0]];
  for (size_t i = 1; i + 1 < ring.size(); ++i) {
    area += (vertices[ring[i]] - first).cross(vertices[ring[i + 1]] - first);
  }
  return area;
}

class ObjectsReader {
 public:
  explicit ObjectsReader(const std::filesystem::path& path) : path_(path) {}

  Model Read() {
    const JsonNode root = JsonNode::Load(path_);
    RequireKnown(root, {"format", "version", "objects"});
    RequireFormat(root);
    model_.format = kFormat;
    model_.metres_per_unit = 1;
    std::set<std::string> names;
    for (const JsonNode& object : root.At("objects").Items()) {
      if (!names.insert(object.At("name").Text()).second) {
        throw object.At("name").Error("is the name of two objects");
      }
      AddObject(object);
    }
    DropUnused(&model_.mesh);
    return std::move(model_);
  }

 private:
  void AddObject(const JsonNode& object) {
    RequireKnown(object, {"name", "layer", "material", "diffuse_rgb", "opacity", "sphere",
                          "polygon", "polyhedron"});
    const auto sphere = object.Find("sphere"), polygon = object.Find("polygon"),
               polyhedron = object.Find("polyhedron");
    const int kinds = (sphere ? 1 : 0) + (polygon ? 1 : 0) + (polyhedron ? 1 : 0);
    if (kinds != 1) {
      throw object.Error(
          "is not one of the three, expected \"sphere\", \"polygon\" or "
          "\"polyhedron\"");
    }
    const int surface = SurfaceOf(object);
    if (sphere) AddSphere(*sphere, surface);
    if (polygon) AddPolygon(*polygon, surface);
    if (polyhedron) AddPolyhedron(*polyhedron, object.At("name").Text(), surface);
    for (const char* kind : {"sphere", "polygon", "polyhedron"}) {
      if (object.Find(kind)) ++model_.entities[kind];
    }
  }

  int SurfaceOf(const JsonNode& object) {
    SurfaceNames names;
    const auto layer = object.Find("layer"), material = object.Find("material"),
               rgb = object.Find("diffuse_rgb"), opacity = object.Find("opacity");
    names.layer = (layer ? *layer : object.At("name")).Text();
    if (material) names.material = material->Text();
    if (rgb) {
      names.rgb = rgb->Vector3();
      if (names.rgb->minCoeff() < 0 || names.rgb->maxCoeff() > 1) {
        throw rgb->Error("is out of range, expected 0 to 1");
      }
    }
    if (opacity) {
      names.opacity = opacity->Number();
      if (names.opacity < 0 || names.opacity > 1) {
        throw opacity->Error("is out of range, expected 0 to 1");
      }
    }
    // What is closed and lets light through is a body.
    names.is_solid = !object.Find("polygon");
    return SurfaceIndex(&model_.mesh.surfaces).IndexOf(names);
  }

  void AddSphere(const JsonNode& node, int surface) {
    RequireKnown(node, {"center", "radius_m"});
    const JsonNode radius = node.At("radius_m");
    if (!(radius.Number() > 0) || radius.Number() > kFarthestPoint) {
      throw radius.Error("is no radius, expected above 0");
    }
    model_.mesh.spheres.push_back({PointOf(node.At("center")), radius.Number(), surface});
  }

  std::vector<int> AddRing(const JsonNode& node) {
    std::vector<int> ring;
    for (const JsonNode& point : node.Items()) {
      ring.push_back(static_cast<int>(model_.mesh.vertices.size()));
      model_.mesh.vertices.push_back(PointOf(point));
    }
    if (ring.size() < 3) throw node.Error("has fewer than 3 points");
    return ring;
  }

  void RequirePlanar(const JsonNode& node, const std::vector<int>& outline,
                     const std::vector<int>& ring) const {
    const auto& vertices = model_.mesh.vertices;
    const Vector3d normal = AreaOf(vertices, outline).normalized();
    for (size_t i = 0; i < ring.size(); ++i) {
      const double off = normal.dot(vertices[ring[i]] - vertices[outline[0]]);
      if (std::abs(off) <= kPlanar) continue;
      throw node.Error(Formatted("is not planar: point %zu lies %.3f m off", i + 1, off));
    }
  }

  void AddFace(const JsonNode& node, const std::vector<int>& outline,
               const std::vector<std::vector<int>>& holes, int surface) {
    if (outline.size() > kMostCorners) throw node.Error("has over 10000 points");
    RequirePlanar(node, outline, outline);
    for (const std::vector<int>& hole : holes) RequirePlanar(node, outline, hole);
    int lost = 0;
    const std::vector<int> ring = OutlineWithHoles(model_.mesh.vertices, outline, holes, &lost);
    if (lost > 0) throw node.Error("has a hole that is not within it, or crosses another");
    const auto triangles = FaceTriangles(model_.mesh.vertices, ring);
    if (triangles.empty()) throw node.Error("has no area, or crosses itself");
    for (const Eigen::Vector3i& triangle : triangles) {
      model_.mesh.triangles.push_back(triangle);
      model_.mesh.surface_of_triangle.push_back(surface);
    }
  }

  void AddPolygon(const JsonNode& node, int surface) {
    RequireKnown(node, {"vertices", "holes"});
    const std::vector<int> outline = AddRing(node.At("vertices"));
    std::vector<std::vector<int>> holes;
    if (const auto list = node.Find("holes")) {
      for (const JsonNode& hole : list->Items()) holes.push_back(AddRing(hole));
    }
    AddFace(node.At("vertices"), outline, holes, surface);
  }

  void AddPolyhedron(const JsonNode& node, const std::string& name, int surface) {
    RequireKnown(node, {"vertices", "faces"});
    const std::vector<int> vertices = AddRing(node.At("vertices"));
    std::map<std::pair<int, int>, int> faces_of_edge;
    for (const JsonNode& face : node.At("faces").Items()) {
      std::vector<int> corners;
      for (const JsonNode& item : face.Items()) {
        const int corner = item.Integer();
        if (corner < 0 || corner >= std::ssize(vertices)) {
          throw item.Error(Formatted("is no vertex, expected 0 to %zu", vertices.size() - 1));
        }
        corners.push_back(vertices[corner]);
      }
      if (corners.size() < 3) throw face.Error("has fewer than 3 corners");
      for (size_t i = 0; i < corners.size(); ++i) {
        ++faces_of_edge[std::minmax({corners[i], corners[(i + 1) % corners.size()]})];
      }
      AddFace(face, corners, {}, surface);
    }
    const auto open =
        std::ranges::count_if(faces_of_edge, [](const auto& edge) { return edge.second != 2; });
    if (open == 0) return;
    model_.warnings.emplace_back(
        node.Error(Formatted("is no polyhedron: \"%s\" has %td edges that are not of two faces",
                             name.c_str(), open))
            .what());
  }

  std::filesystem::path path_;
  Model model_;
};

}  // namespace

bool IsObjectsFile(const std::filesystem::path& path, std::string_view head) {
  return NameKey(path.filename().string()) == "OBJECTS.JSON" ||
         head.find("\"insitu objects\"") != head.npos;
}

Model ReadObjects(const std::filesystem::path& path) { return ObjectsReader(path).Read(); }

}  // namespace insitu
