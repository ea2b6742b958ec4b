// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/prepare/to_do.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "calibration/files/wording.h"

namespace insitu {
namespace {

constexpr int kLeastControl = 3;              // control points that orient a photo
constexpr Json::ArrayIndex kMostOfAKind = 8;  // items told apart; the rest is counted

class List {
 public:
  explicit List(const ToDoInput& input) : input_(input) {}

  Json::Value Fill() {
    Files();
    Lens();
    Control();
    Photos();
    Points();
    Shapes();
    Directions();
    Light();
    Site();
    if (items_.empty()) {
      Add("make the montage", "nothing that it needs is missing", "")["run"] = "montage";
    }
    for (const Json::Value& item : advice_) items_.append(item);
    return items_;
  }

 private:
  // What a montage needs.
  Json::Value& Add(const std::string& text, const std::string& why, const std::string& mode) {
    return AddTo(&items_, text, why, mode);
  }
  // What makes it better.
  Json::Value& Advise(const std::string& text, const std::string& why, const std::string& mode) {
    return AddTo(&advice_, text, why, mode);
  }
  static Json::Value& AddTo(Json::Value* list, const std::string& text, const std::string& why,
                            const std::string& mode) {
    Json::Value item;
    item["text"] = text;
    item["why"] = why;
    if (!mode.empty()) item["where"]["mode"] = mode;
    return list->append(item);
  }
  Json::ArrayIndex Count(const char* table) const { return input_.tables[table].size(); }
  bool NeedsLens(const Json::Value& left_out) const {
    return left_out["kind"] == "photo" &&
           input_.adjusted["photos"][left_out["name"].asString()]["needs_lens"].asBool();
  }
  bool Has(const std::filesystem::path& path) const { return std::filesystem::exists(path); }

  void Files() {
    for (const std::string& fault : input_.file_faults) {
      Add(fault, "the file takes no part until this is mended", "");
    }
    const Json::Value& failed = input_.adjusted["failed"];
    if (failed.isString()) Add(failed.asString(), "nothing can be adjusted before", "control");
    for (const Json::Value& diagnosis : input_.adjusted["diagnoses"]) {
      if (diagnosis["kind"] == "question") continue;
      Json::Value& item =
          Add(diagnosis["text"].asString(), "found in what was measured", "control");
      for (const char* what : {"photo", "point"}) {
        if (diagnosis.isMember(what)) item["where"][what] = diagnosis[what];
      }
    }
  }

  void Lens() {
    std::string why;
    for (const Json::Value& left : input_.adjusted["left_out"]) {
      if (NeedsLens(left)) why = left["reason"].asString();
    }
    if (why.empty()) return;
    const bool has_something =
        Has(input_.site.boards()) && !std::filesystem::is_empty(input_.site.boards());
    if (has_something) {
      Add("calibrate the camera", why, "")["run"] = "calibrate";
    } else {
      Add("put photographs of a board, or a camera file, into calibration/; or take the focal "
          "length from EXIF for a first look",
          why, "")["run"] = "exif-camera";
    }
  }

  void Control() {
    const Json::ArrayIndex count = Count("control_points");
    if (count >= kLeastControl) return;
    Add(Formatted("%d more control points", kLeastControl - static_cast<int>(count)),
        "their coordinates place the photographs in the world: type or paste them",
        "control")["where"]["table"] = "control_points";
  }

  void Photos() {
    if (Count("control_points") < kLeastControl) return;
    for (const Json::Value& left : input_.adjusted["left_out"]) {
      if (left["kind"] != "photo" || NeedsLens(left)) continue;
      Add(left["name"].asString() + ": " + left["reason"].asString(),
          "the photo is not oriented yet", "control")["where"]["photo"] = left["name"];
    }
  }

  void Points() {
    Json::ArrayIndex more = 0, told = 0;
    for (const Json::Value& left : input_.adjusted["left_out"]) {
      if (left["kind"] == "photo") continue;
      if (told++ >= kMostOfAKind) {
        ++more;
        continue;
      }
      const std::string kind = left["kind"].asString(), name = left["name"].asString();
      Json::Value& item =
          Add(name + ": " + left["reason"].asString(), kind + " takes no part in the adjustment",
              kind == "polygon" ? "polygons" : "control");
      if (kind == "point" || kind == "observation") item["where"]["point"] = name;
      if (left.isMember("photo")) item["where"]["photo"] = left["photo"];
    }
    if (more > 0)
      Add(Formatted("and %d more that take no part", static_cast<int>(more)), "", "control");
  }

  void Shapes() {
    if (Count("polygons") == 0) {
      Add("outline the ground and the buildings as polygons",
          "shadows, occlusion and light need to know what stands there", "polygons");
      return;
    }
    std::vector<std::string> without;
    for (const Json::Value& polygon : input_.tables["polygons"]) {
      if (!polygon["photo"].isString()) without.push_back(polygon["name"].asString());
    }
    if (without.empty()) return;
    Advise(Listing("polygons without a photo that shows them", without, 4),
           "their colour is taken from a photograph", "polygons");
  }

  void Directions() {
    if (Count("zenith") == 0) {
      Advise("a vertical edge: bottom, then top",
             "which way is up is else taken from the coordinates' z axis", "sun");
    }
    if (Count("sun") == 0) {
      Advise("a sun pair: a point, then its shadow",
             "without one the sky is taken as overcast and no shadow is cast", "sun");
    }
  }

  void Light() {
    if (Count("horizon") == 0) {
      Add("a sample of the sky at the horizon", "what haze fades to", "light");
    }
    if (Count("haze") == 0) {
      Advise("haze: one material at two distances or more", "else the air is taken as clear",
             "light");
    }
    if (Count("daylight") < 3) {
      Add(Formatted("%d more daylight samples of one material, in sun and in shade",
                    3 - static_cast<int>(Count("daylight"))),
          "sun, sky and ambient light are told apart by them", "light");
    }
    const bool has_card = !input_.tables["light"].empty() &&
                          input_.tables["light"][0].isMember("daylight_reflectance_rgb");
    if (Count("daylight") > 0 && !has_card) {
      Advise("the reflectance of the daylight samples' material",
             "from a grey card or a table: else the building comes out too dark", "light");
    }
    for (const Json::Value& text : input_.light["left_out"]) {
      Advise(text.asString(), "the sample takes no part", "light");
    }
  }

  void Site() {
    const Json::Value& site = input_.tables["site"];
    if (site.empty() || !site[0].isMember("latitude") || !site[0].isMember("local_time")) {
      Advise("place and time of the photographs", "to check the sun against the almanac",
             "")["run"] = "exif-site";
    }
    if (!Has(input_.site.building())) {
      Add("put the planned building's model into building/", "nothing is planned yet", "");
    } else if (!Has(input_.site.artificial())) {
      Advise("convert the building's model", "its wireframe then stands in every photo",
             "")["run"] = "convert";
    }
  }

  const ToDoInput& input_;
  Json::Value items_ = Json::Value(Json::arrayValue), advice_ = items_;
};

}  // namespace

Json::Value ToDo(const ToDoInput& input) { return List(input).Fill(); }

}  // namespace insitu
