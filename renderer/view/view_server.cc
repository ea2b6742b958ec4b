// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/view/view_server.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "calibration/files/error.h"
#include "calibration/files/json_file.h"
#include "reconstruction/editing/edited_tables.h"
#include "renderer/stages/stage_runs.h"
#include "renderer/view/outline_band.h"
#include "renderer/view/running_renders.h"
#include "renderer/view/site_pictures.h"

namespace insitu {
namespace {

constexpr auto kWatchInterval = std::chrono::milliseconds(150);

std::string QueryText(const WebRequest& request, const std::string& name) {
  const auto found = request.query.find(name);
  return found == request.query.end() ? "" : found->second;
}

// What the page may ask for, answered, and what it is told unasked.
class ViewService : public PageService {
 public:
  ViewService(const SitePaths& site, std::function<void(std::string)> send)
      : site_(site),
        send_(std::move(send)),
        renders_(site),
        pictures_(site, renders_),
        outlines_(site),
        runs_(site, [this](const Json::Value& message) { Told(message); }) {
    AddRoutes();
    renders_.Poll(pictures_.photographs());
    watching_ = std::jthread([this](const std::stop_token& stop) { Watch(stop); });
  }

  WebResponse Answer(const WebRequest& request) override {
    const auto route = routes_.find(request.method + " " + request.path);
    if (route == routes_.end()) return ErrorResponse(404, "no such address");
    return route->second(request);
  }

  void Stop() override {
    watching_.request_stop();
    watching_.join();
    runs_.End();
  }

 private:
  using Route = std::function<WebResponse(const WebRequest&)>;

  void AddRoutes() {
    routes_["GET /api/site"] = [this](const WebRequest&) { return JsonAnswer(Site()); };
    routes_["GET /api/tile"] = [this](const WebRequest& r) {
      return pictures_.Of(QueryInteger(r, "photo"))
          ->Tile(QueryInteger(r, "level"), QueryInteger(r, "x"), QueryInteger(r, "y"));
    };
    routes_["GET /api/value"] = [this](const WebRequest& r) {
      return JsonAnswer(pictures_.Of(QueryInteger(r, "photo"))
                            ->Value(QueryInteger(r, "x"), QueryInteger(r, "y")));
    };
    routes_["GET /api/outline"] = [this](const WebRequest& r) {
      return JsonAnswer(outlines_.Of(QueryText(r, "photo"), QueryText(r, "frame")));
    };
    Post("difference", [this](const Json::Value& q) {
      return pictures_.Difference(q["before"].asInt(), q["after"].asInt());
    });
    Post("run", [this](const Json::Value& q) { return Run(q); });
    Post("stop", [this](const Json::Value&) {
      runs_.Stop();
      return Json::Value(Json::objectValue);
    });
  }

  void Post(const std::string& name, const std::function<Json::Value(const Json::Value&)>& answer) {
    routes_["POST /api/" + name] = [answer](const WebRequest& request) {
      return JsonAnswer(answer(ParseJson("request", request.body)));
    };
  }

  Json::Value Site() {
    Json::Value json;
    json["name"] = std::filesystem::absolute(site_.root).lexically_normal().filename().string();
    json["photos"] = pictures_.List();
    const std::lock_guard lock(mutex_);
    json["running"] = running_;
    return json;
  }

  Json::Value Run(const Json::Value& question) {
    const std::string photo = question["photo"].asString();
    const auto is_it = [&](const std::filesystem::path& path) { return path.stem() == photo; };
    if (std::ranges::none_of(pictures_.photographs(), is_it)) {
      throw InputError(site_.photos(), "no photograph is named " + photo);
    }
    std::vector<std::string> options = {"--photo=" + photo};
    if (question.isMember("quality")) {
      const Json::Value& quality = question["quality"];
      if (quality != "fast" && quality != "draft" && quality != "final") {
        throw InputError("request", "quality is none of fast, draft, final");
      }
      options.push_back("--quality=" + quality.asString());
    }
    if (question["frame"].asString() == "pinhole") options.emplace_back("--frame=pinhole");
    Json::Value answer;
    answer["run"] = runs_.Start("render", options);
    const std::lock_guard lock(mutex_);
    running_ = photo;
    return answer;
  }

  void Told(const Json::Value& message) {
    if (message.isMember("status")) {
      const std::lock_guard lock(mutex_);
      running_ = "";
    }
    send_(OneLineJson(message));
  }

  // Files of others are looked at again and again: a render may run anywhere.
  void Watch(const std::stop_token& stop) {
    std::mutex waiting;
    std::unique_lock lock(waiting);
    std::condition_variable_any ended;
    std::string version = pictures_.Version();
    while (!ended.wait_for(lock, stop, kWatchInterval, [&] { return stop.stop_requested(); })) {
      try {
        bool is_other = false;
        for (const Json::Value& message : renders_.Poll(pictures_.photographs())) {
          send_(OneLineJson(message));
          is_other = is_other || message["anew"].asBool();
        }
        std::string now = pictures_.Version();
        is_other = is_other || now != version;
        version = std::move(now);
        if (is_other) send_(R"({"type": "pictures"})");
      } catch (const std::exception&) {  // of a file that is being replaced: the next look tells
      }
    }
  }

  const SitePaths site_;
  const std::function<void(std::string)> send_;
  RunningRenders renders_;
  SitePictures pictures_;
  OutlineBands outlines_;
  std::mutex mutex_;
  std::string running_;  // the photograph that a render of ours is at; "": none
  StageRuns runs_;
  std::map<std::string, Route> routes_;
  std::jthread watching_;
};

}  // namespace

void ServeView(const SitePaths& site, const ViewOptions& options,
               const std::function<void(const std::string& url)>& tell) {
  ServePage(
      options,
      [&](std::function<void(std::string)> send) {
        return std::make_unique<ViewService>(site, std::move(send));
      },
      tell);
}

}  // namespace insitu
