// SPDX-License-Identifier: GPL-3.0-or-later
// Small ACIS bodies written in the tests, in the fields of any version.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "renderer/acis/acis_file.h"

namespace insitu {

class SatText {
 public:
  // Records 0 to 2 are the body, its lump and its shell.
  explicit SatText(int version, const std::string& transform = "") : version_(version) {
    const std::string placed = transform.empty() ? "$-1" : "$3";
    Add("body", "$1 $-1 " + placed);
    Add("lump", "$-1 $2 $0");
    Add("shell", "$-1 $-1 $3 $-1 $1");  // its face is set at the end
    if (!transform.empty()) {
      records_.push_back("transform $-1 " + std::string(version_ >= 700 ? "-1 " : "") + transform);
    }
  }

  int Add(const std::string& type, const std::string& data) {
    records_.push_back(type + (version_ >= 700 ? " $-1 -1 $-1 " : " $-1 ") + data);
    return static_cast<int>(records_.size()) - 1;
  }
  static std::string Ref(int record) { return "$" + std::to_string(record); }
  static std::string Numbers(const Eigen::Vector3d& v) {
    std::ostringstream text;
    text.precision(17);
    text << v.x() << ' ' << v.y() << ' ' << v.z();
    return text.str();
  }

  int Vertex(const Eigen::Vector3d& place) {
    const int point = Add("point", Numbers(place));
    return Add("vertex", "$-1 " + Ref(point));
  }
  // `curve`: a record, -1: none.
  int Edge(int start, int end, int curve, bool is_reversed = false) {
    const std::string sense = is_reversed ? " reversed" : " forward";
    if (version_ < 500) {
      return Add("edge", Ref(start) + " " + Ref(end) + " $-1 " + Ref(curve) + sense);
    }
    return Add("edge",
               Ref(start) + " 0 " + Ref(end) + " 1 $-1 " + Ref(curve) + sense + " @7 unknown");
  }
  int Line(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const std::string data = Numbers(from) + " " + Numbers((to - from).normalized());
    return Add("straight-curve", data + (version_ > 200 ? " I I" : ""));
  }
  // A closed edge with one vertex, about `normal`.
  int Circle(const Eigen::Vector3d& center, const Eigen::Vector3d& normal,
             const Eigen::Vector3d& radius) {
    const int curve = Add("ellipse-curve", Numbers(center) + " " + Numbers(normal) + " " +
                                               Numbers(radius) + " 1 I I");
    const int vertex = Vertex(center + radius);
    return Edge(vertex, vertex, curve);
  }

  using Way = std::pair<int, bool>;  // an edge, and whether it is gone along backwards

  // A face of loops, each of edges in their order.
  int Face(int surface, bool is_reversed, const std::vector<std::vector<Way>>& loops) {
    int next = -1;
    for (const auto& edges : loops) {
      const int first = static_cast<int>(records_.size());
      const int count = static_cast<int>(edges.size());
      for (int i = 0; i < count; ++i) {
        Add("coedge", Ref(first + (i + 1) % count) + " " + Ref(first + (i + count - 1) % count) +
                          " $-1 " + Ref(edges[i].first) +
                          (edges[i].second ? " reversed " : " forward ") + Ref(first + count) +
                          " $-1");
      }
      next = Add("loop", Ref(next) + " " + Ref(first) + " $-1");
    }
    last_face_ = Add("face", Ref(last_face_) + " " + Ref(next) + " $2 $-1 " + Ref(surface) +
                                 (is_reversed ? " reversed" : " forward") + " single");
    return last_face_;
  }
  int Plane(const Eigen::Vector3d& origin, const Eigen::Vector3d& normal) {
    return Add("plane-surface", Numbers(origin) + " " + Numbers(normal) + " " +
                                    Numbers(normal.unitOrthogonal()) + " forward_v I I I I");
  }
  // slope: sine and cosine.
  int Cone(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis,
           const Eigen::Vector3d& radius, const std::string& slope = "0 1") {
    return Add("cone-surface", Numbers(origin) + " " + Numbers(axis) + " " + Numbers(radius) +
                                   " 1 I I " + slope + (version_ >= 400 ? " 1" : "") +
                                   " forward I I I I");
  }

