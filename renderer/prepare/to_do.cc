// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/prepare/to_do.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "calibration/files/sentence.h"

namespace insitu {
namespace {

constexpr int kLeastControl = 3;               // control points that orient a photo
constexpr Json::ArrayIndex kSpareControl = 6;  // of so many some can be check points
constexpr Json::ArrayIndex kMostOfAKind = 8;   // items told apart; the rest is counted

class List {
 public:
  explicit List(const ToDoInput& input) : input_(input) {}

  Json::Value Fill() {
    Files();
    Film();
    Lens();
    Control();
    Photos();
    Points();
    Shapes();
    Directions();
    Light();
    Site();
    if (items_.empty()) {
      Add(Sentence("doMontage", "make the montage"),
          Sentence("whyMontage", "nothing that it needs is missing"), "")["run"] = "montage";
    }
    for (const Json::Value& item : advice_) items_.append(item);
    return items_;
  }

 private:
  // What a montage needs.
  Json::Value& Add(const Sentence& text, const Sentence& why, const std::string& mode) {
    return AddTo(&items_, text, why, mode);
  }
  // What makes it better.
  Json::Value& Advise(const Sentence& text, const Sentence& why, const std::string& mode) {
    return AddTo(&advice_, text, why, mode);
  }
  static Json::Value& AddTo(Json::Value* list, const Sentence& text, const Sentence& why,
                            const std::string& mode) {
    Json::Value item;
    text.SayIn(&item, "text");
    why.SayIn(&item, "why");
    if (!mode.empty()) item["where"]["mode"] = mode;
    return list->append(item);
  }
  static Sentence NamedWithReason(const Json::Value& left) {
    return Sentence(
        "named", "{name}: {reason}",
        {{"name", left["name"]}, {"reason", Sentence::SaidIn(left, "reason").ToJson()}});
  }
  // Sentences one after the other.
  static Sentence AllOf(const Json::Value& list) {
    Sentence all = Sentence::SaidIn(list[0], "text");
    for (Json::ArrayIndex i = 1; i < list.size(); ++i) {
      all = Sentence("and", "{one}, {other}", {{"one", all.ToJson()}, {"other", list[i]}});
    }
    return all;
  }
  // The first few names.
  static std::string FirstOf(const std::vector<std::string>& names) {
    constexpr size_t kFew = 4;
    std::string text;
    for (size_t i = 0; i < std::min(names.size(), kFew); ++i) text += (i ? ", " : "") + names[i];
    return text + (names.size() > kFew ? ", ..." : "");
  }
  Json::ArrayIndex Count(const char* table) const { return input_.tables[table].size(); }
  bool NeedsLens(const Json::Value& left_out) const {
    return left_out["kind"] == "photo" &&
           input_.adjusted["photos"][left_out["name"].asString()]["needs_lens"].asBool();
  }
  // Whether nothing can be placed yet for want of a lens: what points lack shows after that.
  bool IsLensAwaited() const {
    bool is_awaited = false;
    for (const Json::Value& photo : input_.adjusted["photos"]) {
      if (photo["oriented"].asBool()) return false;
      is_awaited = is_awaited || photo["needs_lens"].asBool();
    }
    return is_awaited;
  }
  bool Has(const std::filesystem::path& path) const { return std::filesystem::exists(path); }

  void Files() {
    for (const Sentence& fault : input_.file_faults) {
      Add(fault, Sentence("whyFile", "the file takes no part until this is mended"), "");
    }
    const Json::Value& failed = input_.adjusted["failed"];
    if (failed.isString()) {
      Add(Sentence::SaidIn(input_.adjusted, "failed"),
          Sentence("whyFailed", "nothing can be adjusted before"), "control");
    }
    for (const Json::Value& diagnosis : input_.adjusted["diagnoses"]) {
      if (diagnosis["kind"] == "question") continue;
      Json::Value& item = Add(Sentence::SaidIn(diagnosis, "text"),
                              Sentence("whyDiagnosis", "found in what was measured"), "control");
      for (const char* what : {"photo", "point"}) {
        if (diagnosis.isMember(what)) item["where"][what] = diagnosis[what];
      }
    }
  }

  // Until the scans' cameras can be made of it.
  void Film() {
    if (input_.film.isNull()) return;
    for (const Json::Value& fault : input_.film["faults"]) {
      AddOfFilm(Sentence::SaidIn(fault, "text"),
                Sentence("whyFilmFault", "the scans' cameras cannot be made of this"));
    }
    if (const Json::Value& missing = input_.film["missing"]; !missing.empty()) {
      AddOfFilm(Sentence("doCertificate", "the film's certificate lacks: {what}",
                         {{"what", AllOf(missing).ToJson()}}),
                Sentence("whyCertificate",
                         "it ties the scans to the camera's lens: type it"))["where"]["table"] =
          "film";
    }
    const Json::Value& photos = input_.film["photos"];
    for (const std::string& photo : photos.getMemberNames()) Scan(photo, photos[photo]);
    if (needs_film_ || !IsOutdated(photos)) return;
    Add(Sentence("doScans", "calibrate the scans"), Sentence("whyScans", "their film is complete"),
        "")["run"] = "calibrate";
  }

