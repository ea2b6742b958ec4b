// SPDX-License-Identifier: GPL-3.0-or-later
// What the connections of a loopback server share.
#pragma once

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/thread_pool.hpp>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "calibration/web/loopback_server_options.h"

namespace insitu {

class LiveWindow;

// One thread runs `network`, which all sockets and all members but the threads belong to.
struct ServerCore {
  ServerCore(LoopbackServerOptions o, LoopbackServerCallbacks c)
      : options(std::move(o)), callbacks(std::move(c)) {}

  const LoopbackServerOptions options;
  const LoopbackServerCallbacks callbacks;
  std::atomic<size_t> served = 0, turned_away = 0;  // connections
  int last_window = 0;
  boost::asio::io_context network{1};
  std::map<int, std::shared_ptr<LiveWindow>> windows;  // whose token was right
  boost::asio::thread_pool threads{static_cast<size_t>(options.threads)};
  boost::asio::thread_pool slow_threads{static_cast<size_t>(options.slow_threads)};
};

// A connection's place among those that are counted.
class ConnectionPlace {
 public:
  explicit ConnectionPlace(std::atomic<size_t>& count) : count_(count) { ++count_; }
  ~ConnectionPlace() { --count_; }
  ConnectionPlace(const ConnectionPlace&) = delete;
  ConnectionPlace& operator=(const ConnectionPlace&) = delete;

 private:
  std::atomic<size_t>& count_;
};

// Calls `work` on one of `threads`, then `done` with its result on the network's thread. `owner`
// lives until then.
template <typename Owner, typename Work, typename Done>
void WorkThen(ServerCore& core, boost::asio::thread_pool& threads, std::shared_ptr<Owner> owner,
              Work work, Done done) {
  boost::asio::post(threads, [&core, owner = std::move(owner), work = std::move(work),
                              done = std::move(done)]() mutable {
    boost::asio::post(core.network, [owner = std::move(owner), done = std::move(done),
                                     result = work()]() mutable { done(std::move(result)); });
  });
}

}  // namespace insitu
