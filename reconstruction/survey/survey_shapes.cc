// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/survey/survey_shapes.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <set>
#include <utility>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "reconstruction/survey/near_names.h"
#include "reconstruction/survey/survey_names.h"

namespace insitu {
namespace {

using Kind = GeometricConstraint::Kind;

// At a value, with its place within the file in English.
SaidError Fault(const JsonNode& node, const Sentence& what) {
  return {node.Error(what.text()), {node.path(), node.line()}, what};
}

std::optional<std::string> ReadMask(const JsonNode& polygon) {
  const auto mask = polygon.Find("mask");
  if (!mask) return std::nullopt;
  if (!std::filesystem::exists(polygon.path().parent_path() / mask->Text())) {
    throw Fault(*mask, Sentence("maskNotThere", "mask '{mask}' is not in the folder survey",
                                {{"mask", mask->Text()}}));
  }
  return mask->Text();
}

SaidError UnknownKey(const std::string& key, const JsonNode& member, const std::string& what,
                     const std::vector<std::string>& keys) {
  std::string expected;
  for (const std::string& known : keys) expected += (expected.empty() ? "" : ", ") + known;
  const InputError english = member.Error("is not a key of " + what + ", expected " + expected);
  return {english,
          {member.path(), member.line()},
          Sentence("keyUnknown", "\"{key}\" is not a key there, expected {expected}",
                   {{"key", key}, {"expected", expected}})};
}

// A key that is misspelt would be left out without a word.
void RequireKnownKeys(const JsonNode& node, const std::string& what,
                      const std::vector<std::string>& keys) {
  for (const auto& [key, member] : node.Members()) {
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    throw UnknownKey(key, member, what, keys);
  }
}

// Lists of names, of which a polygon has each once: rings that touch enclose nothing between them.
void ReadHoles(const JsonNode& node, std::set<std::string> taken, PolygonOutline* polygon) {
  for (const JsonNode& hole : node.Items()) {
    polygon->holes.push_back(hole.Texts());
    const std::vector<std::string>& names = polygon->holes.back();
    if (names.size() < 3) {
      throw Fault(hole, Sentence("holeFew",
                                 "a hole of polygon '{polygon}' has {count} vertices, expected at "
                                 "least three",
                                 {{"polygon", polygon->name}, {"count", int(names.size())}}));
    }
    for (const std::string& name : names) {
      if (taken.insert(name).second) continue;
      throw Fault(hole, Sentence("holeVertexTwice",
                                 "a hole of polygon '{polygon}' has vertex '{vertex}', which the "
                                 "polygon has already; expected each vertex once",
                                 {{"polygon", polygon->name}, {"vertex", name}}));
    }
  }
}

PolygonOutline ReadPolygon(const JsonNode& node, const std::vector<std::string>& photos) {
  RequireKnownKeys(node, "a polygon", {"name", "vertices", "photo", "material", "mask", "holes"});
  PolygonOutline polygon;
  polygon.name = node.At("name").Text();
  polygon.place = {node.path(), node.line()};
  polygon.vertices = node.At("vertices").Texts();
  const std::set<std::string> distinct(polygon.vertices.begin(), polygon.vertices.end());
  if (distinct.size() < 3 || distinct.size() < polygon.vertices.size()) {
    throw Fault(node, Sentence("polygonVertices",
                               "polygon '{polygon}' has {count} vertices, {distinct} of them "
                               "distinct; expected at least three, all distinct",
                               {{"polygon", polygon.name},
                                {"count", int(polygon.vertices.size())},
                                {"distinct", int(distinct.size())}}));
  }
  if (const auto holes = node.Find("holes")) ReadHoles(*holes, distinct, &polygon);
  if (const auto photo = node.Find("photo")) {
    polygon.photo = SitePhotoName(photo->Text(), photos);
    if (const auto fault = FaultOfPhoto(*polygon.photo, photos)) throw Fault(*photo, *fault);
  }
  polygon.material = node.At("material").Text();
  polygon.mask = ReadMask(node);
  return polygon;
}

std::vector<DirectionPair> ReadPairs(const JsonNode& root, const std::string& key,
                                     const std::string& from, const std::string& to) {
  std::vector<DirectionPair> pairs;
  const auto list = root.Find(key);
  if (!list) return pairs;
  for (const JsonNode& node : list->Items()) {
    RequireKnownKeys(node, "a " + key + " pair", {from, to});
    pairs.push_back({node.At(from).Text(), node.At(to).Text(), {node.path(), node.line()}});
    if (pairs.back().from == pairs.back().to) {
      throw Fault(node,
                  Sentence("pairTwice", "the pair names point '{point}' twice, expected two points",
                           {{"point", pairs.back().to}}));
    }
  }
  return pairs;
}

struct KindOfConstraint {
  Kind kind;
  std::string name;
  size_t points, polygons;  // how many it is about; polygons 0: points only
  bool has_value;           // [m]; else an angle
};

const std::vector<KindOfConstraint>& KindsOfConstraint() {
  static const std::vector<KindOfConstraint> kinds = {
      {Kind::kDistance, "distance", 2, 0, true},
      {Kind::kHeight, "height", 2, 0, true},
      {Kind::kVertical, "vertical", 2, 1, false},
      {Kind::kHorizontal, "horizontal", 2, 1, false},
      {Kind::kParallel, "parallel", 4, 2, false},
      {Kind::kPerpendicular, "perpendicular", 4, 2, false},
  };
  return kinds;
}

const KindOfConstraint& ReadKind(const JsonNode& node) {
  const std::string name = node.At("kind").Text();
  std::string expected;
  for (const KindOfConstraint& kind : KindsOfConstraint()) {
    if (kind.name == name) return kind;
    expected += (expected.empty() ? "" : ", ") + kind.name;
  }
  throw Fault(node, Sentence("kindUnknown", "kind is '{word}', expected one of {words}",
                             {{"word", name}, {"words", expected}}));
}

std::vector<std::string> KeysOf(const KindOfConstraint& kind) {
  std::vector<std::string> keys = {"kind", "points"};
  if (kind.polygons > 0) keys.push_back("polygons");
  const auto values =
      kind.has_value ? std::array{"value_m", "sigma_m"} : std::array{"sigma_deg", "sigma_mm_per_m"};
  keys.insert(keys.end(), values.begin(), values.end());
  return keys;
}

// "two points (an edge)" and so on, of which the file must name exactly one kind.
std::string ExpectedSubjects(const KindOfConstraint& kind) {
  const std::string points = std::to_string(kind.points) + " distinct names in \"points\"";
  if (kind.polygons == 0) return points;
  return "either " + points + (kind.points == 4 ? " (two edges)" : " (an edge)") + " or " +
         std::to_string(kind.polygons) + " in \"polygons\"";
}

// Two edges may share a corner, but not both ends, and an edge has two.
bool HasTwoEnds(const std::vector<std::string>& names) {
  std::set<std::set<std::string>> edges;
  for (size_t i = 0; i + 1 < names.size(); i += 2) {
    if (names[i] == names[i + 1] || !edges.insert({names[i], names[i + 1]}).second) return false;
  }
  return true;
}

void ReadSubjects(const JsonNode& node, const KindOfConstraint& kind,
                  GeometricConstraint* constraint) {
  if (const auto points = node.Find("points")) constraint->points = points->Texts();
  if (const auto polygons = node.Find("polygons")) constraint->polygons = polygons->Texts();
  const auto& names = constraint->points.empty() ? constraint->polygons : constraint->points;
  const size_t count = constraint->points.empty() ? kind.polygons : kind.points;
  const bool is_distinct = HasTwoEnds(names);
  const bool is_either = constraint->points.empty() || constraint->polygons.empty();
  if (is_either && is_distinct && !names.empty() && names.size() == count) return;
  const InputError english =
      node.Error("is about " + std::to_string(constraint->points.size()) + " points and " +
                 std::to_string(constraint->polygons.size()) + " polygons" +
                 (is_distinct ? "" : ", one of them named twice") + "; a " + kind.name +
                 " constraint expects " + ExpectedSubjects(kind));
  throw SaidError(
      english, {node.path(), node.line()},
      Sentence("constraintSubjects",
               "a constraint \"{kind_name}\" is about {points} distinct points or {polygons} "
               "polygons",
               {{"kind_name", kind.name},
                {"points", int(kind.points)},
                {"polygons", int(kind.polygons)}}));
}

double PositiveNumber(const JsonNode& node) {
  const double number = node.Number();
  if (number > 0) return number;
  throw Fault(node, Sentence("notPositive", "is {number}, expected more than 0",
                             {{"number", std::to_string(number)}}));
}

double AngleSigma(const JsonNode& node) {
  const auto degrees = node.Find("sigma_deg");
  const auto slope = node.Find("sigma_mm_per_m");
  if (degrees.has_value() == slope.has_value()) {
    throw Fault(node,
                Sentence("eitherSigma", "expected either \"sigma_deg\" or \"sigma_mm_per_m\""));
  }
  return degrees ? PositiveNumber(*degrees) * std::numbers::pi / 180
                 : PositiveNumber(*slope) / 1000;
}

GeometricConstraint ReadConstraint(const JsonNode& node, const std::set<std::string>& polygons) {
  const KindOfConstraint& kind = ReadKind(node);
  GeometricConstraint constraint;
  constraint.kind = kind.kind;
  constraint.place = {node.path(), node.line()};
  RequireKnownKeys(node, "a " + kind.name + " constraint", KeysOf(kind));
  ReadSubjects(node, kind, &constraint);
  for (const std::string& polygon : constraint.polygons) {
    if (polygons.contains(polygon)) continue;
    throw Fault(node,
                Sentence("constraintPolygon",
                         "names polygon '{polygon}', expected a polygon of "
                         "polygons.json{hint}",
                         {{"polygon", polygon}, {"hint", SaidMeant(polygon, polygons).ToJson()}}));
  }
  if (kind.has_value) {
    const JsonNode value = node.At("value_m");
    constraint.value = kind.kind == Kind::kDistance ? PositiveNumber(value) : value.Number();
    constraint.sigma = PositiveNumber(node.At("sigma_m"));
  } else {
    constraint.sigma = AngleSigma(node);
  }
  return constraint;
}

}  // namespace

std::vector<PolygonOutline> ReadPolygons(const std::filesystem::path& path,
                                         const std::vector<std::string>& photos) {
  std::vector<PolygonOutline> polygons;
  std::set<std::string> names;
  const JsonNode root = JsonNode::Load(path);
  RequireKnownKeys(root, "the file", {"polygons", "format", "version"});
  for (const JsonNode& node : root.At("polygons").Items()) {
    polygons.push_back(ReadPolygon(node, photos));
    if (!names.insert(polygons.back().name).second) {
      throw Fault(node, Sentence("polygonTwice", "polygon '{polygon}' occurs twice",
                                 {{"polygon", polygons.back().name}}));
    }
  }
  return polygons;
}

DirectionPairs ReadDirections(const std::filesystem::path& path) {
  const JsonNode root = JsonNode::Load(path);
  RequireKnownKeys(root, "the file", {"sun", "zenith", "format", "version"});
  return {ReadPairs(root, "sun", "shadow", "object"), ReadPairs(root, "zenith", "bottom", "top")};
}

std::vector<GeometricConstraint> ReadConstraints(const std::filesystem::path& path,
                                                 const std::vector<PolygonOutline>& polygons) {
  std::set<std::string> names;
  for (const PolygonOutline& polygon : polygons) names.insert(polygon.name);
  std::vector<GeometricConstraint> constraints;
  const JsonNode root = JsonNode::Load(path);
  RequireKnownKeys(root, "the file", {"constraints", "format", "version"});
  for (const JsonNode& node : root.At("constraints").Items()) {
    constraints.push_back(ReadConstraint(node, names));
  }
  return constraints;
}

}  // namespace insitu