  // Planar faces, corners counter-clockwise seen from outside; holes of each, clockwise.
  void Polyhedron(const std::vector<Eigen::Vector3d>& vertices,
                  const std::vector<std::vector<int>>& faces) {
    std::vector<int> records;
    for (const Eigen::Vector3d& v : vertices) records.push_back(Vertex(v));
    std::map<std::pair<int, int>, int> edges;
    for (const std::vector<int>& face : faces) {
      std::vector<Way> loop;
      for (size_t i = 0; i < face.size(); ++i) {
        const int a = face[i], b = face[(i + 1) % face.size()];
        const bool is_back = edges.contains({b, a});
        const auto key = is_back ? std::pair(b, a) : std::pair(a, b);
        if (!edges.contains(key)) {
          const int line = Line(vertices[a], vertices[b]);
          edges[key] = Edge(records[a], records[b], line);
        }
        loop.emplace_back(edges[key], is_back);
      }
      const Eigen::Vector3d& a = vertices[face[0]];
      const Eigen::Vector3d normal =
          (vertices[face[1]] - a).cross(vertices[face[2]] - a).normalized();
      // Every other surface looks inwards, as faces may say that they are reversed.
      const bool is_reversed = ++planes_ % 2 == 0;
      Face(Plane(a, is_reversed ? Eigen::Vector3d(-normal) : normal), is_reversed, {loop});
    }
  }

  std::string Text() const {
    std::string text = std::to_string(version_) + " 0 1 0\n";
    if (version_ >= 200) {
      text += version_ >= 700 ? "@6 insitu @8 ACIS 7.0 @3 now\n" : "6 insitu 8 ACIS 4.0 3 now\n";
      text += "1 9.9999999999999995e-007 1e-010\n";
    }
    for (const std::string& record : records_) text += record + " #\n";
    return text + "End-of-ACIS-data\n";
  }

 private:
  int version_;
  std::vector<std::string> records_;
  int last_face_ = -1, planes_ = 0;
};

inline std::string CubeText(int version, const std::string& transform = "") {
  SatText text(version, transform);
  text.Polyhedron(
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
      {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
  return text.Text();
}

inline std::string SphereText(int version, const Eigen::Vector3d& center, double radius) {
  SatText text(version);
  text.Face(text.Add("sphere-surface", SatText::Numbers(center) + " " + std::to_string(radius) +
                                           " 1 0 0 0 0 1 forward_v I I I I"),
            false, {});
  return text.Text();
}

// The same records in binary.
inline std::string SabOf(const AcisFile& file) {
  std::string bytes = "ASM BinaryFile4";
  const auto plain = [&](auto value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  const auto text = [&](char tag, const std::string& word) {
    bytes += tag;
    bytes += static_cast<char>(word.size());
    bytes += word;
  };
  for (const int32_t value : {file.version, 0, 1, 0}) plain(value);
  text(7, "insitu");
  for (const AcisRecord& record : file.records) {
    const size_t dash = record.type.find('-');
    if (dash != record.type.npos) text(14, record.type.substr(0, dash));
    text(13, dash == record.type.npos ? record.type : record.type.substr(dash + 1));
    for (const AcisToken& token : record.tokens) {
      if (token.kind == AcisToken::Kind::kNumber) {
        bytes += '\x06';
        plain(token.number);
      } else if (token.kind == AcisToken::Kind::kReference) {
        bytes += '\x0C';
        plain(static_cast<int32_t>(token.number));
      } else if (token.word == "unknown") {
        text(7, token.word);
      } else {
        bytes += token.word == "reversed" ? '\x0A' : '\x0B';
      }
    }
    bytes += '\x11';
  }
  for (const char* word : {"End", "of", "ASM"}) text(14, word);
  text(13, "data");
  return bytes;
}

}  // namespace insitu
