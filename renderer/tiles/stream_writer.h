// SPDX-License-Identifier: GPL-3.0-or-later
// A render as a stream into a pipe or socket, for whoever reads at the other end.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include "renderer/tiles/render_watcher.h"
#include "renderer/tiles/tile_stream.h"

namespace insitu {

// How a render is said: each returns bytes, which may be none. `photo` is the whole picture.
struct StreamFormat {
  std::function<std::string()> begin;
  std::function<std::string(const std::string& name, const Raster& photo)> image;
  std::function<std::string(const std::string& name, const Raster& photo, const FinishedTile& tile)>
      tile;
  std::function<std::string(int done, int total)> progress;  // also as a sign of life
  std::function<std::string(bool is_whole)> end;
};

// As tile_stream.h says.
StreamFormat TextFormat(StreamCoding coding);

// A reader that is slow gets the newest state when it reads again, one that has gone nothing more;
// the render waits for neither. At its end it is waited for while it reads.
class RenderStream : public RenderWatcher {
 public:
  // `file`: a descriptor of a pipe, socket or file, which stays open. SIGPIPE is ignored from now
  // on.
  RenderStream(int file, StreamFormat format);
  ~RenderStream() override;

  void Begin(const std::string& name, const Raster& photo) override;
  void Take(const FinishedTile& tile) override;
  void End(bool is_whole) override;

  bool is_closed() const { return is_closed_; }  // by the reader
  int64_t bytes() const { return bytes_; }       // that were written

 private:
  void Run();
  std::string NextText(std::unique_lock<std::mutex>* lock);
  bool Write(const std::string& text);
  bool IsEnded();

  const int file_;
  const StreamFormat format_;
  std::atomic<bool> is_closed_ = false;
  std::atomic<int64_t> bytes_ = 0;
  std::mutex mutex_;  // of what follows
  std::condition_variable news_;
  std::string head_;  // what comes before any tile
  std::string tail_;  // and after all
  std::string name_;
  const Raster* photo_ = nullptr;
  int done_ = 0;
  std::map<int, FinishedTile> tiles_;  // that are not sent
  bool is_ended_ = false;
  std::thread thread_;
};

}  // namespace insitu
