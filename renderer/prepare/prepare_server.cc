// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/prepare/prepare_server.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <thread>
#include <utility>

#include "calibration/files/error.h"
#include "calibration/files/error_at.h"
#include "calibration/files/json_file.h"
#include "calibration/tiles/photo_tiles.h"
#include "calibration/web/end_signals.h"
#include "calibration/web/loopback_server.h"
#include "calibration/web/open_browser.h"
#include "calibration/web/request_guard.h"
#include "reconstruction/editing/edited_tables.h"
#include "reconstruction/geometry/projection_uncertainty.h"
#include "renderer/prepare/library_answer.h"
#include "renderer/prepare/mark_proposal.h"
#include "renderer/prepare/prepare_page.h"
#include "renderer/prepare/prepare_session.h"
#include "renderer/prepare/questions.h"
#include "renderer/prepare/relit_photos.h"
#include "renderer/prepare/site_from_exif.h"
#include "renderer/stages/stage_runs.h"

namespace insitu {
namespace {

constexpr int kPatchRadius = 40;      // [px], of what proposals look at
constexpr double kSearchSigmas = 3;   // of a prediction
constexpr double kWidestSearch = 25;  // [px]
constexpr int kHighestPort = 65535;
constexpr int kMostPanes = 4;

WebResponse JsonResponse(const Json::Value& json, int status = 200) {
  WebResponse response;
  response.status = status;
  response.body = OneLineJson(json);
  return response;
}

// What the page may ask for, answered.
class PrepareService {
 public:
  PrepareService(const SitePaths& site, std::function<void(std::string)> send, const Warn& warn)
      : site_(site),
        paths_(ListPhotographs(site)),
        tiles_(paths_, site.root / "work/prepare/overviews"),
        send_(std::move(send)),
        session_(site, send_, warn),
        relit_(paths_, [this] { return session_.live(); }),
        runs_(site, [this](const Json::Value& message) {
          send_(OneLineJson(message));
          if (message.isMember("status")) session_.Reload();
        }) {
    AddRoutes();
    for (const Json::Value& photo : PhotosJson()) {
      if (photo.isMember("fault")) warn(photo["fault"].asString());
    }
    overviews_ = std::jthread([this](const std::stop_token& stop) { MakeFirstOverviews(stop); });
  }

  WebResponse Answer(const WebRequest& request) const {
    const auto route = routes_.find(request.method + " " + request.path);
    if (route == routes_.end()) return ErrorResponse(404, "no such address");
    return route->second(request);
  }

  std::string Hello() const { return OneLineJson(session_.Hello()); }

  void Stop() {
    runs_.End();
    relit_.Stop();
    session_.Stop();
  }

 private:
  using Route = std::function<WebResponse(const WebRequest&)>;
  using Question = std::function<WebResponse(const Json::Value&)>;

  void AddRoutes() {
    routes_["GET /api/site"] = [this](const WebRequest&) { return JsonResponse(Site()); };
    routes_["GET /api/tile"] = [this](const WebRequest& r) { return Tile(r); };
    routes_["GET /api/patch"] = [this](const WebRequest& r) { return Patch(r); };
    routes_["GET /api/relit"] = [this](const WebRequest& r) { return Relit(r, false); };
    routes_["GET /api/relit_picture"] = [this](const WebRequest& r) { return Relit(r, true); };
    routes_["GET /api/library"] = [this](const WebRequest&) {
      return JsonResponse(LibraryAnswer(site_));
    };
    routes_["GET /api/value"] = [this](const WebRequest& r) { return Value(r); };
    Post("op", [this](const Json::Value& q) { return Told(session_.Apply(q)); });
    Post("undo", [this](const Json::Value& q) { return Told(session_.Undo(q["id"].asString())); });
    Post("redo", [this](const Json::Value& q) { return Told(session_.Redo(q["id"].asString())); });
    Post("merge_decided", [this](const Json::Value& q) {
      session_.Decided(q);
      return JsonResponse(Json::objectValue);
    });
    Post("epipolar", [this](const Json::Value& q) {
      return JsonResponse(EpipolarAnswer(*session_.live(), q));
    });
    Post("measure",
         [this](const Json::Value& q) { return JsonResponse(MeasureAnswer(*session_.live(), q)); });
    Post("best_photo", [this](const Json::Value& q) {
      return JsonResponse(BestPhotoAnswer(*session_.live(), q));
    });
    Post("polygon_at", [this](const Json::Value& q) {
      return JsonResponse(PolygonAtAnswer(*session_.live(), q));
    });
    Post("import", [this](const Json::Value& q) { return JsonResponse(ImportAnswer(site_, q)); });
    Post("refine", [this](const Json::Value& q) { return JsonResponse(Refine(q)); });
    Post("match", [this](const Json::Value& q) { return JsonResponse(Match(q)); });
    Post("run", [this](const Json::Value& q) {
      return Run(q["stage"].asString(), q["label"].asString());
    });
    Post("stop", [this](const Json::Value&) {
      runs_.Stop();
      return JsonResponse(Json::objectValue);
    });
  }