  Json::Value& AddOfFilm(const Sentence& text, const Sentence& why) {
    needs_film_ = true;
    return Add(text, why, "film");
  }

  void Scan(const std::string& photo, const Json::Value& scan) {
    std::vector<std::string> unplaced;
    for (const Json::Value& mark : scan["unplaced"]) unplaced.push_back(mark.asString());
    const int lacking = scan["needed"].asInt() - scan["placed"].asInt();
    const auto at = [&](Json::Value& item) {
      item["where"]["photo"] = photo;
      if (!unplaced.empty()) item["where"]["fiducial"] = unplaced.front();
    };
    if (lacking > 0) {
      at(AddOfFilm(Sentence("doFiducials", "{photo}: fiducials to be placed ({count}): {names}",
                            {{"photo", photo},
                             {"count", static_cast<int>(unplaced.size())},
                             {"names", FirstOf(unplaced)}}),
                   Sentence("whyFiducials", "{count} more tie the scan to its camera",
                            {{"count", lacking}})));
    }
    const Sentence why("whyDisagree", "the scan's fiducials do not agree");
    for (const Json::Value& suspicion : scan["suspicions"]) {
      const Sentence told("named", "{name}: {reason}", {{"name", photo}, {"reason", suspicion}});
      Json::Value& item =
          scan["usable"].asBool() ? Advise(told, why, "film") : AddOfFilm(told, why);
      item["where"]["photo"] = photo;
    }
    if (lacking > 0 || scan["suspicions"].size() > 0) return;
    if (scan["redundancy"] == 0) {
      at(Advise(Sentence("doOneFiducial", "{photo}: one more fiducial", {{"photo", photo}}),
                Sentence("whyOneFiducial",
                         "the film map cannot be checked: an error of a mark would not be seen"),
                "film"));
    } else if (!unplaced.empty()) {
      at(Advise(Sentence("doMoreFiducials", "{photo}: fiducials not placed ({count}): {names}",
                         {{"photo", photo},
                          {"count", static_cast<int>(unplaced.size())},
                          {"names", FirstOf(unplaced)}}),
                Sentence("whyMoreFiducials", "each is a check of the others"), "film"));
    }
  }

  // Whether a scan has no camera, or an older one than its film.
  bool IsOutdated(const Json::Value& photos) const {
    namespace fs = std::filesystem;
    std::error_code none;
    const fs::path folder = input_.site.root / input_.film["folder"].asString();
    for (const std::string& photo : photos.getMemberNames()) {
      const auto made = fs::last_write_time(input_.site.camera(photo), none);
      if (none) return true;
      for (const char* file : {"film.json", "fiducials.csv"}) {
        const auto written = fs::last_write_time(folder / file, none);
        if (none || written > made) return true;
      }
    }
    return false;
  }

  void Lens() {
    if (!input_.film.isNull()) return LensBesideFilm();
    Sentence why;
    for (const Json::Value& left : input_.adjusted["left_out"]) {
      if (NeedsLens(left)) why = Sentence::SaidIn(left, "reason");
    }
    if (why.empty()) return;
    const bool has_something =
        Has(input_.site.boards()) && !std::filesystem::is_empty(input_.site.boards());
    if (has_something) {
      Add(Sentence("doCalibrate", "calibrate the camera"), why, "")["run"] = "calibrate";
    } else {
      Add(Sentence("doLens",
                   "put photographs of a board, or a camera file, into calibration/; or take the "
                   "focal length from EXIF for a first look"),
          why, "")["run"] = "exif-camera";
      Add(Sentence("doFilm", "or, of scanned film, type the camera's certificate"),
          Sentence("whyFilm", "its fiducial marks then tie each scan to the lens"),
          "film")["where"]["table"] = "film";
    }
  }

  // Photos of other cameras than the film's.
  void LensBesideFilm() {
    Sentence why;
    for (const Json::Value& left : input_.adjusted["left_out"]) {
      const bool is_scan = input_.film["photos"].isMember(left["name"].asString());
      if (NeedsLens(left) && !is_scan) why = Sentence::SaidIn(left, "reason");
    }
    if (why.empty() || needs_film_) return;
    Add(Sentence("doCameras", "calibrate the cameras"), why, "")["run"] = "calibrate";
  }

  void Control() {
    const Json::ArrayIndex count = Count("control_points");
    if (count >= kLeastControl) return AskForCheckPoints();
    Add(Sentence("doControl", "{count} more control points",
                 {{"count", kLeastControl - static_cast<int>(count)}}),
        Sentence("whyControl",
                 "their coordinates place the photographs in the world: type or paste them"),
        "control")["where"]["table"] = "control_points";
  }

  void AskForCheckPoints() {
    const Json::Value& points = input_.tables["control_points"];
    const bool has_check = std::any_of(points.begin(), points.end(), [](const Json::Value& point) {
      return point["role"] == "check";
    });
    if (has_check || points.size() < kSpareControl) return;
    Advise(Sentence("doCheck", "make some of the control points check points: none is one"),
           Sentence("whyCheck", "they stay out of the adjustment and tell how good it is"),
           "control")["where"]["table"] = "control_points";
  }

