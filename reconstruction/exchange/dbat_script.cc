// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/exchange/dbat_script.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "calibration/files/error_at.h"
#include "calibration/files/text_table.h"

namespace insitu {
namespace {

// A path of the script: relative to the input's base folder, $HERE the script's own.
std::filesystem::path Resolved(const XmlNode& node, std::string text, const XmlNode& input) {
  const std::filesystem::path here = node.path().parent_path();
  if (text.starts_with("$HERE")) return here / TrimmedView(text.substr(5)).substr(text[5] == '/');
  if (text.starts_with("$")) {
    throw node.Error(
        Sentence("dbatHere", "\"{text}\": only $HERE is known here, expected a path relative to it",
                 {{"text", text}}));
  }
  if (std::filesystem::path(text).is_absolute()) return text;
  const std::string base = input.Attribute("base_dir").value_or("$HERE");
  if (base == "$HERE") return here / text;
  return Resolved(input, base, input) / text;
}

std::filesystem::path FileOf(const XmlNode& file, const XmlNode& input) {
  if (file.Text().empty()) {
    throw file.Error(Sentence("dbatNoFile", "is empty, expected the name of a file"));
  }
  const std::filesystem::path path = Resolved(file, file.Text(), input);
  if (!std::filesystem::is_regular_file(path)) {
    throw file.Error(
        Sentence("dbatFileGone", "there is no file \"{file}\"", {{"file", path.string()}}));
  }
  return path;
}

std::vector<DbatControlPoint> ParseControl(const XmlNode& section, const XmlNode& input) {
  const XmlNode file = section.At("file");
  std::vector<DbatControlPoint> points =
      ReadDbatControl(FileOf(file, input), file.RequiredAttribute("format"));
  for (const XmlNode& filter : section.Children("filter")) {
    const std::vector<std::string> listed = SplitAt(filter.RequiredAttribute("id"), ',');
    const bool keeps = filter.Text() == "keep";
    if (!keeps && filter.Text() != "remove") {
      throw filter.Error(Sentence("dbatFilter", "expected keep or remove"));
    }
    const std::set<std::string> ids(listed.begin(), listed.end());
    std::erase_if(points, [&](const auto& point) { return ids.contains(point.id) != keeps; });
  }
  return points;
}

std::vector<DbatImage> ParseImages(const XmlNode& section, const XmlNode& input) {
  const XmlNode file = section.At("file");
  std::vector<DbatImage> images;
  std::set<std::string> ids;
  for (const auto& row :
       ReadDbatTable(FileOf(file, input), file.RequiredAttribute("format")).rows) {
    const std::string& id = row.Text("id");
    if (!ids.insert(id).second) {
      throw ErrorAt(row.place,
                    Sentence("dbatTwice", "image \"{image}\" stands twice", {{"image", id}}));
    }
    images.push_back({id, std::filesystem::path(row.Text("path")).stem().string(),
                      row.cells.contains("cam") ? row.Text("cam") : "", row.place});
  }
  return images;
}

std::vector<DbatMark> ParseMarks(const XmlNode& section, const XmlNode& input) {
  std::vector<DbatMark> marks;
  for (const XmlNode& file : section.Children("file")) {
    std::vector<DbatMark> read =
        ReadDbatMarks(FileOf(file, input), file.RequiredAttribute("format"));
    const bool has_sigma = file.Attribute("sxy").has_value();
    const double sigma = has_sigma ? file.NumberAttribute("sxy") : 0;
    if (has_sigma && !(sigma > 0)) throw file.Error(Sentence("dbatSxy", "sxy must be positive"));
    for (DbatMark& mark : read) {
      if (has_sigma) mark.sigma_px = sigma;
      if (!mark.sigma_px) {
        throw file.Error(
            Sentence("dbatNoSigma", "marks without sigma, expected a column or attribute sxy"));
      }
    }
    marks.insert(marks.end(), read.begin(), read.end());
  }
  if (marks.empty()) throw section.Error(Sentence("dbatNoMarks", "no marks at all"));
  return marks;
}

std::vector<DbatOrientation> ParseOrientations(const XmlNode& section, const XmlNode& input) {
  const XmlNode file = section.At("file");
  const std::string units = file.Attribute("units").value_or("radians");
  if (units != "degrees" && units != "radians") {
    throw file.Error(Sentence("dbatUnits", "units=\"{units}\", expected degrees or radians",
                              {{"units", units}}));
  }
  const double scale = units == "degrees" ? M_PI / 180 : 1;
  std::vector<DbatOrientation> orientations;
  for (const auto& row :
       ReadDbatTable(FileOf(file, input), file.RequiredAttribute("format")).rows) {
    orientations.push_back(
        {row.Text("id"),
         {row.Number("x"), row.Number("y"), row.Number("z")},
         scale * Eigen::Vector3d(row.Number("omega"), row.Number("phi"), row.Number("kappa")),
         row.place});
  }
  return orientations;
}

std::vector<DbatCamera> ParseCameras(const XmlNode& section, const XmlNode& input) {
  std::vector<XmlNode> elements = section.Children("camera");
  if (const auto file = section.Find("file")) {
    elements = XmlNode::Load(FileOf(*file, input)).At("cameras").Children("camera");
  }
  if (elements.empty()) throw section.Error(Sentence("dbatNoCamera", "no camera"));
  std::vector<DbatCamera> cameras;
  for (const XmlNode& element : elements) cameras.push_back(ParseDbatCamera(element));
  return cameras;
}

// set_initial_values/io: "loaded" or "default", for all or by parameter, or a number.
void SetInitialValue(const XmlNode& node, const std::string& name, DbatCamera* camera) {
  const std::string text = node.Text();
  if (text == "loaded") return;
  const DbatCamera defaults = WithDefaults(*camera);
  const bool is_default = text == "default" || text == "focal";
  if (name == "all" && is_default) {
    *camera = defaults;
  } else if (name == "cc") {
    camera->cc_mm = is_default ? defaults.cc_mm : node.Number();
  } else if (name == "aspect") {
    camera->aspect = is_default ? 1 : node.Number();
  } else if (name == "skew") {
    camera->skew = is_default ? 0 : node.Number();
  } else if (name == "pp" && is_default) {
    camera->pp_mm = defaults.pp_mm;
  } else if (name == "K" && is_default) {
    camera->K = defaults.K;
  } else if (name == "P" && is_default) {
    camera->P = defaults.P;
  } else {
    throw node.Error(
        Sentence("dbatLoaded", "\"{text}\", expected loaded or default", {{"text", text}}));
  }
}

bool ParseTruth(const XmlNode& node) {
  if (node.Text() == "true") return true;
  if (node.Text() == "false") return false;
  throw node.Error(
      Sentence("dbatTruth", "\"{text}\", expected true or false", {{"text", node.Text()}}));
}

// Parameters of kBackwardBrown by DBAT's name.
std::vector<size_t> ParametersNamed(const XmlNode& node, const DbatCamera& camera) {
  static const std::map<std::string, std::vector<size_t>> kNamed = {
      {"cc", {0}},      {"pp", {1, 2}},
      {"px", {1}},      {"py", {2}},
      {"K", {3, 4, 5}}, {"K1", {3}},
      {"K2", {4}},      {"K3", {5}},
      {"P", {6, 7}},    {"P1", {6}},
      {"P2", {7}},      {"aspect", {8}},
      {"skew", {9}},    {"all", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}}};
  const auto named = kNamed.find(node.Name());
  if (named == kNamed.end()) {
    throw node.Error(Sentence("dbatParameter", "is no parameter of a camera that we know"));
  }
  std::vector<size_t> indices = named->second;
  std::erase_if(indices, [&](size_t i) {
    return (i >= 3 && i < 6 && static_cast<int>(i) - 3 >= camera.K_count) ||
           (i >= 6 && i < 8 && static_cast<int>(i) - 6 >= camera.P_count);
  });
  return indices;
}

void ParseEstimated(const XmlNode& operation, DbatScript* script) {
  if (const auto io = operation.Find("io")) {
    if (io->Children().empty()) {
      script->is_estimated.assign(10, ParseTruth(*io));
    }
    for (const XmlNode& node : io->Children()) {
      const bool is_estimated = ParseTruth(node);
      for (const size_t i : ParametersNamed(node, script->cameras[0])) {
        script->is_estimated[i] = is_estimated;
      }
    }
  }
  const auto eo = operation.Find("eo");
  if (!eo) return;
  const XmlNode all = eo->Children().empty() ? *eo : eo->At("all");
  if (!ParseTruth(all) || eo->Children().size() > 1) {
    throw eo->Error(Sentence(
        "dbatFixed", "orientations that are partly fixed are not supported, expected all true"));
  }
}

void ParseOperations(const XmlNode& operations, DbatScript* script) {
  for (const XmlNode& operation : operations.Children("operation")) {
    if (operation.Text() == "check_ray_count") {
      script->min_rays = static_cast<int>(operation.NumberAttribute("min_rays"));
    }
    if (const auto values = operation.Find("set_initial_values")) {
      for (DbatCamera& camera : script->cameras) {
        const auto io = values->Find("io");
        if (!io) break;
        if (io->Children().empty()) SetInitialValue(*io, "all", &camera);
        for (const XmlNode& node : io->Children()) SetInitialValue(node, node.Name(), &camera);
      }
      if (const auto eo = values->Find("eo")) {
        const auto all = eo->Find("all");
        script->start_from_prior_orientations = (all ? all->Text() : eo->Text()) == "loaded";
      }
    }
    if (const auto estimated = operation.Find("set_bundle_estimate_params")) {
      ParseEstimated(*estimated, script);
    }
  }
}

double MetresPerUnit(const XmlNode& document) {
  const auto meta = document.Find("meta");
  const auto unit = meta ? meta->Find("project_unit") : std::nullopt;
  if (!unit || unit->Text() == "m") return 1;
  if (unit->Text() == "mm") return 1e-3;
  throw unit->Error(Sentence("dbatUnit", "\"{text}\", expected m or mm", {{"text", unit->Text()}}));
}

}  // namespace

DbatScript ReadDbatScript(const std::filesystem::path& path) {
  const XmlNode document = XmlNode::Load(path);
  if (!document.Attribute("dbat_script_version")) {
    throw document.Error(
        Sentence("dbatNoScript", "is no script of DBAT: it has no dbat_script_version"));
  }
  const XmlNode input = document.At("input");
  DbatScript script;
  script.metres_per_unit = MetresPerUnit(document);
  script.is_estimated.assign(10, false);
  script.cameras = ParseCameras(input.At("cameras"), input);
  script.images = ParseImages(input.At("images"), input);
  script.marks = ParseMarks(input.At("image_pts"), input);
  if (const auto node = input.Find("ctrl_pts")) script.control = ParseControl(*node, input);
  if (const auto node = input.Find("check_pts")) script.check = ParseControl(*node, input);
  if (const auto node = input.Find("prior_eo")) {
    script.prior_orientations = ParseOrientations(*node, input);
  }
  if (const auto node = document.Find("operations")) ParseOperations(*node, &script);
  return script;
}

}  // namespace insitu
