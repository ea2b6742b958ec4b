// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/convert_report.h"

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "calibration/files/json_file.h"
#include "calibration/files/whole_file.h"
#include "calibration/files/wording.h"
#include "calibration/photo/photograph.h"
#include "calibration/program/html_text.h"
#include "calibration/program/warnings.h"
#include "renderer/preview/preview_image.h"

namespace insitu {
namespace {

using Eigen::Vector3d;

Json::Value PointJson(const Vector3d& point) { return ToJson(Eigen::VectorXd(point)); }

Json::Value CountsJson(const std::map<std::string, int>& counts) {
  Json::Value json(Json::objectValue);
  for (const auto& [name, count] : counts) json[name] = count;
  return json;
}

void AddBox(const Eigen::AlignedBox3d& box, const std::string& suffix, Json::Value* json) {
  (*json)["bbox_min" + suffix] = box.isEmpty() ? Json::Value() : PointJson(box.min());
  (*json)["bbox_max" + suffix] = box.isEmpty() ? Json::Value() : PointJson(box.max());
}

Json::Value SkippedJson(const SkippedEntities& skipped) {
  Json::Value json(Json::arrayValue);
  for (const auto& [what, count] : skipped) {
    Json::Value entry;
    entry["kind"] = what.first;
    entry["reason"] = what.second;
    entry["count"] = count;
    json.append(entry);
  }
  return json;
}

Json::Value PairsJson(const Placement& placement) {
  const AdjustedSimilarity& adjusted = *placement.adjusted;
  Json::Value json;
  json["sigma0"] = adjusted.sigma0;
  json["redundancy"] = adjusted.redundancy;
  const Eigen::VectorXd sigmas = adjusted.covariance.diagonal().cwiseSqrt();
  json["sigma_shift"] = PointJson(sigmas.segment<3>(3));
  json["sigma_rotation_rad"] = PointJson(sigmas.head<3>());
  json["sigma_scale"] = sigmas[6] * adjusted.target_from_source.scale;
  json["scale_if_adjusted"] = adjusted.free_scale;
  for (size_t i = 0; i < placement.pairs.size(); ++i) {
    Json::Value pair;
    pair["name"] = placement.pairs[i].name;
    pair["sigma"] = placement.pairs[i].points.sigma.x();
    pair["residual"] = PointJson(Vector3d::Zero() - adjusted.residuals[i]);  // survey minus model
    json["pairs"].append(pair);
  }
  return json;
}

Json::Value PlacementJson(const Placement& placement) {
  Json::Value json;
  json["scale"] = placement.world_from_model.scale;
  json["rotation"] =
      ToJson(Eigen::MatrixXd(placement.world_from_model.rotation.toRotationMatrix()));
  json["shift"] = PointJson(placement.world_from_model.translation);
  if (placement.y_up) json["up"] = "y";
  if (!placement.model_crs.empty()) {
    json["model_crs"] = placement.model_crs;
    json["survey_crs"] = placement.survey_crs;
  }
  if (placement.adjusted) json["adjusted"] = PairsJson(placement);
  return json;
}

Json::Value ModelJson(const ModelReport& model) {
  Json::Value json;
  json["file"] = model.file.filename().string();
  json["format"] = model.format;
  const auto unit =
      model.placement.metres_per_unit ? model.placement.metres_per_unit : model.metres_per_unit;
  json["metres_per_unit"] = unit ? Json::Value(*unit) : Json::Value();
  json["triangles"] = model.triangles;
  json["spheres"] = model.spheres;
  AddBox(model.box_in_units, "_in_units", &json);
  json["entities"] = CountsJson(model.entities);
  json["skipped"] = SkippedJson(model.skipped);
  json["degenerate_faces"] = model.degenerate_faces;
  json["placement"] = PlacementJson(model.placement);
  return json;
}

Json::Value SolidsJson(const SolidsReport& solids) {
  Json::Value json;
  json["bodies"] = solids.bodies;
  json["closed_bodies"] = solids.closed_bodies;
  json["one_sided_bodies"] = solids.one_sided_bodies;
  json["open_edges"] = solids.open_edges;
  json["crowded_edges"] = solids.crowded_edges;
  json["flipped_faces"] = solids.flipped_faces;
  json["unmended_faces"] = solids.unmended_faces;
  json["duplicate_faces"] = solids.duplicate_faces;
  json["degenerate_faces"] = solids.degenerate_faces;
  json["coincident_faces"] = solids.coincident_faces;
  return json;
}

void AddMeasures(const ElementMeasures& measures, Json::Value* json) {
  (*json)["area_m2"] = measures.area;
  (*json)["open_edges"] = measures.open_edges;
  (*json)["volume_m3"] = measures.volume ? Json::Value(*measures.volume) : Json::Value();
}

struct Sums {
  std::map<std::string, int> entities;
  SkippedEntities skipped;
};

Sums SumOver(const std::vector<ModelReport>& models) {
  Sums sums;
  for (const ModelReport& model : models) {
    for (const auto& [kind, count] : model.entities) sums.entities[kind] += count;
    for (const auto& [what, count] : model.skipped) sums.skipped[what] += count;
  }
  return sums;
}

std::string Row(std::initializer_list<std::string> cells) {
  std::string row = "<tr>";
  for (const std::string& cell : cells) row += "<td>" + HtmlText(cell) + "</td>";
  return row + "</tr>\n";
}

constexpr size_t kMostRows = 500;  // of a table of the page

// Behind the rows of a table that holds the first of so many.
std::string TableEnd(size_t rows) {
  if (rows <= kMostRows) return "</table></section>\n";
  return "</table><p>and " + std::to_string(rows - kMostRows) +
         " smaller ones, which --report lists</p></section>\n";
}

std::string CountsTable(const std::string& title, const std::string& what,
                        const std::map<std::string, int>& counts) {
  std::string table =
      "<section><h2>" + title + "</h2><table><tr><th>" + what + "</th><th>count</th></tr>\n";
  std::vector<std::pair<std::string, int>> rows(counts.begin(), counts.end());
  if (rows.size() > kMostRows) {
    std::ranges::stable_sort(rows, std::greater(), &std::pair<std::string, int>::second);
  }
  for (size_t i = 0; i < std::min(rows.size(), kMostRows); ++i) {
    table += Row({rows[i].first, std::to_string(rows[i].second)});
  }
  return table + TableEnd(rows.size());
}

using NamedMeasures = std::vector<std::pair<std::string, ElementMeasures>>;

NamedMeasures LargestFirst(const std::map<std::string, ElementMeasures>& elements) {
  NamedMeasures largest(elements.begin(), elements.end());
  std::ranges::stable_sort(largest, std::greater(),
                           [](const auto& element) { return element.second.area; });
  return largest;
}

std::string ElementsTable(const Conversion& conversion) {
  std::string table =
      "<section><h2>Layers</h2><table><tr><th>layer</th><th>faces</th><th>area [m²]</th>"
      "<th>volume [m³]</th></tr>\n";
  const NamedMeasures largest = LargestFirst(conversion.elements);
  for (size_t i = 0; i < std::min(largest.size(), kMostRows); ++i) {
    const auto& [name, measures] = largest[i];
    table += Row({name, std::to_string(conversion.triangles_of_layer.at(name)),
                  Number("%.2f", measures.area),
                  measures.volume ? Number("%.2f", *measures.volume)
                                  : std::to_string(measures.open_edges) + " open edges"});
  }
  return table + TableEnd(largest.size());
}

std::string SkippedTable(const SkippedEntities& skipped) {
  if (skipped.empty()) return "<section><h2>Left out</h2>Nothing.</section>\n";
  std::string table =
      "<section><h2>Left out</h2><table><tr><th>kind</th><th>count</th><th>reason</th></tr>\n";
  for (const auto& [what, count] : skipped) {
    table += Row({what.first, std::to_string(count), what.second});
  }
  return table + "</table></section>\n";
}

std::string FilesTable(const Conversion& conversion) {
  std::string table =
      "<section><h2>Files</h2><table><tr><th>file</th><th>format</th><th>metres per unit</th>"
      "<th>triangles</th></tr>\n";
  for (const ModelReport& model : conversion.models) {
    const auto unit =
        model.placement.metres_per_unit ? model.placement.metres_per_unit : model.metres_per_unit;
    table += Row({model.file.filename().string(), model.format,
                  unit ? Number("%g", *unit) : "1 (not named)", std::to_string(model.triangles)});
  }
  return table + "</table></section>\n";
}

// "12 triangles, 1 spheres, 0 lights"
std::string Counts(const ArtificialEnvironment& building) {
  std::string text = std::to_string(building.triangles.size()) + " triangles, ";
  if (!building.spheres.empty()) text += std::to_string(building.spheres.size()) + " spheres, ";
  return text + std::to_string(building.lights.size()) + " lights";
}

std::string BoxTable(const Eigen::AlignedBox3d& box) {
  if (box.isEmpty()) return "<p>There is no surface.</p>\n";
  std::string table =
      "<section><h2>Box</h2><table><tr><th></th><th>from [m]</th><th>to [m]</th>"
      "<th>size [m]</th></tr>\n";
  for (int axis = 0; axis < 3; ++axis) {
    table += Row({std::string(1, "xyz"[axis]), Number("%.3f", box.min()[axis]),
                  Number("%.3f", box.max()[axis]), Number("%.3f", box.sizes()[axis])});
  }
  return table + "</table></section>\n";
}

constexpr char kPageHead[] = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Building</title>
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>
 body { font: 15px/1.45 system-ui, sans-serif; margin: 2rem auto; max-width: 72rem;
        padding: 0 1rem; color: #222; }
 img { max-width: 100%; height: auto; border: 1px solid #ddd; }
 main { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(22rem, 100%), 1fr));
        gap: 1.2rem 2rem; align-items: start; }
 section { max-height: 28rem; overflow-y: auto; }
 table { border-collapse: collapse; width: 100%; }
 th, td { text-align: left; padding: .15rem .6rem .15rem 0; border-bottom: 1px solid #eee;
          vertical-align: top; overflow-wrap: anywhere; }
 th { overflow-wrap: normal; }
 section > h2 { margin-top: 0; }
 h2 { font-size: 1.05rem; margin-bottom: .3rem; }
 li { margin-bottom: .2rem; }
</style></head><body>
<h1>The planned building</h1>
)";

std::string Page(const std::string& picture, const Conversion& conversion) {
  const Sums sums = SumOver(conversion.models);
  std::string page = kPageHead;
  page += "<p>" + Counts(conversion.environment) + ". Arcs of drawings are within " +
          Number("%.3f", conversion.chord_tolerance) +
          " m of their facets. Seen from the south-west, z up; material colours.</p>\n";
  page += Turntable(conversion.environment, conversion.layers);
  page += "<img src=\"" + HtmlText(picture) + "\" alt=\"three-quarter view of the building\">\n";
  if (!conversion.warnings.empty()) {
    page += "<h2>Warnings</h2><ul>\n";
    for (const std::string& warning : conversion.warnings) {
      page += "<li>" + HtmlText(warning) + "</li>\n";
    }
    page += "</ul>\n";
  }
  page += "<main>\n" + BoxTable(conversion.box) + FilesTable(conversion) +
          ElementsTable(conversion) +
          CountsTable("Triangles by material", "material", conversion.triangles_of_material) +
          CountsTable("Entities", "kind", sums.entities) + SkippedTable(sums.skipped);
  std::map<std::string, int> solids;
  const Json::Value json = SolidsJson(conversion.solids);
  for (const std::string& name : json.getMemberNames()) solids[name] = json[name].asInt();
  return page + CountsTable("Solids", "what", solids) + "</main></body></html>\n";
}

std::string Written(const Vector3d& point) {
  return Formatted("(%.3f, %.3f, %.3f)", point.x(), point.y(), point.z());
}

}  // namespace

