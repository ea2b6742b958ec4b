// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/view/stream_page.h"

#include <chrono>
#include <mutex>
#include <opencv2/imgproc.hpp>
#include <thread>
#include <utility>
#include <vector>

#include "calibration/files/error.h"
#include "calibration/tiles/photo_tiles.h"
#include "calibration/tiles/shown_image.h"
#include "reconstruction/editing/edited_tables.h"
#include "renderer/tiles/tile_stream.h"
#include "renderer/view/picture.h"

namespace insitu {
namespace {

constexpr auto kTellEvery = std::chrono::milliseconds(250);

// The newest picture of a stream, locked.
class SharedStream {
 public:
  std::mutex mutex;
  StreamedPicture streamed;
  cv::Mat shown;      // CV_8UC3, as it is
  std::string fault;  // of the stream; "": none yet
  bool has_ended = false;

  bool IsDoneAt(int x, int y) const {
    const int columns = (shown.cols + kRenderTile - 1) / kRenderTile;
    return streamed.IsDone(y / kRenderTile * columns + x / kRenderTile);
  }
  void Show() {
    const CodeImage& picture = streamed.picture();
    const cv::Mat rgb(picture.height, picture.width, CV_8UC3,
                      const_cast<uint8_t*>(picture.codes.data()));
    cv::cvtColor(rgb, shown, cv::COLOR_RGB2BGR);
  }
};

class StreamPicture : public Picture {
 public:
  explicit StreamPicture(SharedStream& stream) : stream_(stream) {}

  PyramidSize Size() override {
    const std::lock_guard lock(stream_.mutex);
    if (!stream_.streamed.has_picture()) throw InputError("stream", "holds no picture yet");
    return PyramidSizeOf(stream_.streamed.picture().width, stream_.streamed.picture().height);
  }
  WebResponse Tile(int level, int x, int y) override {
    RequireTile("stream", level, x, y);
    const std::lock_guard lock(stream_.mutex);
    stream_.Show();
    return HatchedTile(stream_.shown, level, x, y,
                       [this](int u, int v) { return stream_.IsDoneAt(u, v); });
  }
  Json::Value Value(int x, int y) override {
    RequirePixel("stream", x, y);
    const std::lock_guard lock(stream_.mutex);
    stream_.Show();
    if (stream_.IsDoneAt(x, y)) return ValueJson(PixelValueAt(stream_.shown, {}, x, y));
    Json::Value json;
    json["unfinished"] = true;
    return json;
  }
  std::string Version() override { return std::to_string(stream_.streamed.pictures()); }

 private:
  SharedStream& stream_;
};

class StreamService : public PageService {
 public:
  StreamService(std::istream* input, std::function<void(std::string)> send)
      : input_(input), send_(std::move(send)), picture_(stream_) {
    // Waits for a line that may never come: the process ends with it.
    std::thread([this] { ReadLines(); }).detach();
    telling_ = std::jthread([this](const std::stop_token& stop) { Tell(stop); });
  }

  WebResponse Answer(const WebRequest& request) override {
    const std::string asked = request.method + " " + request.path;
    if (asked == "GET /api/site") return JsonAnswer(Site());
    if (asked == "GET /api/tile") {
      return picture_.Tile(QueryInteger(request, "level"), QueryInteger(request, "x"),
                           QueryInteger(request, "y"));
    }
    if (asked == "GET /api/value") {
      return JsonAnswer(picture_.Value(QueryInteger(request, "x"), QueryInteger(request, "y")));
    }
    return ErrorResponse(404, "a stream has no such thing");
  }

  void Stop() override { telling_.request_stop(); }

 private:
  void ReadLines() {
    std::string line;
    while (std::getline(*input_, line)) {
      if (input_->eof()) break;  // cut within a line
      const std::lock_guard lock(stream_.mutex);
      try {
        stream_.streamed.TakeLine(line);
      } catch (const InputError& error) {
        stream_.fault = error.what();
        break;
      }
    }
    const std::lock_guard lock(stream_.mutex);
    stream_.has_ended = true;
    if (stream_.fault.empty() && stream_.streamed.state() == StreamedPicture::State::kRunning) {
      stream_.fault = "the stream has ended before its picture was done";
    }
  }

  static const char* StateOf(const SharedStream& stream) {
    if (stream.streamed.state() == StreamedPicture::State::kDone) return "none";
    const bool is_stopped = stream.streamed.state() == StreamedPicture::State::kStopped;
    return stream.has_ended || is_stopped ? "waiting" : "running";
  }

  Json::Value Site() {
    const std::lock_guard lock(stream_.mutex);
    const StreamedPicture& streamed = stream_.streamed;
    Json::Value json, photo, picture;
    photo["pictures"] = Json::Value(Json::arrayValue);
    photo["name"] = streamed.has_picture() ? streamed.name() : "…";
    photo["render"]["state"] = StateOf(stream_);
    photo["render"]["done"] = streamed.done();
    photo["render"]["total"] = streamed.total();
    if (streamed.has_picture()) {
      const PyramidSize size = PyramidSizeOf(streamed.picture().width, streamed.picture().height);
      picture["id"] = 0;
      picture["kind"] =
          streamed.state() == StreamedPicture::State::kDone ? "montage" : "unfinished";
      picture["name"] = "";
      picture["frame"] = "photo";
      picture["width"] = size.width;
      picture["height"] = size.height;
      picture["levels"] = size.levels;
      picture["version"] = picture_.Version();
      photo["pictures"].append(picture);
    }
    json["name"] = "insitu view -";
    json["photos"].append(photo);
    json["running"] = "";
    json["stream"] = true;
    json["fault"] = stream_.fault;
    return json;
  }

  // Tiles that have come, or that it is another picture, or another state.
  void Tell(const std::stop_token& stop) {
    int pictures = 0;
    std::string state;
    while (!stop.stop_requested()) {
      std::this_thread::sleep_for(kTellEvery);
      std::unique_lock lock(stream_.mutex);
      StreamedPicture& streamed = stream_.streamed;
      const std::string now = StateOf(stream_) + stream_.fault;
      const bool is_other = streamed.pictures() != pictures || now != state;
      pictures = streamed.pictures();
      state = now;
      Json::Value message = NewsOf(&streamed);
      message["state"] = StateOf(stream_);
      lock.unlock();
      if (!message["tiles"].empty()) send_(OneLineJson(message));
      if (is_other) send_(R"({"type": "pictures"})");
    }
  }

  static Json::Value NewsOf(StreamedPicture* streamed) {
    Json::Value message;
    message["type"] = "render";
    message["photo"] = streamed->name();
    message["done"] = streamed->done();
    message["total"] = streamed->total();
    message["tiles"] = Json::Value(Json::arrayValue);
    for (const int index : streamed->TakeNews()) {
      const auto tile = TileAt(streamed->picture().width, streamed->picture().height, index);
      Json::Value box(Json::arrayValue);
      for (const int value : {tile.left, tile.top, tile.right, tile.bottom}) box.append(value);
      message["tiles"].append(box);
    }
    return message;
  }

  std::istream* const input_;
  const std::function<void(std::string)> send_;
  SharedStream stream_;
  StreamPicture picture_;
  std::jthread telling_;
};

}  // namespace

std::unique_ptr<PageService> MakeStreamService(std::istream* input,
                                               std::function<void(std::string)> send) {
  return std::make_unique<StreamService>(input, std::move(send));
}

}  // namespace insitu