  void Photos() {
    if (Count("control_points") < kLeastControl) return;
    for (const Json::Value& left : input_.adjusted["left_out"]) {
      if (left["kind"] != "photo" || NeedsLens(left)) continue;
      Add(NamedWithReason(left), Sentence("whyPhoto", "the photo is not oriented yet"),
          "control")["where"]["photo"] = left["name"];
    }
  }

  void Points() {
    if (IsLensAwaited()) return;
    Json::ArrayIndex more = 0, told = 0;
    for (const Json::Value& left : input_.adjusted["left_out"]) {
      if (left["kind"] == "photo") continue;
      if (told++ >= kMostOfAKind) {
        ++more;
        continue;
      }
      const std::string kind = left["kind"].asString(), name = left["name"].asString();
      Json::Value& item =
          Add(NamedWithReason(left), Sentence("whyLeftOut", "it takes no part in the adjustment"),
              kind == "polygon" ? "polygons" : "control");
      if (kind == "point" || kind == "observation") item["where"]["point"] = name;
      if (left.isMember("photo")) item["where"]["photo"] = left["photo"];
    }
    if (more == 0) return;
    Add(Sentence("doMore", "and {count} more that take no part", {{"count", more}}), {}, "control");
  }

  void Shapes() {
    if (Count("polygons") == 0) {
      Add(Sentence("doPolygons", "outline the ground and the buildings as polygons"),
          Sentence("whyPolygons", "shadows, occlusion and light need to know what stands there"),
          "polygons");
      return;
    }
    std::vector<std::string> without;
    for (const Json::Value& polygon : input_.tables["polygons"]) {
      if (!polygon["photo"].isString()) without.push_back(polygon["name"].asString());
    }
    if (without.empty()) return;
    Advise(Sentence("doImages", "polygons without a photo that shows them ({count}): {names}",
                    {{"count", static_cast<int>(without.size())}, {"names", FirstOf(without)}}),
           Sentence("whyImages", "their colour is taken from a photograph"), "polygons");
  }

  void Directions() {
    if (Count("zenith") == 0) {
      Advise(Sentence("doZenith", "a vertical edge: bottom, then top"),
             Sentence("whyZenith", "which way is up is else taken from the coordinates' z axis"),
             "sun");
    }
    if (Count("sun") == 0) {
      Advise(Sentence("doSun", "a sun pair: a point, then its shadow"),
             Sentence("whySun", "without one the sky is taken as overcast and no shadow is cast"),
             "sun");
    }
  }

  void Light() {
    if (Count("horizon") == 0) {
      Add(Sentence("doHorizon", "a sample of the sky at the horizon"),
          Sentence("whyHorizon", "what haze fades to"), "light");
    }
    if (Count("haze") == 0) {
      Advise(Sentence("doHaze", "haze: one material at two distances or more"),
             Sentence("whyHaze", "else the air is taken as clear"), "light");
    }
    if (Count("daylight") < 3) {
      Add(Sentence("doDaylight",
                   "daylight samples of one material, in sun and in shade: {count} more",
                   {{"count", 3 - static_cast<int>(Count("daylight"))}}),
          Sentence("whyDaylight", "sun, sky and ambient light are told apart by them"), "light");
    }
    const Json::Value& light = input_.tables["light"];
    const bool has_card = !light.empty() && (light[0].isMember("daylight_reflectance_rgb") ||
                                             light[0].isMember("daylight_material"));
    if (Count("daylight") > 0 && !has_card) {
      Advise(Sentence("doReflectance", "the reflectance of the daylight samples' material"),
             Sentence("whyReflectance",
                      "from a grey card or a table: else the building comes out too dark"),
             "light");
    }
    for (const Json::Value& fault : input_.light["left_out"]) {
      Advise(Sentence::SaidIn(fault, "text"), Sentence("whySample", "the sample takes no part"),
             "light");
    }
  }

  void Site() {
    const Json::Value& site = input_.tables["site"];
    if (site.empty() || !site[0].isMember("latitude") || !site[0].isMember("local_time")) {
      Advise(Sentence("doSite", "place and time of the photographs"),
             Sentence("whySite", "to check the sun against the almanac"), "")["run"] = "exif-site";
    }
    if (!Has(input_.site.building())) {
      Add(Sentence("doBuilding", "put the planned building's model into building/"),
          Sentence("whyBuilding", "nothing is planned yet"), "");
    } else if (!Has(input_.site.artificial())) {
      Advise(Sentence("doConvert", "convert the building's model"),
             Sentence("whyConvert", "its wireframe then stands in every photo"), "")["run"] =
          "convert";
    }
  }

  const ToDoInput& input_;
  bool needs_film_ = false;  // something of the film keeps the scans from being calibrated
  Json::Value items_ = Json::Value(Json::arrayValue), advice_ = items_;
};

}  // namespace

Json::Value ToDo(const ToDoInput& input) { return List(input).Fill(); }

}  // namespace insitu