std::string Conversion::BriefReport() const {
  std::string report = Counts(environment) + "\n";
  if (!box.isEmpty()) {
    report += "  from " + Written(box.min()) + " to " + Written(box.max()) + " m\n";
  }
  constexpr size_t kMostElements = 30;
  const NamedMeasures largest = LargestFirst(elements);
  for (size_t i = 0; i < std::min(largest.size(), kMostElements); ++i) {
    const auto& [name, measures] = largest[i];
    report += "  " + name + ": " + std::to_string(triangles_of_layer.at(name)) +
              Formatted(" faces, %.2f m2, ", measures.area) +
              (measures.volume ? Formatted("%.2f m3\n", *measures.volume) : "open\n");
  }
  if (largest.size() > kMostElements) {
    report +=
        "  and " + std::to_string(largest.size() - kMostElements) + " smaller ones: --report\n";
  }
  constexpr std::ptrdiff_t kMostWarnings = 60;
  if (std::ssize(warnings) <= kMostWarnings) return report + WarningLines(warnings);
  const auto left = std::to_string(std::ssize(warnings) - kMostWarnings);
  return report + WarningLines({warnings.begin(), warnings.begin() + kMostWarnings}) + "  and " +
         left + " more warnings: --report\n";
}

void WriteConvertReport(const std::filesystem::path& path, const Conversion& conversion) {
  const Sums sums = SumOver(conversion.models);
  Json::Value json;
  json["format"] = "insitu convert report";
  json["version"] = 1;
  json["triangles"] = Json::Value::Int64(conversion.environment.triangles.size());
  json["spheres"] = Json::Value::Int64(conversion.environment.spheres.size());
  json["chord_tolerance"] = conversion.chord_tolerance;
  json["lights"] = Json::Value::Int64(conversion.environment.lights.size());
  AddBox(conversion.box, "", &json);
  AddMeasures(Sum(conversion.elements), &json);
  json["elements"] = Json::Value(Json::objectValue);
  for (const auto& [name, measures] : conversion.elements) {
    AddMeasures(measures, &json["elements"][name]);
  }
  json["layers"] = CountsJson(conversion.triangles_of_layer);
  json["materials"] = CountsJson(conversion.triangles_of_material);
  json["entities"] = CountsJson(sums.entities);
  json["skipped"] = SkippedJson(sums.skipped);
  json["solids"] = SolidsJson(conversion.solids);
  json["files"] = Json::arrayValue;
  for (const ModelReport& model : conversion.models) json["files"].append(ModelJson(model));
  json["unlisted_materials"] = Json::arrayValue;
  for (const auto& [name, rgb] : conversion.unlisted) json["unlisted_materials"].append(name);
  json["warnings"] = Json::arrayValue;
  for (const std::string& warning : conversion.warnings) json["warnings"].append(warning);
  WriteJson(path, json);
}

void WritePreview(const std::filesystem::path& stem, const Conversion& conversion) {
  std::filesystem::path picture = stem, page = stem;
  picture += ".png";
  page += ".html";
  WritePng(picture, PreviewImage(conversion.environment), Encoding::kSrgb8);
  WriteWhole(page, Page(picture.filename().string(), conversion));
}

}  // namespace insitu