  void Post(const std::string& name, const Question& answer) {
    routes_["POST /api/" + name] = [answer](const WebRequest& request) {
      return answer(ParseJson("request", request.body));
    };
  }

  // What the page shows first, while the browser opens.
  void MakeFirstOverviews(const std::stop_token& stop) {
    for (int i = 0; i < std::min(tiles_.count(), kMostPanes) && !stop.stop_requested(); ++i) {
      try {
        tiles_.Tile(i, tiles_.SizeOf(i).levels - 1, 0, 0);
      } catch (const std::exception&) {  // the page is told when it asks
      }
    }
  }

  static WebResponse Told(const PrepareSession::Answer& answer) {
    return JsonResponse(answer.body, answer.status);
  }

  Json::Value Site() {
    Json::Value site = session_.Site();
    site["photos"] = PhotosJson();
    return site;
  }

  Json::Value PhotosJson() {
    Json::Value photos(Json::arrayValue);
    for (int i = 0; i < tiles_.count(); ++i) {
      Json::Value photo;
      photo["name"] = paths_[i].stem().string();
      try {
        const PyramidSize size = tiles_.SizeOf(i);
        photo["width"] = size.width;
        photo["height"] = size.height;
        photo["levels"] = size.levels;
      } catch (const InputError& error) {
        photo["width"] = photo["height"] = photo["levels"] = 1;
        SentenceOf(error).SayIn(&photo, "fault");
      }
      photos.append(photo);
    }
    return photos;
  }

  WebResponse Tile(const WebRequest& request) {
    WebResponse response;
    response.type = "image/jpeg";
    response.max_age = 3600;
    response.body = tiles_.Tile(QueryInteger(request, "photo"), QueryInteger(request, "level"),
                                QueryInteger(request, "x"), QueryInteger(request, "y"));
    return response;
  }

  WebResponse Patch(const WebRequest& request) {
    WebResponse response;
    response.type = "image/png";
    response.body = tiles_.Patch(QueryInteger(request, "photo"), QueryInteger(request, "x"),
                                 QueryInteger(request, "y"), QueryInteger(request, "r"));
    return response;
  }

  WebResponse Relit(const WebRequest& request, bool is_picture) {
    const auto light = request.query.find("light");
    const RelitPhotos::Answer answer = relit_.Ask(
        QueryInteger(request, "photo"), light == request.query.end() ? "" : light->second);
    if (!is_picture || !answer.jpeg) return JsonResponse(answer.body, answer.status);
    WebResponse response;
    response.type = "image/jpeg";
    response.body = *answer.jpeg;
    return response;
  }

  WebResponse Value(const WebRequest& request) {
    const PixelValue value = tiles_.Value(QueryInteger(request, "photo"),
                                          QueryInteger(request, "x"), QueryInteger(request, "y"));
    Json::Value json;
    json["linear"] = ToJson(value.linear);
    json["encoded"] = ToJson(value.encoded);
    return JsonResponse(json);
  }

  int IndexOf(const std::string& photo) const {
    for (size_t i = 0; i < paths_.size(); ++i) {
      if (paths_[i].stem() == photo) return static_cast<int>(i);
    }
    throw InputError(site_.photos(), "no photograph " + photo);
  }

  GreyPatch GreyAround(const std::string& photo, const Eigen::Vector2d& pixel) {
    GreyPatch patch;
    patch.center = pixel.array().round().cast<int>();
    const std::string png =
        tiles_.Patch(IndexOf(photo), patch.center.x(), patch.center.y(), kPatchRadius);
    const std::vector<uchar> bytes(png.begin(), png.end());
    patch.grey = cv::imdecode(bytes, cv::IMREAD_GRAYSCALE);
    return patch;
  }

  static Json::Value ProposalJson(const std::variant<MarkProposal, NoProposal>& found) {
    Json::Value json;
    if (const auto* why = std::get_if<NoProposal>(&found)) {
      why->SayIn(&json, "error");
      return json;
    }
    const auto& proposal = std::get<MarkProposal>(found);
    json["x"] = proposal.pixel.x();
    json["y"] = proposal.pixel.y();
    json["sigma"] = proposal.sigma_px;
    json["quality"] = proposal.quality;
    json["shift"] = proposal.shift_px;
    return json;
  }

  Json::Value Refine(const Json::Value& question) {
    const Eigen::Vector2d pixel(question["x"].asDouble(), question["y"].asDouble());
    const GreyPatch patch = GreyAround(question["photo"].asString(), pixel);
    const bool is_fiducial = question["fiducial"].asBool();
    return ProposalJson(is_fiducial ? RefineSymmetric(patch, pixel) : RefineCorner(patch, pixel));
  }

  // The point on all photos that lack it and where it is predicted.
  Json::Value Match(const Json::Value& question) {
    const std::string photo = question["photo"].asString(), name = question["point"].asString();
    const std::shared_ptr<const LiveState> live = session_.live();
    const Json::Value& point = live->result.message["points"][name];
    const std::map<std::string, Eigen::Vector2d> marks = session_.MarksOf(name);
    const auto mark = marks.find(photo);
    if (mark == marks.end() || !point["xyz"].isArray()) {
      throw ErrorAt({"match"},
                    Sentence("matchFirst", "the point must be marked here and determined"));
    }
    const Eigen::Vector3d world(point["xyz"][0].asDouble(), point["xyz"][1].asDouble(),
                                point["xyz"][2].asDouble());
    Json::Value answer;
    answer["proposals"] = Json::Value(Json::arrayValue);
    for (const PosedCamera& other : live->result.cameras) {
      const Json::Value& seen = point["images"][other.photo];
      if (seen.isNull() || marks.contains(other.photo)) continue;
      Json::Value proposal = MatchOn(other, seen, photo, mark->second, world, *live);
      if (proposal.isMember("error")) continue;
      proposal["photo"] = other.photo;
      answer["proposals"].append(proposal);
    }
    return answer;
  }

  Json::Value MatchOn(const PosedCamera& other, const Json::Value& seen, const std::string& photo,
                      const Eigen::Vector2d& mark, const Eigen::Vector3d& world,
                      const LiveState& live) {
    const auto here =
        std::find_if(live.result.cameras.begin(), live.result.cameras.end(),
                     [&](const PosedCamera& camera) { return camera.photo == photo; });
    if (here == live.result.cameras.end())
      return ProposalJson(Sentence("matchNotOriented", "not oriented"));
    const Eigen::Vector3d normal = (Center(here->cam_from_world) - world).normalized() +
                                   (Center(other.cam_from_world) - world).normalized();
    const Eigen::Vector2d predicted(seen["x"].asDouble(), seen["y"].asDouble());
    const double radius =
        std::min(kWidestSearch, 2 + kSearchSigmas / kEllipse95 * seen["major"].asDouble());
    return ProposalJson(
        MatchPatch(GreyAround(photo, mark), mark, GreyAround(other.photo, predicted), predicted,
                   OffsetsBetween(*here, other, world, normal.normalized()), radius));
  }

  WebResponse Run(const std::string& stage, const std::string& label) {
    if (stage == "exif-site") {
      PrepareSession::Answer taken = session_.TakeSite(SiteFromExif(paths_), label);
      if (taken.status == 200) taken.body["run"] = 0;  // no program runs for it
      return Told(taken);
    }
    if (stage == "exif-camera") WriteCameraFromExif(site_, paths_);
    Json::Value answer;
    answer["run"] = runs_.Start(stage == "exif-camera" ? "calibrate" : stage);
    return JsonResponse(answer);
  }

  const SitePaths site_;
  const std::vector<std::filesystem::path> paths_;
  PhotoTiles tiles_;
  const std::function<void(std::string)> send_;
  PrepareSession session_;
  RelitPhotos relit_;
  StageRuns runs_;
  std::map<std::string, Route> routes_;
  std::jthread overviews_;
};

// Where the port stands under which the site's page was served last. What the page could not send
// stands in the browser under that address.
std::filesystem::path PortFile(const SitePaths& site) { return site.root / "work/prepare/port"; }

// 0: none.
int LastPort(const SitePaths& site) {
  std::ifstream file(PortFile(site));
  int port = 0;
  return file >> port && port > 0 && port <= kHighestPort ? port : 0;
}

LoopbackServerOptions ServerOptions(int port, const std::string& token) {
  LoopbackServerOptions server;
  server.port = port;
  server.token = token;
  server.public_resources = PreparePage();
  server.slow_paths = {"/api/tile", "/api/patch", "/api/value", "/api/refine", "/api/match"};
  return server;
}

// At the port asked for, else at the site's last one if that is free; `remark` if it is not.
std::unique_ptr<LoopbackServer> MakeServer(const SitePaths& site, const PrepareOptions& options,
                                           const std::string& token,
                                           const LoopbackServerCallbacks& callbacks,
                                           std::string* remark) {
  const int last = options.port == 0 ? LastPort(site) : 0;
  if (last != 0) {
    try {
      return std::make_unique<LoopbackServer>(ServerOptions(last, token), callbacks);
    } catch (const InputError&) {
      *remark = "port " + std::to_string(last) +
                ", under which this site's page was opened last, is taken by another program: what "
                "that page had not sent yet comes in when it is opened with --port " +
                std::to_string(last);
    }
  }
  return std::make_unique<LoopbackServer>(ServerOptions(options.port, token), callbacks);
}

// Not a fault if it cannot be written: then the next port is another one.
void NotePort(const SitePaths& site, int port) { std::ofstream(PortFile(site)) << port << "\n"; }

}  // namespace

void ServePrepare(const SitePaths& site, const PrepareOptions& options, const TellAddress& tell,
                  const Warn& warn) {
  const EndSignals end;
  const std::string token = NewToken();
  std::atomic<LoopbackServer*> windows = nullptr;
  const auto send = [&windows](std::string text) {
    if (LoopbackServer* server = windows) server->Send(std::move(text));
  };
  PrepareService service(site, send, warn);
  const auto greet = [&](int window) {
    if (LoopbackServer* server = windows) server->SendTo(window, service.Hello());
  };
  std::string remark;
  const auto made = MakeServer(
      site, options, token,
      {.on_request = [&](const WebRequest& r) { return service.Answer(r); }, .on_opened = greet},
      &remark);
  LoopbackServer& server = *made;
  NotePort(site, server.port());
  windows = &server;  // what was told before that, the page asks for when it comes
  const std::string url = server.address() + "#" + token;
  std::jthread serving([&] { server.Run(); });
  if (!remark.empty()) warn(remark);
  tell(url);
  {
    const auto page = options.opens_browser ? std::make_unique<OpenedPage>(url) : nullptr;
    end.Wait();
  }
  server.Stop();
  serving.join();
  service.Stop();
}

}  // namespace insitu
